#include "design/operations/drawn_sheet.h"

#include <gtest/gtest.h>

#include <map>

#include "geometry/surfaces.h"

namespace karinui {
namespace {

constexpr double kFair = 0.004;  // metres a fair edge may pass from the line as drawn

const Edge& edgeOf(const DrawnSheet& sheet, std::string_view name) {
  const auto found = sheet.outline.find(name);
  EXPECT_TRUE(found) << name;
  return sheet.outline.edges[found.value_or(0)];
}

// No triangle turned over on paper, none folded onto its neighbour in space.
void expectSensible(const DrawnSheet& sheet) {
  const Form& form = *sheet.form;
  ASSERT_EQ(form.flat.size(), form.space.size());
  const TriangleMesh shape{form.space, form.faces};
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normal;
  for (std::uint32_t f = 0; f < form.faces.size(); ++f) {
    const Triangle& t = form.faces[f];
    EXPECT_GT(cross(form.flat[t[1]] - form.flat[t[0]], form.flat[t[2]] - form.flat[t[0]]), 0);
    for (std::size_t k = 0; k < 3; ++k) normal[{t[k], t[(k + 1) % 3]}] = faceNormal(shape, f);
  }
  for (const auto& [edge, n] : normal)
    if (const auto other = normal.find({edge.second, edge.first}); other != normal.end()) {
      EXPECT_GT(dot(n, other->second), -0.2);
    }
  EXPECT_TRUE(checked(sheet.outline));
}

TEST(DrawnSheet, APanelOnACylinderIsItsUnrolling) {
  const double r = 0.15, ease = 0.01;
  const TriangleMesh mesh = surfaces::cylinder(240, 80, r, 0.8);
  const Bvh bvh(mesh);
  const DrawingGround ground(mesh, bvh);
  const auto on = [&](double a, double y) { return surfaces::nearest(bvh, {r * std::sin(a), y, r * std::cos(a)}); };
  DrawnLine line;
  line.places = {on(-1, 0.2), on(1, 0.2), on(1, 0.6), on(-1, 0.6)};
  line.edges = {"hem", "right", "waist", "left"};
  DrawnSettings settings;
  settings.ease = ease;
  const auto sheet = drawnSheet(ground, line, settings, Token());
  ASSERT_TRUE(sheet) << text(sheet.error().what);
  expectSensible(*sheet);
  ASSERT_EQ(sheet->outline.edges.size(), 4u);
  for (const Edge& edge : sheet->outline.edges) EXPECT_EQ(edge.curve.kind, Curve::Kind::Line) << edge.name;
  EXPECT_NEAR(edgeOf(*sheet, "hem").curve.length(), 2 * (r + ease), 1e-3);
  EXPECT_NEAR(edgeOf(*sheet, "left").curve.length(), 0.4, 5e-4);
  EXPECT_EQ(sheet->distortion.gate, Distortion::Gate::Green);
  for (Vec3 p : sheet->form->space) EXPECT_NEAR(std::hypot(p.x, p.z), r + ease, 5e-4);
}

TEST(DrawnSheet, ASmoothClosedLineIsOneEdgeInAFewCurves) {
  const TriangleMesh mesh = surfaces::plane(60, 1.0);
  const Bvh bvh(mesh);
  const DrawingGround ground(mesh, bvh);
  DrawnLine line;
  for (int i = 0; i < 8; ++i) {
    const double a = i * std::numbers::pi / 4;
    line.places.push_back(surfaces::nearest(bvh, {0.5 + 0.2 * std::cos(a), 0.5 + 0.2 * std::sin(a), 0}));
    line.edges.push_back(i == 0 ? "rim" : "");
  }
  const auto sheet = drawnSheet(ground, line, {}, Token());
  ASSERT_TRUE(sheet) << text(sheet.error().what);
  expectSensible(*sheet);
  EXPECT_EQ(sheet->outline.edges.front().name, "rim");
  EXPECT_EQ(sheet->outline.edges[1].name, "rim_2");
  EXPECT_NEAR(sheet->outline.length(), 2 * std::numbers::pi * 0.2, 0.01);
  EXPECT_NEAR(sheet->outline.area(), std::numbers::pi * 0.04, 0.002);
}

// On a plane the paper is the drawing itself: the outline follows the drawn line everywhere.
TEST(DrawnSheet, TheOutlineFollowsTheDrawnLine) {
  const TriangleMesh mesh = surfaces::plane(80, 1.0);
  const Bvh bvh(mesh);
  const DrawingGround ground(mesh, bvh);
  const auto on = [&](double x, double y) { return surfaces::nearest(bvh, {x, y, 0}); };
  DrawnLine line;  // a sleeve: a high cap that swings in and out, and a hollow hem
  line.places = {on(0.2, 0.5), on(0.26, 0.53), on(0.33, 0.68), on(0.45, 0.74), on(0.58, 0.66), on(0.63, 0.54),
                 on(0.7, 0.5), on(0.64, 0.2),  on(0.55, 0.23), on(0.45, 0.16), on(0.3, 0.2)};
  line.edges = {"cap", "", "", "", "", "", "back", "hem", "", "", "front"};
  const auto sheet = drawnSheet(ground, line, {}, Token());
  ASSERT_TRUE(sheet) << text(sheet.error().what);
  expectSensible(*sheet);
  EXPECT_LT(sheet->fitMiss, kFair);
  EXPECT_LE(edgeOf(*sheet, "cap").curve.parts().size(), 2u) << "a fair line is not made of many pieces";
  // The border runs counter-clockwise, the line was drawn clockwise.
  const Ring ring = sheet->outline.flattened();
  const Flat carry = edgeOf(*sheet, "back").curve.end - Flat{0.7, 0.5};
  double worst = 0;
  for (const auto& [first, last] : {std::pair{0, 6}, std::pair{7, 10}}) {
    const auto side = drawnSide(ground, std::span(line.places).subspan(first, last - first + 1));
    ASSERT_TRUE(side);
    for (const Vec3 p : side->points) worst = std::fmax(worst, distanceToRing(ring, Flat{p.x, p.y} + carry));
  }
  EXPECT_LT(worst, kFair);
}

TEST(DrawnSheet, RefusesCrossingTinyAndRoundTheBodyLines) {
  const TriangleMesh mesh = surfaces::cylinder(120, 60, 0.15, 0.8);
  const Bvh bvh(mesh);
  const DrawingGround ground(mesh, bvh);
  const auto on = [&](double a, double y) {
    return surfaces::nearest(bvh, {0.15 * std::sin(a), y, 0.15 * std::cos(a)});
  };
  const auto draw = [&](std::vector<SurfacePoint> places) {
    DrawnLine line;
    line.places = std::move(places);
    for (std::size_t i = 0; i < line.places.size(); ++i) line.edges.push_back("e" + std::to_string(i));
    return drawnSheet(ground, line, {}, Token());
  };
  const auto crossing = draw({on(-1, 0.2), on(1, 0.6), on(1, 0.2), on(-1, 0.63)});
  ASSERT_FALSE(crossing);
  EXPECT_NE(text(crossing.error().what).find("crosses itself"), std::string::npos);
  const auto tiny = draw({on(0, 0.4), on(0.02, 0.4), on(0.01, 0.405)});
  ASSERT_FALSE(tiny);
  EXPECT_NE(text(tiny.error().what).find("small"), std::string::npos);
  const auto round = draw({on(0, 0.4), on(2, 0.4), on(4, 0.4)});
  ASSERT_FALSE(round);  // an open tube: beyond the line there is the tube's end
}

// A bodice as a dressmaker would draw it, on a realistic figure.
class OnAFigure : public ::testing::Test {
 protected:
  void SetUp() override {
    mesh_ = surfaces::sharedBody("f_eu38");
    if (!mesh_) GTEST_SKIP() << "the realistic bodies are not there";
    bvh_.emplace(*mesh_);
    ground_.emplace(*mesh_, *bvh_);
  }
  SurfacePoint near(double x, double y, double z) const { return surfaces::nearest(*bvh_, {x, y, z}); }
  SurfacePoint facing(double x, double y, double side) const {  // from the front (1) or the back (-1)
    return bvh_->first({x, y, side}, {0, 0, -side})->place;
  }
  DrawnLine bodice(double side) const {
    const double neck = side > 0 ? 1.355 : 1.415;
    DrawnLine line;
    line.symmetric = true;
    line.places = {facing(0, neck, side),     facing(0.045, neck + (side > 0 ? 0.012 : 0.004), side),
                   near(0.062, 1.425, 0),     near(0.155, 1.385, 0),
                   facing(0.132, 1.33, side), facing(0.135, 1.29, side),
                   near(0.15, 1.25, 0.01),    near(0.13, 1.08, 0.01),
                   near(0.17, 0.93, 0.01),    facing(0, 0.93, side)};
    line.edges = {"neck", "", "shoulder", "armhole", "", "", "side", "", "hem", ""};
    return line;
  }
  std::optional<TriangleMesh> mesh_;
  std::optional<Bvh> bvh_;
  std::optional<DrawingGround> ground_;
};

TEST_F(OnAFigure, ABodiceIsSymmetricAndItsSeamsMatch) {
  const auto front = drawnSheet(*ground_, bodice(1), {}, Token()), back = drawnSheet(*ground_, bodice(-1), {}, Token());
  ASSERT_TRUE(front) << text(front.error().what);
  ASSERT_TRUE(back) << text(back.error().what);
  for (const DrawnSheet* sheet : {&*front, &*back}) {
    expectSensible(*sheet);
    ASSERT_EQ(sheet->outline.edges.size(), 10u);
    EXPECT_LT(sheet->fitMiss, kFair);
    for (const char* name : {"neck", "shoulder", "armhole", "side", "hem"}) {
      const Curve left = edgeOf(*sheet, std::string(name) + "_left").curve;
      const Curve right = edgeOf(*sheet, std::string(name) + "_right").curve;
      EXPECT_EQ(left.start, (Flat{right.end.u == 0 ? 0.0 : -right.end.u, right.end.v})) << name;
      EXPECT_EQ(left.length(), right.reversed().mirrored({0, 0}, {0, 1}).length()) << name;
    }
    for (Vec3 p : sheet->form->space) EXPECT_GT(bvh_->signedDistance(p), 0.006);
    // Upright: the neck is at the top of the centre, the hem at its foot.
    EXPECT_GT(edgeOf(*sheet, "neck_left").curve.at(0).v, edgeOf(*sheet, "hem_left").curve.at(0).v + 0.3);
  }
  for (const char* name : {"shoulder_left", "side_left"}) {
    const double a = edgeOf(*front, name).curve.length(), b = edgeOf(*back, name).curve.length();
    EXPECT_NEAR(a / b, 1, 0.01) << name;
  }
  // A front over a bust wants a dart; a back hardly.
  EXPECT_EQ(front->distortion.gate, Distortion::Gate::Red);
  EXPECT_LT(back->distortion.weft.p99, 0.5 * front->distortion.weft.p99);
}

TEST_F(OnAFigure, ASleeveIsOneLineSlitAlongTheUnderarm) {
  const Vec3 shoulder{0.1606, 1.3382, 0.0216}, elbow{0.3309, 1.1516, 0.0274};
  const Vec3 axis = normalized(elbow - shoulder);
  const Vec3 up = normalized(Vec3{0, 1, 0} - axis * axis.y);
  Vec3 front = normalized(cross(axis, up));
  if (front.z < 0) front = -front;
  const auto on = [&](double down, double angle) {
    const Vec3 middle = shoulder + axis * down, out = up * std::cos(angle) + front * std::sin(angle);
    return bvh_->first(middle + out * 0.15, -out)->place;
  };
  DrawnLine line;
  const SurfacePoint under = on(0.10, std::numbers::pi), cuff = on(0.22, std::numbers::pi);
  line.places = {under, on(0.06, -2), on(0.02, -1), on(0, 0),    on(0.02, 1),  on(0.06, 2),
                 under, cuff,         on(0.22, 2),  on(0.22, 0), on(0.22, -2), cuff};
  line.edges = {"cap", "", "", "", "", "", "front", "cuff", "", "", "", "back"};
  const auto sheet = drawnSheet(*ground_, line, {}, Token());
  ASSERT_TRUE(sheet) << text(sheet.error().what);
  expectSensible(*sheet);
  EXPECT_LT(sheet->fitMiss, kFair);
  EXPECT_NEAR(edgeOf(*sheet, "front").curve.length() / edgeOf(*sheet, "back").curve.length(), 1, 0.01);
}

}  // namespace
}  // namespace karinui
