#include <dlfcn.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "devices/cap_daemon.h"
#include "devices/json_scan.h"
#include "karinui/devices/hd_stylus.h"
#include "karinui/devices/inverse3.h"
#include "karinui/devices/placement.h"
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"
#include "karinui/devices/simulated_inverse3.h"
#include "karinui/devices/space_mouse.h"
#include "karinui/touch/servo.h"
#include "touch/hand.h"

namespace karinui {
namespace {

// A servo's work without its thread: one scene, tick by tick.
double mostForce(HapticDevice& device, TouchScene scene, int ticks, const ServoSettings& settings = {}) {
  ServoStep step(device.record(), settings);
  scene.published = 1e9;
  step.adopt(&scene, 0);
  double most = 0;
  for (int k = 0; k < ticks; ++k) {
    const ServoTick tick = step.tick(device.sample(), k * 0.001);
    device.apply(tick.out);
    most = std::max(most, length(tick.out.force));
  }
  device.stop();
  return most;
}

TEST(JsonScan, FindsWhatIsThereAndNothingElse) {
  const JsonScan all(R"( {"a": [ {"k": "x\"}", "v": -1.5e2}, 3 ], "b":{"c":true,"d":{}}, "e":"" } )");
  int elements = 0;
  all.member("a")->each([&](const JsonScan& one) {
    if (elements++ == 0) {
      EXPECT_EQ(one.number("v"), -150);
      EXPECT_TRUE(one.member("k")->isString("x\\\"}"));
    } else {
      EXPECT_EQ(one.number(), 3);
    }
    return true;
  });
  EXPECT_EQ(elements, 2);
  EXPECT_TRUE(all.member("b")->flag("c", false));
  EXPECT_FALSE(all.member("c"));
  for (const char* broken : {"", "{", "{\"a\"", "{\"a\":", "{\"a\":}", "{\"a\":[1,{]", "{\"a\" 1}", "]", "{\"x\":\"a"})
    EXPECT_FALSE(JsonScan(broken).member("a")) << broken;
}

TEST(Placement, TurnsScalesAndBringsForcesBack) {
  SimulatedDevice inner([](double) { return Vec3{0.01, 0.02, 0.03}; });
  Placement placement{turnAbout({0, 1, 0}, std::numbers::pi / 2), {0.01, 0, 0}, {1, 1, 1}, 2};
  PlacedDevice placed(inner, placement, 0, DeviceRecord::Hand::Left);
  EXPECT_EQ(placed.record().hand, DeviceRecord::Hand::Left);
  EXPECT_EQ(placed.record().stiffness, 200);
  EXPECT_EQ(placed.record().damping, 2);
  EXPECT_EQ(placed.record().scale, 2);
  const HandSample hand = placed.sample();
  EXPECT_LT(distance(hand.tip.carry, {1 + 2 * 0.03, 1 + 2 * 0.02, 1}), 1e-9);
  // A push along the scene's x is one along the device's -z... and moves the hand there.
  const Vec3 before = inner.hand().place();
  for (int k = 0; k < 50; ++k) placed.apply({{1, 0, 0}, {}, 0}), placed.sample();
  const Vec3 moved = inner.hand().place() - before;
  EXPECT_GT(moved.z, 1e-4);
  EXPECT_NEAR(moved.x, 0, 1e-9);
  EXPECT_LT(distance(Placement{}.broughtTo({1, 2, 3}, {4, 5, 6}).toScene({1, 2, 3}), {4, 5, 6}), 1e-12);
}

TEST(Placement, AClutchLeadsTheDeviceElsewhere) {
  double x = 0;
  PoseSource inner(shownRecord("pose"));
  PlacedDevice placed(inner, {}, 2);
  const auto at = [&](double to, std::uint32_t buttons) {
    HandSample hand;
    inner.place({1, 0, 0, 0, {x = to, 0, 0}}, buttons);
    for (int k = 0; k < 500; ++k) hand = placed.sample();
    return hand;
  };
  EXPECT_NEAR(at(0.05, 0).tip.carry.x, 0.05, 1e-6);
  EXPECT_NEAR(at(-0.05, 2).tip.carry.x, 0.05, 1e-3) << "held while the button is down";
  EXPECT_NEAR(at(0.05, 0).tip.carry.x, 0.15, 2e-3) << "and goes on from there";
}

