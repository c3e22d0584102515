// Topstitching, piping and bindings where they lie on paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "karinui/pattern/trims.h"
#include "support.h"

namespace karinui {
namespace {

double lengthOf(const std::vector<Flat>& line) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += distance(line[k], line[k + 1]);
  return sum;
}

// Rows of a rectangle's lower edge go from side to side; where the sides are stitched too they meet on the diagonals.
TEST(Topstitching, RunsToTheOutlineAndMeetsRoundCorners) {
  const Pattern pattern = test::patternOf({test::pieceOf(1, test::rectangle(0.3, 0.2), "one")});
  Allowances finish;
  finish.topstitches[{{1}, "bottom"}] = {0.02, 2, 0.006, 0.003, {}};
  auto rows = stitchRows(pattern, finish);
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(lengthOf(rows[k].points), 0.3, 1e-6);
    for (const Flat p : rows[k].points) EXPECT_NEAR(p.v, 0.02 + 0.006 * static_cast<double>(k), 1e-9);
    EXPECT_EQ(rows[k].points.size(), 2u) << "straight rows are straight lines";
  }
  for (const char* edge : {"right", "top", "left"})
    finish.topstitches[{{1}, edge}] = finish.topstitches[{{1}, "bottom"}];
  rows = stitchRows(pattern, finish);
  ASSERT_EQ(rows.size(), 8u);
  double whole = 0;
  for (const StitchRow& row : rows) whole += lengthOf(row.points);
  // Two frames, 20 mm and 26 mm within.
  EXPECT_NEAR(whole, 2 * (0.26 + 0.16) + 2 * (0.248 + 0.148), 5e-4);
}

// Round an inward corner the rows of both edges go on until they meet.
TEST(Topstitching, MeetsRoundInwardCorners) {
  Outline notched;
  const Flat corners[] = {{0, 0}, {0.3, 0}, {0.3, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {0, 0.3}};
  for (std::size_t k = 0; k < 6; ++k)
    notched.edges.push_back({"e" + std::to_string(k), Curve::line(corners[k], corners[(k + 1) % 6])});
  const Pattern pattern = test::patternOf({test::pieceOf(1, notched, "one")});
  Allowances finish;
  for (const char* edge : {"e2", "e3"}) finish.topstitches[{{1}, edge}] = {0.02, 1, 0.006, 0.003, {}};
  const auto rows = stitchRows(pattern, finish);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_LT(distance(rows[0].points.back(), {0.08, 0.08}), 1e-4);
  EXPECT_LT(distance(rows[1].points.front(), {0.08, 0.08}), 1e-4);
  finish.topstitches[{{1}, "e3"}].offset = 0.01;  // another row's way is not its own
  EXPECT_LT(distance(stitchRows(pattern, finish)[0].points.back(), {0.1, 0.08}), 1e-5);
  finish.topstitches.erase({{1}, "e3"});  // alone it ends at the corner
  EXPECT_LT(distance(stitchRows(pattern, finish)[0].points.back(), {0.1, 0.08}), 1e-5);
}

// Along a circle of radius r a row lies on one of r - d; round a hole on one of r + d.
TEST(Topstitching, FollowsCurves) {
  const auto circle = [](double r, const char* name) {
    Outline ring;
    ring.edges = {{std::string(name) + "_1", Curve::arc({r, 0}, {-r, 0}, 1)},
                  {std::string(name) + "_2", Curve::arc({-r, 0}, {r, 0}, 1)}};
    return ring;
  };
  Piece piece = test::pieceOf(1, circle(0.2, "rim"), "one");
  piece.holes = {circle(0.05, "hole")};
  const Pattern pattern = test::patternOf({piece});
  Allowances finish;
  for (const char* edge : {"rim_1", "rim_2", "hole_1", "hole_2"})
    finish.topstitches[{{1}, edge}] = {0.01, 1, 0.006, 0.003, {}};
  double outer = 0, inner = 0;
  for (const StitchRow& row : stitchRows(pattern, finish)) {
    const bool rim = length(row.points.front()) > 0.1;
    for (const Flat p : row.points) EXPECT_NEAR(length(p), rim ? 0.19 : 0.06, 2e-5);
    (rim ? outer : inner) += lengthOf(row.points);
  }
  EXPECT_NEAR(outer, 2 * std::numbers::pi * 0.19, 1e-3);
  EXPECT_NEAR(inner, 2 * std::numbers::pi * 0.06, 1e-3);
}

// Along an inner line the rows lie to both sides of it.
TEST(Topstitching, LiesEvenlyBesideALine) {
  Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2), "one");
  piece.lines.push_back({"yoke", {Curve::line({0, 0.1}, {0.3, 0.1})}, {}});
  Allowances finish;
  finish.topstitches[{{1}, "yoke"}] = {0.006, 3, 0.005, 0.003, {}};
  const auto rows = stitchRows(test::patternOf({piece}), finish);
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    for (const Flat p : rows[k].points) EXPECT_NEAR(p.v, 0.095 + 0.005 * static_cast<double>(k), 1e-9);
}

