// Elastics, hems and folds against their closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "cloth/bend_along.h"
#include "cloth/crease.h"
#include "cloth/edge_bending.h"
#include "cloth/elastic.h"
#include "cloth/helpers.h"
#include "karinui/base/number.h"
#include "karinui/cloth/pulls.h"
#include "karinui/pattern/elastic_lines.h"

namespace karinui::test {
namespace {

// A strip with something done to its lower edge.
ClothLevel strip(const Allowances& finish, double length, double height, double spacing, const Fabric& fabric) {
  ClothChoice choice;
  choice.finish = &finish;
  return levelOf(patternOf({rectangle(1, length, height)}), spacing, fabric, choice);
}

// Drawn out to a length, an elastic pulls with 2 S (length/cut - 1): S at one and a half times its cut length.
TEST(Elastic, PullsAsItIsDrawnOut) {
  Workers workers(1);
  Allowances finish;
  finish.elastics[{{1}, "bottom"}] = {0.6, 9};
  for (const double spacing : {0.04, 0.02, 0.01, 0.005}) {
    const ClothLevel level = strip(finish, 0.4, 0.08, spacing, *preset("cotton"));
    for (const double share : {0.9, 0.75, 0.61, 0.55}) {
      ClothState state = level.state;
      for (Vec3& p : state.position) p.x *= share;
      const double pull = std::fmax(0, 18 * (share / 0.6 - 1));
      const std::vector<ElasticPull> told = elasticPulls(level.cloth, state);
      ASSERT_EQ(told.size(), 1u);
      EXPECT_NEAR(told[0].pull, pull, 1e-9);
      EXPECT_NEAR(told[0].cut, 0.24, 1e-12);
      EXPECT_NEAR(told[0].now, std::fmax(0.24, 0.4 * share), 1e-9);
      // Whatever is cut through, it is pulled together with this force; so are the ends.
      std::vector<Vec3> gradient(state.position.size());
      Springs(elasticSprings(level.cloth), level.cloth.nodeCount).addGradient(state.position, gradient, workers);
      for (const double cut : {0.001, 0.13, 0.2, 0.399}) {
        double force = 0;
        for (std::size_t k = 0; k < gradient.size(); ++k)
          if (level.state.position[k].x < cut) force -= gradient[k].x;
        EXPECT_NEAR(force, pull, 1e-9);
      }
    }
  }
}

// Along a line inside the piece it pulls with the same force, and nothing is tied there.
TEST(Elastic, PullsAlongAnInnerLine) {
  Workers workers(1);
  Allowances finish;
  finish.elastics[{{1}, "shirring"}] = {0.6, 9};
  auto piece = rectangle(1, 0.4, 0.08);
  piece->lines.push_back({"shirring", {Curve::line({0, 0.05}, {0.4, 0.05})}, {}});
  ClothChoice choice;
  choice.finish = &finish;
  for (const double spacing : {0.02, 0.01, 0.005}) {
    const ClothLevel level = levelOf(withElasticLines(patternOf({piece}), finish), spacing, *preset("cotton"), choice);
    EXPECT_TRUE(level.cloth.ties.empty());
    ASSERT_EQ(level.cloth.elastics.size(), 1u);
    for (const std::uint32_t node : level.cloth.elastics[0].edge.nodes)
      EXPECT_NEAR(level.state.position[node].y, 0.05, 1e-9);
    ClothState state = level.state;
    for (Vec3& p : state.position) p.x *= 0.75;
    const std::vector<ElasticPull> told = elasticPulls(level.cloth, state);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NEAR(told[0].pull, 18 * (0.75 / 0.6 - 1), 1e-9);
    EXPECT_NEAR(told[0].cut, 0.24, 1e-12);
    std::vector<Vec3> gradient(state.position.size());
    Springs(elasticSprings(level.cloth), level.cloth.nodeCount).addGradient(state.position, gradient, workers);
    double force = 0;
    for (std::size_t k = 0; k < gradient.size(); ++k)
      if (level.state.position[k].x < 0.13) force -= gradient[k].x;
    EXPECT_NEAR(force, told[0].pull, 1e-9);
  }
}

// Half a ring on paper, its waist in the middle.
std::shared_ptr<Piece> halfRing(std::uint64_t id, double inner, double outer) {
  auto piece = rectangle(id, 1, 1);
  const auto line = [](double from, double to) { return Curve::line({from, 0}, {to, 0}); };
  piece->outline.edges = {{"hem", Curve::arc({outer, 0}, {-outer, 0}, 1)},
                          {"right", line(-outer, -inner)},
                          {"waist", Curve::arc({-inner, 0}, {inner, 0}, -1)},
                          {"left", line(inner, outer)}};
  return piece;
}

// A circle skirt on a round waist of radius R, hung there by its elastic alone: the elastic is drawn out to the girth,
// so that T = 2 S (2 pi R/cut - 1), and what is longer lies in even folds.
TEST(Elastic, HoldsACircleSkirtOnTheWaist) {
  Workers workers;
  const double waist = 0.115, inner = 0.165, cut = 0.62, strength = 12;
  Pattern pattern = patternOf({halfRing(1, inner, 0.45), halfRing(2, inner, 0.45)});
  pattern.seams[{3}] = {{3}, "", {{{1}, "left", 0, 1}}, {{{2}, "right", 0, 1}}};
  pattern.seams[{4}] = {{4}, "", {{{1}, "right", 0, 1}}, {{{2}, "left", 0, 1}}};
  Allowances finish;
  for (const std::uint64_t id : {1, 2})
    finish.elastics[{{id}, "waist"}] = {cut / (2 * std::numbers::pi * inner), strength};
  ClothChoice choice;
  choice.finish = &finish;
  std::vector<ClothLevel> levels;
  for (const double spacing : {0.06, 0.03, 0.015}) {
    levels.push_back(levelOf(pattern, spacing, *preset("cotton"), choice));
    levels.back().state = standingBy(levels.back().cloth, [](std::size_t piece, Flat p) {
      return piece == 0 ? Vec3{p.u, 1, -p.v} : Vec3{-p.u, 1, p.v};
    });
  }
  const CapsuleBody body({{{0, 0, 0}, {0, 2, 0}, waist}});
  const auto report = settle(levels, body, {}, {}, workers);
  ASSERT_TRUE(report) << text(report.error().what);
  EXPECT_TRUE(report->settled) << text(report->why);
  const double pull = 2 * strength * (2 * std::numbers::pi * waist / cut - 1);
  const ClothLevel& level = levels.back();
  for (const ElasticPull& told : elasticPulls(level.cloth, level.state)) {
    EXPECT_NEAR(told.pull, pull, 0.12 * pull);
    EXPECT_NEAR(told.now, std::numbers::pi * waist, 0.01);
  }
  double low = 2, high = 0;
  for (const ElasticEdge& own : level.cloth.elastics)
    for (const std::uint32_t k : own.edge.nodes) {
      const Vec3 p = level.state.position[k];
      EXPECT_LT(std::hypot(p.x, p.z) - waist, 0.005);  // close to the waist all round
      low = std::fmin(low, p.y), high = std::fmax(high, p.y);
    }
  EXPECT_LT(high - low, 0.04);
}

// Rolled up with radius R, a hem stores B (width + under)/(2 R^2) for each metre, whatever the lattice, and lies flat
// for nothing; it weighs what it adds.
TEST(Hem, BendsAndWeighsAsItsLayers) {
  Workers workers(1);
  Allowances finish;
  finish.hems[{{1}, "bottom"}] = {0.04, 0.01};
  Fabric fabric = textbook(1000, 3e-5, 0.2);
  fabric.bendWarp = 1e-5;
  for (const double spacing : {0.02, 0.01}) {
    const ClothLevel level = strip(finish, 0.6, 0.2, spacing, fabric);
    const EdgeBending hem(level.cloth);
    EXPECT_NEAR(hem.value(level.state.position, workers), 0, 1e-18);
    const double radius = 0.1;
    std::vector<Vec3> rolled = level.state.position;
    for (Vec3& p : rolled) p = {radius * std::sin(p.x / radius), p.y, radius * std::cos(p.x / radius)};
    const double joules = 3e-5 * 0.05 / (2 * radius * radius) * 0.6;
    EXPECT_NEAR(hem.value(rolled, workers), joules, 0.06 * joules);  // its two ends have no neighbour
    double mass = 0;
    for (const auto& [node, more] : edgeMasses(level.cloth)) mass += more;
    EXPECT_NEAR(mass, 0.2 * 0.05 * 0.6, 1e-9);
  }
}

// Two cloths sewn along their whole bottoms: the allowance of each, pressed open, bends along the seam with B w and
// weighs what it adds. Where one is gathered into the other, or folded into a pleat, it stiffens nothing.
TEST(SeamAllowance, BendsAndWeighsOnBothSides) {
  Workers workers(1);
  Allowances finish;
  finish.kinds[EdgeKind::Seam] = 0.015;
  finish.edges[{{2}, "bottom"}] = 0.02;
  ClothChoice choice;
  choice.finish = &finish;
  const auto sewn = [&](Seam::Tie tie, double length) {
    Pattern pattern = patternOf({rectangle(1, 0.6, 0.2), rectangle(2, length, 0.2)});
    pattern.seams[{3}] = {{3}, "", {{{1}, "bottom", 0, 1}}, {{{2}, "bottom", 0, 1}}, true, tie};
    return levelOf(pattern, 0.01, textbook(1000, 3e-5, 0.2), choice);
  };
  const auto mass = [](const ClothLevel& level) {
    double sum = 0;
    for (const auto& [node, more] : edgeMasses(level.cloth)) sum += more;
    return sum;
  };
  const ClothLevel level = sewn(Seam::Tie::OneToOne, 0.6);
  const EdgeBending allowance(level.cloth);
  EXPECT_NEAR(allowance.value(level.state.position, workers), 0, 1e-18);
  const double radius = 0.1;
  std::vector<Vec3> rolled = level.state.position;
  for (Vec3& p : rolled) p = {radius * std::sin(p.x / radius), p.y, radius * std::cos(p.x / radius)};
  const double joules = 3e-5 * (0.015 + 0.02) / (2 * radius * radius) * 0.6;
  EXPECT_NEAR(allowance.value(rolled, workers), joules, 0.06 * joules);  // their ends have no neighbour
  EXPECT_NEAR(mass(level), 0.2 * (0.015 + 0.02) * 0.6, 1e-9);

  const ClothLevel gathered = sewn(Seam::Tie::TwoToOne, 1.2);
  ASSERT_EQ(gathered.cloth.foldedBack.size(), 1u);
  EXPECT_EQ(gathered.cloth.foldedBack[0].edge.piece, 0u);
  EXPECT_TRUE(sewn(Seam::Tie::Pleat, 0.6).cloth.foldedBack.empty());
}

// Rolled up with radius R, an edge with a cord of thickness d in a strip of width w stores (0.4 N pi d2/4 + B45 w)/(2
// R2) for each metre, B45 the strip's bending on the bias; one that is bound B45 4 w/(2 R2). They weigh what they add.
TEST(Trims, BendAndWeighAsCordAndStrip) {
  Workers workers(1);
  const Fabric fabric = textbook(1000, 2e-5, 0.2), silk = *preset("silk");
  const auto onBias = [](const Fabric& f) {
    const double root = 0.5 * (std::sqrt(f.bendWarp) + std::sqrt(f.bendWeft));
    return root * root;
  };
  const double section = std::numbers::pi * 0.004 * 0.004 / 4, cover = std::numbers::pi * 0.004 + 0.02;
  struct Case {
    Allowances finish;
    double bending, weight;
  };
  Case cord{{}, 0.4 * section + onBias(fabric) * cover, 600 * section + fabric.weight * cover};
  cord.finish.pipings[{{1}, "bottom"}] = {0.004, ""};
  Case strips{{}, onBias(silk) * 0.04, silk.weight * 0.04};
  strips.finish.bindings[{{1}, "bottom"}] = {0.01, "silk"};
  for (const Case& one : {cord, strips})
    for (const double spacing : {0.02, 0.01}) {
      const ClothLevel level = strip(one.finish, 0.6, 0.2, spacing, fabric);
      const EdgeBending bending(level.cloth);
      EXPECT_NEAR(bending.value(level.state.position, workers), 0, 1e-16);
      const double radius = 0.1;
      std::vector<Vec3> rolled = level.state.position;
      for (Vec3& p : rolled) p = {radius * std::sin(p.x / radius), p.y, radius * std::cos(p.x / radius)};
      const double joules = one.bending / (2 * radius * radius) * 0.6;
      EXPECT_NEAR(bending.value(rolled, workers), joules, 0.06 * joules);  // its two ends have no neighbour
      double mass = 0;
      for (const auto& [node, more] : edgeMasses(level.cloth)) mass += more;
      EXPECT_NEAR(mass, one.weight * 0.6, 1e-9);
    }
}

// A free strip, folded along a thread, rests where the fold's torque c (t0 - t) and the cloth's B/h sin t are in
// balance, c = B/h p/(1 - p); at every spacing, to either side.
TEST(Fold, AFreeStripRestsAtItsShareOfTheAngle) {
  Workers workers;
  for (const auto& [degrees, hold, spacing] :
       {std::tuple{90.0, 0.9, 0.01}, {90.0, 0.5, 0.005}, {-60.0, 0.5, 0.01}, {150.0, 0.9, 0.01}, {150.0, 0.5, 0.01}}) {
    auto paper = rectangle(1, 0.2, 0.2);
    paper->lines.push_back({"turn", {Curve::line({0, 0.1}, {0.2, 0.1})}, Crease{degrees * kDegree, hold}});
    std::vector<ClothLevel> levels{levelOf(patternOf({paper}), spacing, textbook(1000, 2e-5, 0.15))};
    SettleSettings settings;
    settings.gravity = {};
    const NoBody body;
    const auto report = settle(levels, body, settings, {}, workers);
    ASSERT_TRUE(report) << text(report.error().what);
    EXPECT_TRUE(report->settled);
    double rest = hold * degrees * kDegree;
    for (int k = 0; k < 200; ++k) rest = 0.5 * (rest + degrees * kDegree - (1 - hold) / hold * std::sin(rest));
    const auto& nodes = levels[0].cloth.pieces[0].lattice->nodes;
    const auto at = [&](double v) {
      std::size_t best = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (distance(nodes[k], {0.1, v}) < distance(nodes[best], {0.1, v})) best = k;
      return levels[0].state.position[best];
    };
    const Vec3 low = at(0.07) - at(0.03), high = at(0.17) - at(0.13);
    const double turned = std::atan2(cross(low, high).x, dot(low, high));
    EXPECT_NEAR(turned / kDegree, rest / kDegree, 0.6) << degrees << " " << hold;
    EXPECT_GT(std::fabs(turned), hold * std::fabs(degrees) * kDegree * 0.99);
  }
}

// A fold pressed to 170 degrees whose sides cross, at 190, is drawn open by as much as one of 150 is drawn shut: its
// torque does not turn round where the angle's range ends.
TEST(Fold, IsDrawnBackFromBeyondFlatAgainstItself) {
  Workers workers(1);
  for (const double sign : {1.0, -1.0}) {
    auto paper = rectangle(1, 0.1, 0.1);
    paper->lines.push_back({"turn", {Curve::line({0, 0.05}, {0.1, 0.05})}, Crease{sign * 170 * kDegree, 0.9}});
    const ClothLevel level = levelOf(patternOf({paper}), 0.01, *preset("cotton"));
    const CreaseHinges fold(level.cloth);
    const auto folded = [&](double degrees) {
      std::vector<Vec3> x = level.state.position;
      const double t = sign * degrees * kDegree;
      for (Vec3& p : x)
        if (p.y > 0.05) p = {p.x, 0.05 + (p.y - 0.05) * std::cos(t), (p.y - 0.05) * std::sin(t)};
      return x;
    };
    const auto torque = [&](double degrees) {  // by which the energy grows with the angle
      return (fold.value(folded(degrees + 0.01), workers) - fold.value(folded(degrees - 0.01), workers)) /
             (0.02 * kDegree);
    };
    EXPECT_NEAR(torque(170), 0, 1e-9);
    EXPECT_LT(torque(150), -1e-6);
    EXPECT_NEAR(torque(190), -torque(150), 1e-3 * std::fabs(torque(150)));
    EXPECT_NEAR(torque(179.5), -torque(160.5), 1e-3 * std::fabs(torque(150)));
    EXPECT_LT(torque(-90), torque(0)) << "bent back, it is drawn round to its own side";
  }
}

// Where it rests, a fold's stand-in for the second derivative is exact.
TEST(Fold, BlocksPredictItsTorque) {
  Workers workers(1);
  auto paper = rectangle(1, 0.1, 0.1);
  paper->lines.push_back({"turn", {Curve::line({0.01, 0.05}, {0.09, 0.05})}, Crease{0.8, 0.9}});
  const ClothLevel level = levelOf(patternOf({paper}), 0.01, *preset("cotton"));
  const CreaseHinges fold(level.cloth);
  ASSERT_GT(fold.count(), 4u);
  std::vector<Vec3> x = level.state.position, shift(x.size());
  for (Vec3& p : x)
    if (p.y > 0.05) p = {p.x, 0.05 + (p.y - 0.05) * std::cos(0.8), (p.y - 0.05) * std::sin(0.8)};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-1, 1);
  for (Vec3& s : shift) s = {by(random), by(random), by(random)};
  std::vector<NodePair> pairs;
  fold.appendPairs(pairs);
  std::vector<Block3> blocks(fold.pairCount());
  fold.blocks(x, blocks, workers);
  std::vector<Vec3> predicted(x.size()), before(x.size()), later(x.size()), further = x;
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    const Block3& b = blocks[s];
    const Vec3 m = shift[pairs[s].column];
    predicted[pairs[s].row] += Vec3{b[0] * m.x + b[1] * m.y + b[2] * m.z, b[3] * m.x + b[4] * m.y + b[5] * m.z,
                                    b[6] * m.x + b[7] * m.y + b[8] * m.z};
  }
  for (std::size_t k = 0; k < x.size(); ++k) further[k] += shift[k] * 1e-7;
  fold.addGradient(x, before, workers), fold.addGradient(further, later, workers);
  double scale = 0, off = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    scale = std::fmax(scale, length(predicted[k]));
    off = std::fmax(off, length((later[k] - before[k]) * 1e7 - predicted[k]));
  }
  EXPECT_LT(off, 1e-4 * scale);
}

}  // namespace
}  // namespace karinui::test
