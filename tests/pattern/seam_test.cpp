#include <gtest/gtest.h>

#include "karinui/pattern/edit.h"
#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

Seam seamOf(std::uint64_t id, std::vector<EdgeSpan> a, std::vector<EdgeSpan> b) {
  Seam seam;
  seam.id = {id};
  seam.name = "s" + std::to_string(id);
  seam.a = std::move(a);
  seam.b = std::move(b);
  return seam;
}

// Of a front and its facing, turned back along a line, the one goes round the fold outside the other.
TEST(Seam, ofAFacingIsFreeWhereAFoldRunsOut) {
  const auto freedAt = [](double angle, Seam::Tie tie) {
    Piece front = pieceOf(1, rectangle(0.3, 0.5));
    front.lines.push_back({"roll", {Curve::line({0.2, 0}, {0.2, 0.5})}, {}});
    front.lines.back().crease = Crease{angle, 0.9};
    Pattern pattern = patternOf({front, pieceOf(2, rectangle(0.3, 0.1, {0, 0.4}))});
    Seam& seam = pattern.seams[{1}] = seamOf(1, {{{1}, "top", 0, 1}}, {{{2}, "top", 0, 1}});
    seam.reversed = false, seam.tie = tie;
    const auto laid = lay(pattern, 0.02);
    EXPECT_TRUE(laid);
    std::set<double> open;  // of the nodes of the edge
    const Lattice& own = *laid->lattices.at({1});
    for (const std::uint32_t node : own.edges.at("top").nodes) open.insert(own.nodes[node].u);
    for (const SeamTie& held : laid->ties) open.erase(own.nodes[held.a].u);
    return open;
  };
  const std::set<double> free = freedAt(Crease::kSharpest, Seam::Tie::Pleat);
  EXPECT_GE(free.size(), 2u);
  for (const double u : free) EXPECT_NEAR(u, 0.2, 0.024 + 1e-9);
  EXPECT_TRUE(freedAt(1.6, Seam::Tie::Pleat).empty()) << "no more than a hem stands off";
  EXPECT_TRUE(freedAt(Crease::kSharpest, Seam::Tie::OneToOne).empty()) << "two pieces that go on from each other";
}

TEST(Seam, sidesGetEqualCountsAndEndsMeet) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5)), pieceOf(2, rectangle(0.3, 0.52, {1, 0}))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{2}, "left", 0, 1}});
  const auto laid = lay(pattern, 0.02);
  ASSERT_TRUE(laid);
  const auto &right = laid->lattices.at({1})->edges.at("right"), &left = laid->lattices.at({2})->edges.at("left");
  ASSERT_EQ(right.count, left.count);
  ASSERT_EQ(laid->ties.size(), right.count + 1);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const SeamTie& tie : laid->ties) pairs.insert({tie.a, tie.b});
  for (std::size_t k = 0; k <= right.count; ++k)
    EXPECT_TRUE(pairs.contains({right.nodes[k], left.nodes[left.count - k]}));
}

TEST(Seam, alongWhenNotReversed) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5)), pieceOf(2, rectangle(0.3, 0.5, {1, 0}))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{2}, "right", 0, 1}});
  pattern.seams[{1}].reversed = false;
  const auto laid = lay(pattern, 0.05);
  ASSERT_TRUE(laid);
  const auto& edge = laid->lattices.at({1})->edges.at("right");
  EXPECT_EQ(laid->ties.front().a, edge.nodes.front());
  EXPECT_EQ(laid->ties.front().b, laid->lattices.at({2})->edges.at("right").nodes.front());
}

TEST(Seam, gatheringTakesDisjointFoldedPairs) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5)), pieceOf(2, rectangle(0.3, 0.9, {1, 0}))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{2}, "left", 0, 1}});
  pattern.seams[{1}].tie = Seam::Tie::TwoToOne;
  for (const double spacing : {0.021, 0.02, 0.1}) {
    const auto laid = lay(pattern, spacing);
    ASSERT_TRUE(laid);
    const auto &right = laid->lattices.at({1})->edges.at("right"), &left = laid->lattices.at({2})->edges.at("left");
    ASSERT_EQ(2 * right.count, left.count);
    std::set<std::uint32_t> used;
    std::size_t pairs = 0;
    for (const SeamTie& tie : laid->ties) {
      EXPECT_EQ(tie.pieceA, PieceId{1});
      EXPECT_TRUE(used.insert(tie.b).second);
      if (tie.c == kNoNode) continue;
      ++pairs;
      EXPECT_TRUE(used.insert(tie.c).second);
    }
    EXPECT_EQ(laid->ties.size(), right.count + 1);
    EXPECT_EQ(pairs, right.count - 1);
  }
}

