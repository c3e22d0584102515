#include <gtest/gtest.h>

#include "cloth/tie_map.h"

namespace karinui::test {
namespace {

// A point of a finished piece and a folded pair sewn to it, beside a pair sewn 1:1.
struct Sewn {
  Sewn() {
    cloth.nodeCount = 5;
    cloth.ties = {{0, 1, 2, 0}, {3, 4, kNoNode, 0}};
  }
  TieMap map() const { return TieMap(cloth, {1, 0, 0, 0, 0}, {1, 1}); }
  Cloth cloth;
};

TEST(Ties, WhatOneOfAFoldedPairWishesBothDoEachTheirWay) {
  const Sewn sewn;
  for (const std::size_t who : {1u, 2u}) {
    std::vector<Vec3> move(5);
    move[who] = {0, 0.2, 0};
    move[0] = {1, 1, 1};  // held: it goes nowhere
    sewn.map().makeAdmissible(move);
    EXPECT_EQ(move[0], Vec3{});
    EXPECT_NEAR(move[who].y, 0.1, 1e-15) << who;
    EXPECT_LT(length(move[1] + move[2]), 1e-15) << "their middle stays on the held point";
  }
}

TEST(Ties, SewnPointsGoByTheMeanOfTheirWishes) {
  const Sewn sewn;
  std::vector<Vec3> move(5);
  move[3] = {0.2, 0, 0};
  move[4] = {0, 0.4, 0};
  sewn.map().makeAdmissible(move);
  EXPECT_LT(length(move[3] - Vec3{0.1, 0.2, 0}), 1e-15);
  EXPECT_EQ(move[3], move[4]);
}

}  // namespace
}  // namespace karinui::test
