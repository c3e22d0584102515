#include "karinui/pattern/markings.h"
#include "karinui/pattern/label_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/edit.h"
#include "support.h"

namespace karinui {
namespace {

// A rectangle with a dart in its top, sewn.
Pattern darted(double width = 0.03) {
  const auto dart = addDart(test::pieceOf(1, test::rectangle(0.3, 0.2)), "top", 0.5, width, {0.15, 0.1}, "dart");
  Pattern pattern = test::patternOf({dart->edited.piece});
  pattern.seams[{9}] = {{9}, "", {{{1}, dart->to, 0, 1}}, {{{1}, dart->back, 0, 1}}, true, Seam::Tie::OneToOne};
  return pattern;
}

TEST(Darts, AreFoundAndNarrowOnesFolded) {
  const auto darts = dartsOf(darted());
  ASSERT_EQ(darts.size(), 1u);
  EXPECT_LT(distance(darts[0].from, {0.165, 0.2}), 1e-9);
  EXPECT_LT(distance(darts[0].point, {0.15, 0.1}), 1e-9);
  EXPECT_LT(distance(darts[0].until, {0.135, 0.2}), 1e-9);
  EXPECT_TRUE(darts[0].folded());
  EXPECT_FALSE(dartsOf(darted(0.06))[0].folded());
  Pattern unsewn = darted();
  unsewn.seams.clear();
  EXPECT_TRUE(dartsOf(unsewn).empty());
}

// Half the wedge lies, folded, on the cloth behind the dart: turned over the leg, the cap runs along the top.
TEST(Darts, TheCapEndsWithTheEdgeWhenTheDartIsFolded) {
  const Pattern pattern = darted();
  const Piece& piece = *pattern.pieces.at({1});
  const PaperDart dart = dartsOf(pattern)[0];
  const Flat peak = capOf(piece, dart);
  EXPECT_NEAR(peak.u, 0.15, 1e-9);
  EXPECT_NEAR(peak.v, 0.2 + 0.015 * std::tan(2 * std::atan(0.15)), 1e-9);
  const Flat leg = normalized(dart.point - dart.until), way = peak - dart.until;
  const Flat folded = dart.until + leg * (2 * dot(way, leg)) - way;
  EXPECT_NEAR(folded.v, 0.2, 1e-9);
  EXPECT_LT(folded.u, dart.until.u);
  // The cut line goes round the cap, not into the dart.
  Allowances none;
  for (const Edge& edge : piece.outline.edges) none.edges[{piece.id, edge.name}] = 0.001;
  const auto lines = cutLines(piece, AllowancePlan(pattern, none));
  ASSERT_TRUE(lines);
  const double cap = 0.5 * 0.03 * (peak.v - 0.2);
  EXPECT_NEAR(signedArea(lines->outer), 0.302 * 0.202 + cap, 2e-6);
  EXPECT_TRUE(contains(lines->outer, {0.15, 0.19}));
  EXPECT_FALSE(contains(cutLines(*darted(0.06).pieces.at({1}), AllowancePlan(darted(0.06), none))->outer, {0.15, 0.19}))
      << "a wide one is cut out";
}

// A skirt's half with a waist dart and a dart in its side, as a bodice has for the bust; its centre is at u = 0.
Pattern halfWithDarts(bool mirror) {
  const Outline outline{{{"hem", Curve::line({0, 0}, {0.26, 0})},
                         {"side", Curve::cubic({0.26, 0}, {0.27, 0.15}, {0.26, 0.3}, {0.22, 0.45})},
                         {"waist", Curve::line({0.22, 0.45}, {0, 0.44})},
                         {"centre", Curve::line({0, 0.44}, {0, 0})}}};
  const auto waist = addDart(test::pieceOf(1, outline), "waist", 0.4, 0.03, {0.13, 0.33}, "waist_dart");
  const auto both = addDart(waist->edited.piece, "side", 0.6, 0.03, {0.15, 0.27}, "side_dart");
  Piece piece = both->edited.piece;
  if (mirror) piece = mirrored(piece), piece.id = {1};
  Pattern pattern = test::patternOf({piece});
  const auto sew = [&](std::uint64_t id, const DartedPiece& dart) {
    pattern.seams[{id}] = {{id}, "", {{{1}, dart.to, 0, 1}}, {{{1}, dart.back, 0, 1}}, true, Seam::Tie::OneToOne};
  };
  sew(8, *waist), sew(9, *both);
  return pattern;
}

TEST(Darts, ArePressedTowardsTheCentreAndDownwardsOnBothHalves) {
  std::vector<Ring> cut;
  for (const bool mirror : {false, true}) {
    const Pattern pattern = halfWithDarts(mirror);
    const Piece& piece = *pattern.pieces.at({1});
    const auto darts = dartsOf(pattern);
    ASSERT_EQ(darts.size(), 2u);
    for (const PaperDart& dart : darts) {
      const bool forward = pressedForward(piece, dart);
      const Flat over = forward ? dart.from : dart.until, other = forward ? dart.until : dart.from;
      if (dart.seam == SeamId{8})
        EXPECT_LT(std::abs(over.u), std::abs(other.u)) << "the waist's towards the centre";
      else
        EXPECT_LT(over.v, other.v) << "that of the side downwards";
      // Folded over that edge, the paper ends where it does.
      const Flat peak = capOf(piece, dart), leg = normalized(dart.point - over), way = peak - over;
      const Flat folded = over + leg * (2 * dot(way, leg)) - way;
      EXPECT_LT(distanceToRing(piece.outline.flattened(), folded), 5e-4);
    }
    Allowances none;
    for (const Edge& edge : piece.outline.edges) none.edges[{piece.id, edge.name}] = 0.01;
    cut.push_back(cutLines(piece, AllowancePlan(pattern, none))->outer);
  }
  for (const Flat p : cut[0]) EXPECT_LT(distanceToRing(cut[1], {-p.u, p.v}), 2e-5);
  for (const Flat p : cut[1]) EXPECT_LT(distanceToRing(cut[0], {-p.u, p.v}), 2e-5);
}

// Both darts of a whole front, by its own axis.
TEST(Darts, OfASymmetricPieceMirrorEachOther) {
  const Piece front = test::pieceOf(1, test::polygon({{0, 0}, {0.4, 0}, {0.4, 0.32}, {0.2, 0.3}, {0, 0.32}}));
  const auto one = addDart(front, "e2", 0.5, 0.03, {0.3, 0.2}, "one");
  const auto two = addDart(one->edited.piece, "e3", 0.5, 0.03, {0.1, 0.2}, "two");
  Pattern pattern = test::patternOf({two->edited.piece});
  std::uint64_t id = 8;
  for (const DartedPiece& dart : {*one, *two}) {
    pattern.seams[{id}] = {{id}, "", {{{1}, dart.to, 0, 1}}, {{{1}, dart.back, 0, 1}}, true, Seam::Tie::OneToOne};
    ++id;
  }
  const auto darts = dartsOf(pattern);
  ASSERT_EQ(darts.size(), 2u);
  const Piece& piece = *pattern.pieces.at({1});
  const Flat a = capOf(piece, darts[0]), b = capOf(piece, darts[1]);
  EXPECT_LT(distance({0.4 - a.u, a.v}, b), 1e-6);
  EXPECT_NE(pressedForward(piece, darts[0]), pressedForward(piece, darts[1]));
}

TEST(Darts, HaveNotchesAtTheMouthAndAHoleShortOfThePoint) {
  const Pattern pattern = darted();
  std::vector<Flat> at;
  for (const NotchPlace& notch : notchPlaces(pattern)) {
    at.push_back(notch.place);
    EXPECT_LT(distance(notch.outward, {0, 1}), 1e-6) << "across the top, not across the leg";
  }
  ASSERT_EQ(at.size(), 2u);
  EXPECT_NEAR(distance(at[0], at[1]), 0.03, 1e-9);
  const auto holes = drillHoles(pattern, *pattern.pieces.at({1}));
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_LT(distance(holes[0], {0.15, 0.1 + kDrillShort}), 1e-9);
}

// Two long edges sewn together get a notch in their middle.
std::size_t notchesBetween(const std::string& one, const std::string& other) {
  Pattern pattern = test::patternOf(
      {test::pieceOf(1, test::rectangle(0.3, 0.6), one), test::pieceOf(2, test::rectangle(0.3, 0.6), other)});
  pattern.seams[{9}] = {{9}, "", {{{1}, "right", 0, 1}}, {{{2}, "left", 0, 1}}, true, Seam::Tie::OneToOne};
  const auto notches = notchPlaces(pattern);
  for (std::size_t i = 0; i + 1 < notches.size(); i += 2) {  // on both partners alike
    EXPECT_EQ(notches[i].piece, PieceId{1});
    EXPECT_EQ(notches[i + 1].piece, PieceId{2});
    EXPECT_NEAR(notches[i].place.v, notches[i + 1].place.v, 1e-9);
  }
  return notches.size() / 2;
}

TEST(Notches, AreDoubleForABack) {
  EXPECT_EQ(notchesBetween("front", "sleeve"), 1u);
  EXPECT_EQ(notchesBetween("back", "sleeve"), 2u);
  EXPECT_EQ(notchesBetween("sleeve_left", "left_back"), 2u);
  EXPECT_EQ(notchesBetween("袖", "後身頃"), 2u);
  EXPECT_EQ(notchesBetween("front", "back"), 1u) << "the side seam is the same for both";
  EXPECT_EQ(notchesBetween("backing", "pocket"), 1u);
  // Where front and back meet on a sleeve there is one.
  Pattern pattern = test::patternOf({test::pieceOf(1, test::rectangle(0.1, 0.1), "front"),
                                     test::pieceOf(2, test::rectangle(0.1, 0.1), "back"),
                                     test::pieceOf(3, test::rectangle(0.2, 0.1), "sleeve")});
  pattern.seams[{9}] = {
      {9}, "", {{{1}, "top", 0, 1}, {{2}, "top", 0, 1}}, {{{3}, "bottom", 0, 1}}, true, Seam::Tie::OneToOne};
  std::size_t onSleeve = 0;
  for (const NotchPlace& notch : notchPlaces(pattern)) onSleeve += notch.piece == PieceId{3};
  EXPECT_EQ(onSleeve, 1u);
}

// The number of a seam is beside the middle of its side, or as near to it as the lines of the piece let it.
TEST(SeamTags, KeepClearOfLines) {
  Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2), "one");
  piece.lines.push_back({"pleat", {Curve::line({0.15, 0}, {0.15, 0.1})}, {}});
  const Piece other = test::pieceOf(2, test::rectangle(0.3, 0.2), "two");
  Pattern pattern = test::patternOf({piece, other});
  pattern.seams[{9}] = {{9}, "", {{{1}, "bottom", 0, 1}}, {{{2}, "top", 0, 1}}, true, Seam::Tie::OneToOne};
  const auto tags = seamTags(pattern);
  ASSERT_EQ(tags.size(), 2u);
  EXPECT_GT(std::fabs(tags[0].place.u - 0.15), 0.004);
  EXPECT_LT(std::fabs(tags[0].place.u - 0.15), 0.05);
  EXPECT_NEAR(tags[1].place.u, 0.15, 1e-9);
}

