// Slash and spread in a document: both halves, symmetric copies, what is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/geometry/polygon.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {
namespace {

Workroom& room() {
  static Workroom room;
  return room;
}
const Piece& named(const DocumentFile& file, const char* name) { return *file.document().pieceNamed(name); }

// Five slashes make the panel five openings wider; it stays symmetric about the same line, grain upwards.
TEST(SlashAndSpread, KeepsASymmetricPieceSymmetric) {
  for (const char* count : {"1", "2", "5"}) {
    DocumentFile file = DocumentFile::inMemory();
    const auto played = room().play(
        file,
        std::string(
            R"(piece name=skirt outline="M -200 0; hem L 200 0; side_left L 200 600; waist L -200 600; side_right L -200 0"
spread from=skirt.hem to=skirt.waist by=3cm count=)") +
            count);
    ASSERT_TRUE(played) << text(played.error().what);
    const Piece& piece = named(file, "skirt");
    const auto symmetry = symmetryOf(piece.outline);
    ASSERT_TRUE(symmetry) << count;
    EXPECT_LT(distance(symmetry->axis, Flat{0, 1}), 1e-6) << count;
    EXPECT_NEAR(symmetry->through.u, 0, 1e-6) << count;
    const double most = std::stod(count) * 0.03;
    EXPECT_NEAR(findEdge(piece, "hem")->curve.length(), 0.4 + most, 0.004) << count;
    EXPECT_NEAR(findEdge(piece, "waist")->curve.length(), 0.4, 0.004) << count;
    EXPECT_NEAR(findEdge(piece, "side_left")->curve.length(), 0.6, 1e-9) << count;
  }
}

// A slash on the fold is one slash, also where it ends in a corner, as between the two halves of a hem. What was
// recorded before that was asked is opened on both halves.
TEST(SlashAndSpread, OpensTheFoldOnce) {
  for (const char* hem : {"hem_left to_at=0", "hem_right to_at=1"}) {
    DocumentFile file = DocumentFile::inMemory();
    const std::string spread = std::string("spread from=back.top at=0.5 by=8cm to_by=8cm to=back.") + hem;
    ASSERT_TRUE(room().play(file, R"(piece name=back outline="M 0 0; hem_left L 300 0; side_left L 300 500; )"
                                  R"(top L -300 500; side_right L -300 0; hem_right L 0 0")"
                                  "\n"));
    const Document flat = file.document();
    const auto played = room().play(file, spread + "\n");
    ASSERT_TRUE(played) << text(played.error().what);
    const Piece& piece = named(file, "back");
    EXPECT_NEAR(findEdge(piece, "top")->curve.length(), 0.68, 1e-6) << hem;
    EXPECT_NEAR(findEdge(piece, "hem_left")->curve.length(), 0.34, 1e-6) << hem;
    EXPECT_NEAR(findEdge(piece, "hem_right")->curve.length(), 0.34, 1e-6) << hem;
    const auto symmetry = symmetryOf(piece.outline);
    ASSERT_TRUE(symmetry) << hem;
    EXPECT_NEAR(symmetry->through.u, 0, 1e-9) << hem;
    room().context.recorded = true;
    const auto old = apply(flat, op(spread + " symmetric=yes"), room().context);
    room().context.recorded = false;
    ASSERT_TRUE(old);
    EXPECT_NEAR(findEdge(*old->pieceNamed("back"), "hem_left")->curve.length(), 0.38, 1e-6) << hem;
  }
}

// The copy's drill holes, lines and pins are where the piece's are, mirrored.
TEST(SlashAndSpread, DoesTheSameToTheSymmetricCopy) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played =
      room().play(file, R"(piece name=half outline="M 0 0; hem L 220 0; side L 200 600; waist L 0 600; fold L 0 0"
notch piece=half point=15cm,30cm name=hole
line piece=half along="5cm,20cm; 18cm,20cm" name=drawn
mirror piece=half name=other
pin piece=other at="-18cm,10cm"
spread from=half.hem to=half.waist at=0.5 to_at=0.5 by=4cm to_by=1cm
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const Piece &half = named(file, "half"), &other = named(file, "other");
  const auto across = [](Flat p) { return Flat{-p.u, p.v}; };
  EXPECT_EQ(findEdge(half, "fold")->curve, Curve::line({0, 0.6}, {0, 0}));  // the fold stays
  EXPECT_GT(half.marks.at(0).place.u, 0.16);
  EXPECT_LT(distance(across(half.marks.at(0).place), other.marks.at(0).place), 1e-9);
  EXPECT_LT(distance(across(half.lines.at(0).curves[0].end), other.lines.at(0).curves[0].end), 1e-9);
  EXPECT_LT(file.document().pins.at(other.id).at(0).u, -0.2);
  const Ring image = mirrored(half).outline.flattened(1e-6);
  for (const Flat p : other.outline.flattened(1e-4)) EXPECT_LT(distanceToRing(image, p), 2e-6);
}

