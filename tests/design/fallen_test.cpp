// What comes to rest where it is not worn is told of.
#include <gmock/gmock.h>

#include "design/workroom.h"

namespace karinui {
namespace {

// All pieces come to rest so much lower.
std::vector<std::string> toldAfterFalling(double metres, const std::string& more = {}) {
  Workroom room;
  room.context.drape = [&](const Document& document, const DrapePieces& drape, Context&) {
    auto outcome = fallABit(document, drape.live);
    for (auto& [id, form] : outcome->forms) {
      auto lower = std::make_shared<Form>(*form);
      for (Vec3& p : lower->space) p.y += 0.01 - metres;
      form = lower;
    }
    return outcome;
  };
  DocumentFile file = DocumentFile::inMemory();
  EXPECT_TRUE(room.play(file, kTwoPieces));
  EXPECT_TRUE(room.play(file, "sew a=front.side_left b=back.side_right\n" + more));
  std::vector<std::string> told;
  room.context.advise = [&](const Advice& advice) { told.push_back(text(advice.what)); };
  EXPECT_TRUE(room.play(file, "drape\n"));
  return told;
}

TEST(Fallen, IsToldOnceForWhatHangsTogether) {
  EXPECT_THAT(toldAfterFalling(0.4), testing::ElementsAre(testing::HasSubstr("has slid down by 40 cm")));
  EXPECT_THAT(toldAfterFalling(0.2), testing::IsEmpty()) << "as far as cloth settles";
  EXPECT_THAT(toldAfterFalling(0.4, "pin piece=front at=0,0\n"), testing::IsEmpty()) << "it hangs from its pin";
}

}  // namespace
}  // namespace karinui
