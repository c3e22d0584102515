#include "karinui/scene/table_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace karinui {
namespace {

// A board that leans: 0.5 m of it for a metre of paper, turned about two axes.
TablePlacement leaning() {
  const Rigid turn = after(turnAbout({0, 1, 0}, 0.7), turnAbout({1, 0, 0}, -1.1));
  TablePlacement placement;
  placement.origin = {-0.6, 0.9, 0.3};
  placement.across = turn.turned({1, 0, 0}) * 0.5;
  placement.upward = turn.turned({0, 1, 0}) * 0.5;
  return placement;
}

TableEdge straight(const char* name, Flat a, Flat b) {
  TableEdge edge;
  edge.name = name;
  edge.points = {a, b};
  edge.length = distance(a, b);
  return edge;
}

TablePiece square() {
  TablePiece piece;
  piece.name = "pocket";
  piece.low = {0.1, 0.1}, piece.high = {0.3, 0.4};
  piece.edges = {straight("hem", {0.1, 0.1}, {0.3, 0.1}), straight("right", {0.3, 0.1}, {0.3, 0.4}),
                 straight("top", {0.3, 0.4}, {0.1, 0.4}), straight("left", {0.1, 0.4}, {0.1, 0.1})};
  return piece;
}

double area(const TriangleMesh& mesh, Vec3 normal) {
  double sum = 0;
  for (const Triangle& f : mesh.faces) {
    const auto& p = mesh.points;
    sum += dot(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]), normal) / 2;
  }
  return sum;
}

TEST(TablePlacement, ARayMeetsThePlaceItIsAimedAt) {
  const TablePlacement placement = leaning();
  for (const Flat place : {Flat{0, 0}, Flat{0.7, -0.2}, Flat{-0.3, 0.9}}) {
    const Vec3 eye{0.4, 1.9, 1.5};
    const Ray ray{eye, normalized(placement.at(place) - eye)};
    const auto met = meet(placement, ray);
    ASSERT_TRUE(met);
    EXPECT_LT(distance(met->place, place), 1e-12);
    EXPECT_NEAR(met->along, distance(eye, placement.at(place)), 1e-12);
    EXPECT_FALSE(meet(placement, {eye, -ray.direction})) << "it lies behind";
    EXPECT_FALSE(meet(placement, {placement.at(place) - placement.normal(), placement.normal()})) << "from below";
  }
}

TEST(TablePlacement, ASampleInSpaceBecomesOneOnTheTable) {
  const TablePlacement placement = leaning();
  PointerSample sample;
  sample.ray = {placement.at({0.2, 0.3}, 2), -placement.normal()};
  sample.reach = 0.01;
  sample.shift = true;
  const auto pointed = onTable(placement, sample);
  ASSERT_TRUE(pointed);
  EXPECT_EQ(pointed->where, PointerSample::Where::Table);
  EXPECT_LT(distance(pointed->place, Flat{0.2, 0.3}), 1e-12);
  EXPECT_NEAR(pointed->reach, 0.01 * 2 / 0.5, 1e-12) << "a hundredth of a radian, two metres away, at half size";
  EXPECT_TRUE(pointed->shift);
  sample.ray.direction = placement.normal();
  EXPECT_FALSE(onTable(placement, sample));
  sample.tip = Rigid{};
  sample.tip->carry = placement.at({-0.1, 0.5}, 0.02);
  sample.reach = 0.005;
  const auto touched = onTable(placement, sample);
  ASSERT_TRUE(touched) << "a tip needs no ray";
  EXPECT_LT(distance(touched->place, Flat{-0.1, 0.5}), 1e-12);
  EXPECT_NEAR(touched->reach, 0.01, 1e-12);
}

TEST(TableScene, PiecesAreFlatClothsThatFaceUp) {
  TableFrame frame;
  frame.pieces.push_back(square());
  frame.pieces[0].holes = {{straight("a", {0.15, 0.15}, {0.2, 0.15}), straight("b", {0.2, 0.15}, {0.2, 0.2}),
                            straight("c", {0.2, 0.2}, {0.15, 0.2}), straight("d", {0.15, 0.2}, {0.15, 0.15})}};
  const TablePlacement placement = leaning();
  const TableScene scene = sceneOf(frame, placement, 0.004);
  ASSERT_EQ(scene.frame.cloths.size(), 1u);
  const SceneCloth& cloth = scene.frame.cloths[0];
  EXPECT_EQ(cloth.name, "pocket");
  EXPECT_NEAR(area(cloth.mesh, placement.normal()), (0.2 * 0.3 - 0.05 * 0.05) * 0.25, 1e-12) << "without its hole";
  EXPECT_EQ(cloth.outlines.size(), 2u);
  ASSERT_EQ(cloth.flat.size(), cloth.mesh.points.size());
  for (std::size_t i = 0; i < cloth.flat.size(); ++i) {
    EXPECT_LT(distance(placement.at(cloth.flat[i], 0.004), cloth.mesh.points[i]), 1e-12);
  }
}

