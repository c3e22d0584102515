// The whole way: a simulated hand, the simulated Inverse3 service, its WebSocket, the adapter, the force loop's thread,
// pointer samples, the session, the document.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "haptics/operations.h"
#include "karinui/devices/inverse3.h"
#include "karinui/devices/simulated_inverse3.h"
#include "karinui/haptics/haptic_driver.h"
#include "soak.h"

namespace karinui {
namespace {

// The service's axes: right, away, up.
Vec3 theirs(Vec3 v) { return {v.x, -v.z, v.y}; }

// A person with an Inverse3. The hand's clock is that of the service: a millisecond a message.
class Person {
 public:
  Person(Session& session, Vec3 start, double longestPause = 1e9)
      : session_(session), service_([this](double) { return aimed(); }, true, kHand) {
    aim(start);
    // A busy machine is not what is tested here: loop, adapter and pointer have tests of their own for that.
    constexpr double kPatient = 60;  // seconds
    auto device = Inverse3::connect(service_.port(), kPatient);
    if (!device) throw std::runtime_error(text(device.error().what));
    HapticSettings settings;
    settings.servo.rampSeconds = 0.2;
    settings.servo.latest = settings.servo.stalest = 1e9;
    settings.servo.fastest = settings.servo.farthestJump = 1e9;
    settings.longestPause = longestPause;
    driver.emplace(*std::move(device), settings);
  }

  // Some milliseconds of the hand's clock.
  void wait(int milliseconds) {
    const auto then = service_.seen().messages + static_cast<std::uint64_t>(milliseconds);
    ASSERT_TRUE(service_.wait([then](const auto& seen) { return seen.messages >= then; })) << "the loop has ended";
    driver->update(session_, {0, 0, 1});
    session_.update();
    const ServoTick tick = driver->last();
    most = std::max(most, length(tick.out.force));
    if (down_) held = std::max(held, length(tick.out.force));
  }
  void armed() {
    for (int k = 0; k < 4000 && driver->last().state != ServoState::Armed; ++k) wait(5);
    ASSERT_EQ(driver->last().state, ServoState::Armed);
  }
  void go(Vec3 to, bool exactly) {
    constexpr double kStride = 0.15 * 0.005;  // metres in 5 ms
    const Vec3 from = toScene(aimed());
    const int steps = std::max(1, static_cast<int>(distance(from, to) / kStride));
    for (int k = 1; k <= steps; ++k) {
      aim(lerp(from, to, static_cast<double>(k) / steps));
      wait(5);
    }
    int there = 0;
    for (int k = 0; exactly && k < 2000 && there < 10; ++k) {
      const Vec3 left = to - driver->last().hand.tip.carry;
      aim(toScene(aimed()) + left * 0.02);
      there = length(left) < 1e-5 ? there + 1 : 0;
      wait(5);
    }
  }
  void press(bool down) {
    SimulatedInverse3::Grip grip;
    grip.buttons = down ? 1 : 0;
    service_.setGrip(grip);
    while (driver->down() != down) wait(1);
    down_ = down;
    wait(20);
  }
  // The hand goes on, the session stands still: its window is being drawn.
  void goAlone(Vec3 to) {
    const Vec3 from = toScene(aimed());
    for (int k = 1; k <= 400; ++k) {
      aim(lerp(from, to, k / 400.0));
      const auto then = service_.seen().messages + 5;
      ASSERT_TRUE(service_.wait([then](const auto& seen) { return seen.messages >= then; }));
    }
  }
  SimulatedInverse3& service() { return service_; }
  double most = 0, held = 0;  // N, in all and while the button was down
  std::optional<HapticDriver> driver;

 private:
  static constexpr HandModel kHand{0.2, 300, 8};
  static Vec3 toScene(Vec3 v) { return {v.x, v.z, -v.y}; }
  Vec3 aimed() const { return aim_.read(); }
  void aim(Vec3 scene) { aim_.write(theirs(scene)); }