// Equal numbers are sewn together: each piece that a seam holds has its number.
TEST(SeamTags, AreOnEachPieceOfARun) {
  Pattern pattern = test::patternOf({test::pieceOf(1, test::rectangle(0.3, 0.2), "left"),
                                     test::pieceOf(2, test::rectangle(0.3, 0.2), "right"),
                                     test::pieceOf(3, test::rectangle(0.6, 0.05), "band")});
  pattern.seams[{9}] = {{9},
                        "",
                        {{{1}, "top", 0, 0.5}, {{1}, "top", 0.5, 1}, {{2}, "top", 0, 1}},
                        {{{3}, "bottom", 0, 1}},
                        true,
                        Seam::Tie::OneToOne};
  std::map<PieceId, int> on;
  for (const SeamTag& tag : seamTags(pattern)) ++on[tag.piece];
  EXPECT_EQ(on, (std::map<PieceId, int>{{{1}, 1}, {{2}, 1}, {{3}, 1}}));
}

// What is sewn to an edge or turned up is told beside its middle, inside the piece; an elastic's quarters have notches.
TEST(PaperNotes, TellElasticsHemsAndFolds) {
  Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2), "one");
  piece.lines.push_back({"turn", {Curve::line({0.05, 0.15}, {0.25, 0.15})}, Crease{-std::numbers::pi / 2, 0.9}});
  const Pattern pattern = test::patternOf({piece});
  Allowances finish;
  finish.elastics[{{1}, "top"}] = {0.7, 10};
  finish.hems[{{1}, "bottom"}] = {0.03, 0.01};
  const auto notes = notesOf(pattern, finish);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(text(notes[0].words), "elastic 21 cm");
  EXPECT_EQ(text(notes[1].words), "hem 30 mm, 10 mm turned in");
  EXPECT_EQ(text(notes[2].words), "fold 90°");
  for (const PaperNote& note : notes) {
    EXPECT_NEAR(note.place.u, 0.15, 1e-9);
    EXPECT_GT(note.place.v, 0.005);
    EXPECT_LT(note.place.v, 0.195);
    EXPECT_TRUE(note.upright);
  }
  const auto quarters = finishNotches(pattern, finish);
  ASSERT_EQ(quarters.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(quarters[k].place.u, 0.3 * (0.75 - 0.25 * static_cast<double>(k)), 1e-9);
    EXPECT_NEAR(quarters[k].place.v, 0.2, 1e-12);
  }
}