TEST(TableScene, AnOutlineThatCrossesItselfHasNoTriangles) {
  TableFrame frame;
  frame.pieces.push_back(square());
  std::swap(frame.pieces[0].edges[0].points[1], frame.pieces[0].edges[1].points[1]);
  frame.pieces[0].edges[1].points[0] = frame.pieces[0].edges[0].points[1];
  frame.pieces[0].edges[2].points[0] = frame.pieces[0].edges[1].points[1];
  const TableScene scene = sceneOf(frame, {});
  ASSERT_EQ(scene.frame.cloths.size(), 1u);
  EXPECT_TRUE(scene.frame.cloths[0].mesh.faces.empty());
  EXPECT_FALSE(scene.frame.cloths[0].outlines.empty());
}

TEST(TableScene, LinesAndLetteringLieOverThePaper) {
  TableFrame frame;
  frame.pieces.push_back(square());
  TablePiece& piece = frame.pieces[0];
  piece.lines = {{{0.15, 0.3}, {0.25, 0.3}, {0.25, 0.35}}};
  piece.notches = {{{{0.2, 0.1}, {0.2, 0.105}}, true}};
  piece.drills = {{0.2, 0.2}};
  piece.grain = TableStroke{{0.12, 0.15}, {0.12, 0.35}};
  piece.labels = {{TableLabel::Says::Name, say("{0}", "pocket"), {0.2, 0.25}, 0.01, true},
                  {TableLabel::Says::Cut, say("{0}", "cut"), {0.18, 0.25}, 0.01, false}};
  frame.seams.push_back({"side", {0.1f, 0.2f, 0.3f}, false, {}});
  frame.seams[0].sides[0].runs = {{{{0.3, 0.1}, {0.3, 0.4}}, {{-1, 0}, {-1, 0}}}};
  frame.seams[0].sides[0].ticks = {{{0.3, 0.2}, {-1, 0}}};
  const TablePlacement placement = leaning();
  const TableScene scene = sceneOf(frame, placement, 0.004);
  double dashes = 0;
  bool seam = false;
  std::size_t arrows = 0;
  for (const SceneLine& line : scene.frame.lines) {
    arrows += line.arrow;
    for (const Vec3 p : line.points) {
      EXPECT_NEAR(dot(p - placement.origin, placement.normal()), 0.008, 1e-12);
      const Flat place = placement.below(p);
      EXPECT_TRUE(place.u > 0.1 - 1e-9 && place.u < 0.3 + 1e-9 && place.v > 0.1 - 1e-9 && place.v < 0.4 + 1e-9);
      seam |= line.colour == frame.seams[0].colour && std::fabs(place.u - 0.297) < 1e-9;
      if (place.v > 0.3 - 1e-9 && place.u > 0.15 - 1e-9 && place.u < 0.25 + 1e-9 && !line.arrow) dashes += 0.5;
    }
  }
  EXPECT_EQ(arrows, 2u) << "one to each end of the grain line";
  EXPECT_TRUE(seam) << "inside the edge";
  EXPECT_GE(dashes, 15) << "0.15 m in dashes of 6 mm with gaps of 4 mm";
  ASSERT_EQ(scene.labels.size(), 2u);
  EXPECT_NEAR(length(scene.labels[0].upward), 0.005, 1e-12);
  EXPECT_NEAR(dot(scene.labels[0].along, normalized(placement.across)), 1, 1e-12);
  EXPECT_NEAR(dot(scene.labels[1].along, normalized(placement.upward)), 1, 1e-12) << "read from below upwards";
  EXPECT_NEAR(dot(cross(scene.labels[1].along, normalized(scene.labels[1].upward)), placement.normal()), 1, 1e-12)
      << "not mirrored";
}

}  // namespace
}  // namespace karinui
