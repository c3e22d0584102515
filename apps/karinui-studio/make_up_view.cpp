#include "make_up_view.h"

#include <QPainter>

#include "karinui/session/table_frame_of.h"
#include "table_painter.h"
#include "theme.h"

namespace karinui::studio {

MakeUpView::MakeUpView(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAccessibleName(inWords(say("How it is made up")));
}

void MakeUpView::show(SnapshotPtr garment, QImage onFigure) {
  garment_ = std::move(garment);
  onFigure_ = std::move(onFigure);
  setAccessibleDescription(inWords(emptySaid()));
  if (garment_) layout_.arrange(*garment_);
  update();
}

void MakeUpView::setFlat(bool flat) {
  flat_ = flat;
  update();
}

void MakeUpView::choose(std::vector<EdgeRef> edges) {
  chosen_ = std::move(edges);
  update();
}

Message MakeUpView::emptySaid() const {
  if (!garment_ || garment_->body || flat_) return {};
  return say("There is no figure yet. Choose a size on the board Body; then the pieces are shown on it.");
}

void MakeUpView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  if (!garment_) return;
  if (!flat_) {
    if (const Message words = emptySaid(); !words.empty()) {
      painter.setPen(Theme::here().palette().faint);
      painter.drawText(rect().adjusted(30, 30, -30, -30), Qt::AlignCenter | Qt::TextWordWrap, inWords(words));
    }
    if (onFigure_.isNull()) return;
    const QSize fits = onFigure_.size().scaled(size(), Qt::KeepAspectRatio);
    painter.drawImage(QRect(QPoint((width() - fits.width()) / 2, (height() - fits.height()) / 2), fits), onFigure_);
    return;
  }
  TableFrame frame = tableFrameOf(*garment_, layout_, {}, {.language = Theme::here().language()});
  std::size_t k = 0;
  for (const auto& [id, piece] : garment_->document.pattern.pieces) {
    for (TableEdge& edge : frame.pieces[k].edges)
      for (const EdgeRef& one : chosen_)
        if (one.piece.id == id && one.edge == edge.name) edge.chosen = true;
    ++k;
  }
  const FlatBox box = extent(frame);
  if (box.empty()) return;
  TableOnScreen screen;
  screen.middle = (box.low + box.high) * 0.5;
  screen.size = size();
  constexpr double kMargin = 24;  // pixels
  screen.scale = std::min((width() - 2 * kMargin) / box.size().u, (height() - 2 * kMargin) / box.size().v);
  paintTable(painter, frame, screen);
  paintChosenEdges(painter, frame, screen);
}

}  // namespace karinui::studio
