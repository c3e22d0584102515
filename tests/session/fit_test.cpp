#include "karinui/session/fit.h"
#include "karinui/body/sizes.h"

#include <gtest/gtest.h>

#include <set>

#include "design/workroom.h"

namespace karinui {
namespace {

double ellipse(double a, double b) {  // Ramanujan
  const double h = std::pow((a - b) / (a + b), 2);
  return std::numbers::pi * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

// Two panels, 40 cm wide and 30 cm apart, before and behind.
SnapshotPtr panelsRoundAnEgg() {
  Workroom room;
  Document document;
  const auto lines =
      parseScript(std::string(kTwoPieces) + "move piece=front by=-20cm,0,15cm\nmove piece=back by=20cm,0,15cm\n");
  for (const ScriptLine& line : *lines) document = *apply(document, line.operation, room.context);
  return snapshotOf(document, *Body::make(egg()));
}

TEST(Fit, TheLevelTapeGoesRoundGarmentAndBody) {
  const SnapshotPtr fitting = panelsRoundAnEgg();
  const Girths girths = girthsAt(*fitting, 0.4).at(0);
  const double share = std::sqrt(1 - 0.25);  // of the egg's half axes, half-way up
  EXPECT_NEAR(girths.body, ellipse(0.15 * share, 0.12 * share), 0.006);
  EXPECT_NEAR(girths.garment, 2 * (0.4 + 0.3), 0.001);
  EXPECT_EQ(girths.under.front(), girths.under.back());
  for (const Vec3 p : girths.round) EXPECT_NEAR(p.y, 0.4, 1e-9);
}

// Buttons are drawn as discs where they lie: closed ones off the cloth that lies over, open ones on the other's. A zip
// is one line where it is closed and two where it is open.
TEST(Fit, FasteningsAreDrawnAndToldOf) {
  Workroom room;
  Document document;
  const auto play = [&](const std::string& lines) {
    const auto script = parseScript(lines);
    ASSERT_TRUE(script);
    for (const ScriptLine& line : *script) {
      auto after = apply(document, line.operation, room.context);
      ASSERT_TRUE(after) << text(after.error().what);
      document = *std::move(after);
    }
  };
  play(
      "piece name=over outline=\"M 0 0; hem L 200 0; centre L 200 300; neck L 0 300; side L 0 0\" pose=\"0,1,0.3\"\n"
      "piece name=under outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\" "
      "pose=\"0.17,1,0.297\"\n"
      "fasten a=over.centre b=under.centre count=3 first=5cm last=5cm closed=2 size=20mm\n"
      "fasten kind=zip a=over.side b=under.side length=20cm closed_length=5cm reversed=yes\n");
  const SnapshotPtr fitting = snapshotOf(document, nullptr);
  ASSERT_EQ(fitting->frame.lines.size(), 7u) << "with the zip's slider and its tab";
  std::vector<SceneLine> discs, zips;
  for (const SceneLine& line : fitting->frame.lines) {
    if (line.widthMm == 10) discs.push_back(line);
    if (line.widthMm == 4) zips.push_back(line);
  }
  ASSERT_EQ(discs.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const SceneLine& disc = discs[k];
    const double height = 1.05 + 0.1 * static_cast<double>(k);  // counted from the top, drawn from the run's start
    for (const Vec3 p : disc.points) {
      EXPECT_NEAR(distance(p, {0.185, height, p.z}), 0.005, 1e-9);
      EXPECT_NEAR(p.z, (k > 0 ? 0.3 : 0.297) + 0.0015, 1e-9);
    }
    EXPECT_EQ(disc.widthMm, 10);
  }
  const auto reach = [](const SceneLine& line) { return distance(line.points.front(), line.points.back()); };
  EXPECT_NEAR(reach(zips[0]), 0.2, 1e-9);
  EXPECT_NEAR(reach(zips[1]), 0.15, 0.0051);
  const auto pulls = fasteningsOf(*fitting);
  ASSERT_EQ(pulls.size(), 3u);
  EXPECT_TRUE(pulls[0].holds()) << pulls[0].gap;
  EXPECT_EQ(pulls[2].kind, FasteningKind::Zip);
  EXPECT_NEAR(pulls[2].length, 0.05, 1e-9);
  EXPECT_FALSE(pulls[2].holds());
}

TEST(Fit, AboveTheGarmentOnlyTheBodyIsMeasured) {
  const Girths girths = girthsAt(*panelsRoundAnEgg(), 1.2).at(0);
  EXPECT_EQ(girths.garment, 0);
  EXPECT_TRUE(girths.round.empty());
  EXPECT_GT(girths.body, 0.5);
}

TEST(Fit, WhereOnlyOneSideHangsNothingGoesRound) {
  SnapshotPtr whole = panelsRoundAnEgg();
  GarmentSnapshot half = *whole;
  half.frame.cloths.pop_back();
  EXPECT_EQ(girthsAt(half, 0.4).at(0).garment, 0);
}

// A tube of cloth that stands on the floor, round each of `rings`, as high as `top`.
struct TubeRing {
  double x, z, half;
};
GarmentSnapshot tubesOn(const BodyPtr& body, const std::vector<TubeRing>& rings, double top = 0.7) {
  GarmentSnapshot fitting;
  fitting.body = body;
  for (const TubeRing& ring : rings) {
    SceneCloth cloth;
    constexpr std::uint32_t kAround = 48;
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double turn = 2 * std::numbers::pi * k / kAround;
      for (const double y : {0.0, top})
        cloth.mesh.points.push_back({ring.x + ring.half * std::cos(turn), y, ring.z + ring.half * std::sin(turn)});
    }
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % kAround);
      cloth.mesh.faces.push_back({a, b, a + 1});
      cloth.mesh.faces.push_back({b, b + 1, a + 1});
    }
    fitting.frame.cloths.push_back(std::move(cloth));
  }
  return fitting;
}

