// Friction that holds: cloth stays where the closed forms say that it stays, and slides where they say that it slides.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/body/sizes.h"
#include "karinui/cloth/dynamics.h"

namespace karinui::test {
namespace {

struct Fate {
  bool settled = false;
  double moved = 0;  // metres the fastest node went from where it stood at first,
  double drift = 0;  // and the middle, in `frames` of dynamics afterwards
};

Fate fateOf(const ClothLevel& level, const Collider& body, int maxSteps, int frames) {
  Workers workers(1);
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.maxSteps = maxSteps;
  const auto report = settle(levels, body, settings, Token(), workers);
  KARINUI_ASSERT(report);
  Fate fate;
  fate.settled = report->settled;
  for (std::size_t k = 0; k < level.state.position.size(); ++k)
    fate.moved = std::fmax(fate.moved, distance(level.state.position[k], levels[0].state.position[k]));
  if (frames > 0) {
    const auto after = runDynamics(levels[0], body, settings, frames, Token(), workers);
    KARINUI_ASSERT(after);
    fate.drift = after->drift;
  }
  return fate;
}

// A piece on a slope, about as deep in contact as its weight presses it; `cloth`: the slope is cloth that does not
// move, otherwise body.
Fate onSlope(double slope, double friction, bool cloth) {
  Fabric f = *preset("denim");
  f.frictionBody = f.frictionCloth = friction;
  ClothLevel level;
  const Vec3 down{std::cos(slope), -std::sin(slope), 0}, out{std::sin(slope), std::cos(slope), 0};
  addPiece(level.cloth, gridLattice(8, 8, 0.02), f);
  if (cloth) addPiece(level.cloth, gridLattice(16, 16, 0.02, {-0.081, -0.083}), f, false);
  level.state = standingBy(level.cloth, [&](std::size_t piece, Flat p) {
    return down * p.u + Vec3{0, 0, p.v} + out * (piece == 0 ? (cloth ? 0.0015 : 0.0014) : 0.0);
  });
  if (cloth) return fateOf(level, NoBody(), 250, 300);
  return fateOf(level, PlaneBody(out, 0), 250, 300);
}

TEST(Friction, SlopeHoldsUpToItsAngleOnBodyAndOnCloth) {
  for (const bool cloth : {false, true})
    for (const double friction : {0.2, 0.6}) {
      SCOPED_TRACE((cloth ? "on cloth, " : "on body, ") + std::to_string(friction));
      const Fate below = onSlope(std::atan(0.95 * friction), friction, cloth);
      EXPECT_TRUE(below.settled);
      EXPECT_LT(below.moved, 0.0005);
      EXPECT_LT(below.drift, 0.00005);  // in 300 frames: no creep
      const Fate above = onSlope(std::atan(1.05 * friction), friction, cloth);
      EXPECT_GT(above.drift, 0.004);
      if (!cloth) {
        EXPECT_FALSE(above.settled);
      }
    }
}

// A light strip over a round bar, a weight on each end, one `ratio` times the other.
Fate capstan(double ratio, double friction) {
  const double radius = 0.05, h = 0.01, bow = M_PI * radius;
  const std::uint32_t legs = 6, round = 16, wide = 2;
  Fabric light = *preset("chiffon"), heavy = *preset("denim");
  light.weight = 0.005, light.frictionBody = friction, light.bendWarp = light.bendWeft = 1e-7;
  ClothLevel level;
  const auto strip = gridLattice(wide, round + 2 * legs, h);
  const auto weight = gridLattice(wide, 4, h);
  const std::uint32_t rope = addPiece(level.cloth, strip, light);
  std::uint32_t end[2];
  for (int side = 0; side < 2; ++side) {
    heavy.weight = side == 0 ? 4.5 / ratio : 4.5;
    heavy.frictionBody = 0;
    end[side] = addPiece(level.cloth, weight, heavy);
  }
  level.cloth.seams = {SeamId{1}, SeamId{2}};
  for (std::uint32_t i = 0; i <= wide; ++i) {
    level.cloth.ties.push_back({rope + i, end[0] + i, kNoNode, 0});
    level.cloth.ties.push_back({rope + (round + 2 * legs) * (wide + 1) + i, end[1] + i, kNoNode, 1});
  }
  const double away = radius + 0.0013, half = 0.5 * (round + 2 * legs) * h;
  const auto place = [&](double s, double z) {  // s: along the strip from its middle
    const double turn = std::clamp(s / radius, -M_PI / 2, M_PI / 2), down = std::fmax(0.0, std::fabs(s) - bow / 2);
    return Vec3{away * std::sin(turn), away * std::cos(turn) - down, z};
  };
  level.state = standingBy(level.cloth, [&](std::size_t piece, Flat p) {
    if (piece == 0) return place(p.v - half, p.u);
    return place((piece == 1 ? -1 : 1) * (half + p.v), p.u);
  });
  return fateOf(level, CapsuleBody({{{0, 0, -1}, {0, 0, 1}, radius}}), 300, 600);
}

TEST(Friction, RopeOverABarHoldsAsEulerSays) {
  for (const double friction : {0.3, 0.5}) {
    SCOPED_TRACE(friction);
    const double euler = std::exp(friction * M_PI);
    const Fate held = capstan(0.93 * euler, friction);
    EXPECT_TRUE(held.settled);
    EXPECT_LT(held.moved, 0.005);  // what the strip gives
    EXPECT_LT(held.drift, 0.0002);
    const Fate slid = capstan(1.07 * euler, friction);
    EXPECT_FALSE(slid.settled);
    EXPECT_GT(slid.moved, 0.03);
  }
}

// W2, small: a square metre laid on a ball of 0.3 m, nothing but friction 0.3 holds it; ten more seconds.
TEST(Friction, ClothLaidOnABallStaysThere) {
  Fabric f = textbook(1000, 1e-5, 0.15);
  f.shear = 40, f.compression = 0.05, f.toeWarp = f.toeWeft = 0.002;
  f.frictionBody = f.frictionCloth = 0.3;
  std::vector<ClothLevel> levels;
  for (const std::uint32_t cells : {10u, 20u}) {
    ClothLevel level;
    addPiece(level.cloth, gridLattice(cells, cells, 1.0 / cells), f);
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u - 0.5, 0.35, p.v - 0.47}; });
    levels.push_back(std::move(level));
  }
  const CapsuleBody ball({{{}, {}, 0.3}});
  Workers workers(1);
  const auto report = settle(levels, ball, {}, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << text(report->why);
  const auto after = runDynamics(levels.back(), ball, {}, 600, Token(), workers);
  ASSERT_TRUE(after);
  EXPECT_LT(after->drift, 0.003);  // a fold may still snap
  // It lies where it was put: askew by 3 cm, not slid back to the middle, nor off.
  Vec3 middle;
  for (const Vec3 p : levels.back().state.position) middle += p * (1.0 / 441);
  EXPECT_NEAR(middle.z, 0.03, 0.02);
}

