// Pockets in a seam and slanted ones, sewn by the right button and by the menu in the real window.
#include <gmock/gmock.h>

#include <QLabel>
#include <QLineEdit>

#include "karinui/design/script.h"
#include "karinui/pattern/pockets.h"
#include "step_dialog.h"
#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A front and a back that are sewn along one side, beside the figure, and hold still there.
void openSide(Window& w) {
  w.openTunic();
  for (const char* line :
       {"piece name=skirt_front outline=\"M 0 0; hem L 260 0; side L 240 500; waist L 0 490; centre L 0 0\" "
        "pose=\"1,0.5,0\"",
        "piece name=skirt_back outline=\"M -260 0; hem L 0 0; centre L 0 500; waist L -240 500; side L -260 0\" "
        "pose=\"1.52,0.5,0\"",
        "sew a=skirt_front.side b=skirt_back.side name=outer_side", "freeze piece=\"skirt_front skirt_back\""})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
}

std::size_t pockets(Window& w) { return pocketsOf(w.session().snapshot().document.pattern).size(); }

// The right button on a side seam, a longer opening, Enter; what has no room is refused in the dialog with how deep
// there is room, and nothing is changed. Undone, the seam is whole.
TEST(StudioPockets, InASeamByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  const std::size_t before = w.count();
  menuOn(w, "skirt_front", "side");
  ASSERT_TRUE(choose(w, "Pocket in this seam…")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("length").text(), "16 cm");
    EXPECT_EQ(numbers.line("first").text(), "4 cm");
    EXPECT_FALSE(numbers.line("inset").isVisible()) << "only a slanted pocket begins on the waist";
    numbers.type("depth", "35");
    w.rest();
    EXPECT_THAT(numbers.said().toStdString(), HasSubstr("cm have"));
    EXPECT_FALSE(numbers.make().isEnabled());
    numbers.type("depth", "14");
    numbers.type("length", "17");
    w.rest();
    EXPECT_EQ(numbers.said(), "");
    EXPECT_EQ(pockets(w), 0u) << "it is only shown";
    numbers.acceptStep();
  }
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), AllOf(StartsWith("pocket "), HasSubstr("length=170mm")));
  EXPECT_EQ(pockets(w), 1u);
  w.key(Command::Undo), w.rest();
  EXPECT_EQ(pockets(w), 0u);
  EXPECT_EQ(w.session().snapshot().document.pieceNamed("pocket_bag_front"), nullptr);
}

// A slanted one is offered on the waist, at the side it is nearer to, and on the side.
TEST(StudioPockets, SlantedByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  const std::size_t before = w.count();
  menuOn(w, "skirt_front", "hem");
  EXPECT_FALSE(choose(w, "Slanted pocket…")) << "a hem has no upper corner";
  w.key(Command::Select);
  menuOn(w, "skirt_front", "side");
  ASSERT_TRUE(choose(w, "Slanted pocket…")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("inset").text(), "4 cm");
    EXPECT_FALSE(numbers.line("first").isVisible());
    numbers.accept();
  }
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), AllOf(StartsWith("pocket "), HasSubstr("kind=slant")));
  EXPECT_EQ(pockets(w), 1u);
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("pocket_side"));
}

// The piece whose edge a pocket in the seam of a side is set into.
std::optional<PieceId> pieceOfSeamPocket(Window& w, const char* pointedAt) {
  const std::size_t before = w.count();
  menuOn(w, pointedAt, "side");
  EXPECT_TRUE(choose(w, "Pocket in this seam…")) << w.main().said().toStdString();
  Numbers numbers(w);
  if (!numbers) return std::nullopt;
  numbers.acceptStep();
  if (w.count() <= before) return std::nullopt;
  const auto* pocket = std::get_if<SewPocket>(&w.session().steps()[before].operation);
  return pocket ? std::optional(pocket->edge.piece.id) : std::nullopt;
}

// The seam is one: on the back's edge of it the same pocket is meant, whose bags hang to the front.
TEST(StudioPockets, OnTheBackTheyHangToTheFront) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  EXPECT_EQ(pieceOfSeamPocket(w, "skirt_back"), piece(w, "skirt_front").id);
}

// Which of the two is the front is seen by how they stand, not by what they are called.
TEST(StudioPockets, TheFrontIsTheOneThatStandsInFront) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  for (const char* line :
       {"piece name=panel_1 outline=\"M 0 0; hem L 260 0; side L 240 500; waist L 0 490; centre L 0 0\" "
        "pose=\"1,0.5,-0.05\"",
        "piece name=panel_2 outline=\"M -260 0; hem L 0 0; centre L 0 500; waist L -240 500; side L -260 0\" "
        "pose=\"1.52,0.5,0.05\"",
        "sew a=panel_1.side b=panel_2.side name=outer_side", "freeze piece=\"panel_1 panel_2\""})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  EXPECT_EQ(pieceOfSeamPocket(w, "panel_1"), piece(w, "panel_2").id);
}

// A welt pocket where the right button points within a piece, at half centimetres; typed turned, and refused where its
// bags have no room.
TEST(StudioPockets, AWeltByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  const std::size_t before = w.count();
  w.drag(w.table(), {w.onTable("skirt_front", Flat{0.131, 0.331})}, {}, {}, Qt::RightButton);
  ASSERT_TRUE(choose(w, "Welt pocket here…")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    numbers.type("below", "39");
    w.rest();
    EXPECT_THAT(numbers.said().toStdString(), HasSubstr("cm have"));
    EXPECT_FALSE(numbers.make().isEnabled());
    numbers.type("below", "15");
    w.rest();
    EXPECT_EQ(numbers.said(), "");
    numbers.accept();
  }
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  const auto* welt = std::get_if<SewWelt>(&w.session().steps()[before].operation);
  ASSERT_TRUE(welt);
  EXPECT_NEAR(welt->at.u, 0.13, 1e-9);
  EXPECT_NEAR(welt->at.v, 0.33, 1e-9);
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("pocket_welt"));
  w.key(Command::Undo), w.rest();
  EXPECT_FALSE(w.session().snapshot().document.pieceNamed("pocket_welt"));
}

// By the menu, for the keys: with an edge chosen.
TEST(StudioPockets, ByTheMenu) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  w.click(w.table(), w.onTable("skirt_front", findEdge(piece(w, "skirt_front"), "side")->curve.atFraction(0.4)));
  ASSERT_TRUE(w.session().selection().edge);
  fromTheMenu(w, say("Pocket in the seam of the chosen edge…"));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.acceptStep();
  EXPECT_EQ(pockets(w), 1u);
  EXPECT_EQ(w.session().snapshot().document.pieceNamed("pocket_bag_front")->fabric, "cotton");
}

// With a piece chosen; the numbers that are left to the kind of pocket say so.
TEST(StudioPockets, AWeltByTheMenu) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openSide(w);
  w.click(w.table(), w.onTable("skirt_front", Flat{0.13, 0.3}));
  ASSERT_EQ(w.session().selection().pieces.size(), 1u);
  const std::size_t before = w.count();
  fromTheMenu(w, say("Welt pocket in the chosen piece…"));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  for (const char* field : {"length", "width"}) {
    EXPECT_EQ(numbers.line(field).text(), "") << field;
    EXPECT_EQ(numbers.line(field).placeholderText(), "by the kind of pocket") << field;
  }
  numbers.accept();
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  const auto* welt = std::get_if<SewWelt>(&w.session().steps()[before].operation);
  ASSERT_TRUE(welt);
  EXPECT_NEAR(*welt->length, 0.135, 1e-9);
}

}  // namespace
}  // namespace karinui::studio
