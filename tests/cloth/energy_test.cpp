#include <gtest/gtest.h>

#include "cloth/bending.h"
#include "cloth/crease.h"
#include "cloth/edge_bending.h"
#include "cloth/elastic.h"
#include "cloth/helpers.h"
#include "cloth/membrane.h"
#include "cloth/springs.h"

namespace karinui::test {
namespace {

// A piece whose grid stands askew in its outline, so that half of it is ring; an elastic, a hem, a cord and a fold in
// it.
ClothLevel askew(const Fabric& fabric, double fold = 0.4) {
  auto paper = rectangle(1, 0.11, 0.09, {0.3, 1});
  paper->lines.push_back({"turn", {Curve::line({0.01, 0.03}, {0.1, 0.06})}, Crease{fold, 0.9}});
  Allowances finish;
  finish.elastics[{{1}, "bottom"}] = {0.7, 10};
  finish.hems[{{1}, "top"}] = {0.02, 0};
  finish.pipings[{{1}, "left"}] = {0.004, ""};
  ClothChoice choice;
  choice.finish = &finish;
  return levelOf(patternOf({paper}), 0.01, fabric, choice);
}

std::vector<std::unique_ptr<Energy>> energiesOf(const Cloth& cloth) {
  std::vector<std::unique_ptr<Energy>> all;
  all.push_back(std::make_unique<Membrane>(cloth));
  Workers workers;
  all.push_back(
      std::make_unique<Bending>(cloth, std::vector<std::uint8_t>(cloth.nodeCount, 0), GridLayout(cloth), workers));
  all.push_back(std::make_unique<Springs>(simclothSprings(cloth), cloth.nodeCount));
  all.push_back(std::make_unique<Springs>(edgeSprings(cloth), cloth.nodeCount));
  all.push_back(std::make_unique<Springs>(elasticSprings(cloth), cloth.nodeCount));
  all.push_back(std::make_unique<EdgeBending>(cloth));
  all.push_back(std::make_unique<CreaseHinges>(cloth));
  return all;
}

std::vector<Vec3> shaken(const ClothLevel& level, double stretch, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-noise, noise);
  std::vector<Vec3> x = level.state.position;
  for (Vec3& p : x)
    p = Vec3{p.x * stretch, p.y * stretch, 0.02 * std::sin(40 * p.x)} + Vec3{by(random), by(random), by(random)};
  return x;
}

class EveryLaw : public testing::TestWithParam<Fabric::Law> {
 protected:
  Fabric fabric() const {
    Fabric f = *preset(GetParam() == Fabric::Law::Woven ? "denim" : "simcloth");
    return f;
  }
  Workers workers{1};
};

TEST_P(EveryLaw, GradientIsTheSlopeOfTheValue) {
  const ClothLevel level = askew(fabric());
  for (double stretch : {1.1, 0.9})
    for (const auto& energy : energiesOf(level.cloth)) {
      std::vector<Vec3> x = shaken(level, stretch, 0.0005, 7);
      std::vector<Vec3> gradient(x.size());
      energy->addGradient(x, gradient, workers);
      double scale = 0;
      for (Vec3 g : gradient) scale = std::fmax(scale, length(g));
      if (scale == 0) continue;
      for (std::size_t k = 0; k < x.size(); k += 3) {
        Vec3 slope;
        for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
          const double step = 2e-7, before = x[k].*axis;
          x[k].*axis = before + step;
          const double up = energy->value(x, workers);
          x[k].*axis = before - step;
          const double down = energy->value(x, workers);
          x[k].*axis = before;
          slope.*axis = (up - down) / (2 * step);
        }
        EXPECT_LT(length(slope - gradient[k]), 1e-7 * scale) << "node " << k;
      }
    }
}

