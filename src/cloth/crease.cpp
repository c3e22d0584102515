#include "cloth/crease.h"

#include <cmath>
#include <numbers>

#include "cloth/bend_along.h"

namespace karinui {

namespace {

constexpr double kLeastReach = 0.3;                 // spacings that a hinge must reach to either side
constexpr double kOver = 2 * std::numbers::pi / 3;  // radians: see offRest()
constexpr double kPlainBend = 1e-5;                 // N m, of cloth that has no bending of its own (simcloth)

// Evenly along a polyline, about `step` apart.
std::vector<Flat> evenly(const std::vector<Flat>& line, double step) {
  std::vector<double> at(line.size(), 0);
  for (std::size_t k = 1; k < line.size(); ++k) at[k] = at[k - 1] + distance(line[k - 1], line[k]);
  const auto parts = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(at.back() / step)));
  std::vector<Flat> places{line.front()};
  std::size_t k = 1;
  for (std::size_t n = 1; n <= parts; ++n) {
    const double s = at.back() * static_cast<double>(n) / static_cast<double>(parts);
    while (k + 1 < line.size() && at[k] < s) ++k;
    const double whole = at[k] - at[k - 1];
    places.push_back(lerp(line[k - 1], line[k], whole > 0 ? std::fmin(1, (s - at[k - 1]) / whole) : 1));
  }
  return places;
}

}  // namespace

CreaseHinges::CreaseHinges(const Cloth& cloth) {
  std::vector<std::array<NodeIndex, 12>> nodes;
  for (const CreasedLine& line : cloth.creases) {
    const ClothPiece& piece = cloth.pieces[line.piece];
    if (!piece.live || line.places.size() < 2) continue;
    const Lattice& lattice = *piece.lattice;
    const LatticeFinder finder(lattice.nodes, lattice.faces);
    const std::vector<Flat> places = evenly(line.places, cloth.spacing);
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const Flat from = places[k], to = places[k + 1], way = to - from;
      if (!(length(way) > 0)) continue;
      const Flat across = leftOf(normalized(way)), middle = lerp(from, to, 0.5);
      std::array<NodeIndex, 12> corners{};
      Hinge hinge;
      bool reaches = true;
      const std::array<Flat, 4> wanted{from, to, middle + across * cloth.spacing, middle - across * cloth.spacing};
      for (std::size_t p = 0; p < 4; ++p) {
        const LatticePlace in = finder.find(wanted[p]);
        Flat there;
        for (int c = 0; c < 3; ++c) {
          corners[3 * p + c] = piece.firstNode + in.face[c];
          hinge.weight[3 * p + c] = in.weight[c];
          there += lattice.nodes[in.face[c]] * in.weight[c];
        }
        if (p > 1) reaches = reaches && std::fabs(dot(there - middle, across)) > kLeastReach * cloth.spacing;
      }
      if (!reaches) continue;
      const double own = piece.fabric.law == Fabric::Law::Woven ? bendAlong(piece, across) : kPlainBend;
      hinge.rest = line.crease.angle;
      hinge.stiffness = own / cloth.spacing * line.crease.hold / (1 - line.crease.hold) * length(way);
      nodes.push_back(corners);
      hinges_.push_back(hinge);
    }
  }
  setElements(std::move(nodes), cloth.nodeCount);
}

CreaseHinges::Bent CreaseHinges::bent(std::size_t e, const Corners& x) const {
  std::array<Vec3, 4> p;
  for (std::size_t c = 0; c < 12; ++c) p[c / 3] += x[c] * hinges_[e].weight[c];
  const Vec3 edge = p[1] - p[0], toLeft = p[2] - p[0], toRight = p[3] - p[0];
  const Vec3 left = cross(edge, toLeft), right = cross(toRight, edge);
  const double l = length(edge), ll = length(left), lr = length(right);
  Bent now;
  if (!(l > 1e-9 && ll > 1e-12 && lr > 1e-12)) return now;
  now.angle = std::atan2(dot(cross(right, left), edge) / l, dot(left, right));
  now.slope[2] = left * (l / (ll * ll)), now.slope[3] = right * (l / (lr * lr));
  const double a = dot(toLeft, edge) / (l * l), b = dot(toRight, edge) / (l * l);
  now.slope[0] = -(now.slope[2] * (1 - a) + now.slope[3] * (1 - b));
  now.slope[1] = -(now.slope[2] * a + now.slope[3] * b);
  return now;
}

// A hinge reaches straight across cloth that is bent, so its two sides may cross where the fold itself is closed. Its
// angle then goes on beyond 180 degrees; taken for one of nearly 180 to the other side, it would turn the whole torque
// round at once. As far as 120 degrees to the other side a fold is taken to be opened and bent back.
double CreaseHinges::offRest(std::size_t e, double angle) const {
  const double rest = hinges_[e].rest;
  if (rest * angle < 0 && std::fabs(angle) > kOver) angle += std::copysign(2 * std::numbers::pi, rest);
  return angle - rest;
}

double CreaseHinges::elementValue(std::size_t e, const Corners& x) const {
  const double off = offRest(e, bent(e, x).angle);
  return 0.5 * hinges_[e].stiffness * off * off;
}

void CreaseHinges::elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 12> out) const {
  const Bent now = bent(e, x);
  const double torque = hinges_[e].stiffness * offRest(e, now.angle);
  for (std::size_t c = 0; c < 12; ++c) out[c] = now.slope[c / 3] * (torque * hinges_[e].weight[c]);
}

void CreaseHinges::elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const {
  const Bent now = bent(e, x);
  for (std::size_t a = 0; a < 12; ++a)
    for (std::size_t b = 0; b < 12; ++b) {
      out[12 * a + b] = {};
      addOuter(out[12 * a + b], hinges_[e].stiffness * hinges_[e].weight[a] * hinges_[e].weight[b], now.slope[a / 3],
               now.slope[b / 3]);
    }
}

}  // namespace karinui
