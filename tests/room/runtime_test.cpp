// The program on the stub runtime through the real loader: the order of calls, and what happens when runtime, headset,
// session or focus go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "program.h"
#include "recorder.h"
#include "soak.h"

namespace karinui::room {
namespace {

using test::Folder;
using test::Ran;
using test::Recorder;
using testing::HasSubstr;

class RoomRuntime : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = test::displayTrouble(); !why.empty()) GTEST_SKIP() << "skipped: " << why;
  }
  static std::string look(long end) {
    return "0 head 0 1.55 0 1 0 0 0\n0 right 0.2 1.2 -0.2 1 0 0 0\n0 left -0.2 1.2 -0.2 1 0 0 0\n" +
           std::to_string(end) + " end\n";
  }
  static void expectClean(const Ran& ran) {
    EXPECT_EQ(ran.code, 0) << ran.said;
    EXPECT_EQ(ran.faults, "");
    EXPECT_EQ(ran.validation, "");
    ASSERT_FALSE(ran.report.is_discarded()) << ran.said;
    EXPECT_THAT(ran.report["failed_calls"], testing::IsEmpty());
  }
};

TEST_F(RoomRuntime, CallsAreInOrderHoweverItIsShared) {
  const struct {
    const char *with, *share, *space, *format, *graphics, *profile;
  } ways[] = {{"", "window", "stage", "0x8c43", "GLX", "oculus/touch_controller"},
              {"no_egl local linear simple", "window", "local", "0x881a", "GLX", "khr/simple_controller"},
              {"index", "windowless", "stage", "0x8c43", "EGL", "valve/index_controller"}};
  for (const auto& way : ways) {
    SCOPED_TRACE(way.with);
    const Folder folder;
    // Debian's validation layer does not know the EGL binding and refuses it.
    const Ran ran = test::run(folder, {.hands = look(12),
                                       .marks = "12 end\n",
                                       .with = way.with,
                                       .words = {"--share", way.share},
                                       .validated = std::string(way.graphics) == "GLX"});
    expectClean(ran);
    EXPECT_EQ(ran.report["session_states"],
              (std::vector<std::string>{"idle", "ready", "synchronized", "visible", "focused", "visible",
                                        "synchronized", "stopping", "idle", "exiting"}));
    EXPECT_EQ(ran.report["space"], way.space);
    EXPECT_EQ(ran.report["swapchain_format"], way.format);
    EXPECT_THAT(ran.calls, HasSubstr(std::string("graphics ") + way.graphics));
    ASSERT_EQ(ran.report["profiles"].size(), 2u);
    EXPECT_EQ(ran.report["profiles"][1], std::string("/interaction_profiles/") + way.profile);
    for (const char* profile : {"khr/simple_controller", "oculus/touch_controller", "valve/index_controller"})
      EXPECT_THAT(ran.calls, HasSubstr(std::string("suggested /interaction_profiles/") + profile));
    EXPECT_GE(ran.report["pictures"].get<int>(), 12);
    EXPECT_LE(ran.report["pictures_not_drawn"].get<int>(), 2);  // before the session is visible
    const auto& parts = ran.report["milliseconds"];
    EXPECT_GT(parts["poses_to_submitted"]["mean"].get<double>(), parts["poses_to_session"]["mean"].get<double>());
  }
}

// A runtime may offer EGL and refuse a session on it.
TEST_F(RoomRuntime, TriesTheOtherWayToShareWhereOneIsRefused) {
  const Folder folder;
  const Ran ran =
      test::run(folder, {.hands = look(12), .marks = "12 end\n", .with = "refuses_egl", .validated = false});
  EXPECT_EQ(ran.code, 0) << ran.said;
  EXPECT_EQ(ran.faults, "");
  EXPECT_THAT(ran.calls, HasSubstr("refused EGL"));
  EXPECT_THAT(ran.calls, HasSubstr("graphics GLX"));
  EXPECT_THAT(ran.said, HasSubstr("XR_ERROR_GRAPHICS_DEVICE_INVALID"));
  ASSERT_FALSE(ran.report.is_discarded()) << ran.said;
  EXPECT_GE(ran.report["pictures"].get<int>(), 12);
}

