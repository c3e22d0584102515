#include "keys.h"

namespace karinui::studio {

std::optional<KeyStroke> strokeOf(const QKeyEvent& event) {
  switch (event.key()) {
    case Qt::Key_Left:
      return KeyStroke::Left;
    case Qt::Key_Right:
      return KeyStroke::Right;
    case Qt::Key_Up:
      return KeyStroke::Up;
    case Qt::Key_Down:
      return KeyStroke::Down;
    case Qt::Key_Tab:
      return KeyStroke::Next;
    case Qt::Key_Backtab:
      return KeyStroke::Previous;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return KeyStroke::Press;
    case Qt::Key_PageUp:
      return KeyStroke::Longer;
    case Qt::Key_PageDown:
      return KeyStroke::Shorter;
    default:
      return std::nullopt;
  }
}

bool isForFingertip(QEvent* event, const Session& session) {
  if (event->type() != QEvent::ShortcutOverride || !session.fingertip()) return false;
  return strokeOf(*static_cast<QKeyEvent*>(event)) == KeyStroke::Press;
}

}  // namespace karinui::studio
