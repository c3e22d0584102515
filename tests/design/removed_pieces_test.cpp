// What is left of the seams when pieces are taken away.
#include <gmock/gmock.h>

#include <random>

#include "design/workroom.h"

namespace karinui {
namespace {

// Two panels sewn along a side, 400 mm high, both cut across at 150 mm: the seam is a run over two pieces on each side.
const char* const kCutAcross =
    "piece name=front outline=\"M 0 0; hem L 200 0; side L 200 400; top L 0 400; free L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 200 0; free L 200 400; top L 0 400; side L 0 0\"\n"
    "sew a=front.side b=back.side name=side\nease seam=side by=8mm\n"
    "cut piece=front line=\"-10mm,150mm; 210mm,150mm\" name=front_other\n"
    "cut piece=back line=\"-10mm,150mm; 210mm,150mm\" name=back_other\n";

struct CutAcross {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  CutAcross() { EXPECT_TRUE(room.play(file, kCutAcross)); }
  // The name of the upper part of a panel.
  std::string upper(const std::string& panel) const {
    const Piece& piece = *file.document().pieceNamed(panel);
    return piece.outline.area() > 0.04 ? panel : panel + "_other";
  }
  const Seam* side() const {
    for (const auto& [id, seam] : file.document().pattern.seams)
      if (seam.name == "side") return &seam;
    return nullptr;
  }
};

TEST(RemovedPieces, LeaveTheSeamOfThoseThatStay) {
  CutAcross cut;
  ASSERT_TRUE(cut.side());
  const SeamId id = cut.side()->id;
  ASSERT_EQ(cut.side()->a.size(), 2u);
  ASSERT_TRUE(cut.room.play(cut.file, "remove piece=\"" + cut.upper("front") + " " + cut.upper("back") + "\"\n"));
  ASSERT_TRUE(cut.side());
  EXPECT_EQ(cut.side()->id, id);
  const Pattern& pattern = cut.file.document().pattern;
  EXPECT_NEAR(length(pattern, cut.side()->a), 0.15, 1e-9);
  EXPECT_NEAR(length(pattern, cut.side()->b), 0.15, 1e-9);
  for (const auto* side : {&cut.side()->a, &cut.side()->b}) {
    ASSERT_EQ(side->size(), 1u);
    EXPECT_EQ(side->front().from, 0);
    EXPECT_EQ(side->front().to, 1);
  }
  EXPECT_NEAR(cut.file.document().eases.at(id), 0.008 * 0.15 / 0.4, 1e-9);
  EXPECT_THAT(text(cut.file.steps().back().operation), testing::HasSubstr("seams=yes"));
}

TEST(RemovedPieces, LeaveOpenWhatWasSewnToThem) {
  CutAcross cut;
  ASSERT_TRUE(cut.room.play(cut.file, "remove piece=" + cut.upper("front") + "\n"));
  ASSERT_TRUE(cut.side());
  const Pattern& pattern = cut.file.document().pattern;
  EXPECT_NEAR(length(pattern, cut.side()->a), 0.15, 1e-9);
  EXPECT_NEAR(length(pattern, cut.side()->b), 0.15, 1e-9);
  EXPECT_EQ(cut.side()->b.size(), 1u) << "nothing of the upper back";
}

TEST(RemovedPieces, TakeTheirOwnSeamsAndThoseOfOldRecords) {
  CutAcross cut;
  const Document before = cut.file.document();
  cut.room.context.recorded = true;
  const auto old = apply(before, *parseOperation("remove piece=" + cut.upper("front")), cut.room.context);
  ASSERT_TRUE(old);
  EXPECT_TRUE(std::none_of(old->pattern.seams.begin(), old->pattern.seams.end(),
                           [](const auto& seam) { return seam.second.name == "side"; }));
  cut.room.context.recorded = false;
  ASSERT_TRUE(cut.room.play(cut.file, "remove piece=\"front front_other\"\n"));
  EXPECT_FALSE(cut.side());
  EXPECT_EQ(text(cut.file.steps().back().operation).find("seams"), std::string::npos);
}

// Strips in a row on either side of one seam, of random heights, some of which go: what stays has two sides of one
// share of it, and nothing is sewn twice.
TEST(RemovedPieces, AnyOfThem) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 60; ++trial) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    std::string script, sides[2], gone;
    int left = 0;
    for (int side = 0; side < 2; ++side) {
      const int count = 1 + static_cast<int>(random() % 4);
      for (int k = 0; k < count; ++k) {
        const std::string name = (side == 0 ? "a" : "b") + std::to_string(k), high = std::to_string(20 + random() % 90);
        // The edge runs upwards on side a, downwards on side b.
        script += "piece name=" + name + " outline=\"M 0 0; low L 50 0; right L 50 " + high + "; top L 0 " + high +
                  "; left L 0 0\"\n";
        const std::string edge = name + (side == 0 ? ".right" : ".left");
        sides[side] = side == 0 || sides[side].empty() ? sides[side] + " " + edge : edge + " " + sides[side];
        if (random() % 3 == 0)
          gone += " " + name;
        else
          ++left;
      }
    }
    if (gone.empty() || left == 0) continue;
    ASSERT_TRUE(room.play(file, script + "sew a=\"" + sides[0] + "\" b=\"" + sides[1] + "\" reversed=yes\n")) << script;
    const Pattern before = file.document().pattern;
    const Seam whole = before.seams.begin()->second;
    const double ratio = length(before, whole.b) / length(before, whole.a);
    ASSERT_TRUE(room.play(file, "remove piece=\"" + gone + "\"\n")) << gone;
    const Pattern& pattern = file.document().pattern;
    double sewn = 0;
    for (const auto& [id, seam] : pattern.seams) {
      EXPECT_NEAR(length(pattern, seam.b) / length(pattern, seam.a), ratio, 1e-6);
      for (const auto* side : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *side) EXPECT_TRUE(pattern.pieces.contains(span.piece));
      sewn += length(pattern, seam.a);
    }
    EXPECT_LE(sewn, length(before, whole.a) + 1e-9);
    ASSERT_TRUE(file.undo(room.context));
    EXPECT_EQ(file.document().pattern.seams, before.seams);
  }
}

}  // namespace
}  // namespace karinui
