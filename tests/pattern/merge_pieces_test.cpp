#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "karinui/pattern/edit.h"
#include "support.h"

namespace karinui {
namespace {

using namespace test;

std::vector<std::string> cutEdges(const Piece& piece) {
  std::vector<std::string> run;
  const auto& edges = piece.outline.edges;
  const auto isCut = [](const Edge& edge) { return edge.name.starts_with("cut"); };
  const std::size_t n = edges.size();
  std::size_t first = 0;
  while (!(isCut(edges[first]) && !isCut(edges[(first + n - 1) % n]))) ++first;
  for (std::size_t k = first; isCut(edges[k % n]); ++k) run.push_back(edges[k % n].name);
  return run;
}

// The piece with its paper turned and shifted.
Piece elsewhere(Piece piece, const PaperMove& move) {
  for (Edge& edge : piece.outline.edges) edge.curve = move(edge.curve);
  for (Outline& hole : piece.holes)
    for (Edge& edge : hole.edges) edge.curve = move(edge.curve);
  for (InternalLine& line : piece.lines)
    for (Curve& curve : line.curves) curve = move(curve);
  for (Mark& mark : piece.marks) mark.place = move(mark.place);
  return piece;
}

TEST(MergedPieces, TakeBackACutWhereverTheOtherPaperLies) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 60; ++k) {
    Piece piece = pieceOf(1, rectangle(0.4, 0.5));
    piece.marks = {{"low", "", 0, {0.2, 0.02}}, {"high", "", 0, {0.2, 0.48}}};
    piece.lines = {{"above", {Curve::line({0.1, 0.45}, {0.3, 0.47})}, {}}};
    const auto cut = cutPiece(piece,
                              {{0, 0.1 + 0.3 * share(random)},
                               {0.1 + 0.2 * share(random), 0.1 + 0.3 * share(random)},
                               {0.4, 0.1 + 0.3 * share(random)}},
                              {2}, "upper");
    ASSERT_TRUE(cut);
    const Piece& one = cut->pieces[0];
    const Piece two = elsewhere(
        cut->pieces[1],
        {{share(random), share(random)}, {share(random), share(random)}, 2 * std::numbers::pi * share(random)});
    const auto merged = mergePieces(one, cutEdges(one), two, cutEdges(two));
    ASSERT_TRUE(merged) << text(merged.error().what);
    const Piece& whole = merged->piece;
    EXPECT_EQ(whole.id, piece.id);
    EXPECT_NEAR(whole.outline.area(), piece.outline.area(), 1e-9);
    ASSERT_EQ(whole.outline.edges.size(), 6u);
    for (const Edge& edge : whole.outline.edges)
      EXPECT_LT(distanceToRing(piece.outline.flattened(), edge.curve.at(0.5)), 1e-9) << edge.name;
    ASSERT_EQ(whole.marks.size(), 2u);
    for (const Mark& mark : whole.marks)
      EXPECT_LT(distance(mark.place, piece.marks[mark.name == "low" ? 0 : 1].place), 1e-9);
    ASSERT_EQ(whole.lines.size(), 1u);
    EXPECT_LT(distance(whole.lines[0].curves[0].end, {0.3, 0.47}), 1e-9);
    for (const auto& [was, parts] : merged->edges)
      for (const EdgePart& part : parts) EXPECT_TRUE(findEdge(whole, part.now.edge) || part.now.edge == "above");
  }
}

TEST(MergedPieces, KeepCurvesNotchesAndHolesOfBoth) {
  // Two halves of a yoke: the second's sides are curved, it has a notch, and a hole of its own.
  Piece one = pieceOf(1, rectangle(0.2, 0.1)), two = pieceOf(2, rectangle(0.3, 0.1));
  two.outline.edges[1].curve = Curve::arc({0.3, 0}, {0.3, 0.1}, 0.2);
  two.outline.edges[2].curve = Curve::cubic({0.3, 0.1}, {0.2, 0.13}, {0.1, 0.08}, {0, 0.1});
  two.marks = {{"centre", "top", 0.25, {}}, {"meets", "left", 0.5, {}}};
  const Outline hole = polygon({{0.1, 0.03}, {0.13, 0.03}, {0.13, 0.06}, {0.1, 0.06}}, "hole");
  one.holes = {hole}, two.holes = {hole};
  const std::vector<std::string> right{"right"}, left{"left"};
  const auto merged = mergePieces(one, right, two, left);
  ASSERT_TRUE(merged) << text(merged.error().what);
  const Piece& whole = merged->piece;
  EXPECT_NEAR(whole.outline.area(), one.outline.area() + two.outline.area(), 1e-9);
  const auto now = [&](const char* edge) { return merged->edges.at({{2}, edge}).at(0).now.edge; };
  EXPECT_NEAR(findEdge(whole, now("top"))->curve.length(), findEdge(two, "top")->curve.length(), 1e-9);
  EXPECT_NEAR(findEdge(whole, now("right"))->curve.bulge, 0.2, 1e-12);
  ASSERT_EQ(whole.marks.size(), 1u) << "a notch of the edge that goes goes with it";
  EXPECT_EQ(whole.marks[0].edge, now("top"));
  EXPECT_EQ(whole.marks[0].fraction, 0.25);
  ASSERT_EQ(whole.holes.size(), 2u);
  std::set<std::string> names;
  for (const Edge& edge : whole.outline.edges) EXPECT_TRUE(names.insert(edge.name).second) << edge.name;
  for (const Outline& h : whole.holes)
    for (const Edge& edge : h.edges) EXPECT_TRUE(names.insert(edge.name).second) << edge.name;
  EXPECT_TRUE(merged->edges.at({{1}, "right"}).empty());
}

TEST(MergedPieces, RefusesWhatDoesNotLieFlatAsOne) {
  const Piece one = pieceOf(1, rectangle(0.2, 0.1)), longer = pieceOf(2, rectangle(0.2, 0.104));
  const std::vector<std::string> right{"right"}, left{"left"}, none{"gone"}, apart{"top", "bottom"},
      three{"left", "top"};
  const auto reason = [](const auto& result) { return result ? std::string() : text(result.error().what); };
  EXPECT_NE(reason(mergePieces(one, right, longer, left)).find("100.0 and 104.0 mm"), std::string::npos);
  Piece round = pieceOf(2, rectangle(0.2, 0.1));
  round.outline.edges[3].curve = Curve::arc({0, 0.1}, {0, 0}, 0.2);
  Piece own = one;
  own.outline.edges[1].curve = Curve::arc({0.2, 0}, {0.2, 0.1}, 0.2);
  EXPECT_NE(reason(mergePieces(own, right, round, left)).find("not alike"), std::string::npos)
      << reason(mergePieces(own, right, round, left));
  EXPECT_NE(reason(mergePieces(one, none, longer, left)).find("no edge gone"), std::string::npos);
  EXPECT_NE(reason(mergePieces(one, apart, longer, left)).find("does not go on"), std::string::npos);
  // A bay whose arms would lie on the other's.
  const Piece bay =
      pieceOf(2, polygon({{0, 0}, {0.3, 0}, {0.3, 0.3}, {0.2, 0.3}, {0.2, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {0, 0.3}}));
  const Piece wedge = pieceOf(1, polygon({{0, -0.05}, {0.2, 0}, {0.2, 0.1}, {0, 0.15}}));
  const std::vector<std::string> floor{"e4"}, narrow{"e1"};
  EXPECT_NE(reason(mergePieces(wedge, narrow, bay, floor)).find("Laid together"), std::string::npos);
}

}  // namespace
}  // namespace karinui
