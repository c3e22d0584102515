#include "pose_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace karinui::room {
namespace {

TEST(RoomPoses, AreReadBackAsTheyWereWritten) {
  ControllerState hand;
  hand.tracked = true;
  hand.aim = asFloats(after(turnAbout({0, 1, 0}, 0.3), turnAbout({1, 0, 0}, -0.4)));
  hand.aim.carry = asFloats({1, 0, 0, 0, {0.1, 1.2, -0.3}}).carry;
  hand.grip = hand.aim;
  hand.trigger = 1, hand.hold = 0.5, hand.stick = {0.25, -1}, hand.cancel = true;
  const auto script =
      parsePoseScript("# a hand\n0 head 0 1.5 0 1 0 0 0\n" + handLine(3, 1, hand) + "7 right lost\n9 end\n");
  ASSERT_TRUE(script);
  EXPECT_FALSE(script->handAt(1, 2).tracked);
  EXPECT_EQ(script->handAt(1, 3), hand);
  EXPECT_EQ(script->handAt(1, 6), hand);
  EXPECT_FALSE(script->handAt(1, 7).tracked);
  EXPECT_FALSE(script->handAt(0, 5).tracked);
  EXPECT_EQ(script->end(), 9);
}

TEST(RoomPoses, WhatCannotBeReadNamesItsLine) {
  for (const char* bad :
       {"0 head 0 1.5 0 1 0 0", "0 head 0 1.5 0 1 1 1 1", "x right lost", "0 right 0 0 0 1 0 0 0 squeeze 1", "0 dance",
        "-1 end", "9223372036854775807 end", "0 picture ../outside", "0 picture /tmp/outside", "0 picture .hidden",
        "0 head 1e39 0 0 1 0 0 0", "0 right 0 0 0 1 0 0 0 hold 7", "0 right 0 nan 0 1 0 0 0",
        "0 right 0 0 0 1 0 0 0 trigger"}) {
    const auto script = parsePoseScript(std::string("# first\n") + bad + "\n");
    ASSERT_FALSE(script) << bad;
    EXPECT_THAT(text(script.error().what), testing::HasSubstr("Line 2")) << bad;
  }
}

}  // namespace
}  // namespace karinui::room
