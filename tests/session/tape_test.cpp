#include "karinui/session/tape.h"
#include "karinui/body/sizes.h"

#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

// Two panels 40 cm wide hang 30 cm apart round an egg.
class Tapes : public testing::Test {
 protected:
  void SetUp() override {
    const auto lines = parseScript(kTwoPieces);
    Document document;
    for (const ScriptLine& line : *lines) {
      auto next = apply(document, line.operation, room.context);
      ASSERT_TRUE(next) << text(next.error().what);
      document = *next;
    }
    auto body = Body::make(egg());
    ASSERT_TRUE(body);
    fitting = snapshotOf(document, *body);
  }
  Tape along(Ray ray) {
    PointerSample sample;
    sample.ray = ray;
    return tapeAt(*fitting, pick(*fitting, TableLayout(), sample));
  }
  Workroom room;
  SnapshotPtr fitting;
};

TEST_F(Tapes, OnClothGoesRoundTheGarment) {
  const Tape tape = along({{0.2, 0.2, 2}, {0, 0, -1}});
  // Round both panels: a box 80 cm by 30 cm, for the back hangs from 0 to -40 cm.
  EXPECT_NEAR(tape.length, 2 * std::hypot(0.4, 0.3) + 2 * 0.4, 0.02);
  ASSERT_FALSE(tape.line.empty());
  EXPECT_EQ(tape.line.front(), tape.line.back());
}

TEST_F(Tapes, OnSkinGoesRoundTheBody) {
  const Tape tape = along({{0, 0.8, 2}, {0, 0, -1}});
  // Ramanujan's ellipse with half axes 15 cm and 12 cm.
  const double h = std::pow(0.03 / 0.27, 2);
  EXPECT_NEAR(tape.length, std::numbers::pi * 0.27 * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h))), 0.005);
}

TEST_F(Tapes, BesideEverythingMeasuresNothing) { EXPECT_TRUE(along({{2, 0.8, 2}, {0, 0, -1}}).line.empty()); }

// A shirt's sleeves hang at the height of the chest: the tape goes under them, and round one alone where it is pointed
// at.
TEST(TapeOnASleeve, GoesRoundWhatIsPointedAtAlone) {
  Workers alone(1);
  const auto body = makeMannequin(*builtInSize("jis9ar"), alone, Token());
  ASSERT_TRUE(body) << text(body.error().what);
  const auto& landmarks = (*body)->landmarks();
  const Vec3 shoulder = landmarks.at("shoulder_left"), elbow = landmarks.at("elbow_left"),
             wrist = landmarks.at("wrist_left");
  const double chest = (*body)->measured().value.at("bust_girth") / (2 * std::numbers::pi) + 0.03;
  GarmentSnapshot fitting;
  fitting.body = *body;
  const auto tube = [&](Vec3 from, Vec3 to, double radius) {
    SceneCloth cloth;
    constexpr std::uint32_t n = 48;
    const Vec3 along = normalized(to - from), side = normalized(cross(along, {0, 0, 1})), front = cross(side, along);
    for (const Vec3 end : {from, to})
      for (std::uint32_t k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * k / n;
        cloth.mesh.points.push_back(end + side * (radius * std::cos(a)) + front * (radius * std::sin(a)));
      }
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t next = (k + 1) % n;
      cloth.mesh.faces.push_back({k, next, n + k});
      cloth.mesh.faces.push_back({next, n + next, n + k});
    }
    fitting.frame.cloths.push_back(std::move(cloth));
  };
  const double bust = (*body)->measured().value.at("bust_height");
  tube({0, bust - 0.2, 0}, {0, bust + 0.03, 0}, chest);
  tube(shoulder, elbow, 0.06), tube(elbow, wrist, 0.05);
  const auto mirrored = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
  tube(mirrored(shoulder), mirrored(elbow), 0.06);
  Hit hit;
  hit.on = Hit::On::Cloth;
  hit.point = {0, bust, chest};
  EXPECT_NEAR(tapeAt(fitting, hit).length, 2 * std::numbers::pi * chest, 0.01);
  hit.point = lerp(shoulder, elbow, 0.6) + Vec3{0, 0, 0.06};
  EXPECT_NEAR(tapeAt(fitting, hit).length, 2 * std::numbers::pi * 0.06, 0.02) << "square to the arm";
  hit.point = lerp(elbow, wrist, 0.5) + Vec3{0, 0, 0.05};
  EXPECT_NEAR(tapeAt(fitting, hit).length, 2 * std::numbers::pi * 0.05, 0.02);
}

}  // namespace
}  // namespace karinui
