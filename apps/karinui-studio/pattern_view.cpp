#include "pattern_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QPainter>
#include <QToolButton>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "keys.h"
#include "mouse.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr int kButtonAt = 8;                     // pixels from the upper left corner
constexpr double kRulerUp = 18, kRulerPad = 18;  // pixels: from the foot to the ruler; round its words

double niceStep(double pixelsPerMetre) {
  for (const double step : {0.001, 0.005, 0.01, 0.05, 0.1, 0.5, 1.0})
    if (step * pixelsPerMetre >= 14) return step;
  return 5;
}

}  // namespace

PatternView::PatternView(Session& session, LatencyLog& latencyLog, QWidget* parent)
    : QWidget(parent), session_(session), latencyLog_(latencyLog) {
  preparePointing(*this, {220, 200});
  scans_ = new QToolButton(this);
  scans_->setObjectName("show_scans");
  scans_->setCheckable(true);
  scans_->setFocusPolicy(Qt::NoFocus);  // Work, Scans to trace is for the keys
  scans_->move(kButtonAt, kButtonAt);
  scans_->hide();
  Theme::here().keep(scans_, [this] {
    scans_->setText(inWords(say("Scan")));
    scans_->setToolTip(inWords(say("Shows or hides the scans that lie under the pattern.")));
    scans_->adjustSize();
  });
  connect(scans_, &QToolButton::clicked, this, &PatternView::showScans);
  connect(&Theme::here(), &Theme::changed, this, [this] { update(); });
}

TableOnScreen PatternView::screen() const { return {middle_, scale_, size()}; }
QPointF PatternView::onScreen(Flat table) const { return screen().at(table); }
Flat PatternView::onTable(const QPointF& at) const { return screen().table(at); }

FlatBox PatternView::all() const {
  FlatBox box;
  for (const auto& worn : session_.snapshot().worn)
    for (const Flat p : worn.ring) box.include(p + session_.table().at(worn.id));
  for (const auto& [name, underlay] : session_.snapshot().document.underlays)
    if (!underlay.hidden)
      for (const Flat corner : {Flat{0, 0}, Flat{1.0 * underlay.wide, 0}, Flat{0, 1.0 * underlay.high},
                                Flat{1.0 * underlay.wide, 1.0 * underlay.high}})
        box.include(underlay.onTable(corner));
  return box;
}

// Above the ruler, which would lie on a piece's edge.
void PatternView::showAll() {
  FlatBox box = all();
  if (box.empty()) box = {{0, -0.7}, {0.9, 0}};
  const Flat size = box.size();
  const double foot = std::min(QFontMetricsF(font()).ascent() + kRulerUp + kRulerPad, height() * 0.2),
               high = height() - foot;
  scale_ =
      std::clamp(std::min(width() * 0.88 / std::max(size.u, 0.05), high * 0.9 / std::max(size.v, 0.05)), 20.0, 6000.0);
  middle_ = lerp(box.low, box.high, 0.5) - Flat{0, foot / 2 / scale_};
  mine_ = false;
  update();
}

void PatternView::showScans(bool shown) {
  for (const auto& [name, lies] : Underlays(session_.snapshot().document.underlays)) {
    if (lies.hidden != shown) continue;
    LayUnderlay op;
    op.name = name, op.hidden = !shown;
    session_.perform(std::move(op));
  }
}

// Where pieces were laid anew, and out of sight, all are shown again.
void PatternView::refresh() {
  const GarmentSnapshot& fitting = session_.snapshot();
  const Underlays& scans = fitting.document.underlays;
  scans_->setVisible(!scans.empty());
  scans_->setEnabled(!session_.readOnly());
  scans_->setChecked(std::any_of(scans.begin(), scans.end(), [](const auto& one) { return !one.second.hidden; }));
  const std::size_t pieces = fitting.worn.size() + fitting.document.underlays.size();
  std::map<PieceId, Flat> lie;
  for (const auto& worn : fitting.worn) lie[worn.id] = session_.table().at(worn.id);
  if (!mine_ && pieces != piecesShown_) {
    showAll();
  } else if (!mine_ && (lie != lieShown_ || scans != scansShown_) && !session_.begun()) {
    const FlatBox box = all();
    const QRectF seen(rect());
    if (!box.empty() && !(seen.contains(onScreen(box.low)) && seen.contains(onScreen(box.high)))) showAll();
  }
  lieShown_ = std::move(lie);
  scansShown_ = scans;
  piecesShown_ = pieces;
  update();
}

