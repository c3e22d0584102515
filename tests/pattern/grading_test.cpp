#include "karinui/pattern/grading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace karinui {
namespace {

// A front: straight hem and side, a curved armhole, a shoulder, a neckline that is an arc, the centre.
Outline front(double wider = 0, double longer = 0, double deeper = 0) {
  const Flat low{0, 0}, side{0.24 + wider, 0}, under{0.25 + wider, 0.34 + longer}, tip{0.17 + wider / 2, 0.56 + longer},
      neck{0.07, 0.60 + longer}, centre{0, 0.52 + longer - deeper};
  return *checked({{{"hem", Curve::line(low, side)},
                    {"side", Curve::line(side, under)},
                    {"armhole", Curve::cubic(under, under + Flat{-0.08, 0.02}, tip + Flat{-0.01, -0.1}, tip)},
                    {"shoulder", Curve::line(tip, neck)},
                    {"neck", Curve::arc(neck, centre, -0.3)},
                    {"centre", Curve::line(centre, low)}}});
}

Grading of(GradePoints points, std::vector<std::string> sizes = {"S", "M", "L"}) {
  Grading grading;
  grading.sizes = std::move(sizes);
  grading.base = grading.standing = 1;
  grading.pieces[{1}] = std::move(points);
  return grading;
}

double farthest(const Outline& a, const Outline& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.edges.size(); ++k) {
    const Ring line = b.flattened(1e-6);
    for (int i = 0; i <= 50; ++i) most = std::max(most, distanceToRing(line, a.edges[k].curve.atFraction(i / 50.0)));
  }
  return most;
}

// The same outline, drawn with other joints.
double apart(const Outline& a, const Outline& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.edges.size(); ++k)
    for (int i = 0; i <= 50; ++i)
      most = std::max(most, distance(a.edges[k].curve.atFraction(i / 50.0), b.edges[k].curve.atFraction(i / 50.0)));
  return most;
}

GradePoints corners(const Outline& outline, const std::vector<Flat>& by) {
  GradePoints points;
  for (std::size_t k = 0; k < by.size(); ++k) points.push_back({outline.edges[k].name, 0, {-1 * by[k], {}, by[k]}});
  return points;
}

TEST(Grading, CornersGoAsToldAndCurvesKeepTheirKind) {
  const Outline m = front();
  const GradePoints points = corners(m, {{0, 0}, {.01, 0}, {.01, .005}, {.005, .005}, {0, .005}, {0, .005}});
  const auto l = graded(m, of(points), points, 1, 2);
  ASSERT_TRUE(l);
  EXPECT_EQ(l->edges[1].curve.kind, Curve::Kind::Line);
  EXPECT_LT(distance(l->edges[1].curve.start, {0.25, 0}), 1e-12);
  EXPECT_LT(distance(l->edges[1].curve.end, {0.26, 0.345}), 1e-12);
  // The neck goes as a whole; the armhole stretches no more than its ends part.
  EXPECT_EQ(l->edges[4].curve.kind, Curve::Kind::Arc);
  EXPECT_EQ(l->edges[4].curve.bulge, -0.3);
  EXPECT_NEAR(l->edges[4].curve.length(), m.edges[4].curve.length(), 1e-12);
  EXPECT_LT(l->edges[2].curve.length(), m.edges[2].curve.length() + 0.01);
  EXPECT_FALSE(graded(m, of(points), corners(m, {{0, 0}, {-.3, 0}, {-.3, 0}, {0, 0}, {0, 0}, {0, 0}}), 1, 2));
}

TEST(Grading, MeasuredDifferencesGiveTheOutlinesBack) {
  // The large size's armhole has another character, and is drawn with joints of its own.
  Outline large = front(.015, .008, .003);
  Curve& armhole = large.edges[2].curve;
  const Curve halves[] = {armhole.part(0, .3), armhole.part(.3, 1)};
  armhole = Curve::joined(halves);
  armhole.between[0] += Flat{-.004, -.006}, armhole.between[1] += Flat{-.004, -.002},
      armhole.between[2] += Flat{-.004, .004};
  const std::vector<Outline> sizes{front(-.012, -.006, -.002), front(), large};
  const auto made = measuredGrading(sizes, 1);
  ASSERT_TRUE(made);
  for (std::size_t size = 0; size < 3; ++size) {
    const auto back = graded(sizes[1], of(*made), *made, 1, size);
    ASSERT_TRUE(back);
    EXPECT_LT(farthest(*back, sizes[size]), 2e-5) << size;
    EXPECT_LT(farthest(sizes[size], *back), 2e-5) << size;
  }
  Outline fewer = large;
  fewer.edges.pop_back();
  EXPECT_FALSE(measuredGrading({front(), fewer}, 0));
}