  Session& session_;
  SeqLock<Vec3> aim_;  // the service's axes
  bool down_ = false;
  SimulatedInverse3 service_;  // its thread reads the aim
};

TEST(Service, EveryOperationEndsInTheDocumentThatItsScriptMakes) {
  const auto bodies = std::make_shared<Bodies>();
  for (const StylusWork& work : sixOperations()) {
    SCOPED_TRACE(work.name);
    // In real time, and alone on the machine: by the virtual hand all six are done every time.
    if (!atLength() && work.tool != Command::Draw && work.tool != Command::Pull) continue;
    Session session(cheapSession(bodies));
    give(session, work.given);
    Person person(session, work.start(session));
    session.command(work.tool);
    person.armed();
    work.work(
        session, [&](Vec3 to) { person.go(to, work.exact()); }, [&](bool down) { person.press(down); });
    session.finish();
    for (const Notice& notice : session.takeNotices())
      EXPECT_NE(notice.kind, Notice::Kind::Refused) << text(notice.what);
    ASSERT_EQ(session.steps().size(), work.given.size() + 1);
    EXPECT_THAT(text(session.steps().back().operation), testing::StartsWith(work.expected));
    EXPECT_EQ(hash(session.snapshot().document), hashByScript(session));
    if (work.tool == Command::Reshape) {
      EXPECT_EQ(person.held, 0);
    } else if (work.tool != Command::Sew) {  // its click is felt for 40 ms, and may lie between two looks
      EXPECT_GT(person.held, 0.1);
    }
    EXPECT_LE(person.service().seen().mostForce, 3);
    EXPECT_FALSE(person.service().seen().wrong);
    EXPECT_EQ(person.driver->servo().report().dropped, 0u);
    person.driver.reset();
    EXPECT_TRUE(person.service().wait([](const auto& seen) { return seen.lastForce == 0; })) << "the last it is told";
  }
}

// A service that hangs up in mid-drag: what was begun is dropped, nothing is done.
TEST(Service, ALostDeviceDropsTheGesture) {
  Session session(cheapSession(std::make_shared<Bodies>()));
  give(session, twoPieces());
  Person person(session, {0.2, 0.25, 0.03});
  session.command(Command::Move);
  person.armed();
  person.go({0.2, 0.25, 0.004}, true);
  person.press(true);
  person.go({0.2, 0.25, 0.1}, false);
  ASSERT_TRUE(session.begun());
  person.service().hangUp();
  while (person.driver->last().hand.ready) std::this_thread::yield();
  person.driver->update(session, {0, 0, 1});
  EXPECT_FALSE(session.begun());
  session.finish();
  EXPECT_EQ(session.steps().size(), 2u);
  while (length(person.driver->last().out.force) > 0) std::this_thread::yield();
}

// While the session is busy, with drawing say, the hand feels on what was last shown, also far from where it was then;
// where it does not come back the force fades.
TEST(Service, ASlowWindowIsNotFelt) {
  for (const double longestPause : {1e9, 0.05}) {
    SCOPED_TRACE(longestPause);
    Session session(cheapSession(std::make_shared<Bodies>()));
    give(session, twoPieces());
    Person person(session, {0.05, 0.25, 0.01}, longestPause);
    person.armed();
    person.goAlone({0.3, 0.25, 0.01});
    person.goAlone({0.3, 0.25, -0.01});
    person.goAlone({0.31, 0.25, -0.01});
    const ServoTick tick = person.driver->last();
    if (longestPause > 1) {
      EXPECT_TRUE(tick.touching && tick.known);
      EXPECT_GT(tick.out.force.z, 0.3);
    } else {
      EXPECT_FALSE(tick.known) << "no scene was published since";
      EXPECT_EQ(length(tick.out.force), 0);
    }
  }
}

// Another pointer has a gesture under way: the stylus waits.
TEST(Service, TheStylusWaitsForAnotherPointer) {
  Session session(cheapSession(std::make_shared<Bodies>()));
  give(session, twoPieces());
  Person person(session, {0.2, 0.25, 0.004});
  session.command(Command::Move);
  person.armed();
  SimulatedInverse3::Grip grip;
  grip.buttons = 1;
  person.service().setGrip(grip);
  while ((person.driver->last().hand.buttons & 1) == 0) std::this_thread::yield();
  for (int k = 0; k < 20; ++k) EXPECT_FALSE(person.driver->update(session, {0, 0, 1}, false));
  EXPECT_FALSE(session.begun());
}

}  // namespace
}  // namespace karinui
