#include "karinui/pattern/edit.h"

#include <gtest/gtest.h>

#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

std::string reason(const auto& result) {
  return result ? std::string("it was not refused") : text(result.error().what);
}

TEST(Checked, refusesWithThePlace) {
  EXPECT_NE(reason(checked(polygon({{0, 0}, {0.2, 0.2}, {0.2, 0}, {0, 0.2}})))
                .find("crosses or touches itself at (100.0, 100.0)"),
            std::string::npos);
  Outline open = rectangle(0.2, 0.2);
  open.edges[2].curve.end = {0, 0.19};
  EXPECT_NE(reason(checked(open)).find("open"), std::string::npos);
  EXPECT_NE(reason(checked(rectangle(0.005, 0.005))).find("1 cm2"), std::string::npos);
  EXPECT_NE(reason(checked(rectangle(0.0005, 1))).find("at least 1 mm"), std::string::npos);
  EXPECT_TRUE(checked(polygon({{0, 0}, {0.2, 0}, {0.2, 0.1999}, {0.1999, 0.2}, {0, 0.2}})));
  EXPECT_NE(
      reason(checked(polygon({{0, 0}, {0.2, 0}, {0.2, 0.2}, {0.2, 0.200005}, {0, 0.2}}))).find("at least 0.01 mm"),
      std::string::npos);
  EXPECT_FALSE(checked(rectangle(std::nan(""), 1)));
  EXPECT_FALSE(checked(rectangle(HUGE_VAL, 1)));
  EXPECT_FALSE(checked(Outline{}));
  for (const char* name : {"", "side seam", "a.b", "a;b", "a/b", "a:b", "a\n", "\xe3\x81\x82"}) {
    Outline called = rectangle(0.2, 0.2);
    called.edges[1].name = name;
    EXPECT_FALSE(checked(called)) << name;
  }
  Outline clockwise = rectangle(0.2, 0.1);
  std::reverse(clockwise.edges.begin(), clockwise.edges.end());
  for (Edge& e : clockwise.edges) e.curve = e.curve.reversed();
  const auto turned = checked(clockwise);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->area(), 0.02, 1e-15);
}

TEST(Outline, lengthsAndAreasOfClosedForms) {
  EXPECT_NEAR(circle(0.25).length(), 2 * std::numbers::pi * 0.25, 1e-12);
  EXPECT_NEAR(circle(0.25).area(), std::numbers::pi * 0.0625, 1e-12);
  std::mt19937 random(11);
  for (int k = 0; k < 30; ++k) {
    const Outline outline = randomOutline(random, 0.3);
    const Ring fine = outline.flattened(1e-9);
    EXPECT_NEAR(outline.area(), signedArea(fine), 1e-8);
    EXPECT_NEAR(outline.length(), perimeter(fine), 1e-6);
  }
}

TEST(Cut, fromEdgeToEdgeMakesTwoPieces) {
  std::mt19937 random(5);
  int done = 0;
  for (int k = 0; k < 60; ++k) {
    auto outline = checked(randomOutline(random, 0.3));
    if (!outline) continue;
    const Piece piece = pieceOf(1, *outline);
    std::uniform_real_distribution<double> unit(0, 2 * std::numbers::pi);
    const double a = unit(random);
    const Flat far{std::cos(a), std::sin(a)};
    const auto cut = cutPiece(piece, {far, Flat{0.01, -0.02}, -far}, {2}, "half");
    if (!cut) continue;  // now and then the line leaves and comes back
    ++done;
    ASSERT_EQ(cut->pieces.size(), 2u);
    EXPECT_NEAR(cut->pieces[0].outline.area() + cut->pieces[1].outline.area(), outline->area(), 1e-9);
    EXPECT_EQ(cut->pieces[0].id, PieceId{1});
    // Every old edge is there to the last tenth of a micrometre, in parts.
    for (const Edge& edge : outline->edges) {
      const auto parts = cut->edges.find({{1}, edge.name});
      double sum = 0;
      const auto add = [&](PieceId id, const std::string& name) {
        const Edge* now = findEdge(cut->pieces[id == PieceId{1} ? 0 : 1], name);
        ASSERT_TRUE(now) << name;
        sum += now->curve.length();
      };
      if (parts == cut->edges.end())
        add({1}, edge.name);
      else
        for (const auto& part : parts->second) add(part.now.piece, part.now.edge);
      EXPECT_NEAR(sum, edge.curve.length(), 1e-7);
    }
    const auto laid = lay(patternOf(cut->pieces), 0.02);
    ASSERT_TRUE(laid) << text(laid.error().what);
    for (const auto& [id, lattice] : laid->lattices) expectSound(*lattice, "half");
  }
  EXPECT_GT(done, 30);
}

