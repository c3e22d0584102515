// Strips that bend under their own weight, as lay() makes them, border ring and all, at any angle to the grain.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/cloth/measured_fabric.h"

namespace karinui::test {
namespace {

constexpr double kWeight = 0.2, kBend = 5e-5, kBare = -1;

// The heavy elastica, from its free tip (t = 0) to where it is held at `angle` below the level (t = 1), lengths in its
// own: theta'' = -gamma t cos theta, theta'(0) = 0. Counted from upright, which long strips come very near to.
struct Hang {
  double fall = 0, reach = 0, turn = 0;
};
Hang elastica(double gamma, double angle) {
  const int steps = 4000;
  const auto from = [&](double tip, Hang* hang) {
    double a = tip, da = 0, x = 0, y = 0;
    const double dt = 1.0 / steps;
    for (int k = 0; k < steps && a < 2; ++k) {
      const double t = k * dt;
      const auto slope = [&](double at, double value) { return gamma * at * std::sin(value); };
      const double a1 = da, b1 = slope(t, a), a2 = da + dt / 2 * b1, b2 = slope(t + dt / 2, a + dt / 2 * a1);
      const double a3 = da + dt / 2 * b2, b3 = slope(t + dt / 2, a + dt / 2 * a2), a4 = da + dt * b3;
      const double b4 = slope(t + dt, a + dt * a3), middle = a + dt / 2 * da + dt * dt / 8 * b1;
      const double next = a + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      x += dt / 6 * (std::sin(a) + 4 * std::sin(middle) + std::sin(next));
      y += dt / 6 * (std::cos(a) + 4 * std::cos(middle) + std::cos(next));
      a = next;
      da += dt / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
    if (hang) *hang = {y, x, a - tip};
    return a;
  };
  double low = std::log(1e-30), high = std::log(M_PI / 2);  // of the tip's angle from upright
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (from(std::exp(middle), nullptr) < M_PI / 2 - angle ? low : high) = middle;
  }
  Hang hang;
  from(std::exp(low), &hang);
  return hang;
}

struct Row {
  double gamma, fall, reach;  // w L^3/B, H/L, W/L
};
const Row kTable[] = {{0.1, .01250, .99991}, {1, .12347, .99125},   {2, .23851, .96689},  {5, .49591, .84666},
                      {10, .70020, .65635},  {20, .82988, .44523},  {50, .90792, .24502}, {100, .93752, .15922},
                      {300, .96501, .08629}, {1000, .98114, .04599}};

TEST(Elastica, IsTheTablesAndPeirces) {
  for (const Row& row : kTable) {
    EXPECT_NEAR(elastica(row.gamma, 0).fall, row.fall, 1.5e-5) << row.gamma;
    EXPECT_NEAR(elastica(row.gamma, 0).reach, row.reach, 1.5e-5) << row.gamma;
  }
  // ASTM D1388: at 41.5 degrees the overhang is twice the bending length.
  const Hang peirce = elastica(8.004, 0);
  EXPECT_NEAR(std::atan2(peirce.fall, peirce.reach) * 180 / M_PI, 41.5, 0.005);
  EXPECT_NEAR(std::cbrt(8.004), 2, 0.001);
}

// A strip of four cells, held from one end to a clamp's line some three cells in.
struct Strip {
  ClothLevel level;
  std::vector<Vec3> rest;
  double line = 0, height = 0, width = 0, bend = 0;  // of the warp and weft alike, for the length that is free
  double free() const { return height - line; }
};

// So that the border has nodes on the clamp's line.
void addCorners(Piece& piece, double line) {
  const double width = piece.outline.edges[0].curve.end.u, height = piece.outline.edges[1].curve.end.v;
  const Flat a{0, 0}, b{width, 0}, c{width, line}, d{width, height}, e{0, height}, f{0, line};
  piece.outline.edges = {{"bottom", Curve::line(a, b)}, {"right", Curve::line(b, c)}, {"right2", Curve::line(c, d)},
                         {"top", Curve::line(d, e)},    {"left2", Curve::line(e, f)}, {"left", Curve::line(f, a)}};
}

// A row of the grid about three cells in that no face lies across, if there is one.
double clampLine(const Piece& piece, double h) {
  double best = 0;
  const auto plain = lay(patternOf({std::make_shared<Piece>(piece)}), h);
  KARINUI_ASSERT(plain);
  const Lattice& grid = *plain->lattices.begin()->second;
  std::size_t least = grid.faces.size();
  for (std::uint32_t k : grid.grid) {
    if (k == kNoNode || std::fabs(grid.nodes[k].v - 3 * h) > h) continue;
    const double line = grid.nodes[k].v;
    auto cornered = std::make_shared<Piece>(piece);
    addCorners(*cornered, line);
    const auto laid = lay(patternOf({cornered}), h);
    KARINUI_ASSERT(laid);
    const Lattice& lattice = *laid->lattices.begin()->second;
    std::size_t across = 0;
    for (const Triangle& f : lattice.faces) {
      const auto [low, high] = std::minmax({lattice.nodes[f[0]].v, lattice.nodes[f[1]].v, lattice.nodes[f[2]].v});
      across += low < line - 1e-9 && high > line + 1e-9;
    }
    if (across < least) least = across, best = line;
  }
  return best;
}

Strip hung(double gamma, double degrees) {
  Strip strip;
  // A strip that hangs almost straight bends within a small part of its length, and that has to be some cells long.
  const int rows = static_cast<int>(std::fmax(26, 12 * std::cbrt(gamma)));
  const double around = std::cbrt(gamma * kBend / (kWeight * kGravity)), h = around / rows;
  strip.width = 4 * h;
  strip.height = around + 3 * h;
  strip.line = 3 * h;
  strip.bend = kBend;
  if (degrees == kBare) {
    addPiece(strip.level.cloth, gridLattice(4, static_cast<std::uint32_t>(rows + 3), h),
             textbook(3000, kBend, kWeight));
  } else {
    const double turn = degrees * M_PI / 180;
    auto piece = rectangle(1, strip.width, strip.height, {std::sin(turn), std::cos(turn)});
    strip.line = clampLine(*piece, h);
    addCorners(*piece, strip.line);
    strip.bend = kWeight * kGravity * std::pow(strip.free(), 3) / gamma;  // the clamp takes what the grid offers
    strip.level = levelOf(patternOf({piece}), h, textbook(3000, strip.bend, kWeight));
  }
  strip.level.state = standingBy(strip.level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0, p.v}; });
  const auto& nodes = strip.level.cloth.pieces[0].lattice->nodes;
  for (std::uint32_t n = 0; n < nodes.size(); ++n)
    if (nodes[n].v < strip.line + 1e-6) strip.level.cloth.pinned.push_back(n);
  std::vector<ClothLevel> levels{strip.level};
  SettleSettings settings;
  settings.stopMove = 1e-5 * strip.free();
  settings.stopResidual = 0.1;
  settings.maxSteps = 3000;
  settings.clothOnCloth = false;  // the stiffest are so small that the cloth's own thickness would stretch them
  Workers workers(1);
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  KARINUI_ASSERT(report);
  EXPECT_TRUE(report->settled) << text(report->why);
  strip.rest = levels[0].state.position;
  return strip;
}
Vec3 tipOf(const Strip& strip) {
  const auto& nodes = strip.level.cloth.pieces[0].lattice->nodes;
  const Flat middle{strip.width / 2, strip.height};
  const auto tip = std::min_element(nodes.begin(), nodes.end(),
                                    [&](Flat a, Flat b) { return distance(a, middle) < distance(b, middle); });
  return strip.rest[static_cast<std::size_t>(tip - nodes.begin())];
}

