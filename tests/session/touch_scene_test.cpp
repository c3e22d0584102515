#include <gtest/gtest.h>

#include <set>

#include "design/workroom.h"
#include "karinui/cloth/fabric.h"
#include "karinui/session/session.h"
#include "karinui/session/touch_scene_of.h"

#include "karinui/body/sizes.h"
#include "karinui/touch/evaluate.h"

namespace karinui {
namespace {

DeviceRecord record() {
  DeviceRecord r;
  r.force = 100, r.stiffness = 1e5, r.damping = 0;
  return r;
}

struct Given {
  Session session;
  Given() {
    const auto lines = parseScript(kTwoPieces);
    for (const ScriptLine& line : *lines) session.perform(line.operation);
    session.finish();
  }
  const GarmentSnapshot& snapshot() { return session.snapshot(); }
  const Piece& front() { return *snapshot().document.pieceNamed("front"); }
};

TEST(TouchScene, RigidClothIsFeltFromBothSidesAndOnlyNear) {
  Given given;
  const Vec3 on = Stand(given.front())({0.2, 0.2});
  const TouchScene scene = touchSceneOf(given.snapshot(), on);
  ASSERT_FALSE(scene.facets.empty());
  for (const Facet& facet : scene.facets) {
    EXPECT_TRUE(facet.twoSided);
    EXPECT_LE(distance(facet.middle, on), kPatchRadius + facet.radius);
  }
  for (const double side : {1.0, -1.0}) {
    TouchEvaluator evaluator;
    evaluator.evaluate(scene, record(), {}, on + Vec3{0, 0, 0.01 * side}, {});
    const auto forces = evaluator.evaluate(scene, record(), {}, on - Vec3{0, 0, 0.005 * side}, {});
    EXPECT_NEAR(forces.contact.z, scene.stiffness * 0.005 * side, 1e-6);
  }
  EXPECT_TRUE(touchSceneOf(given.snapshot(), on + Vec3{0, 0, 0.5}).facets.empty());
}

TEST(TouchScene, ACarriedPieceWeighsWhatItsClothDoes) {
  Given given;
  const Piece& front = given.front();
  Handling handling;
  handling.carried = {front.id};
  const TouchScene scene = touchSceneOf(given.snapshot(), Stand(front)({0.2, 0.2}), handling);
  const Fabric fabric = *fabricOf(given.snapshot().document, front);
  EXPECT_NEAR(scene.carriedMass, front.outline.area() * fabric.weight, 1e-12);
  EXPECT_TRUE(scene.facets.empty()) << "what is carried is not touched";
}

TEST(TouchScene, PulledClothPullsAsTheCurveOfItsFabricRises) {
  Given given;
  const Piece& front = given.front();
  const Fabric fabric = *fabricOf(given.snapshot().document, front);
  Handling handling;
  const Vec3 at = Stand(front)({0.2, 0.2}) + Vec3{0, 0, 0.003};
  handling.pull = Handling::Pull{front.id, {0.2, 0.2}, at, at, {}};
  const TouchScene scene = touchSceneOf(given.snapshot(), at, handling);
  ASSERT_TRUE(scene.grab);
  double before = -1;
  for (const double extension : {0.0, 0.0005, 0.001, 0.003, 0.006, 0.01}) {  // of 10 cm of cloth
    TouchEvaluator evaluator;
    const auto forces = evaluator.evaluate(scene, record(), {}, at + Vec3{0, 0, extension}, {});
    const double law =
        0.02 * (fabric.warpCurve().force(extension / 0.1) + fabric.weftCurve().force(extension / 0.1)) / 2;
    EXPECT_NEAR(-forces.pull.z, law, 0.02 * law + 1e-3) << extension;
    EXPECT_GT(-forces.pull.z, before);
    before = -forces.pull.z;
  }
}

TEST(TouchScene, CuttingResistsAndWhatChangesIsNotFelt) {
  Given given;
  Handling handling;
  handling.cut = given.front().id;
  handling.clicks = 3;
  const Vec3 at = Stand(given.front())({0.2, 0.2});
  EXPECT_GT(touchSceneOf(given.snapshot(), at, handling).cutting, 0.1);
  EXPECT_EQ(touchSceneOf(given.snapshot(), at, handling).clicks, 3u);
  handling.changing = true;
  EXPECT_TRUE(touchSceneOf(given.snapshot(), at, handling).changing);
}

// A tip that is pressed into the body deeper than the patch reaches still has the skin under its proxy.
TEST(TouchScene, HoldsTheSkinThatStopsADeepTip) {
  Workers workers(1);
  const auto body = makeMannequin(*builtInSize("jis9ar"), workers, {});
  ASSERT_TRUE(body);
  const SnapshotPtr bare = snapshotOf({}, *body);
  const auto skin = (*body)->bvh().first({0.1, 0.75, 0.5}, {0, 0, -1});
  ASSERT_TRUE(skin);
  const Vec3 on = Vec3{0.1, 0.75, 0.5 - skin->along};
  std::set<std::vector<double>> under;
  const auto key = [](const Facet& facet) { return std::vector{facet.middle.x, facet.middle.y, facet.middle.z}; };
  for (const Facet& facet : touchSceneOf(*bare, on).facets) under.insert(key(facet));
  ASSERT_GT(under.size(), 20u);
  for (const double depth : {0.01, 0.03, 0.058, 0.062, 0.066, 0.1, 0.2}) {
    const TouchScene scene = touchSceneOf(*bare, on - Vec3{0, 0, depth}, {}, on);
    std::multiset<std::vector<double>> there;
    for (const Facet& facet : scene.facets) there.insert(key(facet));
    for (const auto& facet : under) EXPECT_EQ(there.count(facet), 1u) << depth;
    EXPECT_EQ(there.size(), std::set(there.begin(), there.end()).size()) << "each once";
  }
}

// Pressed through a garment deep into the body and drawn back, a tip comes out where it went in: the cloth does not let
// it through to hold it from the inside. Cloth that hangs free lets go of a hand that is led away.
TEST(TouchScene, ClothOnTheBodyIsNotPokedThrough) {
  Session session;
  for (const char* line :
       {"body size=jis9ar",
        "draw name=front line=\"torso:waist@0.1; torso:bust@0.1; torso:bust@0.9; torso:waist@0.9\""}) {
    session.perform(*parseOperation(line));
    session.finish();
  }
  const GarmentSnapshot& worn = session.snapshot();
  const auto skin = worn.body->bvh().first({0.02, 1.12, 1}, {0, 0, -1});
  ASSERT_TRUE(skin);
  TouchEvaluator evaluator;
  std::optional<Vec3> proxy;
  double deepest = 0;
  const auto feel = [&](double above) {  // the skin
    const Vec3 tip{0.02, 1.12, 1 - skin->along + above};
    const TouchForces forces = evaluator.evaluate(touchSceneOf(worn, tip, {}, proxy), record(), {}, tip, {});
    proxy = forces.touching ? std::optional(forces.proxy) : std::nullopt;
    deepest = std::max(deepest, forces.contact.z);
    return forces.contact.z;
  };
  for (double above = 0.05; above > -0.12; above -= 0.002) feel(above);
  EXPECT_GT(deepest, 40) << "400 N/m and 12 cm";
  for (double above = -0.12; above < 0.05; above += 0.002) EXPECT_GE(feel(above), -1e-9) << above;

  Given given;
  const Vec3 on = Stand(given.front())({0.2, 0.2});
  EXPECT_TRUE(touchSceneOf(given.snapshot(), on + Vec3{0, 0, 0.1}, {}, on).facets.empty());
}

// --- what a session says of the gesture in hand

PointerSample stylus(PointerSample::Phase phase, Vec3 tip, double seconds = 0) {
  PointerSample sample;
  sample.phase = phase;
  sample.seconds = seconds;
  sample.tip.emplace().carry = tip;
  sample.ray = {tip, {0, 0, -1}};
  return sample;
}
using Phase = PointerSample::Phase;

TEST(TouchScene, ASessionTellsWhatTheGestureInHandDoes) {
  Given given;
  Session& session = given.session;
  const PieceId front = given.front().id;
  const Fabric fabric = *fabricOf(given.snapshot().document, given.front());
  const Vec3 on{0.2, 0.2, 0.004};
  EXPECT_FALSE(session.touchSource().sceneAt(on).facets.empty());
  EXPECT_EQ(session.touchSource().sceneAt(on).carriedMass, 0);

  session.command(Command::Move);
  session.feed(stylus(Phase::Press, on));
  session.feed(stylus(Phase::Drag, on + Vec3{0, 0, 0.1}));
  TouchScene scene = session.touchSource().sceneAt(on);
  EXPECT_NEAR(scene.carriedMass, given.front().outline.area() * fabric.weight, 1e-12);
  EXPECT_TRUE(scene.facets.empty()) << "what is carried is not touched";
  session.command(Command::Cancel);
  EXPECT_EQ(session.touchSource().sceneAt(on).carriedMass, 0);

  session.command(Command::Cut);
  session.feed(stylus(Phase::Press, on));
  EXPECT_GT(session.touchSource().sceneAt(on).cutting, 0.1);
  EXPECT_FALSE(session.touchSource().sceneAt(on).facets.empty()) << "cloth that is cut is touched";
  session.command(Command::Cancel);

  session.command(Command::Reshape);
  session.feed(stylus(Phase::Press, on));
  EXPECT_TRUE(session.touchSource().sceneAt(on).facets.empty()) << "reshaping is not felt";
  session.command(Command::Cancel);

  session.command(Command::Pull);
  session.feed(stylus(Phase::Press, on));
  session.feed(stylus(Phase::Drag, on + Vec3{0, 0, 0.01}));
  session.finish();
  scene = session.touchSource().sceneAt(on);
  ASSERT_TRUE(scene.grab);
  EXPECT_EQ(scene.grab->anchor, on);
  EXPECT_EQ(scene.grab->place, (on + Vec3{0, 0, 0.01}));
  EXPECT_TRUE(scene.facets.empty());
  session.command(Command::Cancel);
  session.finish();
  EXPECT_FALSE(session.touchSource().sceneAt(on).grab);
  EXPECT_EQ(session.snapshot().document.find(front)->name, "front");
}

// By the live drape: the force the solver found, and how stiff the fabric is there.
TEST(TouchScene, APullUnderWayHasTheForceOfTheSolver) {
  Given given;
  Session& session = given.session;
  session.perform(*parseOperation("body size=jis9ar"));
  session.perform(*parseOperation("move piece=front by=0,800mm,400mm"));
  session.perform(*parseOperation("pin piece=front at=\"0,0; 400mm,0\""));
  session.finish();
  session.command(Command::Pull);
  const Vec3 on{0.2, 1.0, 0.404};
  session.feed(stylus(Phase::Press, on));
  for (int k = 1; k <= 5; ++k) session.feed(stylus(Phase::Drag, on + Vec3{0, 0, 0.01 * k})), session.finish();
  const TouchScene scene = session.touchSource().sceneAt(on);
  ASSERT_TRUE(scene.grab);
  EXPECT_GT(length(scene.grab->force), 0.01);
  EXPECT_GT(scene.grab->stiffness.size(), 1);
}

// While a step is under way its cloth may be replaced under the hand.
TEST(TouchScene, WhatIsBeingChangedIsNotFelt) {
  Given given;
  given.session.perform(*parseOperation("cut piece=front line=\"-30mm,200mm; 430mm,200mm\""));
  EXPECT_TRUE(given.session.touchSource().sceneAt({0.2, 0.2, 0}).changing);
  given.session.finish();
  EXPECT_FALSE(given.session.touchSource().sceneAt({0.2, 0.2, 0}).changing);
}

TEST(TouchScene, ASnapClicksOnceEachTime) {
  Given given;
  Session& session = given.session;
  session.command(Command::Move);
  const Vec3 on{0.2, 0.2, 0.004};
  const std::uint32_t before = session.touchSource().sceneAt(on).clicks;
  session.feed(stylus(Phase::Press, on));
  const auto drag = [&](Vec3 by) {
    session.feed(stylus(Phase::Drag, on + by));
    return session.touchSource().sceneAt(on).clicks - before;
  };
  // The lower left corner of the front comes to that of the back, which hangs 30 cm behind, the other way round.
  EXPECT_EQ(drag({0, 0, -0.1}), 0u);
  EXPECT_EQ(drag({0, 0, -0.292}), 1u);
  EXPECT_EQ(drag({0.001, 0, -0.293}), 1u) << "the same corner";
  EXPECT_EQ(drag({0, 0, -0.2}), 1u) << "away";
  EXPECT_EQ(drag({0, 0, -0.292}), 2u) << "and there again";
}

TEST(TouchScene, ThreadsLieAsTheFabricAndItsGrainHaveThem) {
  // Peirce: a cloth of 0.15 kg/m2 and 0.5 mm.
  Fabric fabric;
  fabric.weight = 0.15, fabric.thickness = 0.0005;
  EXPECT_NEAR(threadSpacing(fabric), 2 * 909 * 3.14159265 / 4 * 0.00025 * 0.00025 / 0.15, 1e-9);
  fabric.thickness = 0.0007;
  EXPECT_GT(threadSpacing(fabric), 1.9 * 0.000594) << "thicker threads of the same weight lie further apart";
  fabric.thickness = 0.02;
  EXPECT_EQ(threadSpacing(fabric), 3e-3);

  Given given;
  const Vec3 at{0.2, 0.2, 0.003};
  const TouchScene scene = given.session.touchSource().sceneAt(at);
  ASSERT_TRUE(scene.weave);
  EXPECT_LT(distance(scene.weave->warp, {0, 1, 0}), 1e-9) << "the grain is upright";
  EXPECT_LT(distance(scene.weave->weft, {1, 0, 0}), 1e-9);
  const Fabric cloth = *fabricOf(given.snapshot().document, given.front());
  EXPECT_EQ(scene.weave->period, threadSpacing(cloth));
  // Threads stay where they are, wherever the scene was made from.
  const TouchScene other = given.session.touchSource().sceneAt(at + Vec3{0.05, 0.03, 0});
  for (const double x : {0.2, 0.2001, 0.2003, 0.21})
    EXPECT_NEAR(weaveShare(*scene.weave, {x, 0.2002, 0}), weaveShare(*other.weave, {x, 0.2002, 0}), 1e-6) << x;
  EXPECT_FALSE(given.session.touchSource().sceneAt(at + Vec3{0, 0, 0.05}).weave) << "not so far away";
}

}  // namespace
}  // namespace karinui