TEST(Placement, IsCalibratedTurnedAndTellsHowFarItIsLed) {
  PoseSource inner(shownRecord("pose"));
  PlacedDevice placed(inner, {{}, {}, {}, 2}, 2);
  const auto at = [&](Vec3 to, std::uint32_t buttons) {
    HandSample hand;
    inner.place({1, 0, 0, 0, to}, buttons);
    for (int k = 0; k < 500; ++k) hand = placed.sample();
    return hand;
  };
  EXPECT_LT(distance(at({0.05, 0, 0}, 0).tip.carry, {0.1, 0, 0}), 1e-6);
  placed.bringTo({1, 2, 3});
  EXPECT_LT(distance(placed.sample().tip.carry, {1, 2, 3}), 1e-6) << "wherever the device is";
  EXPECT_LT(distance(at({0.05, 0, 0.01}, 0).tip.carry, {1, 2, 3.02}), 1e-6);
  // Turned to the side: the tip stays, what follows goes another way.
  placed.turnTo(turnAbout({0, 1, 0}, std::numbers::pi / 2));
  EXPECT_LT(distance(placed.sample().tip.carry, {1, 2, 3.02}), 1e-6);
  EXPECT_LT(distance(at({0.06, 0, 0.01}, 0).tip.carry, {1, 2, 3}), 1e-6);
  // Led while the clutch is down.
  const HandSample before = at({0.06, 0, 0.01}, 2);
  const HandSample led = at({0.06, 0.03, 0.01}, 2);
  EXPECT_EQ(led.tip.carry, before.tip.carry);
  EXPECT_LT(distance(led.led - before.led, {0, 0.06, 0}), 1e-6);
  at({0.06, 0.03, 0.01}, 0);
  placed.place({{}, {}, {9, 9, 9}, 5});
  EXPECT_LT(distance(at({0.01, 0, 0}, 0).tip.carry, {9.02, 9, 9}), 1e-6) << "the scale stays";
}

TEST(PoseSource, AMouseIsFeltAsAnArrow) {
  PoseSource mouse(shownRecord("mouse"));
  EXPECT_EQ(mouse.record().freedomOut, 0);
  EXPECT_FALSE(mouse.sample().ready);
  ServoStep step(mouse.record());
  TouchScene scene = floorScene();
  scene.published = 1e9;
  step.adopt(&scene, 0);
  double most = 0;
  for (int k = 0; k < 4000; ++k) {
    // A mouse tells a place every 16 ms, and leaps.
    if (k % 16 == 0) mouse.place({1, 0, 0, 0, {k < 3000 ? 0 : 0.05, k < 2500 ? 0.03 : -0.006, 0}}, 1);
    const ServoTick tick = step.tick(mouse.sample(), k * 0.001);
    if (k > 100) {
      EXPECT_EQ(tick.fault, ServoFault::None) << k;
    }
    mouse.apply(tick.out);
    most = std::max(most, length(mouse.force().force));
  }
  EXPECT_NEAR(most, 0.5 * 400 * 0.006, 0.2);
  mouse.leave();
  EXPECT_FALSE(mouse.sample().ready);
}