TEST(Grading, WhatLiesWithinGoesAlongWithTheOutline) {
  const Outline m = front();
  const GradePoints all = corners(m, std::vector<Flat>(6, {.01, .02}));
  Grading grading = of(all);
  Piece piece;
  piece.id = {1}, piece.outline = m;
  piece.marks = {{"drill", "", 0, {.1, .3}}, {"notch", "side", .4, {}}};
  piece.lines = {{"line", {Curve::line({.05, .1}, {.1, .2})}, {}}};
  auto l = inSize(piece, grading, 2);
  ASSERT_TRUE(l);
  EXPECT_LT(distance(l->marks[0].place, {.11, .32}), 1e-12);  // carried as a whole
  EXPECT_EQ(l->marks[1].fraction, .4);
  EXPECT_LT(distance(l->lines[0].curves[0].end, {.11, .22}), 1e-12);
  // Stretched across, what lies half-way goes half as far (mean value coordinates are exact for linear maps).
  const Outline square = *checked({{{"a", Curve::line({0, 0}, {1, 0})},
                                    {"b", Curve::line({1, 0}, {1, 1})},
                                    {"c", Curve::line({1, 1}, {0, 1})},
                                    {"d", Curve::line({0, 1}, {0, 0})}}});
  Outline wide = square;
  for (Edge& edge : wide.edges)
    for (Flat* p : {&edge.curve.start, &edge.curve.end}) p->u *= 1.1;
  const auto places = carriedWithin(square, wide, {{.5, .3}, {1, .5}, {.2, .7}});
  EXPECT_LT(distance(places[0], {.55, .3}), 1e-9);
  EXPECT_LT(distance(places[1], {1.1, .5}), 1e-9);
  EXPECT_LT(distance(places[2], {.22, .7}), 1e-9);
}

TEST(Grading, FollowsTheEdgesOfAnEditedPiece) {
  Piece piece;
  piece.id = {1}, piece.outline = front();
  Grading grading = of(corners(piece.outline, {{0, 0}, {.01, 0}, {.01, .005}, {.005, .005}, {0, .005}, {0, .005}}));
  const auto large = [&](const Piece& p) { return graded(p.outline, grading, grading.pieces.at(p.id), 1, 2)->area(); };
  const double before = large(piece);
  const auto split = splitEdge(piece, "armhole", 0.4);
  updateGrading(grading, piece, split->edges, {&split->piece});
  EXPECT_EQ(grading.pieces.at({1}).size(), 7u);
  EXPECT_NEAR(large(split->piece), before, 1e-6);
  const auto dart = addDart(split->piece, "hem", 0.5, 0.02, {.12, .1}, "dart");
  updateGrading(grading, split->piece, dart->edited.edges, {&dart->edited.piece});
  const Outline l = *graded(dart->edited.piece.outline, grading, grading.pieces.at({1}), 1, 2);
  // Half-way along a hem that grows by 10 mm the dart goes out by 5, its legs alike.
  const Flat tip = l.edges[*l.find("dart")].curve.end;
  EXPECT_LT(distance(tip, {.125, .1}), 1e-4);
  EXPECT_NEAR(l.edges[*l.find("dart")].curve.length(), l.edges[*l.find("dart_2")].curve.length(), 1e-5);
  const auto joined = joinEdges(split->piece, "armhole");
  Grading other = grading;
  other.pieces[{1}] = corners(split->piece.outline, std::vector<Flat>(7, {.01, 0}));
  updateGrading(other, split->piece, joined->edges, {&joined->piece});
  EXPECT_EQ(other.pieces.at({1}).size(), 6u);
  // A piece cut in two: both halves go as the whole did at the cut.
  const auto cut = cutPiece(piece, {{-.05, .2}, {.3, .2}}, {2}, "upper");
  ASSERT_TRUE(cut);
  other.pieces[{1}] = corners(piece.outline, {{0, 0}, {.01, 0}, {.01, .005}, {.005, .005}, {0, .005}, {0, .005}});
  updateGrading(other, piece, cut->edges, {&cut->pieces[0], &cut->pieces[1]});
  double sum = 0;
  for (const Piece& part : cut->pieces) sum += graded(part.outline, other, other.pieces.at(part.id), 1, 2)->area();
  EXPECT_NEAR(sum, before, 2e-6);
}

TEST(Grading, AMirrorImageIsGradedLikewise) {
  Piece piece;
  piece.id = {1}, piece.outline = front();
  const GradePoints points = *measuredGrading({front(-.012), piece.outline, front(.015, .002)}, 1);
  const Piece image = mirrored(piece);
  const GradePoints other = mirroredGrading(points, piece.outline, image.outline);
  Piece large = piece;
  large.outline = *graded(piece.outline, of(points), points, 1, 2);
  EXPECT_LT(apart(*graded(image.outline, of(other), other, 1, 2), mirrored(large).outline), 1e-9);
}

}  // namespace
}  // namespace karinui
