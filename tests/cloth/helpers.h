#pragma once
// Cloth and bodies for tests: hand-made square lattices, analytic bodies, and the workloads that other solvers were
// measured on.
#include <cmath>
#include <functional>
#include <random>

#include "karinui/cloth/pull.h"

namespace karinui::test {

inline constexpr double kGravity = 9.81;

inline Vec3 middleOf(const ClothState& state) {
  Vec3 sum;
  for (Vec3 p : state.position) sum += p;
  return sum * (1.0 / static_cast<double>(state.position.size()));
}

// columns x rows cells of `h`, all whole, warp along v.
inline std::shared_ptr<Lattice> gridLattice(std::uint32_t columns, std::uint32_t rows, double h, Flat corner = {}) {
  auto lattice = std::make_shared<Lattice>();
  lattice->spacing = h;
  lattice->columns = columns + 1;
  lattice->rows = rows + 1;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      lattice->grid.push_back(static_cast<std::uint32_t>(lattice->nodes.size()));
      lattice->nodes.push_back(corner + Flat{i * h, j * h});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (columns + 1) + i; };
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      lattice->cell.push_back(1);
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 == 0) {
        lattice->faces.push_back({a, b, c});
        lattice->faces.push_back({a, c, d});
      } else {
        lattice->faces.push_back({a, b, d});
        lattice->faces.push_back({b, c, d});
      }
    }
  for (std::uint32_t i = 0; i < columns; ++i) lattice->border.push_back(at(i, 0));
  for (std::uint32_t j = 0; j < rows; ++j) lattice->border.push_back(at(columns, j));
  for (std::uint32_t i = columns; i > 0; --i) lattice->border.push_back(at(i, rows));
  for (std::uint32_t j = rows; j > 0; --j) lattice->border.push_back(at(0, j));
  return lattice;
}

inline std::uint32_t addPiece(Cloth& cloth, std::shared_ptr<const Lattice> lattice, const Fabric& fabric,
                              bool live = true) {
  const std::uint32_t first = cloth.nodeCount;
  cloth.spacing = lattice->spacing;
  cloth.nodeCount += static_cast<std::uint32_t>(lattice->nodes.size());
  cloth.pieces.push_back({PieceId{cloth.pieces.size() + 1}, "piece", std::move(lattice), fabric, first, 0, live});
  return first;
}

inline ClothState standingBy(const Cloth& cloth, const std::function<Vec3(std::size_t piece, Flat)>& where) {
  ClothState state;
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p)
    for (Flat node : cloth.pieces[p].lattice->nodes) state.position.push_back(where(p, node));
  return state;
}

class NoBody : public Collider {
 public:
  Sample sample(Vec3) const override { return {1e3, {0, 1, 0}}; }
  double clearance(Vec3) const override { return 1e9; }
};

class PlaneBody : public Collider {
 public:
  PlaneBody(Vec3 unitNormal, double height) : normal_(unitNormal), height_(height) {}
  Sample sample(Vec3 p) const override { return {dot(p, normal_) - height_, normal_}; }
  double clearance(Vec3 p) const override { return sample(p).distance; }

 private:
  Vec3 normal_;
  double height_;
};

class CapsuleBody : public Collider {  // a ball is a capsule of no length
 public:
  struct Capsule {
    Vec3 a, b;
    double radius;
  };
  explicit CapsuleBody(std::vector<Capsule> capsules) : capsules_(std::move(capsules)) {}
  Sample sample(Vec3 p) const override {
    Sample nearest{1e9, {0, 1, 0}};
    for (const Capsule& c : capsules_) {
      const Vec3 axis = c.b - c.a;
      const double l2 = squaredLength(axis);
      const double t = l2 > 0 ? std::fmin(1, std::fmax(0, dot(p - c.a, axis) / l2)) : 0;
      const Vec3 out = p - (c.a + axis * t);
      const double d = length(out) - c.radius;
      if (d < nearest.distance) nearest = {d, length(out) > 0 ? normalized(out) : Vec3{0, 1, 0}};
    }
    return nearest;
  }
  double clearance(Vec3 p) const override { return sample(p).distance; }

 private:
  std::vector<Capsule> capsules_;
};

