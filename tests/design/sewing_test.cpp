// Seams before they are sewn: their mirror image, and what is asked about.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "design/workroom.h"
#include "karinui/design/sewing.h"

namespace karinui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Both stand across the centre, the back turned to it.
const char* const kAcross =
    "piece name=front pose=\"-0.2,0,0.1\" outline=\"M 0 0; hem L 400 0; side_left L 400 400; shoulder_left L 300 500; "
    "neck L 100 500; shoulder_right L 0 400; side_right L 0 0\"\n"
    "piece name=back pose=\"0.2,0,-0.1 y 180deg\" outline=\"M 0 0; hem L 400 0; side_right L 400 400; shoulder_right L "
    "300 500; neck L 100 500; shoulder_left L 0 400; side_left L 0 0\"\n";

class Sewing : public testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figure is built once
    return shared;
  }
  DocumentFile file = DocumentFile::inMemory();
  const Document& document() const { return file.document(); }

  void play(const std::string& script) {
    const Done done = room().play(file, script);
    ASSERT_TRUE(done) << text(done.error().what);
  }
  std::string refusal(const std::string& line) {
    auto step = file.perform(*parseOperation(line), room().context);
    return step ? "" : text(step.error().what);
  }
  SewEdges sew(const std::string& line) {
    auto op = resolved(document(), *parseOperation(line), room().context);
    EXPECT_TRUE(op) << line << (op ? "" : ": " + text(op.error().what));
    return op ? std::get<SewEdges>(*op) : SewEdges();
  }
  std::vector<SeamDoubt::Kind> doubts(const SewEdges& sew) {
    std::vector<SeamDoubt::Kind> kinds;
    for (const SeamDoubt& doubt : seamDoubts(document(), sew, room().bodies.known(document().body.hash).get()))
      kinds.push_back(doubt.kind);
    return kinds;
  }
  std::vector<std::string> seams() const {
    std::vector<std::string> all;
    const auto side = [&](const std::vector<EdgeSpan>& spans) {
      std::string words;
      for (const EdgeSpan& s : spans) {
        words += (words.empty() ? "" : "+") + document().find(s.piece)->name + "." + s.edge;
        if (s.from != 0 || s.to != 1) words += "@" + written(s.from) + ":" + written(s.to);
      }
      return words;
    };
    for (const auto& [id, seam] : document().pattern.seams)
      all.push_back(text(id) + (seam.name.empty() ? "" : " " + seam.name) + " " + side(seam.a) +
                    (seam.reversed ? " against " : " along ") + side(seam.b));
    return all;
  }
};

TEST_F(Sewing, TheMirrorImageIsSewnInTheSameStep) {
  play(kAcross);
  const std::string before = hash(document());
  play("sew a=front.side_left@0:0.25 b=back.side_left@0.75:1 name=side_left mirror=yes");
  EXPECT_THAT(seams(), ElementsAre("s3 side_left front.side_left@0:0.25 against back.side_left@0.75:1",
                                   "s3.2 side_right front.side_right@0.75:1 against back.side_right@0:0.25"));
  EXPECT_EQ(text(file.steps().back().operation),
            "sew a=p1.side_left@0:0.25 b=p2.side_left@0.75:1 name=side_left reversed=yes tie=1:1 mirror=yes");
  ASSERT_TRUE(file.undo(room().context));
  EXPECT_EQ(hash(document()), before) << "one undo takes both back";
}

TEST_F(Sewing, RunsAreMirroredInTheOutlinesOrder) {
  play(kAcross);
  play(
      "piece name=sleeve_left pose=\"0.5,0.3,0\" outline=\"M 0 0; low L 300 20; cuff L 300 380; high L 0 400; cap L 0 "
      "0\"\nmirror piece=sleeve_left\n");
  play("sew a=\"front.side_left@0.5:1 front.shoulder_left\" b=sleeve_left.cap mirror=yes");
  ASSERT_EQ(seams().size(), 2u);
  EXPECT_THAT(seams()[1], HasSubstr("front.shoulder_right+front.side_right@0:0.5 "));
  EXPECT_THAT(seams()[1], HasSubstr(" sleeve_right.cap"));
}

