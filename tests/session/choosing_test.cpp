// What a click chooses, and what Delete takes away of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

class Choosing : public testing::Test {
 protected:
  Choosing() : session(options()) {
    const auto lines = parseScript(kTwoPieces);
    for (const ScriptLine& line : *lines) session.perform(line.operation);
    session.finish();
    front = session.snapshot().document.pieceNamed("front")->id;
    back = session.snapshot().document.pieceNamed("back")->id;
  }
  SessionOptions options() {
    SessionOptions made;
    made.autoSettle = false;
    made.drape = room.context.drape;
    return made;
  }
  void click(PieceId piece, Flat paper, bool shift = false, bool control = false) {
    PointerSample hand;
    hand.where = PointerSample::Where::Table, hand.reach = 0.005, hand.shift = shift, hand.control = control;
    hand.place = paper + session.table().at(piece);
    for (const auto phase : {PointerSample::Phase::Press, PointerSample::Phase::Release})
      hand.phase = phase, session.feed(hand);
    session.finish();
  }
  // Well inside the piece.
  Flat inside(PieceId piece) const {
    Flat low{1e9, 1e9}, high{-1e9, -1e9};
    for (const Edge& edge : session.snapshot().document.find(piece)->outline.edges) {
      low = {std::fmin(low.u, edge.curve.start.u), std::fmin(low.v, edge.curve.start.v)};
      high = {std::fmax(high.u, edge.curve.start.u), std::fmax(high.v, edge.curve.start.v)};
    }
    return lerp(low, high, 0.45);
  }
  Workroom room;
  Session session;
  PieceId front, back;
};

TEST_F(Choosing, DeleteTakesNoPieceAwayWhereAnEdgeWasChosen) {
  const std::size_t steps = session.steps().size();
  const Edge& edge = session.snapshot().document.find(front)->outline.edges.front();
  const std::string name = edge.name;
  click(front, edge.curve.atFraction(0.4));
  ASSERT_TRUE(session.selection().edge);
  EXPECT_EQ(session.selection().edge->edge, name);
  session.takeNotices();
  session.command(Command::Remove);
  session.finish();
  EXPECT_EQ(session.steps().size(), steps);
  ASSERT_TRUE(session.snapshot().document.find(front));
  const auto told = session.takeNotices();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told.front().kind, Notice::Kind::Refused);
  EXPECT_THAT(text(told.front().what), testing::HasSubstr("click inside the piece"));
  click(front, inside(front));
  ASSERT_FALSE(session.selection().edge);
  session.command(Command::Remove);
  session.finish();
  EXPECT_FALSE(session.snapshot().document.find(front));
}

TEST_F(Choosing, SeveralEdgesOneAfterAnother) {
  const auto place = [&](PieceId piece, const char* edge) {
    const Outline& outline = session.snapshot().document.find(piece)->outline;
    return outline.edges[*outline.find(edge)].curve.atFraction(0.4);
  };
  const auto chosen = [&] {
    std::string all;
    for (const EdgeRef& edge : session.selection().edges())
      all += session.snapshot().document.find(edge.piece.id)->name + "." + edge.edge + " ";
    return all;
  };
  click(front, place(front, "hem"));
  EXPECT_EQ(chosen(), "front.hem ");
  click(back, place(back, "hem"), false, true);
  EXPECT_EQ(chosen(), "front.hem back.hem ");
  EXPECT_EQ(session.selection().pieces, (std::set<PieceId>{front, back}));
  click(front, place(front, "side_left"), false, true);
  EXPECT_EQ(chosen(), "front.hem back.hem front.side_left ");
  click(back, place(back, "hem"), false, true);
  EXPECT_EQ(chosen(), "front.hem front.side_left ") << "one less";
  EXPECT_EQ(session.selection().pieces, (std::set<PieceId>{front}));
  click(front, inside(front), false, true);
  EXPECT_EQ(chosen(), "front.hem front.side_left ") << "the hand missed";
  // They follow their names, and one that has gone is chosen no more.
  session.perform(op("rename edge=front.hem to=low"));
  session.finish();
  EXPECT_EQ(chosen(), "front.low front.side_left ");
  click(front, place(front, "side_right"));
  EXPECT_EQ(chosen(), "front.side_right ") << "without Ctrl one alone";
  click(back, place(back, "neck"), false, true);
  session.perform(op("remove piece=back"));
  session.finish();
  EXPECT_EQ(chosen(), "front.side_right ");
}