// A sleeve's front has one notch and its back two, as the armhole has them, beside that at the shoulder.
TEST(Notches, TellASleevesFrontFromItsBack) {
  Pattern pattern = test::patternOf({test::pieceOf(1, test::rectangle(0.45, 0.4), "sleeve"),
                                     test::pieceOf(2, test::rectangle(0.22, 0.5), "front"),
                                     test::pieceOf(3, test::rectangle(0.22, 0.5), "back")});
  Seam seam;
  seam.id = {4};
  seam.a = {{{1}, "top", 0, 1}}, seam.b = {{{2}, "bottom", 0, 1}, {{3}, "bottom", 0, 1}};
  pattern.seams[seam.id] = seam;
  std::map<PieceId, std::size_t> notches;
  for (const NotchPlace& notch : notchPlaces(pattern)) ++notches[notch.piece];
  EXPECT_EQ(notches[{1}], 4u);
  EXPECT_EQ(notches[{2}] + notches[{3}], 4u);
  EXPECT_GE(notches[{3}], 2u);
}

// The longer side of a gathered seam says how long it comes to be; what is only eased in says nothing.
TEST(PaperNotes, TellWhatIsGathered) {
  for (const double width : {0.72, 0.37}) {
    const Pattern pattern = [&] {
      Pattern sewn = test::patternOf({test::pieceOf(1, test::rectangle(width, 0.5), "skirt"),
                                      test::pieceOf(2, test::rectangle(0.36, 0.2), "top")});
      Seam seam;
      seam.id = {3};
      seam.a = {{{1}, "top", 0, 1}}, seam.b = {{{2}, "bottom", 0, 1}};
      sewn.seams[seam.id] = seam;
      return sewn;
    }();
    const auto notes = notesOf(pattern, {});
    ASSERT_EQ(notes.size(), width > 0.4 ? 1u : 0u);
    if (notes.empty()) continue;
    EXPECT_EQ(notes[0].piece, PieceId{1});
    EXPECT_EQ(text(notes[0].words), "gather to 36 cm");
    EXPECT_NEAR(notes[0].place.v, 0.5 - 0.014, 1e-9);
  }
}

