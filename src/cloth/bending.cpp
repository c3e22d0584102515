#include "cloth/bending.h"

#include <algorithm>
#include <array>

#include "cloth/border_bending.h"

namespace karinui {
namespace {

constexpr double kLeftover = 1.0;  // strength of what a border's quadratic leaves over

// Of each node's area, what can bend: between held nodes nothing does. A clamp runs through the held nodes beside free
// ones, so that the curvature is that of a part of their surroundings only; the part is weighted as the whole.
std::vector<double> bendingShares(const Lattice& lattice, const LatticeAreas& areas,
                                  const std::vector<std::uint8_t>& held) {
  std::vector<double> bends(lattice.nodes.size(), 0);
  const double quarter = lattice.spacing * lattice.spacing / 4;
  for (const auto& c : areas.corners) {
    const int fixed = held[c[0]] + held[c[1]] + held[c[2]] + held[c[3]];
    for (std::uint32_t k : c) bends[k] += quarter * (fixed == 4 ? 0 : fixed == 3 ? 0.5 : 1);
  }
  for (std::uint32_t f : areas.ringFaces) {
    const Triangle& face = lattice.faces[f];
    const Flat a = lattice.nodes[face[0]];
    const double third = cross(lattice.nodes[face[1]] - a, lattice.nodes[face[2]] - a) / 6;
    if (!held[face[0]] || !held[face[1]] || !held[face[2]])
      for (std::uint32_t k : face) bends[k] += third;
  }
  return bends;
}

// Of a piece: the terms on the grid, and the others.
struct PieceBending {
  explicit PieceBending(std::size_t nodes) : inside(nodes), border(nodes) {}
  QuadraticForm inside, border;
};

PieceBending bendingOf(const ClothPiece& piece, const std::vector<std::uint8_t>& held, const GridLayout& layout,
                       GridBending& grid) {
  const Lattice& lattice = *piece.lattice;
  PieceBending bending(lattice.nodes.size());
  const double bu = piece.fabric.bendWeft, bv = piece.fabric.bendWarp, twist = std::sqrt(bu * bv);
  const double h = lattice.spacing, perSquare = 1 / (h * h);
  const LatticeAreas areas = latticeAreas(lattice);
  const auto near = neighboursOf(lattice.nodes.size(), lattice.faces);
  const auto node = [&](std::uint32_t k) { return piece.firstNode + k; };
  const auto isHeld = [&](std::uint32_t k) { return held[node(k)] != 0; };
  const double second[] = {perSquare, -2 * perSquare, perSquare};
  const double mixed[] = {perSquare, -perSquare, -perSquare, perSquare};
  for (const auto& c : areas.corners) {
    // Three corners held: the clamp runs across the cell, and only the half with the free corner twists, twice as much.
    const bool halved = isHeld(c[0]) + isHeld(c[1]) + isHeld(c[2]) + isHeld(c[3]) == 3;
    const double strength = 2 * twist * h * h * (halved ? 2 : 1);
    bending.inside.addSquare(c, mixed, strength);
    grid.twist[layout.slotOf[node(c[0])]] = static_cast<float>(strength * perSquare * perSquare);
  }
  std::vector<std::uint8_t> fixed(lattice.nodes.size());
  for (std::uint32_t k = 0; k < fixed.size(); ++k) fixed[k] = held[node(k)];
  const std::vector<double> bends = bendingShares(lattice, areas, fixed);
  const BorderBending around = borderBending(lattice, areas, near, fixed);
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const auto& x = areas.stencil[k];
    const double area = areas.cell[k] + areas.ring[k];
    if (x[0] == kNoNode) {
      const QuadraticFit& fit = around.fits[k];
      const double strength = kLeftover * 0.5 * (bu + bv) * area;
      bending.border.addBlock(fit.nodes, fit.leftover.data(), strength);
      continue;
    }
    const double times = bends[k] > 0 ? area / bends[k] : 1, weft = bu * area * times, warp = bv * area * times;
    bending.inside.addSquare(std::array{x[0], k, x[1]}, second, weft);
    bending.inside.addSquare(std::array{x[2], k, x[3]}, second, warp);
    grid.weft[layout.slotOf[node(k)]] = static_cast<float>(weft * perSquare * perSquare);
    grid.warp[layout.slotOf[node(k)]] = static_cast<float>(warp * perSquare * perSquare);
  }
  for (const BendRegion& region : around.regions) {
    double bent = 0;
    for (std::uint32_t k : region.members) bent += bends[k];
    const double times = bent > 0 ? region.area / bent : 1;
    const auto n = region.rows.cols();
    bending.border.addSquare(region.nodes, region.rows.data(), bu * region.area * times);
    bending.border.addSquare(region.nodes, region.rows.data() + n, 2 * twist * region.ring * times);
    bending.border.addSquare(region.nodes, region.rows.data() + 2 * n, bv * region.area * times);
  }
  bending.inside.sortByNode();
  bending.border.sortByNode();
  return bending;
}

}  // namespace

