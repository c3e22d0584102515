// What a document keeps of its last drape.
#include <gtest/gtest.h>

#include "design/pack.h"

namespace karinui {
namespace {

TEST(KeptReport, ComesBackWithWhatTheMergedPlanesSaved) {
  Document document;
  SettleReport& report = document.drape.last.emplace();
  report.why = say("At rest.");
  report.steps = 321;
  for (const bool settled : {false, true})
    for (const bool merged : {false, true}) {
      report.settled = settled;
      report.merged.reset();
      if (merged) report.merged = MergeReport{9000, 700, 12, 345};
      const auto back = unpackRest(packRest(document));
      ASSERT_TRUE(back) << text(back.error().what);
      const SettleReport& found = *back->drape.last;
      EXPECT_EQ(found.settled, settled);
      EXPECT_EQ(found.steps, 321u);
      ASSERT_EQ(found.merged.has_value(), merged);
      if (!merged) continue;
      EXPECT_EQ(found.merged->facesBefore, 9000u);
      EXPECT_EQ(found.merged->planesAfter, 700u);
      EXPECT_EQ(found.merged->testsDone, 12u);
      EXPECT_EQ(found.merged->testsSaved, 345u);
    }
}

}  // namespace
}  // namespace karinui