// A collar goes round the neck; its edges may be listed either way round, and meet the same places of the neckline.
TEST_F(Sewing, ARunListedAgainstTheOutlinesIsTurnedRound) {
  play(kAcross);
  play(
      "piece name=sleeve pose=\"0.5,0.3,0\" outline=\"M 0 0; low L 300 20; cuff L 300 380; high L 0 400; cap L 0 "
      "0\"\n");
  const auto listed = [&](const std::string& a) { return text(sew("sew a=\"" + a + "\" b=sleeve.cap")); };
  const std::string before = listed("front.side_left@0.5:1 front.shoulder_left front.neck");
  EXPECT_THAT(before, HasSubstr("a=\"p1.side_left@0.5:1; p1.shoulder_left; p1.neck\""));
  EXPECT_EQ(listed("front.neck front.shoulder_left front.side_left@0.5:1"), before);
  // Over a seam: the corners that it holds together follow each other, however far apart the pieces stand.
  play("sew a=front.shoulder_left b=back.shoulder_left\n");
  const std::string round = listed("back.neck front.neck");
  EXPECT_EQ(listed("front.neck back.neck"), round);
  EXPECT_THAT(round, HasSubstr("a=\"p2.neck; p1.neck\""));
  // Edges that follow each other neither way are sewn as they are listed.
  EXPECT_THAT(listed("front.hem front.neck"), HasSubstr("a=\"p1.hem; p1.neck\""));
  EXPECT_THAT(listed("front.neck front.hem"), HasSubstr("a=\"p1.neck; p1.hem\""));
}

TEST_F(Sewing, PiecesOfMirroredOutlineAreFoundByWhereTheyStand) {
  play(
      "piece name=a pose=\"0.3,0,0\" outline=\"M 0 0; x L 100 0; y L 60 200; z L 0 0\"\n"
      "piece name=b pose=\"0.3,0.3,0\" outline=\"M 0 0; x L 100 0; y L 60 200; z L 0 0\"\n"
      "piece name=c pose=\"-0.3,0,0\" outline=\"M 0 0; u L -60 200; v L -100 0; w L 0 0\"\n"
      "piece name=d pose=\"-0.3,0.3,0\" outline=\"M 0 0; u L -60 200; v L -100 0; w L 0 0\"\n");
  play("sew a=a.y b=b.x mirror=yes");
  ASSERT_EQ(seams().size(), 2u);
  EXPECT_THAT(seams()[1], testing::AnyOf(HasSubstr("c.v against d.w"), HasSubstr("c.v along d.w")));
}

TEST_F(Sewing, AMirrorImageThatIsNoneIsRefused) {
  play(kAcross);
  EXPECT_THAT(refusal("sew a=front.hem b=back.hem mirror=yes"), HasSubstr("is its own mirror image"));
  play("sew a=front.side_right b=back.side_right");
  EXPECT_THAT(refusal("sew a=front.side_left b=back.side_left mirror=yes"), HasSubstr("already sewn by seam s3"));
  play("piece name=odd pose=\"0.4,0,0\" outline=\"M 0 0; x L 100 0; y L 60 200; z L 0 0\"");
  EXPECT_THAT(refusal("sew a=front.shoulder_left b=odd.y mirror=yes"), HasSubstr("odd.y has no mirror image"));
  EXPECT_EQ(seams().size(), 1u);
}

TEST_F(Sewing, ASeamInTheWayIsReplacedInOneStep) {
  play(kAcross);
  play("sew a=front.side_left b=back.side_right\n");
  const std::string before = hash(document());
  EXPECT_THAT(refusal("sew a=front.side_left b=back.side_left"), HasSubstr("already sewn"));
  play("sew a=front.side_left b=back.side_left replace=yes");
  EXPECT_THAT(seams(), ElementsAre("s4 front.side_left against back.side_left"));
  ASSERT_TRUE(file.undo(room().context));
  EXPECT_EQ(hash(document()), before);
}

