#include "focus_frame.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QFocusEvent>
#include <QLineEdit>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QTabBar>
#include <algorithm>

#include "theme.h"

namespace karinui::studio {

namespace {

constexpr int kFrameWide = 2;  // pixels

// Fields and buttons have a border of their own in the sheet of the theme.
bool showsItself(const QWidget* widget) {
  return qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QLineEdit*>(widget) ||
         qobject_cast<const QComboBox*>(widget) || qobject_cast<const QPushButton*>(widget) ||
         qobject_cast<const QMenu*>(widget);
}

}  // namespace

FocusFrame::FocusFrame(QWidget* window) : QWidget(window) {
  setObjectName("focusFrame");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  hide();
  qApp->installEventFilter(this);
}

bool FocusFrame::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      byKeys_ = false;
      place();
      break;
    case QEvent::KeyPress: {
      auto* button = qobject_cast<QPushButton*>(watched);
      const int key = static_cast<QKeyEvent*>(event)->key();
      if (!button || button->window() != parentWidget() || (key != Qt::Key_Return && key != Qt::Key_Enter)) break;
      button->click();
      return true;
    }
    case QEvent::FocusIn: {
      auto* widget = qobject_cast<QWidget*>(watched);
      if (!widget || widget->window() != parentWidget()) break;
      const Qt::FocusReason why = static_cast<QFocusEvent*>(event)->reason();
      byKeys_ = byKeys_ || why == Qt::TabFocusReason || why == Qt::BacktabFocusReason;
      around_ = widget;
      place();
      break;
    }
    case QEvent::FocusOut:
      if (watched == around_) around_.clear(), place();
      break;
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::Hide:
      if (around_ && (watched == around_ || watched == parentWidget())) place();
      break;
    default:
      break;
  }
  return false;
}

void FocusFrame::place() {
  if (!byKeys_ || !around_ || !around_->isVisible() || showsItself(around_)) return hide();
  const auto* tabs = qobject_cast<const QTabBar*>(around_.data());
  const QRect inside = tabs ? tabs->tabRect(tabs->currentIndex()) : around_->rect();
  setGeometry(QRect(around_->mapTo(parentWidget(), inside.topLeft()), inside.size()));
  setMask(QRegion(rect()) - rect().adjusted(kFrameWide, kFrameWide, -kFrameWide, -kFrameWide));
  raise();
  show();
}

void FocusFrame::paintEvent(QPaintEvent*) { QPainter(this).fillRect(rect(), Theme::here().palette().accent); }

}  // namespace karinui::studio
