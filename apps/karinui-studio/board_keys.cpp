#include "board_keys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPointer>
#include <QSignalBlocker>

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

constexpr const char* kByMouse = "by_mouse";

// What was entered is no longer half typed, and is not entered once more as the box is left.
void entered(QLineEdit& line, MainWindow& window) {
  auto* box = qobject_cast<QAbstractSpinBox*>(line.parentWidget());
  QWidget* typed = box ? static_cast<QWidget*>(box) : &line;
  if (box) line.setModified(false);
  if (!typed->hasFocus() || !line.property(kByMouse).toBool()) return;
  const QSignalBlocker quiet(typed);
  window.space().setFocus();
}

bool isEnter(const QKeyEvent& key) { return key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter; }

}  // namespace

void BoardKeys::install() {
  static QPointer<BoardKeys> guard;
  if (guard) return;
  guard = new BoardKeys(qApp);
  qApp->installEventFilter(guard);
}

bool BoardKeys::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type kind = event->type();
  if (kind != QEvent::ShortcutOverride && kind != QEvent::KeyPress && kind != QEvent::FocusIn) return false;
  QLineEdit* line = typedLine(watched);
  auto* window = line ? qobject_cast<MainWindow*>(line->window()) : nullptr;
  if (!window) return false;
  if (kind == QEvent::FocusIn) {
    const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::PopupFocusReason && reason != Qt::ActiveWindowFocusReason)
      line->setProperty(kByMouse, reason == Qt::MouseFocusReason);
    return false;
  }
  const auto& key = *static_cast<QKeyEvent*>(event);
  if (kind == QEvent::KeyPress) {
    if (isEnter(key) && !qobject_cast<LengthBox*>(line->parentWidget()))
      QMetaObject::invokeMethod(
          line, [line, window] { entered(*line, *window); }, Qt::QueuedConnection);
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