class Cantilever : public testing::TestWithParam<std::tuple<double, double>> {};

// Where a row of nodes can be the clamp: along the threads, on the bias, and on a bare lattice.
TEST_P(Cantilever, HangsAsTheElasticaSays) {
  const auto [gamma, degrees] = GetParam();
  const Strip strip = hung(gamma, degrees);
  const Hang truth = elastica(gamma, 0);
  const Vec3 tip = tipOf(strip);
  EXPECT_NEAR(-tip.y / strip.free(), truth.fall, 0.01 * truth.fall);
  EXPECT_NEAR((tip.z - strip.line) / strip.free(), truth.reach, 0.01 * truth.reach);
}
INSTANTIATE_TEST_SUITE_P(Rows, Cantilever,
                         testing::Combine(testing::Values(0.1, 1, 2, 5, 8.004, 9.254, 10, 20, 50, 100, 300, 1000),
                                          testing::Values(0, 45, 90, kBare)));

// A strip that is hung over a table's edge, its overhang and angle read off: what was put in comes back.
TEST(MeasuredFabric, AHungStripGivesItsBendingBack) {
  for (const double gamma : {2.0, 8.004, 20.0})
    for (const double degrees : {0.0, 90.0, kBare}) {
      const Strip strip = hung(gamma, degrees);
      const Vec3 tip = tipOf(strip);
      TableReadings table;
      table.ruler = table.scales = table.angle = 0;
      table.swatchLength = table.swatchWidth = 0.1;
      table.swatchMasses = {kWeight * 0.01};
      table.overhang[0] = {{strip.free()}, {std::atan2(-tip.y, tip.z - strip.line)}};
      const auto measured = measuredFabric(table);
      ASSERT_TRUE(measured) << text(measured.error().what);
      EXPECT_NEAR(measured->fabric.bendWarp, strip.bend, 0.03 * strip.bend) << gamma << " at " << degrees;
    }
}

