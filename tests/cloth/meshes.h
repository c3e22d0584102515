#pragma once
// Bodies of meshes whose distances are known.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/body/body.h"

namespace karinui::test {

// A box about the origin, each side cut into `parts` x `parts` squares of two faces.
inline TriangleMesh boxMesh(Vec3 half, std::uint32_t parts) {
  TriangleMesh mesh;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> have;
  const auto corner = [&](std::array<std::int64_t, 3> at) {
    const auto [found, fresh] = have.emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (fresh) {
      const auto place = [&](int axis, double h) { return h * (2.0 * static_cast<double>(at[axis]) / parts - 1); };
      mesh.points.push_back({place(0, half.x), place(1, half.y), place(2, half.z)});
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (std::int64_t i = 0; i < parts; ++i)
        for (std::int64_t j = 0; j < parts; ++j) {
          const auto at = [&](std::int64_t di, std::int64_t dj) {
            std::array<std::int64_t, 3> p{};
            p[axis] = upper ? parts : 0;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            return corner(p);
          };
          const std::uint32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          if (upper) {
            mesh.faces.push_back({a, b, c});
            mesh.faces.push_back({a, c, d});
          } else {
            mesh.faces.push_back({a, c, b});
            mesh.faces.push_back({a, d, c});
          }
        }
  return mesh;
}

// The same box blown up to a ball.
inline TriangleMesh ballMesh(double radius, std::uint32_t parts) {
  TriangleMesh mesh = boxMesh({1, 1, 1}, parts);
  for (Vec3& p : mesh.points) p = normalized(p) * radius;
  return mesh;
}

inline BodyPtr bodyOf(TriangleMesh mesh) {
  Body::Parts parts;
  parts.name = "test";
  parts.mesh = std::move(mesh);
  auto body = Body::make(std::move(parts));
  EXPECT_TRUE(body) << (body ? "" : text(body.error().what));
  return *body;
}

}  // namespace karinui::test