TEST(ScriptedDevice, PlaysARecordedHand) {
  std::string lines = "# a hand\ntool move\nhover space 0 0 0 0 0 0 -1 0 0 1 reach 0.01\n";
  PointerSample sample;
  for (const auto& [seconds, y] :
       {std::pair(0.0, 0.01), std::pair(2.0, 0.01), std::pair(3.0, -0.005), std::pair(3.5, -0.005)}) {
    sample.seconds = seconds;
    sample.phase = seconds < 3 ? PointerSample::Phase::Hover : PointerSample::Phase::Drag;
    sample.tip = Rigid{1, 0, 0, 0, {0, y, 0}};
    lines += text(sample) + "\r\n";
  }
  auto device = ScriptedDevice::read(lines, simulatedRecord());
  ASSERT_TRUE(device);
  EXPECT_EQ(device->ends(), 3.5);
  auto again = *device;
  for (int k = 0; k < 2501; ++k) again.sample();
  EXPECT_NEAR(again.sample().tip.carry.y, 0.01 - 0.015 * 0.501, 1e-9);
  EXPECT_EQ(again.sample().buttons, 0u);
  for (int k = 0; k < 600; ++k) again.sample();
  EXPECT_EQ(again.sample().buttons, 1u);
  EXPECT_NEAR(mostForce(*device, floorScene(), 3500), 0.5 * 400 * 0.005, 0.01);
  for (const char* bad : {"", "hover space 0 0 0 0 0 0 -1 0 0 1 reach 0.01", "press space x tip 1 2",
                          "hover space 1 0 0 0 0 0 -1 0 0 1 reach 0 tip 0 0 0 1 0 0 0\n"
                          "hover space 0 0 0 0 0 0 -1 0 0 1 reach 0 tip 0 0 0 1 0 0 0",
                          "hover space 0 0 0 0 0 0 -1 0 0 1 reach 0 tip 0 0 0 0 0 0 0",
                          "hover space 0 0 0 0 0 0 -1 0 0 1 reach 0 tip 0 0 0 1 0 0 0\n"
                          "hover space 1e300 0 0 0 0 0 -1 0 0 1 reach 0 tip 0 0 0 1 0 0 0"})
    EXPECT_FALSE(ScriptedDevice::read(bad, simulatedRecord())) << bad;
}

// --- Inverse3, before a service on the loopback interface.

TEST(Inverse3, SpeaksAsTheServiceIsDocumented) {
  SimulatedInverse3 service([](double) { return Vec3{0.01, 0.02, 0.03}; });
  service.setGrip({0.6, 0, 0, 0.8, 5, 0.25});
  auto device = Inverse3::connect(service.port());
  ASSERT_TRUE(device) << text(device.error().what);
  EXPECT_EQ((*device)->record().name, "Haply Inverse3 04AB");
  EXPECT_EQ((*device)->record().hand, DeviceRecord::Hand::Left);
  EXPECT_EQ((*device)->record().freedomIn, 6);
  for (int k = 0; k < 100; ++k) {
    const HandSample hand = (*device)->sample();
    EXPECT_TRUE(hand.ready);
    EXPECT_LT(distance(hand.tip.carry, {0.01, 0.03, -0.02}), 0.02) << "right, up, towards the user";
    EXPECT_EQ(hand.buttons, 5u);
    EXPECT_EQ(hand.trigger, 0.25);
    EXPECT_EQ(hand.tip.w, 0.6);
    EXPECT_EQ(hand.tip.y, 0.8);
    (*device)->apply({{0, 0.5, 0}, {}, 0});
  }
  EXPECT_GT((*device)->sample().tip.carry.y, 0.0301) << "pushed up";
  (*device)->apply({});
  (*device)->sample();
  EXPECT_LE(service.seen().messages, 102u) << "one for each tick; none while a reply is missing";
  EXPECT_GT(service.seen().messages, 20u);
  EXPECT_FALSE(service.seen().wrong);
  (*device)->apply({{0, 2, 0}, {}, 0});
  (*device)->stop();
  EXPECT_TRUE(service.wait([](const auto& seen) { return seen.lastForce == 0; })) << "the last thing it is told";
  EXPECT_FALSE((*device)->sample().ready);
}

