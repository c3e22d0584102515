#include "cloth/membrane.h"

#include <cmath>

#include "cloth/membrane_stress.h"

namespace karinui {
namespace {

// A thread of no length has no direction; below this part of its length none is computed.
constexpr double kShortest = 1e-9;

Vec3 mapped(const std::array<double, 3>& weight, const std::array<Vec3, 3>& x) {
  return x[0] * weight[0] + x[1] * weight[1] + x[2] * weight[2];
}

}  // namespace

Membrane::Membrane(const Cloth& cloth, const GridLayout* layout) {
  std::vector<std::array<NodeIndex, 3>> nodes;
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const ClothPiece& piece = cloth.pieces[p];
    const Fabric& f = piece.fabric;
    if (!piece.live || f.law != Fabric::Law::Woven) continue;
    const ShearCurve shear{f.shear, f.shearStiffen};
    threads_.push_back({f.warpCurve(), f.weftCurve(), shear});
    threads_.push_back({{}, {}, shear});  // where the threads are a grid block's
    const Lattice& lattice = *piece.lattice;
    for (std::size_t n = 0; n < lattice.faces.size(); ++n) {
      const Triangle& face = lattice.faces[n];
      const Flat a = lattice.nodes[face[0]], ab = lattice.nodes[face[1]] - a, ac = lattice.nodes[face[2]] - a;
      const double twice = cross(ab, ac);
      if (!(twice > 0)) continue;  // a face of no area stores no energy
      const auto unit = [&](Flat d) {
        const double b = cross(d, ac) / twice, c = cross(ab, d) / twice;
        return std::array<double, 3>{-b - c, b, c};
      };
      const auto whole = static_cast<std::uint32_t>(threads_.size() - 2);
      const GridLayout::Remainder remainder = layout ? layout->remainder[p][n] : GridLayout::Remainder::All;
      const Gradient gradient{unit(lattice.weft), unit(lattice.warp), 0.5 * twice, whole};
      const std::array<NodeIndex, 3> corners{piece.firstNode + face[0], piece.firstNode + face[1],
                                             piece.firstNode + face[2]};
      all_.push_back({corners, gradient});
      if (remainder == GridLayout::Remainder::Nothing) continue;
      gradient_.push_back(gradient);
      if (remainder == GridLayout::Remainder::Shear) ++gradient_.back().threads;
      nodes.push_back(corners);
    }
  }
  setElements(std::move(nodes), cloth.nodeCount);
}

double Membrane::elementValue(std::size_t e, const Corners& x) const {
  const Gradient& gradient = gradient_[e];
  const Threads& t = threads_[gradient.threads];
  const Vec3 weft = mapped(gradient.weft, x), warp = mapped(gradient.warp, x);
  return gradient.area *
         (t.weft.energy(length(weft) - 1) + t.warp.energy(length(warp) - 1) + t.shear.energy(dot(weft, warp)));
}

void Membrane::elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 3> out) const {
  const Gradient& gradient = gradient_[e];
  const Threads& t = threads_[gradient.threads];
  const Vec3 weft = mapped(gradient.weft, x), warp = mapped(gradient.warp, x);
  const double lu = length(weft), lv = length(warp), slope = t.shear.slope(dot(weft, warp));
  const Vec3 byWeft = weft * (lu > kShortest ? t.weft.force(lu - 1) / lu : 0) + warp * slope;
  const Vec3 byWarp = warp * (lv > kShortest ? t.warp.force(lv - 1) / lv : 0) + weft * slope;
  for (int a = 0; a < 3; ++a) out[a] = (byWeft * gradient.weft[a] + byWarp * gradient.warp[a]) * gradient.area;
}

void Membrane::elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const {
  const Gradient& gradient = gradient_[e];
  const Threads& t = threads_[gradient.threads];
  const Vec3 weft = mapped(gradient.weft, x), warp = mapped(gradient.warp, x);
  const double lu = length(weft), lv = length(warp);
  const Vec3 nu = lu > kShortest ? weft * (1 / lu) : Vec3{}, nv = lv > kShortest ? warp * (1 / lv) : Vec3{};
  // Where the threads are a grid block's, so is what is known of their stress.
  MembraneStress held;
  if (t.weft.stiffness > 0 || t.warp.stiffness > 0)
    held = positivePart({lu > kShortest ? t.weft.force(lu - 1) / lu : 0, t.shear.slope(dot(weft, warp)),
                         lv > kShortest ? t.warp.force(lv - 1) / lv : 0});
  const double bu = std::fmax(0.0, t.weft.tangent(lu - 1) - held.weft);
  const double bv = std::fmax(0.0, t.warp.tangent(lv - 1) - held.warp);
  const double shear = t.shear.curvature(dot(weft, warp));
  std::array<Vec3, 3> byShear;
  for (int a = 0; a < 3; ++a) byShear[a] = warp * gradient.weft[a] + weft * gradient.warp[a];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      Block3& block = out[a * 3 + b];
      block = {};
      const double u = gradient.area * gradient.weft[a] * gradient.weft[b],
                   v = gradient.area * gradient.warp[a] * gradient.warp[b];
      addIdentityAndOuter(block, u * held.weft, u * bu, nu);
      addIdentityAndOuter(block, v * held.warp, v * bv, nv);
      addOuter(block, gradient.area * shear, byShear[a], byShear[b]);
      const double mixed = gradient.weft[a] * gradient.warp[b] + gradient.warp[a] * gradient.weft[b];
      addIdentityAndOuter(block, gradient.area * held.shear * mixed, 0, nu);
    }
}

Vec3 Membrane::tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const {
  Vec3 pull;
  for (const auto& [n, gradient] : all_) {
    if (!patch[n[0]] && !patch[n[1]] && !patch[n[2]]) continue;
    const Threads& t = threads_[gradient.threads];
    const std::array<Vec3, 3> corner{x[n[0]], x[n[1]], x[n[2]]};
    const Vec3 weft = mapped(gradient.weft, corner), warp = mapped(gradient.warp, corner);
    const double lu = length(weft), lv = length(warp);
    for (int a = 0; a < 3; ++a) {
      if (!patch[n[a]]) continue;
      if (lu > 1) pull -= weft * (gradient.area * gradient.weft[a] * t.weft.force(lu - 1) / lu);
      if (lv > 1) pull -= warp * (gradient.area * gradient.warp[a] * t.warp.force(lv - 1) / lv);
    }
  }
  return pull;
}

}  // namespace karinui
