#include "cloth/border_bending.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

constexpr double kLeastSingular = 0.05;  // of the largest singular value: curvatures below it are left out
constexpr std::size_t kEnough = 6;       // nodes to fit a quadratic to,
constexpr std::size_t kEdge = 9;         // and on the piece's edge
constexpr double kLeastArea = 0.25;      // cells: a smaller region joins its neighbour,
constexpr double kLeastRing = 0.1;       // and one with less of the ring

QuadraticFit fitAround(const Lattice& lattice, const std::vector<std::vector<std::uint32_t>>& near,
                       std::uint32_t centre, std::size_t enough) {
  QuadraticFit fit;
  std::vector<std::uint32_t>& nodes = fit.nodes;
  nodes = {centre};
  const double h = lattice.spacing;
  for (int ring = 0; ring < 3; ++ring) {
    std::vector<std::uint32_t> wider = nodes;
    for (std::uint32_t k : nodes) wider.insert(wider.end(), near[k].begin(), near[k].end());
    sortOnce(wider);
    nodes = std::move(wider);
    if (nodes.size() < enough && ring < 2) continue;
    const auto n = static_cast<Eigen::Index>(nodes.size());
    if (n < 4) continue;
    Eigen::MatrixXd linear(n, 3), square(n, 3);
    Eigen::VectorXd root(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Flat d = (lattice.nodes[nodes[k]] - lattice.nodes[centre]) * (1 / h);
      const double u = dot(d, lattice.weft), v = dot(d, lattice.warp);
      root[k] = 1 / ((0.25 + u * u + v * v) * (0.25 + u * u + v * v));
      linear.row(k) << root[k], root[k] * u, root[k] * v;
      square.row(k) << root[k] * u * u / 2, root[k] * u * v, root[k] * v * v / 2;
    }
    // The quadratic is fitted in the orthogonal complement of constant and linear fields, so that its curvatures do not
    // depend on them however the nodes lie.
    Eigen::MatrixXd linearBasis(n, 0);
    for (Eigen::Index c = 0; c < 3; ++c) {
      Eigen::VectorXd v = linear.col(c);
      for (int again = 0; again < 2; ++again) v -= linearBasis * (linearBasis.transpose() * v);
      if (v.norm() < 1e-6 * linear.col(c).norm() || !(v.norm() > 0)) continue;
      linearBasis.conservativeResize(Eigen::NoChange, linearBasis.cols() + 1);
      linearBasis.col(linearBasis.cols() - 1) = v.normalized();
    }
    const Eigen::MatrixXd complement = Eigen::MatrixXd::Identity(n, n) - linearBasis * linearBasis.transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(complement * square, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd singular = svd.singularValues();
    if (ring < 2 && (singular.size() < 3 || singular[2] < kLeastSingular * singular[0])) continue;
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(3, n), kept = complement;
    for (Eigen::Index s = 0; s < singular.size(); ++s) {
      if (singular[s] < kLeastSingular * singular[0] || singular[s] < 1e-9) continue;
      inverse += svd.matrixV().col(s) * svd.matrixU().col(s).transpose() / singular[s];
      kept -= svd.matrixU().col(s) * svd.matrixU().col(s).transpose();
    }
    const Eigen::MatrixXd bent = inverse * complement * root.asDiagonal();
    fit.curvature = bent / (h * h);
    const Eigen::MatrixXd straight = linear.completeOrthogonalDecomposition().pseudoInverse();
    fit.slope = (straight.bottomRows(2) * (Eigen::MatrixXd(root.asDiagonal()) - square * bent)) / h;
    const Eigen::MatrixXd rest = kept * root.asDiagonal();
    fit.leftover = rest.transpose() * rest / (root.squaredNorm() * h * h * h * h);
    return fit;
  }
  // Three nodes or fewer: nothing bends.
  const auto n = static_cast<Eigen::Index>(nodes.size());
  fit.slope = Eigen::MatrixXd::Zero(2, n);
  fit.curvature = Eigen::MatrixXd::Zero(3, n);
  fit.leftover = Eigen::MatrixXd::Zero(n, n);
  return fit;
}

struct Weight {  // of one node's position in the slopes along weft and warp
  std::uint32_t node = 0;
  double u = 0, v = 0;
};
using Slope = std::vector<Weight>;
using Side = std::array<std::uint32_t, 2>;  // from node to node; what it bounds lies on its left
enum class Terms { All, Bends, Twist };     // of the curvature: Bends are k_uu and k_vv, Twist is k_uv

class Regions {
 public:
  Regions(const Lattice& lattice, const LatticeAreas& areas, const std::vector<QuadraticFit>& fits)
      : lattice_(lattice), areas_(areas), fits_(fits), sums_(lattice.nodes.size()) {
    for (std::uint32_t k : lattice.grid)
      if (k != kNoNode) gridNodes_ = std::max(gridNodes_, k + 1);
    for (const auto& c : areas.corners)
      for (const Side side : {Side{c[0], c[1]}, {c[1], c[3]}, {c[3], c[2]}, {c[2], c[0]}}) ofCells_.push_back(side);
    for (std::uint32_t f : areas.ringFaces)
      for (int c = 0; c < 3; ++c) ofRing_.push_back({lattice.faces[f][c], lattice.faces[f][(c + 1) % 3]});
    std::sort(ofCells_.begin(), ofCells_.end());
    std::sort(ofRing_.begin(), ofRing_.end());
    for (const auto& c : areas.corners) divideCell(c);
    for (const Side& side : ofCells_)
      if (!has(ofCells_, side[1], side[0]) && !has(ofRing_, side[1], side[0])) addEdge(side);
    for (std::uint32_t f : areas.ringFaces) divideFace(lattice.faces[f]);
    for (const Side& side : ofRing_)
      if (has(ofCells_, side[1], side[0])) addInterface(side);
  }

  struct Sum {  // of a region: its curvature times its area
    std::uint32_t node = 0;
    double uu = 0, uv = 0, vv = 0;
  };
  const std::vector<Sum>& of(std::uint32_t node) const { return sums_[node]; }

 private:
  static bool has(const std::vector<Side>& sides, std::uint32_t from, std::uint32_t to) {
    return std::binary_search(sides.begin(), sides.end(), Side{from, to});
  }
  bool onBorder(std::uint32_t node) const { return areas_.stencil[node][0] == kNoNode; }
  Flat place(std::uint32_t node) const { return lattice_.nodes[node]; }

  Slope slopeFrom(std::uint32_t node, Flat at, double share = 1) const {
    const QuadraticFit& fit = fits_[node];
    const double u = dot(at - place(node), lattice_.weft), v = dot(at - place(node), lattice_.warp);
    Slope slope;
    for (Eigen::Index k = 0; k < fit.slope.cols(); ++k) {
      const double along = fit.slope(0, k) + u * fit.curvature(0, k) + v * fit.curvature(1, k);
      const double up = fit.slope(1, k) + u * fit.curvature(1, k) + v * fit.curvature(2, k);
      slope.push_back({fit.nodes[static_cast<std::size_t>(k)], share * along, share * up});
    }
    return slope;
  }

  // `out`: across the stretch of outline, as long as it is, out of the node's region.
  void add(std::uint32_t node, Flat out, const Slope& slope, Terms terms) {
    const double u = dot(out, lattice_.weft), v = dot(out, lattice_.warp);
    for (const Weight& w : slope) {
      Sum sum{w.node, 0, 0, 0};
      if (terms != Terms::Twist) sum.uu = u * w.u, sum.vv = v * w.v;
      if (terms != Terms::Bends) sum.uv = 0.5 * (u * w.v + v * w.u);
      sums_[node].push_back(sum);
    }
  }

  // Between the corners of a whole cell. Along a thread from a node with a stencil the slope is the lattice's;
  // elsewhere it is the cell's, a quarter of a spacing further in.
  void divideCell(const std::array<std::uint32_t, 4>& c) {
    const double h = lattice_.spacing, twist = 1 / (4 * h);
    for (const auto& [a, b, towards] : {std::array<int, 3>{0, 1, 1}, {2, 3, -1}, {0, 2, 1}, {1, 3, -1}}) {
      const std::uint32_t from = c[a], to = c[b];
      if (!onBorder(from) && !onBorder(to)) continue;
      const bool weft = b == a + 1;
      Slope slope{{from, -1 / h, 0}, {to, 1 / h, 0}};
      if (onBorder(from) && onBorder(to))
        for (int k = 0; k < 4; ++k) slope.push_back({c[k], (k == 0 || k == 3 ? 1 : -1) * towards * twist, 0});
      if (!weft)
        for (Weight& w : slope) std::swap(w.u, w.v);
      const Flat out = (weft ? lattice_.weft : lattice_.warp) * (0.5 * h);
      if (onBorder(from)) add(from, out, slope, Terms::Bends);
      if (onBorder(to)) add(to, -out, slope, Terms::Bends);
    }
  }

  // The mean of the fits around a face's corners on the grid, which have neighbours on all sides; few serve many faces.
  Slope slopeInFace(const Triangle& face, Flat at) const {
    int onGrid = 0;
    for (std::uint32_t k : face) onGrid += k < gridNodes_ ? 1 : 0;
    Slope slope;
    for (std::uint32_t k : face)
      if (onGrid == 0 || k < gridNodes_) {
        const Slope more = slopeFrom(k, at, 1.0 / (onGrid == 0 ? 3 : onGrid));
        slope.insert(slope.end(), more.begin(), more.end());
      }
    return slope;
  }

  // From the middle of a face to the middles of its sides.
  void divideFace(const Triangle& face) {
    const Flat middle = (place(face[0]) + place(face[1]) + place(face[2])) * (1.0 / 3);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t from = face[c], to = face[(c + 1) % 3];
      const Flat half = (place(from) + place(to)) * 0.5, out = leftOf(half - middle);
      const Slope slope = slopeInFace(face, (half + middle) * 0.5);
      add(from, out, slope, Terms::All);
      add(to, -out, slope, Terms::All);
      if (has(ofCells_, to, from) || has(ofRing_, to, from)) continue;
      const Flat run = place(to) - place(from);  // the piece's edge
      for (const std::uint32_t end : {from, to})
        add(end, -leftOf(run) * 0.5, slopeInFace(face, place(from) + run * (end == from ? 0.25 : 0.75)), Terms::All);
    }
  }

  // Where the ring meets a whole cell the slope along the side is the cell's; the bends' regions reach into the cell.
  void addInterface(Side side) {
    const Flat run = place(side[1]) - place(side[0]);
    const double length = karinui::length(run);
    const bool weft = std::fabs(dot(run, lattice_.weft)) > std::fabs(dot(run, lattice_.warp));
    const double sign = dot(run, weft ? lattice_.weft : lattice_.warp) > 0 ? 1 : -1;
    Slope even{{side[0], -sign / length, 0}, {side[1], sign / length, 0}}, change;
    for (const std::uint32_t node : side) {
      const QuadraticFit& fit = fits_[node];
      for (Eigen::Index k = 0; k < fit.curvature.cols(); ++k)
        change.push_back(
            {fit.nodes[static_cast<std::size_t>(k)], 0.5 * fit.curvature(weft ? 0 : 2, k) * sign * length / 4, 0});
    }
    for (const int end : {0, 1}) {
      Slope slope = even;
      for (const Weight& w : change) slope.push_back({w.node, end == 0 ? -w.u : w.u, 0});
      if (!weft)
        for (Weight& w : slope) std::swap(w.u, w.v);
      add(side[end], -leftOf(run) * 0.5, slope, Terms::Twist);
    }
  }

  // The edge of a piece that has no ring.
  void addEdge(Side side) {
    const Flat run = place(side[1]) - place(side[0]);
    for (const int end : {0, 1})
      add(side[end], -leftOf(run) * 0.5, slopeFrom(side[end], place(side[end]) + run * (end == 0 ? 0.25 : -0.25)),
          Terms::Bends);
  }

  const Lattice& lattice_;
  const LatticeAreas& areas_;
  const std::vector<QuadraticFit>& fits_;
  std::uint32_t gridNodes_ = 0;  // nodes on the grid come first
  std::vector<Side> ofCells_, ofRing_;
  std::vector<std::vector<Sum>> sums_;  // per node
};

