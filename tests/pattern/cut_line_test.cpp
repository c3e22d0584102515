#include "karinui/pattern/cut_line.h"

#include <gtest/gtest.h>

#include <numbers>

#include "karinui/geometry/winding.h"
#include "support.h"

namespace karinui {
namespace {

Flat way(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return {std::cos(a), std::sin(a)};
}
double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
double cotangent(double degrees) { return 1 / std::tan(degrees * std::numbers::pi / 180); }

// In along the u axis, out turned to the left by so much; widths 10 and 20 mm.
CutCorner corner(CornerKind kind, double degrees, double before = 0.01, double after = 0.02) {
  return {{0, 0}, {1, 0}, way(degrees), before, after, kind};
}
void expectPoints(const std::vector<Flat>& got, const std::vector<Flat>& want, const std::string& what) {
  ASSERT_EQ(got.size(), want.size()) << what;
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_LT(distance(got[i], want[i]), 1e-12) << what << " " << i;
}

constexpr double kA = 0.01, kB = 0.02;

TEST(CutCorner, EachKindAtASquareCorner) {
  expectPoints(cornerPoints(corner(CornerKind::Mitre, 90)), {{kB, -kA}}, "mitre");
  expectPoints(cornerPoints(corner(CornerKind::Points, 90)), {{0, -kA}, {kB, 0}}, "points");
  for (const CornerKind kind : {CornerKind::MirrorBefore, CornerKind::SquareBefore})
    expectPoints(cornerPoints(corner(kind, 90)), {{kB, -kA}, {kB, 0}}, "before");
  for (const CornerKind kind : {CornerKind::MirrorAfter, CornerKind::SquareAfter})
    expectPoints(cornerPoints(corner(kind, 90)), {{0, -kA}, {kB, -kA}}, "after");
}

// In the frame of the edge before: the cut line after meets the seam line before at b / sin, the cut line before the
// seam line after at -a / sin of the way after.
TEST(CutCorner, EachKindAtSlantedCorners) {
  for (const double turn : {50.0, 75.0, 110.0, 125.0}) {
    const double s = sine(turn), c = std::cos(turn * std::numbers::pi / 180), cot = cotangent(turn);
    const Flat onBefore{kB / s, 0}, onAfter = way(turn) * (-kA / s);
    const std::string at = std::to_string(turn);
    expectPoints(cornerPoints(corner(CornerKind::Mitre, turn)), {{kB / s + -kA * cot, -kA}}, "mitre " + at);
    expectPoints(cornerPoints(corner(CornerKind::Points, turn)), {onAfter, onBefore}, "points " + at);
    expectPoints(cornerPoints(corner(CornerKind::MirrorBefore, turn)), {{kB / s + kA * cot, -kA}, onBefore},
                 "mirror before " + at);
    expectPoints(cornerPoints(corner(CornerKind::SquareBefore, turn)), {{kB / s, -kA}, onBefore},
                 "square before " + at);
    expectPoints(cornerPoints(corner(CornerKind::SquareAfter, turn)), {onAfter, onAfter + Flat{s, -c} * kB},
                 "square after " + at);
    // Folded on the seam line the end of the allowance lies on the cut line beside it.
    const std::vector<Flat> after = cornerPoints(corner(CornerKind::MirrorAfter, turn));
    ASSERT_EQ(after.size(), 2u);
    EXPECT_LT(distance(after[0], onAfter), 1e-12);
    const Flat axis = way(turn), folded = axis * (2 * dot(after[1], axis)) - after[1];
    EXPECT_NEAR(folded.v, -kA, 1e-12) << at;
    EXPECT_NEAR(dot(after[1], Flat{s, -c}), kB, 1e-12) << at;
  }
}

TEST(CutCorner, TheMitreEndsAtThreeAndAHalfWidths) {
  const double limit = 2 * std::acos(1 / 3.5) * 180 / std::numbers::pi;  // a mitre of just 3.5 widths
  EXPECT_EQ(cornerPoints(corner(CornerKind::Mitre, limit - 0.01, kA, kA)).size(), 1u);
  const std::vector<Flat> square = cornerPoints(corner(CornerKind::Mitre, limit + 0.01, kA, kA));
  ASSERT_EQ(square.size(), 2u);
  const Flat out = normalized(square[0] + square[1]);
  for (const Flat p : square) EXPECT_NEAR(dot(p, out), kA, 1e-9) << "cut square one width from the corner";
  EXPECT_NEAR(square[0].v, -kA, 1e-12);
  // Every other kind falls back to it where it would lead farther.
  for (const CornerKind kind : {CornerKind::Points, CornerKind::MirrorBefore, CornerKind::MirrorAfter,
                                CornerKind::SquareBefore, CornerKind::SquareAfter})
    expectPoints(cornerPoints(corner(kind, 170, kA, kA)), cornerPoints(corner(CornerKind::Mitre, 170, kA, kA)), "170");
}

TEST(CutCorner, StepsWhereTheEdgeRunsOn) {
  for (const CornerKind kind : {CornerKind::Mitre, CornerKind::MirrorBefore, CornerKind::SquareAfter}) {
    expectPoints(cornerPoints(corner(kind, 0)), {{0, -kA}, {0, -kB}}, "a step");
    expectPoints(cornerPoints(corner(kind, 0, kA, kA)), {{0, -kA}}, "none");
  }
  expectPoints(cornerPoints(corner(CornerKind::Mitre, 20)), {{0, -kA}, Flat{way(20).v, -way(20).u} * kB}, "20 degrees");
}

TEST(CutCorner, WalkedTheOtherWayItIsTheMirrorImage) {
  for (const CornerKind kind : {CornerKind::Mitre, CornerKind::Points, CornerKind::MirrorBefore,
                                CornerKind::MirrorAfter, CornerKind::SquareBefore, CornerKind::SquareAfter}) {
    const CutCorner one = corner(kind, 70);
    const auto image = [](Flat p) { return Flat{-p.u, p.v}; };
    const CutCorner other{{0, 0},         -image(one.after), -image(one.before),
                          one.widthAfter, one.widthBefore,   mirrored(kind)};
    std::vector<Flat> points = cornerPoints(other);
    std::reverse(points.begin(), points.end());
    for (Flat& p : points) p = image(p);
    expectPoints(points, cornerPoints(one), "kind " + std::to_string(static_cast<int>(kind)));
  }
}

Pattern alone(const Piece& piece) { return test::patternOf({piece}); }

double areaCut(const Piece& piece, const Allowances& allowances) {
  const auto lines = cutLines(piece, AllowancePlan(alone(piece), allowances));
  return lines ? signedArea(lines->outer) : 0;
}

TEST(CutLine, ARectangleGrowsByItsWidths) {
  const Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2));
  const auto lines = cutLines(piece, AllowancePlan(alone(piece), {}));
  ASSERT_TRUE(lines);
  EXPECT_EQ(lines->outer.size(), 4u);
  EXPECT_NEAR(signedArea(lines->outer), 0.32 * 0.22, 1e-12);
  Allowances own;
  own.edges[{piece.id, "bottom"}] = 0.04;
  own.edges[{piece.id, "left"}] = 0;
  EXPECT_NEAR(areaCut(piece, own), 0.31 * 0.25, 1e-12);
  for (const char* edge : {"bottom", "right", "top", "left"}) own.edges[{piece.id, edge}] = 0;
  EXPECT_FALSE(cutLines(piece, AllowancePlan(alone(piece), own)));
}

