#include "wheel_guard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QPointer>
#include <QScrollBar>
#include <QTabBar>

namespace karinui::studio {

namespace {

bool isBox(const QObject* object) {
  if (qobject_cast<const QScrollBar*>(object)) return false;
  return qobject_cast<const QAbstractSpinBox*>(object) || qobject_cast<const QAbstractSlider*>(object) ||
         qobject_cast<const QComboBox*>(object) || qobject_cast<const QTabBar*>(object);
}

// A list keeps the focus after something was chosen from it, and each line the wheel passes would be a step of its own.
bool takesWheel(const QWidget* box) {
  return box->hasFocus() && !qobject_cast<const QComboBox*>(box) && !qobject_cast<const QTabBar*>(box);
}

}  // namespace

void WheelGuard::install() {
  static QPointer<WheelGuard> guard;
  if (guard) return;
  guard = new WheelGuard(qApp);
  qApp->installEventFilter(guard);
}

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Polish && event->type() != QEvent::Wheel) return false;
  if (!isBox(watched)) return false;
  auto* box = static_cast<QWidget*>(watched);
  if (event->type() == QEvent::Polish) {  // comes once to every widget before it is first shown
    if (box->focusPolicy() == Qt::WheelFocus) box->setFocusPolicy(Qt::StrongFocus);
    return false;
  }
  if (takesWheel(box)) return false;
  event->ignore();
  return true;
}

}  // namespace karinui::studio
