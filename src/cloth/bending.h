#pragma once
// How woven cloth resists being bent: per area 1/2 (B_weft k_uu^2 + B_warp k_vv^2 + 2 sqrt(B_weft B_warp) k_uv^2), with
// curvatures as second differences of the places, so the second derivative is constant (exact for cloth that does not
// stretch; Bergou et al. 2006 call this isometric bending).
//   Inside:  three nodes along warp and weft, the four corners of a cell for the twist.
//   Border:  the mean curvature of regions around the nodes (border_bending.h); what the nodes' best-fitting quadratics
//            leave over is held too, so no jagged border is free of charge.
// Between held nodes nothing bends: a region that is clamped in part counts as much more as it bends less.
#include "cloth/sparse_rows.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class Bending : public Energy {
 public:
  // Of the live woven pieces; held: per cloth node.
  Bending(const Cloth& cloth, const std::vector<std::uint8_t>& held, const PanelPlan& plan, Workers& workers);
  double value(std::span<const Vec3> x, Workers& workers) const override;
  void addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const override;
  // The second derivative: the panels' part of it, and the rest.
  const PanelBending& panels() const { return panels_; }
  const std::vector<NodeWeight>& rest() const { return rest_; }

 private:
  struct Rows {
    std::vector<NodeIndex> node;       // of each row
    std::vector<std::uint32_t> start;  // of each row in column and weight; of all rows, one more: the end
    std::vector<NodeIndex> column;
    std::vector<double> weight;  // N/m
  };
  static Rows summed(std::vector<NodeWeight> entries, const ClothPiece& piece);
  Vec3 rowTimes(std::size_t row, std::span<const Vec3> x) const;
  Rows rows_;
  PanelBending panels_;
  std::vector<NodeWeight> rest_;
};

}  // namespace karinui