TEST(CutLine, EdgesAreWhatTheyAreCalledOrSewn) {
  Outline outline = test::rectangle(0.3, 0.2);
  const char* names[] = {"hem_2", "side_fold", "neckline", "chemise"};
  for (std::size_t k = 0; k < 4; ++k) outline.edges[k].name = names[k];
  Pattern pattern = alone(test::pieceOf(1, outline));
  const auto kinds = [&] {
    const AllowancePlan plan(pattern, {});
    std::vector<EdgeKind> all;
    for (const char* name : names) all.push_back(plan.kind({1}, name));
    return all;
  };
  EXPECT_EQ(kinds(), (std::vector{EdgeKind::Hem, EdgeKind::Fold, EdgeKind::Neckline, EdgeKind::Seam}));
  pattern.seams[{9}] = {{9}, "", {{{1}, "hem_2", 0, 0.5}}, {{{1}, "neckline", 0, 1}}, true, Seam::Tie::OneToOne};
  EXPECT_EQ(kinds(), (std::vector{EdgeKind::Seam, EdgeKind::Fold, EdgeKind::Seam, EdgeKind::Seam}));
  Allowances own;
  own.kinds = {{EdgeKind::Seam, 0.012}};
  own.edges = {{{{1}, "chemise"}, 0.02}};
  const AllowancePlan plan(pattern, own);
  EXPECT_EQ(plan.width({1}, "hem_2"), 0.012);
  EXPECT_EQ(plan.width({1}, "side_fold"), 0);
  EXPECT_EQ(plan.width({1}, "chemise"), 0.02);
}

