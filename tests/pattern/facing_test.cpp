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
  for (const Facing::Part& part : made->parts) {
    const Curve &whole = findEdge(piece, part.piece.edge)->curve,
                &own = made->outline.edges[*made->outline.find(part.facing.edge)].curve;
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
  int tried = 0;
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
      EXPECT_NEAR(away, 0.04, 6e-4) << k;
      EXPECT_TRUE(contains(ring, p) || distanceToRing(ring, p) < 6e-4) << k;
    }
    EXPECT_LT(made->outline.area(), piece.outline.area());
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