// Buttonholes across the edge begin beyond the button's place and are longer than it; crosses lie on the other side.
TEST(Fasteners, AreMarkedAtTrueSize) {
  Piece over = test::pieceOf(1, test::rectangle(0.3, 0.4), "over"),
        under = test::pieceOf(2, test::rectangle(0.3, 0.4), "under");
  const Pattern pattern = test::patternOf({over, under});
  Fastening own;
  own.a = {{{1}, "left", 0, 1}}, own.b = {{{2}, "right", 0, 1}};
  own.at = {0.25, 0.5, 0.75}, own.closed = 2, own.inset = 0.02, own.size = 0.015;
  ASSERT_TRUE(sound(own));
  const auto places = placesOf(pattern, own);
  ASSERT_EQ(places.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    // The left edge runs downwards, the right one upwards.
    EXPECT_LT(distance(places[k].a.place, {0.02, 0.3 - 0.1 * static_cast<double>(k)}), 1e-9);
    EXPECT_LT(distance(places[k].b.place, {0.28, 0.3 - 0.1 * static_cast<double>(k)}), 1e-9);
    EXPECT_EQ(places[k].closed, k < 2);
  }
  const auto marks = fastenersOf(pattern, {{"front", own}});
  ASSERT_EQ(marks.size(), 6u);
  for (const PaperFastener& mark : marks) {
    const PaperStroke& bar = mark.strokes[0];
    if (mark.piece == PieceId{1}) {
      ASSERT_EQ(mark.strokes.size(), 3u);
      EXPECT_NEAR(distance(bar.from, bar.to), 0.018, 1e-12);
      EXPECT_NEAR(bar.from.u, 0.017, 1e-12);
      EXPECT_NEAR(bar.from.v, bar.to.v, 1e-12);
    } else {
      EXPECT_LT(distance(lerp(bar.from, bar.to, 0.5), {0.28, bar.from.v + 0.5 * (bar.to.v - bar.from.v)}), 1e-12);
    }
  }
  own.holesAlong = true;
  const PaperStroke upright = fastenersOf(pattern, {{"front", own}})[1].strokes[0];
  EXPECT_NEAR(std::abs(upright.from.v - upright.to.v), 0.018, 1e-12);
  const auto notions = notionsSaid(pattern, {{"front", own}});
  ASSERT_EQ(notions.size(), 1u);
  EXPECT_EQ(text(notions[0]), "3 buttons 15 mm");
}

