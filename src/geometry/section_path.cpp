// The line between two places of a mesh that stays in a plane.
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "karinui/geometry/geodesic.h"

namespace karinui {
namespace {

class Section {
 public:
  Section(const SurfaceGuide& guide, Vec3 normal, double offset)
      : guide_(guide), mesh_(guide.mesh()), normal_(normalized(normal)), offset_(offset) {}

  // Corners on the plane count as above it, so every face is crossed through exactly two edges or not at all.
  double height(std::uint32_t point) const { return dot(normal_, mesh_.points[point]) - offset_; }
  bool crosses(std::uint32_t face, std::size_t k) const {
    const Triangle& t = mesh_.faces[face];
    return (height(t[k]) >= 0) != (height(t[(k + 1) % 3]) >= 0);
  }
  SurfacePoint crossing(std::uint32_t face, std::size_t k) const {
    const Triangle& t = mesh_.faces[face];
    const std::size_t next = (k + 1) % 3;
    const double a = height(t[k]), b = height(t[next]);
    double w = a / (a - b);
    w = w < 1e-9 ? 0 : w > 1 - 1e-9 ? 1 : w;
    SurfacePoint place{face, {0, 0, 0}};
    place.weight[k] = 1 - w;
    place.weight[next] = w;
    return place;
  }

  // The nearest place of the section to a given place, in its face or one close by.
  std::optional<SurfacePoint> onto(const SurfacePoint& place) const {
    const Vec3 here = at(mesh_, place);
    std::deque<std::uint32_t> open{place.face};
    std::vector<std::uint32_t> seen{place.face};
    std::optional<SurfacePoint> best;
    double bestDistance = 0;
    for (std::size_t looked = 0; !open.empty() && looked < 400; ++looked) {
      const std::uint32_t f = open.front();
      open.pop_front();
      if (const auto near = nearestIn(f, here)) {
        const double d = distance(at(mesh_, *near), here);
        if (!best || d < bestDistance) {
          best = near;
          bestDistance = d;
        }
        if (looked == 0) return best;
      }
      if (best && looked > 40) break;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t g = guide_.across(f, k);
        if (g == SurfaceGuide::kNone || std::find(seen.begin(), seen.end(), g) != seen.end()) continue;
        seen.push_back(g);
        open.push_back(g);
      }
    }
    return best;
  }

  // From a place in its face out over edge k and on, to the place in the goal's face.
  std::optional<SurfacePath> walk(const SurfacePoint& from, std::size_t k, const SurfacePoint& to) const {
    SurfacePath path;
    add(path, from);
    std::uint32_t f = from.face;
    for (std::size_t guard = 0; guard < mesh_.faces.size(); ++guard) {
      add(path, crossing(f, k));
      const std::uint32_t g = guide_.across(f, static_cast<int>(k));
      if (g == SurfaceGuide::kNone || g == from.face) return std::nullopt;
      if (g == to.face) {
        add(path, to);
        return path;
      }
      std::size_t out = 3;
      for (std::size_t j = 0; j < 3; ++j)
        if (crosses(g, j) && guide_.across(g, static_cast<int>(j)) != f) out = j;
      if (out == 3) return std::nullopt;
      f = g;
      k = out;
    }
    return std::nullopt;
  }

  void add(SurfacePath& path, const SurfacePoint& place) const {
    const Vec3 p = at(mesh_, place);
    if (!path.points.empty()) {
      const double step = distance(path.points.back(), p);
      if (step <= 0) return;
      path.length += step;
    }
    path.places.push_back(place);
    path.points.push_back(p);
  }

 private:
  std::optional<SurfacePoint> nearestIn(std::uint32_t face, Vec3 here) const {
    std::optional<SurfacePoint> a, b;
    for (std::size_t k = 0; k < 3; ++k)
      if (crosses(face, k)) (a ? b : a) = crossing(face, k);
    if (!a || !b) return std::nullopt;
    const Vec3 p = at(mesh_, *a), step = at(mesh_, *b) - p;
    const double long2 = squaredLength(step);
    const double t = long2 > 0 ? std::clamp(dot(here - p, step) / long2, 0.0, 1.0) : 0;
    SurfacePoint place{face, {}};
    for (std::size_t k = 0; k < 3; ++k) place.weight[k] = a->weight[k] * (1 - t) + b->weight[k] * t;
    return place;
  }

  const SurfaceGuide& guide_;
  const TriangleMesh& mesh_;
  Vec3 normal_;
  double offset_;
};

}  // namespace

Result<SurfacePath> SurfaceGuide::section(const SurfacePoint& from, const SurfacePoint& to, Vec3 normal,
                                          double offset) const {
  const Section section(*this, normal, offset);
  const auto start = section.onto(from), end = section.onto(to);
  if (!start || !end) return refused(say("A place that should lie on the centre line is not near it."));
  if (start->face == end->face) {
    SurfacePath path;
    section.add(path, *start);
    section.add(path, *end);
    return path;
  }
  std::optional<SurfacePath> best;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!section.crosses(start->face, k)) continue;
    auto path = section.walk(*start, k, *end);
    if (path && (!best || path->length < best->length)) best = std::move(path);
  }
  if (!best)
    return refused(say("The two ends of the centre line are not joined by a line down the middle of the body."));
  return *std::move(best);
}

}  // namespace karinui
