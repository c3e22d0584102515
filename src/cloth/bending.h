#pragma once
// Bending energy of woven cloth, per area: 1/2 (B_weft k_uu^2 + B_warp k_vv^2 + 2 sqrt(B_weft B_warp) k_uv^2).
// Curvatures are second differences of the positions, so the second derivative is constant (exact for cloth that does
// not stretch; isometric bending, Bergou et al. 2006).
//   Inside:  three nodes along warp and weft, the four corners of a cell for the twist.
//   Border:  the mean curvature of regions around the nodes (border_bending.h). What the nodes' best-fitting quadratics
//            leave over costs energy too, so that no jagged mode of the border is free.
// Between held nodes nothing bends: a region that is clamped in part is weighted by whole over bending area.
#include "cloth/quadratic_form.h"
#include "cloth/sparse_rows.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class Bending : public Energy {
 public:
  // Of the live woven pieces; held: per cloth node.
  Bending(const Cloth& cloth, const std::vector<std::uint8_t>& held, const GridLayout& layout, Workers& workers);
  double value(std::span<const Vec3> x, Workers& workers) const override;
  void addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const override;
  // The second derivative: the grid blocks' part of it, and the remainder.
  const GridBending& grid() const { return grid_; }
  const std::vector<NodeWeight>& remainder() const { return remainder_; }

 private:
  struct Rows {
    std::vector<NodeIndex> node;       // of each row
    std::vector<std::uint32_t> start;  // of each row in column and weight; of all rows, one more: the end
    std::vector<NodeIndex> column;
    std::vector<double> weight;                                       // N/m
    void add(NodeIndex first, std::uint32_t row, SparseRowSum& sum);  // a row of the piece whose first node it is
  };
  Vec3 rowTimes(std::size_t row, std::span<const Vec3> x) const;
  Rows rows_;
  GridBending grid_;
  std::vector<NodeWeight> remainder_;
};

}  // namespace karinui
