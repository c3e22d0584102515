// Cloth in layers: pleats that hang from a pinned waist, a patch sewn onto a line inside another piece, and a lining
// that is laid between two layers.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/check/check.h"
#include "karinui/cloth/lay_between.h"
#include "karinui/pattern/pleats.h"

namespace karinui::test {
namespace {

constexpr double kSpacing = 0.01, kLift = 0.003;

void expectSewnAndApart(const ClothLevel& level) {
  const ClothCheck stands = check(level.cloth, level.state, nullptr);
  EXPECT_EQ(stands.clothClothCrossings, 0u);
  EXPECT_EQ(stands.foldCrossings, 0u);
  for (const Tie& tie : level.cloth.ties)
    EXPECT_LT(distance(level.state.position[tie.a], level.state.position[tie.b]), 1e-9);
}

// The mean depth (z) of the nodes of a piece that a place is asked of.
double meanDepth(const ClothLevel& level, std::size_t piece, const std::function<bool(Flat)>& wanted) {
  const ClothPiece& part = level.cloth.pieces[piece];
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < part.lattice->nodes.size(); ++k)
    if (wanted(part.lattice->nodes[k])) sum += level.state.position[part.firstNode + k].z, ++count;
  KARINUI_ASSERT(count > 0);
  return sum / count;
}

struct PleatedStrip {
  PleatedPiece made;
  ClothLevel level;
};

// A strip 20 cm wide with one knife pleat of 2 cm in its top, folded, the top pinned.
PleatedStrip pleatedStrip(bool pressed) {
  auto paper = rectangle(1, 0.2, 0.25);
  PleatPlan plan;
  plan.edge = "top", plan.at = {0.5}, plan.depth = 0.02, plan.along = {0, -1};
  auto made = addPleats(*paper, plan);
  KARINUI_ASSERT(made);
  for (InternalLine& line : made->edited.piece.lines) {
    if (pressed && line.name == made->folds[0].fold) line.crease = Crease{-Crease::kSharpest, 0.9};
    if (pressed && line.name == made->folds[0].inner) line.crease = Crease{Crease::kSharpest, 0.9};
  }
  Pattern pattern = patternOf({std::make_shared<Piece>(made->edited.piece)});
  std::uint64_t id = 10;
  for (const auto& layer : made->layers)
    pattern.seams[{id}] = {{id}, "", {layer.a}, {layer.b}, layer.reversed, Seam::Tie::Pleat}, ++id;
  ClothChoice choice;
  for (double u = 0; u < 0.241; u += 0.005) choice.pins[{1}].push_back({u, 0.25});
  choice.pinRadius = 0.003;
  ClothLevel level = levelOf(pattern, kSpacing, *preset("wool suiting"), choice);
  level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
    const FoldedPlace in = made->folded(p);
    const double mouth = std::fmin(1, (0.25 - p.v) / 0.02);  // at the pinned edge the layers meet
    return Vec3{in.place.u, in.place.v, in.lifted * kLift * mouth};
  });
  return {*std::move(made), std::move(level)};
}

// Pinned at its waist it lies on a slope, its layers over each other.
TEST(Pleat, LiesInThreeLayers) {
  Workers workers;
  for (const bool pressed : {true, false}) {
    PleatedStrip strip = pleatedStrip(pressed);
    EXPECT_TRUE(strip.level.cloth.pleated);
    std::vector<ClothLevel> levels{std::move(strip.level)};
    const PlaneBody slope({0, 0, 1}, -0.003);
    SettleSettings settings;
    settings.gravity = {0, -7, -7};
    const auto report = settle(levels, slope, settings, {}, workers);
    ASSERT_TRUE(report) << text(report.error().what);
    EXPECT_TRUE(report->settled) << text(report->why);
    expectSewnAndApart(levels[0]);
    // A few centimetres below the waist the three layers lie over each other in their order.
    const auto layer = [&](double least, double most) {
      return meanDepth(levels[0], 0, [&](Flat p) {
        const FoldedPlace in = strip.made.folded(p);
        const double low = strip.made.folds[0].low * strip.made.across.u;
        const double from = std::fmin(low, low + 0.02 * strip.made.across.u);
        return p.v < 0.22 && p.v > 0.18 && in.lifted > least && in.lifted < most && in.place.u > from + 0.004 &&
               in.place.u < from + 0.016;
      });
    };
    const double over = layer(1.4, 2.1), middle = layer(0.4, 1.1), under = layer(-0.1, 0.1);
    EXPECT_GT(over, middle + 0.0006) << pressed;  // wool suiting is 0.57 mm thick
    EXPECT_GT(middle, under + 0.0006) << pressed;
    // Pressed, it stays shut down to the hem; the cloth takes there no more room than at the waist, to a centimetre.
    const ClothPiece& part = levels[0].cloth.pieces[0];
    double left = 1, right = -1;
    for (const std::uint32_t k : part.lattice->edges.at("bottom").nodes) {
      left = std::fmin(left, levels[0].state.position[k].x);
      right = std::fmax(right, levels[0].state.position[k].x);
    }
    if (pressed) {
      EXPECT_LT(right - left, 0.215);
    }
  }
}