TEST(Cut, aSlitHasTwoBanksAndOneTip) {
  const Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  for (const bool fromTip : {false, true}) {
    std::vector<Flat> line{{0.2, -0.05}, {0.2, 0.13}, {0.24, 0.25}};
    if (fromTip) std::reverse(line.begin(), line.end());
    const auto cut = cutPiece(piece, line, {2}, "");
    ASSERT_TRUE(cut) << reason(cut);
    ASSERT_EQ(cut->pieces.size(), 1u);
    EXPECT_NEAR(cut->pieces[0].outline.area(), 0.2, 1e-12);
    EXPECT_EQ(cut->pieces[0].outline.edges.size(), 9u);
    for (const double spacing : {0.04, 0.015}) {
      const auto laid = lay(patternOf(cut->pieces), spacing);
      ASSERT_TRUE(laid) << text(laid.error().what);
      const Lattice& lattice = *laid->lattices.at({1});
      expectSound(lattice, "slit");
      const auto &in = lattice.edges.at("cut"), &out = lattice.edges.at("cut_4");
      EXPECT_EQ(in.count, out.count);
      for (std::size_t k = 0; k <= in.count; ++k) {
        EXPECT_EQ(lattice.nodes[in.nodes[k]], lattice.nodes[out.nodes[out.count - k]]);
        EXPECT_NE(in.nodes[k], out.nodes[out.count - k]);
      }
      EXPECT_EQ(lattice.edges.at("cut_2").nodes.back(), lattice.edges.at("cut_3").nodes.front());
      if (const char* to = std::getenv("KARINUI_PLOT"))
        draw(std::string(to) + "/slit_" + std::to_string(int(spacing * 1e3)) + ".svg", {laid->lattices.at({1})});
    }
    // A slit may be cut longer, and its bank divided, and all still lies.
    const auto split = splitEdge(cut->pieces[0], "cut", 0.37);
    ASSERT_TRUE(split);
    const auto laid = lay(patternOf({split->piece}), 0.015);
    ASSERT_TRUE(laid) << text(laid.error().what);
    expectSound(*laid->lattices.at({1}), "divided bank");
  }
}

// A second cut takes cloth away beside the slit, so that one bank goes on where the other ends: where a slit's mouth
// lies is rounded there, and mirrored otherwise.
TEST(Cut, aSlitIsSoundWhicheverWayItIsTurned) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int done = 0;
  for (int round = 0; round < 2000; ++round) {
    const Flat tip{0.15 + 0.1 * unit(random), 0.05 + 0.1 * unit(random)},
        mouth{0.1 + 0.2 * unit(random), 0.5 + 0.01 * unit(random)};
    const auto slit = cutPiece(pieceOf(1, rectangle(0.4, 0.5)), {tip, mouth}, {2}, "");
    ASSERT_TRUE(slit) << reason(slit);
    const double beside = unit(random) < 0.5 ? -0.02 : 0.42;
    const Flat from = lerp(tip, mouth, 0.3 + 0.4 * unit(random));
    const auto cut =
        cutPiece(slit->pieces[0], {from + Flat{beside < 0 ? 1e-5 : -1e-5, 0}, {beside, 0.4}}, {2}, "other");
    if (!cut || cut->pieces.size() != 2) continue;
    ++done;
    for (const Piece& piece : cut->pieces) {
      EXPECT_TRUE(checked(piece.outline));
      const auto turned = checked(mirrored(piece).outline);
      EXPECT_TRUE(turned) << round << ": " << reason(turned);
    }
  }
  EXPECT_GT(done, 1000);
}

