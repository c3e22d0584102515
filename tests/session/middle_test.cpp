// Cuts and inner lines begin and end at the middle of an edge, and run along the middle line of a piece, where the hand
// comes near; and that is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

using testing::HasSubstr;

class Middle : public testing::Test {
 protected:
  Middle() : session(options()) {
    session.perform(
        op("piece name=front outline=\"M -200 0; hem L 200 0; side_left L 180 500; neck C 100 450 -100 450 "
           "-180 500; side_right L -200 0\""));
    session.perform(op("piece name=half outline=\"M 0 0; hem L 200 0; side L 180 500; top L 0 460; centre L 0 0\""));
    session.finish();
  }
  SessionOptions options() {
    SessionOptions made;
    made.autoSettle = false;
    made.drape = room.context.drape;
    return made;
  }
  const Piece& piece(const char* name) { return *session.snapshot().document.pieceNamed(name); }
  void feed(const char* name, Flat paper, PointerSample::Phase phase, bool shift = false) {
    PointerSample hand;
    hand.where = PointerSample::Where::Table, hand.reach = 0.008, hand.phase = phase, hand.shift = shift;
    hand.place = paper + session.table().at(piece(name).id);
    session.feed(hand);
  }
  void drag(const char* name, const std::vector<Flat>& path, bool shift = false) {
    feed(name, path.front(), PointerSample::Phase::Hover);
    hovered = text(session.hint());
    feed(name, path.front(), PointerSample::Phase::Press, shift);
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      for (int k = 1; k <= 20; ++k) feed(name, lerp(path[i], path[i + 1], k / 20.0), PointerSample::Phase::Drag, shift);
    held = text(session.hint());
    feed(name, path.back(), PointerSample::Phase::Release, shift);
    session.finish();
  }
  void click(const char* name, Flat paper) {
    feed(name, paper, PointerSample::Phase::Hover);
    hovered = text(session.hint());
    feed(name, paper, PointerSample::Phase::Press);
    feed(name, paper, PointerSample::Phase::Release);
  }
  Workroom room;
  Session session;
  std::string hovered, held;
};

TEST_F(Middle, ACutAlongTheMiddleLineHalvesThePiece) {
  session.command(Command::Cut);
  // From the hem up, a trembling hand 3 mm beside the middle.
  drag("front", {{0.003, 0.002}, {-0.002, 0.15}, {0.003, 0.3}, {0.002, 0.4615}});
  EXPECT_THAT(hovered, HasSubstr("the middle line of the piece"));
  EXPECT_THAT(held, HasSubstr("the middle line of the piece"));
  EXPECT_THAT(held, HasSubstr("cut the piece in two"));
  const auto& pieces = session.snapshot().document.pattern.pieces;
  ASSERT_EQ(pieces.size(), 3u);
  const Piece& front = piece("front");
  const double whole = 0.5 * (0.4 + 0.36) * 0.5;
  EXPECT_LT(front.outline.area(), whole);
  bool twins = false;
  for (const auto& [id, one] : pieces) twins = twins || one->mirrorOf == front.id || front.mirrorOf == id;
  EXPECT_TRUE(twins) << "the halves are each other's image";
}

TEST_F(Middle, ACutEndsAtTheMiddleOfAnEdge) {
  session.command(Command::Cut);
  // A slit from the middle of the hem of a half, and across from the middle of the side.
  drag("half", {{0.104, 0.001}, {0.102, 0.1}});
  EXPECT_THAT(hovered, HasSubstr("the middle of hem"));
  const Outline& outline = piece("half").outline;
  ASSERT_TRUE(outline.find("hem_2")) << outline.edges.size();
  EXPECT_NEAR(outline.edges[*outline.find("hem")].curve.length(), 0.1, 1e-5);
  EXPECT_NEAR(outline.edges[*outline.find("hem_2")].curve.length(), 0.1, 1e-5);
}

TEST_F(Middle, AwayFromItTheHandIsFollowed) {
  session.command(Command::Cut);
  drag("half", {{0.06, 0.001}, {0.06, 0.1}});
  EXPECT_THAT(hovered, testing::Not(HasSubstr("middle")));
  const Outline& outline = piece("half").outline;
  ASSERT_TRUE(outline.find("hem_2"));
  EXPECT_NEAR(outline.edges[*outline.find("hem")].curve.length(), 0.06, 2e-3);
}

TEST_F(Middle, AnInnerLineLiesOnTheMiddleLine) {
  session.command(Command::Line);
  click("front", {0.003, 0.2});
  EXPECT_THAT(hovered, HasSubstr("the middle line of the piece"));
  click("front", {-0.002, 0.3});
  session.command(Command::Confirm);
  session.finish();
  const auto& lines = piece("front").lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines.front().curves.front().start.u, 0, 1e-9);
  EXPECT_NEAR(lines.front().curves.back().end.u, 0, 1e-9);
}

TEST_F(Middle, AnInnerLineFromTheMiddleOfASide) {
  session.command(Command::Line);
  const Curve side = piece("half").outline.edges[*piece("half").outline.find("side")].curve;
  click("half", side.atFraction(0.5) + Flat{-0.002, 0.003});
  EXPECT_THAT(hovered, HasSubstr("the middle of side"));
  click("half", {0.1, 0.2});
  session.command(Command::Confirm);
  session.finish();
  const auto& lines = piece("half").lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_LT(distance(lines.front().curves.front().start, side.atFraction(0.5)), 1e-4);
}

}  // namespace
}  // namespace karinui
