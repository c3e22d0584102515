#include "cloth/prolong.h"

#include <cmath>

#include "cloth/lattice_areas.h"

namespace karinui {
namespace {

struct Slopes {  // of the place in space by the place on paper
  Vec3 byU, byV;
};

// Least-squares tangent planes at the nodes.
std::vector<Slopes> slopesOf(const Lattice& lattice, std::span<const Vec3> x) {
  const auto near = neighboursOf(lattice.nodes.size(), lattice.faces);
  std::vector<Slopes> slopes(lattice.nodes.size());
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    double uu = 0, uv = 0, vv = 0;
    Vec3 u, v;
    for (std::uint32_t n : near[k]) {
      const Flat d = lattice.nodes[n] - lattice.nodes[k];
      const Vec3 s = x[n] - x[k];
      uu += d.u * d.u;
      uv += d.u * d.v;
      vv += d.v * d.v;
      u += s * d.u;
      v += s * d.v;
    }
    const double det = uu * vv - uv * uv;
    if (det > 1e-6 * uu * vv && det > 0) slopes[k] = {(u * vv - v * uv) * (1 / det), (v * uu - u * uv) * (1 / det)};
  }
  return slopes;
}

}  // namespace

Prolonged prolong(const Cloth& coarse, std::span<const Vec3> x, const Cloth& fine, std::span<const Vec3> standing) {
  Prolonged out;
  out.linear.assign(standing.begin(), standing.end());
  std::vector<std::uint8_t> held(fine.nodeCount, 0);
  for (std::uint32_t k : fine.pinned) held[k] = 1;
  for (const ClothPiece& piece : fine.pieces) {
    if (!piece.live) continue;
    for (const ClothPiece& other : coarse.pieces) {
      if (other.id != piece.id) continue;
      const Lattice& lattice = *other.lattice;
      const std::span<const Vec3> stood = x.subspan(other.firstNode, lattice.nodes.size());
      const auto slopes = slopesOf(lattice, stood);
      const LatticeFinder finder(lattice.nodes, lattice.faces);
      const std::vector<Flat> inwards = inwardsOf(piece.lattice->nodes, piece.lattice->faces);
      out.quadratic.resize(out.linear.size());
      for (std::uint32_t k = 0; k < piece.lattice->nodes.size(); ++k) {
        if (held[piece.firstNode + k]) continue;
        const Flat place = piece.lattice->nodes[k];
        const LatticePlace in = finder.find(place, inwards[k]);
        Vec3 linear, tangent;
        for (int c = 0; c < 3; ++c) {
          const Flat d = place - lattice.nodes[in.face[c]];
          const Slopes& slope = slopes[in.face[c]];
          linear += stood[in.face[c]] * in.weight[c];
          tangent += (slope.byU * d.u + slope.byV * d.v) * in.weight[c];
        }
        out.linear[piece.firstNode + k] = linear;
        out.quadratic[piece.firstNode + k] = tangent * 0.5;
      }
    }
  }
  out.quadratic.resize(out.linear.size());
  for (std::size_t k = 0; k < out.quadratic.size(); ++k) out.quadratic[k] += out.linear[k];
  return out;
}

}  // namespace karinui
