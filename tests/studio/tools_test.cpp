// The tools in the real window, worked with the mouse: from the first stroke to the pattern.
#include <gmock/gmock.h>

#include <QDialog>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QPushButton>
#include <QTest>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(StudioTools, DrawsHalfALineIntoASymmetricPiece) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  w.session().perform(SetBody{.size = "jis9ar", .sex = {}, .set = {}, .mesh = {}});
  w.rest();
  w.view(View::Front);
  w.key(Command::Draw);
  std::vector<QPointF> line;
  for (const char* place :
       {"torso:shoulder+0.4@0", "torso:shoulder+0.6@0.1", "torso:armpit+0.4@0.16", "torso:armpit-0.2@0.2",
        "torso:waist@0.19", "torso:hip@0.19", "torso:hip@0.1", "torso:hip@0"})
    line.push_back(w.onSkin(place));
  w.drag(w.space(), line, {}, [&] {
    w.keep("studio_draw");
    EXPECT_FALSE(w.session().preview().space.lines.empty());
    EXPECT_EQ(w.count(), 1u) << "nothing happens before the release";
  });
  w.rest();
  ASSERT_EQ(w.count(), 2u) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), StartsWith("draw name=front"));
  EXPECT_THAT(w.last(), HasSubstr("symmetric=yes"));
}

TEST(StudioTools, UndoTakesBackAStroke) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  w.session().perform(SetBody{.size = "jis9ar", .sex = {}, .set = {}, .mesh = {}});
  w.rest();
  w.view(View::Front);
  w.key(Command::Draw);
  for (const char* place : {"torso:armpit@0.05", "torso:waist@0.05", "torso:waist@0.95", "torso:hip@0.95"})
    w.click(w.space(), w.onSkin(place));
  w.key(Command::Undo);
  w.click(w.space(), w.onSkin("torso:armpit@0.95"));
  w.key(Command::Confirm);
  w.rest();
  ASSERT_EQ(w.count(), 2u) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), testing::Not(HasSubstr("torso:hip")));
}

TEST(StudioTools, CutsASlitAndItSettles) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Cut);
  w.drag(w.space(), {w.inSpace("front", {0.03, 0.0}) + QPointF(0, 30), w.inSpace("front", {0.03, 0.13})}, {}, [&] {
    w.keep("studio_cut");
    EXPECT_THAT(text(w.session().hint()), HasSubstr("slit"));
  });
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("cut piece=p"));
  EXPECT_THAT(w.last(), StartsWith("drape live="));
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(w.count(), before) << "the drape that came by itself goes with the cut";
}

TEST(StudioTools, CutsOnTheTable) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Cut);
  w.drag(w.table(), {w.onTable("back", {0.05, -0.08}), w.onTable("back", {0.05, 0.1})});
  w.rest();
  EXPECT_GE(w.count(), before + 1) << w.main().said().toStdString();
}

// The image of the line is shown on the symmetric copy, which is cut with the piece, and with Alt it is not.
TEST(StudioTools, CutsTheSymmetricCopyToo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation(
      "piece name=front_left outline=\"M 0 0; hem L 300 0; side L 300 400; top L 0 400; centre L 0 0\""));
  w.session().perform(*parseOperation("mirror piece=front_left"));
  w.rest();
  const std::size_t before = w.count();
  const std::vector<QPointF> across{w.onTable("front_left", {-0.03, 0.2}), w.onTable("front_left", {0.33, 0.2})};
  w.key(Command::Cut);
  std::size_t lines = 0, alone = 0;
  w.drag(w.table(), across, Qt::AltModifier, [&] { alone = w.session().preview().table.lines.size(); });
  w.rest();
  EXPECT_EQ(w.session().snapshot().document.pattern.pieces.size(), 3u);
  EXPECT_THAT(w.last(), testing::Not(HasSubstr("copies")));
  w.key(Command::Undo);
  w.rest();
  ASSERT_EQ(w.count(), before);
  w.drag(w.table(), across, {}, [&] { lines = w.session().preview().table.lines.size(); });
  w.rest();
  EXPECT_EQ(lines, alone + 1);
  EXPECT_EQ(w.session().snapshot().document.pattern.pieces.size(), 4u) << w.main().said().toStdString();
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("front_right_2"));
}

