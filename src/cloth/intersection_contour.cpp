#include "cloth/intersection_contour.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "karinui/base/sort_once.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/triangle_intersection.h"

namespace karinui {
namespace {

constexpr double kMostCells = 1e6;
constexpr std::size_t kCells = 1024;  // a worker takes at once

Vec3 normalOf(const TriangleMesh& mesh, const Triangle& f) {
  return normalized(cross(mesh.points[f[1]] - mesh.points[f[0]], mesh.points[f[2]] - mesh.points[f[0]]));
}

// Faces in the cells of a grid. Two whose boxes overlap are reported once, in the cell where the overlap begins.
class FaceGrid {
 public:
  explicit FaceGrid(const TriangleMesh& mesh) : boxes_(mesh.faces.size()) {
    Box all;
    double sides = 0;
    for (std::size_t f = 0; f < boxes_.size(); ++f) {
      for (NodeIndex k : mesh.faces[f]) boxes_[f].include(mesh.points[k]);
      all.include(boxes_[f].low);
      all.include(boxes_[f].high);
      const Vec3 size = boxes_[f].high - boxes_[f].low;
      sides += std::fmax(size.x, std::fmax(size.y, size.z));
    }
    const Vec3 whole = all.high - all.low;
    const double usual = 1.5 * sides / static_cast<double>(boxes_.size());
    low_ = all.low;
    cell_ = std::fmax(usual, std::cbrt((whole.x + usual) * (whole.y + usual) * (whole.z + usual) / kMostCells));
    last_ = at(all.high);
    start_.assign(number(last_) + 2, 0);
    for (const Box& box : boxes_) eachCell(box, [&](std::size_t c) { ++start_[c + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    face_.resize(start_.back());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t f = 0; f < boxes_.size(); ++f) eachCell(boxes_[f], [&](std::size_t c) { face_[next[c]++] = f; });
  }

  std::size_t cells() const { return start_.size() - 1; }
  template <class Report>
  void forTouchingFaces(std::size_t cell, const Report& report) const {
    for (std::uint32_t m = start_[cell]; m < start_[cell + 1]; ++m)
      for (std::uint32_t n = m + 1; n < start_[cell + 1]; ++n) {
        const Box &a = boxes_[face_[m]], &b = boxes_[face_[n]];
        const Vec3 low{std::fmax(a.low.x, b.low.x), std::fmax(a.low.y, b.low.y), std::fmax(a.low.z, b.low.z)};
        if (low.x > std::fmin(a.high.x, b.high.x) || low.y > std::fmin(a.high.y, b.high.y) ||
            low.z > std::fmin(a.high.z, b.high.z))
          continue;
        if (number(at(low)) == cell) report(face_[m], face_[n]);
      }
  }

 private:
  using Cell = std::array<std::uint32_t, 3>;
  Cell at(Vec3 p) const {
    return {static_cast<std::uint32_t>((p.x - low_.x) / cell_), static_cast<std::uint32_t>((p.y - low_.y) / cell_),
            static_cast<std::uint32_t>((p.z - low_.z) / cell_)};
  }
  std::size_t number(const Cell& c) const {
    return (std::size_t{c[2]} * (last_[1] + 1) + c[1]) * (last_[0] + 1) + c[0];
  }
  template <class Use>
  void eachCell(const Box& box, const Use& use) const {
    const Cell low = at(box.low), high = at(box.high);
    for (std::uint32_t k = low[2]; k <= high[2]; ++k)
      for (std::uint32_t j = low[1]; j <= high[1]; ++j)
        for (std::uint32_t i = low[0]; i <= high[0]; ++i) use(number({i, j, k}));
  }

  std::vector<Box> boxes_;
  Vec3 low_;
  double cell_ = 1;
  Cell last_{};
  std::vector<std::uint32_t> start_, face_;
};

}  // namespace

IntersectionContour::IntersectionContour(const Cloth& cloth)
    : group_(cloth.nodeCount), near_(cloth.nodeCount, 0), direction_(cloth.nodeCount) {
  std::iota(group_.begin(), group_.end(), 0);
  const auto root = [&](std::uint32_t k) {
    while (group_[k] != k) k = group_[k] = group_[group_[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    group_[root(tie.b)] = root(tie.a);
    if (tie.c != kNoNode) group_[root(tie.c)] = root(tie.a);
  }
  for (std::uint32_t k = 0; k < group_.size(); ++k) group_[k] = root(k);

  std::unordered_map<std::uint64_t, std::uint32_t> known;  // by both nodes
  std::size_t faces = 0;
  for (const ClothPiece& piece : cloth.pieces) faces += piece.lattice->faces.size();
  known.reserve(2 * faces);
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces) {
      const Triangle face{piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]};
      const auto number = static_cast<std::uint32_t>(mesh_.faces.size());
      std::array<std::uint32_t, 3> around{};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(face[c], face[(c + 1) % 3]);
        const auto [at, isNew] =
            known.try_emplace(std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(edges_.size()));
        if (isNew)
          edges_.push_back({{low, high}, {number, kNoNode}});
        else
          edges_[at->second].face[1] = number;
        around[c] = at->second;
      }
      mesh_.faces.push_back(face);
      live_.push_back(piece.live);
      edgeOf_.push_back(around);
    }
}

void IntersectionContour::find(std::span<const Vec3> x, Workers& workers) {
  mesh_.points.assign(x.begin(), x.end());
  std::fill(near_.begin(), near_.end(), 0);
  std::fill(direction_.begin(), direction_.end(), Vec3{});
  crossings_ = 0;
  if (mesh_.faces.empty()) return;
  using Pierced = std::pair<std::uint32_t, std::uint32_t>;  // edge and face
  const auto test = [&](std::uint32_t f, std::uint32_t g, std::vector<Pierced>& pierced) {
    const Triangle& face = mesh_.faces[g];
    const std::array<NanoPoint, 3> corners{toNano(x[face[0]]), toNano(x[face[1]]), toNano(x[face[2]])};
    for (const std::uint32_t e : edgeOf_[f])
      if (segmentCrossesTriangle(toNano(x[edges_[e].node[0]]), toNano(x[edges_[e].node[1]]), corners))
        pierced.emplace_back(e, g);
  };
  const auto sewn = [&](std::uint32_t f, std::uint32_t g) {
    for (NodeIndex a : mesh_.faces[f])
      for (NodeIndex b : mesh_.faces[g])
        if (group_[a] == group_[b]) return true;
    return false;
  };
  const FaceGrid grid(mesh_);
  std::vector<std::vector<Pierced>> parts((grid.cells() + kCells - 1) / kCells);
  workers.forBlocks(grid.cells(), kCells, [&](std::size_t begin, std::size_t end) {
    auto& out = parts[begin / kCells];
    for (std::size_t cell = begin; cell < end; ++cell)
      grid.forTouchingFaces(cell, [&](std::uint32_t f, std::uint32_t g) {
        if ((!live_[f] && !live_[g]) || sewn(f, g)) return;
        test(f, g, out);
        test(g, f, out);
      });
  });
  std::vector<Pierced> pierced;
  for (const auto& part : parts) pierced.insert(pierced.end(), part.begin(), part.end());
  sortOnce(pierced);
  crossings_ = pierced.size();
  if (pierced.empty()) return;

  for (const auto& [e, g] : pierced) {
    addShortening(x, edges_[e], g);
    for (NodeIndex k : mesh_.faces[g]) near_[k] = 1;
    for (const std::uint32_t f : edges_[e].face)
      if (f != kNoNode)
        for (NodeIndex k : mesh_.faces[f]) near_[k] = 1;
  }
  for (Vec3& way : direction_)
    if (const double far = length(way); far > 1) way = way * (1 / far);
  const std::vector<std::uint8_t> concerned = near_;
  for (const Triangle& face : mesh_.faces)
    if (concerned[face[0]] || concerned[face[1]] || concerned[face[2]])
      for (NodeIndex k : face) near_[k] = 1;
}

// Where the edge (unit direction e) moves by d against the face (normal n), the point where it passes through moves by
// d - e (d.n)/(e.n) in the face's plane. The contour leaves that point along r in each face beside the edge and so
// grows by -r times that move.
void IntersectionContour::addShortening(std::span<const Vec3> x, const Edge& edge, std::uint32_t face) {
  const Vec3 along = normalized(x[edge.node[1]] - x[edge.node[0]]);
  const Vec3 n = normalOf(mesh_, mesh_.faces[face]);
  const double steep = dot(along, n);
  if (std::fabs(steep) < 1e-6) return;
  Vec3 way;
  for (const std::uint32_t beside : edge.face) {
    if (beside == kNoNode) continue;
    const Triangle& f = mesh_.faces[beside];
    Vec3 r = normalized(cross(n, normalOf(mesh_, f)));
    Vec3 inward;
    for (NodeIndex k : f)
      if (k != edge.node[0] && k != edge.node[1]) inward = x[k] - x[edge.node[0]];
    inward = inward - along * dot(inward, along);
    if (dot(r, inward) < 0) r = -r;
    way += r - n * (dot(along, r) / steep);
  }
  way = way * (1 / std::sqrt(1 + squaredLength(way)));
  for (NodeIndex k : edge.node) direction_[k] += way;
  for (NodeIndex k : mesh_.faces[face]) direction_[k] -= way;
}

}  // namespace karinui
