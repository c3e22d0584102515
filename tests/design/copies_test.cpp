// What is drawn, folded, marked, fused and fastened on a piece is so on its symmetric copy, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// A front and its copy, a cuff and its copy, and a piece that has none.
const char* const kPair =
    "piece name=front_left outline=\"M 0 0; hem L 300 0; side_left L 320 500; neck L 20 450; centre L 0 0\"\n"
    "piece name=cuff_left outline=\"M 0 0; low L 220 0; end_left L 220 60; top L 0 60; end_right L 0 0\" "
    "pose=\"0.6,0,0\"\n"
    "piece name=back outline=\"M 0 0; hem L 300 0; side L 300 500; neck L 0 450; centre L 0 0\" pose=\"0,0,-0.3\"\n"
    "mirror piece=front_left\nmirror piece=cuff_left\n";

struct Pair {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> advice;
  explicit Pair(const std::string& more = {}) {
    room.context.advise = [this](const Advice& told) { advice.push_back(text(told.what)); };
    const Done done = room.play(file, kPair + more);
    EXPECT_TRUE(done) << text(done.error().what);
  }
  std::string play(const std::string& lines) {
    const Done done = room.play(file, lines);
    return done ? std::string() : text(done.error().what);
  }
  const Piece& operator[](const char* name) const { return *file.document().pieceNamed(name); }
  const InternalLine& line(const char* piece, const char* name) const {
    for (const InternalLine& one : (*this)[piece].lines)
      if (one.name == name) return one;
    ADD_FAILURE() << piece << " has no line " << name;
    std::abort();
  }
  std::string last() const { return text(file.steps().back().operation); }
};

Flat across(Flat p) { return {-p.u, p.v}; }

// A dart's seam lies within the piece: its copies have it. A record of before, which does not say so, keeps its
// meaning.
TEST(Copies, HaveTheSeamsWithinThePiece) {
  Pair pair;
  ASSERT_EQ(
      pair.play("piece name=skirt_left outline=\"M 0 0; hem L 300 0; side L 300 500; waist L 0 500; centre L 0 0\"\n"
                "dart edge=skirt_left.waist at=0.5 tip=150mm,380mm width=4cm\n"
                "mirror piece=skirt_left\nduplicate piece=skirt_left name=second\n"),
      "");
  EXPECT_THAT(pair.last(), HasSubstr("seams=yes"));
  for (const char* name : {"skirt_left", "skirt_right", "second"}) {
    const Piece& piece = pair[name];
    const auto& seams = pair.file.document().pattern.seams;
    const auto own = std::find_if(seams.begin(), seams.end(),
                                  [&](const auto& one) { return one.second.a.front().piece == piece.id; });
    ASSERT_NE(own, seams.end()) << name;
    const Seam& seam = own->second;
    ASSERT_EQ(seam.b.front().piece, piece.id);
    const Curve &to = findEdge(piece, seam.a.front().edge)->curve, &back = findEdge(piece, seam.b.front().edge)->curve;
    EXPECT_LT(distance(to.end, back.start), 1e-12) << name;  // at the tip
    EXPECT_TRUE(seam.reversed);
    EXPECT_NEAR(to.length(), back.length(), 1e-9);
  }
  EXPECT_EQ(pair.file.document().pattern.seams.size(), 3u);
  ASSERT_EQ(pair.play("mirror piece=skirt_left name=third seams=no\n"), "");
  EXPECT_EQ(pair.file.document().pattern.seams.size(), 3u);
}

// Two lines between the same ends are two, on the copy too.
TEST(Copies, HaveBothLinesBetweenTheSameEnds) {
  Pair pair;
  ASSERT_EQ(pair.play("line piece=front_left along=\"150mm,100mm; 163mm,200mm; 150mm,300mm\" smooth=yes name=one\n"
                      "line piece=front_left along=\"150mm,100mm; 137mm,200mm; 150mm,300mm\" smooth=yes name=two\n"),
            "");
  ASSERT_EQ(pair["front_right"].lines.size(), 2u);
  const Flat own = pair.line("front_left", "two").curves.front().at(0.5);
  EXPECT_LT(distance(across(own), pair.line("front_right", "two").curves.front().at(0.5)), 1e-12);
}

