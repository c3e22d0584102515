#pragma once
// A mouse as the session's pointer says it, alike over the fitting and over the pattern; where it points is for the
// view to add. GUI thread.
#include <QMouseEvent>
#include <QWidget>

#include "karinui/scene/pointer.h"
#include "latency_log.h"

namespace karinui::studio {

enum class Held { Nothing, Tool, Turn, Pan };

inline void preparePointing(QWidget& view, QSize least) {
  view.setMouseTracking(true);
  view.setFocusPolicy(Qt::StrongFocus);
  view.setMinimumSize(least);
}

inline PointerSample mouseSample(PointerSample::Phase phase, PointerSample::Where where, Qt::KeyboardModifiers keys,
                                 const LatencyLog& latencyLog) {
  PointerSample sample;
  sample.phase = phase;
  sample.where = where;
  sample.seconds = latencyLog.now() / 1000;
  sample.shift = keys.testFlag(Qt::ShiftModifier);
  sample.control = keys.testFlag(Qt::ControlModifier);
  sample.alt = keys.testFlag(Qt::AltModifier);
  return sample;
}

}  // namespace karinui::studio
