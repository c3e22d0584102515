// Reshaping the paper by pulling the cloth in space.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/design/drawing.h"
#include "karinui/pattern/lattice.h"

namespace karinui {
namespace {

// A panel standing in space as `place` says.
Document panel(const std::function<Vec3(Flat)>& place) {
  auto piece = std::make_shared<Piece>();
  piece->id = madeBy<PieceId>(1, 0);
  piece->name = "panel";
  piece->outline =
      *checked(*parseOutline("M 0 0; hem L 300 0; side C 330 100 320 300 300 400; waist L 0 400; centre L 0 0"));
  Document document;
  document.operations = 1;
  document.pattern.pieces[piece->id] = piece;
  const auto laid = lay(document.pattern, 0.01);
  const Lattice& lattice = *laid->lattices.at(piece->id);
  auto form = std::make_shared<Form>();
  form->flat = lattice.nodes;
  form->faces = lattice.faces;
  for (Flat p : lattice.nodes) form->space.push_back(place(p));
  piece->form = form;
  return document;
}
Vec3 plane(Flat p) { return {p.u, p.v, 0.2}; }
Vec3 cylinder(Flat p) { return {0.15 * std::sin(p.u / 0.15), p.v, 0.15 * std::cos(p.u / 0.15)}; }
Vec3 cone(Flat p) {  // unrolled about the point (0, 1)
  const double r = std::hypot(p.u, 1 - p.v), a = std::atan2(p.u, 1 - p.v) / 0.25;
  return {0.25 * r * std::sin(a), -r * std::sqrt(1 - 0.0625), 0.25 * r * std::cos(a)};
}
const PieceId kPanel = madeBy<PieceId>(1, 0);

TEST(Reshape, NoPullGivesTheOldOutline) {
  for (const auto& shape : {plane, cylinder, cone}) {
    const Document document = panel(shape);
    const auto made = reshaped(document, kPanel, {}, Length{0.12}, Token());
    ASSERT_TRUE(made) << text(made.error().what);
    EXPECT_EQ(made->outline, document.find(kPanel)->outline);
  }
}

TEST(Reshape, APulledHemGrowsThereAndNowhereElse) {
  for (const auto& shape : {plane, cylinder}) {
    const Document document = panel(shape);
    const Outline before = document.find(kPanel)->outline;
    const ReshapePull pull{{0.15, 0}, {0, -0.04, 0}};
    const auto made = reshaped(document, kPanel, std::span(&pull, 1), Length{0.12}, Token());
    ASSERT_TRUE(made) << text(made.error().what);
    const Outline& after = made->outline;
    for (const char* same : {"side", "waist", "centre"})
      EXPECT_EQ(after.edges[*after.find(same)], before.edges[*before.find(same)]) << same;
    const Curve hem = after.edges[*after.find("hem")].curve;
    EXPECT_EQ(hem.start, (Flat{0, 0}));
    EXPECT_EQ(hem.end, (Flat{0.3, 0}));
    double lowest = 0;
    for (Flat p : hem.flattened()) lowest = std::fmin(lowest, p.v);
    EXPECT_LT(lowest, -0.02);
    EXPECT_GT(lowest, -0.05);
  }
}

TEST(Reshape, AStraightEdgePulledEvenlyStaysStraight) {
  const Document document = panel(plane);
  std::vector<ReshapePull> pulls;
  for (int i = -4; i <= 34; ++i) pulls.push_back({{0.01 * i, 0}, {0, -0.03, 0}});
  const auto made = reshaped(document, kPanel, pulls, Length{0.2}, Token());
  ASSERT_TRUE(made) << text(made.error().what);
  const Curve hem = made->outline.edges[*made->outline.find("hem")].curve;
  EXPECT_EQ(hem.kind, Curve::Kind::Line);
  EXPECT_NEAR(hem.start.v, -0.03, 0.004);
  EXPECT_NEAR(hem.end.v, -0.03, 0.004);
}

}  // namespace
}  // namespace karinui
