#pragma once
// Small scenes every view test shares: a ball as body, a flat cloth, a tube of cloth.
#include <cmath>
#include <numbers>

#include "karinui/scene/scene_frame.h"

namespace karinui::test {

// A round body standing on the ground.
inline SceneBody ball(Vec3 centre, double radius, std::uint32_t rings = 24) {
  SceneBody body;
  const std::uint32_t rays = 2 * rings;
  for (std::uint32_t j = 0; j <= rings; ++j)
    for (std::uint32_t i = 0; i < rays; ++i) {
      const double a = std::numbers::pi * j / rings, b = 2 * std::numbers::pi * i / rays;
      body.mesh.points.push_back(centre +
                                 radius * Vec3{std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)});
    }
  for (std::uint32_t j = 0; j < rings; ++j)
    for (std::uint32_t i = 0; i < rays; ++i) {
      const std::uint32_t p = j * rays + i, q = j * rays + (i + 1) % rays;
      body.mesh.faces.push_back({p, p + rays, q});
      body.mesh.faces.push_back({q, p + rays, q + rays});
    }
  return body;
}

// A sheet facing +z, from (x0, y0) to (x1, y1) at depth z; strain grows from 0 at the left to `strain` at the right.
inline SceneCloth sheet(double x0, double y0, double x1, double y1, double z, double strain = 0, std::uint32_t n = 16) {
  SceneCloth cloth;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
      cloth.mesh.points.push_back({x0 + (x1 - x0) * s, y0 + (y1 - y0) * t, z});
      cloth.flat.push_back({(x1 - x0) * s, (y1 - y0) * t});
      if (strain > 0) cloth.strain.push_back(static_cast<float>(strain * s));
    }
  const std::uint32_t row = n + 1;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = j * row + i;
      cloth.mesh.faces.push_back({p, p + 1, p + row + 1});
      cloth.mesh.faces.push_back({p, p + row + 1, p + row});
    }
  std::vector<std::uint32_t> border;
  for (std::uint32_t i = 0; i < n; ++i) border.push_back(i);
  for (std::uint32_t j = 0; j < n; ++j) border.push_back(j * row + n);
  for (std::uint32_t i = 0; i < n; ++i) border.push_back(n * row + n - i);
  for (std::uint32_t j = 0; j <= n; ++j) border.push_back((n - j) * row);
  cloth.outlines.push_back(border);
  cloth.colour = {0.10f, 0.20f, 0.60f};
  return cloth;
}

// A standing tube with folds, sewn down one side.
inline SceneCloth tube(Vec3 foot, double radius, double height, std::uint32_t n = 96) {
  SceneCloth cloth;
  const std::uint32_t rows = 24;
  std::vector<std::uint32_t> seam;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    seam.push_back(j * n + n / 12);
    for (std::uint32_t i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n, t = static_cast<double>(j) / rows;
      const double r = radius * (1.25 - 0.25 * t + 0.08 * (1 - t) * std::sin(9 * a));
      cloth.mesh.points.push_back(foot + Vec3{r * std::sin(a), height * t, r * std::cos(a)});
      cloth.flat.push_back({radius * a, height * t});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = j * n + i, q = j * n + (i + 1) % n;
      cloth.mesh.faces.push_back({p, q, q + n});
      cloth.mesh.faces.push_back({p, q + n, p + n});
    }
  cloth.seams.push_back(seam);
  return cloth;
}

}  // namespace karinui::test