TEST_F(Sewing, NonsenseIsDoubted) {
  using enum SeamDoubt::Kind;
  play(kAcross);
  EXPECT_THAT(doubts(sew("sew a=front.shoulder_left b=back.shoulder_left")), IsEmpty());
  EXPECT_THAT(doubts(sew("sew a=front.side_left b=front.side_right")), IsEmpty()) << "a tube";
  EXPECT_THAT(doubts(sew("sew a=front.shoulder_right b=back.shoulder_left")), ElementsAre(OtherSide));
  EXPECT_THAT(doubts(sew("sew a=front.side_left b=front.shoulder_left")), ElementsAre(Folded));
  EXPECT_THAT(doubts(sew("sew a=front.side_left b=back.side_left reversed=no")), ElementsAre(Twisted));
  EXPECT_THAT(doubts(sew("sew a=front.side_left b=back.side_left@0:0.2")), ElementsAre(Gathered));
  const SewEdges again = sew("sew a=front.side_left b=back.side_left");
  play("sew a=front.side_left b=back.hem");
  EXPECT_THAT(doubts(again), ElementsAre(Sewn));
}

// Front and back of a drawing lie over each other as they were drawn, the right side of both up: the left of the back
// is where the right of the front is.
TEST_F(Sewing, PaperHasNoSidesOfABody) {
  play(
      "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 180 400; top L -180 400; side_right L -200 0\"\n"
      "piece name=back outline=\"M -200 0; hem L 200 0; side_right L 180 400; top L -180 400; side_left L -200 0\"\n");
  EXPECT_THAT(doubts(sew("sew a=front.side_left b=back.side_left")), IsEmpty());
  EXPECT_THAT(doubts(sew("sew a=front.side_right b=back.side_right")), IsEmpty());
}

// A godet in the lower part of a seam beside the centre back swings out beyond the centre.
TEST_F(Sewing, WhatBeginsAtOneCornerIsMeant) {
  play(
      "piece name=mid outline=\"M 0 0; hem L 200 0; low_left L 200 200; up_left L 200 400; waist L 0 400; up_right L 0 "
      "200; low_right L 0 0\" pose=\"-0.1,0,0\"\n"
      "piece name=side outline=\"M 0 0; hem L 100 0; out L 100 400; waist L 0 400; up L 0 200; low L 0 0\" "
      "pose=\"0.15,0,0\"\n"
      "piece name=godet outline=\"M 0 0; near L -400 -100; hem L 0 -200; far L 0 0\" pose=\"0.15,0.2,0\"\n"
      "sew a=godet.far b=side.low");
  const std::string line = "sew a=godet.near b=mid.low_left";
  EXPECT_THAT(doubts(sew(line)), testing::Contains(SeamDoubt::Kind::OtherSide));
  play("sew a=side.up b=mid.up_left");
  EXPECT_THAT(doubts(sew(line)), testing::Not(testing::Contains(SeamDoubt::Kind::OtherSide)));
}

TEST_F(Sewing, ADartAndASlitAreNoFold) {
  play(
      "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top_a L 220 500; dart_a L 200 400; dart_b L 180 "
      "500; top_b L 0 500; other L 0 0\"");
  EXPECT_THAT(doubts(sew("sew a=front.dart_a b=front.dart_b")), IsEmpty());
}

TEST_F(Sewing, WhatWasMeantIsProposed) {
  play(kAcross);
  const SewEdges wrong = sew("sew a=front.shoulder_right b=back.shoulder_left");
  const auto found = seamDoubts(document(), wrong, nullptr);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_TRUE(found[0].instead);
  EXPECT_EQ(text(*found[0].instead), "sew a=p1.shoulder_right b=p2.shoulder_right reversed=yes tie=1:1");
  const auto far = seamDoubts(document(), sew("sew a=front.side_left b=back.side_left@0:0.2"), nullptr);
  ASSERT_TRUE(far.at(0).instead);
  EXPECT_NEAR(lengthOf(document(), far[0].instead->a), 0.08 * mostGather(*preset("cotton")), 1e-4);
}

TEST_F(Sewing, HowMuchIsGatheredHangsOnTheFabric) {
  EXPECT_GT(mostGather(*preset("chiffon")), 3.4);
  EXPECT_NEAR(mostGather(*preset("cotton")), 3, 0.1);
  EXPECT_LT(mostGather(*preset("denim")), 1.8);
  EXPECT_EQ(mostGather(*preset("wool coating")), std::max(1.5, mostGather(*preset("wool coating"))));
}