TEST_F(Choosing, AllIsChosenAtOnceAndEscapeChoosesNothing) {
  session.command(Command::SelectAll);
  EXPECT_EQ(session.selection().pieces, (std::set<PieceId>{front, back}));
  const std::size_t steps = session.steps().size();
  session.command(Command::Cut);
  session.command(Command::Cancel);
  EXPECT_EQ(session.tool(), Command::Select);
  EXPECT_EQ(session.selection().pieces.size(), 2u) << "the tool first";
  session.command(Command::Cancel);
  EXPECT_TRUE(session.selection().pieces.empty());
  EXPECT_EQ(session.steps().size(), steps);
  session.command(Command::SelectAll);
  session.command(Command::Freeze);
  session.finish();
  for (const PieceId id : {front, back}) EXPECT_TRUE(session.snapshot().document.find(id)->frozen);
}

TEST_F(Choosing, AClickWithShiftChoosesOneMoreAndOneLess) {
  click(front, inside(front));
  EXPECT_EQ(session.selection().pieces, std::set<PieceId>{front});
  click(back, inside(back), true);
  EXPECT_EQ(session.selection().pieces, (std::set<PieceId>{front, back}));
  click(front, inside(front), true);
  EXPECT_EQ(session.selection().pieces, std::set<PieceId>{back});
  click(front, session.snapshot().document.find(front)->outline.edges.front().curve.atFraction(0.4), true);
  EXPECT_EQ(session.selection().pieces, (std::set<PieceId>{front, back})) << "on its edge, too, the piece is meant";
  EXPECT_FALSE(session.selection().edge);
  click(front, inside(front));
  EXPECT_EQ(session.selection().pieces, std::set<PieceId>{front});
}

// Sides that differ by a hair have nothing to spare, neither more nor less.
TEST_F(Choosing, NothingToSpareIsNotLessThanNothing) {
  for (const char* step : {"piece name=left outline=\"M 0 0; hem L 200 0; centre L 200 300; neck L 0 300; side L 0 0\"",
                           "piece name=right outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 "
                           "0.02; low L 0 0\" pose=\"0.3,0,0\"",
                           "sew a=left.centre b=right.centre"})
    session.perform(op(step));
  session.finish();
  const Piece& left = *session.snapshot().document.pieceNamed("left");
  PointerSample hand;
  hand.where = PointerSample::Where::Table, hand.reach = 0.005, hand.phase = PointerSample::Phase::Hover;
  hand.place = Flat{0.2, 0.15} + session.table().at(left.id);
  session.feed(hand);
  ASSERT_FALSE(session.preview().table.words.empty());
  EXPECT_THAT(session.preview().table.words.front().text, testing::HasSubstr("30.0 cm / 30.0 cm   +0.0 cm (+0.0 %)"));
}

// Who gives a chosen edge a name goes on with that edge.
TEST_F(Choosing, AnEdgeThatIsRenamedStaysChosen) {
  Selection chosen;
  chosen.pieces = {front};
  chosen.edge = EdgeNear{front, session.snapshot().document.find(front)->outline.edges.front().name, 0.5, 0};
  const std::string was = chosen.edge->edge;
  session.select(chosen);
  session.perform(op("rename edge=front." + was + " to=lower_edge"));
  session.finish();
  ASSERT_TRUE(session.selection().edge);
  EXPECT_EQ(session.selection().edge->edge, "lower_edge");
  session.command(Command::Undo);
  session.finish();
  ASSERT_TRUE(session.selection().edge);
  EXPECT_EQ(session.selection().edge->edge, was);
}

// What is done next is done to the copy.
TEST_F(Choosing, ThePieceThatADuplicateMadeIsChosen) {
  Selection chosen;
  chosen.pieces = {front};
  session.select(chosen);
  session.command(Command::Duplicate);
  session.finish();
  ASSERT_EQ(session.selection().pieces.size(), 1u);
  EXPECT_EQ(session.snapshot().document.find(*session.selection().pieces.begin())->name, "front_2");
}

// All that are chosen are meant, in one step.
TEST_F(Choosing, WhatIsDoneToSeveralPiecesIsDoneToAllOfThem) {
  session.perform(op("freeze piece=front"));
  session.finish();
  session.command(Command::SelectAll);
  const auto frozen = [&] {
    return std::pair(session.snapshot().document.find(front)->frozen, session.snapshot().document.find(back)->frozen);
  };
  session.command(Command::Freeze);
  session.finish();
  EXPECT_EQ(frozen(), std::pair(true, true)) << "as long as one is not";
  session.command(Command::Freeze);
  session.finish();
  EXPECT_EQ(frozen(), std::pair(false, false));
  const std::size_t steps = session.steps().size();
  session.command(Command::Duplicate);
  session.finish();
  EXPECT_EQ(session.steps().size(), steps + 1);
  const Document& document = session.snapshot().document;
  ASSERT_TRUE(document.pieceNamed("front_2"));
  ASSERT_TRUE(document.pieceNamed("back_2"));
  EXPECT_EQ(session.selection().pieces,
            (std::set<PieceId>{document.pieceNamed("front_2")->id, document.pieceNamed("back_2")->id}));
  session.command(Command::Undo);
  session.finish();
  EXPECT_EQ(session.snapshot().document.pattern.pieces.size(), 2u);
}

