// Facings against closed forms and on random outlines.
#include "karinui/pattern/facing.h"

#include <gtest/gtest.h>

#include <random>

#include "support.h"

namespace karinui {
namespace {

using namespace test;

TEST(Facing, IsTheStripBesideTheEdge) {
  const Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  const auto made = facingOf(piece, {"top"}, 0.06);
  ASSERT_TRUE(made) << text(made.error().what);
  EXPECT_NEAR(made->outline.area(), 0.4 * 0.06, 1e-9);
  ASSERT_EQ(made->outline.edges.size(), 4u);
  EXPECT_EQ(findCurve(piece, "top")->length(), made->outline.edges[*made->outline.find("top")].curve.length());
  EXPECT_EQ(made->outline.edges[*made->outline.find(made->inner)].curve.kind, Curve::Kind::Line);
  // Its other edges are parts of the piece's: of the left side the first 6 cm, of the right one the last.
  for (const DividedPart::EdgePart& part : made->edges) {
    const Curve &whole = findEdge(piece, part.piece.edge)->curve,
                &own = made->outline.edges[*made->outline.find(part.own.edge)].curve;
    EXPECT_LT(distance(whole.atFraction(part.piece.from), own.start), 1e-9) << part.piece.edge;
    EXPECT_LT(distance(whole.atFraction(part.piece.to), own.end), 1e-9) << part.piece.edge;
    if (part.piece.edge != "top") {
      EXPECT_NEAR(own.length(), 0.06, 1e-9);
    }
  }
}

// A round neckline: a sector of a ring.
TEST(Facing, OfARoundNecklineIsASectorOfARing) {
  const double r = 0.08, wide = 0.3, deep = 0.05, turn = 2.0;
  const auto at = [](double radius, double angle) { return Flat{radius * std::cos(angle), radius * std::sin(angle)}; };
  Piece piece = pieceOf(1, {});
  piece.outline.edges = {{"outer", Curve::arc(at(wide, 0), at(wide, turn), std::tan(turn / 4))},
                         {"left", Curve::line(at(wide, turn), at(r, turn))},
                         {"neck", Curve::arc(at(r, turn), at(r, 0), -std::tan(turn / 4))},
                         {"right", Curve::line(at(r, 0), at(wide, 0))}};
  const auto made = facingOf(piece, {"neck"}, deep);
  ASSERT_TRUE(made) << text(made.error().what);
  EXPECT_NEAR(made->outline.area(), turn / 2 * ((r + deep) * (r + deep) - r * r), 1e-5);
  EXPECT_NEAR(made->outline.edges[*made->outline.find("inner")].curve.length(), turn * (r + deep), 1e-3);
}

// Round a corner of the piece the inner line is as far from both edges.
TEST(Facing, GoesRoundACorner) {
  const Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  const auto made = facingOf(piece, {"right", "top"}, 0.06);
  ASSERT_TRUE(made) << text(made.error().what);
  EXPECT_NEAR(made->outline.area(), 0.06 * (0.4 + 0.5 - 0.06), 2e-5);
}

TEST(Facing, IsAsDeepEverywhere) {
  std::mt19937 random(3);
  int tried = 0, places = 0, deeper = 0;
  for (int k = 0; k < 60; ++k) {
    const Piece piece = pieceOf(1, randomOutline(random, 0.3));
    const auto made = facingOf(piece, {"e0"}, 0.04);
    if (!made) continue;
    ++tried;
    const auto line = findEdge(piece, "e0")->curve.flattened(1e-6);
    const Ring ring = piece.outline.flattened(1e-6);
    for (const Flat p : made->outline.edges[*made->outline.find("inner")].curve.evenly(0, 1, 40)) {
      double away = 1;
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        away = std::min(away, distanceToSegment(line[i], line[i + 1], p));
      EXPECT_GT(away, 0.04 - 6e-4) << k;
      EXPECT_LT(away, 0.04 * 1.3) << k << ": rounded off";
      ++places, deeper += away > 0.04 + 6e-4;
      EXPECT_TRUE(contains(ring, p) || distanceToRing(ring, p) < 6e-4) << k;
    }
    EXPECT_LT(made->outline.area(), piece.outline.area());
  }
  EXPECT_GT(tried, 40);
  EXPECT_LT(deeper, places / 20);
}

// The neckline comes to a point: about it the inner line is an arc, which meets the parallels of its sides in corners.
TEST(Facing, ALineOfItsOwnHasNoCorners) {
  Piece piece = pieceOf(1, {});
  const Flat point{0, 0.30}, left{-0.07, 0.36}, right{0.07, 0.36};
  piece.outline.edges = {{"hem", Curve::line({-0.2, 0}, {0.2, 0})},
                         {"side", Curve::line({0.2, 0}, {0.2, 0.34})},
                         {"shoulder", Curve::line({0.2, 0.34}, right)},
                         {"neck", Curve::cubic(right, {0.05, 0.32}, {0.02, 0.335}, point)},
                         {"neck_2", Curve::cubic(point, {-0.02, 0.335}, {-0.05, 0.32}, left)},
                         {"shoulder_2", Curve::line(left, {-0.2, 0.34})},
                         {"side_2", Curve::line({-0.2, 0.34}, {-0.2, 0})}};
  const auto made = facingOf(piece, {"neck", "neck_2"}, 0.06);
  ASSERT_TRUE(made) << text(made.error().what);
  const std::vector<Flat> line = made->outline.edges[*made->outline.find("inner")].curve.evenly(0, 1, 200);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Flat in = line[i] - line[i - 1], out = line[i + 1] - line[i];
    EXPECT_LT(std::fabs(std::atan2(cross(in, out), dot(in, out))), 0.12) << i;
  }
}

// Facing and rest are the piece, along one line.
TEST(Facing, LeavesTheRestOfThePiece) {
  std::mt19937 random(5);
  int tried = 0;
  for (int k = 0; k < 60; ++k) {
    const Piece piece = pieceOf(1, randomOutline(random, 0.3));
    const auto strip = facingOf(piece, {"e0"}, 0.03), rest = shortenedAt(piece, {"e0"}, 0.03);
    if (!strip || !rest) continue;
    ++tried;
    EXPECT_NEAR(strip->outline.area() + rest->outline.area(), piece.outline.area(), 1e-6) << k;
    EXPECT_EQ(rest->inner, "e0");
    double whole = 0, parts = 0;
    for (const Edge& edge : piece.outline.edges) whole += edge.name == "e0" ? 0 : edge.curve.length();
    for (const DividedPart* one : {&*strip, &*rest})
      for (const auto& part : one->edges)
        if (part.piece.edge != "e0") {
          const Curve &of = findEdge(piece, part.piece.edge)->curve,
                      &own = one->outline.edges[*one->outline.find(part.own.edge)].curve;
          EXPECT_LT(distance(of.atFraction(part.piece.from), own.start), 1e-3) << k;
          EXPECT_LT(distance(of.atFraction(part.piece.to), own.end), 1e-3) << k;
          parts += own.length();
        }
    EXPECT_NEAR(parts, whole, 4e-3) << k;
  }
  EXPECT_GT(tried, 40);
}

TEST(Facing, SaysWhatIsWrong) {
  const Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  const auto why = [&](const std::vector<std::string>& run, double width) {
    const auto made = facingOf(piece, run, width);
    return made ? std::string("not refused") : text(made.error().what);
  };
  EXPECT_NE(why({"gone"}, 0.05).find("no edge"), std::string::npos);
  EXPECT_NE(why({"top", "bottom"}, 0.05).find("does not follow"), std::string::npos);
  EXPECT_NE(why({"bottom", "right", "top", "left"}, 0.05).find("leave an edge"), std::string::npos);
  EXPECT_NE(why({"left", "bottom", "right"}, 0.25).find("narrower"), std::string::npos);
}

}  // namespace
}  // namespace karinui