TEST_F(Sewing, AScriptIsAdvised) {
  play(kAcross);
  std::vector<std::string> advice;
  Context own = room().context;
  own.advise = [&](const Advice& said) { advice.push_back(text(said.what)); };
  ASSERT_TRUE(file.perform(*parseOperation("sew a=front.shoulder_right b=back.shoulder_left"), own));
  EXPECT_THAT(advice, ElementsAre("front.shoulder_right and back.shoulder_left lie on opposite sides of the body."));
}

// Where both halves were sewn crosswise at once one step mends both.
TEST_F(Sewing, CrossedHalvesAreMendedTogether) {
  play(kAcross);
  std::optional<Operation> mend;
  Context own = room().context;
  own.advise = [&](const Advice& said) { mend = said.mend; };
  ASSERT_TRUE(file.perform(*parseOperation("sew a=front.shoulder_right b=back.shoulder_left mirror=yes"), own));
  ASSERT_TRUE(mend);
  const auto mended = file.perform(*mend, room().context);
  ASSERT_TRUE(mended) << text(mended.error().what);
  int alike = 0;
  for (const auto& [id, seam] : document().pattern.seams) alike += seam.a.front().edge == seam.b.front().edge;
  EXPECT_EQ(document().pattern.seams.size(), 2u);
  EXPECT_EQ(alike, 2);
}

// A strap may be sewn to an edge before it is bound or turned up as well as after; what is sewn all along is not free.
TEST(Finishing, IsOfAnEdgeThatHoldsAStrap) {
  const std::string top =
      "piece name=top outline=\"M 0 0; hem L 400 0; side L 400 300; upper L 0 300; centre L 0 0\"\n"
      "rectangle name=strap width=40cm height=1cm edges=\"low right long left\"\n";
  for (const char* finish : {"binding edges=top.upper width=5mm\n", "hem edges=top.upper width=1cm under=5mm\n"}) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(file, top + "sew a=strap.left b=top.upper@0.2:0.225\n" + finish);
    EXPECT_TRUE(done) << text(done.error().what);
    DocumentFile other = DocumentFile::inMemory();
    EXPECT_FALSE(room.play(other, top + "sew a=strap.low b=top.upper\n" + finish));
  }
}

// What is offered instead of a part is said in the numbers one would write.
TEST_F(Sewing, ThePartThatIsMeantIsSaidInRoundNumbers) {
  play(kAcross);
  std::vector<std::string> mends;
  Context own = room().context;
  own.advise = [&](const Advice& said) {
    if (said.mend) mends.push_back(text(*said.mend));
  };
  ASSERT_TRUE(file.perform(*parseOperation("sew a=front.shoulder_right@0:0.043 b=back.shoulder_left@0.957:1"), own));
  EXPECT_THAT(mends, testing::Contains(testing::EndsWith("@0:0.043 reversed=yes tie=1:1 replace=yes")));
}

// On the figure: shoulder to shoulder of one piece runs through the neck; the seams of a tunic are no matter of doubt.
TEST_F(Sewing, AThreadThroughTheBodyIsDoubted) {
  play(
      "body size=jis9ar\nset ease=12mm\n"
      "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
      "line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
      "torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; "
      "torso:hip@0\"\n"
      "draw name=back symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
      "line=\"torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
      "torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; "
      "torso:hip@0.5\"\n");
  ASSERT_TRUE(bodyOf(document(), room().context));
  for (const char* edge : {"shoulder_left", "shoulder_right", "side_left", "side_right"})
    EXPECT_THAT(doubts(sew("sew a=front." + std::string(edge) + " b=back." + edge)), IsEmpty()) << edge;
  EXPECT_THAT(doubts(sew("sew a=front.shoulder_right b=front.shoulder_left")), ElementsAre(SeamDoubt::Kind::Through));
  EXPECT_THAT(doubts(sew("sew a=front.shoulder_right b=back.shoulder_left")), ElementsAre(SeamDoubt::Kind::OtherSide));
  play("sew a=front.shoulder_left b=back.shoulder_left mirror=yes\nsew a=front.side_left b=back.side_left mirror=yes");
  EXPECT_EQ(seams().size(), 4u);
}

