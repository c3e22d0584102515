// Zips, and what is sewn on beyond their upper ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kTube =
    "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 200 400; waist L -200 400; side_right L -200 0\"\n"
    "piece name=back pose=\"0,0,-0.3 y 180deg\" outline=\"M -200 0; hem L 200 0; side_right L 200 400; waist L -200 "
    "400; "
    "side_left L -200 0\"\n"
    "sew a=front.side_left b=back.side_left name=left\nsew a=front.side_right b=back.side_right name=right\n";
constexpr const char* kBand = "band name=waistband of=\"front.waist back.waist\" depth=4cm sew=yes\n";
constexpr const char* kZip = "fasten kind=zip a=front.side_left b=back.side_left length=18cm\n";

std::string saidOf(const std::string& script) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  room.context.advise = [&](const Advice& one) { said += text(one.what) + "\n"; };
  const Done done = room.play(file, script);
  return done ? said : text(done.error().what);
}

TEST(Zip, ABandThatGoesOnClosedAboveItIsTold) {
  const std::string tube = kTube, band = kBand, zip = kZip;
  EXPECT_THAT(saidOf(tube + band + zip), HasSubstr("“waistband” goes on, closed, over the upper end of the zip"));
  EXPECT_THAT(saidOf(tube + zip + band), Not(HasSubstr("closed"))) << "it begins at the zip";
  EXPECT_THAT(saidOf(tube + zip), Not(HasSubstr("closed")));
  // Ended at that side, with its ends sewn to each other.
  EXPECT_THAT(saidOf(tube + "band name=waistband of=\"back.waist front.waist\" depth=4cm sew=yes\n" + zip),
              HasSubstr("goes on, closed"));
  // One that begins further down opens the side, not the edge.
  EXPECT_THAT(saidOf(tube + band + "fasten kind=zip a=front.side_left b=back.side_left length=18cm first=5cm\n"),
              Not(HasSubstr("closed")));
}

}  // namespace
}  // namespace karinui