// The representative of each node: regions too small to have a curvature of their own join the largest beside them.
std::vector<std::uint32_t> mergedRegions(const Lattice& lattice, const LatticeAreas& areas,
                                         const std::vector<std::vector<std::uint32_t>>& near,
                                         const std::vector<std::uint8_t>& held) {
  const std::size_t count = lattice.nodes.size();
  const double square = lattice.spacing * lattice.spacing;
  std::vector<std::uint32_t> representative(count);
  std::vector<double> area(count), ring = areas.ring;
  for (std::uint32_t k = 0; k < count; ++k) {
    representative[k] = k;
    area[k] = areas.cell[k] + areas.ring[k];
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    if (areas.stencil[k][0] != kNoNode) continue;
    const std::uint32_t own = representative[k];
    if (area[own] >= kLeastArea * square && (ring[own] <= 0 || ring[own] >= kLeastRing * square)) continue;
    std::uint32_t best = kNoNode;
    for (std::uint32_t other : near[k]) {
      const std::uint32_t its = representative[other];
      if (its == own || areas.stencil[other][0] != kNoNode || (held[other] != 0) != (held[k] != 0)) continue;
      if (best == kNoNode || area[its] > area[best]) best = its;
    }
    if (best == kNoNode) continue;
    for (std::uint32_t& s : representative)
      if (s == own) s = best;
    area[best] += area[own];
    ring[best] += ring[own];
  }
  return representative;
}

}  // namespace