TEST(Fit, ATrouserLegIsMeasuredByItself) {
  Workers alone(1);
  const auto body = makeMannequin(*builtInSize("jis9ar"), alone, Token());
  ASSERT_TRUE(body) << text(body.error().what);
  const auto knee = (*body)->find(*parseBodyPoint("left_leg:knee@0"));
  ASSERT_TRUE(knee);
  const Vec3 left = at((*body)->mesh(), *knee);
  const double z = left.z - 0.05;
  const auto trousers = girthsAt(tubesOn(*body, {{left.x, z, 0.1}, {-left.x, z, 0.1}}), left.y);
  ASSERT_EQ(trousers.size(), 2u);
  EXPECT_EQ(trousers[0].what, Girths::Round::LeftLeg);
  EXPECT_EQ(trousers[1].what, Girths::Round::RightLeg);
  for (const Girths& leg : trousers) {
    EXPECT_NEAR(leg.garment, 2 * std::numbers::pi * 0.1, 0.003);
    EXPECT_NEAR(leg.body, (*body)->measured().value.at("knee_girth"), 0.006);
  }
  for (const Vec3 p : trousers[0].round) EXPECT_GT(p.x, 0) << "the body's left is +x";
  const auto skirt = girthsAt(tubesOn(*body, {{0, z, 0.17}}), left.y);
  ASSERT_EQ(skirt.size(), 1u) << "a narrow skirt goes round both";
  EXPECT_NEAR(skirt[0].garment, 2 * std::numbers::pi * 0.17, 0.004);
  EXPECT_GT(skirt[0].body, 1.3 * (*body)->measured().value.at("knee_girth"));
  const auto one = girthsAt(tubesOn(*body, {{-left.x, z, 0.1}}), left.y);
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[0].garment, 0);
  EXPECT_GT(one[1].garment, 0.6);
  const auto bare = girthsAt(tubesOn(*body, {}), left.y);
  ASSERT_EQ(bare.size(), 1u);
  EXPECT_EQ(bare[0].garment, 0);
}

// The table of ease and the table of measures tell one girth: both are taken at the same height.
TEST(Fit, TellsTheGirthsThatTheTapeFound) {
  Workers alone(1);
  Measurements own;
  own.value = {{"height", 1.63}, {"bust_girth", 0.96}, {"waist_girth", 0.80}, {"hip_girth", 1.04}};
  const auto body = makeMannequin(own, alone, Token());
  ASSERT_TRUE(body) << text(body.error().what);
  std::set<std::string> told;
  const std::map<std::string, std::string> measures{
      {"bust", "bust_girth"}, {"waist", "waist_girth"}, {"hip", "hip_girth"}};
  for (const Girths& girths : girthsOf(tubesOn(*body, {{0, 0, 0.22}}, 1.6))) {
    const auto measure = measures.find(text(girths.name));
    if (measure == measures.end() || !told.insert(measure->first).second) continue;
    EXPECT_NEAR(girths.body, (*body)->measured().value.at(measure->second), 0.004) << measure->first;
  }
  EXPECT_EQ(told.size(), 3u);
}

// A skirt's upper edge hangs a little below the waist, a bodice's lower one a little above it: both are measured there.
TEST(Fit, TellsTheGirthAtTheEdgeOfASkirt) {
  Workers alone(1);
  const auto body = makeMannequin(*builtInSize("eu40"), alone, Token());
  ASSERT_TRUE(body) << text(body.error().what);
  const double waist = (*body)->measured().value.at("waist_height");
  const auto told = [&](double top) {
    std::map<std::string, Girths> all;
    for (Girths& girths : girthsOf(tubesOn(*body, {{0, 0, 0.22}}, top))) all[text(girths.name)] = std::move(girths);
    return all;
  };
  const auto skirt = told(waist - 0.012);
  ASSERT_TRUE(skirt.contains("waist"));
  EXPECT_NEAR(skirt.at("waist").garment, 2 * std::numbers::pi * 0.22, 0.01);
  EXPECT_NEAR(skirt.at("waist").body, (*body)->measured().value.at("waist_girth"), 0.02);
  EXPECT_NEAR(skirt.at("waist").off, -0.0125, 1e-9) << "and how far from the waist that is";
  ASSERT_TRUE(skirt.contains("high hip"));
  EXPECT_EQ(skirt.at("high hip").off, 0);
  EXPECT_TRUE(skirt.contains("hip"));
  EXPECT_FALSE(skirt.contains("under bust"));
  EXPECT_FALSE(told(waist - 0.06).contains("waist")) << "that is no edge at the waist";
}

