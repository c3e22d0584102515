#include <gtest/gtest.h>

#include <random>

#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/markings.h"
#include "support.h"

namespace karinui {
namespace {

// A panel with a dart of two points, sewn.
Pattern doubleDarted(double width = 0.03, double at = 0.5) {
  const auto made =
      addDoubleDart(test::pieceOf(1, test::rectangle(0.3, 0.5)), {0.15, 0.4}, {0.15, 0.1}, width, at, "dart", {});
  Pattern pattern = test::patternOf({made->piece});
  const auto& e = made->edges;
  pattern.seams[{9}] = {{9}, "", {{{1}, e[0], 0, 1}, {{1}, e[1], 0, 1}}, {{{1}, e[2], 0, 1}, {{1}, e[3], 0, 1}}};
  return pattern;
}

TEST(DoubleDart, IsAKiteWhoseSidesAreAlike) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 200; ++k) {
    const Flat from{0.1 + 0.1 * share(random), 0.3 + 0.15 * share(random)}, to{0.1 + 0.1 * share(random), 0.1};
    const double width = 0.01 + 0.04 * share(random), at = 0.2 + 0.6 * share(random);
    const auto made = addDoubleDart(test::pieceOf(1, test::rectangle(0.3, 0.5)), from, to, width, at, "dart", {});
    ASSERT_TRUE(made) << text(made.error().what);
    const Outline& kite = made->piece.holes.at(0);
    EXPECT_NEAR(kite.area(), 0.5 * width * distance(from, to), 1e-9);
    const auto along = [&](std::size_t edge) { return findEdge(made->piece, made->edges[edge])->curve.length(); };
    EXPECT_NEAR(along(0), along(3), 1e-12);
    EXPECT_NEAR(along(1), along(2), 1e-12);
    EXPECT_LT(distance(findEdge(made->piece, made->edges[0])->curve.start, from), 1e-12);
    EXPECT_LT(distance(findEdge(made->piece, made->edges[1])->curve.end, to), 1e-12);
  }
}

TEST(DoubleDart, IsMarkedAndNotCutUnlessItIsWide) {
  const Pattern pattern = doubleDarted(0.03, 0.25);
  const auto darts = doubleDartsOf(pattern);
  ASSERT_EQ(darts.size(), 1u);
  EXPECT_LT(distance(darts[0].from, {0.15, 0.4}), 1e-12);
  EXPECT_LT(distance(darts[0].to, {0.15, 0.1}), 1e-12);
  EXPECT_LT(distance(lerp(darts[0].left, darts[0].right, 0.5), {0.15, 0.325}), 1e-9);
  EXPECT_NEAR(distance(darts[0].left, darts[0].right), 0.03, 1e-9);
  const Piece& piece = *pattern.pieces.at({1});
  EXPECT_EQ(foldedHoles(pattern, {1}), std::set<std::size_t>{0});
  EXPECT_TRUE(cutLines(piece, AllowancePlan(pattern, {}))->holes.empty());
  EXPECT_EQ(drillHoles(pattern, piece).size(), 4u) << "at both points and beside its widest place";
  for (const Flat hole : drillHoles(pattern, piece)) EXPECT_TRUE(contains(piece.holes[0].flattened(), hole));
  EXPECT_TRUE(notchPlaces(pattern).empty()) << "no notch within a piece";

  const Pattern wide = doubleDarted(0.06);
  EXPECT_TRUE(foldedHoles(wide, {1}).empty());
  EXPECT_EQ(cutLines(*wide.pieces.at({1}), AllowancePlan(wide, {}))->holes.size(), 1u);
  Pattern unsewn = doubleDarted();
  unsewn.seams.clear();
  EXPECT_TRUE(doubleDartsOf(unsewn).empty()) << "a hole that nothing closes is a hole";
}

TEST(DoubleDart, IsRefusedWhereItWouldNotLie) {
  const Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.5));
  const auto why = [](const Result<DoubleDartedPiece>& made) { return made ? std::string() : text(made.error().what); };
  const auto made = [&](Flat from, Flat to, double width, double at = 0.5) {
    return why(addDoubleDart(piece, from, to, width, at, "dart", {}));
  };
  EXPECT_EQ(made({0.1, 0.4}, {0.1, 0.1}, 0.03), "");
  EXPECT_NE(made({0.1, 0.4}, {0.1, 0.6}, 0.03).find("5 mm from its edges"), std::string::npos);
  EXPECT_NE(made({0.01, 0.4}, {0.01, 0.1}, 0.03).find("5 mm from its edges"), std::string::npos);
  EXPECT_NE(made({0.1, 0.4}, {0.1, 0.39}, 0.03).find("no wider than it is long"), std::string::npos);
  EXPECT_NE(made({0.1, 0.4}, {0.1, 0.1}, 0.03, 1).find("0.95"), std::string::npos);
  EXPECT_NE(made({0.1, NAN}, {0.1, 0.1}, 0.03), "");
  const Pattern has = doubleDarted();
  EXPECT_NE(why(addDoubleDart(*has.pieces.at({1}), {0.1, 0.2}, {0.2, 0.22}, 0.01, 0.5, "dart", {})).find("hole"),
            std::string::npos);
  Piece lined = piece;
  lined.lines.push_back({"fold", {Curve::line({0, 0.25}, {0.3, 0.25})}, Crease{1.57}});
  EXPECT_NE(why(addDoubleDart(lined, {0.1, 0.4}, {0.1, 0.1}, 0.03, 0.5, "dart", {"fold"})).find("“fold”"),
            std::string::npos);
}

}  // namespace
}  // namespace karinui
