// A fly is sewn in one step, and hangs where it belongs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "karinui/design/piece_label.h"
#include "karinui/pattern/facing.h"

namespace karinui {
namespace {

const char* const kTrousers = "body size=eu38\nset spacing=20mm\nblock kind=trousers\n";

Document drapedWith(const std::string& fly) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played = drapingRoom().play(file, kTrousers + fly + "drape\n");
  EXPECT_TRUE(played) << text(played.error().what);
  return file.document();
}

// Draped once, the facing lies in the front and the shield behind it, on the other side of the zip, too.
TEST(Fly, LiesBehindItsZip) {
  const Document document = drapedWith("fly a=leg_front_left.crotch b=leg_front_right.crotch\n");
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("leg_front_left"), &facing = *document.pieceNamed("fly_facing"),
              &shield = *document.pieceNamed("fly_shield");
  EXPECT_GT(front.layer, facing.layer);
  EXPECT_GT(facing.layer, shield.layer);
  const Curve &edge = findEdge(front, "crotch")->curve, &inner = findEdge(facing, "inner")->curve;
  for (const double down : {0.03, 0.08, 0.13}) {
    const Flat at = edge.atFraction(down / edge.length()) + Flat{0.015, 0};
    expectWithin(document, facing, front, at);
    expectWithin(document, shield, front, at);
    expectWithin(document, shield, facing, at);
  }
  EXPECT_NEAR(distance(inner.atFraction(0.5), edge.atFraction(0.08 / edge.length())), 0.035, 0.02);
}

// Either side may lie over; the stitched line ends where the facing does, at one place of the edge.
TEST(Fly, MayLieOverFromTheRight) {
  const Document document = drapedWith("fly a=leg_front_right.crotch b=leg_front_left.crotch rows=0\n");
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("leg_front_right"), &shield = *document.pieceNamed("fly_shield");
  const Curve& edge = findEdge(front, "crotch")->curve;
  expectWithin(document, shield, front, edge.atFraction(1 - 0.08 / edge.length()) - Flat{0.015, 0});
  EXPECT_TRUE(document.allowances.topstitches.empty());
}

// The facing is as the front beside its edge, 1.5 cm longer than the zip; its seam line is where it is stitched on. The
// shield is larger by 5 mm, and cut twice.
TEST(Fly, HasItsPaper) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(
      file, std::string(kTrousers) + "fly a=leg_front_left.crotch b=leg_front_right.crotch length=14cm width=3cm\n"));
  const Document document = file.document();
  const Piece &front = *document.pieceNamed("leg_front_left"), &facing = *document.pieceNamed("fly_facing"),
              &shield = *document.pieceNamed("fly_shield");
  EXPECT_NEAR(findEdge(facing, "crotch")->curve.length(), 0.155, 1e-3);
  EXPECT_NEAR(findEdge(shield, "crotch")->curve.length(), 0.16, 1e-3);
  EXPECT_EQ(findCurve(front, "fly_line")->length(), findEdge(facing, "inner")->curve.length());
  EXPECT_EQ(document.allowances.topstitches.at({front.id, "fly_line"}).rows, 2);
  EXPECT_EQ(document.allowances.fastenings.at("fly").kind, FasteningKind::Zip);
  EXPECT_EQ(document.cutting.at(shield.id), (Cutting{2, true}));
  EXPECT_THAT(wornInsideOut(document.pattern), testing::ElementsAre(facing.id));
  EXPECT_THAT(laidWithin(document.pattern), testing::ElementsAre(facing.id, shield.id));
  // The seam below the zip stays sewn; a waistband goes on over the facing's upper edge.
  // It begins at the zip, wherever it is named from, with its lap there.
  std::string told;
  room.context.advise = [&](const Advice& advice) { told += text(advice.what); };
  const Done band = room.play(file,
                              "band name=waistband depth=4cm sew=yes extra=4cm of=\"leg_front_left.waist* "
                              "leg_front_right.waist* leg_back_right.waist* leg_back_left.waist*\"\n");
  EXPECT_TRUE(band) << text(band.error().what);
  EXPECT_EQ(told, "");
  const Document& banded = file.document();
  const auto sewn = std::find_if(banded.pattern.seams.begin(), banded.pattern.seams.end(), [&](const auto& seam) {
                      return seam.second.a.front().piece == banded.pieceNamed("waistband")->id;
                    })->second;
  EXPECT_EQ(sewn.b.front().piece, banded.pieceNamed("leg_front_right")->id);
  EXPECT_EQ(sewn.b.back().piece, banded.pieceNamed("leg_front_left")->id);
}