// None of the examples is doubted.
// Over the shoulders the back edges of a cape's halves lie nearly level, and as near to each other one way as the
// other.
TEST_F(Sewing, RightSidesTellTheDirectionWherePlacesDoNot) {
  play(
      "body size=eu38 set=\"belly_girth=104cm\"\n"
      "ring name=cape_left inner=\"neck_base_girth/2 + 2cm\" angle=140deg depth=70cm edges=\"hem back neck front\"\n"
      "place piece=cape_left at=\"torso:neck_base@0.25\" ease=2cm\nmirror piece=cape_left\n");
  const SewEdges backs = sew("sew a=cape_left.back b=cape_right.back");
  EXPECT_EQ(backs.reversed, Choice::Yes) << "neck to neck and hem to hem";
  EXPECT_THAT(doubts(backs), IsEmpty());
}

// The last edge of a gusset lies any way round until the cloth draws it there.
TEST_F(Sewing, SeamsThatAreThereTellTheDirection) {
  play(
      "piece name=front outline=\"M 0 0; low L 100 0; right L 100 300; top L 0 300; left L 0 0\"\n"
      "piece name=back pose=\"0.1,0,0\" outline=\"M 0 0; low L 100 0; right L 100 300; top L 0 300; left L 0 0\"\n"
      "piece name=gusset pose=\"0,-0.3,0 z -90deg\" outline=\"M 0 0; low L 80 0; right L 80 100; top L 0 100; left L 0 "
      "0\"\nline piece=gusset along=\"2cm,2cm; 2cm,8cm\" name=placket\n"
      "sew a=front.right b=back.left\n");
  const std::string last = "sew a=gusset.right b=back.low";
  EXPECT_EQ(sew(last).reversed, Choice::No) << "as they lie";
  play("sew a=gusset.left b=front.low\n");
  EXPECT_EQ(sew(last).reversed, Choice::Yes) << "right side to right side";
  EXPECT_THAT(doubts(sew(last)), IsEmpty());
  EXPECT_EQ(sew(last + " tie=pleat").reversed, Choice::No) << "cloth is laid onto itself there";
  EXPECT_EQ(sew("sew a=gusset.placket b=back.low").reversed, Choice::No) << "a line has cloth on both sides";
  play(last + " reversed=no");  // said so: the cloth is twisted, and tells nothing more
  EXPECT_EQ(sew("sew a=gusset.top b=back.top").reversed, sew("sew a=gusset.top b=front.top").reversed);
}

// A neighbour that stood still would be a wall: two centimetres at a shirt's front were felt as 38 newtons for 1.
TEST_F(Sewing, WhatHangsTogetherMovesWhenItIsPulled) {
  play(std::string(kAcross) +
       "sew a=front.side_left b=back.side_left\n"
       "piece name=apron pose=\"-0.2,0,0.3\" outline=\"M 0 0; hem L 400 0; side L 400 400; top L 0 400; end L 0 0\"\n"
       "piece name=bib outline=\"M 0 0; low L 200 0; side L 200 200; top L 0 200; end L 0 0\"\n"
       "fasten name=tie kind=tie a=front.hem b=apron.hem count=1\nsew a=back.hem b=bib.low\nfreeze piece=bib\n");
  const auto op = resolved(document(), *parseOperation("pull piece=front at=20cm,20cm by=0,0,5cm"), room().context);
  ASSERT_TRUE(op) << text(op.error().what);
  std::set<std::string> live;
  for (const PieceRef& ref : std::get<PullCloth>(*op).live) live.insert(document().find(ref.id)->name);
  EXPECT_THAT(live, testing::UnorderedElementsAre("front", "back", "apron")) << "and not what is frozen";
}

