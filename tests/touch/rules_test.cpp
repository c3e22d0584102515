// The nine safety rules of the force loop, each with the fault it is there for.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "karinui/touch/simulated_hand.h"
#include "touch/hand.h"

namespace karinui {
namespace {

// A step under a virtual clock, its scenes published anew at every tick so that none grows old.
class Loop {
 public:
  explicit Loop(const ServoSettings& settings = {}, const DeviceRecord& record = touchRecord())
      : record_(record), step(record, settings) {}
  ServoTick at(Vec3 place, Vec3 velocity = {}) { return with(handAt(place, velocity)); }
  ServoTick with(const HandSample& hand, double seconds = kServoTick) {
    now += seconds;
    if (publish) fresh();
    const ServoTick tick = step.tick(hand, now);
    const Vec3 force = tick.out.force;
    steepest = std::max(steepest, distance(force, force_));
    most = std::max(most, length(force));
    force_ = force;
    return tick;
  }
  void hold(Vec3 place, double seconds) {
    for (double t = 0; t < seconds; t += kServoTick) at(place);
  }
  // Above the floor until the force is armed.
  void arm(Vec3 place = {0, 0.005, 0}) { hold(place, 1.6); }
  // Down (or up) at 5 cm/s.
  void lead(Vec3 from, Vec3 to, double speed = 0.05) {
    const int ticks = static_cast<int>(distance(from, to) / speed / kServoTick);
    for (int k = 1; k <= ticks; ++k) at(lerp(from, to, static_cast<double>(k) / ticks), normalized(to - from) * speed);
    at(to);
  }
  void fresh() {
    if (now - adopted_ >= 0.016 && step.mayAdopt(now)) show(scene);
  }
  void show(const TouchScene& wanted) {
    auto one = std::make_unique<TouchScene>(wanted);
    one->published = now;
    adopted_ = now;
    step.adopt(one.get(), now);
    kept_.push_back(std::move(one));
  }

  TouchScene scene = floorScene();
  bool publish = true;
  double now = 10, most = 0, steepest = 0;

 private:
  DeviceRecord record_;
  double adopted_ = -1;
  Vec3 force_;
  std::vector<std::unique_ptr<TouchScene>> kept_;

 public:
  ServoStep step;
};

TEST(Safety, ForceIsACouplingToTheProxy) {  // 1
  Loop loop;
  loop.scene.damping = 2;
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.004, 0});
  loop.hold({0, -0.004, 0}, 0.1);
  EXPECT_NEAR(distance(loop.at({0, -0.004, 0}).out.force, {0, 0.5 * 400 * 0.004, 0}), 0, 1e-6);
  // A spring and a damper, not the spring alone.
  for (int k = 0; k < 5; ++k) loop.at({0, -0.004, 0}, {0, -0.05, 0});
  EXPECT_NEAR(loop.at({0, -0.004, 0}, {0, -0.05, 0}).out.force.y, 0.5 * (400 * 0.004 + 2 * 0.05), 1e-6);
  // What a solver says of a force at a place is felt only as a spring about it: never by itself while nothing is held.
  loop.scene.grab.emplace();
  loop.scene.grab->force = {100, 0, 0};
  loop.hold({0, -0.004, 0}, 0.2);
  EXPECT_NEAR(loop.at({0, -0.004, 0}).out.force.x, 0, 1e-9);
}