// A trapezium whose sides lean inwards above: turned up, the hem must be as wide as the cloth it then lies on.
TEST(CutLine, AHemLiesFlatWhenItIsTurnedUp) {
  Outline outline = test::polygon({{0, 0}, {0.4, 0}, {0.34, 0.3}, {0.06, 0.3}});
  outline.edges[0].name = "hem";
  const Piece piece = test::pieceOf(1, outline);
  const auto lines = cutLines(piece, AllowancePlan(alone(piece), {}));
  ASSERT_TRUE(lines);
  const Ring& ring = lines->outer;
  int folded = 0;
  for (const Flat p : ring)
    if (std::fabs(p.v + usualAllowance(EdgeKind::Hem)) < 1e-9) {
      EXPECT_LT(distanceToRing(ring, {p.u, -p.v}), 1e-9) << p.u;
      ++folded;
    }
  EXPECT_EQ(folded, 2);
}

// A hem drawn on a body may curl by millimetres right at its corners. Its allowance is turned up along the hem, not
// along the curl, which would lead it away from the corner like a horn.
TEST(CutLine, AHemThatCurlsAtItsCornersHasNoHorns) {
  Outline outline = test::polygon({{0, 0}, {0.4, 0}, {0.36, 0.3}, {0.04, 0.3}});
  outline.edges[0] = {"hem", Curve::cubic({0, 0}, {0.012, -0.012}, {0.388, -0.012}, {0.4, 0})};
  const Piece piece = test::pieceOf(1, outline);
  const auto lines = cutLines(piece, AllowancePlan(alone(piece), {}));
  ASSERT_TRUE(lines);
  const double seam = usualAllowance(EdgeKind::Seam);
  for (const Flat p : lines->outer) {
    EXPECT_GT(p.u, -2.5 * seam) << p.v;
    EXPECT_LT(p.u, 0.4 + 2.5 * seam) << p.v;
  }
}

TEST(CutLine, CurvesKeepTheirDistance) {
  const Piece disc = test::pieceOf(1, test::circle(0.1));
  EXPECT_NEAR(areaCut(disc, {}), std::numbers::pi * 0.11 * 0.11, 2e-5);
  // A ring: the hole's own line lies in the hole, and goes where the allowance fills it.
  Piece ring = disc;
  ring.holes.push_back(test::circle(0.03, {}, "inner"));
  auto lines = cutLines(ring, AllowancePlan(alone(ring), {}));
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->holes.size(), 1u);
  EXPECT_NEAR(signedArea(lines->holes[0]), std::numbers::pi * 0.02 * 0.02, 1e-5);
  ring.holes[0] = test::circle(0.009, {}, "inner");
  lines = cutLines(ring, AllowancePlan(alone(ring), {}));
  ASSERT_TRUE(lines);
  EXPECT_TRUE(lines->holes.empty());
}

