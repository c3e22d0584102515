// A cuff that is turned back on a sleeve that narrows to the wrist.
#include <gmock/gmock.h>

#include "design/quick_folder.h"
#include "design/workroom.h"
#include "karinui/pattern/piece.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 300 mm wide above and 200 mm at the hem, its two sides sewn to each other; the line lies 60 mm above the hem.
const char* const kSleeve =
    "piece name=sleeve outline=\"M -100 0; hem L 100 0; right L 150 400; top L -150 400; left L -100 0\" lines=\"turn "
    "M "
    "-107.5 60 L 107.5 60\"\n"
    "sew a=sleeve.left b=sleeve.right name=underarm\n";

class TurnedBack : public testing::Test {
 protected:
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::vector<Advice> advice;
  void SetUp() override {
    ASSERT_TRUE(room.play(file, kSleeve));
    room.context.advise = [this](const Advice& one) { advice.push_back(one); };
  }
  void perform(const Operation& operation) {
    advice.clear();
    const auto step = file.perform(operation, room.context);
    ASSERT_TRUE(step) << text(step.error().what);
  }
  void perform(const char* line) { perform(*parseOperation(line)); }
  double lengthOf(const char* edge) const {
    const Outline& outline = file.document().pieceNamed("sleeve")->outline;
    return outline.edges[*outline.find(edge)].curve.length();
  }
};

TEST_F(TurnedBack, ItIsToldHowMuchTooNarrowItIsAndMended) {
  perform("fold piece=sleeve line=turn angle=170deg turned=yes");
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_THAT(text(advice[0].what), HasSubstr("30.0 mm narrower"));
  EXPECT_NEAR(lengthOf("hem"), 0.2, 1e-9) << "nothing is changed without being asked";
  ASSERT_TRUE(advice[0].mend);
  perform(Operation(*advice[0].mend));
  EXPECT_THAT(advice, IsEmpty());
  EXPECT_NEAR(lengthOf("hem"), 0.23, 1e-9);
  const Document& document = file.document();
  EXPECT_NEAR(lengthMismatch(document.pattern, document.pattern.seams.begin()->second), 0, 1e-9)
      << "sewn along both parts still";
  EXPECT_EQ(document.pattern.seams.begin()->second.a.size(), 2u);
  EXPECT_TRUE(document.pieceNamed("sleeve")->lines.front().crease);
  // Each place of the cuff lies on the sleeve, 3 mm out from it at most.
  const Piece& sleeve = *document.pieceNamed("sleeve");
  ASSERT_TRUE(sleeve.form);
  double lowest = 1;
  for (const Vec3 p : sleeve.form->space) lowest = std::min(lowest, sleeve.pose.turned(p).y);
  double highest = -1;
  for (const Vec3 p : sleeve.form->space) highest = std::max(highest, sleeve.pose.turned(p).y);
  EXPECT_NEAR(highest - lowest, 0.34, 1e-3);
}

TEST_F(TurnedBack, CutToLieOnItAtOnce) {
  perform("fold piece=sleeve line=turn angle=170deg turned=yes flared=yes");
  EXPECT_THAT(advice, IsEmpty());
  EXPECT_NEAR(lengthOf("hem"), 0.23, 1e-9);
  EXPECT_NEAR(lengthOf("left_2"), lengthOf("right"), 1e-9);
  // The copy on the other side is cut likewise.
  ASSERT_TRUE(room.play(file, "mirror piece=sleeve name=other\n"));
  EXPECT_NEAR(file.document().pieceNamed("other")->outline.area(), file.document().pieceNamed("sleeve")->outline.area(),
              1e-9);
}