TEST(Seam, aRunOverTwoPiecesMeetsOneEdge) {
  // A sleeve cap of 0.5 into an armhole of 0.2 + 0.31; and two seams that share an edge in parts.
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5)), pieceOf(2, rectangle(0.2, 0.2, {1, 0})),
                               pieceOf(3, rectangle(0.2, 0.31, {2, 0}))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{2}, "left", 0, 1}, {{3}, "left", 0, 1}});
  pattern.seams[{2}] = seamOf(2, {{{1}, "left", 0, 0.4}}, {{{2}, "right", 0, 1}});
  for (const double spacing : {0.04, 0.02, 0.01}) {
    const auto laid = lay(pattern, spacing);
    ASSERT_TRUE(laid) << text(laid.error().what);
    const auto &cap = laid->lattices.at({1})->edges.at("right"), &one = laid->lattices.at({2})->edges.at("left"),
               &two = laid->lattices.at({3})->edges.at("left");
    EXPECT_EQ(cap.count, one.count + two.count);
    for (const auto& [id, lattice] : laid->lattices) expectSound(*lattice, "run");
    // The joint of the two pieces meets one node of the cap, both of them.
    std::map<std::uint32_t, int> met;
    for (const SeamTie& tie : laid->ties)
      if (tie.seam == SeamId{1}) ++met[tie.a];
    EXPECT_EQ(std::count_if(met.begin(), met.end(), [](auto& m) { return m.second == 2; }), 1);
    EXPECT_EQ(met.size(), cap.count + 1);
    bool end = false;
    for (double f : laid->lattices.at({1})->edges.at("left").fraction) end |= std::abs(f - 0.4) < 1e-9;
    EXPECT_TRUE(end) << "the end of a seam is a node";
  }
}

TEST(Seam, tubesAndDartsAreSewnToThemselves) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{1}, "left", 0, 1}});
  const auto tube = lay(pattern, 0.02);
  ASSERT_TRUE(tube);
  EXPECT_EQ(tube->ties.size(), 26u);
  Outline darted = polygon({{0, 0}, {0.15, 0}, {0.17, 0.12}, {0.19, 0}, {0.3, 0}, {0.3, 0.3}, {0, 0.3}});
  pattern = patternOf({pieceOf(1, darted)});
  pattern.seams[{1}] = seamOf(1, {{{1}, "e1", 0, 1}}, {{{1}, "e2", 0, 1}});
  const auto dart = lay(pattern, 0.02);
  ASSERT_TRUE(dart);
  EXPECT_EQ(dart->ties.size(), dart->lattices.at({1})->edges.at("e1").count) << "the tip is not sewn to itself";
}

