// The boards, buttons and sticks of the room, without headset and pictures.
#include "fitting_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <random>
#include <thread>

#include "board_images.h"
#include "karinui/body/body.h"
#include "karinui/body/sizes.h"
#include "karinui/design/script.h"
#include "program.h"
#include "recorder.h"

namespace karinui::room {
namespace {

using test::Recorder;

void perform(Session& session, const char* line) {
  session.perform(*parseOperation(line));
  session.finish();
}

// Presses the button of the strip that says this.
void press(Recorder& hand, const FittingRoom& room, const std::string& label) {
  const SceneMenu strip = room.strip();
  for (std::size_t k = 0; k < strip.buttons.size(); ++k)
    if (text(strip.buttons[k].label) == label) return hand.clickAt(test::middleOf(strip, k));
  ADD_FAILURE() << "no " << label;
}

std::string said(const FittingRoom& room) {
  std::string all;
  for (const Caption& caption : room.captions()) all += text(caption.notice.what) + "\n";
  return all;
}

TEST(RoomBoards, KeepGivesADraftAPlaceAndSaysWhereAnythingElseIs) {
  const test::Folder folder;
  SessionOptions options;
  options.drafts = folder / "Drafts";
  Session session(options);
  perform(session, "body size=jis9ar");
  ASSERT_TRUE(session.draft());
  const auto draft = session.path();
  RoomOptions wished;
  wished.documents = folder.path();
  FittingRoom room(session, wished);
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  press(hand, room, "Keep");
  EXPECT_FALSE(session.draft());
  EXPECT_EQ(session.path().parent_path(), folder.path());
  EXPECT_TRUE(test::fs::exists(session.path()));
  EXPECT_FALSE(test::fs::exists(draft));
  const auto kept = session.path();
  press(hand, room, "Keep");
  EXPECT_EQ(session.path(), kept);
  EXPECT_THAT(said(room), testing::HasSubstr("Every step is saved in “" + kept.string()));
}

// A document that may not be written: Keep makes a copy to work on.
TEST(RoomBoards, KeepOfADocumentThatIsReadOnlyMakesACopy) {
  const test::Folder folder;
  {
    Session first;
    first.create(folder / "coat.karinui");
    perform(first, "body size=jis9ar");
    first.close();
  }
  test::fs::permissions(folder / "coat.karinui", test::fs::perms::owner_read);
  Session session;
  session.open(folder / "coat.karinui");
  session.finish();
  if (!session.readOnly()) GTEST_SKIP() << "whoever runs this may write everything";
  RoomOptions wished;
  wished.documents = folder / "Kept";
  FittingRoom room(session, wished);
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  press(hand, room, "Keep");
  EXPECT_FALSE(session.readOnly());
  EXPECT_EQ(session.path().parent_path(), folder / "Kept") << said(room);
}

TEST(RoomBoards, AChoiceIsMadeByPointingAtIt) {
  Session session;
  perform(session, "body size=jis9ar");
  perform(session,
          "draw name=high line=\"torso:waist+0.5@0.06; torso:bust@0.06; torso:bust@0.94; torso:waist+0.5@0.94\"");
  perform(session, "draw name=low line=\"torso:hip@0.14; torso:waist@0.14; torso:waist@0.86; torso:hip@0.86\"");
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(session, options);
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  hand.choose(Command::Sew);
  const auto edge = [&](const char* piece, bool highest) {
    const Piece* found = session.snapshot().document.pieceNamed(piece);
    Vec3 best{0, highest ? -1e9 : 1e9, 0};
    for (const Edge& one : found->outline.edges) {
      const auto line = edgeInSpace(session.snapshot(), {PieceRef(found->id), one.name});
      const Vec3 middle = line[line.size() / 2];
      if (highest ? middle.y > best.y : middle.y < best.y) best = middle;
    }
    return best;
  };
  hand.drag(edge("high", false), edge("low", true), false);
  ASSERT_TRUE(room.choice());  // sides that long apart are asked about
  EXPECT_FALSE(room.choice()->title.empty());
  const SceneMenu panel = room.choice()->panel;
  ASSERT_GE(panel.buttons.size(), 2u);
  // The board stands still while it is pointed at, and the item under the ray is marked.
  hand.pointAt(room.placement().standToFitting(test::middleOf(panel, 0)));
  hand.hold(3);
  EXPECT_EQ(room.choice()->panel.corner, panel.corner);
  EXPECT_TRUE(room.choice()->panel.buttons[0].hot);
  EXPECT_FALSE(room.choice()->panel.buttons[1].hot);
  hand.click();
  EXPECT_FALSE(room.choice());
  EXPECT_THAT(text(session.steps().back().operation), testing::StartsWith("sew "));
}

// Two squares side by side before the body, and a hand that holds a tool.
struct TwoSquares {
  TwoSquares() {
    perform(session, "body size=jis9ar");
    perform(session,
            "piece name=one outline=\"M 0 0; a L 150 0; b L 150 150; c L 0 150; d L 0 0\" pose=\"-0.2,1.1,0.3\"");
    perform(session,
            "piece name=two outline=\"M 0 0; a L 150 0; b L 150 150; c L 0 150; d L 0 0\" pose=\"0.05,1.1,0.3\"");
    hand.hold(4);
    hand.tool().tracked = true;
    hand.other() = hand.tool();
    hand.other().aim.carry = {-0.25, 1.1, -0.2};
  }
  Vec3 onTable(const char* piece, Flat paper) {
    const PieceId id = session.snapshot().document.pieceNamed(piece)->id;
    return room.placement().standToFitting(room.table().at(paper + session.table().at(id)));
  }
  Session session;
  FittingRoom room{session, [] {
                     RoomOptions options;
                     options.posture.floor = 0;
                     return options;
                   }()};
  Recorder hand{room};
};

TEST(RoomBoards, TheFlatPatternOnItsTableIsSewnAlike) {
  TwoSquares at;
  at.hand.choose(Command::Sew);
  at.hand.drag(at.onTable("one", {0.15, 0.075}), at.onTable("two", {0, 0.075}), false);
  EXPECT_THAT(text(at.session.steps().back().operation), testing::StartsWith("sew a=p2.b b=p3.d"));
}

// Cloth that follows the hand leaves the paper on the table as it is; it is drawn again where the pattern has changed.
TEST(RoomBoards, ThePaperIsDrawnAgainOnlyWhereItChanges) {
  TwoSquares at;
  DrawnTable drawn;
  const auto anew = [&] { return drawn.follow(at.session, at.room.table()); };
  EXPECT_TRUE(anew());
  EXPECT_FALSE(anew());
  at.hand.choose(Command::Pull);
  const Vec3 held = *spaceOf(at.session.snapshot(), at.session.snapshot().document.pieceNamed("one")->id, {0.07, 0.07});
  at.hand.touchAt(held), at.hand.hold(3), at.hand.trigger(1);
  const std::uint64_t shown = at.session.changes().garment;
  for (int k = 1; k < 10; ++k) {
    at.hand.touchAt(held + Vec3{0, 0, 0.004 * k}), at.hand.hold();
    EXPECT_FALSE(anew());
  }
  EXPECT_GT(at.session.changes().garment, shown) << "the cloth has followed meanwhile";
  at.hand.trigger(0);
  EXPECT_TRUE(anew()) << "a step";
  at.hand.choose(Command::Undo);
  EXPECT_TRUE(anew());
  EXPECT_FALSE(anew());
}

// Presses the item of the list that hangs open.
void choose(Recorder& hand, const FittingRoom& room, const std::string& label) {
  ASSERT_TRUE(room.choice());
  const SceneMenu panel = room.choice()->panel;
  for (std::size_t k = 0; k < panel.buttons.size(); ++k)
    if (text(panel.buttons[k].label) == label)
      return hand.clickAt(room.placement().standToFitting(test::middleOf(panel, k)));
  ADD_FAILURE() << "no " << label;
}

// What the one table of commands has is on the bar, on the strip or on the list, and nowhere twice.
TEST(RoomBoards, EveryCommandOfTheTableIsReached) {
  TwoSquares at;
  std::multiset<Command> found(menuBar().begin(), menuBar().end());
  const auto take = [&](const std::vector<Offer>& offers) {
    for (const Offer& offer : offers)
      if (const auto* command = std::get_if<Command>(&offer.what)) found.insert(*command);
  };
  take(stripOffers(at.session, Scale::One, {}, true));
  take(listOffers(at.session, RoomCommand::More));
  for (const CommandInfo& one : commands())
    EXPECT_EQ(found.count(one.command), one.command == Command::ViewAll ? 0u : 1u) << one.name;
}

TEST(RoomBoards, ToolsOfTheListAreUsedOnClothAndTable) {
  TwoSquares at;
  Session& session = at.session;
  const auto tool = [&](const char* label, Command command) {
    press(at.hand, at.room, "More");
    choose(at.hand, at.room, label);
    EXPECT_FALSE(at.room.choice()) << "the list closes";
    EXPECT_EQ(session.tool(), command);
  };
  const auto on = [&](const char* piece, Flat paper) {
    return *spaceOf(session.snapshot(), session.snapshot().document.pieceNamed(piece)->id, paper);
  };
  const auto last = [&] { return session.steps().empty() ? "" : text(session.steps().back().operation); };
  const auto clickOn = [&](const char* piece, Flat paper) { at.hand.clickAt(on(piece, paper)); };
  tool("Notch", Command::Notch);
  clickOn("one", {0.149, 0.075});
  EXPECT_THAT(last(), testing::StartsWith("notch edge=p2.b"));
  tool("Dart", Command::Dart);
  clickOn("one", {0.075, 0.001});
  clickOn("one", {0.075, 0.06});
  EXPECT_THAT(last(), testing::StartsWith("dart edge=p2.a"));
  tool("Inner line", Command::Line);
  clickOn("two", {0.03, 0.03});
  clickOn("two", {0.12, 0.03});
  clickOn("two", {0.12, 0.1});
  press(at.hand, at.room, "Finish");
  EXPECT_THAT(last(), testing::StartsWith("line piece=p3"));
  tool("Pin", Command::Pin);
  clickOn("two", {0.05, 0.12});
  EXPECT_THAT(last(), testing::StartsWith("pin piece=p3"));
  tool("Edit points", Command::Points);  // on the flat pattern
  at.hand.drag(at.onTable("two", {0.15, 0.15}), at.onTable("two", {0.17, 0.16}), false);
  const auto* moved = std::get_if<ReshapePiece>(&session.steps().back().operation);
  ASSERT_TRUE(moved && moved->outline.edges.size() == 4) << last();
  EXPECT_LT(distance(moved->outline.edges[2].curve.start, Flat{0.17, 0.16}), 1e-3)
      << "the table stays where it is while its paper is drawn";
  // Commands that are done at once.
  at.hand.choose(Command::Move);
  tool("Edit points", Command::Points);
  press(at.hand, at.room, "Select");
  clickOn("two", {0.05, 0.1});
  ASSERT_EQ(session.selection().pieces.size(), 1u);
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Duplicate");
  EXPECT_THAT(last(), testing::StartsWith("duplicate piece=p3"));
  EXPECT_EQ(said(at.room), "");
}

TEST(RoomBoards, FigureAndFabricAreChosenInTheAir) {
  TwoSquares at;
  Session& session = at.session;
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Fabric");
  ASSERT_TRUE(at.room.choice());
  EXPECT_EQ(text(at.room.choice()->title.front()), "The fabric of the chosen pieces, or of all");
  const Offer offer = listOffers(session, RoomCommand::Fabric)[2];
  const std::string name = std::get<SetFabric>(std::get<Operation>(offer.what)).name;
  choose(at.hand, at.room, text(offer.label));
  const auto* fabric = std::get_if<SetFabric>(&session.steps().back().operation);
  ASSERT_TRUE(fabric) << text(session.steps().back().operation);
  EXPECT_EQ(fabric->name, name);
  EXPECT_EQ(fabric->pieces.size(), 2u) << "nothing is chosen: all";
  EXPECT_FALSE(at.room.choice());
  const std::size_t steps = session.steps().size();
  // Cancel closes an open list, and drops nothing else.
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Figure");
  ASSERT_TRUE(at.room.choice());
  press(at.hand, at.room, "Cancel");
  EXPECT_FALSE(at.room.choice());
  at.hand.choose(Command::Move);
  press(at.hand, at.room, "More");
  at.hand.press(&ControllerState::cancel);  // the button, too
  EXPECT_FALSE(at.room.choice());
  EXPECT_EQ(session.tool(), Command::Move);
  press(at.hand, at.room, "More");
  press(at.hand, at.room, "More");
  EXPECT_FALSE(at.room.choice()) << "again closes it";
  EXPECT_EQ(session.steps().size(), steps);
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Figure");
  const SceneMenu panel = at.room.choice()->panel;
  const auto& series = sizeSeries().front().sizes;  // of the size that is worn
  ASSERT_EQ(panel.buttons.size(),
            series.size() + sizeSeries().size() - 1 + 1);  // the others' usual one, the dress form
  EXPECT_TRUE(panel.buttons[2].chosen) << "jis9ar, which is worn";
  at.hand.clickAt(at.room.placement().standToFitting(test::middleOf(panel, series.size())));
  const auto* body = std::get_if<SetBody>(&session.steps().back().operation);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->size, "eu38");
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Figure");
  const SceneMenu again = at.room.choice()->panel;
  at.hand.clickAt(at.room.placement().standToFitting(test::middleOf(again, again.buttons.size() - 1)));
  EXPECT_EQ(text(session.steps().back().operation), "body size=eu38 form=yes");
}

TEST(RoomBoards, TheStickAndTheOtherTriggerAreCtrlAndShift) {
  TwoSquares at;
  const auto moved = [&] {
    const PieceId one = at.session.snapshot().document.pieceNamed("one")->id;
    const Vec3 from = *spaceOf(at.session.snapshot(), one, {0.08, 0.07});
    at.hand.pointAt(from), at.hand.hold(3), at.hand.trigger(1);
    at.hand.pointAt(from + Vec3{0, 0.05, 0}), at.hand.hold(3), at.hand.trigger(0);
    const auto* move = std::get_if<MovePiece>(&at.session.steps().back().operation);
    EXPECT_TRUE(move) << said(at.room);
    return move ? *move : MovePiece();
  };
  at.hand.choose(Command::Move);
  EXPECT_FALSE(moved().turn) << "carried as it hangs";
  at.hand.tool().stick = {0, 1};
  EXPECT_TRUE(moved().turn) << "Ctrl turns it";
  at.hand.tool().stick = {};
}

TEST(RoomBoards, SticksAndButtonsMoveTheFitting) {
  Session session;
  perform(session, "body size=jis9ar");
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(session, options);
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = hand.other().tracked = true;
  hand.hold(2);
  hand.other().stick = {1, 0}, hand.hold(10), hand.other().stick = {}, hand.hold(2);
  EXPECT_NEAR(room.placement().turn, 3.14159265358979 / 6, 1e-9);  // once a push
  const double high = room.placement().foot.y;
  hand.other().stick = {0, 1}, hand.hold(36), hand.other().stick = {}, hand.hold(2);
  EXPECT_NEAR(room.placement().foot.y, high + 0.175, 0.01);  // half a second
  hand.press(&ControllerState::scaleSwitch);
  EXPECT_EQ(room.scale(), Scale::TableTop);
  EXPECT_EQ(room.placement().scale, kTableTopScale);
  EXPECT_NEAR(room.placement().turn, 3.14159265358979 / 6, 1e-9);
  press(hand, room, "Life size");
  EXPECT_EQ(room.scale(), Scale::One);
  // The other hand's buttons undo and redo.
  hand.other().confirm = true, hand.hold(2), hand.other().confirm = false, hand.hold(2);
  EXPECT_EQ(session.steps().size(), 0u);
  hand.other().cancel = true, hand.hold(2), hand.other().cancel = false, hand.hold(2);
  EXPECT_EQ(session.steps().size(), 1u);
}

TEST(RoomBoards, TheHintOfViewSaysWhatItDoesHere) {
  TwoSquares at;
  const auto menu = at.room.menu();
  std::size_t button = 0;
  while (menuBar()[button] != Command::ViewOblique) ++button;
  at.hand.pointAt(test::middleOf(*menu, button));
  at.hand.hold(3);
  EXPECT_EQ(text(at.room.hint()), "Brings body and table before you again.");
}

TEST(RoomBoards, WhereANumberWouldBeTypedItIsSaidHowElse) {
  TwoSquares at;
  at.hand.choose(Command::Move);
  press(at.hand, at.room, "More");
  choose(at.hand, at.room, "Rectangle");
  at.hand.clickAt(at.onTable("one", {0.4, 0.4}));
  EXPECT_EQ(said(at.room), "Nothing is typed here: drag it in its size.\n");
}

// A line that was drawn is not lost without a word where another tool is taken.
TEST(RoomBoards, WhatIsDroppedForAnotherToolIsSaid) {
  TwoSquares at;
  at.hand.choose(Command::Draw);
  at.hand.clickAt({0, 0.9, 0.15});
  ASSERT_TRUE(at.session.begun());
  at.hand.choose(Command::Sew);
  EXPECT_EQ(said(at.room), "What “Draw” had begun is dropped.\n");
}

// A figure takes a second to be made: that is told, as a drape is.
TEST(RoomBoards, WhatIsWorkedOutForAWhileIsTold) {
  const char* const set = std::getenv("KARINUI_FIGURES");
  const std::string kept = set ? set : "";
  ::setenv("KARINUI_FIGURES", "", 1);  // another suite may have made this figure
  Session session;
  perform(session, "body size=jis9ar");
  FittingRoom room(session, {});
  test::Person person;
  person.step(room);
  EXPECT_FALSE(room.working());
  session.perform(*parseOperation("body size=eu38"));
  person.step(room);
  EXPECT_FALSE(room.working()) << "not at once";
  std::string told;
  while (!session.idle() && told.empty()) {
    person.step(room);
    if (const auto working = room.working()) told = text(*working);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the figure is made beside it, in its own time
  }
  ::setenv("KARINUI_FIGURES", kept.c_str(), 1);
  EXPECT_THAT(told, testing::MatchesRegex(".+: [0-9]+ %"));
  session.finish();
  person.step(room);
  EXPECT_FALSE(room.working());
}

// Whoever wears a headset does not see a terminal.
TEST(RoomBoards, AControllerThatSleepsIsToldInTheAir) {
  TwoSquares at;
  EXPECT_FALSE(at.room.toolUnseen());
  at.hand.tool().tracked = false;
  at.hand.hold(72);
  EXPECT_FALSE(at.room.toolUnseen()) << "a hand that reaches for something";
  at.hand.hold(3 * 72);
  EXPECT_TRUE(at.room.toolUnseen());
  at.hand.tool().tracked = true;
  at.hand.hold(2);
  EXPECT_FALSE(at.room.toolUnseen());
}

// A controller out of sight still tells of its buttons.
TEST(RoomBoards, AButtonActsOnceThoughItsHandIsOutOfSight) {
  TwoSquares at;
  const std::size_t steps = at.session.steps().size();
  at.hand.other().tracked = false, at.hand.hold(2);
  at.hand.other().confirm = true, at.hand.hold(20);
  EXPECT_EQ(at.session.steps().size(), steps - 1) << "one undo for one press";
  at.hand.other().tracked = true, at.hand.hold(5);
  EXPECT_EQ(at.session.steps().size(), steps - 1) << "nor again when it is seen";
  at.hand.other().confirm = false, at.hand.hold(2);
  at.hand.other().cancel = true, at.hand.hold(20), at.hand.other().cancel = false, at.hand.hold(2);
  EXPECT_EQ(at.session.steps().size(), steps);
  // What was held when the hands went and is still held when they are back was pressed before.
  at.hand.other().confirm = true, at.hand.hold(2);
  EXPECT_EQ(at.session.steps().size(), steps - 1);
  at.room.dropHands();
  at.hand.hold(5);
  EXPECT_EQ(at.session.steps().size(), steps - 1);
}

// Whoever stands within reach of the figure, or has it on a desk, reads every board: none hangs in it or behind it.
TEST(RoomBoards, NoBoardHangsInTheFigure) {
  for (const Scale scale : {Scale::One, Scale::TableTop})
    for (const bool left : {false, true}) {
      Session session;
      perform(session, "body size=jis9ar");
      RoomOptions options;
      options.posture.floor = 0;
      options.scale = scale, options.left = left;
      FittingRoom room(session, options);
      test::Person person;
      person.step(room);
      if (scale == Scale::One) person.head.carry = {0, 1.5, -0.55};  // from where the hand reaches the waist
      for (int k = 0; k < 72; ++k) person.step(room);
      const auto seen = [&](const SceneMenu& panel, const char* which, const std::function<Vec3(Vec3)>& inFitting) {
        const Vec3 eyes = room.placement().roomToFitting(person.head.carry);
        for (std::size_t k = 0; k < panel.buttons.size(); ++k) {
          const Vec3 way = inFitting(test::middleOf(panel, k)) - eyes;
          const auto met = session.snapshot().body->bvh().first(eyes, normalized(way));
          EXPECT_FALSE(met && met->along < length(way))
              << which << " " << text(panel.buttons[k].label) << (left ? " left" : "") << static_cast<int>(scale);
        }
      };
      const auto same = [](Vec3 p) { return p; };
      ASSERT_TRUE(room.menu());
      seen(*room.menu(), "menu", same);
      seen(room.strip(), "strip", same);
      const SceneMenu strip = room.strip();
      std::size_t more = 0;
      while (text(strip.buttons[more].label) != "More") ++more;
      ControllerState& tool = person.hands[left ? FittingRoom::kLeft : FittingRoom::kRight];
      tool.tracked = true;
      tool.aim = tool.grip =
          test::aimed(person.head.carry - Vec3{0, 0.3, 0}, room.placement().fittingToRoom(test::middleOf(strip, more)));
      person.step(room), tool.trigger = 1, person.step(room), tool.trigger = 0, person.step(room);
      ASSERT_TRUE(room.choice());
      seen(room.choice()->panel, "list", [&](Vec3 p) { return room.placement().standToFitting(p); });
    }
}

// A line that is drawn click by click leads round the figure; the boards come along.
TEST(RoomBoards, TheMenuFollowsWhoeverWalksRoundWhileDrawing) {
  Session session;
  perform(session, "body size=jis9ar");
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(session, options);
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  hand.choose(Command::Draw);
  hand.clickAt({0.06, 1.04, 0.16});
  ASSERT_TRUE(session.begun());
  hand.person.head = test::aimed({1, 1.5, -1.1}, {0, 1.4, -1.1});
  hand.hold(72);
  EXPECT_TRUE(session.begun());
  EXPECT_LT(distance(room.anchor().eyes(), hand.person.head.carry), 1e-6);
}

// Where a number would be typed it is turned up and down.
TEST(RoomBoards, ANumberIsTurnedInsteadOfTyped) {
  Session session;
  perform(session, "body size=jis9ar");
  for (const char* line :
       {"piece name=long outline=\"M 0 0; a L 200 0; b L 200 100; c L 0 100; d L 0 0\" pose=\"-0.1,1.2,0.3\"",
        "piece name=short outline=\"M 0 0; a L 100 0; b L 100 100; c L 0 100; d L 0 0\" pose=\"-0.05,1.0,0.3\""})
    perform(session, line);
  FittingRoom room(session, {});
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  hand.choose(Command::Sew);
  hand.drag({0, 1.2, 0.3}, {0, 1.1, 0.3}, false);
  ASSERT_TRUE(room.choice());
  choose(hand, room, "Another ratio…");
  ASSERT_TRUE(room.choice());
  const std::size_t items = room.choice()->panel.buttons.size();
  EXPECT_EQ(text(room.choice()->panel.buttons[items - 2].label), "Gathered so many times: 1.25");
  choose(hand, room, "+");
  EXPECT_EQ(text(room.choice()->panel.buttons[items - 2].label), "Gathered so many times: 1.50");
  for (int k = 0; k < 5; ++k) choose(hand, room, "+");
  EXPECT_EQ(text(room.choice()->panel.buttons[items - 2].label), "Gathered so many times: 2.00") << "as far as it goes";
  choose(hand, room, "−");
  choose(hand, room, "Gathered so many times: 1.75");
  EXPECT_FALSE(room.choice());
  const auto* sew = std::get_if<SewEdges>(&session.steps().back().operation);
  ASSERT_TRUE(sew) << text(session.steps().back().operation);
  const PieceId longOne = session.snapshot().document.pieceNamed("long")->id;
  const EdgeRef& longer = sew->a.front().piece.id == longOne ? sew->a.front() : sew->b.front();
  EXPECT_NEAR(longer.to - longer.from, 1.75 / 2, 1e-3) << text(session.steps().back().operation);
}

TEST(RoomBoards, PlatesThatFaceTheEyeDoNotCoverEachOther) {
  const auto plate = [](double x, double y) {
    Board board;
    board.corner = {x, y, 0.2}, board.across = {0.1, 0, 0}, board.upward = {0, 0.03, 0};
    return board;
  };
  std::vector<Board> others{plate(0, 0), plate(0, 0.031)};
  Board board = plate(0.05, 0.01);
  liftClear(board, others);
  EXPECT_NEAR(board.corner.y, 0.061, 1e-9) << "above both";
  Board beside = plate(0.11, 0.01);
  liftClear(beside, others);
  EXPECT_EQ(beside.corner, plate(0.11, 0.01).corner);
}

// What a ray carries goes as far as the ray points, at right angles to how the person sees it, wherever the hand is.
TEST(RoomBoards, ARayCarriesAPieceAcrossThePersonsView) {
  for (const Scale scale : {Scale::One, Scale::TableTop})
    for (const Vec3 shoulder : {Vec3{0.22, 1.15, -0.18}, Vec3{0.3, 0.9, 0.1}, Vec3{-0.3, 1.4, -0.1}}) {
      Session session;
      perform(session, "body size=jis9ar");
      perform(session,
              "piece name=one outline=\"M 0 0; a L 150 0; b L 150 150; c L 0 150; d L 0 0\" pose=\"-0.075,1.1,0.3\"");
      RoomOptions options;
      options.posture.floor = 0, options.scale = scale;
      FittingRoom room(session, options);
      Recorder hand(room);
      hand.hold(4);
      hand.tool().tracked = true;
      hand.choose(Command::Move);
      hand.person.shoulder = shoulder;
      const PieceId one = session.snapshot().document.pieceNamed("one")->id;
      for (const Vec3 by : {Vec3{0, 0.1, 0}, Vec3{0.1, 0, 0}, Vec3{0, -0.1, 0}}) {
        const Vec3 from = *spaceOf(session.snapshot(), one, {0.08, 0.07});
        hand.tool().stick = {0, -1};  // Alt: nothing snaps
        hand.drag(from, from + by, false);
        hand.tool().stick = {};
        const auto* move = std::get_if<MovePiece>(&session.steps().back().operation);
        ASSERT_TRUE(move) << said(room);
        const Vec3 view = normalized(room.placement().roomToFitting(hand.person.head.carry) - from);
        EXPECT_LT(length(move->by), 0.16) << text(session.steps().back().operation);
        EXPECT_GT(dot(normalized(move->by), normalized(by)), 0.7) << text(session.steps().back().operation);
        EXPECT_NEAR(dot(move->by, view), 0, 1e-3);
        session.command(Command::Undo), session.finish();
      }
    }
}

// Clicks of a hand in the air that trembles by two millimetres, and that moves as it presses, are clicks.
TEST(RoomBoards, AHandThatTremblesDrawsByClicks) {
  for (const Scale scale : {Scale::One, Scale::TableTop}) {
    Session session;
    perform(session, "body size=jis9ar");
    RoomOptions options;
    options.posture.floor = 0, options.scale = scale;
    FittingRoom room(session, options);
    Recorder hand(room);
    hand.hold(4);
    hand.tool().tracked = true;
    hand.choose(Command::Draw);
    std::mt19937 chance(3);
    std::normal_distribution<double> part(0, 0.0012);
    std::array<double, 5> off{};
    const auto shaken = [&](Vec3 at, double trigger) {
      for (double& one : off) one = 0.8 * one + part(chance);  // 2 mm, 2 mrad
      hand.person.shoulder = Vec3{0.22, 1.15, -0.18} + Vec3{off[0], off[1], off[2]};
      hand.pointAt(at);
      const Rigid still = hand.tool().aim;
      const double squeezed = trigger > 0 ? 0.004 : 0;
      hand.tool().aim = after(turnAbout({0, 1, 0}, off[3]), after(still, turnAbout({1, 0, 0}, off[4] - squeezed)));
      hand.tool().aim.carry = still.carry;
      hand.tool().trigger = trigger;
      hand.hold();
    };
    for (const auto& [x, y] : {std::pair(0.06, 1.04), {0.06, 1.16}, {-0.06, 1.16}, {-0.06, 1.04}, {0.06, 1.04}}) {
      const auto met = session.snapshot().body->bvh().first({x, y, 2}, {0, 0, -1});
      ASSERT_TRUE(met);
      for (int k = 0; k < 3; ++k) shaken(met->point, 0);
      for (int k = 0; k < 7; ++k) shaken(met->point, 1);
      for (int k = 0; k < 3; ++k) shaken(met->point, 0);
    }
    const auto* draw = std::get_if<DrawPiece>(&session.steps().back().operation);
    ASSERT_TRUE(draw) << said(room);
    EXPECT_EQ(session.snapshot().document.pattern.pieces.begin()->second->outline.edges.size(), 4u)
        << text(session.steps().back().operation);
  }
}

// A piece in the hand is not thrown by what moves the room all at once.
TEST(RoomBoards, ALeapOfTheRoomThrowsNothingThatIsHeld) {
  TwoSquares at;
  const auto held = [&] {
    const PieceId one = at.session.snapshot().document.pieceNamed("one")->id;
    const Vec3 from = *spaceOf(at.session.snapshot(), one, {0.08, 0.07});
    at.hand.touchAt(from), at.hand.hold(3), at.hand.trigger(1);
    at.hand.touchAt(from + Vec3{0.01, 0.05, 0}), at.hand.hold(3);
    EXPECT_TRUE(at.session.begun());
  };
  at.hand.choose(Command::Move);
  held();
  const std::size_t steps = at.session.steps().size();
  at.hand.press(&ControllerState::scaleSwitch);  // as a thumb does that rests on the stick
  EXPECT_EQ(at.room.scale(), Scale::One);
  at.hand.trigger(0);
  ASSERT_EQ(at.session.steps().size(), steps + 1);
  const auto* move = std::get_if<MovePiece>(&at.session.steps().back().operation);
  ASSERT_TRUE(move);
  EXPECT_LT(length(move->by), 0.06) << text(at.session.steps().back().operation);
  // The runtime's own place may change at any time: then the drag is dropped.
  held();
  at.hand.person.head.carry = {0.4, 1.6, 0.3};
  at.room.placeAnew();
  at.hand.hold(3);
  EXPECT_FALSE(at.session.begun());
  EXPECT_EQ(said(at.room), "The hand was lost; what it was doing is dropped.\n");
  at.hand.trigger(0);
  EXPECT_EQ(at.session.steps().size(), steps + 1);
}

TEST(RoomBoards, RefusalsAreReadForAWhileInTheAir) {
  Session session;
  perform(session, "body size=jis9ar");
  FittingRoom room(session, {});
  Recorder hand(room);
  hand.hold(4);
  hand.tool().tracked = true;
  hand.choose(Command::Move);  // there is no piece to move
  EXPECT_THAT(said(room), testing::HasSubstr("There is no piece yet"));
  hand.choose(Command::Move);
  EXPECT_EQ(room.captions().size(), 1u) << "once, however often";
  hand.hold(10 * 72);
  EXPECT_EQ(said(room), "");
}

}  // namespace
}  // namespace karinui::room
