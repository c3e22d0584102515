#include "karinui/touch/force_law.h"

#include <gtest/gtest.h>

#include "touch/hand.h"

namespace karinui {
namespace {

void expectNear(Vec3 a, Vec3 b, double within = 1e-9) { EXPECT_LE(distance(a, b), within); }

// Each law through the evaluator of a scene, against its formula.
TouchForces felt(const TouchScene& scene, Vec3 from, Vec3 to, const TouchLaws& laws = {}, Vec3 velocity = {}) {
  TouchEvaluator evaluator;
  evaluator.evaluate(scene, touchRecord(), laws, from, {});
  return evaluator.evaluate(scene, touchRecord(), laws, to, velocity);
}

TEST(ForceLaw, TouchingIsMinusNPN) {
  TouchScene scene;
  const Vec3 normal = normalized({1, 2, 2});
  const Vec3 u = normalized(cross(normal, {0, 0, 1})), v = cross(normal, u), on{0.1, 0.2, 0.3};
  add(scene, on - u - v, on + u - v, on + v);
  scene.radius = 10;
  scene.stiffness = 300;
  const Vec3 penetration = normal * -0.003 + u * 0.002;
  const auto forces = felt(scene, on + normal * 0.01, on + penetration, {.friction = false});
  expectNear(forces.contact, normal * (-300 * dot(normal, penetration)));
  expectNear(contactForce(penetration, normal, 300), normal * (-300 * dot(normal, penetration)));
  expectNear(contactForce(normal * 0.003, normal, 300), {});
  expectNear(felt(scene, on + normal * 0.01, on + penetration, {.contact = false}).coupled(), {});
}

TEST(ForceLaw, FrictionIsWithinCoulombsCone) {
  TouchScene scene = floorScene();
  scene.friction = 0.4;
  const auto slips = felt(scene, {0, 0.001, 0}, {0.02, -0.005, 0});
  EXPECT_NEAR(slips.contact.x, -0.4 * slips.contact.y, 0.01);
  const auto none = felt(scene, {0, 0.001, 0}, {0.02, -0.005, 0}, {.friction = false});
  EXPECT_NEAR(none.contact.x, 0, 1e-6);
}

TEST(ForceLaw, CarryingIsMassTimesGravity) {
  TouchScene scene;
  scene.carriedMass = 0.08;
  expectNear(felt(scene, {}, {}).weight, {0, -0.08 * 9.81, 0});
  expectNear(felt(scene, {}, {}, {.weight = false}).weight, {});
}

TEST(ForceLaw, PullingIsEquationOneBeyondNaturalLength) {
  TouchScene scene;
  scene.damping = 0;
  Grab& grab = scene.grab.emplace();
  grab.springStiffness = 40;
  grab.neighbours = {{{0.1, 0, 0}, 0.08}, {{0, 0.05, 0}, 0.06}, {{0, 0, -0.2}, 0.1}};
  const Vec3 x{-0.01, 0.002, 0.003};
  Vec3 sum;
  for (const auto& [xk, natural] : grab.neighbours) {
    const double l = distance(x, xk);
    if (l > natural) sum += (xk - x) * (40 * (l - natural) / l);
  }
  EXPECT_GT(length(sum), 1);
  expectNear(felt(scene, x, x, {.pull = PullLaw::Springs}).pull, sum);
  expectNear(felt(scene, x, x, {.pull = PullLaw::None}).pull, {});
  expectNear(springTension(x, {0, 0.05, 0}, 0.06, 40), {}, 0);
}

TEST(ForceLaw, PullingByTheFabricsCurveRisesAsItDoes) {
  TouchScene scene;
  scene.damping = 0;
  Grab& grab = scene.grab.emplace();
  grab.anchor = {0, 1, 0};
  grab.natural = 0.1;
  grab.curve.places = {{0, 0}, {0.01, 0.05}, {0.02, 0.3}, {0.03, 1.3}};
  const auto at = [&](double extension) {
    const auto forces = felt(scene, {0, 0.9 - extension, 0}, {0, 0.9 - extension, 0});
    EXPECT_NEAR(forces.pull.x, 0, 1e-12);
    return forces.pull.y;
  };
  EXPECT_EQ(at(-0.01), 0);
  EXPECT_NEAR(at(0.005), 0.025, 1e-9);
  EXPECT_NEAR(at(0.015), 0.175, 1e-9);
  EXPECT_NEAR(at(0.025), 0.8, 1e-9);
  EXPECT_NEAR(at(0.035), 1.8, 1e-9);
  double energy = 0;
  for (int k = 0; k < 3500; ++k) energy += 1e-5 * at((k + 0.5) * 1e-5);
  EXPECT_NEAR(storedEnergy(grab.curve, 0.035, 1e9), energy, 1e-7);
}

TEST(ForceLaw, PullingByTheTangentIsAffine) {
  TouchScene scene;
  scene.damping = 0;
  Grab& grab = scene.grab.emplace();
  grab.place = {0.1, 0.2, 0.3};
  grab.force = {0.3, -0.1, 0.2};
  grab.stiffness = {50, 10, 0, 60, 5, 70};
  const Vec3 step{0.002, -0.001, 0.003};
  const auto forces = felt(scene, grab.place, grab.place + step, {.pull = PullLaw::Tangent});
  expectNear(forces.pull, Vec3{0.3, -0.1, 0.2} - Vec3{50 * 0.002 - 10 * 0.001, 10 * 0.002 - 60 * 0.001 + 5 * 0.003,
                                                      -5 * 0.001 + 70 * 0.003});
}

TEST(ForceLaw, CuttingIsFeltAgainstTheMotion) {
  TouchScene scene;
  scene.cutting = 0.8;
  expectNear(felt(scene, {}, {}, {}, {0.1, 0, 0}).cut, {-0.8, 0, 0});
  expectNear(felt(scene, {}, {}, {}, {0, 0.025, 0}).cut, {0, -0.4, 0});
  expectNear(felt(scene, {}, {}, {}, {}).cut, {});
  expectNear(felt(scene, {}, {}, {.cutting = false}, {0.1, 0, 0}).cut, {});
}

TEST(ForceLaw, TheWeaveIsFeltThreadByThread) {
  TouchScene scene = floorScene();
  scene.weave = Weave{{1, 0, 0}, {0, 0, 1}, 0.004, 0.1};
  const auto at = [&](double x, bool weave) {
    return felt(scene, {x, 0.001, 0.001}, {x, -0.002, 0.001}, {.friction = false, .weave = weave}).contact.y;
  };
  EXPECT_NEAR(at(0.001, true), at(0.001, false) * 1.1, 1e-6);
  EXPECT_NEAR(at(0.003, true), at(0.001, false) * 0.9, 1e-6);
  scene.weave->depth = 5;  // never more than a little
  EXPECT_NEAR(at(0.001, true), at(0.001, false) * 1.15, 1e-6);
}

TEST(ForceLaw, AClickIsShortAndSmooth) {
  EXPECT_EQ(clickForce(-0.01), 0);
  EXPECT_NEAR(clickForce(kClickSeconds / 2), kClickForce, 1e-12);
  EXPECT_EQ(clickForce(kClickSeconds), 0);
  for (double t = 0; t < 0.05; t += 0.001) EXPECT_LE(std::fabs(clickForce(t + 0.001) - clickForce(t)), 30 * 0.001);
}

TEST(ForceLaw, ASnappedPairClicksOnce) {
  ServoStep step(touchRecord());
  TouchScene one, two;
  one.published = 1e9, two.published = 1e9;
  one.clicks = 4, two.clicks = 5;  // what snapped before is not felt
  step.adopt(&one, 0);
  double before = 0, most = 0, after = 0;
  for (int k = 0; k < 4000; ++k) {
    if (k == 2000) step.adopt(&two, k * 0.001);
    const double force = length(step.tick(handAt({}), k * 0.001).out.force);
    (k < 2000 ? before : k < 2100 ? most : after) = std::max(k < 2000 ? before : k < 2100 ? most : after, force);
  }
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(most, 0.5 * kClickForce, 0.01);
  EXPECT_NEAR(after, 0, 1e-12);
}

TEST(ForceLaw, NothingIsFeltWhilePiecesAreCutOrSewn) {
  TouchScene scene = floorScene();
  scene.changing = true;
  scene.cutting = 1;
  scene.grab.emplace().curve.places = {{0, 0}, {1, 100}};
  expectNear(felt(scene, {0, 0.01, 0}, {0, -0.01, 0}, {}, {0.1, 0, 0}).coupled(), {});
}

}  // namespace
}  // namespace karinui