TEST(Copies, ALineAndItsFoldAreOnBothFronts) {
  Pair pair;
  ASSERT_EQ(pair.play("line piece=front_left along=\"18mm,400mm; 150mm,0\" name=roll_left\n"), "");
  EXPECT_THAT(pair.last(), HasSubstr("copies=yes"));
  const Curve own = pair.line("front_left", "roll_left").curves.front(),
              image = pair.line("front_right", "roll_right").curves.front();
  EXPECT_LT(distance(across(own.start), image.start), 1e-12);
  EXPECT_LT(distance(across(own.end), image.end), 1e-12);
  const std::size_t undrawn = pair.file.steps().size();
  ASSERT_EQ(pair.play("fold piece=front_right line=roll_right angle=170deg turned=yes\n"), "");
  const auto &right = pair.line("front_right", "roll_right").crease,
             &left = pair.line("front_left", "roll_left").crease;
  ASSERT_TRUE(right && left);
  EXPECT_EQ(*left, *right);
  // What lies turned back lies mirrored: the two fronts stand as images of each other.
  const Stand here(pair["front_left"]), there(pair["front_right"]);
  for (const Flat p : pair["front_left"].outline.flattened(0.01)) {
    const Vec3 a = here(p), b = there(across(p));
    EXPECT_LT(distance(a, Vec3{-b.x, b.y, b.z}), 2e-4) << p.u << " " << p.v;
  }
  EXPECT_EQ(pair.file.steps().size(), undrawn + 1) << "one step, which one undo takes back";
  ASSERT_TRUE(pair.file.undo(pair.room.context));
  EXPECT_FALSE(pair.line("front_left", "roll_left").crease);
}

TEST(Copies, OneAloneWhereThatIsSaid) {
  Pair pair("line piece=front_left along=\"5cm,5cm; 15cm,5cm\" name=pocket copies=no\n");
  EXPECT_TRUE(pair["front_right"].lines.empty());
  ASSERT_EQ(pair.play("line piece=front_right along=\"-5cm,5cm; -15cm,5cm\" name=pocket copies=no\n"
                      "fold piece=front_left line=pocket angle=90deg copies=no\n"),
            "");
  EXPECT_FALSE(pair.line("front_right", "pocket").crease);
  EXPECT_THAT(pair.play("line piece=back along=\"5cm,5cm; 15cm,5cm\" copies=yes\n"),
              HasSubstr("has no symmetric copy that is like it"));
  ASSERT_EQ(pair.play("line piece=back along=\"5cm,5cm; 15cm,5cm\"\n"), "");
  EXPECT_EQ(pair.last().find("copies"), std::string::npos) << "there is nothing to be decided";
  // A copy that went its own way is left alone.
  ASSERT_EQ(pair.play("cut piece=front_right line=\"-0.2,-0.01 -0.2,0.6\"\n"
                      "line piece=front_left along=\"5cm,20cm; 15cm,20cm\" name=dart_line\n"),
            "");
  for (const auto& [id, piece] : pair.file.document().pattern.pieces)
    for (const InternalLine& line : piece->lines)
      EXPECT_TRUE(piece->name == "front_left" || line.name != "dart_line") << piece->name;
}

// Scripts that draw and fold both sides themselves go on as they did.
TEST(Copies, WhatIsThereAlreadyIsDoneOnce) {
  Pair pair;
  ASSERT_EQ(pair.play("line piece=front_left along=\"5cm,5cm; 15cm,5cm\" name=turn\n"
                      "line piece=front_right along=\"-15cm,5cm; -5cm,5cm\" name=turn\n"
                      "fold piece=front_left line=turn angle=90deg\n"
                      "fold piece=front_right line=turn angle=90deg\n"),
            "");
  EXPECT_EQ(pair["front_right"].lines.size(), 1u);
  EXPECT_TRUE(pair.line("front_right", "turn").crease);
  EXPECT_THAT(pair.advice, ::testing::Contains(HasSubstr("drawn with its symmetric copy")));
  EXPECT_THAT(pair.play("line piece=front_right along=\"-5cm,9cm; -15cm,9cm\" name=turn\n"),
              HasSubstr("already has a line"));
}