TEST_F(Sewing, TheExamplesAreNotDoubted) {
  namespace fs = std::filesystem;
  for (const auto& entry : fs::directory_iterator(fs::path(KARINUI_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".ops") continue;
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream in(entry.path());
    std::stringstream script;
    script << in.rdbuf();
    const auto lines = parseScript(script.str());
    ASSERT_TRUE(lines);
    DocumentFile garment = DocumentFile::inMemory();
    Context own = room().context;
    std::vector<std::string> advice;
    // A drape after the last seam changes no doubt.
    const auto sews = [](const ScriptLine& line) { return std::holds_alternative<SewEdges>(line.operation); };
    const auto rest = std::find_if(lines->rbegin(), lines->rend(), sews).base();
    for (auto at = lines->begin(); at != lines->end(); ++at) {
      const ScriptLine& line = *at;
      if (at >= rest && std::holds_alternative<DrapePieces>(line.operation)) continue;
      own.advise = {};
      if (std::holds_alternative<SewEdges>(line.operation))
        own.advise = [&](const Advice& said) { advice.push_back(text(said.what)); };
      ASSERT_TRUE(garment.perform(line.operation, own)) << text(line.operation);
    }
    EXPECT_THAT(advice, IsEmpty());
  }
}

TEST(SewnRuns, AreSewnAsTheyFollowEachOther) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const char* const script =
      "piece name=hem outline=\"M 0 0; one L 100 0; two L 200 10; three L 300 0; side L 300 200; top L 0 200; other L "
      "0 "
      "0\"\n"
      "piece name=band outline=\"M 0 -100; low L 300 -100; end L 300 -60; long L 0 -60; start L 0 -100\"\n";
  ASSERT_TRUE(room.play(file, script));
  const Document before = file.document();
  const std::string line = "sew a=\"hem.three hem.one hem.two\" b=band.long";
  const auto edges = [](const Document& document) {
    std::string all;
    for (const EdgeSpan& span : document.pattern.seams.begin()->second.a) all += span.edge + " ";
    return all;
  };
  EXPECT_EQ(edges(*apply(before, op(line), room.context)), "one two three ");
  room.context.recorded = true;
  EXPECT_EQ(edges(*apply(before, op(line), room.context)), "three one two ");
  room.context.recorded = false;
  // A band takes a run in any order, too.
  EXPECT_TRUE(apply(before, op("band name=low of=\"hem.two hem.one hem.three\" depth=3cm"), room.context));
  EXPECT_FALSE(apply(before, op("band name=low of=\"hem.one hem.three\" depth=3cm"), room.context));
}

// The fronts of a romper, named as one sees them, each from its own side: sewn as they were listed both sides came to
// the middle.
TEST(SewnRuns, GoOnFromPieceToPiece) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(
      file,
      "piece name=left pose=0,0,0.1 outline=\"M 0 0; hem L 200 0; side L 200 300; waist L 100 290; waist_2 L 0 300; "
      "centre L 0 0\"\n"
      "piece name=right pose=0,0,0.1 outline=\"M 0 0; centre L 0 300; waist_2 L -100 290; waist L -200 300; side L "
      "-200 0; hem L 0 "
      "0\"\nsew a=left.centre b=right.centre\n"
      "piece name=top pose=\"0,0.3,0\" outline=\"M -200 0; hem L 200 0; end L 200 200; up L -200 200; other L -200 "
      "0\"\n"));
  const Document before = file.document();
  const std::string line = "sew a=top.hem b=\"right.waist* left.waist*\"";
  const auto edges = [](const Document& document) {
    std::string all;
    for (const EdgeSpan& span : document.pattern.seams.rbegin()->second.b)
      all += document.find(span.piece)->name + "." + span.edge + " ";
    return all;
  };
  EXPECT_EQ(edges(*apply(before, op(line), room.context)), "left.waist left.waist_2 right.waist_2 right.waist ");
  room.context.recorded = true;
  EXPECT_EQ(edges(*apply(before, op(line), room.context)), "right.waist_2 right.waist left.waist left.waist_2 ");
  room.context.recorded = false;
  // What stands near goes on there, though nothing holds it: a front that opens, and a skirt whose zip is in the
  // middle.
  const std::string fronts = "sew a=top.hem b=\"right.hem left.hem\"";
  EXPECT_EQ(edges(*apply(before, op(fronts), room.context)), "right.hem left.hem ");
}