// The parabola that fits best what the nodes around a place on the strip say: value, slope, bend there.
using Parabola = std::array<double, 3>;
template <class Of>
Parabola parabolaBy(const Strip& strip, double place, const Of& of) {
  const auto& nodes = strip.level.cloth.pieces[0].lattice->nodes;
  double m[3][4] = {};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double s = nodes[k].v - place, power[3] = {1, s, s * s};
    if (std::fabs(s) > 2.5 * strip.level.cloth.spacing) continue;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += power[i] * power[j];
      m[i][3] += power[i] * of(strip.rest[k]);
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < 3; ++r)
      if (r != i)
        for (int j = 3; j >= i; --j) m[r][j] -= m[i][j] * m[r][i] / m[i][i];
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

class AcrossTheGrain : public testing::TestWithParam<std::tuple<double, double>> {};

// At other angles held nodes make a jagged clamp; but past it the strip is the elastica that starts at that slope.
TEST_P(AcrossTheGrain, HangsAsTheElasticaSaysPastItsClamp) {
  const auto [gamma, degrees] = GetParam();
  const Strip strip = hung(gamma, degrees);
  const double start = strip.line + 4 * strip.level.cloth.spacing, length = strip.height - start;
  const Parabola along = parabolaBy(strip, start, [](Vec3 p) { return p.z; });
  const Parabola down = parabolaBy(strip, start, [](Vec3 p) { return -p.y; });
  const double angle = std::atan2(down[1], along[1]);
  const Hang truth = elastica(kWeight * kGravity * length * length * length / strip.bend, angle);
  const Vec3 tip = tipOf(strip);
  const double reach = (tip.z - along[0]) / length, fall = (-tip.y - down[0]) / length;
  // Off the straight line on which it starts: what bending does.
  const double bent = fall * std::cos(angle) - reach * std::sin(angle);
  const double should = truth.fall * std::cos(angle) - truth.reach * std::sin(angle);
  EXPECT_NEAR(bent, should, 0.01 * should + 0.001);
  EXPECT_NEAR(fall, truth.fall, 0.01);
  EXPECT_NEAR(reach, truth.reach, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Angles, AcrossTheGrain,
                         testing::Combine(testing::Values(1, 10, 100), testing::Values(5, 17, 30, 52, 67, 80)));

}  // namespace
}  // namespace karinui::test