// Asked for one way only, the program says why it cannot be had.
TEST_F(RoomRuntime, SaysWhyTheOnlyWayAskedForIsRefused) {
  const Folder folder;
  const Ran ran = test::run(folder, {.hands = look(12),
                                     .marks = "12 end\n",
                                     .with = "refuses_egl",
                                     .words = {"--share", "windowless"},
                                     .validated = false});
  EXPECT_EQ(ran.code, 6) << ran.said;
  EXPECT_THAT(ran.said, HasSubstr("XR_ERROR_GRAPHICS_DEVICE_INVALID"));
}

// A picture means the same light in a linear texture as in an sRGB one.
TEST_F(RoomRuntime, LinearAndSrgbTexturesHoldTheSameLight) {
  const std::string hands = look(10) + "6 picture look\n";
  std::string pictures[2];
  for (const bool linear : {false, true}) {
    const Folder folder;
    const Ran ran = test::run(
        folder, {.hands = hands, .marks = "10 end\n", .with = linear ? "linear" : "", .words = {"--share", "window"}});
    expectClean(ran);
    pictures[linear] = test::bytesOf(folder / "log/look_left.ppm");
  }
  ASSERT_EQ(pictures[0].size(), pictures[1].size());
  ASSERT_GT(pictures[0].size(), 100000u);
  int most = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i)
    most = std::max(most,
                    std::abs(static_cast<unsigned char>(pictures[0][i]) - static_cast<unsigned char>(pictures[1][i])));
  EXPECT_LE(most, 2);
}

// Recorded poses may have a head of their own: the pictures are what its eyes see, whatever head the runtime has.
TEST_F(RoomRuntime, TheEyesGoWithARecordedHead) {
  const std::string straight = "0 head 0 1.55 0 1 0 0 0\n", aside = "0 head 0.7 1.4 0.2 0.96 0 0.28 0\n";
  std::string pictures[3];
  for (const int way : {0, 1, 2}) {  // seen by the runtime's head, by a recorded one, and straight on
    const Folder folder;
    const Ran ran = test::run(folder, {.hands = (way == 0 ? aside : straight) + "6 picture look\n",
                                       .marks = (way == 1 ? aside : "") + "10 end\n",
                                       .words = {"--share", "windowless"},
                                       .validated = false});
    expectClean(ran);
    pictures[way] = test::bytesOf(folder / "log/look_left.ppm");
  }
  ASSERT_GT(pictures[0].size(), 100000u);
  const auto apart = [&](int a, int b) {  // share of bytes that differ by more than rounding
    std::size_t count = 0;
    for (std::size_t i = 0; i < pictures[a].size() && i < pictures[b].size(); ++i)
      count += std::abs(static_cast<unsigned char>(pictures[a][i]) - static_cast<unsigned char>(pictures[b][i])) > 4;
    return static_cast<double>(count) / static_cast<double>(pictures[a].size());
  };
  EXPECT_LT(apart(0, 1), 0.005);
  EXPECT_GT(apart(0, 2), 0.05);  // which is not the same as straight on
}

TEST_F(RoomRuntime, WithoutARuntimeASentenceSaysWhatToDo) {
  for (const auto& [language, said] :
       {std::pair("en", "No headset runtime was found."), {"ja", "ヘッドセットのランタイムが見つかりません"}}) {
    const Folder folder;
    const Ran ran = test::run(folder, {.words = {"--language", language}, .validated = false, .runtime = false});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.said, HasSubstr(said));
    EXPECT_EQ(std::count(ran.said.begin(), ran.said.end(), '\n'), 1) << ran.said;
  }
}

// However often it is begun in vain, no drafts pile up; what was named stays.
TEST_F(RoomRuntime, ADraftThatWasBegunForNothingIsNotLeftBehind) {
  const Folder folder;
  const auto drafts = [&] {
    std::size_t count = 0;
    std::error_code none;
    for (const auto& one : test::fs::recursive_directory_iterator(folder / "Documents", none))
      count += one.is_regular_file();
    return count;
  };
  for (int k = 0; k < 2; ++k)
    EXPECT_EQ(test::run(folder, {.validated = false, .runtime = false, .headless = false}).code, 3);
  EXPECT_EQ(drafts(), 0u);
  const std::string named = (folder / "mine.karinui").string();
  EXPECT_EQ(test::run(folder, {.words = {named}, .validated = false, .runtime = false, .headless = false}).code, 3);
  EXPECT_TRUE(test::fs::exists(named));
}