// Sewn on with three sides: its edge stays on the line, and it lies over the cloth it is sewn to.
TEST(Patch, StaysOnItsLineAndOutside) {
  Workers workers;
  auto base = rectangle(1, 0.2, 0.25), pocket = rectangle(2, 0.08, 0.09);
  const auto at = [](Flat p) { return p + Flat{0.057, 0.083}; };
  Seam seam{{5}, "", {}, {}, false, Seam::Tie::OneToOne};
  for (const std::size_t k : {3u, 0u, 1u}) {
    const Edge& edge = pocket->outline.edges[k];
    base->lines.push_back({"line_" + edge.name, {Curve::line(at(edge.curve.start), at(edge.curve.end))}, {}});
    seam.a.push_back({{2}, edge.name, 0, 1});
    seam.b.push_back({{1}, base->lines.back().name, 0, 1});
  }
  Pattern pattern = patternOf({base, pocket});
  pattern.seams[seam.id] = seam;
  ClothChoice choice;
  for (double u = 0; u < 0.201; u += 0.005) choice.pins[{1}].push_back({u, 0.25});
  choice.pinRadius = 0.003;
  std::vector<ClothLevel> levels{levelOf(pattern, kSpacing, *preset("cotton"), choice)};
  levels[0].state = standingBy(levels[0].cloth, [&](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u, p.v, 0} : Vec3{at(p).u, at(p).v, kLift};
  });
  const NoBody body;
  const auto report = settle(levels, body, {}, {}, workers);
  ASSERT_TRUE(report) << text(report.error().what);
  EXPECT_TRUE(report->settled) << text(report->why);
  expectSewnAndApart(levels[0]);
  const double over =
      meanDepth(levels[0], 1, [](Flat p) { return p.u > 0.02 && p.u < 0.06 && p.v > 0.03 && p.v < 0.06; });
  const double under = meanDepth(levels[0], 0, [&](Flat p) {
    return p.u > at({0.02, 0}).u && p.u < at({0.06, 0}).u && p.v > at({0, 0.03}).v && p.v < at({0, 0.06}).v;
  });
  EXPECT_GT(over, under + 0.001);
}

// Three layers over each other, the outer one last; the inner one is `beneath` it and the lining 3 mm.
ClothLevel linedLayers(const std::function<double(Flat)>& beneath) {
  ClothLevel level;
  level.cloth.spacing = kSpacing;
  for (const int layer : {0, 1, 2}) {
    // Other nodes than the other layers'.
    addPiece(level.cloth, gridLattice(20, 20, kSpacing, {0.0031 * layer, 0.0017 * layer}), *preset("silk"));
    level.cloth.pieces.back().layer = layer;
  }
  level.state = standingBy(level.cloth, [&](std::size_t layer, Flat p) {
    const double outer = 0.1 * p.u * p.u + 0.01 * std::sin(40 * p.v);
    return Vec3{p.u, p.v, outer - (layer == 0 ? beneath(p) : layer == 1 ? 0.003 : 0)};
  });
  return level;
}

TEST(Lining, IsLaidBetweenLayersThatLieCloser) {
  ClothLevel level = linedLayers([](Flat p) { return 0.003 + 0.002 * std::sin(60 * p.u); });
  ASSERT_GT(check(level.cloth, level.state, nullptr).clothClothCrossings, 100u);
  const std::vector<Vec3> before = level.state.position;
  EXPECT_TRUE(layBetween(level.cloth, level.state.position));
  EXPECT_EQ(check(level.cloth, level.state, nullptr).clothClothCrossings, 0u);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const bool lining = k / level.cloth.pieces[1].lattice->nodes.size() == 1;
    if (!lining) {
      EXPECT_EQ(level.state.position[k], before[k]);
    }
  }
  const std::vector<Vec3> laid = level.state.position;
  EXPECT_FALSE(layBetween(level.cloth, level.state.position)) << "it goes through nothing any more";
  EXPECT_EQ(level.state.position, laid);
}

TEST(Lining, StaysWhereThereIsRoomForIt) {
  ClothLevel level = linedLayers([](Flat) { return 0.006; });
  const std::vector<Vec3> before = level.state.position;
  EXPECT_FALSE(layBetween(level.cloth, level.state.position));
  EXPECT_EQ(level.state.position, before);
}

}  // namespace
}  // namespace karinui::test