TEST_P(EveryLaw, PullsOnNothingOutside) {
  const ClothLevel level = askew(fabric());
  const std::vector<Vec3> x = shaken(level, 1.05, 0.001, 11);
  for (const auto& energy : energiesOf(level.cloth)) {
    std::vector<Vec3> gradient(x.size());
    energy->addGradient(x, gradient, workers);
    Vec3 force, torque;
    double scale = 1e-12;
    for (std::size_t k = 0; k < x.size(); ++k) {
      force += gradient[k];
      torque += cross(x[k], gradient[k]);
      scale = std::fmax(scale, length(gradient[k]));
    }
    EXPECT_LT(length(force), 1e-11 * scale);
    EXPECT_LT(length(torque), 1e-11 * scale);
  }
}

TEST_P(EveryLaw, TurnsWithTheCloth) {
  const ClothLevel level = askew(fabric());
  const Rigid turn = after(turnAbout({1, 2, 3}, 1.1), turnAbout({0, 1, 0}, 0.4));
  std::vector<Vec3> x = level.state.position;
  for (Vec3& p : x) p = turn(p) + Vec3{3, -2, 1};
  for (const auto& energy : energiesOf(level.cloth)) {
    // What pulls on flat cloth, an elastic or a fold, turns with it.
    std::vector<Vec3> still(x.size()), gradient(x.size());
    energy->addGradient(level.state.position, still, workers);
    energy->addGradient(x, gradient, workers);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(length(gradient[k] - turn(still[k])), 1e-9);
  }
}

TEST_P(EveryLaw, BlocksAreTheSlopeOfTheGradientAlongStretch) {
  // Where nothing is squeezed the stand-in keeps all but the shear's small indefinite part, so it must predict the
  // gradient's change under further stretch. (A fold's stand-in lacks what its torque turns: none where it rests.)
  const ClothLevel level = askew(fabric(), 0);
  std::vector<Vec3> x = level.state.position, move = x;
  for (Vec3& p : x) p = p * 1.2;
  const double step = 1e-7;
  for (const auto& any : energiesOf(level.cloth)) {
    const auto* energy = dynamic_cast<const BlockEnergy*>(any.get());
    if (!energy) continue;  // bending: see the step's system
    std::vector<NodePair> pairs;
    energy->appendPairs(pairs);
    std::vector<Block3> blocks(energy->pairCount());
    ASSERT_EQ(pairs.size(), blocks.size());
    energy->blocks(x, blocks, workers);
    std::vector<Vec3> predicted(x.size()), before(x.size()), afterwards(x.size());
    for (std::size_t s = 0; s < pairs.size(); ++s) {
      const Block3& b = blocks[s];
      const Vec3 m = move[pairs[s].column];
      predicted[pairs[s].row] += Vec3{b[0] * m.x + b[1] * m.y + b[2] * m.z, b[3] * m.x + b[4] * m.y + b[5] * m.z,
                                      b[6] * m.x + b[7] * m.y + b[8] * m.z};
    }
    energy->addGradient(x, before, workers);
    std::vector<Vec3> further = x;
    for (std::size_t k = 0; k < x.size(); ++k) further[k] += move[k] * step;
    energy->addGradient(further, afterwards, workers);
    double scale = 1e-2;
    for (Vec3 p : predicted) scale = std::fmax(scale, length(p));
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_LT(length((afterwards[k] - before[k]) * (1 / step) - predicted[k]), 1e-3 * scale);
  }
}

INSTANTIATE_TEST_SUITE_P(Fabrics, EveryLaw, testing::Values(Fabric::Law::Woven, Fabric::Law::Simcloth));

