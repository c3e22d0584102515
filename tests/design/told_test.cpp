// What an operation tells beside doing it names what it means: of many seams and pieces one has to be found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::AllOf, ::testing::Contains, ::testing::HasSubstr;

std::vector<std::string> toldOf(const std::string& script) {
  Workroom room;
  std::vector<std::string> told;
  room.context.advise = [&](const Advice& said) { told.push_back(text(said.what)); };
  DocumentFile file = DocumentFile::inMemory();
  const Done done = room.play(file, script);
  EXPECT_TRUE(done) << text(done.error().what);
  return told;
}

const char* const kTwo =
    "piece name=front outline=\"M 0 0; hem L 400 0; side_left L 400 500; neck L 0 500; side_right L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 400 0; side_right L 400 500; neck L 0 500; side_left L 0 0\" "
    "pose=\"0.4,0,-0.3 y 180deg\"\n";

TEST(Told, ASeamWhoseThreadsCrossIsNamed) {
  EXPECT_THAT(toldOf(std::string(kTwo) + "sew a=front.side_right b=back.side_right reversed=no\n"),
              Contains(AllOf(HasSubstr("threads"), HasSubstr("front.side_right"), HasSubstr("back.side_right"))));
}

}  // namespace
}  // namespace karinui