// Whatever the outline: no stitch outside it, and none nearer to the edge than it was asked for.
TEST(Topstitching, KeepsWithinAnyPiece) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> far(0.08, 0.3);
  for (int round = 0; round < 40; ++round) {
    Outline star;
    std::vector<Flat> corners;
    for (int k = 0; k < 9; ++k) {
      const double turn = 2 * std::numbers::pi * k / 9;
      corners.push_back(Flat{std::cos(turn), std::sin(turn)} * far(random));
    }
    for (std::size_t k = 0; k < 9; ++k)
      star.edges.push_back({"e" + std::to_string(k), Curve::line(corners[k], corners[(k + 1) % 9])});
    const Pattern pattern = test::patternOf({test::pieceOf(1, star, "one")});
    Allowances finish;
    for (const std::size_t k : {0u, 1u, 2u, 5u})
      finish.topstitches[{{1}, "e" + std::to_string(k)}] = {0.01, 2, 0.004, 0.003, {}};
    const Ring ring = star.flattened();
    std::size_t found = 0;
    for (const StitchRow& row : stitchRows(pattern, finish)) {
      ++found;
      for (const Flat p : row.points) {
        EXPECT_TRUE(contains(ring, p) || distanceToRing(ring, p) < 1e-6);
        for (const std::size_t k : {0u, 1u, 2u, 5u})
          EXPECT_GT(distanceToSegment(corners[k], corners[(k + 1) % 9], p), 0.01 - 3e-5);
      }
    }
    EXPECT_GE(found, 2u);
  }
}

// A binding is as wide as said but at its corners, where two of them are mitred and a lone one ends at the outline.
TEST(Binding, IsMitredAtCorners) {
  Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2), "one");
  Allowances finish;
  finish.bindings[{{1}, "bottom"}] = finish.bindings[{{1}, "right"}] = {0.02, ""};
  const TrimRun run = runOf(piece, "bottom", {0.02, ""}, finish);
  ASSERT_EQ(run.edgewise.size(), run.inside.size());
  ASSERT_GT(run.edgewise.size(), 20u);
  for (std::size_t k = 0; k < run.edgewise.size(); ++k) {
    const double s = run.edgewise[k].u;
    EXPECT_NEAR(run.edgewise[k].v, 0, 1e-12);
    EXPECT_NEAR(run.inside[k].v, s < 1e-9 ? run.inside[k].v : std::min(0.02, 0.3 - s), 2e-4);
  }
  EXPECT_LT(distance(run.inside.back(), {0.3, 0}), 2e-4);
  EXPECT_NEAR(run.inside.front().v, 0.02, 1e-9);
}

// The strip for all bindings of a fabric and width is as long as their edges, four times as wide as is seen, and cut in
// lengths that half a metre of cloth gives; a cord's strip goes round it.
TEST(BiasStrips, AreAsLongAsTheirEdges) {
  const Pattern pattern = test::patternOf(
      {test::pieceOf(1, test::rectangle(0.3, 0.2), "one"), test::pieceOf(2, test::rectangle(0.9, 0.2), "two")});
  Allowances finish;
  finish.bindings[{{1}, "bottom"}] = {0.008, "silk"}, finish.bindings[{{2}, "top"}] = {0.008, "silk"};
  finish.pipings[{{1}, "left"}] = {0.004, ""};
  const auto strips = biasStrips(pattern, finish);
  ASSERT_EQ(strips.size(), 2u);
  const BiasStrip &cord = strips[0], &binding = strips[1];
  EXPECT_EQ(binding.fabric, "silk");
  EXPECT_NEAR(binding.width, 0.032, 1e-9);
  EXPECT_NEAR(binding.length, 1.2, 1e-9);
  EXPECT_EQ(binding.count, 2);
  EXPECT_NEAR(binding.cutLength, 0.62, 1e-9);
  EXPECT_NEAR(cord.length, 0.2, 1e-9);
  EXPECT_NEAR(cord.width, std::numbers::pi * 0.004 + 0.02, 5e-5);
  // Of a piece that is cut twice the strip is twice as long.
  EXPECT_NEAR(biasStrips(pattern, finish, {{{1}, 2}})[0].length, 0.4, 1e-9);
  // Its long sides lie on the bias, its ends along the grain.
  const auto piece = stripPiece(binding, 0);
  const Flat side = piece->outline.edges[0].curve.tangent(0), end = piece->outline.edges[1].curve.tangent(0);
  EXPECT_NEAR(std::fabs(cross(normalized(side), piece->grain)), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(cross(normalized(end), piece->grain), 0, 1e-9);
  EXPECT_NEAR(piece->outline.area(), binding.width * binding.cutLength, 1e-9);
}

// Divided, an edge's parts keep what was sewn to it; of parts that become one the widest stays; a mirrored copy has it.
TEST(Trims, FollowTheirEdges) {
  Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2), "one");
  Allowances finish;
  finish.topstitches[{{1}, "bottom"}] = {0.02, 2, 0.006, 0.003, 0x102030};
  finish.pipings[{{1}, "bottom"}] = {0.004, "silk"};
  finish.bindings[{{1}, "right"}] = {0.008, "silk"};
  const auto split = splitEdge(piece, "bottom", 0.5);
  ASSERT_TRUE(split);
  Pattern pattern = test::patternOf({split->piece});
  Allowances divided = finish;
  updateAllowances(divided, split->edges, pattern);
  EXPECT_EQ(divided.topstitches.size(), 2u);
  EXPECT_EQ(divided.pipings.size(), 2u);
  EXPECT_EQ(divided.bindings, finish.bindings);
  divided.pipings.rbegin()->second.thickness = 0.006;
  const auto joined = joinEdges(split->piece, "bottom");
  ASSERT_TRUE(joined);
  updateAllowances(divided, joined->edges, test::patternOf({joined->piece}));
  EXPECT_EQ(divided.topstitches, finish.topstitches);
  ASSERT_EQ(divided.pipings.size(), 1u);
  EXPECT_EQ(divided.pipings.begin()->second.thickness, 0.006);
  Piece copy = mirrored(piece);
  copy.id = {2};
  copyAllowances(finish, piece, copy, true);
  EXPECT_EQ(finish.topstitches.count({{2}, "bottom"}), 1u);
  EXPECT_EQ(finish.bindings.size(), 2u);
}

}  // namespace
}  // namespace karinui