// Of outlines that turn inwards, with widths of all kinds: nowhere nearer than the narrowest width, nowhere farther
// than the longest mitre, never crossing itself, and the whole piece within.
TEST(CutLine, RandomOutlinesStayWithinTheirBounds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 60; ++round) {
    const Piece piece = test::pieceOf(1, test::randomOutline(random, 0.25));
    Allowances own;
    double narrow = 1, wide = 0;
    for (const Edge& edge : piece.outline.edges) {
      const double width = 0.005 + 0.03 * unit(random);
      own.edges[{piece.id, edge.name}] = width;
      own.corners[{piece.id, edge.name}] = static_cast<CornerKind>(static_cast<int>(unit(random) * 6));
      narrow = std::min(narrow, width), wide = std::max(wide, width);
    }
    const auto lines = cutLines(piece, AllowancePlan(alone(piece), own));
    ASSERT_TRUE(lines) << round;
    EXPECT_FALSE(crossing(lines->outer)) << round;
    const Ring seam = piece.outline.flattened(1e-5);
    for (const Flat p : seam) EXPECT_EQ(turnsRound(lines->outer, p), 1) << round;
    for (const Flat p : lines->outer) EXPECT_LE(distanceToRing(seam, p), kLongestMitre * wide + 1e-4) << round;
    for (const Edge& edge : piece.outline.edges)  // the middles of the edges: there no corner matters
      EXPECT_GE(distanceToRing(lines->outer, edge.curve.atFraction(0.5)), narrow - 1e-4) << round << edge.name;
  }
}

TEST(CutLine, ASlitIsCoveredByItsAllowance) {
  Outline outline = test::polygon({{0, 0}, {0.1, 0}, {0.1, 0.12}, {0.1, 0}, {0.3, 0}, {0.3, 0.2}, {0, 0.2}});
  const Piece piece = test::pieceOf(1, outline);
  const auto lines = cutLines(piece, AllowancePlan(alone(piece), {}));
  ASSERT_TRUE(lines);
  EXPECT_NEAR(signedArea(lines->outer), 0.32 * 0.22, 1e-9);
}

TEST(Allowance, FollowsItsEdges) {
  const PieceId id{1};
  Allowances own;
  own.edges[{id, "side"}] = 0.02, own.edges[{id, "top"}] = 0.03;
  own.corners[{id, "side"}] = CornerKind::Points, own.corners[{id, "top"}] = CornerKind::SquareAfter;
  Outline outline = test::rectangle(0.3, 0.2);
  outline.edges[1].name = "side";
  Piece piece = test::pieceOf(1, outline);
  // divided: both parts, the corner at its start alone
  auto split = splitEdge(piece, "side", 0.5);
  ASSERT_TRUE(split);
  Allowances parts = own;
  updateAllowances(parts, split->edges, alone(split->piece));
  EXPECT_EQ((parts.edges.at({id, "side_2"})), 0.02);
  EXPECT_EQ(parts.corners.size(), 2u);
  // joined again: the wider, and the corner between them is gone
  parts.edges[{id, "side_2"}] = 0.05, parts.corners[{id, "side_2"}] = CornerKind::Points;
  auto joined = joinEdges(split->piece, "side");
  ASSERT_TRUE(joined);
  updateAllowances(parts, joined->edges, alone(joined->piece));
  EXPECT_EQ((parts.edges.at({id, "side"})), 0.05);
  EXPECT_FALSE(parts.edges.contains({id, "side_2"}));
  EXPECT_EQ(parts.corners, own.corners);
  // cut in two: each piece has its part
  const auto cut = cutPiece(piece, {{-0.1, 0.1}, {0.4, 0.1}}, {2}, "second");
  ASSERT_TRUE(cut);
  Allowances two = own;
  updateAllowances(two, cut->edges, test::patternOf(cut->pieces));
  int sides = 0;
  for (const auto& [at, width] : two.edges) sides += width == 0.02;
  EXPECT_EQ(sides, 2);
  // the mirror image of a piece is cut along the mirror image of its cut line
  Piece image = mirrored(piece);
  image.id = {3};
  Allowances both = own;
  copyAllowances(both, piece, image, true);
  const auto left = cutLines(piece, AllowancePlan(alone(piece), both)),
             right = cutLines(image, AllowancePlan(alone(image), both));
  ASSERT_TRUE(left && right);
  ASSERT_EQ(left->outer.size(), right->outer.size());
  for (const Flat p : left->outer) EXPECT_LT(distanceToRing(right->outer, {-p.u, p.v}), 1e-9);
  // what is gone is forgotten
  updateAllowances(both, {}, alone(piece));
  EXPECT_EQ(both, own);
}

}  // namespace
}  // namespace karinui
