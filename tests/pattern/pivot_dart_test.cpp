#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "karinui/pattern/edit.h"
#include "support.h"

namespace karinui {
namespace {

using namespace test;

// A rectangle with a dart in its top edge, from (du, 0.4) down.
Piece darted(Flat tip, double at, double width) {
  Piece piece;
  piece.id = {1}, piece.name = "front", piece.outline = rectangle(0.3, 0.4);
  return addDart(piece, "top", at, width, tip, "dart")->edited.piece;
}
double lengthOf(const Piece& piece, const char* edge) { return findEdge(piece, edge)->curve.length(); }

TEST(PivotDart, KeepsAreaLengthsAndTheDart) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 60; ++k) {
    const Flat tip{0.1 + 0.1 * share(random), 0.1 + 0.15 * share(random)};
    const Piece piece = darted(tip, 1 - tip.u / 0.3, 0.01 + 0.03 * share(random));  // the legs are alike
    const char* edges[] = {"left", "right", "bottom"};
    const std::string edge = edges[k % 3];
    const auto moved = pivotDart(piece, "dart", edge, 0.2 + 0.5 * share(random));
    ASSERT_TRUE(moved) << text(moved.error().what);
    const Piece& now = moved->piece;
    EXPECT_EQ(now.outline.edges.size(), piece.outline.edges.size() + 1);
    EXPECT_NEAR(lengthOf(now, edge.c_str()) + lengthOf(now, (edge + "_2").c_str()), lengthOf(piece, edge.c_str()),
                1e-9);
    for (const char* other : {"left", "right", "bottom", "top", "top_2"})
      if (other != edge) {
        EXPECT_NEAR(lengthOf(now, other), lengthOf(piece, other), 1e-9) << other;
      }
    EXPECT_NEAR(lengthOf(now, "dart"), lengthOf(now, "dart_2"), 1e-9);
    // Cloth is neither lost nor gained: both wedges are outside the paper.
    EXPECT_NEAR(now.outline.area(), piece.outline.area(), 1e-9);
    // The wedge has the same angle at the same point.
    const auto angle = [](const Piece& p) {
      const Curve &in = findEdge(p, "dart")->curve, &out = findEdge(p, "dart_2")->curve;
      return std::acos(std::clamp(dot(normalized(in.start - in.end), normalized(out.end - out.start)), -1.0, 1.0));
    };
    EXPECT_NEAR(angle(now), angle(piece), 1e-9);
    EXPECT_LT(distance(findEdge(now, "dart")->curve.end, tip), 1e-9);
  }
}

TEST(PivotDart, TakesDrillHolesLinesAndTheFormAlong) {
  Piece piece = darted({0.15, 0.2}, 0.5, 0.04);
  piece.marks = {{"fixed", "", 0, {0.25, 0.1}}, {"goes", "", 0, {0.05, 0.35}}};
  piece.lines = {{"goes", {Curve::line({0.02, 0.3}, {0.06, 0.3})}, {}},
                 {"stays", {Curve::line({0.2, 0.1}, {0.25, 0.1})}, {}}};
  const auto moved = pivotDart(piece, "dart", "left", 0.5);  // the upper left corner turns
  ASSERT_TRUE(moved) << text(moved.error().what);
  const Piece& now = moved->piece;
  EXPECT_EQ(now.marks[0].place, piece.marks[0].place);
  const double angle = 2 * std::atan(0.02 / 0.2);
  const Flat d = piece.marks[1].place - Flat{0.15, 0.2};
  const Flat turned = Flat{0.15, 0.2} + Flat{d.u * std::cos(angle) + d.v * std::sin(angle),
                                             -d.u * std::sin(angle) + d.v * std::cos(angle)};
  EXPECT_LT(distance(now.marks[1].place, turned), 1e-9);  // clockwise, towards the closed dart
  EXPECT_NEAR(now.lines[0].curves[0].length(), 0.04, 1e-12);
  EXPECT_NE(now.lines[0].curves[0].start, piece.lines[0].curves[0].start);
  EXPECT_EQ(now.lines[1], piece.lines[1]);
}

TEST(PivotDart, SaysWhatIsWrong) {
  const auto why = [](const auto& result) { return result ? std::string("not refused") : text(result.error().what); };
  Piece lopsided;
  lopsided.outline = polygon({{0, 0}, {0.3, 0}, {0.3, 0.4}, {0.2, 0.4}, {0.15, 0.2}, {0.12, 0.4}, {0, 0.4}});
  EXPECT_NE(why(pivotDart(lopsided, "e3", "e6", 0.5)).find("make them alike"), std::string::npos);
  const Piece piece = darted({0.15, 0.2}, 0.5, 0.04);
  EXPECT_NE(why(pivotDart(piece, "dart", "dart_2", 0.5)).find("another edge"), std::string::npos);
  EXPECT_NE(why(pivotDart(piece, "dart", "gone", 0.5)).find("no edge"), std::string::npos);
  EXPECT_NE(why(pivotDart(piece, "dart", "left", 0.001)).find("1 mm from both ends"), std::string::npos);
  // Which piece, which dart, and where: of many darts one has to be found.
  using testing::AllOf, testing::HasSubstr;
  lopsided.name = "bodice";
  EXPECT_THAT(why(pivotDart(lopsided, "e3", "e6", 0.5)), AllOf(HasSubstr("bodice"), HasSubstr("e3"), HasSubstr("e4")));
  Piece hooked;
  hooked.name = "bodice";
  hooked.outline = polygon({{0, 0},
                            {0.3, 0},
                            {0.3, 0.15},
                            {0.2, 0.15},
                            {0.2, 0.25},
                            {0.3, 0.25},
                            {0.3, 0.4},
                            {0.17, 0.4},
                            {0.15, 0.2},
                            {0.13, 0.4},
                            {0, 0.4}});
  EXPECT_THAT(why(pivotDart(hooked, "e7", "e1", 0.9)),
              AllOf(HasSubstr("bodice"), HasSubstr("e1@0.9"), HasSubstr("e7"), HasSubstr("15.0, 20.0")));
}

}  // namespace
}  // namespace karinui