TEST(Cut, refusesWithTheReason) {
  Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  EXPECT_NE(reason(cutPiece(piece, {{0.1, 0.1}, {0.3, 0.3}}, {2}, "")).find("does not reach the outline"),
            std::string::npos);
  EXPECT_NE(reason(cutPiece(piece, {{1, 1}, {2, 2}}, {2}, "")).find("does not run over"), std::string::npos);
  EXPECT_NE(reason(cutPiece(piece, {{-0.1, 0.1}, {0.3, 0.1}, {0.3, 0.3}, {0.2, 0.3}, {0.2, -0.1}}, {2}, ""))
                .find("crosses itself at (200.0, 100.0)"),
            std::string::npos);
  EXPECT_NE(reason(cutPiece(piece, {{0.1, 0.1}, {-0.1, 0.2}, {0.1, 0.3}}, {2}, "")).find("comes back"),
            std::string::npos);
  EXPECT_FALSE(cutPiece(piece, {}, {2}, ""));
  EXPECT_FALSE(cutPiece(piece, {{0, 0}, {std::nan(""), 1}}, {2}, ""));
  piece.holes = {circle(0.05, {0.2, 0.25}, "hole")};
  EXPECT_NE(reason(cutPiece(piece, {{-0.1, 0.25}, {0.5, 0.25}}, {2}, "")).find("hole"), std::string::npos);
}

TEST(Cut, endsNearACornerGoToIt) {
  Piece piece;
  piece.id = {1}, piece.name = "front", piece.outline = rectangle(0.4, 0.5);
  const auto cut = [&](std::vector<Flat> line) { return cutPiece(piece, std::move(line), {2}, "neck", {}, true); };
  // A V from both upper corners, drawn some way beside them.
  const auto v = cut({{0.3985, 0.5}, {0.2, 0.3}, {0.0012, 0.5}});
  ASSERT_TRUE(v) << reason(v);
  EXPECT_EQ(v->pieces[0].outline.edges.size(), 5u);
  EXPECT_EQ(v->pieces[1].outline.edges.size(), 3u);
  for (const Edge& edge : v->pieces[0].outline.edges) EXPECT_GT(edge.curve.length(), 0.2);
  EXPECT_EQ(cutPiece(piece, {{0.3985, 0.5}, {0.2, 0.3}, {0.0012, 0.5}}, {2}, "neck")->pieces[0].outline.edges.size(),
            7u);
  // Farther away it was meant so.
  EXPECT_EQ(cut({{0.396, 0.5}, {0.2, 0.3}, {-0.01, 0.4}})->pieces[0].outline.edges.size(), 6u);
  // A strip of 2 mm off an edge stays one, and so does a corner's tip.
  const auto strip = cut({{-0.01, 0.002}, {0.41, 0.002}});
  ASSERT_TRUE(strip) << reason(strip);
  EXPECT_NEAR(strip->pieces[1].outline.area(), 0.4 * 0.002, 1e-9);
  const auto slit = cut({{0, 0.499}, {0.2, 0.3}});
  ASSERT_TRUE(slit) << reason(slit);
  EXPECT_EQ(slit->pieces[0].outline.edges.size(), 6u) << "a slit begins at the corner, too";
}

TEST(Cut, endsSnapAndSeamsFollow) {
  Pattern pattern = patternOf({pieceOf(1, rectangle(0.4, 0.5)), pieceOf(2, rectangle(0.4, 0.5, {1, 0}))});
  Seam side;
  side.id = {1};
  side.a = {{{1}, "right", 0.1, 1}};
  side.b = {{{2}, "left", 0, 0.9}};
  pattern.seams[{1}] = side;
  const double before = length(pattern, side.a);
  const auto cut = cutPiece(*pattern.pieces.at({1}), {{0.003, 0.2}, {0.398, 0.3}}, {3}, "lower");
  ASSERT_TRUE(cut) << reason(cut);
  ASSERT_EQ(cut->pieces.size(), 2u);
  for (const Piece& p : cut->pieces) pattern.pieces[p.id] = std::make_shared<const Piece>(p);
  updateSeams(pattern, cut->edges);
  EXPECT_EQ(pattern.seams[{1}].a.size(), 2u);
  EXPECT_NEAR(length(pattern, pattern.seams[{1}].a), before, 1e-9);
  const auto laid = lay(pattern, 0.02);
  ASSERT_TRUE(laid) << text(laid.error().what);
}