TEST(Safety, StiffnessAndDampingStayWithinTheDevice) {  // 2
  Loop loop({.gain = 1});
  loop.scene.stiffness = 1e5;
  loop.scene.damping = 1e3;
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.004, 0});
  loop.hold({0, -0.004, 0}, 0.2);
  EXPECT_NEAR(loop.at({0, -0.004, 0}).out.force.y, 400 * 0.004, 1e-6);
  EXPECT_LE(loop.most, 400 * 0.0041 + 4 * 0.06);
  Loop half;  // the gain is a half unless it is said
  half.scene.stiffness = 1e5;
  half.arm();
  half.lead({0, 0.005, 0}, {0, -0.004, 0});
  half.hold({0, -0.004, 0}, 0.2);
  EXPECT_NEAR(half.at({0, -0.004, 0}).out.force.y, 0.5 * 400 * 0.004, 1e-6);
  // Many stiff springs, and a stiff curve, are no stiffer than the coupling allows.
  TouchScene scene;
  scene.damping = 0;
  scene.grab.emplace();
  scene.grab->springStiffness = 5000;
  for (int k = 0; k < 12; ++k) scene.grab->neighbours.push_back({{0, 0, 0}, 0});
  scene.grab->curve.places = {{0, 0}, {0.01, 500}};
  scene.grab->force = {0, 0, 0};
  scene.grab->stiffness = {9000, 0, 0, 9000, 0, 9000};
  for (const PullLaw law : {PullLaw::Springs, PullLaw::Curve, PullLaw::Tangent}) {
    TouchEvaluator evaluator;
    const auto forces = evaluator.evaluate(scene, touchRecord(), {.pull = law}, {0.01, 0, 0}, {});
    EXPECT_LE(length(forces.pull), 0.7 * 400 * 0.01 + 1e-9);
    EXPECT_GT(length(forces.pull), 0.5 * 400 * 0.01 / std::sqrt(3));
  }
}

TEST(Safety, ForceStaysWithinTheLimit) {  // 3
  for (const double wish : {3.0, 1.0, 100.0}) {
    Loop loop({.gain = 1, .limit = wish});
    loop.scene.carriedMass = 0.5;
    loop.arm();
    loop.lead({0, 0.005, 0}, {0, -0.05, 0});
    loop.hold({0, -0.05, 0}, 0.2);
    EXPECT_NEAR(loop.most, std::min(wish, 0.8 * 3.3), 1e-6);
    EXPECT_TRUE(loop.at({0, -0.05, 0}).limited);
  }
}

TEST(Safety, ForceDoesNotStepWhenTheSceneDoes) {  // 4
  Loop loop({.gain = 1});
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.005, 0});
  loop.hold({0, -0.005, 0}, 0.2);
  loop.steepest = 0;
  loop.scene.facets.clear();  // deleted under the tip
  loop.hold({0, -0.005, 0}, 0.2);
  EXPECT_NEAR(length(loop.at({0, -0.005, 0}).out.force), 0, 1e-9);
  EXPECT_LE(loop.steepest, 300 * kServoTick + 1e-9);
  EXPECT_GT(loop.steepest, 0.05);
  // The cloth leaps away from the hand, and comes to be cut.
  loop.scene.grab.emplace();
  loop.scene.grab->curve.places = {{0, 0}, {0.1, 5}};
  loop.scene.grab->anchor = {0, -0.005, 0};
  loop.hold({0, -0.005, 0}, 0.1);
  loop.steepest = 0;
  loop.scene.grab->anchor = {0.05, 0, 0};
  loop.hold({0, -0.005, 0}, 0.3);
  EXPECT_GT(length(loop.at({0, -0.005, 0}).out.force), 2);
  EXPECT_LE(loop.steepest, 30 * kServoTick + 1e-9);
  loop.scene.changing = true;
  loop.hold({0, -0.005, 0}, 0.1);
  EXPECT_NEAR(length(loop.at({0, -0.005, 0}).out.force), 0, 1e-9);
  EXPECT_LE(loop.steepest, 300 * kServoTick + 1e-9);
}

TEST(Safety, ForceIsArmedOnlyWhereNoneWouldAct) {  // 5
  Loop loop;
  loop.scene.grab.emplace();  // something pulls from the start
  loop.scene.grab->curve.places = {{0, 0}, {0.01, 1}};
  loop.scene.grab->anchor = {0.01, 0.01, 0};
  loop.hold({0, 0.01, 0}, 3);
  EXPECT_EQ(loop.most, 0);
  EXPECT_EQ(loop.at({0, 0.01, 0}).state, ServoState::Waiting);
  loop.lead({0, 0.01, 0}, {0.01, 0.01, 0});
  loop.hold({0.01, 0.01, 0}, 0.01);
  EXPECT_EQ(loop.at({0.01, 0.01, 0}).state, ServoState::Ramping);
  EXPECT_LT(loop.most, 0.05) << "a ramp begins at nothing";
  loop.lead({0.01, 0.01, 0}, {0, 0.01, 0});
  const double early = length(loop.at({0, 0.01, 0}).out.force);
  loop.hold({0, 0.01, 0}, 1.6);
  EXPECT_EQ(loop.at({0, 0.01, 0}).state, ServoState::Armed);
  EXPECT_NEAR(length(loop.at({0, 0.01, 0}).out.force), 0.5, 1e-6);
  EXPECT_LT(early, 0.25);
  // Lost focus, then focus: the hand must first be where nothing acts.
  loop.step.setFocus(false);
  loop.hold({0, 0.01, 0}, 0.1);
  EXPECT_EQ(loop.at({0, 0.01, 0}).fault, ServoFault::NoFocus);
  loop.step.setFocus(true);
  loop.hold({0, 0.01, 0}, 2);
  EXPECT_NEAR(length(loop.at({0, 0.01, 0}).out.force), 0, 1e-9);
}

