#include <gtest/gtest.h>

#include <random>

#include "karinui/pattern/darts.h"
#include "karinui/pattern/edit.h"
#include "support.h"

namespace karinui {
namespace {

using namespace test;

// A panel 0.6 m wide and 0.6 m high; darts from its upper edge, 0.12 m deep, and darts with two points.
struct Darted {
  Pattern pattern;
  std::uint64_t seams = 0;
  const Piece& piece() const { return *pattern.pieces.at({1}); }
  Darted() { pattern = patternOf({pieceOf(1, rectangle(0.6, 0.6), "panel")}); }
  void put(Piece piece) { pattern.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece)); }
  void sew(std::vector<std::string> a, std::vector<std::string> b) {
    Seam seam;
    seam.id = {++seams};
    for (const std::string& edge : a) seam.a.push_back({{1}, edge});
    for (const std::string& edge : b) seam.b.push_back({{1}, edge});
    pattern.seams[seam.id] = seam;
  }
  void dart(double at, double width, double lean) {  // from the right to the left, so that the edge is cut from its end
    const std::string edge = "top";
    const double whole = findEdge(piece(), edge)->curve.length();
    const auto made = addDart(piece(), edge, at / whole, width, Flat{0.6 - at + lean, 0.48}, "dart");
    ASSERT_TRUE(made) << text(made.error().what);
    updateSeams(pattern, made->edited.edges);
    put(made->edited.piece);
    sew({made->to}, {made->back});
  }
  void doubleDart(double at, double width, double lean) {
    const auto made = addDoubleDart(piece(), {at - lean, 0.1}, {at + lean, 0.4}, width, 0.4, "waist", {});
    ASSERT_TRUE(made) << text(made.error().what);
    put(made->piece);
    sew({made->edges[0], made->edges[1]}, {made->edges[2], made->edges[3]});
  }
};

NewPart fresh(std::size_t k) { return {{10 + k}, "part_" + std::to_string(k)}; }

// As the operation does it.
Pattern after(const Darted& before, const CutAcross& across) {
  Pattern now = before.pattern;
  updateSeams(now, across.cut.edges);
  now.pieces.erase({1});
  for (const Piece& piece : across.cut.pieces) now.pieces[piece.id] = std::make_shared<const Piece>(piece);
  std::uint64_t id = 100;
  for (const CutDart& dart : across.darts) {
    const auto parts = dividedDart(now.seams.at(dart.seam), dart.turned);
    now.seams.erase(dart.seam);
    for (Seam part : parts) part.id = {id++}, now.seams[part.id] = part;
  }
  return now;
}

double areaOf(const Piece& piece) {
  double area = piece.outline.area();
  for (const Outline& hole : piece.holes) area -= hole.area();
  return area;
}

void expectWhole(const Pattern& now, double area) {
  double all = 0;
  for (const auto& [id, piece] : now.pieces) {
    all += areaOf(*piece);
    EXPECT_TRUE(checked(piece->outline)) << piece->name;
    std::set<std::string> names;
    for (const Edge& edge : piece->outline.edges) EXPECT_TRUE(names.insert(edge.name).second) << edge.name;
  }
  EXPECT_NEAR(all, area, 1e-9) << "no cloth is lost or gained";
  for (const auto& [id, seam] : now.seams) {
    EXPECT_NEAR(length(now, seam.a), length(now, seam.b), 3e-3);
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) EXPECT_TRUE(findEdge(*now.pieces.at(span.piece), span.edge)) << span.edge;
  }
}

TEST(CutAcrossDarts, GivesAPartBesideEachDartAndTheRestItsPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 40; ++k) {
    Darted panel;
    const int count = 1 + k % 3;
    for (int n = count; n > 0; --n)  // each takes the first part of what is left of the edge
      panel.dart(0.6 * n / (count + 1), 0.02 + 0.02 * share(random), 0.02 * (share(random) - 0.5));
    const double low = 0.5 + 0.06 * share(random), slope = 0.03 * (share(random) - 0.5);
    std::vector<Flat> line{{-0.01, low - slope}, {0.61, low + slope}};
    if (k % 2) std::reverse(line.begin(), line.end());
    const auto across = cutAcrossDarts(panel.pattern, panel.piece(), line, fresh);
    ASSERT_TRUE(across) << text(across.error().what);
    ASSERT_EQ(across->cut.pieces.size(), count + 2u);
    EXPECT_EQ(across->darts.size(), static_cast<std::size_t>(count));
    const Pattern now = after(panel, *across);
    expectWhole(now, areaOf(panel.piece()));
    std::size_t points = 0;
    for (const PaperDart& dart : dartsOf(now)) points += dart.piece == PieceId{1};
    EXPECT_EQ(points, static_cast<std::size_t>(count)) << "what is left of each dart is a dart";
    // Closed, the cut runs on: both banks of a dart are as far from its point.
    for (const PaperDart& dart : dartsOf(now))
      EXPECT_NEAR(distance(dart.from, dart.point), distance(dart.until, dart.point), 2e-3);
  }
}