TEST_F(RoomRuntime, WithoutAHeadsetItWaitsAndThenSaysSo) {
  const Folder folder;
  const Ran ran = test::run(folder, {.hands = look(5), .with = "no_headset", .validated = false});
  EXPECT_EQ(ran.code, 4);
  EXPECT_THAT(ran.said, HasSubstr("The headset is not connected"));
  EXPECT_EQ(ran.faults, "");
}

// The loader finds the runtime, whose service does not run: as Monado's library without monado-service.
TEST_F(RoomRuntime, ARuntimeThatDoesNotBeginIsToldFromNone) {
  const Folder folder;
  const Ran ran = test::run(folder, {.hands = look(5), .with = "no_service", .validated = false});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.said, HasSubstr("is installed but does not begin (XR_ERROR_RUNTIME_FAILURE)"));
  EXPECT_EQ(ran.faults, "");
}

// A hand in the middle of a move, and then this happens.
struct MidDrag {
  std::string hands, marks;
  std::vector<std::string> steps;
};
MidDrag midDrag(const std::string& event) {
  Session session;
  for (const char* line : {"body size=jis9ar",
                           "draw name=front line=\"torso:waist@0.1; torso:bust@0.1; torso:bust@0.9; "
                           "torso:waist@0.9\""}) {
    session.perform(*parseOperation(line));
    session.finish();
  }
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(session, options);
  Recorder hand(room);
  hand.hold(6);
  hand.tool().tracked = true;
  hand.choose(Command::Move);
  const auto& worn = session.snapshot().worn.front();
  const Vec3 held = *spaceOf(session.snapshot(), worn.id, {0, 0.03});
  hand.touchAt(held), hand.hold(3), hand.trigger(1);
  for (int k = 1; k <= 10; ++k) hand.touchAt(held + Vec3{0.01 * k, 0, 0}), hand.hold();
  EXPECT_TRUE(session.begun());
  if (!event.empty()) hand.event(event);
  const std::string upToThere = hand.hands();
  // The hand goes on as if nothing were, and lets go.
  for (int k = 1; k <= 10; ++k) hand.touchAt(held + Vec3{0.1 + 0.01 * k, 0, 0}), hand.hold();
  hand.trigger(0);
  hand.hold(20);
  MidDrag made{hand.hands(), hand.marks(), {}};
  for (const Step& step : session.steps()) made.steps.push_back(text(step.operation));
  return made;
}

TEST_F(RoomRuntime, WhateverIsLostInMidDragNothingElseIs) {
  const MidDrag whole = midDrag("");
  ASSERT_EQ(whole.steps.size(), 3u);  // undisturbed it is a move
  EXPECT_THAT(whole.steps.back(), testing::StartsWith("move "));
  const std::vector<std::string> before(whole.steps.begin(), whole.steps.begin() + 2);
  struct Loss {
    const char *event, *said;
    int sessions;
  };
  std::vector<Loss> losses = {{"session lost", "The headset was lost", 2}, {"focus off", "", 1}};
  if (atLength()) {
    losses.push_back({"headset gone", "The headset is not connected", 2});
    losses.push_back({"instance lost", "The headset was lost", 2});
  }
  for (const Loss& loss : losses) {
    SCOPED_TRACE(loss.event);
    const Folder folder;
    {
      MemoryBlobs none;
      Workers workers(1);
      Bodies bodies;
      Context context{workers, {}, none, bodies, {}, {}};
      auto made = DocumentFile::create(folder / "garment.karinui");
      ASSERT_TRUE(made);
      for (const std::string& step : before) ASSERT_TRUE(made->perform(*parseOperation(step), context));
    }
    MidDrag played = midDrag(loss.event);
    if (std::string(loss.event) == "focus off") {  // and on again, while the hand still holds the trigger
      std::istringstream lines(played.hands);
      long at = 0;
      for (std::string line; std::getline(lines, line);)
        if (line.ends_with("focus off")) at = std::stol(line);
      played.hands += std::to_string(at + 4) + " focus on\n";
    }
    const Ran ran = test::run(folder, {.hands = played.hands,
                                       .marks = played.marks,
                                       .with = "seldom",
                                       .words = {"--share", "window", (folder / "garment.karinui").string()}});
    expectClean(ran);
    EXPECT_EQ(ran.report["sessions"], loss.sessions);
    EXPECT_THAT(ran.said, HasSubstr(loss.said));
    if (loss.sessions == 2) {
      EXPECT_THAT(ran.said, HasSubstr("The headset is back"));
    }
    // The drag is dropped: neither the move nor half of one; every step before it is there, on the disk too.
    EXPECT_EQ(ran.report["document"]["steps"], before);
    auto kept = DocumentFile::openForReading(folder / "garment.karinui");
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->steps().size(), before.size());
  }
}