// A lapel's facing lay beneath it; turned back with it, it goes round the fold and lies above.
TEST_F(TurnedBack, ItsFacingGoesRoundTheFold) {
  ASSERT_TRUE(
      room.play(file,
                "piece name=front outline=\"M -100 0; hem L 100 0; right L 100 400; top L -100 400; left L -100 0\"\n"
                "facing edges=front.right width=7cm\n"
                "line piece=front along=\"5cm,0; 5cm,40cm\" name=roll_line\n"));
  const auto formOf = [](const Document& document, const char* name) { return document.pieceNamed(name)->form; };
  const Document flat = file.document();
  perform("fold piece=front line=roll_line angle=170deg turned=yes");
  const auto front = formOf(file.document(), "front"), facing = formOf(file.document(), "front_facing");
  TriangleMesh cloth{front->space, front->faces};
  const auto first = static_cast<std::uint32_t>(cloth.points.size());
  cloth.points.insert(cloth.points.end(), facing->space.begin(), facing->space.end());
  for (const auto& [a, b, c] : facing->faces) cloth.faces.push_back({first + a, first + b, first + c});
  EXPECT_THAT(selfCrossings(cloth), IsEmpty());
  for (std::size_t k = 0; k < facing->flat.size(); ++k) {
    const Flat paper = facing->flat[k];
    const Vec3 p = facing->space[k];
    EXPECT_NEAR(p.y, paper.v, 1e-9);
    const bool over = paper.u > 0.07;
    EXPECT_TRUE(!over || p.x < 0.05);
    if (over || paper.u < 0.05) {
      EXPECT_NEAR(p.z, over ? 0.006 : -0.003, 1e-9) << paper.u;
    }
  }
  const std::string asked = text(file.steps().back().operation);
  EXPECT_THAT(asked, HasSubstr("facings=yes"));
  // Not asked for, and in a record that does not know of it, it stays.
  for (const bool recorded : {false, true}) {
    room.context.recorded = recorded;
    const std::string line = "fold piece=front line=roll_line angle=170deg turned=yes";
    const auto after = apply(flat, *parseOperation(recorded ? line : line + " facings=no"), room.context);
    ASSERT_TRUE(after);
    EXPECT_EQ(formOf(*after, "front_facing")->space, formOf(flat, "front_facing")->space);
  }
}

// A straight side that was turned and stretched has no control points, whatever was worked out beside it.
TEST_F(TurnedBack, IsReadFromTheFileAsItWasCut) {
  const std::filesystem::path folder = quickFolder();
  {
    auto written = DocumentFile::create(folder / "sleeve.karinui");
    ASSERT_TRUE(written) << text(written.error().what);
    ASSERT_TRUE(room.play(*written, kSleeve));
    ASSERT_TRUE(room.play(*written, "fold piece=sleeve line=turn angle=170deg turned=yes flared=yes\n"));
  }
  const auto read = DocumentFile::open(folder / "sleeve.karinui");
  ASSERT_TRUE(read) << text(read.error().what);
  for (const Message& remark : read->remarks()) ADD_FAILURE() << text(remark);
  std::filesystem::remove_all(folder);
}

// The lapels of two fronts that are still sewn to each other along all of the middle.
TEST(LapelsSewnUp, AreTold) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  room.context.advise = [&](const Advice& one) { said += text(one.what) + "\n"; };
  const auto play = [&](const char* script) {
    said.clear();
    const Done done = room.play(file, script);
    ASSERT_TRUE(done) << text(done.error().what);
  };
  play(
      "piece name=front_left outline=\"M 0 0; hem L 250 0; side L 250 500; neck L 0 500; centre L 0 0\"\n"
      "mirror piece=front_left name=front_right\nsew a=front_left.centre b=front_right.centre name=opening\n"
      "line piece=front_left along=\"0,200mm; 80mm,500mm\" name=roll\n");
  play("fold piece=front_left line=roll angle=170deg turned=yes\n");
  EXPECT_THAT(said, HasSubstr("still sewn to right front, by seam"));
  ASSERT_TRUE(file.undo(room.context));
  play(
      "unsew seam=opening\nsew a=front_left.centre@0.65:1 b=front_right.centre@0:0.35\n"
      "fold piece=front_left line=roll angle=170deg turned=yes\n");
  EXPECT_THAT(said, ::testing::Not(HasSubstr("still sewn")));
}

}  // namespace
}  // namespace karinui