// “skirt.waist*” is every edge of the outline whose name begins so; the record names them.
TEST(SewnRuns, AreNamedByHowTheirNamesBegin) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(
      room.play(file,
                "piece name=skirt outline=\"M 0 0; hem L 300 0; side L 300 200; waist_left L 200 200; dart L 180 120; "
                "dart_2 L 160 200; waist_right L 0 200; other L 0 0\"\nsew a=skirt.dart b=skirt.dart_2\n"));
  ASSERT_TRUE(room.play(file, "band name=belt of=skirt.waist* depth=3cm sew=yes\n"));
  EXPECT_NE(file.log().find("of=\"p1.waist_left; p1.waist_right\""), std::string::npos) << file.log();
  const auto refused = apply(file.document(), op("band name=low of=skirt.neck* depth=3cm"), room.context);
  ASSERT_FALSE(refused);
  EXPECT_NE(text(refused.error().what).find("it has: hem, side, waist_left"), std::string::npos)
      << text(refused.error().what);
}

// A seam and a zip on the same stretch of an edge would tie a place to two others.
// What is free is told by thousandths of the edge; typed as it is told, it is sewn.
TEST(SewnRuns, EndAtWhatIsSewnAlready) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto play = [&](const std::string& line) {
    const Done done = room.play(file, line + "\n");
    return done ? std::string() : text(done.error().what);
  };
  ASSERT_EQ(play("rectangle name=leg width=299mm height=20cm\nrectangle name=other width=149mm height=20cm\n"
                 "rectangle name=shield width=15cm height=20cm\nsew a=leg.bottom@0:0.49832 b=other.bottom"),
            "");
  EXPECT_THAT(play("sew a=leg.bottom b=shield.bottom"), testing::HasSubstr("what is free: leg.bottom@0.498:1."));
  ASSERT_EQ(play("sew a=leg.bottom@0.498:1 b=shield.bottom name=shield"), "");
  EXPECT_THAT(file.log(), testing::HasSubstr("bottom@0.49832:1"));
  ASSERT_TRUE(file.undo(room.context));
  EXPECT_THAT(play("sew a=leg.bottom@0.49:1 b=shield.bottom"), testing::HasSubstr("already sewn"))
      << "2.5 mm are meant";
}

TEST_F(Sewing, ASeamKeepsClearOfAZip) {
  play(
      "piece name=over outline=\"M 0 0; hem L 200 0; centre L 200 300; neck L 0 300; side L 0 0\"\n"
      "piece name=under outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\" "
      "pose=\"0.2,0,0\"\n"
      "fasten name=opening kind=zip a=over.centre b=under.centre reversed=yes from=top length=20cm "
      "closed_length=0\n");
  EXPECT_THAT(refusal("sew a=over.centre b=under.centre reversed=yes"), HasSubstr("zip “opening”"));
  EXPECT_THAT(refusal("sew a=under.centre@0.5:0.9 b=over.centre@0:0.4"), HasSubstr("zip “opening”"));
  // Much of the zip is a mistake; a few millimetres of it are not seen, and its end was meant.
  play("sew a=over.centre@0:0.345 b=under.centre@0.64:1 reversed=yes\n");
  const Seam& seam = document().pattern.seams.begin()->second;
  EXPECT_NEAR(seam.a.front().to, 1.0 / 3, 1e-9);
  EXPECT_NEAR(seam.b.front().from, 2.0 / 3, 1e-9);
  // A lining or a placket is sewn to the edge that the zip is in.
  play(
      "rectangle name=placket width=10cm height=10cm\n"
      "sew a=over.centre@0.5:0.8 b=placket.side_left\n");
}

