// A dart moved along its edge as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "karinui/pattern/edit.h"

namespace karinui {
namespace {

Piece skirtPanel(bool curved) {
  Piece piece;
  piece.id = {1};
  piece.name = "panel";
  const auto edge = [](const char* name, Curve curve) { return Edge{name, std::move(curve)}; };
  piece.outline.edges = {edge("hem", Curve::line({0, 0}, {0.25, 0})), edge("side", Curve::line({0.25, 0}, {0.24, 0.6})),
                         edge("waist", curved ? Curve::cubic({0.24, 0.6}, {0.16, 0.585}, {0.08, 0.58}, {0, 0.58})
                                              : Curve::line({0.24, 0.6}, {0, 0.6})),
                         edge("centre", Curve::line({0, curved ? 0.58 : 0.6}, {0, 0}))};
  auto dart = addDart(piece, "waist", 0.5, 0.02, {0.12, 0.46}, "dart");
  return dart ? dart->edited.piece : piece;
}
const Curve& edgeOf(const Piece& piece, const char* name) {
  return piece.outline.edges[*piece.outline.find(name)].curve;
}
double angleAtTip(const Piece& piece) {
  const Curve &to = edgeOf(piece, "dart"), &back = edgeOf(piece, "dart_2");
  return std::fabs(angleFrom(to.start - to.end, back.end - back.start));
}

class ShiftDart : public testing::TestWithParam<std::tuple<bool, double>> {};

TEST_P(ShiftDart, KeepsItsLegsItsAngleAndTheSeam) {
  const auto [curved, by] = GetParam();
  const Piece before = skirtPanel(curved);
  ASSERT_TRUE(before.outline.find("dart"));
  const auto moved = shiftDart(before, "dart", by);
  ASSERT_TRUE(moved) << text(moved.error().what);
  const Piece& after = moved->piece;
  const auto seam = [](const Piece& piece) {
    return edgeOf(piece, "waist").length() + edgeOf(piece, "waist_2").length();
  };
  for (const char* leg : {"dart", "dart_2"})
    EXPECT_NEAR(edgeOf(after, leg).length(), edgeOf(before, leg).length(), 1e-9) << leg;
  EXPECT_NEAR(angleAtTip(after), angleAtTip(before), 1e-9);
  EXPECT_NEAR(seam(after), seam(before), 5e-5);
  EXPECT_NEAR(edgeOf(after, "waist").length(), edgeOf(before, "waist").length() + by, 3e-4);
  const Flat step = edgeOf(after, "dart").end - edgeOf(before, "dart").end;
  EXPECT_NEAR(length(step), std::fabs(by), 4e-4);
  EXPECT_LT(step.u * by, 0) << "the waist runs from the side to the centre";
  for (const char* other : {"hem", "side", "centre"}) EXPECT_EQ(edgeOf(after, other), edgeOf(before, other)) << other;
}
// Trued: with the dart closed the waist is one line, and the two parts meet the dart's sides square.
TEST(ShiftDart, AlongATruedEdge) {
  Piece before = skirtPanel(false);
  auto& edges = before.outline.edges;
  const std::size_t k = *before.outline.find("waist"), m = *before.outline.find("waist_2");
  edges[k].curve = Curve::cubic({0.24, 0.6}, {0.2, 0.595}, {0.16, edges[k].curve.end.v - 0.002}, edges[k].curve.end);
  edges[m].curve =
      Curve::cubic(edges[m].curve.start, {0.08, edges[m].curve.start.v - 0.002}, {0.04, 0.597}, edges[m].curve.end);
  const auto moved = shiftDart(before, "dart", -0.03);
  ASSERT_TRUE(moved) << text(moved.error().what);
  const auto seam = [](const Piece& piece) {
    return edgeOf(piece, "waist").length() + edgeOf(piece, "waist_2").length();
  };
  EXPECT_NEAR(seam(moved->piece), seam(before), 5e-5);
  EXPECT_NEAR(angleAtTip(moved->piece), angleAtTip(before), 1e-9);
  EXPECT_NEAR(edgeOf(moved->piece, "dart_2").length(), edgeOf(before, "dart_2").length(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Ways, ShiftDart, testing::Combine(testing::Bool(), testing::Values(0.02, -0.02, 0.05, -0.07)));

TEST(ShiftDart, NotchesStayWhereTheyAre) {
  Piece before = skirtPanel(false);
  before.marks = {{"near", "waist_2", 0.1, {}}, {"far", "waist", 0.5, {}}, {"tip", "", 0, {0.12, 0.46}}};
  const auto moved = shiftDart(before, "dart", 0.03);
  ASSERT_TRUE(moved);
  const Piece& after = moved->piece;
  ASSERT_EQ(after.marks.size(), 3u);
  EXPECT_EQ(after.marks[0].edge, "waist") << "the dart went past it";
  const double whole = edgeOf(after, "waist").length(), was = edgeOf(before, "waist").length();
  EXPECT_NEAR(after.marks[0].fraction * whole, was + 0.1 * edgeOf(before, "waist_2").length(), 1e-5);
  EXPECT_NEAR(after.marks[1].fraction * whole, 0.5 * was, 1e-5);
  EXPECT_NEAR(distance(after.marks[2].place, edgeOf(after, "dart").end), 0, 1e-9) << "it marks the point";
}

// A waist that dips between its darts is a hair longer once the dart stands elsewhere; nobody sews so fine.
TEST(ShiftDart, AlongAWavingEdge) {
  Piece before = skirtPanel(false);
  auto& edges = before.outline.edges;
  const std::size_t k = *before.outline.find("waist"), m = *before.outline.find("waist_2");
  edges[k].curve = Curve::cubic(edges[k].curve.start, {0.2, 0.6}, {0.17, 0.598}, edges[k].curve.end);
  edges[m].curve = Curve::cubic(edges[m].curve.start, {0.07, 0.598}, {0.04, 0.6}, edges[m].curve.end);
  const auto seam = [](const Piece& piece) {
    return edgeOf(piece, "waist").length() + edgeOf(piece, "waist_2").length();
  };
  for (const double by : {0.03, -0.03, 0.06, -0.06}) {
    const auto moved = shiftDart(before, "dart", by);
    ASSERT_TRUE(moved) << by << " " << text(moved.error().what);
    EXPECT_NEAR(seam(moved->piece), seam(before), 5e-4) << by;
    EXPECT_NEAR(angleAtTip(moved->piece), angleAtTip(before), 1e-9) << by;
  }
}

TEST(ShiftDart, NotBeyondTheEdge) {
  const auto moved = shiftDart(skirtPanel(false), "dart", 0.2);
  ASSERT_FALSE(moved);
  EXPECT_THAT(text(moved.error().what), testing::HasSubstr("cannot be moved 200.0 mm"));
  Piece corner = skirtPanel(false);
  const auto none = shiftDart(corner, "hem", 0.01);
  EXPECT_FALSE(none);
}

}  // namespace
}  // namespace karinui