TEST(CutAcrossDarts, TurnsADartWithTwoPointsIntoADartOfEachPart) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 40; ++k) {
    Darted panel;
    const int count = 1 + k % 3;
    for (int n = 1; n <= count; ++n)
      panel.doubleDart(0.6 * n / (count + 1), 0.02 + 0.02 * share(random), 0.02 * (share(random) - 0.5));
    Piece marked = panel.piece();
    marked.marks = {{"leg", marked.holes[0].edges[1].name, 0.7, {}}};
    const Flat place = marked.holes[0].edges[1].curve.atFraction(0.7);
    panel.put(marked);
    const double low = 0.15 + 0.2 * share(random), slope = 0.05 * (share(random) - 0.5);
    std::vector<Flat> line{{-0.01, low - slope}, {0.61, low + slope}};
    if (k % 2) std::reverse(line.begin(), line.end());
    const auto across = cutAcrossDarts(panel.pattern, panel.piece(), line, fresh);
    ASSERT_TRUE(across) << text(across.error().what);
    ASSERT_EQ(across->cut.pieces.size(), 2u);
    const Pattern now = after(panel, *across);
    expectWhole(now, areaOf(panel.piece()));
    EXPECT_EQ(now.seams.size(), 2u * count);
    for (const auto& [id, seam] : now.seams) {
      EXPECT_TRUE(seam.reversed);
      for (const auto* side : {&seam.a, &seam.b})  // in the outlines' order, each going on where the one before ends
        for (std::size_t i = 0; i + 1 < side->size(); ++i)
          EXPECT_EQ(findEdge(*now.pieces.at((*side)[i].piece), (*side)[i].edge)->curve.end,
                    findEdge(*now.pieces.at((*side)[i + 1].piece), (*side)[i + 1].edge)->curve.start);
      // The sides meet at the dart's point.
      const auto& outline = now.pieces.at(seam.a.front().piece)->outline;
      const Flat ends[] = {outline.edges[*outline.find(seam.a.back().edge)].curve.end,
                           outline.edges[*outline.find(seam.a.front().edge)].curve.start},
                 starts[] = {outline.edges[*outline.find(seam.b.front().edge)].curve.start,
                             outline.edges[*outline.find(seam.b.back().edge)].curve.end};
      EXPECT_TRUE(ends[0] == starts[0] || ends[1] == starts[1]);
    }
    int found = 0;
    for (const auto& [id, piece] : now.pieces)
      for (const Mark& mark : piece->marks) {
        EXPECT_LT(distance(findEdge(*piece, mark.edge)->curve.atFraction(mark.fraction), place), 1e-9);
        ++found;
      }
    EXPECT_EQ(found, 1);
  }
}

TEST(CutAcrossDarts, TakesOneOfEachAndASlitBesideThem) {
  Darted panel;
  panel.dart(0.45, 0.03, 0);  // at u = 0.15
  panel.doubleDart(0.4, 0.03, 0);
  const auto both =
      cutAcrossDarts(panel.pattern, panel.piece(), {{-0.01, 0.55}, {0.2, 0.55}, {0.3, 0.25}, {0.61, 0.25}}, fresh);
  ASSERT_TRUE(both) << text(both.error().what);
  EXPECT_EQ(both->cut.pieces.size(), 3u);
  expectWhole(after(panel, *both), areaOf(panel.piece()));
  const auto slit = cutAcrossDarts(panel.pattern, panel.piece(), {{-0.01, 0.55}, {0.2, 0.55}}, fresh);
  ASSERT_TRUE(slit) << text(slit.error().what);
  EXPECT_EQ(slit->cut.pieces.size(), 2u);
  expectWhole(after(panel, *slit), areaOf(panel.piece()));
}

// Where there is no dart a cut is what it always was, to the last bit: recorded garments keep their hashes.
TEST(CutAcrossDarts, WithoutADartIsAPlainCut) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 60; ++k) {
    const Piece piece = pieceOf(1, randomOutline(random, 0.5));
    const Pattern pattern = patternOf({piece});
    const Flat in{0.05 * share(random), 0.05 * share(random)}, out{share(random) - 0.5, share(random) - 0.5};
    std::vector<Flat> line{out * 3, in};
    if (k % 2) line.push_back(out * -3);
    const auto plain = cutPiece(piece, line, {10}, "part_0");
    const auto across = cutAcrossDarts(pattern, piece, line, fresh);
    ASSERT_EQ(static_cast<bool>(plain), static_cast<bool>(across));
    if (!plain) continue;
    ASSERT_EQ(plain->pieces.size(), across->cut.pieces.size());
    for (std::size_t i = 0; i < plain->pieces.size(); ++i)
      EXPECT_EQ(plain->pieces[i].outline, across->cut.pieces[i].outline) << k;
  }
}

TEST(CutAcrossDarts, RefusesALineThatEndsInADart) {
  Darted panel;
  panel.dart(0.3, 0.04, 0);
  panel.doubleDart(0.4, 0.03, 0);
  const auto reason = [&](std::vector<Flat> line) {
    const auto cut = cutAcrossDarts(panel.pattern, panel.piece(), std::move(line), fresh);
    return cut ? std::string("cut") : text(cut.error().what);
  };
  EXPECT_NE(reason({{-0.01, 0.25}, {0.4, 0.25}}).find("goes into a dart"), std::string::npos);
  EXPECT_NE(reason({{-0.01, 0.2}, {0.395, 0.21}, {-0.01, 0.22}}).find("goes into a dart"), std::string::npos);
  // Round the point: no crossing.
  EXPECT_EQ(reason({{-0.01, 0.45}, {0.61, 0.45}}), "cut");
}

}  // namespace
}  // namespace karinui
