#include "studio/person.h"
#include "menu_letters.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QLineEdit>
#include <QMenu>
#include <QPointer>
#include <QTabBar>
#include <QTabWidget>
#include <QTest>
#include <QTimer>
#include <QWindow>

namespace karinui::studio {

namespace {

QPoint inWindow(const QWidget& widget, QPointF at) { return widget.mapTo(widget.window(), at).toPoint(); }

// What a click there would meet.
bool reaches(QWidget& widget, QPointF at) {
  QWidget* met = widget.window()->childAt(inWindow(widget, at));
  return widget.isVisible() && met && (met == &widget || widget.isAncestorOf(met) || met->isAncestorOf(&widget));
}

}  // namespace

void Person::count(const std::string& what) {
  ++inputs_;
  done_.push_back(what);
}

// The wheel over the board, as far as it needs.
void Person::scrollTo(QWidget& widget) {
  for (QWidget* up = widget.parentWidget(); up; up = up->parentWidget()) {
    auto* area = qobject_cast<QScrollArea*>(up);
    if (!area) continue;
    const auto seen = [&] { return QRect(widget.mapTo(area->viewport(), QPoint()), widget.size()); };
    const auto inSight = [&] { return area->viewport()->rect().adjusted(0, 2, 0, -2).contains(seen().center()); };
    if (inSight()) continue;
    count("wheel");
    for (int k = 0; k < 60 && !inSight(); ++k) {
      const QPointF at(2, area->viewport()->height() / 2.0);
      QWheelEvent event(at, area->viewport()->mapToGlobal(at), {}, {0, seen().center().y() > 0 ? -60 : 60},
                        Qt::NoButton, {}, Qt::NoScrollPhase, false);
      QApplication::sendEvent(area->viewport(), &event);
      QApplication::processEvents();
    }
  }
}

void Person::click(QWidget& widget, QPointF at, Qt::MouseButton button) {
  scrollTo(widget);
  ASSERT_TRUE(reaches(widget, at)) << widget.metaObject()->className() << " " << widget.objectName().toStdString()
                                   << " " << widget.accessibleName().toStdString() << " cannot be clicked";
  count("click");
  QWindow* window = widget.window()->windowHandle();
  QTest::mouseMove(window, inWindow(widget, at));
  QTest::mouseClick(window, button, {}, inWindow(widget, at));
  QApplication::processEvents();
}

void Person::drag(QWidget& widget, const std::vector<QPointF>& path, Qt::MouseButton button) {
  for (const QPointF at : path) ASSERT_TRUE(reaches(widget, at)) << "the way leads out of the view";
  count("drag");
  QWindow* window = widget.window()->windowHandle();
  QTest::mouseMove(window, inWindow(widget, path.front()));
  QTest::mousePress(window, button, {}, inWindow(widget, path.front()));
  for (const QPointF at : path) {
    QTest::mouseMove(window, inWindow(widget, at));
    QApplication::processEvents();
  }
  QTest::mouseRelease(window, button, {}, inWindow(widget, path.back()));
  QApplication::processEvents();
}

void Person::key(int key, Qt::KeyboardModifiers with, int times) {
  for (int k = 0; k < times; ++k) {
    count("key");
    QWidget* focused = QApplication::focusWidget();
    QTest::keyClick(focused ? focused : &w_.main(), static_cast<Qt::Key>(key), with);
    QApplication::processEvents();
  }
}

// As the window system tells it.
void Person::menuKey(QWidget& widget) {
  count("key");
  QContextMenuEvent event(QContextMenuEvent::Keyboard, widget.rect().center(),
                          widget.mapToGlobal(widget.rect().center()));
  QApplication::sendEvent(&widget, &event);
  QApplication::processEvents();
}

void Person::type(const QString& text, Qt::Key end) {
  QWidget* focused = QApplication::focusWidget();
  ASSERT_TRUE(focused) << "nothing takes " << text.toStdString();
  count("typed " + text.toStdString());
  QTest::keyClicks(focused, text);
  QTest::keyClick(focused, end);
  QApplication::processEvents();
}

void Person::board(int which) {
  QTabBar* tabs = w_.main().boards().tabBar();
  click(*tabs, tabs->tabRect(which).center());
}

void Person::choose(const Message& item) {
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu) << "no menu is open";
  for (QAction* action : menu->actions())
    if (withoutLetter(*action) == inWords(item)) {
      ASSERT_TRUE(action->isEnabled());
      count("click");
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
      return QApplication::processEvents();
    }
  FAIL() << "the menu does not offer " << inWords(item).toStdString();
}

void Person::choose(QComboBox& box, int item) {
  click(box);
  QAbstractItemView* list = box.view();
  ASSERT_TRUE(list->isVisible());
  const QRect row = list->visualRect(box.model()->index(item, 0));
  ASSERT_TRUE(list->viewport()->rect().contains(row.center()));
  count("click");
  QTest::mouseMove(list->viewport(), row.center());
  QTest::qWait(2 * QApplication::doubleClickInterval());  // the list takes no release right after it opened
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, row.center());
  QApplication::processEvents();
}

QPushButton& Person::button(const Message& words) { return w_.button(inWords(words).toUtf8().constData()); }
LengthBox& Person::box(const Message& name) { return w_.box(inWords(name).toUtf8().constData()); }

Person::~Person() { EXPECT_TRUE(waiting_.children().empty()) << "a dialog that was waited for did not come"; }

void Person::inDialog(std::function<void(QWidget&)> then) {
  auto* watch = new QTimer(&waiting_);
  QWidget* was = QApplication::activeModalWidget();
  QObject::connect(watch, &QTimer::timeout, [watch, was, then = std::move(then)] {
    QWidget* dialog = QApplication::activeModalWidget();
    if (!dialog || dialog == was || !dialog->isVisible()) return;
    watch->stop();
    watch->setParent(qApp);
    const auto act = then;  // the timer, and what it holds, may be deleted while the dialog is waited for
    watch->deleteLater();
    const QPointer<QWidget> open(dialog);
    dialog->activateWindow();
    while (open && !open->isActiveWindow()) QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    ASSERT_TRUE(open) << "the dialog closed by itself";
    act(*open);
  });
  watch->start(0);
}

}  // namespace karinui::studio