// Rule 6: the hand presses on the floor, a fault comes, and the force is gone within 50 ms and without a step.
void fades(const std::string& what, ServoFault fault,
           const std::function<HandSample(Loop&, HandSample, double&)>& bring) {
  SCOPED_TRACE(what);
  Loop loop({.gain = 1});
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.005, 0});
  loop.hold({0, -0.005, 0}, 0.1);
  double seconds = kServoTick;
  loop.steepest = 0;
  const HandSample hand = bring(loop, handAt({0, -0.005, 0}), seconds);
  ServoTick tick = loop.with(hand, seconds);
  EXPECT_EQ(tick.fault, fault);
  EXPECT_EQ(tick.state, ServoState::Fading);
  EXPECT_GT(length(tick.out.force), 1);
  for (int k = 0; k < 51; ++k) tick = loop.with(handAt(hand.tip.carry));
  EXPECT_NEAR(length(tick.out.force), 0, 1e-9);
  EXPECT_LE(loop.steepest, 2 / 0.05 * kServoTick + 1e-9);
  EXPECT_NE(tick.state, ServoState::Armed);
}

TEST(Safety, AFaultFadesTheForceOut) {  // 6
  fades("jump", ServoFault::Jump, [](Loop&, HandSample hand, double&) {
    hand.tip.carry.x += 0.021;
    return hand;
  });
  fades("speed as told", ServoFault::Speed, [](Loop&, HandSample hand, double&) {
    hand.velocity = {0, 0, 1.1};
    return hand;
  });
  fades("speed as seen", ServoFault::Speed, [](Loop&, HandSample hand, double&) {
    hand.tip.carry.x += 0.002;
    return hand;
  });
  fades("late tick", ServoFault::Late, [](Loop&, HandSample hand, double& seconds) {
    seconds = 0.021;
    return hand;
  });
  fades("not ready", ServoFault::NotReady, [](Loop&, HandSample hand, double&) {
    hand.ready = false;
    return hand;
  });
  fades("old scene", ServoFault::Stale, [](Loop& loop, HandSample hand, double&) {
    loop.publish = false;
    while (loop.at(hand.tip.carry).fault == ServoFault::None && loop.now < 100) {
    }
    return hand;
  });
  Loop loop({.gain = 1});
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.005, 0});
  loop.hold({0, -0.005, 0}, 0.1);
  loop.publish = false;
  const double from = loop.now;
  while (loop.at({0, -0.005, 0}).fault == ServoFault::None) ASSERT_LT(loop.now, from + 1);
  EXPECT_LE(loop.now - from, 0.100 + 2 * kServoTick);
}

TEST(Safety, WhatIsNoNumberEndsTheForceAtOnce) {  // 6
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf}) {
    for (const int where : {0, 1, 2}) {
      Loop loop({.gain = 1});
      loop.arm();
      loop.lead({0, 0.005, 0}, {0, -0.005, 0});
      loop.hold({0, -0.005, 0}, 0.1);
      HandSample hand = handAt({0, -0.005, 0});
      if (where == 0) hand.tip.carry.y = bad;
      if (where == 1) hand.velocity.x = bad;
      if (where == 2) loop.scene.damping = nan, loop.scene.friction = bad, loop.scene.carriedMass = nan;
      ServoTick tick;
      for (int k = 0; k < 40 && tick.fault != ServoFault::NotFinite; ++k) tick = loop.with(hand);
      EXPECT_EQ(tick.fault, ServoFault::NotFinite) << where;
      EXPECT_EQ(length(tick.out.force), 0) << where;
      for (int k = 0; k < 40; ++k) EXPECT_EQ(length(loop.with(hand).out.force), 0) << where;
    }
  }
}

