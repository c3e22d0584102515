#pragma once
// Moves a fine level of a garment as a coarse one has moved, with the detail that wide cells do not show: each fine
// node keeps its offsets from the coarse nodes around it, which turn as the cloth there has turned (as in linear blend
// skinning, the turns being those of Sorkine and Alexa, "As-rigid-as-possible surface modeling", 2007).
#include <array>
#include <span>
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class DetailTransfer {
 public:
  // `x`: where the fine nodes stand. Both levels have the same pieces; `coarse` must outlive this.
  DetailTransfer(const Cloth& fine, std::span<const Vec3> x, const Cloth& coarse);
  // Where the coarse nodes are to begin: interpolated on paper from the fine ones.
  const std::vector<Vec3>& start() const { return start_; }
  // Where the fine nodes are when the coarse ones are at `places`. The turns are found from those of the call before:
  // the cloth should be shown on its way, not only at the end of it.
  std::vector<Vec3> at(std::span<const Vec3> places, Workers& workers);
  // The same with the turns of the last call, and at each fine node with such a share of its detail: 1 all of it, 0
  // none, so that it lies on a coarse face.
  std::vector<Vec3> at(std::span<const Vec3> places, std::span<const double> share, Workers& workers) const;
  // The coarse nodes around a fine one.
  const std::array<std::uint32_t, 3>& around(std::size_t fine) const { return places_[fine].node; }

 private:
  // The turn of the cloth around each coarse node.
  void turnTo(std::span<const Vec3> places, Workers& workers);

  struct Turn {  // where it takes the axes
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    Vec3 operator()(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  };
  struct Place {  // of a fine node in a coarse triangle
    std::array<std::uint32_t, 3> node{};
    std::array<double, 3> weight{};
    std::array<Vec3, 3> offset;  // from each node, at the start
  };
  static Turn nearest(const std::array<Vec3, 3>& product, Turn turn);

  const Cloth& coarse_;
  std::vector<Vec3> start_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<Vec3> normal_;  // at the start, as long as the neighbours are far, all together
  std::vector<Turn> turns_;
  std::vector<Place> places_;
};

}  // namespace karinui
