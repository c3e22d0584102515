#include "cloth/bending.h"

#include <Eigen/Dense>
#include <algorithm>

#include "cloth/by_row.h"
#include "cloth/lattice_shares.h"

namespace karinui {
namespace {

constexpr double kLeftover = 1.0;   // strength of what a border's quadratic leaves over
constexpr double kSeen = 0.05;      // a curvature the nodes around hardly show is not asked for
constexpr std::size_t kEnough = 9;  // nodes for a border's quadratic

using Entry = NodeWeight;

// Adds c (sum w x)^2 / 2.
void addTerm(std::vector<Entry>& entries, const std::vector<NodeIndex>& nodes, const double* w, double c) {
  if (!(c > 0)) return;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < nodes.size(); ++b)
      if (w[a] != 0 && w[b] != 0) entries.push_back({nodes[a], nodes[b], c * w[a] * w[b]});
}

struct Fit {
  std::vector<std::uint32_t> nodes;  // of the lattice
  Eigen::MatrixXd curvature;         // 3 x n: k_uu, k_uv, k_vv from the nodes' places
  Eigen::MatrixXd leftover;          // n x n: squared, weighted, in 1/m4
};

Fit fitAround(const Lattice& lattice, const std::vector<std::vector<std::uint32_t>>& near, std::uint32_t centre) {
  Fit fit;
  std::vector<std::uint32_t>& nodes = fit.nodes;
  nodes = {centre};
  const double h = lattice.spacing;
  for (int ring = 0; ring < 3; ++ring) {
    std::vector<std::uint32_t> wider = nodes;
    for (std::uint32_t k : nodes) wider.insert(wider.end(), near[k].begin(), near[k].end());
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    nodes = std::move(wider);
    if (nodes.size() < kEnough && ring < 2) continue;
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
    // Taken off every column: what constant and linear fields could explain. The quadratic is fitted in the rest alone,
    // so its curvatures are blind to them however the nodes lie.
    Eigen::MatrixXd plain(n, 0);
    for (Eigen::Index c = 0; c < 3; ++c) {
      Eigen::VectorXd v = linear.col(c);
      for (int again = 0; again < 2; ++again) v -= plain * (plain.transpose() * v);
      if (v.norm() < 1e-6 * linear.col(c).norm() || !(v.norm() > 0)) continue;
      plain.conservativeResize(Eigen::NoChange, plain.cols() + 1);
      plain.col(plain.cols() - 1) = v.normalized();
    }
    const Eigen::MatrixXd blind = Eigen::MatrixXd::Identity(n, n) - plain * plain.transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(blind * square, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd seen = svd.singularValues();
    if (ring < 2 && (seen.size() < 3 || seen[2] < kSeen * seen[0])) continue;
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(3, n), kept = blind;
    for (Eigen::Index s = 0; s < seen.size(); ++s) {
      if (seen[s] < kSeen * seen[0] || seen[s] < 1e-9) continue;
      inverse += svd.matrixV().col(s) * svd.matrixU().col(s).transpose() / seen[s];
      kept -= svd.matrixU().col(s) * svd.matrixU().col(s).transpose();
    }
    fit.curvature = inverse * blind * root.asDiagonal() / (h * h);
    const Eigen::MatrixXd rest = kept * root.asDiagonal();
    fit.leftover = rest.transpose() * rest / (root.squaredNorm() * h * h * h * h);
    return fit;
  }
  // Three nodes or fewer: nothing can bend.
  const auto n = static_cast<Eigen::Index>(nodes.size());
  fit.curvature = Eigen::MatrixXd::Zero(3, n);
  fit.leftover = Eigen::MatrixXd::Zero(n, n);
  return fit;
}

// Fills `inside` with the grid's terms and `border` with the others'.
void addPiece(const ClothPiece& piece, const std::vector<std::uint8_t>& held, const PanelPlan& plan,
              std::vector<Entry>& inside, std::vector<Entry>& border, PanelBending& panels) {
  const Lattice& lattice = *piece.lattice;
  const double bu = piece.fabric.bendWeft, bv = piece.fabric.bendWarp, twist = std::sqrt(bu * bv);
  const double h = lattice.spacing, perSquare = 1 / (h * h);
  const LatticeShares shares = sharesOf(lattice);
  const auto near = neighboursOf(lattice.nodes.size(), lattice.faces);
  const auto node = [&](std::uint32_t k) { return piece.firstNode + k; };
  const auto isHeld = [&](std::uint32_t k) { return held[node(k)] != 0; };
  const auto clamp = [&](std::uint32_t left, std::uint32_t k, std::uint32_t right) {
    return isHeld(k) && isHeld(left) != isHeld(right) ? 2.0 : 1.0;
  };
  const double second[] = {perSquare, -2 * perSquare, perSquare};
  const double mixed[] = {perSquare, -perSquare, -perSquare, perSquare};
  for (const auto& c : shares.corners) {
    // Three corners held: the clamp runs across the cell, and only the half with the free corner twists, twice as much.
    const bool halved = isHeld(c[0]) + isHeld(c[1]) + isHeld(c[2]) + isHeld(c[3]) == 3;
    const double strength = 2 * twist * h * h * (halved ? 2 : 1);
    addTerm(inside, {node(c[0]), node(c[1]), node(c[2]), node(c[3])}, mixed, strength);
    panels.twist[plan.slotOf[node(c[0])]] = static_cast<float>(strength * perSquare * perSquare);
  }
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const auto& x = shares.cross[k];
    const double area = shares.cell[k] + shares.ring[k];
    if (x[0] != kNoNode) {
      const double weft = bu * area * clamp(x[0], k, x[1]), warp = bv * area * clamp(x[2], k, x[3]);
      addTerm(inside, {node(x[0]), node(k), node(x[1])}, second, weft);
      addTerm(inside, {node(x[2]), node(k), node(x[3])}, second, warp);
      panels.weft[plan.slotOf[node(k)]] = static_cast<float>(weft * perSquare * perSquare);
      panels.warp[plan.slotOf[node(k)]] = static_cast<float>(warp * perSquare * perSquare);
      continue;
    }
    const Fit fit = fitAround(lattice, near, k);
    std::size_t heldNear = 0;
    for (std::uint32_t other : near[k]) heldNear += isHeld(other) ? 1 : 0;
    const double twice = isHeld(k) && heldNear > 0 && heldNear < near[k].size() ? 2.0 : 1.0;
    std::vector<NodeIndex> nodes;
    for (std::uint32_t other : fit.nodes) nodes.push_back(node(other));
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows = fit.curvature;
    const auto n = rows.cols();
    addTerm(border, nodes, rows.data(), bu * area * twice);
    addTerm(border, nodes, rows.data() + n, 2 * twist * shares.ring[k] * twice);
    addTerm(border, nodes, rows.data() + 2 * n, bv * area * twice);
    const double leftover = kLeftover * 0.5 * (bu + bv) * area;
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b) border.push_back({nodes[a], nodes[b], leftover * fit.leftover(a, b)});
  }
}

}  // namespace