TEST(Copies, NotchesHolesAndWhatIsErased) {
  Pair pair("notch edge=front_left.side_left at=0.25 name=waist_left\nnotch piece=front_left point=10cm,20cm\n");
  ASSERT_EQ(pair["front_right"].marks.size(), 2u);
  const Mark notch = pair["front_right"].marks[0], hole = pair["front_right"].marks[1];
  EXPECT_EQ(notch.edge, "side_right");
  EXPECT_EQ(notch.name, "waist_right");
  EXPECT_NEAR(notch.fraction, 0.75, 1e-12);
  EXPECT_LT(distance(hole.place, Flat{-0.1, 0.2}), 1e-12);
  ASSERT_EQ(pair.play("line piece=front_left along=\"5cm,5cm; 15cm,5cm\" name=turn\n"
                      "erase piece=front_right name=turn\nerase piece=front_right at=-10cm,20.3cm\n"
                      "erase piece=front_left name=waist_left\n"),
            "");
  for (const char* name : {"front_left", "front_right"}) {
    EXPECT_TRUE(pair[name].lines.empty()) << name;
    EXPECT_TRUE(pair[name].marks.empty()) << name;
  }
}

TEST(Copies, GrainInterfacingAndNamesOfEdges) {
  Pair pair("grain piece=front_left to=1,2\ninterface piece=cuff_right\nrename edge=front_left.side_left to=slit_l\n");
  EXPECT_LT(distance(pair["front_right"].grain, normalized(Flat{-1, 2})), 1e-12);
  EXPECT_EQ(pair["cuff_left"].interfacing, "interfacing");
  EXPECT_TRUE(pair["front_right"].outline.find("slit_r"));
  ASSERT_EQ(pair.play("notch edge=front_left.slit_l at=0.5\n"), "");
  EXPECT_EQ(pair["front_right"].marks.size(), 1u) << "they are still each other's likeness";
  ASSERT_EQ(pair.play("interface piece=cuff_left none=yes\n"), "");
  EXPECT_TRUE(pair["cuff_right"].interfacing.empty());
}

TEST(Copies, AButtonedCuffIsButtonedOnBothSides) {
  Pair pair(
      "fasten name=cuff_left a=cuff_left.end_left b=cuff_left.end_right reversed=yes count=2 first=1cm last=1cm "
      "size=8mm\n");
  const Fastenings& all = pair.file.document().allowances.fastenings;
  ASSERT_EQ(all.size(), 2u);
  ASSERT_TRUE(all.contains("cuff_right"));
  const Fastening &own = all.at("cuff_left"), &copy = all.at("cuff_right");
  EXPECT_EQ(copy.closed, own.closed);
  for (std::size_t k = 0; k < 2; ++k) {
    const FastenedPlaces here = placesOf(pair.file.document().pattern, own)[k],
                         there = placesOf(pair.file.document().pattern, copy)[1 - k];
    EXPECT_LT(distance(across(here.a.place), there.a.place), 1e-9);
    EXPECT_LT(distance(across(here.b.place), there.b.place), 1e-9);
  }
  // Said once more for the other side, as a script of before says it.
  const std::string other =
      "fasten name=cuff_right a=cuff_right.end_right b=cuff_right.end_left reversed=yes count=2 "
      "first=1cm last=1cm size=8mm\n";
  ASSERT_EQ(pair.play(other), "");
  EXPECT_EQ(pair.file.document().allowances.fastenings.size(), 2u);
  // Two fronts that are buttoned to each other are no two pairs.
  ASSERT_EQ(pair.play("fasten name=front a=front_left.centre b=front_right.centre reversed=yes count=3\n"), "");
  EXPECT_EQ(pair.file.document().allowances.fastenings.size(), 3u);
  EXPECT_THAT(pair.play("fasten name=more a=front_left.hem@0.4:0.6 b=back.hem@0.4:0.6 count=1 size=8mm copies=yes\n"),
              HasSubstr("nothing that is fastened likewise"));
}

// A step that was recorded before copies followed stays what it was when steps are played again.
TEST(Copies, StepsOfOldKeepTheirMeaning) {
  Pair pair;
  const std::size_t first = pair.file.steps().size();
  ASSERT_EQ(pair.play("move piece=back by=0,1cm,0\nline piece=front_left along=\"5cm,5cm; 15cm,5cm\" name=line "
                      "copies=no\nline piece=front_right along=\"-5cm,6cm; -15cm,5cm\" name=line copies=no\n"),
            "");
  const auto left = pair.file.steps()[first + 1].operation;
  Operation old = left;
  std::get<AddLine>(old).copies = Choice::Auto;  // as an older program left it
  EXPECT_EQ(std::get<AddLine>(asRecorded(old)).copies, Choice::No);
  ASSERT_TRUE(pair.file.amend(first + 1, *parseOperation("move piece=back by=0,2cm,0"), pair.room.context));
  EXPECT_EQ(pair["front_left"].lines.size(), 1u);
  EXPECT_EQ(pair["front_right"].lines.size(), 1u);
  Context again = pair.room.context;
  again.recorded = true;
  const auto after = apply(
      pair.file.document(),
      [&] {
        AddLine line = std::get<AddLine>(old);
        line.name = "later", line.along = {{0.05, 0.3}, {0.15, 0.3}};
        return Operation(line);
      }(),
      again);
  ASSERT_TRUE(after) << text(after.error().what);
  EXPECT_EQ(after->pieceNamed("front_right")->lines.size(), 1u);
}

