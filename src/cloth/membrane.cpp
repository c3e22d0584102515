#include "cloth/membrane.h"

namespace karinui {
namespace {

// A thread squeezed to nothing has no direction; below this part of its length none is asked for.
constexpr double kShortest = 1e-9;

Vec3 carried(const std::array<double, 3>& weight, const std::array<Vec3, 3>& x) {
  return x[0] * weight[0] + x[1] * weight[1] + x[2] * weight[2];
}

}  // namespace

Membrane::Membrane(const Cloth& cloth, const PanelPlan* plan) {
  std::vector<std::array<NodeIndex, 3>> nodes;
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const ClothPiece& piece = cloth.pieces[p];
    const Fabric& f = piece.fabric;
    if (!piece.live || f.law != Fabric::Law::Woven) continue;
    const ShearCurve shear{f.shear, f.shearStiffen};
    threads_.push_back({f.warpCurve(), f.weftCurve(), shear});
    threads_.push_back({{}, {}, shear});  // where the threads are the panel's
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
      const PanelPlan::Left left = plan ? plan->left[p][n] : PanelPlan::Left::All;
      const Share share{unit(lattice.weft), unit(lattice.warp), 0.5 * twice, whole};
      const std::array<NodeIndex, 3> corners{piece.firstNode + face[0], piece.firstNode + face[1],
                                             piece.firstNode + face[2]};
      all_.push_back({corners, share});
      if (left == PanelPlan::Left::Nothing) continue;
      share_.push_back(share);
      if (left == PanelPlan::Left::Shear) ++share_.back().threads;
      nodes.push_back(corners);
    }
  }
  setElements(std::move(nodes), cloth.nodeCount);
}

double Membrane::elementValue(std::size_t e, const Corners& x) const {
  const Share& share = share_[e];
  const Threads& t = threads_[share.threads];
  const Vec3 weft = carried(share.weft, x), warp = carried(share.warp, x);
  return share.area *
         (t.weft.energy(length(weft) - 1) + t.warp.energy(length(warp) - 1) + t.shear.energy(dot(weft, warp)));
}

void Membrane::elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 3> out) const {
  const Share& share = share_[e];
  const Threads& t = threads_[share.threads];
  const Vec3 weft = carried(share.weft, x), warp = carried(share.warp, x);
  const double lu = length(weft), lv = length(warp), slope = t.shear.slope(dot(weft, warp));
  const Vec3 byWeft = weft * (lu > kShortest ? t.weft.force(lu - 1) / lu : 0) + warp * slope;
  const Vec3 byWarp = warp * (lv > kShortest ? t.warp.force(lv - 1) / lv : 0) + weft * slope;
  for (int a = 0; a < 3; ++a) out[a] = (byWeft * share.weft[a] + byWarp * share.warp[a]) * share.area;
}

void Membrane::elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const {
  const Share& share = share_[e];
  const Threads& t = threads_[share.threads];
  const Vec3 weft = carried(share.weft, x), warp = carried(share.warp, x);
  const double lu = length(weft), lv = length(warp);
  const Vec3 nu = lu > kShortest ? weft * (1 / lu) : Vec3{}, nv = lv > kShortest ? warp * (1 / lv) : Vec3{};
  // Across the thread only tension holds; squeezed threads would give a negative value, which is left out.
  const double au = lu > kShortest ? std::fmax(0.0, t.weft.force(lu - 1) / lu) : 0;
  const double av = lv > kShortest ? std::fmax(0.0, t.warp.force(lv - 1) / lv) : 0;
  const double bu = t.weft.tangent(lu - 1) - au, bv = t.warp.tangent(lv - 1) - av;
  const double shear = t.shear.curvature(dot(weft, warp));
  std::array<Vec3, 3> turn;
  for (int a = 0; a < 3; ++a) turn[a] = warp * share.weft[a] + weft * share.warp[a];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      Block3& block = out[a * 3 + b];
      block = {};
      const double u = share.area * share.weft[a] * share.weft[b], v = share.area * share.warp[a] * share.warp[b];
      addStretch(block, u * au, u * bu, nu);
      addStretch(block, v * av, v * bv, nv);
      addOuter(block, share.area * shear, turn[a], turn[b]);
    }
}

Vec3 Membrane::tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const {
  Vec3 pull;
  for (const auto& [n, share] : all_) {
    if (!patch[n[0]] && !patch[n[1]] && !patch[n[2]]) continue;
    const Threads& t = threads_[share.threads];
    const std::array<Vec3, 3> corner{x[n[0]], x[n[1]], x[n[2]]};
    const Vec3 weft = carried(share.weft, corner), warp = carried(share.warp, corner);
    const double lu = length(weft), lv = length(warp);
    for (int a = 0; a < 3; ++a) {
      if (!patch[n[a]]) continue;
      if (lu > 1) pull -= weft * (share.area * share.weft[a] * t.weft.force(lu - 1) / lu);
      if (lv > 1) pull -= warp * (share.area * share.warp[a] * t.warp.force(lv - 1) / lv);
    }
  }
  return pull;
}

}  // namespace karinui
