// What is turned back along a line is cut as the mirror image of what it comes to lie on.
#include "karinui/pattern/turn_back.h"

#include <gmock/gmock.h>

#include "pattern/support.h"

namespace karinui {
namespace {

constexpr double kSame = 1e-6;

// A sleeve below the elbow, 300 mm wide above and 200 mm at the hem, with a line 60 mm above that.
Piece sleeve() {
  Piece piece = test::pieceOf(1, test::polygon({{-0.1, 0}, {0.1, 0}, {0.15, 0.4}, {-0.15, 0.4}}));
  const char* names[] = {"hem", "right", "top", "left"};
  for (int k = 0; k < 4; ++k) piece.outline.edges[static_cast<std::size_t>(k)].name = names[k];
  piece.lines.push_back({"turn", {Curve::line({-0.1075, 0.06}, {0.1075, 0.06})}, {}});
  return piece;
}
bool below(Flat place) { return place.v < 0.06; }

TEST(TurnBack, ANarrowingSleeveWidensAgainBeyondTheLine) {
  const auto flared = flaredBeyond(sleeve(), "turn", below);
  ASSERT_TRUE(flared) << text(flared.error().what);
  EXPECT_NEAR(flared->wider, 0.03, kSame);  // 230 mm, as the sleeve is 60 mm above the line
  const Outline& outline = flared->edited.piece.outline;
  std::vector<std::string> names;
  for (const Edge& edge : outline.edges) names.push_back(edge.name);
  EXPECT_THAT(names, testing::ElementsAre("hem", "right", "right_2", "top", "left", "left_2"));
  const Curve& hem = outline.edges[0].curve;
  EXPECT_NEAR(distance(hem.start, {-0.115, 0}), 0, kSame);
  EXPECT_NEAR(distance(hem.end, {0.115, 0}), 0, kSame);
  // Every place beyond lies on the piece's edge when it is turned back.
  for (const double f : {0.1, 0.5, 0.9}) {
    const Flat place = outline.edges[1].curve.atFraction(f), back{place.u, 0.12 - place.v};
    EXPECT_NEAR(back.u, 0.1 + 0.05 * back.v / 0.4, kSame);
  }
  // What was sewn to the whole side is sewn to both its parts.
  const auto& parts = flared->edited.edges.at({PieceId{1}, "right"});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].to, 0.15, 1e-4);
}

TEST(TurnBack, WhatIsItsMirrorImageAlreadyStays) {
  const auto once = flaredBeyond(sleeve(), "turn", below);
  const auto twice = flaredBeyond(once->edited.piece, "turn", below);
  ASSERT_TRUE(twice);
  EXPECT_NEAR(twice->wider, 0, kSame);
  EXPECT_TRUE(twice->edited.edges.empty());
  ASSERT_EQ(twice->edited.piece.outline.edges.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(
        distance(twice->edited.piece.outline.edges[k].curve.start, once->edited.piece.outline.edges[k].curve.start), 0,
        kSame);
}

TEST(TurnBack, CurvedSidesAndAnEndOfSeveralEdgesAreFollowed) {
  Piece piece = sleeve();
  auto& edges = piece.outline.edges;
  edges[1].curve = Curve::cubic({0.1, 0}, {0.1, 0.15}, {0.13, 0.3}, {0.15, 0.4});
  edges[0].curve = Curve::line({-0.1, 0}, {0, -0.01});
  edges.insert(edges.begin() + 1, {"hem_2", Curve::line({0, -0.01}, {0.1, 0})});
  piece.lines[0].curves = {Curve::line({-0.1075, 0.06}, {0.102, 0.06})};
  const auto flared = flaredBeyond(piece, "turn", below);
  ASSERT_TRUE(flared) << text(flared.error().what);
  const Outline& outline = flared->edited.piece.outline;
  ASSERT_TRUE(checked(outline));
  const Curve& beyond = outline.edges[2].curve;  // right, from the hem to the line
  const Curve& before = outline.edges[3].curve;
  for (const double f : {0.2, 0.6}) {
    const Flat place = beyond.atFraction(1 - f), image = before.atFraction(f * beyond.length() / before.length());
    EXPECT_NEAR(place.u, image.u, 1e-4);
    EXPECT_NEAR(0.12 - place.v, image.v, 1e-4);
  }
}

TEST(TurnBack, RefusesWhatHasNoMirrorImage) {
  Piece curved = sleeve();
  curved.lines[0].curves = {Curve::cubic({-0.1075, 0.06}, {-0.05, 0.08}, {0.05, 0.08}, {0.1075, 0.06})};
  EXPECT_THAT(text(flaredBeyond(curved, "turn", below).error().what), testing::HasSubstr("is curved"));
  Piece deep = sleeve();
  deep.lines[0].curves = {Curve::line({-0.14, 0.32}, {0.14, 0.32})};
  const auto far = [](Flat place) { return place.v < 0.32; };
  EXPECT_THAT(text(flaredBeyond(deep, "turn", far).error().what), testing::HasSubstr("deeper than"));
  Piece pointed = test::pieceOf(1, test::polygon({{0, -0.1}, {0.1, 0.2}, {-0.1, 0.2}}));
  pointed.lines.push_back({"turn", {Curve::line({-0.04, 0.02}, {0.04, 0.02})}, {}});
  EXPECT_THAT(text(flaredBeyond(pointed, "turn", [](Flat p) { return p.v < 0.02; }).error().what),
              testing::HasSubstr("two sides"));
  EXPECT_THAT(text(flaredBeyond(sleeve(), "gone", below).error().what), testing::HasSubstr("no line"));
}

}  // namespace
}  // namespace karinui
