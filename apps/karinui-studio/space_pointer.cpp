// The mouse over the fitting: the pointer that works the cloth, and walking round.
#include <QApplication>
#include <QContextMenuEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "force_feedback.h"
#include "karinui/session/menu.h"
#include "keys.h"
#include "mouse.h"
#include "orbit.h"
#include "space_view.h"

namespace karinui::studio {

PointerSample SpaceView::sampleAt(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) const {
  PointerSample sample = mouseSample(phase, PointerSample::Where::Space, keys, latencyLog_);
  const QSize parts = halves();
  const double w = 1.0 * width() / parts.width(), h = 1.0 * height() / parts.height();
  const double x = std::fmod(at.x(), w), y = std::fmod(at.y(), h);
  sample.ray = rayAt(camera_, x, y, w, h);
  sample.facing = normalized(camera_.eye - camera_.target);
  sample.reach = 11 * camera_.fieldOfView / h;  // eleven pixels
  return sample;
}

void SpaceView::feed(PointerSample sample) {
  if (!force_ || !force_->pointed(sample)) session_.feed(sample);
}

bool SpaceView::event(QEvent* event) {
  if (isForFingertip(event, session_)) event->accept();
  return QOpenGLWidget::event(event);
}

void SpaceView::keyPressEvent(QKeyEvent* event) {
  const auto stroke = strokeOf(*event);
  if (!stroke) return QOpenGLWidget::keyPressEvent(event);
  latencyLog_.begin("event to picture");
  session_.strike(*stroke, sampleAt({}, event->modifiers(), PointerSample::Phase::Hover));
  refresh();
}

void SpaceView::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
  walk_.stop();
  clicked_ = event->button() == Qt::RightButton ? std::optional(last_) : std::nullopt;
  const bool alt = event->modifiers().testFlag(Qt::AltModifier);
  const Qt::MouseButton turn = blender_ ? Qt::MiddleButton : Qt::RightButton;
  if (event->button() == turn && !(blender_ && event->modifiers().testFlag(Qt::ShiftModifier))) {
    held_ = Held::Turn;
  } else if (event->button() == Qt::MiddleButton) {
    held_ = Held::Pan;
  } else if (event->button() == Qt::LeftButton && alt && session_.tool() != Command::Move &&
             session_.tool() != Command::Draw) {
    held_ = Held::Turn;
  } else if (event->button() == Qt::LeftButton) {
    held_ = Held::Tool;
    toolDown_ = true;
    latencyLog_.begin("event to picture");
    feed(sampleAt(last_, event->modifiers(), PointerSample::Phase::Press));
    refresh();
  }
  if (held_ != Held::Tool) session_.leave();  // what was under the pointer is there no more
  setFocus();
}

void SpaceView::mouseMoveEvent(QMouseEvent* event) {
  if (clicked_) {
    if ((event->position() - *clicked_).manhattanLength() < QApplication::startDragDistance()) return;
    clicked_.reset();
  }
  const QPointF step = event->position() - last_;
  last_ = event->position();
  if (tape_ && held_ == Held::Nothing) {
    const PointerSample sample = sampleAt(last_, event->modifiers(), PointerSample::Phase::Hover);
    const SnapshotPtr fitting = session_.shownPtr();
    tapeShown_ = tapeAt(*fitting, pick(*fitting, session_.table(), sample));
  }
  switch (held_) {
    case Held::Turn:
      framedAs_.reset();
      camera_ = turned(camera_, step.x() * 0.0075, step.y() * 0.0075);
      return cameraMoved();
    case Held::Pan:
      framedAs_.reset();
      camera_ = panned(camera_, step.x(), step.y(), height());
      return cameraMoved();
    default:
      break;
  }
  latencyLog_.begin("event to picture");
  if (held_ == Held::Tool) latencyLog_.begin("drag to preview");
  feed(sampleAt(last_, event->modifiers(),
                held_ == Held::Tool ? PointerSample::Phase::Drag : PointerSample::Phase::Hover));
  refresh();
}

void SpaceView::mouseReleaseEvent(QMouseEvent* event) {
  if (toolDown_ && event->button() == Qt::LeftButton) {
    toolDown_ = false;
    latencyLog_.forget("drag to preview");
    feed(sampleAt(event->position(), event->modifiers(), PointerSample::Phase::Release));
    refresh();
  }
  held_ = toolDown_ ? Held::Tool : Held::Nothing;  // the stroke goes on after the view was turned
  if (event->button() != Qt::RightButton || !std::exchange(clicked_, std::nullopt)) return;
  const PointerSample sample = sampleAt(event->position(), event->modifiers(), PointerSample::Phase::Hover);
  if (const auto bar = session_.menu(); bar && meets(*bar, sample.ray)) return;
  emit menuAsked(sample, event->globalPosition().toPoint());
}

// The mouse asks when its button comes up; here only the keyboard does.
void SpaceView::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() != QContextMenuEvent::Keyboard) return;
  PointerSample sample = sampleAt(rect().center(), {}, PointerSample::Phase::Hover);
  if (const auto tip = session_.fingertip()) sample = *tip;
  const auto at = onScreen(sample.ray.origin + sample.ray.direction * camera_.distance());
  emit menuAsked(sample, mapToGlobal(at.value_or(rect().center()).toPoint()));
}

void SpaceView::wheelEvent(QWheelEvent* event) {
  if (force_ && force_->wheeled(event->angleDelta().y() / 120.0)) return refresh();
  framedAs_.reset();
  if (!event->pixelDelta().isNull() && event->modifiers().testFlag(Qt::ShiftModifier)) {  // two fingers on a trackpad
    camera_ = panned(camera_, event->pixelDelta().x(), event->pixelDelta().y(), height());
    return cameraMoved();
  }
  const double turns = event->angleDelta().y() / 120.0;
  camera_ = zoomed(camera_, std::pow(0.88, turns),
                   rayAt(camera_, event->position().x(), event->position().y(), width(), height()));
  cameraMoved();
}

void SpaceView::leaveEvent(QEvent*) {
  tapeShown_ = {};
  if (force_) force_->left();
  session_.leave();
  refresh();
}

}  // namespace karinui::studio