TEST(StudioTools, SaysWhyACutIsRefused) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Cut);
  w.drag(w.space(), {w.inSpace("front", {-0.04, 0.2}), w.inSpace("front", {0.04, 0.3})});
  w.rest();
  EXPECT_EQ(w.count(), before);
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("does not reach the outline"));
  w.keep("studio_refused");
}

TEST(StudioTools, PullsWithALivePreviewAndAForce) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  const std::uint64_t predicted = w.session().changes().predicted;
  w.key(Command::Pull);
  const QPointF hem = w.inSpace("front", {0.04, 0.04});
  w.drag(w.space(), {hem, hem + QPointF(40, 20)}, {}, [&] {
    w.session().finish();
    w.keep("studio_pull");
    EXPECT_GT(w.session().changes().predicted, predicted) << "the cloth followed the hand";
    EXPECT_THAT(text(w.session().hint()), HasSubstr(" N."));
    EXPECT_EQ(w.count(), before);
  });
  w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), StartsWith("pull piece=p"));
}

TEST(StudioTools, ReshapesWithThePaperFollowing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Reshape);
  const QPointF hem = w.inSpace("front", {0.0, 0.015});
  w.drag(w.space(), {hem, hem + QPointF(0, 22)}, {}, [&] {
    w.session().finish();
    w.keep("studio_reshape");
    EXPECT_EQ(w.session().preview().outlines.size(), 1u);
  });
  w.rest();
  ASSERT_GE(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("reshape piece=p"));
}

TEST(StudioTools, MovesAPieceAndEscapeDropsIt) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Move);
  const QPointF at = w.inSpace("front", {0, 0.3});
  w.drag(w.space(), {at, at + QPointF(60, -30)}, {}, [&] {
    EXPECT_EQ(w.session().preview().carried.size(), 1u);
    w.key(Command::Cancel);
  });
  w.rest();
  EXPECT_EQ(w.count(), before);
  w.drag(w.space(), {at, at + QPointF(60, -30)}, Qt::AltModifier, [&] { w.keep("studio_move"); });
  w.rest();
  ASSERT_EQ(w.count(), before + 1);
  EXPECT_THAT(w.last(), StartsWith("move piece=p"));
}

TEST(StudioTools, UndoInMidDragDropsOnlyTheDrag) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Move);
  const QPointF at = w.inSpace("front", {0, 0.3});
  w.drag(w.space(), {at, at + QPointF(60, -30)}, {}, [&] { w.key(Command::Undo); });
  w.rest();
  EXPECT_EQ(w.count(), before);
}

TEST(StudioTools, UnsewsAndSewsFromEdgeToEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Selection seam;
  seam.seam = w.session().snapshot().document.pattern.seams.begin()->first;
  w.session().select(seam);
  w.rest();
  w.key(Command::Remove);
  w.rest();
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 3u);
  const auto middle = [&](const char* piece) {
    const Piece* p = w.session().snapshot().document.pieceNamed(piece);
    return w.onTable(piece, findEdge(*p, "shoulder_left")->curve.atFraction(0.5));
  };
  w.key(Command::Sew);
  w.drag(w.table(), {middle("front"), middle("back")}, {}, [&] {
    w.keep("studio_sew");
    EXPECT_FALSE(w.session().preview().table.words.empty()) << "both lengths are told before the release";
  });
  w.rest();
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 4u) << w.main().said().toStdString();
}

TEST(StudioTools, DragsACornerOfThePatternAndTheClothFollows) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Points);
  const Piece* front = w.session().snapshot().document.pieceNamed("front");
  const Flat corner = findEdge(*front, "side_left")->curve.start;
  w.drag(w.table(), {w.onTable("front", corner), w.onTable("front", corner) + QPointF(8, 14)}, {}, [&] {
    w.session().finish();
    w.keep("studio_points");
    EXPECT_NE(&w.session().shown(), &w.session().snapshot()) << "the fitting shows what is to come";
  });
  w.rest();
  ASSERT_GE(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("reshape piece=p"));
}