Bending::Bending(const Cloth& cloth, const std::vector<std::uint8_t>& held, const GridLayout& layout, Workers& workers)
    : grid_(layout.slots) {
  std::vector<const ClothPiece*> pieces;
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live && piece.fabric.law == Fabric::Law::Woven &&
        (piece.fabric.bendWarp > 0 || piece.fabric.bendWeft > 0))
      pieces.push_back(&piece);
  std::vector<std::vector<NodeWeight>> remainder(pieces.size());
  std::vector<Rows> rows(pieces.size());
  workers.forBlocks(pieces.size(), 1, [&](std::size_t p, std::size_t) {
    const NodeIndex first = pieces[p]->firstNode;
    const auto nodes = static_cast<std::uint32_t>(pieces[p]->lattice->nodes.size());
    const PieceBending bending = bendingOf(*pieces[p], held, layout, grid_);
    SparseRowSum sum(nodes);
    for (std::uint32_t k = 0; k < nodes; ++k) {
      bending.inside.addRow(k, sum);
      bending.border.addRow(k, sum);
      rows[p].add(first, k, sum);
      bending.border.addRow(k, sum);
      sum.take([&](std::uint32_t column, double weight) {
        remainder[p].push_back({first + k, first + column, weight});
      });
    }
  });
  for (const auto& entries : remainder) remainder_.insert(remainder_.end(), entries.begin(), entries.end());
  for (const Rows& own : rows) {
    const auto before = static_cast<std::uint32_t>(rows_.column.size());
    for (const std::uint32_t start : own.start) rows_.start.push_back(before + start);
    rows_.node.insert(rows_.node.end(), own.node.begin(), own.node.end());
    rows_.column.insert(rows_.column.end(), own.column.begin(), own.column.end());
    rows_.weight.insert(rows_.weight.end(), own.weight.begin(), own.weight.end());
  }
  rows_.start.push_back(static_cast<std::uint32_t>(rows_.column.size()));
}

void Bending::Rows::add(NodeIndex first, std::uint32_t row, SparseRowSum& sum) {
  const auto begin = static_cast<std::uint32_t>(column.size());
  sum.take([&](std::uint32_t k, double w) {
    column.push_back(first + k);
    weight.push_back(w);
  });
  if (column.size() == begin) return;
  node.push_back(first + row);
  start.push_back(begin);
}

Vec3 Bending::rowTimes(std::size_t row, std::span<const Vec3> x) const {
  // Rows sum to nothing, so places may be taken from the row's own node: no rounding from how far away the cloth is.
  const Vec3 here = x[rows_.node[row]];
  Vec3 sum;
  for (std::uint32_t c = rows_.start[row]; c < rows_.start[row + 1]; ++c)
    sum += (x[rows_.column[c]] - here) * rows_.weight[c];
  return sum;
}

double Bending::value(std::span<const Vec3> x, Workers& workers) const {
  return workers.sum(rows_.node.size(), 512, [&](std::size_t begin, std::size_t end) {
    double total = 0;
    for (std::size_t r = begin; r < end; ++r) total += 0.5 * dot(x[rows_.node[r]], rowTimes(r, x));
    return total;
  });
}

void Bending::addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const {
  workers.forBlocks(rows_.node.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) gradient[rows_.node[r]] += rowTimes(r, x);
  });
}

}  // namespace karinui