Bending::Bending(const Cloth& cloth, const std::vector<std::uint8_t>& held, const PanelPlan& plan)
    : panels_(plan.slots) {
  std::vector<Entry> entries;
  entries.reserve(40 * std::size_t{cloth.nodeCount});
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live && piece.fabric.law == Fabric::Law::Woven &&
        (piece.fabric.bendWarp > 0 || piece.fabric.bendWeft > 0))
      addPiece(piece, held, plan, entries, rest_, panels_);
  entries.insert(entries.end(), rest_.begin(), rest_.end());
  sortByRow(
      entries, cloth.nodeCount, [](const Entry& e) { return e.row; }, [](const Entry& e) { return e.column; });
  start_.push_back(0);
  for (std::size_t e = 0; e < entries.size(); ++e) {
    if (e == 0 || entries[e].row != entries[e - 1].row) {
      if (e > 0) start_.push_back(static_cast<std::uint32_t>(column_.size()));
      node_.push_back(entries[e].row);
    } else if (entries[e].column == column_.back()) {
      weight_.back() += entries[e].weight;
      continue;
    }
    column_.push_back(entries[e].column);
    weight_.push_back(entries[e].weight);
  }
  if (!node_.empty()) start_.push_back(static_cast<std::uint32_t>(column_.size()));
}

Vec3 Bending::rowTimes(std::size_t row, std::span<const Vec3> x) const {
  // Rows sum to nothing, so places may be taken from the row's own node: no rounding from how far away the cloth is.
  const Vec3 here = x[node_[row]];
  Vec3 sum;
  for (std::uint32_t c = start_[row]; c < start_[row + 1]; ++c) sum += (x[column_[c]] - here) * weight_[c];
  return sum;
}

double Bending::value(std::span<const Vec3> x, Workers& workers) const {
  return workers.sum(node_.size(), 512, [&](std::size_t begin, std::size_t end) {
    double total = 0;
    for (std::size_t r = begin; r < end; ++r) total += 0.5 * dot(x[node_[r]], rowTimes(r, x));
    return total;
  });
}

void Bending::addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const {
  workers.forBlocks(node_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) gradient[node_[r]] += rowTimes(r, x);
  });
}

}  // namespace karinui