TEST(StudioTools, SpaceSettlesAndStops) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  const std::string stand = drapeHash(w.session().snapshot().document);
  // Stopped before anything has moved, nothing is changed.
  w.key(Command::Settle);
  EXPECT_TRUE(w.session().busy().settling);
  w.key(Command::Settle);
  w.rest();
  if (w.count() > before) w.key(Command::Undo), w.rest();
  ASSERT_EQ(w.count(), before);
  // Stopped under way the cloth stays where it is, and one undo takes it back.
  ChangeSettings fine;  // so that it takes a while
  fine.spacing = Length{0.008};
  w.session().perform(fine);
  w.rest();
  ASSERT_EQ(w.count(), before + 1);
  std::uint64_t predicted = w.session().changes().predicted;
  w.key(Command::Settle);
  while (w.session().busy().settling && w.session().changes().predicted == predicted)
    QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  ASSERT_TRUE(w.session().busy().settling) << "seen on its way";
  w.space().setFocus();
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  QTest::keyClick(&w.space(), Qt::Key_Space);
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), testing::MatchesRegex("drape live=.* stop=[0-9]+"));
  EXPECT_THAT(w.main().said().toStdString(), testing::HasSubstr("Stopped where it is"));
  const Document& document = w.session().snapshot().document;
  EXPECT_FALSE(document.drape.last->settled);
  EXPECT_TRUE(document.drape.dirty.contains(document.pieceNamed("front")->id)) << "its dot stays";
  w.key(Command::Undo);
  w.rest();
  ASSERT_EQ(w.count(), before + 1);
  predicted = w.session().changes().predicted;
  w.key(Command::Settle);  // still fine: on coarse cloth it may be over before there is a picture
  w.rest();
  EXPECT_EQ(w.count(), before + 2);
  EXPECT_GT(w.session().changes().predicted, predicted) << "the cloth was seen on its way";
  w.key(Command::Undo);
  w.rest();
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(drapeHash(w.session().snapshot().document), stand);
}

// A newcomer's shirt: two clicks from a figure to a shirt at rest.
TEST(StudioTools, AShirtFromTheFigureInTwoClicks) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  for (const char* line : {"body size=eu50", "set spacing=20mm"}) w.session().perform(*parseOperation(line)), w.rest();
  auto* blocks = w.main().findChild<QPushButton*>("blocks_button");
  ASSERT_TRUE(blocks && blocks->menu());
  QMenu* menu = blocks->menu();
  menu->popup(w.main().mapToGlobal(QPoint(200, 200)));
  QAction* shirt = menu->findChild<QAction*>("block_shirt");
  ASSERT_TRUE(shirt && shirt->isEnabled());
  QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(shirt).center());
  w.rest();
  ASSERT_EQ(w.count(), 4u) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[2].operation), StartsWith("block kind=shirt"));
  const auto& report = w.session().snapshot().document.drape.last;
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled);
}

TEST(StudioTools, DragsARectangleAndACircleOnThePattern) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Rectangle);
  const QPointF corner(30, 30), far(150, 90);
  w.drag(w.table(), {corner, far}, {}, [&] {
    EXPECT_FALSE(w.session().preview().table.lines.empty());
    EXPECT_EQ(w.count(), before) << "nothing happens before the release";
  });
  w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), StartsWith("rectangle name=rectangle width="));
  w.key(Command::Circle);
  w.drag(w.table(), {corner, corner + QPointF(40, 0)});
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), StartsWith("ring name=circle depth="));
  // A click draws nothing, it asks for numbers.
  w.click(w.table(), corner);
  w.rest();
  EXPECT_EQ(w.count(), before + 2);
  EXPECT_TRUE(w.main().findChild<QDialog*>("step_dialog"));
}

}  // namespace
}  // namespace karinui::studio
