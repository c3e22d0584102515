// A simulated hand works at a session by a virtual clock: what it feels, and what comes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "haptics/force_plot.h"
#include "haptics/operations.h"
#include "haptics/virtual_stylus.h"
#include "karinui/base/file.h"
#include "karinui/session/touch_scene_of.h"
#include "karinui/touch/evaluate.h"
#include "karinui/touch/force_law.h"

namespace karinui {
namespace {

const std::shared_ptr<Bodies>& bodies() {
  static const auto all = std::make_shared<Bodies>();
  return all;
}

struct Came {
  std::string step, hash, byScript;
  std::vector<std::string> refused;
};

Came played(const StylusWork& work, VirtualStylus& stylus, Session& session, bool exact) {
  session.command(work.tool);
  stylus.wait(2.2);  // armed
  const auto go = [&](Vec3 to) {
    stylus.go(to);
    if (exact) stylus.arrive(to);
  };
  work.work(session, go, [&](bool down) { stylus.press(down); });
  stylus.wait(0.3);
  session.finish();
  Came came;
  if (session.steps().size() > work.given.size()) came.step = text(session.steps().back().operation);
  came.hash = hash(session.snapshot().document);
  came.byScript = hashByScript(session);
  for (const Notice& notice : session.takeNotices())
    if (notice.kind == Notice::Kind::Refused) came.refused.push_back(text(notice.what));
  return came;
}

TEST(VirtualStylus, EveryOperationIsDoneAndFelt) {
  std::vector<ForcePlot> plots;
  for (const StylusWork& work : sixOperations()) {
    SCOPED_TRACE(work.name);
    Session session(cheapSession(bodies()));
    give(session, work.given);
    ASSERT_EQ(session.steps().size(), work.given.size());
    VirtualStylus stylus(session, work.start(session));
    const Came came = played(work, stylus, session, work.exact());
    EXPECT_THAT(came.refused, testing::IsEmpty());
    EXPECT_THAT(came.step, testing::StartsWith(work.expected));
    EXPECT_EQ(came.hash, came.byScript);
    EXPECT_LE(stylus.excess, 1e-9);
    double held = 0, last = 0;  // N while the button is down: at most, and before it is let go
    ForcePlot plot{work.name, {}};
    const double begins = 2.2;  // armed
    for (const auto& moment : stylus.moments) {
      if (moment.down) last = length(moment.force);
      if (moment.down) held = std::max(held, length(moment.force));
      if (moment.seconds >= begins) plot.places.push_back({moment.seconds - begins, length(moment.force), moment.down});
      EXPECT_TRUE(moment.seconds < begins || moment.fault == ServoFault::None) << moment.seconds;
    }
    plots.push_back(std::move(plot));
    // A half of the true force (the gain): skin 2 mm deep; the weight of 0.2 m2 of cotton; a click; 0.4 N of scissors
    // and the cloth 2 mm deep; 10 mm of cloth pulled; nothing.
    const double pulled = 0.5 * tension(tensionCurveOf(*preset("cotton"), 0.02, 0.10), 0.01, kCouplingShare * 400);
    const double cloth = 0.5 * 400 * 0.002, weight = 0.5 * 0.1925 * 0.15 * 9.81;
    const std::map<std::string, std::pair<double, double>> felt{{"draw", {cloth, 0.1}},
                                                                {"move", {weight, 0.02}},
                                                                {"sew", {0.5 * kClickForce, 0.02}},
                                                                {"cut", {std::hypot(cloth, 0.5 * 0.4), 0.1}},
                                                                {"pull", {pulled, 0.1 * pulled}},
                                                                {"reshape", {0, 0}}};
    EXPECT_NEAR(work.name == "pull" ? last : held, felt.at(work.name).first, felt.at(work.name).second);
  }
  keepPlots(plots);
}

// Energy, force and slew, however slow and uneven the session is.
TEST(VirtualStylus, SlowAndStallingSessionsKeepTheBounds) {
  const std::vector<SessionRate> rates{
      {5, 0.3, 0}, {15, 0.5, 0.15}, {30, 0.5, 0.15}, {60, 0.3, 0.15}, {120, 0.5, 0.05}};
  for (const StylusWork& work : sixOperations())
    for (const SessionRate& rate : rates) {
      SCOPED_TRACE(work.name + " at " + std::to_string(rate.hertz));
      Session session(cheapSession(bodies()));
      give(session, work.given);
      ServoSettings settings;
      settings.gain = 1;
      VirtualStylus stylus(session, work.start(session), settings, rate);
      const Came came = played(work, stylus, session, false);
      EXPECT_EQ(came.hash, came.byScript);
      EXPECT_LE(stylus.most, 0.8 * 3.3 + 1e-9);
      EXPECT_LE(stylus.excess, 1e-9);
      EXPECT_LE(stylus.work, 4e-3);  // 1 mJ, and what is given back within some ticks of its slew
    }
}

TEST(VirtualStylus, AFreeRideInTheRoomFeelsNothing) {
  Session session(cheapSession(bodies()));
  give(session, {"body size=jis9ar"});
  give(session, twoPieces());
  VirtualStylus stylus(session, {0.6, 1.2, 0.6});
  stylus.wait(2);
  for (const Vec3 to : {Vec3{0.6, 1.0, 0.3},
                        {0.2, 1.0, 0.35},
                        onFront(session, 0, -0.04),
                        onFront(session, 2, -0.03),
                        onFront(session, 2, -0.2),
                        {0.36, 0.4, 0.2},
                        {0.36, 0.25, 0.03},
                        {0.36, 0.1, 0.03}})
    stylus.go(to, 0.4);
  EXPECT_EQ(stylus.most, 0);
  EXPECT_GT(stylus.facets, 0u) << "something was near";
  EXPECT_EQ(stylus.moments.back().fault, ServoFault::None);
}

// Whether a place is on the outer side of the skin, and how far from it.
double outside(const Body& body, Vec3 place) {
  const auto near = body.bvh().nearest(place);
  const Vec3 normal = faceNormal(body.mesh(), near->place.face);
  return dot(place - near->point, normal) >= 0 ? near->distance : -near->distance;
}

TEST(VirtualStylus, SlidesRoundTheArmOfTheMannequinAndIntoItsArmpit) {
  Session session(cheapSession(bodies()));
  give(session, {"body size=jis9ar"});
  const Body& body = *session.snapshot().body;
  const auto place = [&](const char* name) { return at(body.mesh(), *body.find(*parseBodyPoint(name))); };
  // The arm between armpit and elbow, from its four sides.
  const Vec3 a = place("left_arm:armpit+0.8@0"), b = place("left_arm:armpit+0.8@0.5"), middle = lerp(a, b, 0.5),
             below = lerp(place("left_arm:elbow@0"), place("left_arm:elbow@0.5"), 0.5);
  const Vec3 along = normalized(below - middle), u = normalized(a - middle - along * dot(a - middle, along)),
             v = cross(along, u);
  const double radius = distance(a, b) / 2;
  ServoSettings settings;
  settings.gain = 1;
  VirtualStylus stylus(session, middle + u * (radius + 0.03), settings, {60, 0.3, 0});
  stylus.wait(2);
  stylus.go(middle + u * (radius - 0.012));
  const std::size_t begins = stylus.moments.size();
  for (int k = 0; k <= 72; ++k) {
    const double turn = 2 * std::numbers::pi * k / 72;
    stylus.go(middle + (u * std::cos(turn) + v * std::sin(turn)) * (radius - 0.012), 0.1);
  }
  double nearest = 1, furthest = 0, least = 1e9;
  for (std::size_t k = begins; k < stylus.moments.size(); ++k) {
    const auto& moment = stylus.moments[k];
    const double away = outside(body, moment.proxy);
    nearest = std::min(nearest, away), furthest = std::max(furthest, away);
    least = std::min(least, length(moment.force));
  }
  EXPECT_GT(nearest, -1e-6) << "never within the arm";
  EXPECT_LT(furthest, 1e-3) << "never away from it";
  EXPECT_GT(least, 0.2) << "and felt all the way";
  EXPECT_LE(stylus.excess, 1e-9);

  // From below up between arm and trunk until both hold it.
  const Vec3 pit = body.landmarks().at("armpit_left");
  VirtualStylus up(session, pit + Vec3{0.01, -0.12, 0}, settings, {60, 0.3, 0});
  up.wait(2);
  up.go(pit + Vec3{-0.01, 0.02, 0}, 0.1);
  up.wait(1.5);
  for (const auto& moment : up.moments) {
    if (moment.seconds < 0.5) continue;
    EXPECT_GT(outside(body, moment.proxy), -1e-6) << moment.seconds;
  }
  EXPECT_GT(length(up.moments.back().force), 0.3);
  const auto& last = up.moments.back();
  const auto& before = up.moments[up.moments.size() - 300];
  EXPECT_LT(distance(last.tip, before.tip), 1e-4) << "at rest there";
}

TEST(VirtualStylus, SkinIsStableAtTheLimitsOfDevices) {
  Session session(cheapSession(bodies()));
  give(session, {"body size=jis9ar"});
  const Vec3 on = onFront(session, 1, 0), out = onFront(session, 1, -0.01) - on;
  for (const double mass : {0.1, 0.3, 1.0})
    for (const auto& [stiffness, damping] : {std::pair(400.0, 4.0), std::pair(1000.0, 8.0)}) {
      SCOPED_TRACE(mass);
      DeviceRecord device = simulatedRecord();
      device.stiffness = stiffness, device.damping = damping, device.force = 8;
      ServoSettings settings;
      settings.gain = 1;
      VirtualStylus stylus(session, on + out, settings, {60, 0.3, 0}, {mass, 100, 5}, device);
      stylus.wait(2);
      stylus.go(on - out);
      stylus.wait(4);
      double most = 0;
      const Vec3 rest = stylus.moments.back().tip;
      for (std::size_t k = stylus.moments.size() - 1000; k < stylus.moments.size(); ++k)
        most = std::max(most, distance(stylus.moments[k].tip, rest));
      EXPECT_LT(most, 2e-5);
      EXPECT_GT(stylus.most, 0.2);
    }
}

// The sleeve of the classic fitting.
TEST(VirtualStylus, APulledSleeveRisesAsTheCurveOfItsFabric) {
  const auto script = readFile(std::filesystem::path(KARINUI_SOURCE_DIR) / "examples/kyoto_fitting.ops");
  ASSERT_TRUE(script);
  const auto lines = parseScript(*script);
  ASSERT_TRUE(lines);
  Session session(cheapSession(bodies()));
  for (const ScriptLine& line : *lines) {
    if (std::holds_alternative<PullCloth>(line.operation)) break;
    if (std::holds_alternative<DrapePieces>(line.operation)) continue;  // as it was drawn on the arm
    session.perform(line.operation);
    session.finish();
  }
  const GarmentSnapshot& fitting = session.snapshot();
  const Piece* sleeve = fitting.document.pieceNamed("sleeve");
  ASSERT_TRUE(sleeve);
  const Fabric fabric = *fabricOf(fitting.document, *sleeve);
  const Vec3 cuff = Stand(*sleeve)({-0.03, 0.05});
  const Vec3 out = normalized(cuff - fitting.body->bvh().nearest(cuff)->point);
  ServoSettings settings;
  settings.gain = 1;
  VirtualStylus stylus(session, cuff + out * 0.05, settings);
  session.command(Command::Pull);
  stylus.wait(2.2);
  stylus.go(cuff + out * 0.004);
  stylus.arrive(cuff + out * 0.004);
  const Vec3 grip = stylus.moments.back().tip;
  stylus.press(true);
  double before = 0, steepness = 0;
  for (const double extension : {0.0003, 0.0006, 0.001, 0.0015, 0.002, 0.003}) {
    stylus.arrive(grip + out * extension);
    const auto& moment = stylus.moments.back();
    const double away = distance(moment.tip, grip), felt = length(moment.force);
    const double law = tension(tensionCurveOf(fabric, 0.02, 0.10), away, 0.7 * 400);
    EXPECT_NEAR(felt, law, 0.02 * law + 2e-3) << extension;
    EXPECT_GT(felt, before) << extension;
    steepness = std::max(steepness, felt / away);
    before = felt;
    EXPECT_LT(dot(normalized(moment.force), out), -0.99) << "towards where it was taken";
  }
  EXPECT_GT(before, 0.05);
  stylus.press(false);
  EXPECT_LE(stylus.excess, 1e-9);
}

}  // namespace
}  // namespace karinui