TEST(Edit, mirroringTwiceIsTheSame) {
  std::mt19937 random(2);
  const Piece piece = pieceOf(1, randomOutline(random, 0.3));
  const Piece once = mirrored(piece), twice = mirrored(once);
  EXPECT_NEAR(once.outline.area(), piece.outline.area(), 1e-12);
  for (std::size_t k = 0; k < piece.outline.edges.size(); ++k) {
    EXPECT_EQ(piece.outline.edges[k].name, twice.outline.edges[k].name);
    EXPECT_LT(distance(piece.outline.edges[k].curve.at(0.3), twice.outline.edges[k].curve.at(0.3)), 1e-12);
  }
}

TEST(Edit, cornersMoveAndOutlinesAreReplacedByName) {
  const Piece piece = pieceOf(1, rectangle(0.4, 0.5));
  const auto moved = moveCorner(piece, "top", {0.45, 0.55});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->outline.edges[1].curve.end, (Flat{0.45, 0.55}));
  EXPECT_FALSE(moveCorner(piece, "top", {-0.2, 0.25}));
  EXPECT_TRUE(reshaped(piece, moved->outline));
  EXPECT_FALSE(reshaped(piece, circle(0.2)));
}

TEST(Edit, everyCornerMovesWithBothItsEdges) {
  for (const std::size_t corners : {3u, 5u, 6u, 7u}) {
    std::vector<Flat> round;
    for (std::size_t k = 0; k < corners; ++k) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
      round.push_back({0.3 * std::cos(turn), 0.3 * std::sin(turn)});
    }
    for (std::size_t k = 0; k < corners; ++k) {
      std::vector<Flat> wanted = round;
      wanted[k] = round[k] * 1.2;
      const auto moved = moveCorner(pieceOf(1, polygon(round)), "e" + std::to_string(k), wanted[k]);
      ASSERT_TRUE(moved);
      const Outline expected = polygon(wanted);
      for (std::size_t e = 0; e < corners; ++e) {
        EXPECT_EQ(moved->outline.edges[e].curve.start, expected.edges[e].curve.start) << corners << " " << k;
        EXPECT_EQ(moved->outline.edges[e].curve.end, expected.edges[e].curve.end) << corners << " " << k;
      }
    }
  }
}

TEST(Edit, ADartsSidesAreTruedToOneLength) {
  Piece piece;
  piece.id = PieceId{1};
  piece.name = "skirt";
  piece.outline.edges = {{"waist", Curve::line({0, 0}, {0.4, 0})},
                         {"right", Curve::line({0.4, 0}, {0.4, 0.6})},
                         {"hem", Curve::line({0.4, 0.6}, {0, 0.6})},
                         {"left", Curve::line({0, 0.6}, {0, 0})}};
  const auto dart = addDart(piece, "waist", 0.5, 0.03, {0.24, 0.1}, "dart");
  ASSERT_TRUE(dart) << text(dart.error().what);
  const Piece& after = dart->edited.piece;
  const Curve to = findEdge(after, dart->to)->curve, back = findEdge(after, dart->back)->curve;
  EXPECT_NEAR(to.length(), back.length(), 1e-12);
  EXPECT_NEAR(to.length(), std::hypot(0.055, 0.1), 1e-9) << "the shorter side grew";
  EXPECT_EQ(findEdge(after, "waist")->curve.end, to.start);
}

TEST(Edit, ASplitEdgesPartIsCountedOn) {
  Piece piece;
  piece.id = PieceId{1};
  piece.name = "band";
  piece.outline.edges = {{"hem", Curve::line({0, 0}, {0.4, 0})},
                         {"right", Curve::line({0.4, 0}, {0.4, 0.1})},
                         {"top", Curve::line({0.4, 0.1}, {0, 0.1})},
                         {"left", Curve::line({0, 0.1}, {0, 0})}};
  const auto once = splitEdge(piece, "hem", 0.5);
  ASSERT_TRUE(once);
  const auto twice = splitEdge(once->piece, "hem_2", 0.5);
  ASSERT_TRUE(twice);
  EXPECT_TRUE(findEdge(twice->piece, "hem_3"));
  EXPECT_FALSE(findEdge(twice->piece, "hem_2_2"));
}

}  // namespace
}  // namespace karinui