// An edge of a fraction of a millimetre stays on the paper; in the lattice its two corners are one node, and what is
// sewn to both its neighbours meets there. Wherever along the outline it comes, also at its beginning.
TEST(Seam, edgesMuchShorterThanACellAreOnePlaceOfTheLattice) {
  for (const int turn : {0, 1, 2, 3, 4}) {
    Outline cut = polygon({{0, 0}, {0.3, 0}, {0.3, 0.4991}, {0.2999, 0.5}, {0, 0.5}});
    std::rotate(cut.edges.begin(), cut.edges.begin() + turn, cut.edges.end());
    Pattern pattern = patternOf({pieceOf(1, *checked(cut)), pieceOf(2, rectangle(0.3, 0.5, {1, 0}))});
    pattern.seams[{1}] = seamOf(1, {{{1}, "e1", 0, 1}}, {{{2}, "left", 0, 1}});
    pattern.seams[{2}] = seamOf(2, {{{1}, "e2", 0, 1}}, {{{2}, "top", 0, 0.004}});
    for (const double spacing : {0.04, 0.02, 0.01}) {
      const auto laid = lay(pattern, spacing);
      ASSERT_TRUE(laid) << text(laid.error().what);
      const Lattice& lattice = *laid->lattices.at({1});
      expectSound(lattice, "short edge " + std::to_string(turn));
      const auto &side = lattice.edges.at("e1"), &tiny = lattice.edges.at("e2"), &top = lattice.edges.at("e3");
      EXPECT_EQ(side.nodes.back(), top.nodes.front());
      EXPECT_EQ(tiny.nodes.front(), tiny.nodes.back());
      EXPECT_EQ(tiny.nodes.front(), top.nodes.front());
      EXPECT_EQ(lattice.border[top.first], top.nodes.front());
      EXPECT_EQ(side.count, laid->lattices.at({2})->edges.at("left").count);
      EXPECT_EQ(laid->ties.size(), side.count + 1);
      double least = 1;
      for (std::size_t k = 0; k < lattice.border.size(); ++k)
        least = std::min(least, distance(lattice.nodes[lattice.border[k]],
                                         lattice.nodes[lattice.border[(k + 1) % lattice.border.size()]]));
      EXPECT_GT(least, 0.3 * spacing);
    }
  }
}

// A curve drawn as a hundred chords of half a millimetre is a line with nodes as far apart as elsewhere, not one place.
TEST(Seam, aRunOfShortEdgesKeepsItsLength) {
  std::vector<Flat> corners{{0, 0}, {0.3, 0}};
  for (int k = 0; k < 100; ++k) corners.push_back({0.3, 0.1 + 0.0005 * k});
  corners.push_back({0.3, 0.4}), corners.push_back({0, 0.4});
  Pattern pattern = patternOf({pieceOf(1, *checked(polygon(corners)))});
  const auto laid = lay(pattern, 0.01);
  ASSERT_TRUE(laid);
  const Lattice& lattice = *laid->lattices.at({1});
  expectSound(lattice, "chords");
  EXPECT_LT(distance(lattice.nodes[lattice.edges.at("e101").nodes.front()], corners[101]), 1e-3);
  EXPECT_LT(distance(lattice.nodes[lattice.edges.at("e52").nodes.front()], corners[52]), 1e-3);
}

TEST(Seam, overlappingSeamsThatChaseEachOtherAreRefusedNotEndless) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 0.7}}, {{{1}, "right", 0.3, 1}});
  pattern.seams[{2}] = seamOf(2, {{{1}, "right", 0, 0.61803398}}, {{{1}, "right", 0.38196602, 1}});
  const auto laid = lay(pattern, 0.001);
  if (!laid) {
    EXPECT_NE(text(laid.error().what).find("edge to edge"), std::string::npos);
  }
}

TEST(Seam, refusesWhatIsNotThere) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "rihgt", 0, 1}}, {{{1}, "left", 0, 1}});
  auto laid = lay(pattern, 0.02);
  ASSERT_FALSE(laid);
  EXPECT_NE(text(laid.error().what).find("no edge rihgt"), std::string::npos);
  EXPECT_FALSE(lay(pattern, 0));
  EXPECT_FALSE(lay(pattern, std::nan("")));
}

TEST(Seam, easeAndDirection) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.3, 0.5)), pieceOf(2, rectangle(0.3, 0.6, {1, 0}))});
  pattern.seams[{1}] = seamOf(1, {{{1}, "right", 0, 1}}, {{{2}, "left", 0.5, 1}});
  EXPECT_NEAR(easeRatio(pattern, pattern.seams[{1}]), 5.0 / 3, 1e-12);
  EXPECT_NEAR(lengthMismatch(pattern, pattern.seams[{1}]), 0.2, 1e-12);
  const std::vector<Vec3> up{{0, 0, 0}, {0, 1, 0}}, near{{0.1, 0, 0}, {0.1, 1, 0}}, down{{0.1, 1, 0}, {0.1, 0, 0}};
  EXPECT_FALSE(facesReversed(up, near));
  EXPECT_TRUE(facesReversed(up, down));
  // Where the places do not tell, facing outlines run against each other.
  const std::vector<Vec3> across{{-0.1, 0.5, 0}, {0.1, 0.5, 0}};
  EXPECT_TRUE(facesReversed(up, across));
}

}  // namespace
}  // namespace karinui