// Each part of a piece is the mirror image of a part of its copy.
void expectImages(const Pair& pair, const char* piece, const char* copy) {
  const Piece &own = pair[piece], &other = pair[copy];
  EXPECT_EQ(other.mirrorOf, own.id) << copy;
  EXPECT_NEAR(own.outline.area(), other.outline.area(), 1e-12);
  for (const Flat p : own.outline.flattened(0.01))
    EXPECT_LT(distanceToRing(other.outline.flattened(1e-6), across(p)), 1e-6) << piece << " " << p.u << " " << p.v;
}

TEST(Copies, AreCutAndMergedLikewise) {
  Pair pair;
  // Both fronts are sewn to the back, and to each other at the centre: seams go over to the parts of both.
  ASSERT_EQ(pair.play("sew a=front_left.hem b=back.hem name=low\nsew a=front_left.centre b=front_right.centre\n"
                      "cut piece=front_left line=\"-10mm,150mm; 400mm,200mm\" name=lower_left copies=yes\n"),
            "");
  ASSERT_TRUE(pair.file.document().pieceNamed("lower_right"));
  expectImages(pair, "front_left", "front_right");
  expectImages(pair, "lower_left", "lower_right");
  EXPECT_THAT(pair.advice, testing::Not(testing::Contains(HasSubstr("no longer alike"))));
  // So what is done to one part is still done to the other.
  ASSERT_EQ(pair.play("line piece=lower_left along=\"5cm,5cm; 15cm,5cm\" name=pocket\n"), "");
  EXPECT_EQ(pair["lower_right"].lines.size(), 1u);
  ASSERT_EQ(pair.play("merge a=front_left.cut b=lower_left.cut\n"), "");
  EXPECT_THAT(pair.last(), HasSubstr("copies=yes"));
  EXPECT_FALSE(pair.file.document().pieceNamed("lower_right"));
  expectImages(pair, "front_left", "front_right");
  EXPECT_NEAR(pair["front_right"].outline.area(), pair["back"].outline.area(), 0.02);
  EXPECT_EQ(pair["front_right"].lines.size(), 1u);
  const Document whole = pair.file.document();
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(pair.file.undo(pair.room.context));
  EXPECT_FALSE(pair.file.document().pieceNamed("lower_right"));
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(pair.file.redo(pair.room.context));
  EXPECT_EQ(hash(pair.file.document()), hash(whole));
}

// A sleeve cut into halves of the same size: each keeps its own side.
TEST(Copies, AreCutIntoHalvesLikewise) {
  for (const char* edge : {"end_left", "end_right"})
    for (const char* cut : {"110mm,-10mm; 110mm,80mm", "110mm,80mm; 110mm,-10mm"}) {
      Pair pair;
      ASSERT_EQ(pair.play("sew a=cuff_right." + std::string(edge) + " b=back.hem@0:0.2 name=held\n"), "");
      const auto heldAt = [&] {
        for (const auto& [id, seam] : pair.file.document().pattern.seams)
          if (const Edge* own = findEdge(*pair.file.document().find(seam.a.front().piece), seam.a.front().edge))
            return own->curve.atFraction(0.5);
        return Flat{1, 1};
      };
      const Flat before = heldAt();
      ASSERT_EQ(pair.play("cut piece=cuff_left line=\"" + std::string(cut) + "\" name=half copies=yes\n"), "");
      expectImages(pair, "cuff_left", "cuff_right");
      expectImages(pair, "half", "half_mirrored");
      EXPECT_LT(distance(heldAt(), before), 1e-9) << edge << ": the seam stays where it is";
    }
}

