// Two pieces made one: what is sewn, pinned, marked and graded comes along.
#include <gmock/gmock.h>

#include "design/workroom.h"
#include "karinui/pattern/grading.h"

namespace karinui {
namespace {

using testing::HasSubstr;

// Front and back, each in two parts one above the other; a side seam runs over all four.
const char* const kParts =
    "piece name=front outline=\"M 0 0; hem L 200 0; side L 200 250; join L 0 250; centre L 0 0\"\n"
    "piece name=yoke outline=\"M 0 0; join L 200 0; side L 200 150; top L 0 150; centre L 0 0\" pose=\"0,0.6,0\"\n"
    "piece name=back outline=\"M 0 0; hem L 200 0; centre L 200 400; top L 0 400; side L 0 0\" pose=\"0.5,0,0\"\n"
    "sew a=\"front.side yoke.side\" b=back.side name=side\n"
    "sew a=front.join b=yoke.join name=across\n";

const Seam* seamNamed(const Document& document, const std::string& name) {
  for (const auto& [id, seam] : document.pattern.seams)
    if (seam.name == name) return &seam;
  return nullptr;
}

TEST(Merge, KeepsTheSeamsRoundBothPieces) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kParts));
  ASSERT_TRUE(room.play(file, "pin piece=yoke at=\"100mm,140mm\"\nmerge a=front.join b=yoke.join\n"));
  const Document& now = file.document();
  EXPECT_FALSE(now.pieceNamed("yoke"));
  EXPECT_FALSE(seamNamed(now, "across"));
  const Piece& front = *now.pieceNamed("front");
  EXPECT_NEAR(front.outline.area(), 0.2 * 0.4, 1e-9);
  const Seam* side = seamNamed(now, "side");
  ASSERT_TRUE(side);
  EXPECT_NEAR(length(now.pattern, side->a), 0.4, 1e-9);
  for (const EdgeSpan& span : side->a) EXPECT_EQ(span.piece, front.id);
  ASSERT_EQ(now.pins.at(front.id).size(), 1u);
  EXPECT_LT(distance(now.pins.at(front.id)[0], {0.1, 0.39}), 1e-9);
}

TEST(Merge, SharesADeclaredEaseWithWhatIsStillSewn) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kParts));
  ASSERT_TRUE(room.play(file, "ease seam=side by=8mm\ncut piece=back line=\"-10mm,250mm; 210mm,250mm\" name=above\n"));
  const Document before = file.document();
  const std::string upper = before.pieceNamed("back")->outline.area() < 0.04 ? "back" : "above";
  const std::string edge = findEdge(*before.pieceNamed(upper), "side") ? "side" : "side_2";
  const SeamId id = seamNamed(before, "side")->id;
  ASSERT_TRUE(room.play(file, "merge a=yoke.side b=" + upper + "." + edge + "\n"));
  const Document& now = file.document();
  ASSERT_TRUE(now.find(id));
  EXPECT_NEAR(length(now.pattern, now.find(id)->a), 0.25, 1e-9);
  EXPECT_NEAR(length(now.pattern, now.find(id)->b), 0.25, 1e-9);
  EXPECT_NEAR(now.eases.at(id), 0.008 * 0.25 / 0.4, 1e-9);
  EXPECT_NEAR(now.pieceNamed("yoke")->outline.area(), 0.4 * 0.15, 1e-9);
}