// A flared tube whose waist is smaller than the hip: it comes to sit on the figure's waist and stays.
TEST(Friction, SkirtStaysOnTheWaist) {
  Workers workers(1);
  const Token token;
  const auto body = makeMannequin(*builtInSize("eu38"), workers, token);
  ASSERT_TRUE(body);
  ASSERT_TRUE((*body)->prepareField(workers, token));
  const auto& girth = (*body)->measured().value;
  const double waist = girth.at("waist_girth") + 0.01, hip = girth.at("hip_girth"), top = girth.at("waist_height");
  const auto half = [&](std::uint64_t id) {
    auto piece = std::make_shared<Piece>();
    piece->id = PieceId{id};
    piece->name = id == 1 ? "front" : "back";
    const double w = waist / 4, h = 0.16 * 2 * hip;
    piece->outline.edges = {{"hem", Curve::line({-h, -0.5}, {h, -0.5})},
                            {"side_left", Curve::line({h, -0.5}, {w, 0})},
                            {"waist", Curve::line({w, 0}, {-w, 0})},
                            {"side_right", Curve::line({-w, 0}, {-h, -0.5})}};
    return piece;
  };
  Pattern pattern = patternOf({half(1), half(2)});
  for (std::uint64_t s : {1, 2}) {
    Seam seam;
    seam.id = SeamId{s};
    seam.name = s == 1 ? "left" : "right";
    seam.a = {{PieceId{1}, s == 1 ? "side_left" : "side_right"}};
    seam.b = {{PieceId{2}, s == 1 ? "side_left" : "side_right"}};
    seam.reversed = false;
    pattern.seams[seam.id] = seam;
  }
  std::vector<ClothLevel> levels;
  for (const double spacing : {0.04, 0.02}) {
    levels.push_back(levelOf(pattern, spacing, *preset("wool suiting")));
    levels.back().state = standingBy(levels.back().cloth, [&](std::size_t piece, Flat p) {
      return Vec3{p.u, top + 0.01 + p.v, piece == 0 ? 0.22 : -0.2};
    });
  }
  const auto collider = fieldCollider(*body);
  const auto report = settle(levels, *collider, {}, token, workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << text(report->why);
  EXPECT_LE(report->seamGap, 0.0005);
  const auto after = runDynamics(levels.back(), *collider, {}, 150, token, workers);
  ASSERT_TRUE(after);
  EXPECT_LT(after->drift, 0.001);
  const ClothLevel& finest = levels.back();
  double low = 1e9, high = -1e9;
  for (std::size_t p = 0; p < 2; ++p)
    for (const std::uint32_t k : finest.cloth.pieces[p].lattice->edges.at("waist").nodes) {
      const double y = finest.state.position[finest.cloth.pieces[p].firstNode + k].y;
      low = std::fmin(low, y), high = std::fmax(high, y);
    }
  // Where it was put, a centimetre above the waist; without friction it slides 17 mm down, as far as the hip lets it.
  EXPECT_NEAR(low, top + 0.01, 0.008);
  EXPECT_LT(high, top + 0.06);
}

}  // namespace
}  // namespace karinui::test