TEST(Membrane, UniformStretchIsFeltTheSameAcrossLatticeAndRing) {
  Workers workers(1);
  const double k = 800, strain = 0.01;
  const ClothLevel level = askew(textbook(k, 0, 0.1));
  const Flat warp = level.cloth.pieces[0].lattice->warp, weft = level.cloth.pieces[0].lattice->weft;
  std::vector<Vec3> x = level.state.position;
  for (Vec3& p : x) {
    const Flat f{p.x, p.y};
    const Flat to = warp * (dot(f, warp) * (1 + strain)) + weft * dot(f, weft);
    p = {to.u, to.v, 0};
  }
  const Membrane membrane(level.cloth);
  EXPECT_NEAR(membrane.value(x, workers), 0.5 * k * strain * strain * 0.11 * 0.09, 1e-12);
  // Inside nothing is out of balance; on the border the forces are those of a uniform tension.
  std::vector<Vec3> gradient(x.size());
  membrane.addGradient(x, gradient, workers);
  std::vector<std::uint8_t> border(x.size(), 0);
  for (std::uint32_t n : level.cloth.pieces[0].lattice->border) border[n] = 1;
  for (std::size_t n = 0; n < x.size(); ++n)
    if (!border[n]) {
      EXPECT_LT(length(gradient[n]), 1e-12);
    }
}

TEST(Membrane, BiasModulusFollowsFromStretchAndShear) {
  // 1/(1/(4 Ku) + 1/(4 Kv) + 1/(4 G)) without Poisson coupling.
  const double k = 2000, g = 40, strain = 1e-4;
  const double modulus = 1 / (1 / (4 * k) + 1 / (4 * k) + 1 / (4 * g));
  Fabric f = textbook(k, 0, 0.1);
  f.shear = g;
  Cloth cloth;
  addPiece(cloth, gridLattice(6, 6, 0.01), f);
  const Membrane membrane(cloth);
  Workers workers(1);
  // Uniform fields: stretch e along the bias, c across, symmetric. The energy's least value over c is 1/2 modulus e^2.
  const auto energy = [&](double c) {
    std::vector<Vec3> x;
    for (Flat p : cloth.pieces[0].lattice->nodes) {
      const Flat along{std::sqrt(0.5), std::sqrt(0.5)}, across = leftOf(along);
      const Flat q = along * (dot(p, along) * (1 + strain)) + across * (dot(p, across) * (1 + c));
      x.push_back({q.u, q.v, 0});
    }
    return membrane.value(x, workers) / (0.06 * 0.06);
  };
  double low = -3 * strain, high = strain;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (energy(a) < energy(b) ? high : low) = energy(a) < energy(b) ? b : a;
  }
  EXPECT_NEAR(2 * energy(low) / (strain * strain), modulus, 0.002 * modulus);
  EXPECT_NEAR(modulus, 153.8, 0.1);
}

// Cloth clamped in a hinged frame of side a, sheared by gamma: along the diagonal it takes
// F = a dPhi/dgamma / sin(pi/4 - gamma/2), dPhi/dgamma = G (gamma + k gamma^3). Threads keep their lengths, so whatever
// their curves, only shear speaks; G 40, a 0.2, gamma 0.1: 1.192 N.
TEST(Membrane, PictureFrameForce) {
  Fabric plain = textbook(2000, 0, 0.1), stiffening = *preset("denim");
  plain.shear = 40;
  stiffening.shearStiffen = 3;
  Workers workers(1);
  const double side = 0.2, quarter = std::acos(-1.0) / 4;
  for (const Fabric& f : {plain, stiffening}) {
    Cloth cloth;
    addPiece(cloth, gridLattice(10, 10, 0.02), f);
    const Membrane membrane(cloth);
    const auto framed = [&](double gamma) {
      const double angle = quarter - gamma / 2;  // half the frame's corner
      const Vec3 a{std::cos(angle), std::sin(angle), 0}, b{std::cos(angle), -std::sin(angle), 0};
      std::vector<Vec3> x;
      for (Flat p : cloth.pieces[0].lattice->nodes) x.push_back(a * p.u + b * p.v);
      return x;
    };
    const auto diagonal = [&](double gamma) { return 2 * side * std::cos(quarter - gamma / 2); };
    for (const double gamma : {-0.2, 0.02, 0.1, 0.4}) {
      SCOPED_TRACE(f.name + ", " + std::to_string(gamma));
      const double step = 1e-5;
      const double force =
          (membrane.value(framed(gamma + step), workers) - membrane.value(framed(gamma - step), workers)) /
          (diagonal(gamma + step) - diagonal(gamma - step));
      const double right =
          side * f.shear * (gamma + f.shearStiffen * gamma * gamma * gamma) / std::sin(quarter - gamma / 2);
      EXPECT_NEAR(force, right, (0.001 + 3 * std::pow(gamma, 4)) * std::fabs(right));  // a polynomial's next order
      if (f == plain && gamma == 0.1) {
        EXPECT_NEAR(force, 1.192, 0.002);
      }
      // Within the frame nothing is out of balance.
      std::vector<Vec3> gradient(cloth.nodeCount);
      membrane.addGradient(framed(gamma), gradient, workers);
      for (std::uint32_t j = 1; j < 10; ++j)
        for (std::uint32_t i = 1; i < 10; ++i) EXPECT_LT(length(gradient[j * 11 + i]), 1e-9);
    }
  }
}

