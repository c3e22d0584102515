// A simulated hand before a simulation that is slow, jitters and stalls.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include "karinui/touch/simulated_hand.h"
#include "touch/hand.h"

namespace karinui {
namespace {

struct Rate {
  double hertz = 60;
  double jitter = 0.3;  // share of the period
  double stall = 0;     // seconds, now and then
};

// A hand that goes where `aim` says and feels what a servo makes of the scenes that `sceneAt` gives.
struct Ride {
  DeviceRecord record = touchRecord();
  ServoSettings settings;
  HandModel model;
  Rate rate;
  std::function<Vec3(double)> aim;
  std::function<TouchScene(double, Vec3)> sceneAt;
  Vec3 start;
  double seconds = 6;

  // What is seen meanwhile.
  double most = 0, excess = 0, worst = 0;  // N; N beyond the slew rate limit in a tick; J the hand was given
  std::vector<Vec3> places, forces, proxies;

  void go() {
    ServoStep step(record, settings);
    SimulatedHand hand(start, model);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<std::unique_ptr<TouchScene>> kept;
    const TouchScene* waiting = nullptr;
    double next = 0;
    Vec3 force, place = start;
    for (int k = 0; k < static_cast<int>(seconds / kServoTick); ++k) {
      const double now = k * kServoTick;
      if (now >= next) {  // what it shows is as old as it took to work out
        kept.push_back(std::make_unique<TouchScene>(sceneAt(now, hand.place())));
        kept.back()->published = now;
        waiting = kept.back().get();
        next = now + (1 + rate.jitter * (2 * unit(random) - 1)) / rate.hertz;
        if (rate.stall > 0 && unit(random) < 0.05) next += rate.stall;
      }
      if (waiting && step.mayAdopt(now)) step.adopt(std::exchange(waiting, nullptr), now);
      hand.step(aim(now), force, kServoTick);
      const ServoTick tick = step.tick(handAt(hand.place(), hand.velocity()), now);
      const double way = distance(hand.place(), place);
      const Vec3 change = tick.out.force - force;
      const double slew = dot(change, force) < 0 ? settings.falling : settings.rising;
      excess = std::max(excess, length(change) - slew * kServoTick - settings.gain * record.stiffness * way);
      force = tick.out.force;
      place = hand.place();
      most = std::max(most, length(force));
      worst = std::max(worst, hand.work());
      places.push_back(place);
      forces.push_back(force);
      proxies.push_back(tick.proxy);
    }
  }
};

const std::vector<Rate> kRates{{5, 0.3, 0}, {15, 0.5, 0}, {30, 0.5, 0.15}, {60, 0.3, 0.15}, {120, 0.5, 0.05}};

TEST(SimulatedHand, AFreeRideFeelsNothing) {
  Ride ride;
  ride.start = {0, 0.05, 0};
  ride.aim = [](double t) { return Vec3{0.1 * std::sin(2 * t), 0.05 + 0.03 * std::sin(3 * t), 0.1 * std::cos(t)}; };
  ride.sceneAt = [](double, Vec3) { return floorScene(); };
  ride.go();
  EXPECT_EQ(ride.most, 0);
}

TEST(SimulatedHand, ContactAtEveryRateKeepsTheBounds) {
  for (const Rate& rate : kRates) {
    SCOPED_TRACE(rate.hertz);
    Ride ride;
    ride.settings.gain = 1;
    ride.rate = rate;
    ride.start = {0, 0.03, 0};
    ride.aim = [](double t) {
      return Vec3{0.05 * std::sin(t), t < 2 ? 0.03 : 0.005 + 0.02 * std::cos(4 * (t - 2)), 0};
    };
    ride.sceneAt = [](double, Vec3) { return floorScene(); };
    ride.go();
    EXPECT_LE(ride.most, 0.8 * 3.3 + 1e-9);
    EXPECT_LE(ride.excess, 1e-9);
    EXPECT_LE(ride.worst, 1e-3);
    if (rate.hertz > 15) {
      EXPECT_GT(ride.most, 1);
    }
  }
}

TEST(SimulatedHand, LateTensionAtEveryRateKeepsTheBounds) {
  for (const PullLaw law : {PullLaw::Springs, PullLaw::Curve, PullLaw::Tangent})
    for (const Rate& rate : kRates) {
      SCOPED_TRACE(rate.hertz);
      Ride ride;
      ride.settings.gain = 1;
      ride.settings.laws.pull = law;
      ride.rate = rate;
      ride.aim = [](double t) {
        return t < 2 ? Vec3{} : Vec3{0.04 * std::sin(3 * (t - 2)), 0.03 * std::sin(5 * (t - 2)), 0};
      };
      Vec3 before;
      ride.sceneAt = [&before](double, Vec3 hand) {  // the cloth follows the hand a scene late
        TouchScene scene;
        Grab& grab = scene.grab.emplace();
        const Vec3 anchor = before * 0.3;
        grab.springStiffness = 40;
        grab.neighbours = {{anchor + Vec3{0.03, 0, 0}, 0.03}, {anchor - Vec3{0.03, 0, 0}, 0.03}};
        grab.anchor = anchor;
        grab.curve.places = {{0, 0}, {0.01, 0.1}, {0.03, 2}};
        grab.place = before;
        grab.force = (anchor - before) * 60;
        grab.stiffness = {60, 0, 0, 60, 0, 60};
        before = hand;
        return scene;
      };
      ride.go();
      EXPECT_LE(ride.most, 0.8 * 3.3 + 1e-9);
      EXPECT_LE(ride.excess, 1e-9);
      EXPECT_LE(ride.worst, 4e-3);  // 1 mJ, and what is given back within some ticks of its slew
    }
}

// At the device's limit of stiffness, light hands and heavy ones come to rest on the floor.
TEST(SimulatedHand, ContactIsStableAtTheLimitsOfTheDevice) {
  for (const double mass : {0.1, 0.3, 1.0})
    for (const double damping : {3.0, 8.0})
      for (const auto& [stiffness, most] : {std::pair(400.0, 4.0), std::pair(1000.0, 8.0)}) {
        SCOPED_TRACE(mass);
        Ride ride;
        ride.record.stiffness = stiffness;
        ride.record.damping = most;
        ride.record.force = 8;
        ride.settings.gain = 1;
        ride.model = {mass, 100, damping};
        ride.start = {0, 0.01, 0};
        ride.seconds = 9;
        ride.aim = [](double t) { return Vec3{0, t < 2 ? 0.01 : -0.01, 0}; };
        ride.sceneAt = [stiff = stiffness](double, Vec3) {
          TouchScene scene = floorScene();
          scene.stiffness = stiff;
          return scene;
        };
        ride.go();
        double low = 1, high = -1;  // over the last second
        for (std::size_t k = ride.places.size() - 1000; k < ride.places.size(); ++k)
          low = std::min(low, ride.places[k].y), high = std::max(high, ride.places[k].y);
        EXPECT_LT(high - low, 2e-5);
        EXPECT_NEAR(low, -0.01 * 100 / (100 + stiffness), 5e-5);
      }
}

// A limb: a round bar of many facets, along a given way.
void addBar(TouchScene& scene, Vec3 from, Vec3 to, double radius) {
  const Vec3 along = normalized(to - from);
  const Vec3 u = normalized(cross(along, std::fabs(along.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0})),
             v = cross(along, u);
  constexpr int kRound = 32, kLong = 24;
  const auto at = [&](int i, int j) {
    const double turn = 2 * std::numbers::pi * i / kRound;
    return lerp(from, to, static_cast<double>(j) / kLong) + (u * std::cos(turn) + v * std::sin(turn)) * radius;
  };
  for (int i = 0; i < kRound; ++i)
    for (int j = 0; j < kLong; ++j) {
      add(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

TEST(SimulatedHand, SlidesRoundAnArmAndIntoTheArmpit) {
  // An arm that hangs away from the trunk and meets it at the shoulder.
  TouchScene body;
  const Vec3 shoulder{0.16, 0.3, 0}, wrist{0.34, 0, 0};
  addBar(body, shoulder, wrist, 0.04);
  addBar(body, {0, 0.5, 0}, {0, -0.2, 0}, 0.14);
  body.radius = 10;
  body.friction = 0.2;
  const Vec3 along = normalized(wrist - shoulder), out = normalized(cross(along, {0, 0, 1}));
  const auto awayFromArm = [&](Vec3 p) { return length(cross(along, p - shoulder)); };
  const auto awayFromTrunk = [](Vec3 p) { return std::hypot(p.x, p.z); };

  Ride ride;
  ride.settings.gain = 1;
  ride.seconds = 9;
  const Vec3 middle = lerp(shoulder, wrist, 0.6);
  ride.start = middle + Vec3{0, 0, 1} * 0.06;
  ride.aim = [&](double t) {  // once round the arm, 1 cm below its skin
    if (t < 2) return middle + Vec3{0, 0, 1} * 0.06;
    const double turn = 2 * std::numbers::pi * std::min(1.0, (t - 2) / 6);
    const double radius = std::max(0.03, 0.06 - 0.03 * (t - 2));
    return middle + (Vec3{0, 0, 1} * std::cos(turn) + out * std::sin(turn)) * radius;
  };
  ride.sceneAt = [&](double, Vec3) { return body; };
  ride.go();
  for (std::size_t k = 3500; k < 8000; ++k) {
    EXPECT_NEAR(awayFromArm(ride.proxies[k]), 0.04, 4e-4) << k;
    EXPECT_GT(length(ride.forces[k]), 0.3) << k;
  }
  EXPECT_LE(ride.excess, 1e-9);

  // Up along the inside of the arm until the trunk holds it too.
  Ride armpit = ride;
  armpit.places.clear(), armpit.forces.clear(), armpit.proxies.clear();
  const Vec3 inside = Vec3{0.19, 0.06, 0}, pit{0.15, 0.26, 0};
  armpit.start = inside;
  armpit.aim = [&](double t) { return t < 2 ? inside : lerp(inside, pit, std::min(1.0, (t - 2) / 4)); };
  armpit.go();
  const Vec3 rest = armpit.proxies.back();
  EXPECT_NEAR(awayFromArm(rest), 0.04, 5e-4);
  EXPECT_NEAR(awayFromTrunk(rest), 0.14, 2e-3);  // a bar of 32 sides
  EXPECT_LT(distance(armpit.places[8999], armpit.places[8500]), 2e-4);
  for (const Vec3 p : armpit.proxies) {
    EXPECT_GT(awayFromArm(p), 0.0395);
    EXPECT_GT(awayFromTrunk(p), 0.139);
  }
}

}  // namespace
}  // namespace karinui
