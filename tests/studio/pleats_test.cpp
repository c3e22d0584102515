// Pleats in the real window: by number on both halves, by lines that were drawn, and those that the paper refuses.
#include <gmock/gmock.h>

#include <QLineEdit>
#include <QMenu>
#include <QTest>

#include "karinui/design/script.h"
#include "menu_letters.h"
#include "new_pieces.h"
#include "step_dialog.h"
#include "studio/asked.h"
#include "studio/window.h"
#include "theme.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

// A waist that a dart or the middle divides is pleated on both halves at once, as darts and notches are put there.
TEST(StudioNewPieces, PleatsOnBothHalvesOfASkirt) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(
      *parseOperation("polygon name=panel points=\"0,0; 20cm,0; 18cm,40cm; 0,40cm; -18cm,40cm; -20cm,0\" "
                      "edges=\"hem_left side_left waist_left waist_right side_right hem_right\""));
  w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  menuOn(w, "panel", "waist_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Pleats…"))) << w.main().said().toStdString();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.type("count", "1");
  EXPECT_EQ(numbers.said().toStdString(), "");
  numbers.accept();
  EXPECT_THAT(w.last(), HasSubstr("symmetric=yes"));
  EXPECT_TRUE(symmetryOf(piece(w, "panel").outline)) << "it stays symmetric";
}

// A kilt's pleat that is drawn: three clicks of two places each, the right button on the fold, and Enter.
TEST(StudioNewPieces, APleatIsFoldedByThreeDrawnLines) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation("rectangle name=skirt width=60cm height=40cm")), w.rest();
  w.table().showAll();
  w.rest();
  w.key(Command::Line);
  for (const double u : {-0.1, -0.07, -0.04}) {
    // A hand hits the edge by a few pixels, and goes on upright with Shift.
    const QPointF low = w.onTable("skirt", {u, 0}) + QPointF(0.3, -2),
                  high = w.onTable("skirt", {u, 0.4}) + QPointF(1, 2);
    w.click(w.table(), low);
    w.drag(w.table(), {high}, Qt::ShiftModifier);
    w.key(Command::Confirm);
    w.rest();
  }
  const auto& lines = piece(w, "skirt").lines;
  ASSERT_EQ(lines.size(), 3u) << w.main().said().toStdString();
  for (const InternalLine& line : lines) {
    EXPECT_EQ(line.curves.front().start.v, 0) << "on the edge";
    EXPECT_EQ(line.curves.front().end.v, 0.4);
    EXPECT_EQ(line.curves.front().start.u, line.curves.front().end.u);
  }
  const std::size_t before = w.count();
  w.key(Command::Select);
  const auto menuOnLine = [&](double u) {
    w.drag(w.table(), {w.onTable("skirt", {u, 0.25})}, {}, {}, Qt::RightButton);
  };
  menuOnLine(-0.07);
  EXPECT_FALSE(choose(w, "Pleat: fold line 2*")) << "beside the middle one there are no two";
  for (QMenu* menu : w.main().findChildren<QMenu*>("context")) menu->close();
  QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  menuOnLine(-0.1);
  int offered = 0;
  for (QMenu* menu : w.main().findChildren<QMenu*>("context"))
    for (QAction* action : menu->actions()) offered += withoutLetter(*action).startsWith("Pleat:");
  EXPECT_EQ(offered, 1) << "to the side where two lines are";
  ASSERT_TRUE(choose(w, QString::fromUtf8("Pleat: fold line onto line 3…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_FALSE(numbers.line("count").isVisible()) << "the lines say it";
  EXPECT_TRUE(numbers.line("stitch").isVisible());
  EXPECT_EQ(numbers.said(), "");
  w.keepDialog(*numbers.dialog, "studio_drawn_pleat");
  numbers.accept();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), HasSubstr("lines=\"p1.line; p1.line_2; p1.line_3\""));
  EXPECT_FALSE(piece(w, "skirt").lines.front().name.empty());
  w.keep("studio_pleated_by_lines");
  w.key(Command::Undo), w.rest();
  EXPECT_EQ(piece(w, "skirt").lines.size(), 3u);
}

// What the paper refuses is said while the numbers can still be changed: the hem's pleats would not end in one edge.
TEST(StudioNewPieces, PleatsThatThePaperRefusesAreToldInTheDialog) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  menuOn(w, "front", "hem_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Pleats…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_NE(numbers.said(), "");
  EXPECT_FALSE(numbers.make().isEnabled());
  QWidget& make = numbers.make();
  EXPECT_NE(make.grab().toImage().pixelColor(6, make.height() / 2), Theme::here().palette().accent) << "seen so";
  QTest::keyClick(&numbers.line("count"), Qt::Key_Return);
  EXPECT_TRUE(numbers.dialog->isVisible()) << "what was typed is not lost";
  w.rest();
  EXPECT_EQ(w.count(), before);
}

}  // namespace
}  // namespace karinui::studio