BorderBending borderBending(const Lattice& lattice, const LatticeAreas& areas,
                            const std::vector<std::vector<std::uint32_t>>& near,
                            const std::vector<std::uint8_t>& held) {
  const auto count = static_cast<std::uint32_t>(lattice.nodes.size());
  BorderBending border;
  border.fits.resize(count);
  std::vector<std::size_t> enough(count, kEnough);
  for (std::uint32_t k : lattice.border) enough[k] = kEdge;
  for (const auto& hole : lattice.holes)
    for (std::uint32_t k : hole) enough[k] = kEdge;
  for (std::uint32_t k = 0; k < count; ++k)
    if (areas.stencil[k][0] == kNoNode) border.fits[k] = fitAround(lattice, near, k, enough[k]);
  const Regions regions(lattice, areas, border.fits);
  const std::vector<std::uint32_t> representative = mergedRegions(lattice, areas, near, held);
  std::vector<std::uint32_t> numberOf(count, kNoNode);
  std::vector<std::vector<Regions::Sum>> sums;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (areas.stencil[k][0] != kNoNode) continue;
    std::uint32_t& number = numberOf[representative[k]];
    if (number == kNoNode) {
      number = static_cast<std::uint32_t>(border.regions.size());
      border.regions.emplace_back();
      sums.emplace_back();
    }
    BendRegion& region = border.regions[number];
    region.members.push_back(k);
    region.area += areas.cell[k] + areas.ring[k];
    region.ring += areas.ring[k];
    sums[number].insert(sums[number].end(), regions.of(k).begin(), regions.of(k).end());
  }
  for (std::size_t r = 0; r < sums.size(); ++r) {
    BendRegion& region = border.regions[r];
    std::stable_sort(sums[r].begin(), sums[r].end(), [](const auto& a, const auto& b) { return a.node < b.node; });
    for (const auto& sum : sums[r])
      if (region.nodes.empty() || region.nodes.back() != sum.node) region.nodes.push_back(sum.node);
    region.rows.setZero(3, static_cast<Eigen::Index>(region.nodes.size()));
    Eigen::Index at = 0;
    for (const auto& sum : sums[r]) {
      while (region.nodes[static_cast<std::size_t>(at)] != sum.node) ++at;
      region.rows.col(at) += Eigen::Vector3d(sum.uu, sum.uv, sum.vv);
    }
    region.rows.row(0) *= region.area > 0 ? 1 / region.area : 0;
    region.rows.row(1) *= region.ring > 0 ? 1 / region.ring : 0;
    region.rows.row(2) *= region.area > 0 ? 1 / region.area : 0;
  }
  return border;
}

}  // namespace karinui
