#include "karinui/cloth/lay_between.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "karinui/geometry/bvh.h"

namespace karinui {
namespace {

constexpr double kBeneath = 0.005;  // metres: what was laid beneath a piece lies no further from it
constexpr double kShare = 0.45;     // of the gap between the two layers, from the outer one

// The faces of some layers together; points are cloth nodes.
TriangleMesh layersOf(const Cloth& cloth, const std::vector<Vec3>& x, auto isOne) {
  TriangleMesh mesh;
  mesh.points = x;
  for (const ClothPiece& piece : cloth.pieces)
    if (isOne(piece.layer))
      for (const Triangle& f : piece.lattice->faces)
        mesh.faces.push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
  return mesh;
}

// At the nodes of `outer`, how near `inner` comes to the faces around each at least, metres.
std::vector<double> gapsBetween(const TriangleMesh& outer, const Bvh& nearOuter, const TriangleMesh& inner,
                                const Bvh& nearInner) {
  std::vector<double> gaps(outer.points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> done(outer.points.size(), 0);
  for (const Triangle& face : outer.faces)
    for (const std::uint32_t k : face)
      if (!std::exchange(done[k], 1))
        if (const auto near = nearInner.nearest(outer.points[k], 2 * kBeneath)) gaps[k] = near->distance;
  std::fill(done.begin(), done.end(), 0);
  for (const Triangle& face : inner.faces)
    for (const std::uint32_t k : face)
      if (!std::exchange(done[k], 1))
        if (const auto near = nearOuter.nearest(inner.points[k], 2 * kBeneath))
          for (const std::uint32_t corner : outer.faces[near->place.face])
            gaps[corner] = std::min(gaps[corner], near->distance);
  return gaps;
}

}  // namespace

bool layBetween(const Cloth& cloth, std::vector<Vec3>& x) {
  std::set<int> layers;
  for (const ClothPiece& piece : cloth.pieces) layers.insert(piece.layer);
  bool laid = false;
  for (const int layer : layers) {
    const TriangleMesh outer = layersOf(cloth, x, [&](int other) { return other > layer; }),
                       inner = layersOf(cloth, x, [&](int other) { return other < layer; });
    if (outer.faces.empty() || inner.faces.empty()) continue;
    const Bvh nearOuter(outer), nearInner(inner);
    std::vector<double> gaps;  // once they are asked for
    for (const ClothPiece& piece : cloth.pieces) {
      if (piece.layer != layer || !piece.live) continue;
      struct Beneath {
        std::uint32_t node = 0;
        Triangle face{};
        Vec3 above;
      };
      std::vector<Beneath> beneath;
      bool through = false;
      for (std::uint32_t k = 0; k < piece.lattice->nodes.size(); ++k) {
        const std::uint32_t node = piece.firstNode + k;
        const auto above = nearOuter.nearest(x[node], kBeneath);
        if (!above || !(above->distance > 0)) continue;
        beneath.push_back({node, outer.faces[above->place.face], above->point});
        const auto hit = nearInner.first(above->point, (x[node] - above->point) * (1 / above->distance));
        through = through || (hit && hit->along < above->distance);
      }
      if (!through) continue;
      if (gaps.empty()) gaps = gapsBetween(outer, nearOuter, inner, nearInner);
      for (const Beneath& its : beneath) {
        const double gap = std::min({gaps[its.face[0]], gaps[its.face[1]], gaps[its.face[2]]});
        const Vec3 way = x[its.node] - its.above;
        const double most = kShare * gap;
        if (length(way) > most) x[its.node] = its.above + way * (most / length(way));
      }
      laid = true;
    }
  }
  return laid;
}

}  // namespace karinui