void PatternView::resizeEvent(QResizeEvent*) {
  if (!mine_) showAll();
}

void PatternView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& p = Theme::here().palette();
  painter.fillRect(rect(), p.paper);
  const double step = niceStep(scale_);
  const Flat low = onTable({0, static_cast<double>(height())}), high = onTable({static_cast<double>(width()), 0});
  for (int pass = 0; pass < 2; ++pass) {
    const double s = pass == 0 ? step : step * 5;
    QColor line = p.paperLine;
    if (pass == 0) line.setAlphaF(0.55f);
    painter.setPen(QPen(line, 1));
    for (double u = std::ceil(low.u / s) * s; u < high.u; u += s) {
      const double x = std::floor(onScreen({u, 0}).x()) + 0.5;
      painter.drawLine(QPointF(x, 0), QPointF(x, height()));
    }
    for (double v = std::ceil(low.v / s) * s; v < high.v; v += s) {
      const double y = std::floor(onScreen({0, v}).y()) + 0.5;
      painter.drawLine(QPointF(0, y), QPointF(width(), y));
    }
  }
  const Preview preview = session_.preview();
  const TableFrame frame = tableFrameOf(
      session_.snapshot(), session_.table(), session_.selection(),
      {Theme::here().language(), session_.tool() == Command::Points, nest_, true, preview.outlines, preview.underlays},
      &rooms_);
  paintTable(painter, frame, screen());
  for (const TableLine& line : preview.table.lines) {
    QPolygonF points;
    for (const Flat q : line.points) points << onScreen(q);
    painter.setPen(QPen(shown(line.colour), 3, line.dashed ? Qt::DashLine : Qt::SolidLine, Qt::RoundCap));
    painter.drawPolyline(points);
  }
  painter.setPen(QPen(Qt::white, 1.5));
  painter.setBrush(p.accent);
  for (const Flat dot : preview.table.dots) painter.drawEllipse(onScreen(dot), 5, 5);
  for (const Flat ring : preview.table.rings) paintRing(painter, onScreen(ring), p.accent);
  if (const auto tip = session_.fingertip(); tip && tip->where == PointerSample::Where::Table)
    paintFingertip(painter, onScreen(tip->place));
  for (const TableWord& word : preview.table.words) {
    // Above what is being drawn there, never over it.
    QPointF place = onScreen(word.place);
    constexpr double kNear = 90;  // pixels to either side
    double top = place.y();
    for (const TableLine& line : preview.table.lines)
      for (const Flat q : line.points)
        if (const QPointF at = onScreen(q); std::fabs(at.x() - place.x()) < kNear && place.y() - at.y() < 2 * kNear)
          top = std::min(top, at.y());
    place.setY(top);
    paintWord(painter, place, QString::fromStdString(word.text), rect());
  }
  paintChosenEdges(painter, frame, screen());
  // A ruler in the corner: how large things are. On a ground, for a piece may lie there.
  double ruler = step * 5;
  for (const double steps : {2.0, 1.0})  // both its ends are to be seen
    if (ruler * scale_ > width() - 2 * kRulerPad) ruler = step * steps;
  const QPointF left(18, height() - kRulerUp), right(18 + ruler * scale_, height() - kRulerUp);
  const QString rulerSaid = lengthText(ruler);
  const QFontMetricsF metrics(painter.font());
  const double wide = std::max(right.x() - left.x(), 2 + metrics.horizontalAdvance(rulerSaid));
  QColor ground = p.paper;
  ground.setAlphaF(0.88f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ground);
  painter.drawRoundedRect(QRectF(left - QPointF(7, metrics.ascent() + 9), left + QPointF(wide + 7, 9)), 5, 5);
  painter.setPen(QPen(p.faint, 1.4));
  painter.drawLine(left, right);
  painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
  painter.drawLine(right - QPointF(0, 4), right + QPointF(0, 4));
  painter.drawText(left + QPointF(2, -6), rulerSaid);
  if (frame.pieces.empty() && frame.scans.empty()) {
    painter.setPen(p.faint);
    painter.drawText(rect().adjusted(30, 30, -30, -30), Qt::AlignCenter | Qt::TextWordWrap, inWords(emptySaid()));
  }
}

