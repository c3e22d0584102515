#include "undo_guard.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPointer>

#include "length_box.h"
#include "main_window.h"

namespace karinui::studio {

namespace {

// The line in which a box is typed into; null: no such box.
QLineEdit* typedLine(QObject* watched) {
  if (auto* line = qobject_cast<QLineEdit*>(watched)) return line;
  const auto* box = qobject_cast<QAbstractSpinBox*>(watched);
  return box ? box->findChild<QLineEdit*>() : nullptr;
}

bool isEnter(const QKeyEvent& key) { return key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter; }

}  // namespace

void UndoGuard::install() {
  static QPointer<UndoGuard> guard;
  if (guard) return;
  guard = new UndoGuard(qApp);
  qApp->installEventFilter(guard);
}

bool UndoGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) return false;
  QLineEdit* line = typedLine(watched);
  auto* window = line ? qobject_cast<MainWindow*>(line->window()) : nullptr;
  if (!window) return false;
  const auto& key = *static_cast<QKeyEvent*>(event);
  if (event->type() == QEvent::KeyPress) {  // a number that was entered is no longer half typed
    const auto* box = qobject_cast<QAbstractSpinBox*>(line->parentWidget());
    if (box && !qobject_cast<const LengthBox*>(box) && isEnter(key))
      QMetaObject::invokeMethod(
          line, [line] { line->setModified(false); }, Qt::QueuedConnection);
    return false;
  }
  if (beingTyped(*line)) return false;
  const QKeySequence keys(key.keyCombination());
  for (const Command command : {Command::Undo, Command::Redo})
    if (window->action(command)->shortcuts().contains(keys)) {
      event->ignore();
      return true;
    }
  return false;
}

}  // namespace karinui::studio