// Qt takes over the person's locale, in which printf may write a comma.
TEST(Inverse3, IsSentNumbersWithAPointWhereThePersonWritesAComma) {
  const auto folder = std::filesystem::temp_directory_path() / ("karinui_locale_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const int made = std::system(("localedef -i de_DE -f UTF-8 '" + (folder / "de_DE.UTF-8").string() + "' >&2").c_str());
  ::setenv("LOCPATH", folder.c_str(), 1);
  const bool comma = made == 0 && std::setlocale(LC_NUMERIC, "de_DE.UTF-8") != nullptr;
  ::unsetenv("LOCPATH");
  std::filesystem::remove_all(folder);
  if (!comma) GTEST_SKIP() << "no locale with a decimal comma can be made here";
  SimulatedInverse3 service([](double) { return Vec3{0.01, 0.02, 0.03}; });
  auto device = Inverse3::connect(service.port());
  ASSERT_TRUE(device);
  for (int k = 0; k < 1000 && !service.seen().wrong && service.seen().lastForce != 0.5; ++k) {
    (*device)->sample();
    (*device)->apply({{0, 0.5, 0}, {}, 0});
  }
  std::setlocale(LC_NUMERIC, "C");
  EXPECT_FALSE(service.seen().wrong);
  EXPECT_EQ(service.seen().lastForce, 0.5);
}

TEST(Inverse3, AServiceThatIsNotThereIsSaid) {
  EXPECT_FALSE(Inverse3::connect(1));
  SimulatedInverse3 empty([](double) { return Vec3{}; }, false);
  const auto none = Inverse3::connect(empty.port());
  ASSERT_FALSE(none);
  EXPECT_NE(text(none.error().what).find("plugged in"), std::string::npos);
}

TEST(Inverse3, SilenceHangingUpAndNoCalibrationAreNotReady) {
  for (const int trouble : {0, 1, 2}) {
    SimulatedInverse3 service([](double) { return Vec3{}; });
    auto device = Inverse3::connect(service.port());
    ASSERT_TRUE(device);
    EXPECT_TRUE((*device)->sample().ready);
    if (trouble == 0) service.fallSilent();
    if (trouble == 1) service.hangUp();
    if (trouble == 2) service.setCalibrated(false);
    bool ready = true;
    for (int k = 0; k < 20; ++k) {
      (*device)->apply({});
      ready = (*device)->sample().ready;
    }
    EXPECT_FALSE(ready) << trouble;
    (*device)->stop();
  }
  // As long as it is told to wait for a reply it does.
  SimulatedInverse3 service([](double) { return Vec3{}; });
  auto patient = Inverse3::connect(service.port(), 60);
  ASSERT_TRUE(patient);
  service.fallSilent();
  for (int k = 0; k < 20; ++k) {
    (*patient)->apply({});
    EXPECT_TRUE((*patient)->sample().ready);
  }
  (*patient)->stop();
}

// The whole way: hand, device, WebSocket, servo's thread, proxy, and back into the hand.
TEST(Inverse3, AHandFeelsAFloorThroughTheService) {
  // Up, which is z there, and down to 1 cm below the floor, again and again: a service that does not get to answer for
  // a while on a busy machine is a device that is not ready, and is armed anew.
  SimulatedInverse3 service([](double t) { return Vec3{0, 0, std::fmod(t, 2) < 1 ? 0.05 : 0.03}; });
  auto device = Inverse3::connect(service.port());
  ASSERT_TRUE(device);
  ServoSettings settings;
  settings.rampSeconds = 0.2;
  settings.latest = 1e9;  // a busy machine is not what is tested here
  {
    Servo servo(**device, settings);
    TouchScene scene = floorScene();
    for (Facet& facet : scene.facets)
      facet = *facetOf(facet.corner[0] + Vec3{0, 0.04, 0}, facet.corner[1] + Vec3{0, 0.04, 0},
                       facet.corner[2] + Vec3{0, 0.04, 0}, false);
    // The hand's spring of 300 N/m draws it to 1 cm below the floor, whose spring is half of that of the device.
    const double wanted = 0.01 * 300 * 200 / 500;
    ServoTick tick;
    const auto felt = [&] { return tick.touching && std::fabs(tick.out.force.y - wanted) < 0.15 * wanted; };
    while (service.seen().messages < 60000 && !felt()) {
      servo.publish(std::make_unique<TouchScene>(scene));
      const auto then = service.seen().messages + 5;  // as many ticks of the force loop
      service.wait([then](const auto& seen) { return seen.messages >= then; });
      tick = servo.last();
    }
    EXPECT_TRUE(tick.touching);
    EXPECT_NEAR(tick.proxy.y, 0.04, 1e-3);
    EXPECT_NEAR(tick.out.force.y, wanted, 0.15 * wanted);
  }
  EXPECT_TRUE(service.wait([](const auto& seen) { return seen.lastForce == 0; })) << "the last thing it is told";
  EXPECT_LE(service.seen().mostForce, 3);
  EXPECT_LE(service.seen().work, 1e-3);
  EXPECT_FALSE(service.seen().wrong);
}

// Both hands at one service: each its own device and grip.
TEST(Inverse3, TheSecondOneIsForTheOtherHand) {
  SimulatedInverse3 service([](double) { return Vec3{0.01, 0.02, 0.03}; });
  service.setGrip({0.6, 0, 0, 0.8, 5, 0.25});
  const auto second = Inverse3::connect(service.port(), Inverse3::kPatience, 1);
  ASSERT_TRUE(second) << text(second.error().what);
  EXPECT_EQ((*second)->record().name, "Haply Inverse3 FFFF");
  const HandSample hand = (*second)->sample();
  EXPECT_TRUE(hand.ready);
  EXPECT_LT(distance(hand.tip.carry, {9, 9, -9}), 1e-9);
  EXPECT_EQ(hand.buttons, 0u) << "the grip is the first one's";
  (*second)->stop();
  EXPECT_FALSE(service.seen().wrong);
  const auto third = Inverse3::connect(service.port(), Inverse3::kPatience, 2);
  ASSERT_FALSE(third);
  EXPECT_NE(text(third.error().what).find("no second Inverse3"), std::string::npos);
}

// --- SpaceMouse, before a daemon of ours.

TEST(SpaceMouse, IsADeviceWithoutAMotorWhoseTipGoesOnWhileItIsPushed) {
#ifndef KARINUI_SPNAV
  EXPECT_FALSE(SpaceMouse::open());
  GTEST_SKIP() << "built without libspnav";
#endif
  const auto path = std::filesystem::temp_directory_path() / ("karinui_cap_" + std::to_string(getpid()));
  std::filesystem::remove(path);
  setenv("SPNAV_SOCKET", (path.string() + "_nobody").c_str(), 1);
  const auto none = SpaceMouse::open();
  ASSERT_FALSE(none);
  EXPECT_NE(text(none.error().what).find("spacenavd"), std::string::npos);
  CapDaemon daemon(path);
  setenv("SPNAV_SOCKET", path.c_str(), 1);
  auto cap = SpaceMouse::open();
  unsetenv("SPNAV_SOCKET");
  ASSERT_TRUE(cap) << text(cap.error().what);
  EXPECT_TRUE(SpaceMouse::taken());
  EXPECT_FALSE(SpaceMouse::open()) << "one in a program";
  daemon.accept();
  EXPECT_EQ((*cap)->record().freedomIn, 6);
  EXPECT_EQ((*cap)->record().freedomOut, 0);
  EXPECT_EQ((*cap)->record().force, 0);
  EXPECT_TRUE((*cap)->sample().ready);
  // Half as far as it goes to the right for 40 ms, then all the way up.
  daemon.push(175, 0, 0, 0, 0, 40);
  HandSample hand = (*cap)->sample();
  EXPECT_LT(distance(hand.tip.carry, {0.002, 0, 0}), 1e-12);
  EXPECT_LT(distance(hand.velocity, {0.05, 0, 0}), 1e-12);
  daemon.push(0, 350, 0, 0, 0, 50);
  EXPECT_LT(distance((*cap)->sample().tip.carry, {0.002, 0.005, 0}), 1e-12);
  daemon.push(0, 0, 350, 0, 0, 50);
  EXPECT_LT(distance((*cap)->sample().tip.carry, {0.002, 0.005, -0.005}), 1e-12) << "away is -z";
  daemon.push(0, 0, 0, 0, 350, 50);
  hand = (*cap)->sample();
  EXPECT_LT(distance(hand.tip.turned({0, 0, 1}), {-std::sin(0.05), 0, std::cos(0.05)}), 1e-9);
  EXPECT_EQ(hand.velocity, Vec3{}) << "turned where it is";
  daemon.button(1, true);
  EXPECT_EQ((*cap)->sample().buttons, 2u);
  daemon.button(1, false);
  EXPECT_EQ((*cap)->sample().buttons, 0u);
  // Whatever force it is told, nothing comes of it; the daemon goes, and it is not ready any more.
  (*cap)->apply({{1, 0, 0}, {}, 0});
  EXPECT_LT(distance((*cap)->sample().tip.carry, {0.002, 0.005, -0.005}), 1e-12);
  daemon.hangUp();
  EXPECT_FALSE((*cap)->sample().ready);
  cap = notFound({});
  EXPECT_FALSE(SpaceMouse::taken());
  std::filesystem::remove(path);
}

// --- 3D Systems Touch, before a library of ours.

struct FakeHd {
  void* library = dlopen(KARINUI_FAKE_HD, RTLD_NOW | RTLD_LOCAL);
  template <class F>
  F get(const char* name) {
    return reinterpret_cast<F>(dlsym(library, name));
  }
  std::string calls() { return get<const char* (*)()>("fakeHdCalls")(); }
  int frames() { return get<int (*)()>("fakeHdFrames")(); }
  // The first sample that is ready, or not. A sample read while the scheduler stands in the middle of writing one is
  // the former sample, and it may stand there as long as the machine has other work.
  HandSample sampleThatIs(bool ready, HdStylus& stylus) {
    const int before = frames();
    HandSample hand;
    do {
      hand = stylus.sample();
    } while (hand.ready != ready && frames() < before + 100'000);
    return hand;
  }
  ~FakeHd() { dlclose(library); }
};

TEST(HdStylus, CallsTheLibraryInOrder) {
  FakeHd fake;
  ASSERT_TRUE(fake.library);
  fake.get<void (*)()>("fakeHdReset")();
  {
    auto stylus = HdStylus::open(KARINUI_FAKE_HD);
    ASSERT_TRUE(stylus) << text(stylus.error().what);
    EXPECT_EQ(fake.calls(), "init enable-force schedule start ");
    const DeviceRecord& record = (*stylus)->record();
    EXPECT_EQ(record.name, "Touch (fake)");
    EXPECT_EQ(record.force, 3.3);
    EXPECT_NEAR(record.stiffness, 500, 1e-9);
    EXPECT_NEAR(record.damping, 4, 1e-9);
    EXPECT_NEAR(record.workspace.high.x, 0.08, 1e-12);
    const HandSample hand = fake.sampleThatIs(true, **stylus);
    EXPECT_TRUE(hand.ready);
    EXPECT_LT(distance(hand.tip.carry, {0.01, 0.02, 0.03}), 1e-12);
    EXPECT_LT(distance(hand.tip.turned({0, 0, 1}), {1, 0, 0}), 1e-9);
    EXPECT_LT(distance(hand.velocity, {0.1, 0, -0.05}), 1e-12);
    EXPECT_EQ(hand.buttons, 3u);
    while (fake.get<double (*)()>("fakeHdMostForce")() < 0.7) (*stylus)->apply({{0.75, 0, 0}, {}, 0});
    // A servo that does not come back: its own scheduler takes the force away.
    const int then = fake.frames();
    while (fake.frames() < then + 40) std::this_thread::yield();
    double force[3];
    fake.get<void (*)(double*)>("fakeHdForce")(force);
    EXPECT_EQ(force[0], 0);
    (*stylus)->apply({{0.5, 0, 0}, {}, 0});
    (*stylus)->stop();
    fake.get<void (*)(double*)>("fakeHdForce")(force);
    EXPECT_EQ(force[0], 0) << "nothing is left in the hand";
  }
  EXPECT_EQ(fake.calls(), "init enable-force schedule start stop unschedule disable ");
  EXPECT_FALSE(fake.get<bool (*)()>("fakeHdOutOfFrame")()) << "state is read and written within a frame";
}

TEST(HdStylus, AFaultOfTheLibraryIsNotReady) {
  FakeHd fake;
  fake.get<void (*)()>("fakeHdReset")();
  auto stylus = HdStylus::open(KARINUI_FAKE_HD);
  ASSERT_TRUE(stylus);
  EXPECT_TRUE(fake.sampleThatIs(true, **stylus).ready);
  fake.get<void (*)(unsigned int)>("fakeHdFail")(0x0302);
  EXPECT_FALSE(fake.sampleThatIs(false, **stylus).ready);
}

TEST(HdStylus, WhatIsNotThereIsSaid) {
  EXPECT_FALSE(HdStylus::open("libHD-that-is-not-there.so"));
  FakeHd fake;
  fake.get<void (*)()>("fakeHdReset")();
  fake.get<void (*)(bool)>("fakeHdAbsent")(true);
  const auto none = HdStylus::open(KARINUI_FAKE_HD);
  ASSERT_FALSE(none);
  EXPECT_NE(text(none.error().what).find("plugged in"), std::string::npos);
  EXPECT_EQ(fake.calls(), "init ");
}

}  // namespace
}  // namespace karinui
