// Cloth that is worn with its right side inwards.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/scene_of.h"

namespace karinui {
namespace {

TEST(InsideOut, AFacingShowsItsRightSideInwards) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, R"(rectangle name=panel width=20cm height=30cm
facing edges=panel.top width=5cm
rectangle name=other width=20cm height=30cm fabric=silk
facing edges=other.top width=5cm
look fabric=cotton colour=ff0000 print=stripe ink=00ff00 wrong=0000ff
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const auto frame = sceneOf(file.document(), nullptr);
  ASSERT_TRUE(frame);
  const auto named = [&](const char* name) {
    for (const SceneCloth& cloth : frame->cloths)
      if (cloth.name == name) return cloth;
    ADD_FAILURE() << name;
    return SceneCloth();
  };
  const SceneCloth panel = named("panel"), facing = named("panel_facing");
  ASSERT_TRUE(panel.look.wrong && facing.look.wrong);
  EXPECT_EQ(facing.colour, panel.look.wrong->colour);
  EXPECT_EQ(facing.look.print, ClothLook::Print::None);
  EXPECT_EQ(facing.look.wrong->colour, panel.colour);
  EXPECT_EQ(facing.look.wrong->print, ClothLook::Print::Stripe);
  EXPECT_EQ(facing.look.wrong->ink, panel.look.ink);
  // Cloth of one look on both sides shows it inwards, not in the shade of an inner side.
  const SceneCloth other = named("other"), inside = named("other_facing");
  EXPECT_FALSE(other.look.wrong);
  ASSERT_TRUE(inside.look.wrong);
  EXPECT_EQ(inside.look.wrong->colour, other.colour);
}

}  // namespace
}  // namespace karinui
