#include <cmath>
#include <numbers>

#include "karinui/scene/scene_frame.h"

namespace karinui {

namespace {

// The frame of a trim at one of its pairs: along the edge, out of the cloth beyond the edge, and up from its right
// side.
struct EdgeFrame {
  Vec3 edge, inside, along, out, up;
};

std::vector<EdgeFrame> framesOf(const SceneTrim& trim, const TriangleMesh& cloth) {
  std::vector<EdgeFrame> frames;
  const std::vector<Vec3>& points = cloth.points;
  for (std::size_t k = 0; k < trim.edge.size() && k < trim.inside.size(); ++k) {
    const Triangle& f = trim.inside[k].corners;
    if (f[0] >= points.size() || f[1] >= points.size() || f[2] >= points.size()) return {};
    frames.push_back({trim.edge[k].on(points), trim.inside[k].on(points), {}, {}, {}});
    frames.back().up = normalized(cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]));
  }
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EdgeFrame& own = frames[k];
    const Vec3 before = frames[k > 0 ? k - 1 : 0].edge, after = frames[std::min(k + 1, frames.size() - 1)].edge;
    own.along = normalized(after - before);
    const Vec3 out = own.edge - own.inside;
    own.out = normalized(out - own.along * dot(out, own.along));
    if (!(length(own.out) > 0.5)) own.out = normalized(cross(own.along, own.up));
  }
  return frames;
}

// Rings of points, one a frame, joined to a skin; a closed one is capped at both ends.
TriangleMesh skinOf(const std::vector<std::vector<Vec3>>& rings, bool closed) {
  TriangleMesh mesh;
  if (rings.size() < 2) return mesh;
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  for (const auto& ring : rings) mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  for (std::uint32_t k = 0; k + 1 < rings.size(); ++k)
    for (std::uint32_t i = 0; i < (closed ? n : n - 1); ++i) {
      const std::uint32_t a = k * n + i, b = k * n + (i + 1) % n;
      mesh.faces.push_back({a, a + n, b}), mesh.faces.push_back({b, a + n, b + n});
    }
  const std::uint32_t last = static_cast<std::uint32_t>(rings.size() - 1) * n;
  for (std::uint32_t i = 1; closed && i + 1 < n; ++i) {
    mesh.faces.push_back({0, i, i + 1}), mesh.faces.push_back({last, last + i + 1, last + i});
  }
  return mesh;
}

}  // namespace

TriangleMesh meshOf(const SceneTrim& trim, const TriangleMesh& cloth) {
  constexpr int kRound = 12;
  constexpr double kTurnIn = 0.0006;  // metres from the cloth's middle to a strip's outside, with its own cloth
  std::vector<std::vector<Vec3>> rings;
  for (const EdgeFrame& at : framesOf(trim, cloth)) {
    auto& ring = rings.emplace_back();
    if (trim.kind == SceneTrim::Kind::Cord) {
      const double radius = trim.thickness / 2;
      const Vec3 middle = at.edge + (trim.raised ? at.up : at.out) * radius;
      for (int k = 0; k < kRound; ++k) {
        const double turn = 2 * std::numbers::pi * k / kRound;
        ring.push_back(middle + (at.out * std::cos(turn) + at.up * std::sin(turn)) * radius);
      }
      continue;
    }
    const double lift = kTurnIn + trim.thickness;
    for (const auto& [place, side] : {std::pair(at.inside, 1.0), {at.edge, 1.0}, {at.edge, -1.0}, {at.inside, -1.0}})
      ring.push_back(place + at.up * (side * lift));
    ring.insert(ring.begin() + 2, at.edge + at.out * lift);
  }
  return skinOf(rings, trim.kind == SceneTrim::Kind::Cord);
}

}  // namespace karinui