// Cloth that answers late: every 50 ms its anchor comes to where the hand was 50 ms ago, less its stretch. A hand that
// goes to and fro draws energy out of it.
double gained(bool passivity) {
  ServoSettings settings;
  settings.gain = 1;
  settings.passivity = passivity;
  settings.laws.pull = PullLaw::Tangent;
  Loop loop(settings);
  loop.scene = {};
  Grab& grab = loop.scene.grab.emplace();
  grab.stiffness = {150, 0, 0, 150, 0, 150};
  loop.arm({});
  SimulatedHand hand({}, {0.2, 60, 0.5});
  double worst = 0;
  Vec3 force;
  for (int k = 0; k < 6000; ++k) {
    if (k % 50 == 0) grab.place = {}, grab.force = hand.place() * -150 + hand.velocity() * 7.5;  // late by 50 ms
    if (k % 50 == 0) grab.place = hand.place();
    hand.step({0.02 * std::sin(0.012 * k), 0, 0}, force, kServoTick);
    force = loop.at(hand.place(), hand.velocity()).out.force;
    worst = std::max(worst, hand.work());
  }
  return worst;
}

TEST(Safety, ThePassivityObserverTakesOutWhatTheSolverPutsIn) {  // 7
  EXPECT_GT(gained(false), 0.02);
  EXPECT_LE(gained(true), 0.003);
}

TEST(Safety, WhatIsCarriedIsNeverTooHeavy) {  // 8
  Loop heavy({.gain = 1});
  heavy.scene = {};
  heavy.scene.carriedMass = 2;
  heavy.hold({0, 0.1, 0}, 2.5);
  EXPECT_NEAR(distance(heavy.at({0, 0.1, 0}).out.force, {0, -0.3 * 3.3, 0}), 0, 1e-9);
  EXPECT_NEAR(heavy.most, 0.3 * 3.3, 1e-9);
  Loop light;
  light.scene = {};
  light.scene.carriedMass = 0.05;
  light.hold({0, 0.1, 0}, 2.5);
  EXPECT_NEAR(light.at({0, 0.1, 0}).out.force.y, -0.5 * 0.05 * kGravity, 1e-9);
}

TEST(Safety, EmergencyOffEndsTheForceAtOnce) {  // 9
  for (const bool button : {true, false}) {
    Loop loop({.gain = 1, .offButtons = 4});
    loop.arm();
    loop.lead({0, 0.005, 0}, {0, -0.005, 0});
    loop.hold({0, -0.005, 0}, 0.1);
    HandSample hand = handAt({0, -0.005, 0});
    if (button)
      hand.buttons = 4;
    else
      loop.step.emergencyOff();
    ServoTick tick = loop.with(hand);
    EXPECT_EQ(tick.state, ServoState::Off);
    EXPECT_EQ(length(tick.out.force), 0);
    loop.hold({0, 0.01, 0}, 3);  // let go of the button: it stays off
    loop.lead({0, 0.01, 0}, {0, -0.005, 0});
    EXPECT_EQ(length(loop.at({0, -0.005, 0}).out.force), 0);
    loop.step.takeOffBack();
    loop.hold({0, 0.01, 0}, 0.01);
    EXPECT_EQ(loop.at({0, 0.01, 0}).state, ServoState::Ramping);
  }
}

TEST(Safety, AClutchedHandFeelsNothingAndIsArmedAnew) {  // 5
  Loop loop({.gain = 1, .clutchButtons = 2});
  loop.arm();
  loop.lead({0, 0.005, 0}, {0, -0.005, 0});
  HandSample hand = handAt({0, -0.005, 0});
  hand.buttons = 2;
  for (int k = 0; k < 60; ++k) loop.with(hand);
  hand.tip.carry = {0.3, -0.2, 0};  // led elsewhere, as far as it likes
  ServoTick tick = loop.with(hand);
  EXPECT_EQ(length(tick.out.force), 0);
  EXPECT_EQ(tick.fault, ServoFault::Clutch);
  hand.buttons = 0;
  tick = loop.with(hand);
  EXPECT_EQ(tick.state, ServoState::Waiting);
}

}  // namespace
}  // namespace karinui