TEST(Merge, IsDoneInAllSizes) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kParts));
  ASSERT_TRUE(room.play(
      file, "grade sizes=\"S M L\" base=M\ngrade corners=\"front.side front.join yoke.side\" by=5mm,0 symmetric=no\n"));
  DocumentFile narrow = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(narrow, kParts));
  ASSERT_TRUE(room.play(narrow, "grade sizes=\"S M L\" base=M\ngrade corners=yoke.side by=5mm,0\n"));
  EXPECT_THAT(text(room.play(narrow, "merge a=front.join b=yoke.join\n").error().what), HasSubstr("In size S: "));
  ASSERT_TRUE(room.play(file, "merge a=front.join b=yoke.join\nsize name=L\n"));
  // A trapeze of 205 and 200 mm over a rectangle 205 mm wide.
  EXPECT_NEAR(file.document().pieceNamed("front")->outline.area(), 0.205 * 0.25 + (0.205 + 0.2) / 2 * 0.15, 1e-6);
  EXPECT_THAT(text(room.play(file,
                             "cut piece=front line=\"-10mm,100mm; 300mm,100mm\" name=low\n"
                             "merge a=front.cut b=low.cut\n")
                       .error()
                       .what),
              HasSubstr("size name=M"));
}

TEST(Merge, RefusesWhatIsSewnOrFastenedElsewhere) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kParts));
  const auto reason = [&](const std::string& step) {
    const auto done = room.play(file, step + "\n");
    return done ? std::string() : text(done.error().what);
  };
  EXPECT_THAT(reason("merge a=front.side b=back.centre"), HasSubstr("is sewn to something else, by seam side"));
  EXPECT_THAT(reason("merge a=front.side b=front.centre"), HasSubstr("edges of one piece"));
  EXPECT_THAT(reason("merge a=\"front.side yoke.side\" b=back.side"), HasSubstr("lies on one piece"));
  EXPECT_THAT(reason("merge a=front.join b=yoke.gone"), HasSubstr("gone"));
  EXPECT_THAT(reason("merge a=front.centre b=yoke.centre"), HasSubstr("250.0 and 150.0 mm"));
  ASSERT_TRUE(room.play(file, "unsew seam=across\nfasten a=front.join b=yoke.join count=3 name=row\n"));
  EXPECT_THAT(reason("merge a=front.join b=yoke.join"), HasSubstr("“row” fastens the edge"));
}

// Cloth at rest stays where it is: the cut and what takes it back are paper alone.
TEST(Merge, LeavesTheClothWhereItStands) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file,
                        "set spacing=20mm\n"
                        "piece name=cloth outline=\"M 0 0; hem L 400 0; right L 400 500; top L 0 500; left L 0 0\"\n"
                        "pin piece=cloth at=\"0,500mm; 400mm,500mm\"\ndrape\n"));
  const Piece whole = *file.document().pieceNamed("cloth");
  ASSERT_TRUE(whole.form);
  ASSERT_TRUE(room.play(file,
                        "cut piece=cloth line=\"-10mm,200mm; 410mm,230mm\" name=other\n"
                        "sew a=cloth.cut b=other.cut\nmerge a=cloth.cut b=other.cut\n"));
  const Piece& now = *file.document().pieceNamed("cloth");
  ASSERT_TRUE(now.form);
  const Stand before(whole), after(now);
  for (double u = 0.01; u < 0.4; u += 0.03)
    for (double v = 0.01; v < 0.5; v += 0.03) EXPECT_LT(distance(before({u, v}), after({u, v})), 1e-3) << u << " " << v;
}

// Apart in space, the second goes on from where the first one's cloth ends.
TEST(Merge, LeadsWhatStandsElsewhereAlongTheEdge) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kParts));
  ASSERT_TRUE(
      room.play(file, "set spacing=20mm\nunsew seam=side\npin piece=front at=\"0,0; 200mm,0\"\ndrape live=front\n"));
  ASSERT_TRUE(room.play(file, "merge a=front.join b=yoke.join\n"));
  const Piece& front = *file.document().pieceNamed("front");
  const Stand stand(front);
  EXPECT_LT(distance(stand({0.1, 0.245}), stand({0.1, 0.265})), 0.03);
  EXPECT_NEAR(distance(stand({0.1, 0.25}), stand({0.1, 0.39})), 0.14, 0.03);
}

}  // namespace
}  // namespace karinui