// So does a dart that is moved.
TEST(PivotedDart, TakesTheCopysDrillHolesAlong) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room().play(
      file,
      R"(piece name=half outline="M 0 0; waist L 150 0; side L 150 300; shoulder L 60 400; centre L 0 400; fold L 0 0"
notch piece=half point=12cm,30cm name=hole
mirror piece=half name=other
dart edge=half.waist at=0.5 tip=75mm,150mm width=40mm
pivot dart=half.dart to=half.shoulder at=0.4
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const Flat place = named(file, "half").marks.at(0).place, image = named(file, "other").marks.at(0).place;
  EXPECT_GT(distance(place, Flat{0.12, 0.3}), 0.01);
  EXPECT_LT(distance(Flat{-place.u, place.v}, image), 1e-9);
}

TEST(SlashAndSpread, TellsWhatBecameLonger) {
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> said;
  room().context.advise = [&](const Advice& advice) { said.push_back(text(advice.what)); };
  const auto played = room().play(file, R"(rectangle name=skirt width=40cm height=60cm edges="hem left waist right"
rectangle name=band width=40cm height=4cm
sew a=skirt.waist b=band.bottom
spread from=skirt.waist to=skirt.hem by=5cm to_by=5cm
)");
  room().context.advise = {};
  ASSERT_TRUE(played) << text(played.error().what);
  EXPECT_THAT(said, testing::Contains(testing::HasSubstr("waist: 400.0 mm → 450.0 mm")));
  EXPECT_THAT(said, testing::Contains("skirt.waist is 50.0 mm longer than band.bottom, to which it is sewn."));
}

TEST(SlashAndSpread, TellsWhatIsInTheWay) {
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room().play(
      file,
      "piece name=front outline=\"M 0 0; hem L 300 0; side L 300 100; dart L 100 150; dart_2 L 300 200; side_2 L "
      "300 400; top L 0 400; centre L 0 0\"\n"));
  const auto cut = [&](const std::string& line) {
    const auto step = file.perform(op(line), room().context);
    EXPECT_FALSE(step);
    return step ? std::string() : text(step.error().what);
  };
  EXPECT_THAT(cut("spread from=front.hem to=front.top at=0.8 to_at=0.2 by=3cm"),
              testing::HasSubstr("From “hem” to “top” the paper cannot be cut straight: “dart” is in the way, at "));
  // A sleeve's crown in two edges over one hem: each is slashed to its own half.
  ASSERT_TRUE(
      room().play(file,
                  "piece name=sleeve outline=\"M -150 0; hem C -50 150 50 150 150 0; under L 180 100; cap_back L 0 "
                  "200; cap_front L -180 100; under_2 L -150 0\"\n"));
  EXPECT_THAT(cut("spread from=sleeve.cap_front to=sleeve.hem by=3cm to_by=3cm count=4"),
              testing::HasSubstr("Name the part of “hem” that lies opposite, as hem@0:0.5"));
  EXPECT_TRUE(
      file.perform(op("spread from=sleeve.cap_front to=sleeve.hem@0:0.5 by=3cm to_by=3cm count=4"), room().context));
  EXPECT_THAT(cut("spread from=front.side to=front.side_2 at=0.5 to_at=0.5 by=3cm"),
              testing::HasSubstr("is in the way"));
}

// A record of it is replayed to the same bits, and amended.
TEST(SlashAndSpread, IsReplayed) {
  DocumentFile file = DocumentFile::inMemory();
  const std::string script =
      R"(piece name=skirt outline="M -200 0; hem L 200 0; side_left L 200 600; waist L -200 600; side_right L -200 0"
spread from=skirt.hem to=skirt.waist by=3cm count=3
)";
  ASSERT_TRUE(room().play(file, script));
  DocumentFile again = DocumentFile::inMemory();
  std::string log;
  for (const Step& step : file.steps()) log += text(step.operation) + "\n";
  ASSERT_TRUE(room().play(again, log));
  EXPECT_EQ(hash(again.document()), hash(file.document()));
}

// A front that buttons along its centre flares towards the side.
TEST(SlashAndSpread, LeavesTheOpeningOnTheGrain) {
  DocumentFile file = DocumentFile::inMemory();
  const char* const script =
      "piece name=front outline=\"M 0 0; hem L 300 0; side L 260 700; top L 0 700; centre L 0 0\"\n"
      "piece name=other outline=\"M 0 0; hem L 300 0; centre L 300 700; top L 40 700; side L 0 0\"\n"
      "fasten kind=button a=front.centre b=other.centre count=3\n";
  ASSERT_TRUE(room().play(file, script));
  const Document flat = file.document();
  const auto centre = [&](const Document& document) {
    const Curve& curve = findEdge(*document.pieceNamed("front"), "centre")->curve;
    return curve.end - curve.start;
  };
  const std::string spread = "spread from=front.hem to=front.top by=8cm at=0.2 to_at=0.8";
  ASSERT_TRUE(room().play(file, spread + "\n"));
  EXPECT_NEAR(std::abs(centre(file.document()).u), 0, 1e-9);
  EXPECT_THAT(text(file.steps().back().operation), testing::HasSubstr("keep=centre"));
  room().context.recorded = true;
  const auto old = apply(flat, op(spread), room().context);
  room().context.recorded = false;
  ASSERT_TRUE(old);
  EXPECT_EQ(centre(*old), centre(*apply(flat, op(spread + " keep=side"), room().context))) << "the larger part stayed";
}

}  // namespace
}  // namespace karinui
