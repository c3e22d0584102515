// Slash and spread against closed forms, on random outlines, and what goes along.
#include "karinui/pattern/spread.h"
#include "karinui/pattern/likeness.h"

#include <gtest/gtest.h>

#include <random>

#include "support.h"

namespace karinui {
namespace {

using namespace test;

constexpr double kWidth = 0.4, kHeight = 0.6;

// A panel: hem below, waist above; its slash runs straight up.
Piece panel() {
  Piece piece = pieceOf(1, rectangle(kWidth, kHeight), "skirt");
  piece.outline.edges[0].name = "hem", piece.outline.edges[2].name = "waist";
  return piece;
}
Slash slashed(double by, double toBy, bool smooth = false, double at = 0.5) {
  Slash slash{"hem", "waist"};
  slash.at = at, slash.toAt = 1 - at, slash.by = by, slash.toBy = toBy, slash.smooth = smooth;
  return slash;
}
double edgeLength(const Piece& piece, const char* edge) { return findEdge(piece, edge)->curve.length(); }

TEST(Spread, AddsTheTrapezoidBetweenTheBanks) {
  for (const auto& [by, toBy] : {std::pair{0.05, 0.0}, {0.05, 0.05}, {0.08, 0.03}, {0.0, 0.04}}) {
    const Piece before = panel();
    const auto opened = spreadPiece(before, slashed(by, toBy));
    ASSERT_TRUE(opened) << text(opened.error().what);
    const Piece& now = opened->edited.piece;
    // Hinged: a triangle with two sides as long as the slash; parallel: a rectangle.
    const double half = (by - toBy) / 2, deep = std::sqrt(kHeight * kHeight - half * half);
    EXPECT_NEAR(now.outline.area(), before.outline.area() + (by + toBy) / 2 * deep, 1e-9);
    EXPECT_NEAR(edgeLength(now, "hem"), kWidth + by, 1e-9);
    EXPECT_NEAR(edgeLength(now, "waist"), kWidth + toBy, 1e-9);
    EXPECT_NEAR(edgeLength(now, "left"), kHeight, 1e-9);
    EXPECT_NEAR(edgeLength(now, "right"), kHeight, 1e-9);
    EXPECT_EQ(now.grain, before.grain);
  }
  // Opened evenly, what was straight stays one straight line.
  const auto parallel = spreadPiece(panel(), slashed(0.05, 0.05, true));
  ASSERT_TRUE(parallel);
  EXPECT_EQ(findEdge(parallel->edited.piece, "hem")->curve.kind, Curve::Kind::Line);
}

// Every part keeps its shape, whichever stays; the larger one does by itself, to the bit.
TEST(Spread, MovesPartsAsRigidThings) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  int tried = 0;
  for (int k = 0; k < 200; ++k) {
    const Piece before = pieceOf(1, randomOutline(random, 0.3));
    const std::size_t n = before.outline.edges.size();
    Slash slash{"e0", "e" + std::to_string(1 + static_cast<std::size_t>(share(random) * static_cast<double>(n - 1)))};
    slash.at = 0.2 + 0.6 * share(random), slash.toAt = 0.2 + 0.6 * share(random);
    slash.by = 0.03 * share(random), slash.toBy = k % 3 == 0 ? 0 : 0.03 * share(random), slash.smooth = k % 2 == 0;
    slash.stays = static_cast<Slash::Stays>(k % 4);
    const auto opened = spreadPiece(before, slash);
    if (!opened) continue;  // the slash would leave the piece
    ++tried;
    const Piece& now = opened->edited.piece;
    ASSERT_EQ(now.outline.edges.size(), n);
    double most = 0;
    for (std::size_t e = 0; e < n; ++e) {
      const Edge &was = before.outline.edges[e], &is = now.outline.edges[e];
      EXPECT_EQ(is.name, was.name);
      if (was.name == slash.from || was.name == slash.to) continue;
      EXPECT_NEAR(is.curve.length(), was.curve.length(), 1e-9);
      for (const double f : {0.0, 0.3, 1.0})
        most = std::max(most, distance(is.curve.atFraction(f), opened->place(was.curve.atFraction(f))));
    }
    EXPECT_LT(most, 1e-9);
    const Flat a = findEdge(before, slash.from)->curve.atFraction(slash.at),
               b = findEdge(before, slash.to)->curve.atFraction(slash.toAt);
    const double half = (slash.by - slash.toBy) / 2,
                 added = (slash.by + slash.toBy) / 2 * std::sqrt(dot(b - a, b - a) - half * half);
    // In straight lines exactly the opening is added; trued, hardly another area.
    EXPECT_NEAR(now.outline.area(), before.outline.area() + added, slash.smooth ? 4e-4 : 1e-7);
    // Distances within a part are kept.
    const Flat p = before.outline.edges[0].curve.atFraction(slash.at / 3),
               q = before.outline.edges[n - 1].curve.atFraction(0.999);
    if (slash.to != before.outline.edges[n - 1].name) {
      EXPECT_NEAR(distance(opened->place(p), opened->place(q)), distance(p, q), 1e-9);
    }
  }
  EXPECT_GT(tried, 80);
}

// Trued: no corner is left on the edge, and it stays near the straight lines.
TEST(Spread, TruesTheEdges) {
  const auto plain = spreadPiece(panel(), slashed(0.08, 0)), trued = spreadPiece(panel(), slashed(0.08, 0, true));
  ASSERT_TRUE(plain && trued);
  const auto turn = [](const Curve& curve) {
    double most = 0;
    const auto p = curve.evenly(0, 1, 400);
    for (std::size_t k = 1; k + 1 < p.size(); ++k)
      most = std::max(
          most, std::abs(std::atan2(cross(p[k] - p[k - 1], p[k + 1] - p[k]), dot(p[k] - p[k - 1], p[k + 1] - p[k]))));
    return most;
  };
  for (const char* edge : {"hem", "waist"}) {
    EXPECT_GT(turn(findEdge(plain->edited.piece, edge)->curve), 0.03) << edge;
    EXPECT_LT(turn(findEdge(trued->edited.piece, edge)->curve), 0.012) << edge;
    for (const Flat p : findEdge(trued->edited.piece, edge)->curve.evenly(0, 1, 100))
      EXPECT_LT(distanceToRing(plain->edited.piece.outline.flattened(), p), 0.003);
  }
}

TEST(Spread, TakesSeamsNotchesHolesAndLinesAlong) {
  Piece piece = panel();
  piece.marks = {
      {"n", "hem", 0.25, {}}, {"m", "hem", 0.75, {}}, {"fixed", "", 0, {0.1, 0.3}}, {"goes", "", 0, {0.3, 0.3}}};
  piece.lines = {{"across", {Curve::line({0.1, 0.3}, {0.3, 0.3})}, {}},
                 {"aside", {Curve::line({0.3, 0.1}, {0.3, 0.2})}, {}}};
  piece.holes = {rectangle(0.02, 0.02, {0.32, 0.45})};
  for (Edge& edge : piece.holes[0].edges) edge.name = "hole_" + edge.name;
  Slash slash = slashed(0.06, 0.06);
  slash.stays = Slash::Stays::Behind;
  const auto opened = spreadPiece(piece, slash);
  ASSERT_TRUE(opened) << text(opened.error().what);
  const Piece& now = opened->edited.piece;
  const auto at = [](const Piece& p, const Mark& mark) {
    return findEdge(p, mark.edge)->curve.atFraction(mark.fraction);
  };
  EXPECT_LT(distance(at(now, now.marks[0]), at(piece, piece.marks[0])), 1e-6);
  EXPECT_LT(distance(at(now, now.marks[1]), at(piece, piece.marks[1]) + Flat{0.06, 0}), 1e-6);
  EXPECT_EQ(now.marks[2].place, piece.marks[2].place);
  EXPECT_LT(distance(now.marks[3].place, piece.marks[3].place + Flat{0.06, 0}), 1e-12);
  ASSERT_EQ(now.lines[0].curves.size(), 1u);  // still one line, that can be sewn to
  EXPECT_NEAR(now.lines[0].curves[0].length(), 0.26, 1e-9);
  EXPECT_LT(distance(now.lines[1].curves[0].start, Flat{0.36, 0.1}), 1e-12);
  EXPECT_LT(distance(now.holes[0].edges[0].curve.start, Flat{0.38, 0.45}), 1e-12);
  // A seam over the slash holds the opening, too; one beside it keeps its length.
  Pattern pattern = patternOf({piece});
  const auto sew = [&](std::uint64_t id, EdgeSpan span) {
    pattern.seams[{id}] = {{id}, "", {std::move(span)}, {}, true};
  };
  sew(2, {{1}, "hem", 0, 1}), sew(3, {{1}, "hem", 0.1, 0.4}), sew(4, {{1}, "hem", 0.6, 0.9}),
      sew(5, {{1}, "across", 0, 1}), sew(6, {{1}, "across", 0.1, 0.4});
  updateSeams(pattern, opened->edited.edges);
  pattern.pieces[{1}] = std::make_shared<const Piece>(now);
  EXPECT_EQ(pattern.seams[{2}].a.size(), 1u);
  EXPECT_NEAR(length(pattern, pattern.seams[{2}].a), 0.46, 1e-9);
  EXPECT_NEAR(length(pattern, pattern.seams[{3}].a), 0.12, 1e-6);
  EXPECT_NEAR(length(pattern, pattern.seams[{4}].a), 0.12, 1e-6);
  EXPECT_NEAR(length(pattern, pattern.seams[{5}].a), 0.26, 1e-9);
  EXPECT_NEAR(length(pattern, pattern.seams[{6}].a), 0.06, 1e-6);
}

// The shape in space covers the new paper: no place of it lies far from the form's paper.
TEST(Spread, TakesTheFormAlong) {
  Piece piece = panel();
  const auto laid = lay(patternOf({piece}), 0.02);
  ASSERT_TRUE(laid);
  auto form = std::make_shared<Form>();
  const Lattice& lattice = *laid->lattices.at({1});
  form->flat = lattice.nodes, form->faces = lattice.faces;
  for (const Flat p : lattice.nodes) form->space.push_back({p.u, p.v, 0.1});
  piece.form = form;
  const auto opened = spreadPiece(piece, slashed(0.06, 0));
  ASSERT_TRUE(opened);
  const Form& now = *opened->edited.piece.form;
  ASSERT_EQ(now.space.size(), form->space.size());
  double area = 0;
  for (const Triangle& f : now.faces) {
    const double own = 0.5 * cross(now.flat[f[1]] - now.flat[f[0]], now.flat[f[2]] - now.flat[f[0]]);
    EXPECT_GT(own, 0);
    area += own;
  }
  EXPECT_NEAR(area, opened->edited.piece.outline.area(), 2e-4);
}

TEST(Spread, SlashesFromACorner) {
  Slash slash = slashed(0.04, 0);
  slash.to = "right", slash.toAt = 1;  // the corner of right side and waist
  const auto opened = spreadPiece(panel(), slash);
  ASSERT_TRUE(opened) << text(opened.error().what);
  EXPECT_NEAR(edgeLength(opened->edited.piece, "right"), kHeight, 1e-9);
  EXPECT_NEAR(edgeLength(opened->edited.piece, "waist"), kWidth, 1e-9);
  EXPECT_NEAR(edgeLength(opened->edited.piece, "hem"), kWidth + 0.04, 1e-9);
  slash.toBy = 0.02;  // the opening becomes a part of the edge that is named
  const auto wide = spreadPiece(panel(), slash);
  ASSERT_TRUE(wide) << text(wide.error().what);
  EXPECT_NEAR(edgeLength(wide->edited.piece, "right"), kHeight + 0.02, 1e-9);
}

TEST(Spread, IsMirroredOnACopy) {
  const Piece piece = panel(), copy = mirrored(piece);
  Slash slash = slashed(0.05, 0.01, true, 0.3);
  slash.stays = Slash::Stays::Ahead;
  const auto one = spreadPiece(piece, slash);
  const auto from = edgeOnCopy(copy, piece, "hem"), to = edgeOnCopy(copy, piece, "waist");
  ASSERT_TRUE(one && from && to);
  const auto other = spreadPiece(copy, mirrored(slash, *from, *to));
  ASSERT_TRUE(other);
  const Ring image = mirrored(one->edited.piece).outline.flattened(1e-6);
  for (const Flat p : other->edited.piece.outline.flattened(1e-4)) EXPECT_LT(distanceToRing(image, p), 2e-6);
}

// What lies double is gone, half of it on either side; what is beside it keeps its shape.
TEST(Spread, FoldsPaperOut) {
  const auto parallel = spreadPiece(panel(), slashed(-0.05, -0.05, true));
  ASSERT_TRUE(parallel) << text(parallel.error().what);
  const Piece& narrow = parallel->edited.piece;
  EXPECT_NEAR(narrow.outline.area(), (kWidth - 0.05) * kHeight, 1e-9);
  EXPECT_NEAR(edgeLength(narrow, "hem"), kWidth - 0.05, 1e-9);
  EXPECT_EQ(findEdge(narrow, "hem")->curve.kind, Curve::Kind::Line);
  EXPECT_NEAR(edgeLength(narrow, "left"), kHeight, 1e-9);
  // A wedge to nothing: the hem turns where it was.
  const double half = std::asin(0.05 / 2 / kHeight), gone = kHeight * std::tan(half);
  const auto wedge = spreadPiece(panel(), slashed(-0.05, 0));
  ASSERT_TRUE(wedge) << text(wedge.error().what);
  const Piece& bent = wedge->edited.piece;
  EXPECT_NEAR(bent.outline.area(), kWidth * kHeight - gone * kHeight, 1e-9);
  EXPECT_NEAR(edgeLength(bent, "hem"), kWidth - 2 * gone, 1e-9);
  EXPECT_NEAR(edgeLength(bent, "waist"), kWidth, 1e-9);
  for (const char* side : {"left", "right"}) EXPECT_NEAR(edgeLength(bent, side), kHeight, 1e-9);
  // A seam over the fold, or over its end, stays one.
  Pattern pattern = patternOf({panel()});
  for (const auto& [id, edge] : {std::pair(2, "hem"), std::pair(3, "waist")}) {
    const SeamId seam{static_cast<std::uint64_t>(id)};
    pattern.seams[seam] = {seam, "", {{{1}, edge, 0, 1}}, {}, true};
  }
  updateSeams(pattern, wedge->edited.edges);
  for (const auto& [id, seam] : pattern.seams) {
    ASSERT_EQ(seam.a.size(), 1u) << seam.a.front().edge;
    EXPECT_EQ(seam.a.front().from, 0);
    EXPECT_EQ(seam.a.front().to, 1);
  }
  const auto smooth = spreadPiece(panel(), slashed(-0.05, 0, true));
  ASSERT_TRUE(smooth);
  EXPECT_LT(edgeLength(smooth->edited.piece, "hem"), edgeLength(bent, "hem"));
  EXPECT_NEAR(edgeLength(smooth->edited.piece, "hem"), edgeLength(bent, "hem"), 1e-3);
}

// Of a tapered sleeve the sides meet half-way: no step is left on them.
TEST(Spread, FoldsASleeveShorter) {
  Piece sleeve = pieceOf(1, polygon({{0.05, 0}, {0.25, 0}, {0.32, 0.4}, {-0.02, 0.4}}), "sleeve");
  const char* names[] = {"hem", "front", "cap", "back"};
  for (std::size_t k = 0; k < 4; ++k) sleeve.outline.edges[k].name = names[k];
  sleeve.marks = {{"low", "front", 0.2, {}}, {"gone", "front", 0.5, {}}};
  sleeve.lines = {{"along", {Curve::line({0.15, 0.02}, {0.15, 0.38})}, std::nullopt},
                  {"in", {Curve::line({0.1, 0.19}, {0.1, 0.3})}, std::nullopt}};
  Slash slash{"front", "back"};
  slash.by = slash.toBy = -0.04;
  const double before = edgeLength(sleeve, "front");
  const auto folded = spreadPiece(sleeve, slash);
  ASSERT_TRUE(folded) << text(folded.error().what);
  const Piece& now = folded->edited.piece;
  const FlatBox box = boxOf(now.outline.flattened(1e-4));
  EXPECT_NEAR(box.high.v - box.low.v, 0.36, 1e-6);
  EXPECT_NEAR(edgeLength(now, "hem"), 0.2, 1e-9);
  EXPECT_NEAR(edgeLength(now, "cap"), 0.34, 1e-9);
  for (const char* side : {"front", "back"}) {
    EXPECT_NEAR(edgeLength(now, side), before * 0.9, 0.002);
    const Curve& curve = findEdge(now, side)->curve;
    for (double at = 0.05; at < 1; at += 0.05)  // never back, nor far to a side
      EXPECT_GT(
          dot(normalized(curve.atFraction(at) - curve.atFraction(at - 0.05)), normalized(curve.end - curve.start)),
          0.98);
  }
  EXPECT_NEAR(findEdge(now, "front")->curve.atFraction(now.marks[0].fraction).v - box.low.v, 0.08, 1e-3);
  EXPECT_NEAR(findEdge(now, "front")->curve.atFraction(now.marks[1].fraction).v - box.low.v, 0.18, 2e-3);
  EXPECT_NEAR(now.lines[0].curves.front().length(), 0.36 - 0.04, 1e-6);
  EXPECT_NEAR(now.lines[1].curves.front().length(), 0.11 - 0.03, 1e-6) << "what of it lies in the fold goes";
  double covered = 0;
  for (const EdgePart& part : folded->edited.edges.at({now.id, "front"})) {
    EXPECT_NEAR(part.from, covered, 1e-12);
    covered = part.to;
  }
  EXPECT_EQ(covered, 1);
}

TEST(Spread, SaysWhatIsWrong) {
  const auto why = [](const Piece& piece, const Slash& slash) {
    const auto result = spreadPiece(piece, slash);
    return result ? std::string("not refused") : text(result.error().what);
  };
  Slash slash = slashed(0.05, 0);
  slash.to = "hem";
  EXPECT_NE(why(panel(), slash).find("from one edge to another"), std::string::npos);
  EXPECT_NE(why(panel(), slashed(0.7, 0)).find("cannot open"), std::string::npos);
  EXPECT_NE(why(panel(), slashed(0, 0)).find("more than 0"), std::string::npos);
  EXPECT_NE(why(panel(), slashed(-0.05, 0.05)).find("or folded out at both"), std::string::npos);
  EXPECT_NE(why(panel(), slashed(-0.45, -0.45)).find("cannot be folded out"), std::string::npos);
  slash = slashed(0.05, 0);
  slash.to = "gone";
  EXPECT_NE(why(panel(), slash).find("no edge"), std::string::npos);
  Piece holed = panel();
  holed.holes = {circle(0.03, {0.2, 0.3})};
  EXPECT_NE(why(holed, slashed(0.05, 0)).find("hole"), std::string::npos);
  Piece beside = panel();
  beside.holes = {circle(0.01, {0.215, 0.3})};
  EXPECT_NE(why(beside, slashed(-0.05, -0.05)).find("lies where the paper is folded out"), std::string::npos);
  beside.holes.clear();
  beside.lines = {{"grain", {Curve::line({0.205, 0.1}, {0.205, 0.5})}, std::nullopt}};
  EXPECT_NE(why(beside, slashed(-0.05, -0.05)).find("take the line away first"), std::string::npos);
  Piece hollow;
  hollow.outline = polygon({{0, 0}, {0.4, 0}, {0.4, 0.6}, {0.3, 0.6}, {0.2, 0.2}, {0.1, 0.6}, {0, 0.6}});
  Slash over{"e2", "e5"};
  EXPECT_NE(why(hollow, over).find("cannot be cut straight"), std::string::npos);
}

}  // namespace
}  // namespace karinui
