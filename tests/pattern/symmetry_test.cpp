// The symmetry of a piece, with slits and darts in it; points taken away on both halves.
#include "karinui/pattern/symmetry.h"

#include <gtest/gtest.h>

#include "karinui/pattern/edit.h"
#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

// A skirt front: its axis at u = 0.2; waist across the axis, sides slanted, hem across.
Piece skirt() {
  Piece piece = pieceOf(1, polygon({{0, 0}, {0.4, 0}, {0.36, 0.5}, {0.04, 0.5}}), "skirt");
  const char* names[] = {"hem", "side_right", "waist", "side_left"};
  for (std::size_t k = 0; k < 4; ++k) piece.outline.edges[k].name = names[k];
  return piece;
}
Piece cutIn(const Piece& piece, std::vector<Flat> line) {
  const auto cut = cutPiece(piece, std::move(line), {2}, "other");
  EXPECT_TRUE(cut) << text(cut.error().what);
  EXPECT_EQ(cut->pieces.size(), 1u);
  return cut->pieces[0];
}
std::string partnerOf(const Outline& outline, const PaperSymmetry& symmetry, const char* edge) {
  const auto partner = symmetry.partner[*outline.find(edge)];
  return partner ? outline.edges[*partner].name : "none";
}

TEST(Symmetry, ASlitOnOneHalfLeavesTheRestItsCounterparts) {
  const Piece piece = cutIn(skirt(), {{0.3, -0.01}, {0.3, 0.2}});
  const auto symmetry = symmetryOf(piece.outline);
  ASSERT_TRUE(symmetry);
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "side_left"), "side_right");
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "waist"), "waist");
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "hem"), "none");
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "cut"), "none");
  // A place on the hem has its image, on whichever part of the hem that is.
  const auto image = imageOf(piece.outline, *symmetry, {*piece.outline.find("hem_2"), 0.5});
  ASSERT_TRUE(image);
  EXPECT_EQ(piece.outline.edges[image->edge].name, "hem");
  EXPECT_LT(distance(piece.outline.edges[image->edge].curve.atFraction(image->at), {0.05, 0}), 1e-6);
  EXPECT_FALSE(imageOf(piece.outline, *symmetry, {*piece.outline.find("cut"), 0.5}));
}

TEST(Symmetry, ASlitOnTheAxisOrBesideIt) {
  for (const double u : {0.2, 0.203}) {
    const Piece piece = cutIn(skirt(), {{u, -0.01}, {u, 0.2}});
    const auto symmetry = symmetryOf(piece.outline);
    ASSERT_TRUE(symmetry) << u;
    EXPECT_EQ(partnerOf(piece.outline, *symmetry, "side_left"), "side_right");
    EXPECT_NEAR(symmetry->through.u, 0.2, 1e-9);
  }
}

TEST(Symmetry, ASlitFromACorner) {
  const Piece piece = cutIn(skirt(), {{0.36, 0.5}, {0.3, 0.4}});
  const auto symmetry = symmetryOf(piece.outline);
  ASSERT_TRUE(symmetry);
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "side_left"), "side_right");
  EXPECT_EQ(partnerOf(piece.outline, *symmetry, "hem"), "hem");
  // The other half's corner is dragged: both sides of the slit's mouth go with it, and it stays a slit.
  Outline now = piece.outline;
  const std::size_t k = *now.find("side_left");
  const auto moved = moveCorner(piece, "side_left", {0.03, 0.52});
  ASSERT_TRUE(moved);
  const Outline both = onBothHalves(piece.outline, moved->outline, *symmetry);
  const auto good = checked(both);
  ASSERT_TRUE(good) << text(good.error().what);
  EXPECT_EQ(both.edges.size(), piece.outline.edges.size());
  EXPECT_LT(distance(both.edges[*both.find("side_right")].curve.end, {0.37, 0.52}), 1e-12);
  EXPECT_LT(distance(both.edges[*both.find("waist")].curve.start, {0.37, 0.52}), 1e-12);
  EXPECT_EQ(both.edges[k].curve.start, (Flat{0.03, 0.52}));
}

TEST(Symmetry, ADartOnOneHalf) {
  const auto dart = addDart(skirt(), "waist", 0.25, 0.03, {0.28, 0.38}, "dart");
  ASSERT_TRUE(dart);
  const Outline& outline = dart->edited.piece.outline;
  const auto symmetry = symmetryOf(outline);
  ASSERT_TRUE(symmetry);
  EXPECT_EQ(partnerOf(outline, *symmetry, "side_left"), "side_right");
  EXPECT_EQ(partnerOf(outline, *symmetry, "hem"), "hem");
  EXPECT_EQ(partnerOf(outline, *symmetry, "dart"), "none");
}

TEST(Symmetry, CornersBesideASlitMoveOnBothHalves) {
  const Piece piece = cutIn(skirt(), {{0.3, -0.01}, {0.3, 0.2}});
  const auto symmetry = symmetryOf(piece.outline);
  ASSERT_TRUE(symmetry);
  const auto moved = moveCorner(piece, "side_right", {0.42, -0.02});
  ASSERT_TRUE(moved);
  const Outline both = onBothHalves(piece.outline, moved->outline, *symmetry);
  ASSERT_TRUE(checked(both));
  EXPECT_LT(distance(both.edges[*both.find("hem")].curve.start, {-0.02, -0.02}), 1e-12);
  EXPECT_EQ(both.edges[*both.find("cut")], piece.outline.edges[*piece.outline.find("cut")]);
  EXPECT_EQ(both.edges[*both.find("waist")], piece.outline.edges[*piece.outline.find("waist")]);
}