// Of a zip 20 cm long that opens at the top and is closed for 15, the lower 15 are a seam; its edges are cut as seams,
// and its ends have notches. A divided edge keeps it.
TEST(Fasteners, AZipIsASeamAsFarAsItIsClosed) {
  Pattern pattern = test::patternOf(
      {test::pieceOf(1, test::rectangle(0.3, 0.4), "one"), test::pieceOf(2, test::rectangle(0.3, 0.4), "two")});
  Fastening own;
  own.kind = FasteningKind::Zip;
  own.a = {{{1}, "left", 0, 1}}, own.b = {{{2}, "right", 0, 1}};
  own.at = {0, 0.5}, own.zipped = 0.75;
  const Pattern worn = withZips(pattern, {{"zip", own}});
  ASSERT_EQ(worn.seams.size(), 1u);
  const Seam& seam = worn.seams.begin()->second;
  ASSERT_EQ(seam.a.size(), 1u);
  EXPECT_NEAR(seam.a[0].from, 0.125, 1e-12);
  EXPECT_NEAR(seam.a[0].to, 0.5, 1e-12);
  EXPECT_NEAR(seam.b[0].from, 0.5, 1e-12);
  EXPECT_NEAR(seam.b[0].to, 0.875, 1e-12);
  Allowances finish;
  finish.fastenings["zip"] = own;
  EXPECT_EQ(AllowancePlan(pattern, finish).kind({1}, "left"), EdgeKind::Seam);
  const auto ends = finishNotches(pattern, finish);
  ASSERT_EQ(ends.size(), 2u) << "the upper end is a corner";
  EXPECT_NEAR(ends[0].place.v, 0.2, 1e-9);
  own.zipped = 0;
  EXPECT_TRUE(withZips(pattern, {{"zip", own}}).seams.empty());

  const auto split = splitEdge(*pattern.pieces.at({1}), "left", 0.25);
  ASSERT_TRUE(split);
  pattern.pieces[{1}] = std::make_shared<const Piece>(split->piece);
  own.zipped = 1;
  Fastenings led{{"zip", own}};
  updateFastenings(led, split->edges, pattern);
  ASSERT_EQ(led.size(), 1u);
  EXPECT_EQ(led.at("zip").a.size(), 2u);
  EXPECT_NEAR(length(pattern, zipSeam(pattern, led.at("zip"))->a), 0.2, 1e-9);
  pattern.pieces.erase({2});
  updateFastenings(led, {}, pattern);
  EXPECT_TRUE(led.empty());
}

