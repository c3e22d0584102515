#include <algorithm>
#include <cmath>

#include "karinui/geometry/patch.h"
#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

// A flat map as a mesh on the plane z = 0, to find the triangle under a paper place.
TriangleMesh asPlane(std::span<const Flat> flat, const std::vector<Triangle>& faces) {
  TriangleMesh plane;
  for (Flat p : flat) plane.points.push_back({p.u, p.v, 0});
  plane.faces = faces;
  return plane;
}

struct BorderPoint {
  Flat flat;
  std::uint32_t a = 0, b = 0;  // between these points of the old border
  double share = 0;
  std::uint32_t side = 0;
};

// Each side cut into equal lengths (in space) of about the spacing, corners kept.
std::vector<BorderPoint> walkBorder(const Patch& patch, std::span<const Flat> flat, double spacing) {
  std::vector<BorderPoint> out;
  const std::size_t n = patch.border.size();
  const auto step = [&](std::size_t i) {
    return distance(patch.mesh.points[patch.border[i % n]], patch.mesh.points[patch.border[(i + 1) % n]]);
  };
  for (std::size_t start = 0; start < n;) {
    std::size_t end = start;
    double whole = 0;
    while (end < n && patch.side[end] == patch.side[start]) whole += step(end++);
    const int parts = std::max(1, static_cast<int>(std::lround(whole / spacing)));
    std::size_t i = start;
    double passed = 0;
    for (int k = 0; k < parts; ++k) {
      const double goal = whole * k / parts;
      while (i + 1 < end && passed + step(i) <= goal + 1e-12) passed += step(i++);
      const double l = step(i), share = l > 0 ? std::clamp((goal - passed) / l, 0.0, 1.0) : 0;
      const std::uint32_t a = patch.border[i % n], b = patch.border[(i + 1) % n];
      out.push_back({lerp(flat[a], flat[b], share), a, b, share, patch.side[start]});
    }
    start = end;
  }
  return out;
}

}  // namespace

Result<Remeshed> remeshed(const Patch& patch, std::span<const Flat> flat, double spacing) {
  KARINUI_ASSERT(flat.size() == patch.mesh.points.size() && spacing > 0);
  const std::vector<BorderPoint> walk = walkBorder(patch, flat, spacing);
  if (walk.size() < 3) return refused(say("The line is too small to hold a piece of cloth."));
  Ring ring;
  for (const BorderPoint& p : walk) ring.push_back(p.flat);
  if (crossing(ring)) return refused(say("Laid flat, the piece would overlap itself; draw it as two pieces."));

  // Inside: rows of equal triangles, clear of the border.
  const auto [low, high] = boxOf(ring);
  const double rowStep = spacing * std::sqrt(3.0) / 2;
  std::vector<Flat> inner;
  int row = 0;
  for (double v = low.v + rowStep / 2; v < high.v; v += rowStep, ++row)
    for (double u = low.u + (row % 2 ? spacing / 2 : 0); u < high.u; u += spacing)
      if (contains(ring, {u, v}) && distanceToRing(ring, {u, v}) > 0.55 * spacing) inner.push_back({u, v});
  const auto faces = triangulate(ring, {}, inner);
  if (!faces) return faces.error();

  Remeshed out;
  out.patch.turned = patch.turned;
  out.patch.mesh.faces = *faces;
  out.flat = ring;
  out.flat.insert(out.flat.end(), inner.begin(), inner.end());
  const TriangleMesh plane = asPlane(flat, patch.mesh.faces);
  const Bvh finder(plane);
  for (std::size_t i = 0; i < out.flat.size(); ++i) {
    const auto under = finder.nearest({out.flat[i].u, out.flat[i].v, 0});
    KARINUI_ASSERT(under);
    out.from.push_back(under->place);
    const Vec3 p = i < walk.size() ? lerp(patch.mesh.points[walk[i].a], patch.mesh.points[walk[i].b], walk[i].share)
                                   : at(patch.mesh, under->place);
    out.patch.mesh.points.push_back(p);
  }
  for (std::uint32_t i = 0; i < walk.size(); ++i) {
    out.patch.border.push_back(i);
    out.patch.side.push_back(walk[i].side);
  }
  out.patch.first.assign(patch.first.size(), 0);
  for (std::size_t i = walk.size(); i-- > 0;)
    if (i == 0 || out.patch.side[i - 1] != out.patch.side[i])
      out.patch.first[out.patch.side[i]] = static_cast<std::uint32_t>(i);
  return out;
}

}  // namespace karinui