// Whichever way the grain runs, ring and all: an evenly bent piece stores what it should, and is out of balance only
// where moments act on its edge. What is soft or stiff along the border fails here.
TEST(Bending, EvenlyBentPieceIsInBalanceButOnItsBentEdges) {
  Workers workers(1);
  const double b = 2e-5, bend = 5, width = 0.21, height = 0.19, far = 0.045;
  for (const double degrees : {0, 5, 17, 30, 45, 73, 90}) {
    const double turn = degrees * std::acos(-1.0) / 180;
    const ClothLevel level = levelOf(patternOf({rectangle(1, width, height, {std::sin(turn), std::cos(turn)})}), 0.01,
                                     textbook(1000, b, 0.1));
    const auto& nodes = level.cloth.pieces[0].lattice->nodes;
    const std::vector<std::uint8_t> held(level.cloth.nodeCount, 0);
    const Bending bending(level.cloth, held, GridLayout(level.cloth), workers);
    for (const bool across : {true, false}) {
      SCOPED_TRACE(std::to_string(degrees) + (across ? " degrees, across" : " degrees, along"));
      std::vector<Vec3> x, force(nodes.size());
      for (const Flat p : nodes) x.push_back({p.u, p.v, 0.5 * bend * (across ? p.u * p.u : p.v * p.v)});
      const double whole = 0.5 * b * bend * bend * width * height;
      EXPECT_NEAR(bending.value(x, workers), whole, 1e-9 * whole);
      bending.addGradient(x, force, workers);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double edge =
            across ? std::fmin(nodes[k].u, width - nodes[k].u) : std::fmin(nodes[k].v, height - nodes[k].v);
        if (edge > far) {
          EXPECT_LT(length(force[k]), 1e-9 * b * bend) << nodes[k].u << ", " << nodes[k].v;
        }
      }
    }
  }
}

TEST(Springs, SimclothKnowsEightNeighboursAndFourFurther) {
  Cloth cloth;
  addPiece(cloth, gridLattice(4, 4, 0.01), *preset("simcloth"));
  int atMiddle = 0;
  for (const auto& spring : simclothSprings(cloth)) atMiddle += spring.a == 12 || spring.b == 12;
  EXPECT_EQ(atMiddle, 12);
  const double k = cloth.pieces[0].fabric.stretchWarp;
  const Springs one({{0, 1, 0.01, k}}, 2);
  Workers workers(1);
  std::vector<Vec3> pull(2);
  one.addGradient(std::vector<Vec3>{{0, 0, 0}, {0.012, 0, 0}}, pull, workers);
  EXPECT_NEAR(pull[1].x, k * 0.002, 1e-12);  // K (x - x_k)(l - L)/l
  std::fill(pull.begin(), pull.end(), Vec3{});
  one.addGradient(std::vector<Vec3>{{0, 0, 0}, {0.008, 0, 0}}, pull, workers);
  EXPECT_EQ(pull[1], Vec3{});  // never pushes
}

}  // namespace
}  // namespace karinui::test