Message PatternView::emptySaid() const {
  return session_.busy().loading ? say("The garment is being opened …")
                                 : say("Pieces you draw on the body appear here as flat paper pattern.");
}

PointerSample PatternView::sampleAt(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) const {
  PointerSample sample = mouseSample(phase, PointerSample::Where::Table, keys, latencyLog_);
  sample.place = onTable(at);
  sample.reach = 9 / scale_;
  return sample;
}

bool PatternView::event(QEvent* event) {
  if (isForFingertip(event, session_)) event->accept();
  return QWidget::event(event);
}

void PatternView::keyPressEvent(QKeyEvent* event) {
  const auto stroke = strokeOf(*event);
  if (!stroke) return QWidget::keyPressEvent(event);
  session_.strike(*stroke, sampleAt({}, event->modifiers(), PointerSample::Phase::Hover));
  if (const auto tip = session_.fingertip()) {
    const QPointF at = onScreen(tip->place);
    if (!QRectF(rect()).adjusted(20, 20, -20, -20).contains(at)) middle_ = tip->place, mine_ = true;
    emit pointed(tip->place);
  }
  update();
}

void PatternView::feed(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) {
  const PointerSample sample = sampleAt(at, keys, phase);
  session_.feed(sample);
  emit pointed(sample.place);
  update();
}

void PatternView::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
  clicked_ = event->button() == Qt::RightButton ? std::optional(last_) : std::nullopt;
  setFocus();
  if (event->button() == Qt::LeftButton) {
    held_ = Held::Tool;
    feed(last_, event->modifiers(), PointerSample::Phase::Press);
  } else {
    held_ = Held::Pan;
  }
}

void PatternView::mouseMoveEvent(QMouseEvent* event) {
  if (clicked_) {
    if ((event->position() - *clicked_).manhattanLength() < QApplication::startDragDistance()) return;
    clicked_.reset();
  }
  const QPointF step = event->position() - last_;
  last_ = event->position();
  if (held_ == Held::Pan) {
    middle_ += Flat{-step.x() / scale_, step.y() / scale_};
    mine_ = true;
    return update();
  }
  feed(last_, event->modifiers(), held_ == Held::Tool ? PointerSample::Phase::Drag : PointerSample::Phase::Hover);
}

void PatternView::mouseReleaseEvent(QMouseEvent* event) {
  if (held_ == Held::Tool && event->button() == Qt::LeftButton)
    feed(event->position(), event->modifiers(), PointerSample::Phase::Release);
  held_ = Held::Nothing;
  if (event->button() == Qt::RightButton && std::exchange(clicked_, std::nullopt))
    emit menuAsked(sampleAt(event->position(), event->modifiers(), PointerSample::Phase::Hover),
                   event->globalPosition().toPoint());
}

// The mouse asks when its button comes up; here only the keyboard does.
void PatternView::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() != QContextMenuEvent::Keyboard) return;
  PointerSample sample = sampleAt(rect().center(), {}, PointerSample::Phase::Hover);
  if (const auto tip = session_.fingertip()) sample = *tip;
  emit menuAsked(sample, mapToGlobal(onScreen(sample.place).toPoint()));
}

void PatternView::leaveEvent(QEvent*) {
  session_.leave();
  emit left();
  update();
}

void PatternView::wheelEvent(QWheelEvent* event) {
  const Flat fixed = onTable(event->position());
  scale_ = std::clamp(scale_ * std::pow(1.14, event->angleDelta().y() / 120.0), 20.0, 20000.0);
  const Flat now = onTable(event->position());
  middle_ += fixed - now;
  mine_ = true;
  update();
}

}  // namespace karinui::studio
