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
    const auto made = reshaped(document, kPanel, {}, Length{0.12}, Choice::Auto, Token());
    ASSERT_TRUE(made) << text(made.error().what);
    EXPECT_EQ(made->outline, document.find(kPanel)->outline);
  }
}

TEST(Reshape, APulledHemGrowsThereAndNowhereElse) {
  for (const auto& shape : {plane, cylinder}) {
    const Document document = panel(shape);
    const Outline before = document.find(kPanel)->outline;
    const ReshapePull pull{{0.15, 0}, {0, -0.04, 0}};
    const auto made = reshaped(document, kPanel, std::span(&pull, 1), Length{0.12}, Choice::Auto, Token());
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
  const auto made = reshaped(document, kPanel, pulls, Length{0.2}, Choice::Auto, Token());
  ASSERT_TRUE(made) << text(made.error().what);
  const Curve hem = made->outline.edges[*made->outline.find("hem")].curve;
  EXPECT_EQ(hem.kind, Curve::Kind::Line);
  EXPECT_NEAR(hem.start.v, -0.03, 2e-4);
  EXPECT_NEAR(hem.end.v, -0.03, 2e-4);
}

// A drafted skirt panel: straight sides, a hollow waist, square at the hem.
Document skirt(const std::string& outline) {
  DocumentFile file = DocumentFile::inMemory();
  Workroom room;
  EXPECT_TRUE(room.play(file, "piece name=skirt outline=\"" + outline + "\"\n"));
  return file.document();
}
const char* const kSkirtOutline = "M 0 0; hem L 400 0; side L 400 500; waist C 280 470 120 485 0 500; centre L 0 0";
ReshapePiece pulledAt(const Document& document, std::vector<ReshapePull> pulls, double within,
                      Choice symmetric = Choice::No) {
  const auto made = reshaped(document, kPanel, pulls, Length{within}, symmetric, Token());
  EXPECT_TRUE(made) << (made ? "" : text(made.error().what));
  return made ? *made : ReshapePiece{};
}
double turnAt(const Outline& outline, std::size_t k) {  // where edge k begins
  const std::size_t n = outline.edges.size();
  const Flat in = outline.edges[(k + n - 1) % n].curve.tangent(1), out = outline.edges[k].curve.tangent(0);
  return std::atan2(cross(in, out), dot(in, out));
}

TEST(Reshape, WhatThePullDoesNotReachStaysToTheLastBit) {
  for (const auto& shape : {plane, cylinder, cone}) {
    const Document document = panel(shape);
    const Outline before = document.find(kPanel)->outline;
    for (const Flat at : {Flat{0.3, 0}, Flat{0.15, 0}, Flat{0.32, 0.2}, Flat{0, 0.4}, Flat{0.15, 0.2}}) {
      const double within = 0.08;
      const Outline after = pulledAt(document, {{at, {0.01, -0.03, 0.01}}}, within).outline;
      ASSERT_EQ(after.edges.size(), before.edges.size());
      for (std::size_t k = 0; k < before.edges.size(); ++k) {
        const Curve &was = before.edges[k].curve, &is = after.edges[k].curve;
        if (distance(was.start, at) > within) {
          EXPECT_EQ(is.start, was.start) << before.edges[k].name;
        }
        if (is.kind == Curve::Kind::Line) continue;  // swings as a whole
        for (int i = 0; i <= 100; ++i)
          if (const Flat p = was.atFraction(i / 100.0); distance(p, at) > within + 0.01) {
            EXPECT_LT(distanceToRing(after.flattened(1e-7), p), 1e-6) << before.edges[k].name;
          }
      }
    }
  }
}

TEST(Reshape, StraightEdgesSwingAboutTheirFarEndsWhenACornerIsPulled) {
  const Document document = skirt(kSkirtOutline);
  const Outline after = pulledAt(document, {{{0.4, 0}, {0.03, 0, 0}}}, 0.12).outline;
  for (const char* name : {"hem", "side", "centre"})
    EXPECT_EQ(after.edges[*after.find(name)].curve.kind, Curve::Kind::Line) << name;
  EXPECT_NEAR(after.edges[1].curve.start.u, 0.43, 5e-4);
  EXPECT_NEAR(after.edges[1].curve.start.v, 0, 5e-4);
  EXPECT_EQ(after.edges[1].curve.end, (Flat{0.4, 0.5}));
  EXPECT_EQ(after.edges[0].curve.start, (Flat{0, 0}));
  EXPECT_EQ(after.edges[2], document.find(kPanel)->outline.edges[2]);
}

TEST(Reshape, RightAnglesStayRight) {
  const Document document = skirt(kSkirtOutline);
  const double right = std::numbers::pi / 2;
  // The hem pulled down in its middle, so far round that its corners' surroundings come along a little.
  const Outline belly = pulledAt(document, {{{0.2, 0}, {0, -0.03, 0}}}, 0.25).outline;
  EXPECT_NE(belly.edges[0].curve.kind, Curve::Kind::Line);
  EXPECT_NEAR(turnAt(belly, 0), right, 0.005);
  EXPECT_NEAR(turnAt(belly, 1), right, 0.005);
  // The whole hem pulled down evenly: longer, still square, still straight.
  std::vector<ReshapePull> pulls;
  for (int i = -4; i <= 44; ++i) pulls.push_back({{0.01 * i, 0}, {0, -0.05, 0}});
  const Outline longer = pulledAt(document, pulls, 0.2).outline;
  EXPECT_EQ(longer.edges[0].curve.kind, Curve::Kind::Line);
  EXPECT_NEAR(distance(longer.edges[0].curve.start, {0, -0.05}), 0, 2e-4);
  EXPECT_NEAR(distance(longer.edges[0].curve.end, {0.4, -0.05}), 0, 2e-4);
  EXPECT_NEAR(turnAt(longer, 0), right, 1e-3);
  EXPECT_NEAR(turnAt(longer, 1), right, 1e-3);
  // The waist raised at the side: its other angle is kept, whatever it was.
  const Outline raised = pulledAt(document, {{{0.4, 0.5}, {0, 0.03, 0}}}, 0.1).outline;
  EXPECT_NEAR(turnAt(raised, 2), turnAt(document.find(kPanel)->outline, 2), 0.005);
  EXPECT_EQ(raised.edges[1].curve.kind, Curve::Kind::Line);
}

TEST(Reshape, ASymmetricPieceIsPulledOnBothHalves) {
  const Document document = skirt(
      "M -200 0; hem L 200 0; side_right C 230 150 210 400 180 500; waist C 80 470 -80 470 -180 500; side_left C -210 "
      "400 -230 150 -200 0");
  const ReshapePiece made = pulledAt(document, {{{0.2, 0}, {0.03, -0.01, 0.005}}}, 0.12, Choice::Auto);
  EXPECT_EQ(made.symmetric, Choice::Yes);
  ASSERT_EQ(made.at.size(), 2u);
  EXPECT_NEAR(distance(made.at[1], {-0.2, 0}), 0, 1e-12);
  EXPECT_NEAR(distance(made.by[1], {-0.03, -0.01, 0.005}), 0, 1e-9);
  const Outline& after = made.outline;
  EXPECT_NEAR(after.edges[1].curve.start.u, 0.23, 1e-3);
  for (std::size_t k = 0; k < after.edges.size(); ++k) {
    const Curve& image = after.edges[(8 - k) % 4].curve;
    for (const double f : {0.0, 0.2, 0.5, 1.0}) {
      const Flat p = after.edges[k].curve.atFraction(f), q = image.atFraction(1 - f);
      EXPECT_LT(distance(p, {-q.u, q.v}), 1e-12) << after.edges[k].name;
    }
  }
  // A pull at the centre keeps it symmetric too; asked not to, only one half changes.
  const ReshapePiece atCentre = pulledAt(document, {{{0, 0}, {0.01, -0.03, 0}}}, 0.12, Choice::Yes);
  ASSERT_EQ(atCentre.by.size(), 1u) << "a place on the centre is its own image";
  EXPECT_NEAR(distance(atCentre.by[0], {0, -0.03, 0}), 0, 1e-9);
  const Outline& centre = atCentre.outline;
  EXPECT_NEAR(centre.edges[0].curve.atFraction(0.5).u, 0, 1e-12);
  EXPECT_LT(centre.edges[0].curve.atFraction(0.5).v, -0.02);
  const auto halves = centre.edges[0].curve.parts();
  EXPECT_NEAR(halves[halves.size() / 2].tangent(0).v, 0, 1e-12) << "no kink in the middle";
  EXPECT_LE(centre.edges[0].curve.parts().size(), 10u) << "few cubics: no ripples";
  const ReshapePiece one = pulledAt(document, {{{0.2, 0}, {0.03, -0.01, 0}}}, 0.12, Choice::No);
  EXPECT_EQ(one.at.size(), 1u);
  EXPECT_EQ(one.outline.edges[3], document.find(kPanel)->outline.edges[3]);
  const ReshapePull pull{{0.4, 0}, {0.03, 0, 0}};
  EXPECT_FALSE(reshaped(skirt(kSkirtOutline), kPanel, std::span(&pull, 1), Length{0.1}, Choice::Yes, Token()));
}

TEST(Reshape, NotchesAndPartSeamsStayOnTheirCloth) {
  DocumentFile file = DocumentFile::inMemory();
  Workroom room;
  ASSERT_TRUE(room.play(file, std::string("piece name=a outline=\"") + kSkirtOutline +
                                  "\"\npiece name=b outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; "
                                  "centre L 0 0\"\nnotch edge=a.hem at=0.9 name=n\nsew a=a.hem@0.8:1 b=b.hem@0:0.2\n"));
  const auto placeOf = [&](double fraction) {
    const Outline& outline = file.document().pieceNamed("a")->outline;
    return outline.edges[*outline.find("hem")].curve.atFraction(fraction);
  };
  const Flat notch = placeOf(0.9), from = placeOf(0.8);
  ASSERT_TRUE(room.play(file, "reshape piece=a at=10cm,0 by=0,-4cm,0 within=8cm\n"));
  EXPECT_LT(placeOf(0.25).v, -0.02);
  EXPECT_LT(distance(placeOf(file.document().pieceNamed("a")->marks[0].fraction), notch), 1e-6);
  EXPECT_LT(distance(placeOf(file.document().pattern.seams.begin()->second.a[0].from), from), 1e-6);
}

}  // namespace
}  // namespace karinui
