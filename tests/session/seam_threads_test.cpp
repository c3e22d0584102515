// Seams that would twist the cloth are marked, and no others.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {
namespace {

std::vector<CrossedSeam> crossedIn(const std::string& script) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, script);
  EXPECT_TRUE(played) << text(played.error().what);
  const auto body = room.bodies.find(file.document().body, room.blobs, room.workers, room.token);
  return crossedSeams(*snapshotOf(file.document(), body ? *body : nullptr));
}

TEST(CrossedSeams, AreThoseWhoseThreadsCross) {
  const std::string apart =
      "piece name=left outline=\"M 0 0; hem L 200 0; side L 200 300; top L 0 300; free L 0 0\"\n"
      "piece name=right outline=\"M 0 0; hem L 200 0; free L 200 300; top L 0 300; side L 0 0\" pose=\"0.3,0,0\"\n";
  EXPECT_TRUE(crossedIn(apart + "sew a=left.side b=right.side\n").empty());
  EXPECT_EQ(crossedIn(apart + "sew a=left.side b=right.side reversed=no\n").size(), 1u);
}

// A run round an armhole begins and ends in one place, whichever way it is sewn.
TEST(CrossedSeams, AreNoArmholesThatAreSewnAsTheyShould) {
  for (const char* block : {"block kind=shirt length=0\n", "block kind=bodice\nblock kind=sleeve length=24cm\n"})
    for (const CrossedSeam& one : crossedIn(std::string("body size=eu38\n") + block)) ADD_FAILURE() << text(one.seam);
}

}  // namespace
}  // namespace karinui