// A seam is led along its edge when that is redrawn, a zip keeps its shares: 0.04 mm apart, they left a sliver between
// two corners of the cloth, and it tore.
TEST(Fasteners, AZipEndsJustWhereTheSeamBesideItEnds) {
  Pattern pattern = test::patternOf(
      {test::pieceOf(1, test::rectangle(0.3, 0.4), "one"), test::pieceOf(2, test::rectangle(0.3, 0.4), "two")});
  Fastening own;
  own.kind = FasteningKind::Zip;
  own.a = {{{1}, "left", 0, 1}}, own.b = {{{2}, "right", 0, 1}};
  own.at = {0, 0.5};
  const auto wornBeside = [&](double off) {
    Seam below;
    below.id = {9};
    below.a = {{{1}, "left", 0.5 - off, 1}}, below.b = {{{2}, "right", 0, 0.5 + off}};
    pattern.seams[below.id] = below;
    return withZips(pattern, {{"zip", own}}).seams.at(zipId(0));
  };
  for (const double off : {1e-4, -1e-4}) {
    const Seam near = wornBeside(off);
    EXPECT_EQ(near.a[0].to, 0.5 - off);
    EXPECT_EQ(near.b[0].from, 0.5 + off);
    EXPECT_EQ(near.a[0].from, 0);
    EXPECT_EQ(near.b[0].to, 1);
  }
  EXPECT_NEAR(wornBeside(0.01).a[0].to, 0.5, 1e-12) << "4 mm are meant";
}

// What is said beside an edge stays on the piece, however small that is, and clear of what is written there.
TEST(PaperNotes, HaveRoomOnTheirPiece) {
  const auto boxOf = [](const std::string& words, const LetteredPiece::Line& at) {
    const Flat half = Flat{wordsWidth(words, at.size), 1.2 * at.size} * 0.5;
    return at.upright ? half : Flat{half.v, half.u};
  };
  const std::string hem = "hem 30 mm, 5 mm turned in";
  for (const auto& [wide, high] : {std::pair{0.4, 0.3}, {0.09, 0.11}, {0.02, 0.08}, {0.12, 0.03}}) {
    const Piece piece = test::pieceOf(1, test::rectangle(wide, high), "pocket");
    const std::vector<std::string> lines{"breast pocket", "Cut 1 · Cotton"};
    const LetteredPiece lettered = roomFor(piece, lines);
    const Flat wished{wide / 2, high - 0.014};
    const auto notes = roomForNotes(piece, {{hem, {wished, kNoteSize, true}}}, lines, lettered, {});
    ASSERT_EQ(notes.size(), 1u);
    const Flat half = boxOf(hem, notes[0]), place = notes[0].place;
    EXPECT_GE(notes[0].size, kLeastNote);
    EXPECT_GT(place.u - half.u, 0) << wide;
    EXPECT_LT(place.u + half.u, wide);
    EXPECT_GT(place.v - half.v, 0) << wide;
    EXPECT_LT(place.v + half.v, high);
    if (wide > 0.3) {
      EXPECT_EQ(place, wished) << "there is room where it is wished";
      EXPECT_EQ(notes[0].size, kNoteSize);
    }
    if (wide < 0.05) continue;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Flat other = boxOf(lines[i], lettered.lines[i]), at = lettered.lines[i].place;
      EXPECT_TRUE(std::fabs(at.u - place.u) >= half.u + other.u || std::fabs(at.v - place.v) >= half.v + other.v)
          << "written over “" << lines[i] << "” at " << wide;
    }
  }
}

}  // namespace
}  // namespace karinui