// Those that are whole or have both sides stay as they are.
TEST_F(Choosing, MirrorMakesTheOtherSideOfThoseThatHaveNone) {
  for (const char* step :
       {"rectangle name=cuff_left width=20cm height=6cm", "move piece=cuff_left by=40cm,0,0",
        "rectangle name=sleeve_left width=20cm height=50cm", "move piece=sleeve_left by=40cm,10cm,0",
        "sew a=cuff_left.top b=sleeve_left.bottom name=wrist_left",
        "piece name=whole outline=\"M -200 0; low L 200 0; right L 200 400; top L -200 400; left L -200 0\"",
        "remove piece=\"front back\""})
    session.perform(op(step));
  session.finish();
  session.takeNotices();
  const std::size_t steps = session.steps().size();
  session.command(Command::SelectAll);
  session.command(Command::Mirror);
  session.finish();
  const Document& document = session.snapshot().document;
  EXPECT_EQ(session.steps().size(), steps + 1);
  EXPECT_EQ(document.pattern.pieces.size(), 5u);
  ASSERT_TRUE(document.pieceNamed("cuff_right"));
  ASSERT_TRUE(document.pieceNamed("sleeve_right"));
  ASSERT_EQ(document.pattern.seams.size(), 2u);
  EXPECT_EQ(document.pattern.seams.rbegin()->second.name, "wrist_right");
  const auto told = session.takeNotices();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(text(told.front().what), testing::HasSubstr("1 piece of the chosen is on both sides"));
  session.command(Command::SelectAll);
  session.command(Command::Mirror);
  session.finish();
  EXPECT_EQ(session.steps().size(), steps + 1) << "now all have";
  EXPECT_EQ(session.takeNotices().back().kind, Notice::Kind::Refused);
}

// By the hand, too: in space one step, on the table none.
TEST_F(Choosing, SeveralPiecesAreCarriedTogether) {
  session.command(Command::SelectAll);
  session.command(Command::Move);
  const auto place = [&](PieceId id) { return Stand(*session.snapshot().document.find(id))({0, 0}); };
  const auto carry = [&](PointerSample hand, const auto& go) {
    for (const auto phase : {PointerSample::Phase::Press, PointerSample::Phase::Drag, PointerSample::Phase::Release}) {
      hand.phase = phase;
      if (phase != PointerSample::Phase::Press) go(hand);
      session.feed(hand);
    }
    session.finish();
  };
  const std::size_t steps = session.steps().size();
  const Flat frontLay = session.table().at(front), backLay = session.table().at(back);
  PointerSample hand;
  hand.where = PointerSample::Where::Table, hand.reach = 0.005, hand.place = inside(front) + frontLay;
  carry(hand, [&](PointerSample& sample) { sample.place = inside(front) + frontLay + Flat{0.3, 0.1}; });
  EXPECT_EQ(session.steps().size(), steps);
  for (const auto& [id, lay] : {std::pair(front, frontLay), std::pair(back, backLay)})
    EXPECT_LT(distance(session.table().at(id), lay + Flat{0.3, 0.1}), 1e-9);
  const Vec3 frontStood = place(front), backStood = place(back);
  const Vec3 hold = Stand(*session.snapshot().document.find(front))(inside(front));
  hand = {};
  hand.where = PointerSample::Where::Space, hand.facing = {0, 0, 1}, hand.alt = true;
  hand.ray = {hold + Vec3{0, 0, 1}, {0, 0, -1}};
  carry(hand, [&](PointerSample& sample) { sample.ray = {hold + Vec3{0.25, 0.1, 1}, {0, 0, -1}}; });
  EXPECT_EQ(session.steps().size(), steps + 1);
  EXPECT_EQ(session.selection().pieces.size(), 2u);
  EXPECT_LT(distance(place(front), frontStood + Vec3{0.25, 0.1, 0}), 1e-3);
  EXPECT_LT(distance(place(back), backStood + Vec3{0.25, 0.1, 0}), 1e-3);
  session.command(Command::Undo);
  session.finish();
  EXPECT_LT(distance(place(back), backStood), 1e-9);
}

}  // namespace
}  // namespace karinui
