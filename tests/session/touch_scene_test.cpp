#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/cloth/fabric.h"
#include "karinui/session/session.h"
#include "karinui/session/touch_scene_of.h"
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

}  // namespace
}  // namespace karinui
