// The examiner, linked without the library cloth: what it finds it finds without the solver.
#include "karinui/check/check.h"

#include "cloth/meshes.h"

namespace karinui::test {
namespace {

// One cell of cloth, its corners at (0,0) (1,0) (0,1) (1,1) of the function given.
ClothState cells(const Cloth& cloth, std::vector<std::function<Vec3(double, double)>> each) {
  return standingBy(cloth, [&](std::size_t piece, Flat p) { return each[piece](p.u / 0.01, p.v / 0.01); });
}
Cloth pieces(int count) {
  Cloth cloth;
  for (int k = 0; k < count; ++k) addPiece(cloth, gridLattice(1, 1, 0.01), Fabric());
  return cloth;
}

TEST(Check, MeasuresHowDeepClothStandsInTheBody) {
  const BodyPtr body = bodyOf(boxMesh({0.1, 0.1, 0.1}, 2));
  Cloth cloth;
  addPiece(cloth, gridLattice(5, 5, 0.01), Fabric());
  for (const double height : {0.002, -0.0004, -0.007}) {
    const ClothState state = standingBy(cloth, [&](std::size_t, Flat p) {
      return Vec3{p.u - 0.02, 0.1 + height, p.v - 0.02};
    });
    const ClothCheck found = check(cloth, state, body.get());
    EXPECT_NEAR(found.penetration, std::fmax(0.0, -height), 1e-9);
    EXPECT_EQ(found.clothBodyCrossings, 0u);  // wholly in or wholly out: no face passes through the skin
    EXPECT_EQ(found.vertices, 36u);
    EXPECT_EQ(check(cloth, state, nullptr).penetration, 0);
  }
}

TEST(Check, SeesACornerThatPokesUpThroughAFace) {
  // All nodes are outside; only the middle of the cell is inside.
  const BodyPtr body = bodyOf(boxMesh({0.002, 0.1, 0.002}, 1));
  const Cloth cloth = pieces(1);
  const ClothState state = cells(cloth, {[](double u, double v) {
                                   return Vec3{0.02 * (u - 0.5), 0.098, 0.02 * (v - 0.5)};
                                 }});
  const ClothCheck found = check(cloth, state, body.get());
  EXPECT_NEAR(found.penetration, 0.002, 1e-9);
  EXPECT_GT(found.clothBodyCrossings, 0u);
}

TEST(Check, CountsPairsOfFacesThatCrossTheBody) {
  // A cell on edge, through one of the two faces of the box's top: both its faces cross that one.
  const BodyPtr body = bodyOf(boxMesh({0.1, 0.1, 0.1}, 1));
  const Cloth cloth = pieces(1);
  const ClothState state = cells(cloth, {[](double u, double v) {
                                   return Vec3{0.05, 0.1 + 0.01 * (v - 0.5), -0.05 + 0.01 * u};
                                 }});
  EXPECT_EQ(check(cloth, state, body.get()).clothBodyCrossings, 2u);
}

TEST(Check, CountsPairsOfFacesThatCrossEachOther) {
  // The first lies flat, halved by its diagonal; the second stands on edge through it along x = 0.3 cells.
  const auto flat = [](double u, double v) { return Vec3{u, v, 0} * 0.01; };
  const auto upright = [](double from, double to) {
    return [=](double u, double v) { return Vec3{0.3, from + (to - from) * u, v - 0.5} * 0.01; };
  };
  const Cloth cloth = pieces(2);
  const auto count = [&](double from, double to) {
    return check(cloth, cells(cloth, {flat, upright(from, to)}), nullptr).clothClothCrossings;
  };
  EXPECT_EQ(count(0.45, 0.55), 2u);  // beyond the diagonal: two faces through one
  EXPECT_EQ(count(0.15, 0.40), 3u);  // across it: one of them through both
  EXPECT_EQ(count(1.10, 1.40), 0u);
  // They are told by the pieces, with their middle.
  Cloth named = cloth;
  named.pieces[0].id = PieceId{7}, named.pieces[1].id = PieceId{3};
  const auto crossings = check(named, cells(named, {flat, upright(0.45, 0.55)}), nullptr).crossings;
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_EQ(crossings[0].a, PieceId{3});
  EXPECT_EQ(crossings[0].b, PieceId{7});
  EXPECT_EQ(crossings[0].pairs, 2u);
  EXPECT_LT(distance(crossings[0].middle, Vec3{0.003, 0.005, 0}), 0.004);
  // Faces that meet at a seam do not count.
  Cloth sewn = cloth;
  for (std::uint32_t k = 0; k < 4; ++k) sewn.ties.push_back({0, 4 + k, kNoNode, 0});
  EXPECT_EQ(check(sewn, cells(sewn, {flat, upright(0.15, 0.40)}), nullptr).clothClothCrossings, 0u);
}

// Two cells sewn along an edge. Folded back onto each other they meet at the seam; where the second's far edge is led
// through the first they pass through each other beside it.
TEST(Check, CountsFacesThatCrossBesideWhatTheyShare) {
  Cloth sewn = pieces(2);
  sewn.ties = {{0, 4, kNoNode, 0}, {2, 6, kNoNode, 0}};    // u = 0 of both
  const auto count = [&](double nearEnd, double farEnd) {  // heights of the second's free edge over the first
    const ClothCheck found = check(sewn,
                                   cells(sewn, {[](double u, double v) {
                                                  return Vec3{u, v, 0} * 0.01;
                                                },
                                                [=](double u, double v) {
                                                  return Vec3{0.9 * u, v, u * std::lerp(nearEnd, farEnd, v)} * 0.01;
                                                }}),
                                   nullptr);
    EXPECT_EQ(found.clothClothCrossings, 0u);
    return found.foldCrossings;
  };
  EXPECT_EQ(count(0.5, 0.5), 0u);
  EXPECT_EQ(count(0.01, 0.02), 0u);
  EXPECT_GT(count(0.2, -0.2), 0u);
  // A point sewn to the middle of two only touches the edge between them.
  Cloth gathered = pieces(2);
  gathered.ties = {{0, 4, 5, 0}};
  const ClothState state = cells(gathered, {[](double u, double v) {
                                              return Vec3{0.5 + u, 0, v} * 0.01;
                                            },
                                            [](double u, double v) {
                                              return Vec3{u, v, 0} * 0.01;
                                            }});
  EXPECT_EQ(check(gathered, state, nullptr).foldCrossings, 0u);
}

TEST(Check, GivesTheWidestSeamGap) {
  Cloth cloth = pieces(2);
  cloth.ties = {{0, 4, kNoNode, 0}, {1, 5, 7, 0}};
  const ClothState state = cells(cloth, {[](double u, double v) {
                                           return Vec3{u, v, 0} * 0.01;
                                         },
                                         [](double u, double v) {
                                           return Vec3{0.01 * u, 0.01 * v, 0.004};
                                         }});
  // Node 0 to 4: 4 mm. Node 1 at (10, 0, 0) to the middle of 5 (10, 0, 4) and 7 (10, 10, 4): (0, 5, 4) mm.
  EXPECT_NEAR(check(cloth, state, nullptr).seamGap, std::hypot(0.005, 0.004), 1e-12);
  cloth.ties.pop_back();
  EXPECT_NEAR(check(cloth, state, nullptr).seamGap, 0.004, 1e-12);
}

TEST(Check, GivesTheStrainOfWarpAndWeft) {
  Cloth cloth;
  addPiece(cloth, gridLattice(10, 10, 0.01), Fabric());
  const ClothState state = standingBy(cloth, [](std::size_t, Flat p) { return Vec3{1.03 * p.u, 0.99 * p.v, 0}; });
  const StrainReport strain = check(cloth, state, nullptr).strain;
  EXPECT_NEAR(strain.max, 0.03, 1e-9);
  EXPECT_NEAR(strain.mean, 0.02, 1e-9);  // as many weft edges at 3 % as warp edges at 1 %
  EXPECT_NEAR(strain.p99, 0.03, 1e-9);
  const ClothState rigid = standingBy(cloth, [](std::size_t, Flat p) { return Vec3{2, p.u, -p.v}; });
  EXPECT_NEAR(check(cloth, rigid, nullptr).strain.max, 0, 1e-9);
}

TEST(Check, SaysWhatIsNotFinite) {
  const Cloth cloth = pieces(1);
  const ClothState fine = cells(cloth, {[](double u, double v) { return Vec3{u, v, 0}; }});
  EXPECT_TRUE(check(cloth, fine, nullptr).finite);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e6}) {
    ClothState state = fine;
    state.position[2].z = bad;
    EXPECT_FALSE(check(cloth, state, nullptr).finite);
  }
  ClothState shorter = fine;
  shorter.position.pop_back();
  EXPECT_FALSE(check(cloth, shorter, nullptr).finite);
}

}  // namespace
}  // namespace karinui::test
