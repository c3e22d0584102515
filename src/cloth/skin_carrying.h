#pragma once
// Moves of cloth with the skin it lies on.
#include <cstdint>
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/body/skeleton.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// What a place of the cloth lies on: a point of the skin, and how wholly it goes with it.
struct SkinHold {
  std::uint32_t point = kNoNode;
  double share = 0;
};

// `skin`: where the points of the body's mesh are. A place that is far from it has none.
std::vector<SkinHold> holdsOf(const std::vector<Vec3>& places, const Body& own, const std::vector<Vec3>& skin);

// Cloth off the skin goes as the cloth around it does.
class SkinCarrying {
 public:
  // `from` and `to`: where the skin is at both ends of the way.
  SkinCarrying(const Cloth& cloth, const std::vector<Vec3>& x, std::vector<SkinHold> holds,
               const std::vector<Rigid>& from, const std::vector<Rigid>& to);
  // Of each node, in the part of the way between two placements of the skin.
  const std::vector<Vec3>& moves(const std::vector<Vec3>& x, const std::vector<Rigid>& before,
                                 const std::vector<Rigid>& after, Workers& workers);

 private:
  std::vector<SkinHold> holds_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<Vec3> move_;
};

}  // namespace karinui
