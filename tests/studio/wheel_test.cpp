// The wheel over boxes that have not the focus: nothing changes, and what they lie in scrolls.
#include <QtTest/qtestspontaneevent.h>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>

#include "export_dialog.h"
#include "menu_letters.h"
#include "picture_dialog.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

// As the window system sends it: to the widget under the cursor, and on to its parents until one accepts it.
void roll(QWidget& over, int eighths) {
  const QPoint at = over.rect().center();
  QWidget* under = over.childAt(at) ? over.childAt(at) : &over;
  const QPointF there = under->mapFrom(&over, at);
  QWheelEvent event(there, under->mapToGlobal(there), {}, {0, eighths}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
  QSpontaneKeyEvent::setSpontaneous(&event);
  qApp->notify(under, &event);
}

std::string valueOf(const QWidget& box) {
  if (const auto* number = qobject_cast<const QAbstractSpinBox*>(&box)) return number->text().toStdString();
  if (const auto* slider = qobject_cast<const QAbstractSlider*>(&box)) return std::to_string(slider->value());
  if (const auto* combo = qobject_cast<const QComboBox*>(&box)) return std::to_string(combo->currentIndex());
  return std::to_string(static_cast<const QTabBar&>(box).currentIndex());
}

std::vector<QWidget*> boxesIn(QWidget& window) {
  std::vector<QWidget*> boxes;
  for (QWidget* one : window.findChildren<QWidget*>()) {
    const bool box = qobject_cast<QAbstractSpinBox*>(one) || qobject_cast<QComboBox*>(one) ||
                     qobject_cast<QTabBar*>(one) ||
                     (qobject_cast<QAbstractSlider*>(one) && !qobject_cast<QScrollBar*>(one));
    if (box && one->isVisible() && one->isEnabled()) boxes.push_back(one);
  }
  return boxes;
}

std::string nameOf(const QWidget& box) {
  return box.metaObject()->className() + (" “" + box.accessibleName().toStdString() + "”");
}

// The scroll areas round a box that have somewhere to go, and where they are.
std::vector<int> scrolledTo(const QWidget& box) {
  std::vector<int> all;
  for (const QWidget* up = box.parentWidget(); up; up = up->parentWidget())
    if (const auto* area = qobject_cast<const QScrollArea*>(up); area && area->verticalScrollBar()->maximum() > 0)
      all.push_back(area->verticalScrollBar()->value());
  return all;
}

int rollOverAll(QWidget& window, const std::function<std::size_t()>& steps) {
  const std::vector<QWidget*> boxes = boxesIn(window);
  for (QWidget* box : boxes) {
    if (QWidget* focused = QApplication::focusWidget()) focused->clearFocus();
    const std::string before = valueOf(*box);
    const std::size_t count = steps();
    const std::vector<int> at = scrolledTo(*box);
    bool scrolled = at.empty();
    for (const int way : {-120, -120, 120, 120, 120, -120}) {
      roll(*box, way);
      scrolled = scrolled || scrolledTo(*box) != at;
      EXPECT_EQ(valueOf(*box), before) << nameOf(*box);
    }
    EXPECT_TRUE(scrolled) << nameOf(*box) << " keeps the wheel to itself";
    EXPECT_FALSE(box->hasFocus()) << nameOf(*box);
    EXPECT_EQ(steps(), count) << nameOf(*box);
  }
  return static_cast<int>(boxes.size());
}

TEST(StudioWheel, ChangesNoBoxOfABoardUnlessItHasTheFocus) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().resize(1000, 620);
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  chosen.edge = EdgeNear{*chosen.pieces.begin(), "side_left", 0.5, 0};
  w.session().select(chosen);
  const auto steps = [&] {
    w.rest();
    return w.count();
  };
  int boxes = 0;
  for (int board = 0; board < w.main().boards().count(); ++board) {
    w.main().boards().setCurrentIndex(board);
    w.rest();
    boxes += rollOverAll(w.main(), steps);
    EXPECT_EQ(w.main().boards().currentIndex(), board) << "the tabs are no boxes to roll over either";
  }
  EXPECT_GT(boxes, 40);
}

TEST(StudioWheel, ChangesTheBoxThatHasTheFocus) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(3);
  w.main().activateWindow();
  w.rest();
  LengthBox& height = w.box("Height above the floor");
  height.setFocus();
  ASSERT_TRUE(height.hasFocus());
  const double before = height.value();
  roll(height, 120);
  EXPECT_GT(height.value(), before);
}

// A list has the focus after something was chosen from it; the wheel, rolled on over it, would make step after step.
TEST(StudioWheel, ChangesNoListEvenWithTheFocus) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().activateWindow();
  int lists = 0;
  for (int board = 0; board < w.main().boards().count(); ++board) {
    w.main().boards().setCurrentIndex(board);
    w.rest();
    for (QWidget* box : boxesIn(w.main())) {
      auto* list = qobject_cast<QComboBox*>(box);
      if (!list || !list->isVisible() || list->count() < 2) continue;
      list->setFocus();
      if (!list->hasFocus()) continue;
      const int chosen = list->currentIndex();
      const std::size_t steps = w.count();
      for (const int way : {-120, -120, 120, 120, 120}) roll(*list, way);
      w.rest();
      EXPECT_EQ(list->currentIndex(), chosen) << nameOf(*list);
      EXPECT_EQ(w.count(), steps) << nameOf(*list);
      ++lists;
    }
  }
  EXPECT_GT(lists, 2);
}

TEST(StudioWheel, ChangesNoBoxOfADialog) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto steps = [&] { return w.count(); };
  ExportDialog out(w.session(), w.space(), &w.main());
  out.show();
  QApplication::processEvents();
  EXPECT_GE(rollOverAll(out, steps), 2);
  out.close();
  PictureDialog picture(w.session(), w.space(), &w.main());
  picture.show();
  QApplication::processEvents();
  EXPECT_EQ(rollOverAll(picture, steps), 3);
  picture.close();
  for (const char* words : {"New garment…", "Keys…"})
    for (QAction* action : w.main().findChildren<QAction*>())
      if (withoutLetter(*action) == words) {
        bool met = false;
        QTimer::singleShot(0, &w.main(), [&] {
          auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
          ASSERT_TRUE(dialog) << words;
          met = true;
          rollOverAll(*dialog, steps);
          dialog->reject();
        });
        action->trigger();
        EXPECT_TRUE(met);
        break;
      }
}

}  // namespace
}  // namespace karinui::studio