TEST(Symmetry, WhatIsNotSymmetricDoesNotBecomeSoByASlit) {
  Piece piece = skirt();
  piece.outline.edges[1].curve.end = piece.outline.edges[2].curve.start = {0.3, 0.5};  // a corner further in
  EXPECT_FALSE(symmetryOf(piece.outline));
  EXPECT_FALSE(symmetryOf(cutIn(piece, {{0.3, -0.01}, {0.3, 0.2}}).outline));
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const auto outline = checked(randomOutline(random, 0.3));
    if (!outline) continue;
    const auto cut = cutPiece(pieceOf(1, *outline), {{1, 0.01}, {0.1, 0.02}}, {2}, "other");
    if (!cut || cut->pieces.size() != 1) continue;
    EXPECT_FALSE(symmetryOf(cut->pieces[0].outline));
  }
}

double farthest(const Curve& a, const Curve& b) {
  double most = 0;
  const std::vector<Flat> line = b.flattened(1e-6);
  for (const Flat place : a.evenly(0, 1, 200)) {
    double nearest = 1;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      nearest = std::min(nearest, distanceToSegment(line[i], line[i + 1], place));
    most = std::max(most, nearest);
  }
  return most;
}

TEST(Join, SplitAndJoinedIsTheCurveItWas) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.1, 0.9);
  for (int round = 0; round < 60; ++round) {
    const auto outline = checked(randomOutline(random, 0.3));
    if (!outline) continue;
    const Piece piece = pieceOf(1, *outline);
    for (const Edge& edge : outline->edges) {
      const auto split = splitEdge(piece, edge.name, unit(random));
      ASSERT_TRUE(split);
      const auto again = splitEdge(split->piece, edge.name, unit(random));  // and once more
      ASSERT_TRUE(again);
      auto joined = joinEdges(again->piece, edge.name, true);
      ASSERT_TRUE(joined);
      joined = joinEdges(joined->piece, edge.name, true);
      ASSERT_TRUE(joined);
      const Curve& now = findEdge(joined->piece, edge.name)->curve;
      EXPECT_EQ(now.kind, edge.curve.kind);
      EXPECT_EQ(now.between.size(), edge.curve.between.size()) << "as many curves as it was";
      EXPECT_LT(farthest(now, edge.curve), 1e-5);
      EXPECT_NEAR(now.length(), edge.curve.length(), 1e-7);
    }
  }
}

TEST(Join, ASmoothJointIsRefittedWithinATenthOfAMillimetre) {
  Piece piece = pieceOf(1, rectangle(0.4, 0.3));
  // A quarter ellipse-like bow of two cubics that were never one.
  const Curve first = Curve::cubic({0.4, 0.3}, {0.35, 0.33}, {0.3, 0.345}, {0.24, 0.35});
  const Curve second = Curve::cubic({0.24, 0.35}, {0.15, 0.3575}, {0.06, 0.34}, {0, 0.3});
  piece.outline.edges[2].curve = first;
  piece.outline.edges.insert(piece.outline.edges.begin() + 3, {"top_2", second});
  const auto joined = joinEdges(piece, "top", true);
  ASSERT_TRUE(joined) << text(joined.error().what);
  const Curve& now = findEdge(joined->piece, "top")->curve;
  EXPECT_LT(farthest(first, now), 2e-4);
  EXPECT_LT(farthest(second, now), 2e-4);
  EXPECT_EQ(now.start, first.start);
  EXPECT_EQ(now.end, second.end);
}

TEST(Join, ATrueCornerIsRoundedAndTheRestStays) {
  Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  const Curve armhole = Curve::cubic({0.4, 0.3}, {0.33, 0.31}, {0.32, 0.4}, {0.33, 0.5});
  piece.outline.edges[1].curve = Curve::line({0.4, 0}, {0.4, 0.3});
  piece.outline.edges.insert(piece.outline.edges.begin() + 2, {"armhole", armhole});
  piece.outline.edges[3].curve.start = {0.33, 0.5};
  const auto joined = joinEdges(piece, "right", true);
  ASSERT_TRUE(joined) << text(joined.error().what);
  const Curve& now = findEdge(joined->piece, "right")->curve;
  // Beyond a third of the shorter edge from the corner it is what was there.
  EXPECT_LT(farthest(Curve::line({0.4, 0}, {0.4, 0.22}), now), 1e-3);
  EXPECT_LT(farthest(armhole.part(armhole.parameterAt(0.08), 1), now), 1e-3);
  const auto before = joinEdges(piece, "right");
  ASSERT_TRUE(before);
  EXPECT_GT(farthest(Curve::line({0.4, 0}, {0.4, 0.22}), findEdge(before->piece, "right")->curve), 0.005)
      << "as documents of before have it";
}

}  // namespace
}  // namespace karinui
