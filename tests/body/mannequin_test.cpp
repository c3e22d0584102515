#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <span>

#include "body/anthropometry/contour.h"
#include "karinui/body/body.h"
#include "karinui/body/sizes.h"
#include "karinui/geometry/section.h"
#include "soak.h"

namespace karinui {
namespace {

BodyPtr made(const Measurements& wanted, int threads = 1, MannequinEnds ends = MannequinEnds::Modelled) {
  Workers workers(threads);
  const Token token;
  auto body = makeMannequin(wanted, workers, token, ends);
  EXPECT_TRUE(body) << text(body.error().what);
  return body ? *body : nullptr;
}

Measurements sizeNamed(const std::string& name) {
  if (name == "large")
    return {Sex::Female, {{"bust_girth", 1.16}, {"waist_girth", 1.02}, {"hip_girth", 1.22}, {"height", 1.66}}};
  return builtInSize(name).value();
}

BodyPtr kept(const std::string& name) {  // made once for all tests of this program
  static std::map<std::string, BodyPtr> bodies;
  if (!bodies.contains(name)) bodies[name] = made(sizeNamed(name));
  return bodies[name];
}

void meets(const Measurements& wanted, const Body& body) {
  const Measurements measured = measure(body.mesh(), body.bvh());
  for (const auto& [key, value] : wanted.value)
    EXPECT_NEAR(measured.value.at(key), value, key.ends_with("_girth") ? 0.003 : 0.005) << key;
  const MeshReport report = inspect(body.mesh());
  EXPECT_TRUE(report.closed() && report.outward);
  EXPECT_EQ(report.shells, 1u);
  EXPECT_EQ(report.selfCrossings, 0u);
  EXPECT_EQ(report.points + report.triangles - report.triangles * 3 / 2, 2u);  // genus 0
  EXPECT_GE(report.triangles, 10000u);
  EXPECT_LE(report.triangles, 50000u);
  double low = 1;
  for (const Vec3& p : body.mesh().points) low = std::min(low, p.y);
  EXPECT_NEAR(low, 0, 1e-9);
  EXPECT_NEAR(measured.value.at("arm_angle") * 180 / M_PI, 46, 6);
}

class Sizes : public testing::TestWithParam<const char*> {};

TEST_P(Sizes, MeetTheTapeOnASoundMesh) {
  const BodyPtr body = kept(GetParam());
  ASSERT_TRUE(body);
  meets(sizeNamed(GetParam()), *body);
  for (const char* key : {"height",      "bust_girth",      "under_bust_girth", "waist_girth",    "hip_girth",
                          "neck_girth",  "upper_arm_girth", "wrist_girth",      "thigh_girth",    "knee_girth",
                          "calf_girth",  "ankle_girth",     "arm_length",       "crotch_height",  "waist_height",
                          "bust_height", "hip_height",      "armpit_height",    "shoulder_width", "back_waist_length"})
    EXPECT_TRUE(body->measured().value.contains(key)) << key;
}

TEST_P(Sizes, APlaceIsFoundAgainFromItsDescription) {
  const BodyPtr body = kept(GetParam());
  ASSERT_TRUE(body);
  std::mt19937_64 random(7);
  std::size_t named = 0, tried = 0;
  for (int i = 0; i < 400; ++i, ++tried) {
    const auto face = static_cast<std::uint32_t>(random() % body->mesh().faces.size());
    const SurfacePoint place{face, {0.2, 0.3, 0.5}};
    const BodyPoint point = body->describe(place);
    named += point.part != BodyPoint::Part::Face;
    const auto parsed = parseBodyPoint(text(point));
    ASSERT_TRUE(parsed) << text(point);
    EXPECT_EQ(text(*parsed), text(point));
    const auto found = body->find(*parsed);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(at(body->mesh(), *found), at(body->mesh(), place)), 0.001) << text(point);
  }
  EXPECT_GT(named, tried * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(Body, Sizes, testing::Values("jis9ar", "eu38", "eu50", "large", "child110"));

class EachSizeOf : public testing::TestWithParam<SizeSystem> {};

TEST_P(EachSizeOf, MeetsTheTape) {
  for (const SizeSeries& series : sizeSeries()) {
    if (series.system != GetParam()) continue;
    for (const BuiltInSize& size : series.sizes) {
      SCOPED_TRACE(size.name);
      const BodyPtr body = made(*builtInSize(size.name));
      ASSERT_TRUE(body);
      meets(*builtInSize(size.name), *body);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Body, EachSizeOf,
                         testing::Values(SizeSystem::JisWomen, SizeSystem::EuWomen, SizeSystem::EuMen,
                                         SizeSystem::JisMen, SizeSystem::Misses, SizeSystem::Children));

TEST(Mannequin, LimbGirthsAndLengthsAskedForAreMet) {
  const Measurements wanted{Sex::Female,
                            {{"height", 1.68},
                             {"bust_girth", 0.9},
                             {"waist_girth", 0.73},
                             {"hip_girth", 0.98},
                             {"neck_girth", 0.355},
                             {"upper_arm_girth", 0.29},
                             {"wrist_girth", 0.162},
                             {"calf_girth", 0.36},
                             {"arm_joint_length", 0.49},
                             {"shoulder_width", 0.38}}};
  const BodyPtr body = made(wanted);
  ASSERT_TRUE(body);
  meets(wanted, *body);
}

// JIS L 4002: a child of five, 110 cm high.
TEST(Mannequin, AChildIsMade) {
  const Measurements wanted{Sex::Female,
                            {{"height", 1.10},
                             {"bust_girth", 0.57},
                             {"waist_girth", 0.52},
                             {"hip_girth", 0.61},
                             {"crotch_height", 0.48},
                             {"neck_girth", 0.26},
                             {"arm_length", 0.35},
                             {"shoulder_width", 0.27}}};
  const BodyPtr body = made(wanted);
  ASSERT_TRUE(body);
  meets(wanted, *body);
  EXPECT_TRUE(inspect(body->mesh()).closed());
  Workers workers(1);
  const auto infant = makeMannequin({Sex::Female, {{"height", 0.8}}}, workers, Token{});
  ASSERT_FALSE(infant);
  EXPECT_NE(text(infant.error().what).find("110.0 cm"), std::string::npos) << text(infant.error().what);
}

// Shares of the height that tell a child of five from an adult, and that grow into an adult's.
TEST(Mannequin, AChildHasAChildsProportions) {
  const auto share = [](const BodyPtr& of, const char* key) {
    return of->measured().value.at(key) / of->measured().value.at("height");
  };
  const BodyPtr small = kept("child110"), adult = kept("eu50");
  ASSERT_TRUE(small && adult);
  EXPECT_EQ(small->measured().sex, Sex::Child);
  EXPECT_NEAR(share(small, "crotch_height"), 0.44, 0.012) << "JIS L 4002: 48 cm of 110";
  EXPECT_LT(share(small, "neck_height"), share(adult, "neck_height") - 0.03) << "a larger head";
  EXPECT_NEAR(small->measured().value.at("arm_length"), 0.35, 0.015);
  EXPECT_NEAR(small->measured().value.at("shoulder_width"), 0.27, 0.015);
  EXPECT_NEAR(small->measured().value.at("neck_girth"), 0.265, 0.006);
  EXPECT_LT(small->measured().value.at("bust_girth") - small->measured().value.at("waist_girth"), 0.05);
  double before = share(small, "neck_height");
  for (const double height : {1.24, 1.38, 1.52}) {
    const BodyPtr body = made({Sex::Child, {{"height", height}}});
    ASSERT_TRUE(body);
    const double now = share(body, "neck_height");
    EXPECT_GT(now, before) << height;
    before = now;
  }
}

// Everything measured on a real figure, asked for at once.
class WholePeople : public testing::TestWithParam<const char*> {};

TEST_P(WholePeople, AreMadeFromAllTheirMeasurements) {
  const std::string file = std::string(KARINUI_SHARED_DIR) + "/bodies/" + GetParam() + ".json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared bodies are not here";
  std::ifstream in(file);
  const auto known = nlohmann::json::parse(in);
  Measurements wanted{known.at("sex") == "male" ? Sex::Male : Sex::Female, {}};
  for (const auto& [name, centimetres] : known.at("measured_cm").items()) {
    // Where exactly the hip is widest, and how wide the joints stand, is measured only.
    if (name == "hips_height" || name == "shoulder_joint_width" || name.starts_with("arm_angle")) continue;
    const std::string key = name == "arm_length" ? "arm_joint_length" : measurementKey(name).value();
    wanted.value[key] = centimetres.get<double>() / 100;
  }
  EXPECT_EQ(wanted.value.size(), 17u);
  const BodyPtr body = made(wanted);
  ASSERT_TRUE(body);
  meets(wanted, *body);
}

INSTANTIATE_TEST_SUITE_P(Body, WholePeople, testing::Values("f_eu38", "f_jis9ar", "f_plus", "m_eu50", "m_tall"));

// Each key a mannequin can be made to is asked for once, away from where it would lie by itself: up and down in turn.
// A belly has its own test.
TEST(Mannequin, EveryKeyCanBeAskedFor) {
  const BodyPtr usual = kept("eu38");
  ASSERT_TRUE(usual);
  constexpr std::size_t kSets = 3;
  std::vector<Measurements> sets(kSets, sizeNamed("eu38"));
  std::size_t turn = 0;
  for (const auto key : mannequinKeys()) {
    if (key == "height" || key == "arm_joint_length" || key == "belly_girth" ||
        sets[0].value.contains(std::string(key)))
      continue;
    const double by = (key.ends_with("_girth") ? 0.03 : 0.012) * (turn / kSets % 2 ? -1 : 1);
    sets[turn++ % kSets].value[std::string(key)] = usual->measured().value.at(std::string(key)) * (1 + by);
  }
  for (const Measurements& wanted : sets)
    if (const BodyPtr body = made(wanted)) meets(wanted, *body);
}

TEST(Mannequin, ABellyStandsOutInFront) {
  const BodyPtr usual = kept("eu38");
  ASSERT_TRUE(usual);
  Measurements wanted = withOwn(sizeNamed("eu38"), {{"belly_girth", 0.98}});
  EXPECT_FALSE(wanted.value.contains("waist_girth")) << "the size's waist is not hers";
  const BodyPtr body = made(wanted);
  ASSERT_TRUE(body);
  meets(wanted, *body);
  const auto said = [](const BodyPtr& of, const char* key) { return of->measured().value.at(key); };
  EXPECT_GT(said(body, "belly_height"), said(body, "hip_height") + 0.05);
  EXPECT_LT(said(body, "belly_height"), said(body, "under_bust_height"));
  const auto depths = [](const BodyPtr& of, double y) {
    Interval z;
    for (const SectionLoop& loop : section(of->mesh(), {{0, y, 0}, {0, 1, 0}}))
      for (const Vec3& p : loop.points)
        if (std::abs(p.x) < 0.01) z.include(p.z);
    return z;
  };
  const double level = said(body, "belly_height");
  const Interval now = depths(body, level), before = depths(usual, level);
  EXPECT_GT(now.high - before.high, 0.06) << "in front";
  EXPECT_LT(std::abs(now.low - before.low), 0.015) << "not behind";
  // The foremost level is what the tape says it is.
  for (const double off : {-0.03, 0.03}) EXPECT_LT(depths(body, level + off).high, now.high + 1e-6);
  // On a body that is only measured, too; an ordinary front is no belly.
  EXPECT_NEAR(measure(body->mesh(), body->bvh()).value.at("belly_girth"), 0.98, 0.003);
  EXPECT_FALSE(measure(usual->mesh(), usual->bvh()).value.contains("belly_girth"));
  // Asked for as it is anyway, it changes nothing.
  Measurements same = sizeNamed("eu38");
  same.value["belly_girth"] = said(usual, "belly_girth");
  if (const BodyPtr again = made(same)) {
    EXPECT_NEAR(said(again, "belly_girth"), said(usual, "belly_girth"), 0.003);
    EXPECT_NEAR(said(again, "waist_height"), said(usual, "waist_height"), 0.015);
  }
  // Not farther than a figure carries it.
  EXPECT_FALSE(plausible(withOwn(sizeNamed("eu38"), {{"belly_girth", 1.30}})));
  // A man's, wider than his chest and his hips.
  Measurements stout{Sex::Male, {{"height", 1.76}, {"bust_girth", 1.10}, {"belly_girth", 1.18}, {"hip_girth", 1.08}}};
  if (!atLength()) return;
  if (const BodyPtr man = made(stout)) meets(stout, *man);
}

TEST(Mannequin, AQuarrelNamesBothAndTheRange) {
  Measurements wanted = sizeNamed("eu38");
  wanted.value["crotch_height"] = 0.80;
  wanted.value["thigh_girth"] = 0.70;  // plausible for its hip, yet no room between the legs up to that crotch
  Workers workers(1);
  const Token token;
  const auto body = makeMannequin(wanted, workers, token);
  ASSERT_FALSE(body);
  const std::string said = text(body.error().what);
  EXPECT_NE(said.find("thigh_girth"), std::string::npos) << said;
  EXPECT_NE(said.find("do not go together"), std::string::npos) << said;
  EXPECT_TRUE(said.find("at most") != std::string::npos || said.find("at least") != std::string::npos) << said;
}

// A waist that is stated too wide: it is the girth under the bust that stands in its way.
TEST(Mannequin, AQuarrelFarOffNamesBoth) {
  Workers workers(1);
  const Token token;
  const Measurements wanted{
      Sex::Female,
      {{"height", 1.65}, {"bust_girth", 0.84}, {"under_bust_girth", 0.80}, {"waist_girth", 0.92}, {"hip_girth", 0.90}}};
  const auto body = makeMannequin(wanted, workers, token);
  ASSERT_FALSE(body);
  const std::string said = text(body.error().what);
  EXPECT_NE(said.find("waist_girth 92.0 cm and under_bust_girth 80.0 cm do not go together"), std::string::npos)
      << said;
}

// Girths that no body has together are those that were stated, and the one that is in the way of all others is named.
TEST(Mannequin, GirthsOfNoBodyAreNamed) {
  Workers workers(1);
  const Token token;
  const auto said = [&](Measurements wanted) {
    const auto body = makeMannequin(wanted, workers, token);
    return body ? std::string() : text(body.error().what);
  };
  EXPECT_EQ(said({Sex::Female,
                  {{"height", 1.68},
                   {"bust_girth", 0.92},
                   {"under_bust_girth", 0.45},
                   {"waist_girth", 0.74},
                   {"hip_girth", 0.98}}}),
            "These girths do not belong to one body: bust 92.0 cm, under the bust 45.0 cm, waist 74.0 cm, hip 98.0 cm "
            "at a height of 168.0 cm. Without under the bust 45.0 cm they would; check that number first.");
}

// The arms of a stout figure, as it is drawn first, lie in its trunk. EN 13402 has women of this size.
TEST(Mannequin, StoutFiguresAreMade) {
  const auto woman = [](double height, double bust, double waist, double hip) {
    return Measurements{Sex::Female,
                        {{"height", height}, {"bust_girth", bust}, {"waist_girth", waist}, {"hip_girth", hip}}};
  };
  for (const Measurements& wanted :
       {woman(1.68, 1.34, 1.19, 1.37), woman(1.65, 1.30, 1.18, 1.34), woman(1.72, 1.50, 1.40, 1.52)}) {
    if (const BodyPtr body = made(wanted)) meets(wanted, *body);
    if (!atLength()) break;
  }
}

Measurements ofGirths(Sex sex, double height, double bust, double waist, double hip) {
  return {sex, {{"height", height}, {"bust_girth", bust}, {"waist_girth", waist}, {"hip_girth", hip}}};
}

// Whose waist is as wide as the hip carries it in front.
TEST(Mannequin, AWaistAsWideAsTheHipIsABellys) {
  for (const Measurements& wanted :
       {ofGirths(Sex::Male, 1.78, 1.08, 1.12, 1.10), ofGirths(Sex::Female, 1.65, 1.10, 1.04, 1.04),
        ofGirths(Sex::Male, 1.78, 1.32, 1.30, 1.28)}) {
    if (const BodyPtr body = made(wanted)) {
      meets(wanted, *body);
      const auto& at = body->landmarks();
      ASSERT_TRUE(at.contains("waist_front") && at.contains("hip_front"));
      EXPECT_GT(at.at("waist_front").z, at.at("hip_front").z);
    }
    if (!atLength()) break;
  }
}

// The hip is the seat's, not the under side of a belly as wide; the bust lies where it usually does, not on a shelf of
// the ribs; the waist of a woman with a belly lies above it.
TEST(Mannequin, AStoutFigureHasSeatBustAndWaist) {
  for (const Measurements& wanted :
       {ofGirths(Sex::Male, 1.76, 1.20, 1.25, 1.18), ofGirths(Sex::Female, 1.65, 1.20, 1.15, 1.22),
        ofGirths(Sex::Female, 1.60, 1.24, 1.18, 1.18)}) {
    const BodyPtr body = made(wanted);
    if (!body) continue;
    meets(wanted, *body);
    const auto said = [&](const char* key) { return body->measured().value.at(key); };
    const double height = said("height");
    EXPECT_LT(said("hip_height"), said("crotch_height") + 0.03 * height);
    if (wanted.sex == Sex::Female) {
      EXPECT_GT(said("bust_height"), 0.70 * height);
      EXPECT_GT(said("waist_height"), 0.60 * height);
      EXPECT_GT(said("bust_girth"), said("under_bust_girth") + 0.03);
    }
    if (!atLength()) break;
  }
}

// Of a waist wider than the hip: no woman of such girths could be made.
TEST(Mannequin, AWomansWaistMayBeWiderThanHerHip) {
  for (const Measurements& wanted :
       {ofGirths(Sex::Female, 1.65, 1.30, 1.28, 1.24), ofGirths(Sex::Female, 1.65, 1.20, 1.20, 1.18),
        ofGirths(Sex::Female, 1.68, 1.40, 1.35, 1.28), ofGirths(Sex::Female, 1.58, 1.10, 1.12, 1.06)}) {
    const BodyPtr body = made(wanted);
    if (!body) continue;
    meets(wanted, *body);
    const auto said = [&](const char* key) { return body->measured().value.at(key); };
    EXPECT_GT(said("bust_girth"), said("under_bust_girth") + 0.03);
    EXPECT_GT(said("bust_height"), 0.68 * said("height"));
    if (!atLength()) break;
  }
}

// Wider than bust and hip, it is a belly's girth, and the figure can be made so.
TEST(Mannequin, AWaistThatIsABellysIsToldApart) {
  if (!atLength()) GTEST_SKIP() << "./test --long";
  Workers workers(2);
  Measurements woman = ofGirths(Sex::Female, 1.55, 1.00, 1.02, 0.99);
  const auto none = makeMannequin(woman, workers, Token());
  ASSERT_FALSE(none);
  const std::string said = text(none.error().what);
  EXPECT_NE(said.find("state it as belly_girth in its place"), std::string::npos) << said;
  woman.value["belly_girth"] = 1.02;
  woman.value.erase("waist_girth");
  if (const BodyPtr body = made(woman)) meets(woman, *body);
}

// Arms that are thick enough to lie at the trunk, where the tape jumps from grid to grid, are no quarrel.
TEST(Mannequin, ThickArmsOfAStoutFigureAreMade) {
  for (const double arm : {0.40, 0.39}) {
    const Measurements wanted{
        Sex::Female,
        {{"height", 1.60}, {"bust_girth", 1.20}, {"waist_girth", 1.06}, {"hip_girth", 1.26}, {"upper_arm_girth", arm}}};
    if (const BodyPtr body = made(wanted)) meets(wanted, *body);
    if (!atLength()) break;
  }
}

// The number that is told is one that can be made.
TEST(Mannequin, TheNearestThatIsToldCanBeMade) {
  Workers workers(1);
  const Token token;
  for (Measurements wanted :
       {Measurements{Sex::Female, {{"height", 1.50}, {"bust_girth", 1.30}}},
        Measurements{Sex::Female,
                     {{"height", 1.50}, {"bust_girth", 1.20}, {"waist_girth", 1.10}, {"hip_girth", 1.25}}}}) {
    const auto body = makeMannequin(wanted, workers, token);
    if (body) continue;
    const Message& told = body.error().what;
    ASSERT_GE(told.values.size(), 3u) << text(told);
    const std::string said = text(told);
    const std::string key = text(told.values[0]);
    std::smatch number;
    ASSERT_TRUE(std::regex_search(said, number, std::regex("(?:has|at most|at least) ([0-9.]+)"))) << said;
    wanted.value[key] = std::stod(number[1]) / 100;
    const auto nearest = makeMannequin(wanted, workers, token);
    EXPECT_TRUE(nearest) << said << " But: " << text(nearest.error().what);
  }
}

TEST(Mannequin, RandomPlausiblePeopleAreMet) {
  std::mt19937_64 random(11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 10001) / 10000;
  };
  for (int i = 0; i < 3; ++i) {
    Measurements wanted{i % 2 ? Sex::Male : Sex::Female, {}};
    const double height = wanted.value["height"] = between(1.55, 1.88), wide = between(0, 1);
    const bool female = wanted.sex == Sex::Female;
    wanted.value["bust_girth"] = height * ((female ? 0.51 : 0.54) + 0.10 * wide);
    wanted.value["waist_girth"] = height * ((female ? 0.40 : 0.43) + 0.10 * wide);
    wanted.value["hip_girth"] = height * ((female ? 0.56 : 0.54) + 0.08 * wide);
    const BodyPtr body = made(wanted);
    ASSERT_TRUE(body);
    meets(wanted, *body);
  }
}

TEST(Mannequin, SameBitsForAnyNumberOfThreads) {
  EXPECT_EQ(kept("jis9ar")->hash(), made(sizeNamed("jis9ar"), 2)->hash());
  // Of one whose girths pull at each other the figures beside it are made on all threads at once.
  Measurements tailored = sizeNamed("eu38");
  tailored.value["thigh_girth"] = 0.56, tailored.value["crotch_height"] = 0.76;
  EXPECT_EQ(made(tailored)->hash(), made(tailored, 3)->hash());
}

TEST(Mannequin, ACancelledOneIsNotMade) {
  Workers workers(1);
  Token token;
  token.cancel();
  const auto body = makeMannequin(sizeNamed("eu38"), workers, token);
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().kind, Error::Kind::Cancelled);
}

TEST(Mannequin, TheNeckEndsInItsShoulders) {
  for (const char* size : {"jis9ar", "eu38", "large"}) {
    const BodyPtr body = kept(size);
    ASSERT_TRUE(body) << size;
    const auto& m = body->measured().value;
    EXPECT_GT(m.at("shoulder_length"), 0.10) << size;
    EXPECT_LT(m.at("shoulder_length"), 0.18) << size;
    EXPECT_NEAR(m.at("shoulder_slope"), 0.42, 0.14) << size;  // 16 to 32 degrees
    for (const char* name : {"neck_left", "neck_right"}) {
      const Vec3 p = body->landmarks().at(name);
      EXPECT_GT(p.y, m.at("shoulder_height")) << size;
      EXPECT_LT(p.y, m.at("neck_height")) << size << ": not on the head";
    }
  }
}

// A man's chest is widest right under the armpit. What is named at or under the armpit's level is on his trunk all the
// same, not across the arm.
TEST(Mannequin, WhatIsNamedUnderTheArmpitIsOnTheTrunk) {
  const Measurements slim{Sex::Male,
                          {{"height", 1.78}, {"bust_girth", 0.88}, {"waist_girth", 0.75}, {"hip_girth", 0.92}}};
  for (const BodyPtr& body : {kept("eu38"), kept("eu50"), made(slim)}) {
    ASSERT_TRUE(body);
    const double armpit = body->measured().value.at("armpit_height"),
                 gap = body->landmarks().at("armpit_left").x;  // between trunk and arm
    for (const char* along : {"bust", "bust+0.5", "armpit-0.3", "armpit"})
      for (const char* around : {"0.23", "0.25", "0.27", "0.73", "0.75", "0.77"}) {
        const std::string name = std::string("torso:") + along + "@" + around;
        const auto place = body->find(*parseBodyPoint(name));
        ASSERT_TRUE(place) << name;
        const Vec3 p = at(body->mesh(), *place);
        EXPECT_LT(std::abs(p.x), gap + 0.015) << name;
        EXPECT_LT(p.y, armpit + 0.012) << name;  // before and behind the fold a little higher
        EXPECT_GT(p.y, armpit - 0.05) << name;
      }
  }
}

TEST(Mannequin, TheSamePlaceOnAnotherBody) {
  const BodyPtr a = kept("jis9ar"), b = kept("large");
  ASSERT_TRUE(a && b);
  for (const BodyPtr& body : {a, b}) {
    const auto waist = body->find(parseBodyPoint("torso:waist@0").value());
    const auto bust = body->find(parseBodyPoint("torso:bust@0.07").value());
    const auto left = body->find(parseBodyPoint("torso:waist@0.25").value());
    ASSERT_TRUE(waist && bust && left);
    EXPECT_NEAR(at(body->mesh(), *waist).y, body->measured().value.at("waist_height"), 0.03);
    EXPECT_GT(at(body->mesh(), *bust).y, at(body->mesh(), *waist).y + 0.08);
    EXPECT_GT(at(body->mesh(), *left).x, 0.08);
    const BodyPoint elbow = parseBodyPoint("left_arm:elbow@0.1").value();
    const auto here = body->find(elbow), there = body->find(body->mirrored(elbow).value());
    ASSERT_TRUE(here && there);
    const Vec3 p = at(body->mesh(), *here), q = at(body->mesh(), *there);
    EXPECT_LT(distance({-p.x, p.y, p.z}, q), 0.002);
    for (const char* name : {"shoulder_left", "neck_front", "neck_back", "neck_left", "armpit_left", "bust_left",
                             "crotch", "elbow_left", "wrist_left", "knee_left", "ankle_left", "waist_front"})
      EXPECT_TRUE(body->find(parseBodyPoint(std::string("landmark:") + name).value())) << name;
  }
}

// What is described on one figure and found on another lies where it should: beside the same landmark.
TEST(Mannequin, ALandmarkDescribedOnOneLiesAtTheOthers) {
  // Within a centimetre among women; between a woman and the man shoulders and knees sit a little differently around
  // the bone, and a man's foremost chest is no bust point. Under a child's flat chest the levels of bust and armpit
  // nearly fall together, and where its neck ends is hardly seen.
  static constexpr std::array sizes{"jis9ar",   "eu38",     "eu50",     "jis92a5",
                                    "misses12", "child110", "child128", "child146"};
  std::size_t tried = 0;
  for (const auto from : sizes)
    for (const auto to : sizes) {
      const BodyPtr a = kept(std::string(from)), b = kept(std::string(to));
      ASSERT_TRUE(a && b);
      const bool alike = a->measured().sex == b->measured().sex,
                 child = a->measured().sex == Sex::Child || b->measured().sex == Sex::Child;
      const double apart = child ? (alike ? 0.030 : 0.036) : alike ? 0.010 : 0.025;
      for (const auto& [name, place] : a->landmarks()) {
        if (!alike && name.starts_with("bust_")) continue;
        const BodyPoint point = a->describe(a->bvh().nearest(place)->place);
        if (point.part == BodyPoint::Part::Face) continue;
        const auto found = b->find(point);
        ASSERT_TRUE(found) << name << " " << text(point);
        EXPECT_LT(distance(at(b->mesh(), *found), b->landmarks().at(name)), apart)
            << name << " of " << from << " on " << to << ": " << text(point);
        ++tried;
      }
    }
  EXPECT_GT(tried, sizes.size() * sizes.size() * 25);
}

// A level of the body's chart: its middle and where it looks, by the level's number (the torso's twelve come first).
Plane levelOf(const Body& body, std::size_t level) {
  const auto numbers = body.chartNumbers();  // the height, then each level's middle and normal
  const double* at = &numbers[1 + 6 * level];
  return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
}
constexpr std::size_t kWrist = 12 + 3, kTip = 12 + 4;

// Between neck, wrists and ankles the modelled figure is the drawn one, point for point and face for face: whatever was
// drafted on it keeps its place.
TEST(Mannequin, HeadHandsAndFeetLeaveTheRestAsItWas) {
  for (const char* size : {"jis9ar", "eu50"}) {
    const BodyPtr body = kept(size), drawn = made(sizeNamed(size), 1, MannequinEnds::Drawn);
    ASSERT_TRUE(body && drawn);
    EXPECT_EQ(body->measured(), drawn->measured());
    EXPECT_EQ(body->landmarks(), drawn->landmarks());
    EXPECT_EQ(body->chartNumbers(), drawn->chartNumbers());
    const Plane wrist = levelOf(*drawn, kWrist);
    const double neck = drawn->measured().value.at("neck_front_height"),
                 ankle = drawn->measured().value.at("ankle_height");
    const auto between = [&](Vec3 p) {
      p.x = std::abs(p.x);
      const bool hand = distance(p, wrist.through) < 0.3 && dot(p - wrist.through, wrist.normal) > 0;
      return p.y < neck && p.y > ankle && !hand;
    };
    const auto places = [&](const TriangleMesh& mesh) {  // of the faces between, in order
      std::vector<std::array<double, 9>> all;
      for (const Triangle& f : mesh.faces)
        if (const Vec3 a = mesh.points[f[0]], b = mesh.points[f[1]], c = mesh.points[f[2]];
            between(a) && between(b) && between(c))
          all.push_back({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
      return all;
    };
    const auto before = places(drawn->mesh());
    EXPECT_GT(before.size(), drawn->mesh().faces.size() * 3 / 4);
    EXPECT_EQ(places(body->mesh()), before) << size;
    EXPECT_NE(body->mesh().points.size(), drawn->mesh().points.size()) << size;
  }
}

// The closed lines of the left hand, cut across at a share of its length from wrist to fingertip.
std::vector<SectionLoop> acrossHand(const Body& body, double share, Vec3& normal) {
  const Vec3 wrist = levelOf(body, kWrist).through, tip = levelOf(body, kTip).through;
  normal = normalized(tip - wrist);
  auto loops = section(body.mesh(), {lerp(wrist, tip, share), normal});
  std::erase_if(loops, [&](const SectionLoop& l) { return distance(l.points[0], wrist) > 0.3; });
  return loops;
}

TEST(Mannequin, FingersLieTogetherAndTheThumbStandsApart) {
  for (const char* size : {"jis9ar", "eu50", "large"}) {
    const BodyPtr body = kept(size);
    ASSERT_TRUE(body);
    Vec3 normal;
    EXPECT_EQ(acrossHand(*body, 0.3, normal).size(), 1u) << size;
    EXPECT_EQ(acrossHand(*body, 0.56, normal).size(), 2u) << size;
    const auto fingers = acrossHand(*body, 0.72, normal);
    ASSERT_EQ(fingers.size(), 1u) << size << ": no gap that catches a thread";
    const double skin = lineLength(fingers[0].points, true), tape = tightTapeLength(fingers[0].points, normal);
    EXPECT_GT(skin, 1.01 * tape) << size << ": grooves between the fingers";
  }
}

TEST(Mannequin, TheNoseIsTheForemostOfTheFaceAndTheChinStandsBeforeTheNeck) {
  for (const char* size : {"jis9ar", "eu50", "large"}) {
    const BodyPtr body = kept(size);
    ASSERT_TRUE(body);
    const double height = body->measured().value.at("height");
    Vec3 nose{0, 0, -1}, beside{0, 0, -1}, chin{0, 0, -1};
    for (const Vec3& p : body->mesh().points) {
      const double share = p.y / height;
      if (share > 0.9 && p.z > nose.z) nose = p;
      if (share > 0.9 && share < 0.95 && std::abs(p.x) > 0.02 && p.z > beside.z) beside = p;
      if (share > 0.875 && share < 0.89 && p.z > chin.z) chin = p;
    }
    EXPECT_LT(std::abs(nose.x), 0.008) << size;
    EXPECT_GT(nose.z, beside.z + 0.009) << size << ": a ridge, where a drawn head has 5 or 6 mm";
    EXPECT_LT(std::abs(chin.x), 0.02) << size;
    EXPECT_GT(chin.z, body->landmarks().at("neck_front").z + 0.03) << size;
  }
}

// From the nose to the chin the profile has no hollow, and below the chin no second one stands out.
TEST(Mannequin, TheProfileIsCalm) {
  for (const char* size : {"jis9ar", "eu50", "child110"}) {
    const BodyPtr body = kept(size);
    ASSERT_TRUE(body);
    const double height = body->measured().value.at("height"), neck = body->landmarks().at("neck_front").y;
    std::vector<Vec3> face;
    for (const SectionLoop& loop : section(body->mesh(), {{0.0005, 0, 0}, {1, 0, 0}}))
      for (const Vec3& p : loop.points)
        if (p.y > neck && p.y < 0.97 * height && p.z > body->landmarks().at("neck_front").z - 0.02) face.push_back(p);
    std::sort(face.begin(), face.end(), [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
    const auto nose = std::max_element(face.begin(), face.end(), [](auto& a, auto& b) { return a.z < b.z; });
    const auto leaning = [&](const Vec3& p) { return p.z - 0.3 * p.y; };  // the chin: where a line under it touches
    const auto chin =
        std::max_element(face.begin(), nose - 4, [&](auto& a, auto& b) { return leaning(a) < leaning(b); });
    double hollow = 0, second = 0;
    for (auto at = chin; at != nose; ++at)
      hollow = std::max(hollow, std::lerp(chin->z, nose->z, (at->y - chin->y) / (nose->y - chin->y)) - at->z);
    double back = HUGE_VAL;
    for (auto at = std::make_reverse_iterator(chin); at != face.rend(); ++at)
      second = std::max(second, at->z - back), back = std::min(back, at->z);
    EXPECT_LT(hollow, 0.006) << size;
    EXPECT_LT(second, 0.002) << size;
  }
}

// Children, pregnant and round figures: people far from the middle of what was described.
TEST(Mannequin, FiguresFarFromTheUsualHaveHandsToo) {
  const Measurements people[] = {
      {Sex::Female, {{"height", 1.32}, {"bust_girth", 0.66}, {"waist_girth", 0.59}, {"hip_girth", 0.71}}},
      {Sex::Female, {{"height", 1.65}, {"bust_girth", 1.02}, {"waist_girth", 0.99}, {"hip_girth", 1.06}}},
      {Sex::Male, {{"height", 1.75}, {"bust_girth", 1.18}, {"waist_girth", 1.14}, {"hip_girth", 1.18}}}};
  for (const Measurements& wanted : std::span(people).first(atLength() ? 3 : 1))
    if (const BodyPtr body = made(wanted)) {
      meets(wanted, *body);
      Vec3 normal;
      EXPECT_EQ(acrossHand(*body, 0.56, normal).size(), 2u);
    }
}

TEST(BodyPoint, BadTextIsRefusedWithASentence) {
  for (const char* bad :
       {"", "torso", "torso:", "torso:waist", "torso:wasit@0", "torso:99@0", "torso:-1@0", "torso:waist@x", "tail:1@0",
        "landmark:", "landmark:A B", "face:1", "face:-1@0,0", "face:1@0.9,0.9", "torso:nan@0", "torso:1@inf"})
    EXPECT_FALSE(parseBodyPoint(bad)) << bad;
  EXPECT_DOUBLE_EQ(parseBodyPoint("torso:waist+0.5@1.25")->along, 3.5);
  EXPECT_DOUBLE_EQ(parseBodyPoint("torso:waist+0.5@1.25")->around, 0.25);
}

}  // namespace
}  // namespace karinui
