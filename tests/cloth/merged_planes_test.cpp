#include "karinui/cloth/merged_planes.h"

#include "cloth/meshes.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

TEST(MergedPlanes, ABoxIsSixPolygons) {
  const MergedPlanes planes(bodyOf(boxMesh({0.1, 0.15, 0.1}, 8)));
  EXPECT_EQ(planes.report().facesBefore, 6u * 8 * 8 * 2);
  EXPECT_EQ(planes.report().planesAfter, 6u);
  for (double height : {0.003, 0.0, -0.004}) {
    const auto contact = planes.sample({0.02, 0.15 + height, -0.03});
    EXPECT_NEAR(contact.distance, height, 1e-12);
    EXPECT_NEAR(contact.normal.y, 1, 1e-12);
  }
  // Above the edge no polygon is met straight on.
  const auto edge = planes.sample({0.1 + 0.003, 0.15 + 0.004, 0});
  EXPECT_NEAR(edge.distance, 0.005, 1e-9);
  EXPECT_GT(planes.report().testsSaved, 4 * planes.report().testsDone);
}

// By how much a contact may differ from the mesh: the plane's own flatness, above and below it.
void expectNear(const BodyPtr& body, unsigned seed, double spread) {
  const MergedPlanes planes(body);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-1, 1);
  int asked = 0;
  while (asked < 400) {
    const auto& mesh = body->mesh();
    const Vec3 skin = mesh.points[random() % mesh.points.size()];
    const Vec3 place = skin + Vec3{side(random), side(random), side(random)} * spread;
    const double right = body->bvh().signedDistance(place);
    const auto contact = planes.sample(place);
    EXPECT_NEAR(contact.distance, right, 0.0025) << place.x << " " << place.y << " " << place.z;
    EXPECT_NEAR(length(contact.normal), 1, 1e-9);
    EXPECT_TRUE(planes.mayBeWithin(place, std::fmax(0.0, contact.distance) + 1e-9))
        << contact.distance << " true " << right << " field " << body->field().distance(place) << " cell "
        << body->field().cell();
    EXPECT_NEAR(planes.exactSample(place).distance, right, 1e-9);
    ++asked;
  }
}

TEST(MergedPlanes, AnswersAsTheMeshWithinItsFlatness) { expectNear(bodyOf(ballMesh(0.15, 24)), 3, 0.006); }

TEST(MergedPlanes, DoesNotSeeThroughAThinPart) {
  // A finger's breadth thick: from above one rim the other side is within reach.
  expectNear(bodyOf(boxMesh({0.1, 0.012, 0.012}, 12)), 5, 0.006);
}

TEST(MergedPlanes, ClothRestsOnThemOutsideTheMesh) {
  const BodyPtr body = bodyOf(ballMesh(0.15, 24));
  const MergedPlanes planes(body);
  EXPECT_LT(planes.report().planesAfter, planes.report().facesBefore / 2);
  Fabric f = *preset("cotton");
  ClothLevel level;
  addPiece(level.cloth, gridLattice(12, 12, 0.025), f);
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u - 0.15, 0.155, p.v - 0.15}; });
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.maxSteps = 600;
  Workers workers(1);
  const auto report = settle(levels, planes, settings, Token(), workers);
  ASSERT_TRUE(report) << text(report.error().what);
  EXPECT_TRUE(report->settled) << text(report->why);
  const ClothCheck found = check(levels[0].cloth, levels[0].state, body.get());
  EXPECT_LE(found.penetration, 1e-4);
  EXPECT_LE(report->penetration, 1e-4);
  double highest = -1, lowest = 1;
  for (Vec3 p : levels[0].state.position) {
    highest = std::fmax(highest, p.y);
    lowest = std::fmin(lowest, p.y);
  }
  EXPECT_NEAR(highest, 0.152, 0.003);  // it still lies on the ball
  EXPECT_LT(lowest, 0.08);             // and hangs down round it
  EXPECT_GT(planes.report().testsDone, 1000u);
  EXPECT_GT(planes.report().testsSaved, 0u);
}

}  // namespace
}  // namespace karinui::test