// An arm that is raised moves no level of the trunk below it.
TEST(Fit, TellsTheSameGirthsWithAnArmRaised) {
  Workers alone(1);
  const auto body = makeMannequin(*builtInSize("eu38"), alone, Token());
  ASSERT_TRUE(body);
  const auto skeleton = Skeleton::of(*body);
  ASSERT_TRUE(skeleton) << text(skeleton.error().what);
  const auto raised = posed(**skeleton, {{Joint::LeftShoulder, {0, 80 * kDegree, 0}}});
  ASSERT_TRUE(raised) << text(raised.error().what);
  std::map<std::string, double> before;
  for (const Girths& girths : girthsOf(tubesOn(*body, {{0, 0, 0.22}}, 1.6))) before[text(girths.name)] = girths.body;
  for (const Girths& girths : girthsOf(tubesOn(*raised, {{0, 0, 0.22}}, 1.6)))
    if (text(girths.name) == "waist" || text(girths.name) == "hip") {
      EXPECT_NEAR(girths.body, before.at(text(girths.name)), 1e-3) << text(girths.name);
    }
  ASSERT_TRUE(before.contains("hip"));
}

// The tape at the armpit goes under the arms, not round them: a man's chest is measured just there.
TEST(Fit, AtTheArmpitTheArmsAreLeftOut) {
  Workers alone(1);
  for (const char* size : {"jis9ar", "eu38", "eu50"}) {
    const auto body = makeMannequin(*builtInSize(size), alone, Token());
    ASSERT_TRUE(body) << text(body.error().what);
    const auto& measured = (*body)->measured().value;
    const double half = measured.at("bust_girth") / (2 * std::numbers::pi) + 0.03;
    const auto girths = girthsOf(tubesOn(*body, {{0, 0, half}}, 1.6));
    ASSERT_FALSE(girths.empty());
    EXPECT_EQ(text(girths[0].name), "armpit");
    EXPECT_LT(girths[0].height, measured.at("armpit_height"));
    EXPECT_NEAR(girths[0].body, measured.at("bust_girth"), 0.012) << size;
    EXPECT_NEAR(girths[0].garment, 2 * std::numbers::pi * half, 0.02) << size;
  }
}

// A full upper arm lies against the trunk below the fold of the armpit: there the tape would go round both.
TEST(Fit, AtTheArmpitAFullArmIsLeftOutToo) {
  Workers alone(1);
  Measurements full;
  full.value = {{"height", 1.60}, {"bust_girth", 1.04}, {"waist_girth", 0.90}, {"hip_girth", 1.12}};
  const auto body = makeMannequin(full, alone, Token());
  ASSERT_TRUE(body) << text(body.error().what);
  const auto girths = girthsOf(tubesOn(*body, {{0, 0, 0.20}}, 1.6));
  ASSERT_FALSE(girths.empty());
  EXPECT_EQ(text(girths[0].name), "armpit");
  EXPECT_NEAR(girths[0].body, 1.04, 0.02);
  EXPECT_GT(girths[0].garment, girths[0].body);
}

TEST(Fit, PressureIsShownOfAFigureThatStandsOnTheFloor) {
  const SnapshotPtr fitting = panelsRoundAnEgg();
  const std::vector<float> values(fitting->body->mesh().points.size(), 5.0f);
  const SceneFrame frame = pressureFrame(*fitting, values);
  EXPECT_EQ(frame.bodies.size(), 1u) << "cloth without a body is drawn above the floor";
  EXPECT_EQ(frame.cloths.at(0).mesh.points, fitting->body->mesh().points);
  Workers workers(1);
  const auto nobody = pressedFrame(*snapshotOf(fitting->document, nullptr), workers);
  ASSERT_FALSE(nobody);
  EXPECT_EQ(text(nobody.error().what), "There is no figure to be pressed on; choose one: body size=eu38.");
}

TEST(Fit, TheTopOfAScaleIsRound) {
  std::vector<float> values(200, 0.03f);
  values.push_back(-1);
  values.push_back(9);  // one in a hundred may lie beyond
  EXPECT_DOUBLE_EQ(roundTop(values, 0.001), 0.05);
  EXPECT_DOUBLE_EQ(roundTop(values, 0.1), 0.1);
  EXPECT_EQ(roundTop({-1, 0}, 0.1), 0);
}

}  // namespace
}  // namespace karinui