TEST_F(RoomRuntime, NoPictureWaitsForADrape) {
  const Folder folder;
  std::string steps = test::bytesOf(std::string(KARINUI_SOURCE_DIR) + "/examples/first_tunic.ops");
  steps = steps.substr(0, steps.find("\ndrape") + 1);
  {
    MemoryBlobs none;
    Workers workers(2);
    Bodies bodies;
    Context context{workers, {}, none, bodies, {}, {}};
    auto made = DocumentFile::create(folder / "tunic.karinui");
    ASSERT_TRUE(made);
    const auto lines = parseScript(steps);
    ASSERT_TRUE(lines);
    for (const ScriptLine& line : *lines) ASSERT_TRUE(made->perform(line.operation, context));
  }
  Session session;
  session.open(folder / "tunic.karinui");
  session.finish();
  RoomOptions options;
  options.posture.floor = 0;
  std::string hands;
  {
    // Where the menu's Settle is; what it does is left to the program.
    FittingRoom room(session, options);
    Recorder hand(room);
    hand.hold(8);
    hand.tool().tracked = true;
    const auto menu = room.menu();
    std::size_t button = 0;
    while (menuBar()[button] != Command::Settle) ++button;
    hand.pointAt(test::middleOf(*menu, button));
    hand.hold(4);
    hands = hand.hands();
    ControllerState pressed = hand.tool();
    pressed.trigger = 1;
    hands += handLine(hand.picture(), FittingRoom::kRight, pressed);
    hands += handLine(hand.picture() + 3, FittingRoom::kRight, hand.tool());
  }
  session.begin(DocumentFile::inMemory());  // closes the file
  const Ran ran = test::run(
      folder,
      {.hands = hands, .marks = "60 end\n", .words = {"--share", "window", (folder / "tunic.karinui").string()}});
  expectClean(ran);
  EXPECT_GE(ran.report["pictures_while_draping"].get<int>(), 5);
  EXPECT_GE(ran.report["pictures"].get<int>(), 60);
}

TEST_F(RoomRuntime, AWrongCallIsToldInASentence) {
  const Folder folder;
  test::write(folder / "bad.txt", "0 dance\n");
  const struct {
    std::vector<std::string> words;
    const char* said;
  } calls[] = {{{"--scale", "two"}, "“two” cannot be given to --scale"},
               {{"--dance"}, "karinui-room does not know “--dance”"},
               {{"--script", (folder / "bad.txt").string()}, "Line 1 of the recorded poses cannot be read"},
               {{"--new", "giant"}, "“giant” cannot be given to --new"},
               {{"--threads", "many"}, "“many” cannot be given to --threads"}};
  for (const auto& call : calls) {
    const Ran ran = test::run(folder, {.words = call.words, .validated = false});
    EXPECT_EQ(ran.code, 2) << call.said;
    EXPECT_THAT(ran.said, HasSubstr(call.said));
    EXPECT_EQ(ran.calls, "");
  }
}

}  // namespace
}  // namespace karinui::room