TEST(Copies, AreLeftAloneByACutThatDoesNotNameThem) {
  Pair pair;
  ASSERT_EQ(pair.play("cut piece=front_left line=\"-10mm,150mm; 400mm,150mm\" name=upper\n"), "");
  EXPECT_FALSE(pair.file.document().pieceNamed("upper_mirrored"));
  EXPECT_THAT(pair.advice, testing::Contains(HasSubstr("no longer alike")));
  EXPECT_THAT(pair.play("cut piece=back line=\"-10mm,150mm; 400mm,150mm\" copies=yes\n"),
              HasSubstr("has no symmetric copy"));
  EXPECT_THAT(pair.play("merge a=front_left.cut b=upper.cut copies=yes\n"), HasSubstr("have no symmetric copies"));
}

// Two fronts that become one leave nothing that could be unlike; what is advised takes the side out of the name.
TEST(Copies, ThatAreMergedAreOnePiece) {
  Pair pair;
  std::vector<Operation> mends;
  std::vector<std::string> said;
  pair.room.context.advise = [&](const Advice& told) {
    said.push_back(text(told.what));
    if (told.mend) mends.push_back(*told.mend);
  };
  ASSERT_TRUE(pair.room.play(pair.file, "merge a=front_left.centre b=front_right.centre\n"));
  EXPECT_THAT(said, testing::Not(testing::Contains(HasSubstr("no longer alike"))));
  ASSERT_EQ(mends.size(), 1u);
  EXPECT_EQ(text(mends.front()), "rename piece=front_left to=front");
  ASSERT_TRUE(pair.room.play(pair.file, text(mends.front()) + "\n"));
  EXPECT_TRUE(pair.file.document().pieceNamed("front"));
}

// Across a dart: both halves of the yoke are merged by the one step that is advised.
TEST(Copies, GetTheirYokesInOneStep) {
  Pair pair("dart edge=front_left.hem at=0.5 tip=150mm,120mm width=3cm\n");
  std::vector<Operation> mends;
  pair.room.context.advise = [&](const Advice& told) {
    if (told.mend) mends.push_back(*told.mend);
  };
  ASSERT_EQ(pair.play("cut piece=front_left line=\"-10mm,50mm; 400mm,70mm\" name=yoke_left copies=yes\n"), "");
  EXPECT_EQ(pair.file.document().pattern.pieces.size(), 9u);
  ASSERT_EQ(mends.size(), 1u);
  ASSERT_EQ(pair.play(text(mends.front()) + "\n"), "");
  EXPECT_EQ(pair.file.document().pattern.pieces.size(), 7u);
  expectImages(pair, "front_left", "front_right");
  expectImages(pair, "yoke_left", "yoke_right");
}

// Cuts at random: parts stay images of each other, and undone nothing is left.
TEST(Copies, AreCutLikewiseWhereverTheCutRuns) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  int done = 0;
  for (int round = 0; round < 40; ++round) {
    Pair pair("dart edge=front_left.hem at=0.5 tip=150mm,120mm width=3cm\n");
    CutPiece cut;
    cut.piece = PieceRef(pair["front_left"].id);
    const double low = 0.02 + 0.4 * share(random), high = 0.02 + 0.4 * share(random);
    cut.line = {{-0.02, low}, {0.4, high}};
    if (round % 2) cut.line = {{0.02 + 0.25 * share(random), -0.02}, {0.02 + 0.25 * share(random), 0.6}};
    cut.name = "part_left", cut.copies = Choice::Yes;
    const std::string said = pair.play(text(Operation(cut)) + "\n");
    if (!said.empty()) continue;  // as through the very point of the dart
    ++done;
    std::size_t pairs = 0;
    for (const auto& [id, piece] : pair.file.document().pattern.pieces)
      if (const Piece* own = pair.file.document().find(piece->mirrorOf)) {
        ++pairs;
        expectImages(pair, own->name.c_str(), piece->name.c_str());
      }
    EXPECT_EQ(pairs * 2, pair.file.document().pattern.pieces.size() - 1) << text(Operation(cut));
  }
  EXPECT_GT(done, 30);
}

const Seam* seamBetween(const Document& document, const char* one, const char* other) {
  const auto on = [&](const std::vector<EdgeSpan>& side, const char* name) {
    return std::all_of(side.begin(), side.end(),
                       [&](const EdgeSpan& span) { return document.find(span.piece)->name == name; });
  };
  for (const auto& [id, seam] : document.pattern.seams)
    if ((on(seam.a, one) && on(seam.b, other)) || (on(seam.a, other) && on(seam.b, one))) return &seam;
  return nullptr;
}