// A zip in a side that is sewn already: the seam is opened along it and stays sewn beside it, in one step.
TEST_F(Sewing, AZipOpensTheSeamItComesIn) {
  play(
      "piece name=over outline=\"M 0 0; hem L 200 0; side_left L 200 300; neck L 0 300; centre L 0 0\"\n"
      "piece name=under outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\" "
      "pose=\"0.2,0,0\"\n"
      "rectangle name=third width=10cm height=30cm\n"
      "sew a=over.side_left b=under.centre reversed=yes name=side\nease seam=side by=9mm\n");
  const Document sewn = document();
  const auto setAt = [&](const std::string& more) -> Document {
    const auto done =
        apply(sewn, op("fasten name=opening kind=zip a=over.side_left b=under.centre " + more), room().context);
    EXPECT_TRUE(done) << text(done.error().what);
    return done ? *done : sewn;
  };
  const auto sewnLength = [](const Document& after) {
    double all = 0;
    for (const auto& [id, seam] : after.pattern.seams) all += length(after.pattern, seam.a);
    return all;
  };
  // From the top: one part stays, and is the seam that was there.
  const Document top = setAt("length=20cm");
  ASSERT_EQ(top.pattern.seams.size(), 1u);
  const Seam& rest = top.pattern.seams.begin()->second;
  EXPECT_EQ(rest.id, sewn.pattern.seams.begin()->first);
  EXPECT_EQ(rest.name, "side");
  EXPECT_NEAR(rest.a.front().from, 0, 1e-9);
  EXPECT_NEAR(rest.a.front().to, 1.0 / 3, 1e-9);
  EXPECT_NEAR(rest.b.front().from, 2.0 / 3, 1e-9);
  EXPECT_NEAR(rest.b.front().to, 1, 1e-9);
  EXPECT_NEAR(top.eases.at(rest.id), 0.003, 1e-9);
  ASSERT_TRUE(top.allowances.fastenings.contains("opening"));
  EXPECT_NEAR(sewnLength(setAt("length=20cm from=bottom")), 0.1, 1e-9);
  // In the middle, as under an arm: a part on either side.
  const Document middle = setAt("first=5cm length=18cm");
  EXPECT_EQ(middle.pattern.seams.size(), 2u);
  EXPECT_NEAR(sewnLength(middle), 0.12, 1e-9);
  double eases = 0;
  for (const auto& [id, seam] : middle.pattern.seams) eases += middle.eases.at(id);
  EXPECT_NEAR(eases, 0.009 * 12 / 30, 1e-9);
  // The whole of it.
  EXPECT_TRUE(setAt("").pattern.seams.empty());

  EXPECT_THAT(refusal("fasten kind=zip a=over.side_left b=under.centre length=20cm unpick=no"),
              HasSubstr("unsew seam=side"));
  // What joins something else there is not opened.
  EXPECT_THAT(refusal("fasten kind=zip a=over.side_left b=third.side_left length=20cm"), HasSubstr("Seam side holds"));
  // Where the two sides of the zip lie far from each other in the seam, it is not clear what is to be opened.
  EXPECT_THAT(refusal("fasten kind=zip a=over.side_left@0.5:1 b=under.centre@0.2:0.7 length=12cm"),
              HasSubstr("Seam side holds"));
}

// On the symmetric copies only if it is asked for: a skirt has its zip on one side.
TEST_F(Sewing, AZipOpensTheSeamOfTheCopiesWhenAsked) {
  play(
      "piece name=front_left outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\"\n"
      "piece name=back_left outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\" "
      "pose=\"0,0,-0.2\"\n"
      "mirror piece=front_left\nmirror piece=back_left\n"
      "sew a=front_left.side b=back_left.side reversed=no\nsew a=front_right.side b=back_right.side reversed=no\n");
  const auto open = [&](const std::string& more) {
    const auto done =
        apply(document(), op("fasten kind=zip a=front_left.side b=back_left.side reversed=no length=20cm" + more),
              room().context);
    EXPECT_TRUE(done) << text(done.error().what);
    double sewn = 0;
    for (const auto& [id, seam] : done->pattern.seams) sewn += length(done->pattern, seam.a);
    return std::pair(done->allowances.fastenings.size(), sewn);
  };
  const auto one = open(""), both = open(" copies=yes");
  EXPECT_EQ(one.first, 1u);
  EXPECT_NEAR(one.second, 0.4, 1e-9);
  EXPECT_EQ(both.first, 2u);
  EXPECT_NEAR(both.second, 0.2, 1e-9);
}

}  // namespace
}  // namespace karinui