// The tunic of two panels on three capsules (W3), `cells` across its 0.6 m.
inline CapsuleBody tunicBody() {
  return CapsuleBody({{{0, -0.16, 0}, {0, 0.16, 0}, 0.14},
                      {{0.10, 0.18, 0}, {0.50, 0.18, 0}, 0.05},
                      {{-0.10, 0.18, 0}, {-0.50, 0.18, 0}, 0.05}});
}
inline ClothLevel tunic(std::uint32_t cells, const Fabric& fabric) {
  ClothLevel level;
  const double h = 0.6 / cells;
  const std::uint32_t rows = static_cast<std::uint32_t>(std::lround(0.7 / h));
  for (int side = 0; side < 2; ++side) addPiece(level.cloth, gridLattice(cells, rows, h), fabric);
  const double height = rows * h;
  level.state = standingBy(level.cloth, [&](std::size_t piece, Flat p) {
    return Vec3{-0.3 + p.u, 0.27 - height + p.v, piece == 0 ? 0.26 : -0.26};
  });
  const std::uint32_t back = level.cloth.pieces[1].firstNode;
  const auto tie = [&](std::uint32_t i, std::uint32_t j, std::uint32_t seam) {
    const std::uint32_t node = j * (cells + 1) + i;
    level.cloth.ties.push_back({node, back + node, kNoNode, seam});
  };
  for (std::uint32_t s = 1; s <= 4; ++s) level.cloth.seams.push_back(SeamId{s});
  for (std::uint32_t j = 0; j * h <= height - 0.2; ++j) {
    tie(0, j, 0);
    tie(cells, j, 1);
  }
  for (std::uint32_t i = 0; i * h <= 0.178; ++i) {
    tie(i, rows, 2);
    tie(cells - i, rows, 3);
  }
  return level;
}

// A rectangle as a pattern piece, from the origin; edges bottom, right, top, left.
inline std::shared_ptr<Piece> rectangle(std::uint64_t id, double width, double height, Flat grain = {0, 1}) {
  auto piece = std::make_shared<Piece>();
  piece->id = PieceId{id};
  piece->name = "piece" + std::to_string(id);
  piece->grain = normalized(grain);
  const Flat a{0, 0}, b{width, 0}, c{width, height}, d{0, height};
  piece->outline.edges = {{"bottom", Curve::line(a, b)},
                          {"right", Curve::line(b, c)},
                          {"top", Curve::line(c, d)},
                          {"left", Curve::line(d, a)}};
  return piece;
}

inline Pattern patternOf(const std::vector<std::shared_ptr<Piece>>& pieces) {
  Pattern pattern;
  for (const auto& piece : pieces) pattern.pieces[piece->id] = piece;
  return pattern;
}

// Two rectangles, the upper one's bottom sewn to the lower one's top.
inline Pattern sewnBelow(const std::shared_ptr<Piece>& upper, const std::shared_ptr<Piece>& lower, const Seam& how) {
  Pattern pattern = patternOf({upper, lower});
  Seam seam = how;
  seam.id = SeamId{1};
  seam.name = "gathered";
  seam.a = {{upper->id, "bottom"}};
  seam.b = {{lower->id, "top"}};
  pattern.seams[seam.id] = seam;
  return pattern;
}

inline ClothLevel levelOf(const Pattern& pattern, double spacing, const Fabric& fabric,
                          const ClothChoice& choice = {}) {
  const auto laid = lay(pattern, spacing);
  KARINUI_ASSERT(laid);
  auto cloth = assemble(pattern, *laid, {{"cotton", fabric}}, choice);
  KARINUI_ASSERT(cloth);
  ClothState state = standing(pattern, *cloth);
  return {std::move(*cloth), std::move(state)};
}

// Stiff in its plane, no toe, no slack: cloth as in the textbooks.
inline Fabric textbook(double stretch, double bend, double weight) {
  Fabric f;
  f.weight = weight;
  f.stretchWarp = f.stretchWeft = stretch;
  f.shear = 0.5 * stretch;
  f.bendWarp = f.bendWeft = bend;
  f.compression = 1;
  f.toeWarp = f.toeWeft = 0;
  return f;
}

}  // namespace karinui::test