// The place on paper at a share of a run's length.
Flat placeAlong(const Document& document, const std::vector<EdgeSpan>& run, double share) {
  double whole = 0;
  for (const EdgeSpan& span : run) whole += findCurve(*document.find(span.piece), span.edge)->length();
  double left = share * whole;
  for (const EdgeSpan& span : run) {
    const Curve& curve = *findCurve(*document.find(span.piece), span.edge);
    if (left <= curve.length() + 1e-12) return curve.atFraction(std::min(1.0, left / curve.length()));
    left -= curve.length();
  }
  return findCurve(*document.find(run.back().piece), run.back().edge)->end;
}

// A second frill is sewn to the other front, by edges that run the other way; one that is sewn there already stays.
TEST(Copies, AreSewnToTheCopiesOfWhatThePieceIsSewnTo) {
  Pair pair(
      "piece name=frill_left outline=\"M 0 0; low L 450 0; end L 450 60; top L 0 60; begin L 0 0\"\n"
      "sew a=frill_left.low b=front_left.hem name=frill_left\n"
      "sew a=frill_left.end b=cuff_left.low\nsew a=cuff_right.low b=back.hem\n");
  pair.advice.clear();
  ASSERT_EQ(pair.play("mirror piece=frill_left sewn=yes\n"), "");
  const Document& now = pair.file.document();
  const Seam* seam = seamBetween(now, "frill_right", "front_right");
  const Seam& own = *seamBetween(now, "frill_left", "front_left");
  ASSERT_TRUE(seam);
  EXPECT_EQ(seam->name, "frill_right");
  EXPECT_EQ(seam->reversed, own.reversed);
  EXPECT_EQ(seam->tie, own.tie);
  for (const double share : {0.0, 0.3, 1.0}) {
    EXPECT_LT(distance(placeAlong(now, seam->a, share), across(placeAlong(now, own.a, 1 - share))), 1e-9);
    EXPECT_LT(distance(placeAlong(now, seam->b, share), across(placeAlong(now, own.b, 1 - share))), 1e-9);
  }
  EXPECT_EQ(seamBetween(now, "frill_right", "cuff_right"), nullptr);
  EXPECT_THAT(pair.advice, ::testing::ElementsAre(HasSubstr("is on the side of")));
}

// A second pocket is sewn onto the other front, or the other half of a symmetric piece, whose lines are drawn; not
// where it would lie on the first.
TEST(Copies, OfPocketsAreSewnToLinesOfTheirOwn) {
  for (const bool halves : {false, true}) {
    const std::string on = halves ? "skirt" : "front_left", other = halves ? "skirt" : "front_right";
    Pair pair(
        "piece name=skirt outline=\"M -300 0; hem L 300 0; side_left L 250 500; waist L -250 500; side_right L -300 "
        "0\"\n"
        "rectangle name=pocket_left width=10cm height=12cm\npatch piece=pocket_left open=top at=15cm,20cm on=" +
        on + "\n");
    pair.advice.clear();
    ASSERT_EQ(pair.play("mirror piece=pocket_left\n"), "");
    EXPECT_THAT(pair.advice, ::testing::ElementsAre(HasSubstr("sewn=yes does that")));
    ASSERT_EQ(pair.play("remove piece=pocket_right\nmirror piece=pocket_left sewn=yes\n"), "");
    const Document& now = pair.file.document();
    const Seam* seam = seamBetween(now, "pocket_right", other.c_str());
    ASSERT_TRUE(seam);
    EXPECT_EQ(seam->b.size(), 3u);
    const Flat middle{0, 0.06}, at{0.15, 0.2};
    for (const double share : {0.0, 0.1, 0.3, 0.5, 0.8, 1.0}) {
      const Flat edge = across(placeAlong(now, seam->a, share)),
                 line = across(placeAlong(now, seam->b, seam->reversed ? 1 - share : share));
      EXPECT_LT(distance(edge - middle + at, line), 1e-9) << halves << share;
    }
  }
  Pair pair(
      "piece name=skirt outline=\"M -300 0; hem L 300 0; side_left L 300 500; waist L -300 500; side_right L -300 0\"\n"
      "rectangle name=pouch width=20cm height=12cm\npatch piece=pouch on=skirt at=2cm,20cm open=top\n");
  pair.advice.clear();
  ASSERT_EQ(pair.play("mirror piece=pouch sewn=yes\n"), "");
  EXPECT_THAT(pair.advice, ::testing::ElementsAre(HasSubstr("in the same place"), HasSubstr("is on the side of")));
  EXPECT_EQ(pair["skirt"].lines.size(), 3u);
}

}  // namespace
}  // namespace karinui
