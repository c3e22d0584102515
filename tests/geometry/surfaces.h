#pragma once
// Surfaces with known answers, and bodies from the shared folder where it is there.
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "geometry/shapes.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/geodesic.h"
#include "karinui/geometry/mesh.h"

namespace karinui::surfaces {

// A grid of (columns x rows) cells carried into space; `round`: the last column joins the first.
inline TriangleMesh grid(int columns, int rows, bool round, const std::function<Vec3(double, double)>& place) {
  TriangleMesh mesh;
  const int across = round ? columns : columns + 1;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < across; ++i)
      mesh.points.push_back(place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * across + (round ? i % columns : i)); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  return mesh;
}
inline TriangleMesh plane(int cells, double size) {  // faces +z
  return grid(cells, cells, false, [&](double s, double t) { return Vec3{s * size, t * size, 0}; });
}
inline TriangleMesh cylinder(int round, int up, double radius, double height) {  // about y, open at both ends
  return grid(round, up, true, [&](double s, double t) {
    const double a = 2 * std::numbers::pi * s;
    return Vec3{radius * std::sin(a), height * t, radius * std::cos(a)};
  });
}
inline TriangleMesh cone(int round, int up, double low, double high, double height) {
  return grid(round, up, true, [&](double s, double t) {
    const double a = 2 * std::numbers::pi * s, r = low + (high - low) * t;
    return Vec3{r * std::sin(a), height * t, r * std::cos(a)};
  });
}
inline TriangleMesh ball(int round, int up, double radius) {  // closed
  TriangleMesh mesh = grid(round, up, true, [&](double s, double t) {
    const double a = 2 * std::numbers::pi * s, b = std::numbers::pi * (0.001 + 0.998 * t);
    return Vec3{radius * std::sin(b) * std::sin(a), -radius * std::cos(b), radius * std::sin(b) * std::cos(a)};
  });
  const auto n = static_cast<std::uint32_t>(round), last = static_cast<std::uint32_t>(round * up);
  const auto bottom = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back({0, -radius, 0});
  mesh.points.push_back({0, radius, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.faces.push_back({(i + 1) % n, i, bottom});
    mesh.faces.push_back({last + i, last + (i + 1) % n, bottom + 1});
  }
  return mesh;
}
inline SurfacePoint nearest(const Bvh& bvh, Vec3 p) { return bvh.nearest(p)->place; }

inline std::optional<TriangleMesh> sharedBody(const std::string& name) {
  TriangleMesh mesh = test::readPlainObj(std::string(KARINUI_SHARED_DIR) + "/bodies/" + name + ".obj");
  if (mesh.faces.empty()) return std::nullopt;
  return mesh;
}

}  // namespace karinui::surfaces
