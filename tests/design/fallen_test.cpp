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

// Two sheets before the body, one a centimetre in front of the other.
TEST(Layers, ThatChangedPlacesAreTold) {
  const auto told = [](int inner, int outer) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const auto sheet = [](const char* name, const char* pose, int layer) {
      return std::string("piece name=") + name +
             " outline=\"M 0 0; hem L 200 0; left L 200 200; top L 0 200; right L 0 0\" pose=\"" + pose +
             "\" layer=" + std::to_string(layer) + "\n";
    };
    EXPECT_TRUE(room.play(file, "body size=eu38\n" + sheet("shield", "-0.1,0.9,0.3", inner) +
                                    sheet("leg", "-0.1,0.9,0.29", outer) + "sew a=shield.left b=leg.left\n"));
    std::vector<std::string> all;
    room.context.advise = [&](const Advice& advice) { all.push_back(text(advice.what)); };
    EXPECT_TRUE(room.play(file, "drape\n"));
    return all;
  };
  EXPECT_THAT(told(0, 1), testing::ElementsAre(testing::HasSubstr("“shield” came to rest outside “leg”")));
  EXPECT_THAT(told(1, 0), testing::IsEmpty()) << "as it was meant";
  EXPECT_THAT(told(0, 0), testing::IsEmpty()) << "nothing is said of which lies outside";
}

}  // namespace
}  // namespace karinui
