#pragma once
// What is asked by the studio's dialogs and menus, for tests that answer.
#include <gtest/gtest.h>

#include <QApplication>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTest>

#include "menu_letters.h"
#include "studio/window.h"
#include "theme.h"

namespace karinui::studio {

struct Numbers {  // the dialog that is open
  Window& w;
  QDialog* dialog;
  explicit Numbers(Window& window, const char* name = "step_dialog")
      : w(window), dialog(window.main().findChild<QDialog*>(name)) {}
  explicit operator bool() const { return dialog != nullptr; }
  QLineEdit& line(const char* field) { return *dialog->findChild<QLineEdit*>(field); }
  void type(const char* field, const char* text) {
    line(field).selectAll();
    QTest::keyClicks(&line(field), text);
  }
  QString said() const { return dialog->findChild<QLabel*>("said")->text(); }
  QPushButton& make() { return *dialog->findChild<QPushButton*>("make"); }
  void accept() {
    QTest::mouseClick(&make(), Qt::LeftButton);
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    w.rest();
  }
  // Without the drape that follows, for what is asked of the step alone.
  void acceptStep() {
    const std::size_t before = w.count();
    QTest::mouseClick(&make(), Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor([&] { return w.count() > before; }, 60'000)) << w.main().said().toStdString();
  }
};

inline const Piece& piece(Window& w, const char* name) {
  const Piece* found = w.session().snapshot().document.pieceNamed(name);
  EXPECT_TRUE(found) << name << ": " << w.main().said().toStdString();
  static const Piece none;
  return found ? *found : none;
}
inline double draftedLength(Window& w, const char* of, const char* edge) {
  const Edge* found = findEdge(piece(w, of), edge);
  EXPECT_TRUE(found) << of << "." << edge;
  return found ? found->curve.length() : 0;
}
inline void menuOn(Window& w, const char* of, const char* edge) {
  const Edge* at = findEdge(piece(w, of), edge);
  w.drag(w.table(), {w.onTable(of, at->curve.atFraction(0.5))}, {}, {}, Qt::RightButton);
}
// An item of the context menu, by its words, their beginning* or their *end; closes it.
inline bool choose(Window& w, const QString& words) {
  for (QMenu* menu : w.main().findChildren<QMenu*>("context"))
    for (QAction* action : menu->actions())
      if (const QString own = withoutLetter(*action); own == words ||
                                                      (words.startsWith("*") && own.endsWith(words.mid(1))) ||
                                                      (words.endsWith("*") && own.startsWith(words.chopped(1)))) {
        QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        w.rest();
        return true;
      }
  return false;
}

inline void fromTheMenu(Window& w, const Message& words) {
  for (QAction* action : w.main().findChildren<QAction*>())
    if (withoutLetter(*action) == inWords(words)) return action->trigger();
  FAIL() << "no such item";
}

}  // namespace karinui::studio
