// What is too small is told before it is draped; what is tight is sewn up where it stands.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "design/draping_room.h"
#include "karinui/base/number.h"
#include "karinui/cloth/girth_check.h"

namespace karinui {
namespace {

// Two rectangles before and behind the figure, from 64 cm above the floor up, sewn at both sides unless `open`.
std::string tube(double halfWidth, const std::string& fabric, bool open = false, double length = 0.6) {
  const std::string w = fixed(1000 * halfWidth, 4), h = fixed(1000 * length, 0);
  const std::string outline =
      "M -" + w + " 0; hem L " + w + " 0; left L " + w + " " + h + "; top L -" + w + " " + h + "; right L -" + w + " 0";
  std::string script = "body size=eu38\nset spacing=16mm\npiece name=front fabric=" + fabric + " outline=\"" + outline +
                       "\" pose=\"0,0.64,0.25\"\npiece name=back fabric=" + fabric + " outline=\"" + outline +
                       "\" pose=\"0,0.64,-0.22 y 180deg\"\nsew a=front.left b=back.right\n";
  return open ? script : script + "sew a=front.right b=back.left\n";
}
Document played(const std::string& script) {
  Document document;
  const auto lines = parseScript(script);
  EXPECT_TRUE(lines) << text(lines.error().what);
  for (const ScriptLine& line : *lines) {
    auto next = apply(document, line.operation, drapingRoom().context);
    EXPECT_TRUE(next) << text(next.error().what);
    if (next) document = *std::move(next);
  }
  return document;
}
std::optional<GirthLoop> tightest(const Document& document) {
  const auto stands = standingCloth(document, livePieces(document, {}));
  const auto body = bodyOf(document, drapingRoom().context);
  return tightestLoop(stands->cloth, stands->state, **body);
}

TEST(TightFit, ATubeIsAsLongRoundAsItsPiecesAreWide) {
  const double hip =
      bodyOf(played(tube(0.3, "cotton")), drapingRoom().context).value()->measured().value.at("hip_girth");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> widths(0.15, 0.32);
  for (int k = 0; k < 12; ++k) {
    const double half = widths(random);
    const auto loop = tightest(played(tube(half, "cotton")));
    ASSERT_TRUE(loop) << half;
    EXPECT_NEAR(loop->garment, 4 * half, 1e-4);
    EXPECT_NEAR(loop->body, hip, 0.01);
    const double tension = kMostPressure * loop->body / (2 * std::numbers::pi);
    EXPECT_NEAR(loop->stretched, 4 * half * (1 + preset("cotton")->weftCurve().strainAt(tension)), 2e-3);
    EXPECT_EQ(loop->tight(), 4 * half < loop->body);
  }
}

TEST(TightFit, OnlyWhatIsSewnUpAllRoundIsCompared) {
  EXPECT_FALSE(tightest(played(tube(0.15, "cotton", true))));
  // A sleeve goes round an arm, not round the trunk.
  EXPECT_FALSE(
      tightest(played("body size=eu38\npiece name=sleeve outline=\"M -150 0; wrist L 150 0; b L 150 300; cap L "
                      "-150 300; a L -150 0\" pose=\"0.45,0.9,0.1\"\nsew a=sleeve.a b=sleeve.b\n")));
}

TEST(TightFit, WhatIsTooSmallIsToldAndLeftAsItStands) {
  const Document before = played(tube(0.213, "cotton"));
  const Document after = played(tube(0.213, "cotton") + "drape\n");
  ASSERT_TRUE(after.drape.last);
  EXPECT_FALSE(after.drape.last->settled);
  EXPECT_EQ(after.drape.last->steps, 0u);
  const std::string why = text(after.drape.last->why);
  EXPECT_NE(why.find("Too small by 5 cm at the hip"), std::string::npos) << why;
  const auto stood = standingCloth(before, livePieces(before, {})),
             stands = standingCloth(after, livePieces(after, {}));
  for (std::size_t k = 0; k < stood->state.position.size(); ++k)
    EXPECT_LT(distance(stood->state.position[k], stands->state.position[k]), 1e-6);
}

// Closed without friction on the whole figure, the tube goes up by 20 cm and rolls up.
TEST(TightFit, ATubeOfJerseyStaysWhereItWasPutOn) {
  const Document document = played(tube(0.198, "jersey") + "drape\n");
  ASSERT_TRUE(document.drape.last);
  EXPECT_TRUE(document.drape.last->settled) << text(document.drape.last->why);
  const auto stands = standingCloth(document, livePieces(document, {}));
  const auto body = bodyOf(document, drapingRoom().context);
  const ClothCheck found = check(stands->cloth, stands->state, body->get());
  EXPECT_EQ(found.clothBodyCrossings + found.clothClothCrossings + found.foldCrossings, 0u);
  EXPECT_LE(found.penetration, 0.0005);
  EXPECT_LE(found.seamGap, 0.0005);
  EXPECT_GT(found.strain.mean, 0.05) << "it is stretched over the hip";
  double lowest = 1e9;
  for (const Vec3 p : stands->state.position) lowest = std::fmin(lowest, p.y);
  EXPECT_NEAR(lowest, 0.64, 0.03);
}

// Narrower than the body by a tenth all the way down, with nothing that holds them: cut too short in the crotch they
// were drawn over the hip and slid to the knees, hanging straight down they were sewn up beside the ankles.
TEST(TightFit, LeggingsStayUp) {
  for (const std::string figure :
       {"size=eu38", "size=eu50", "size=eu38 set=\"hip_girth=135cm; waist_girth=118cm; bust_girth=130cm\""}) {
    SCOPED_TRACE(figure);
    const Document document = played("body " + figure + "\nset spacing=13mm\nblock kind=leggings\ndrape\n");
    ASSERT_TRUE(document.drape.last);
    EXPECT_TRUE(document.drape.last->settled) << text(document.drape.last->why);
    EXPECT_EQ(document.pieceNamed("leg_back_left")->fabric, "jersey");
    const auto stands = standingCloth(document, livePieces(document, {}));
    const auto body = bodyOf(document, drapingRoom().context);
    const ClothCheck found = check(stands->cloth, stands->state, body->get());
    EXPECT_EQ(found.clothBodyCrossings + found.clothClothCrossings, 0u);
    EXPECT_LE(found.seamGap, 0.0005);
    EXPECT_GT(found.strain.mean, 0.03) << "stretched";
    EXPECT_LT(found.strain.max, 0.5);
    const auto& measured = (*body)->measured().value;
    double highest = 0, lowest = 1e9;
    for (const Vec3 p : stands->state.position) highest = std::fmax(highest, p.y), lowest = std::fmin(lowest, p.y);
    EXPECT_NEAR(highest, measured.at("waist_height"), 0.06);
    EXPECT_NEAR(lowest, measured.at("ankle_height"), 0.04);
  }
}

}  // namespace
}  // namespace karinui