// A hook or a button at the ends of a band lies in the middle of their lap, where it holds them flat over each other.
TEST(Fly, TheWaistbandIsFastenedInItsLap) {
  const auto inset = [](const std::string& extra, const std::string& kind) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(
        file, std::string(kTrousers) +
                  "fly a=leg_front_left.crotch b=leg_front_right.crotch\n"
                  "band name=waistband depth=4cm sew=yes of=\"leg_back_left.waist* leg_front_left.waist* "
                  "leg_front_right.waist* leg_back_right.waist*\"" +
                  extra + "\nfasten a=waistband.end_left b=waistband.end_right count=1 first=2cm kind=" + kind + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return std::get<Fasten>(file.steps().back().operation).inset->metres;
  };
  EXPECT_NEAR(inset(" extra=3cm", "hook"), 0.015, 1e-6);
  EXPECT_NEAR(inset(" extra=5cm", "button"), 0.025, 1e-6);
  EXPECT_EQ(inset("", "hook"), 0);
  EXPECT_EQ(inset("", "button"), 0.015);
  EXPECT_EQ(inset(" extra=3cm", "hook inset=1cm"), 0.01);
}

// A band over an opening ends there, without a lap, too: over a fly as over a zip. In a record of before its ends are
// sewn to each other, as they are along a ring that opens nowhere.
TEST(Fly, OpensTheWaistband) {
  const std::string trousers = std::string(kTrousers) + "fly a=leg_front_left.crotch b=leg_front_right.crotch\n",
                    closed = kTrousers,
                    skirt =
                        "body size=eu38\nblock kind=skirt\nfasten kind=zip a=skirt_front.side_left "
                        "b=skirt_back.side_left length=18cm\n",
                    legs =
                        "band name=waistband depth=4cm sew=yes of=\"leg_back_left.waist* leg_front_left.waist* "
                        "leg_front_right.waist* leg_back_right.waist*\"",
                    hips = "band name=waistband depth=4cm sew=yes of=\"skirt_front.waist* skirt_back.waist*\"";
  const auto endsSewn = [](const std::string& script, const std::string& band, bool recorded = false) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done begun = room.play(file, script);
    EXPECT_TRUE(begun) << text(begun.error().what);
    room.context.recorded = recorded;
    const auto after = apply(file.document(), op(band), room.context);
    EXPECT_TRUE(after) << text(after.error().what);
    const PieceId id = after->pieceNamed("waistband")->id;
    return std::any_of(after->pattern.seams.begin(), after->pattern.seams.end(), [&](const auto& seam) {
      return seam.second.a.front() == EdgeSpan{id, "end_left", 0, 1} &&
             seam.second.b.front() == EdgeSpan{id, "end_right", 0, 1};
    });
  };
  EXPECT_FALSE(endsSewn(trousers, legs));
  EXPECT_FALSE(endsSewn(skirt, hips));
  EXPECT_TRUE(endsSewn(trousers, legs + " joined=yes"));
  EXPECT_TRUE(endsSewn(skirt, hips, true));
  EXPECT_TRUE(endsSewn(closed, legs));
  EXPECT_FALSE(endsSewn(closed, legs + " joined=no"));
}

// A step of a document of before is done again on another figure: the seam of the band's ends, which the next step may
// take out, is there. What closes no ring is no hindrance.
TEST(Fly, TheWaistbandOfARecordIsSewnAsItWas) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done begun = room.play(file,
                               "body size=eu38\nblock kind=skirt\nfasten kind=zip a=skirt_front.side_left "
                               "b=skirt_back.side_left length=18cm\n");
  ASSERT_TRUE(begun) << text(begun.error().what);
  const Document skirt = file.document();
  for (const auto& [of, seams] :
       {std::pair{"skirt_front.waist* skirt_back.waist*", 2u}, std::pair{"skirt_front.waist*", 1u}}) {
    const auto band = resolved(skirt, op("band name=w depth=4cm sew=yes of=\"" + std::string(of) + "\""), room.context);
    ASSERT_TRUE(band) << text(band.error().what);
    Operation old = *band;
    std::get<DrawBand>(old).joined = Choice::Auto;
    const auto after = apply(skirt, asRecorded(old), room.context);
    ASSERT_TRUE(after) << text(after.error().what);
    EXPECT_EQ(after->pattern.seams.size(), skirt.pattern.seams.size() + seams);
  }
}

}  // namespace
}  // namespace karinui
