#include "pattern_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <array>
#include <cmath>

#include "karinui/base/number.h"
#include "keys.h"
#include "mouse.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// One hue a seam, told apart by most eyes (P. Tol's bright scheme).
constexpr std::array<QRgb, 7> kThreads{0x4477AA, 0xEE6677, 0x228833, 0xB08B12, 0x2A9DB5, 0xAA3377, 0x777777};

double niceStep(double pixelsPerMetre) {
  for (const double step : {0.001, 0.005, 0.01, 0.05, 0.1, 0.5, 1.0})
    if (step * pixelsPerMetre >= 14) return step;
  return 5;
}

constexpr double kBesideGrain = 10, kClear = 14;  // pixels from the grain line, and in all from grain line and outline

// A piece's name, where the whole of it has room: level beside the grain line in the middle of the paper, along that
// line as tailors write it, or level across it; else its beginning and end. A dot: the piece has yet to be settled.
void paintName(QPainter& painter, const QString& name, const QRectF& paper, bool dirty) {
  painter.save();
  QFont font = painter.font();
  font.setPointSizeF(10.5);
  font.setWeight(QFont::DemiBold);
  painter.setFont(font);
  const QFontMetricsF metrics(font);
  const double dot = dirty ? 16 : 0, needed = metrics.horizontalAdvance(name) + dot, up = metrics.ascent();
  const double beside = paper.width() / 2 - kClear, along = paper.height() - kClear, whole = paper.width() - kClear;
  const bool turned = needed > beside && needed <= along, across = needed > beside && !turned;
  const double room = turned ? along : across ? std::fmax(whole, 4 * kClear) : beside;
  const QString label = needed <= room ? name : metrics.elidedText(name, Qt::ElideMiddle, room - dot);
  const double wide = metrics.horizontalAdvance(label);
  painter.translate(paper.center());
  if (turned) painter.rotate(-90);
  const QPointF start = turned ? QPointF(-(wide + dot) / 2, kBesideGrain + 0.5 * up)
                               : QPointF(across ? -(wide + dot) / 2 : kBesideGrain, 0.35 * up);
  if (across) {
    QColor ground = Theme::here().palette().paper;
    ground.setAlphaF(0.8f);
    painter.fillRect(QRectF(start.x() - 3, start.y() - up, wide + dot + 6, 1.3 * up), ground);
  }
  painter.drawText(start, label);
  if (dirty) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(Theme::here().palette().accent);
    painter.drawEllipse(start + QPointF(wide + 9, -4), 3.5, 3.5);
  }
  painter.restore();
}

}  // namespace

PatternView::PatternView(Session& session, LatencyLog& latencyLog, QWidget* parent)
    : QWidget(parent), session_(session), latencyLog_(latencyLog) {
  preparePointing(*this, {220, 200});
  connect(&Theme::here(), &Theme::changed, this, [this] { update(); });
}

QPointF PatternView::onScreen(Flat p) const {
  return {width() / 2.0 + (p.u - middle_.u) * scale_, height() / 2.0 - (p.v - middle_.v) * scale_};
}
Flat PatternView::onTable(const QPointF& s) const {
  return {middle_.u + (s.x() - width() / 2.0) / scale_, middle_.v - (s.y() - height() / 2.0) / scale_};
}

void PatternView::showAll() {
  Flat low{1e9, 1e9}, high{-1e9, -1e9};
  for (const auto& worn : session_.snapshot().worn)
    for (const Flat p : worn.ring) {
      const Flat q = p + session_.table().at(worn.id);
      low = {std::fmin(low.u, q.u), std::fmin(low.v, q.v)};
      high = {std::fmax(high.u, q.u), std::fmax(high.v, q.v)};
    }
  if (low.u > high.u) low = {0, -0.7}, high = {0.9, 0};
  middle_ = lerp(low, high, 0.5);
  const Flat size = high - low;
  scale_ = std::clamp(std::min(width() * 0.88 / std::max(size.u, 0.05), height() * 0.86 / std::max(size.v, 0.05)), 20.0,
                      6000.0);
  mine_ = false;
  update();
}

void PatternView::refresh() {
  const std::size_t pieces = session_.snapshot().worn.size();
  if (pieces != piecesShown_ && !mine_) showAll();
  piecesShown_ = pieces;
  update();
}

void PatternView::resizeEvent(QResizeEvent*) {
  if (!mine_) showAll();
}

void PatternView::paintPiece(QPainter& painter, const Piece& piece, const Outline& outline, const Preview& preview) {
  const Palette& p = Theme::here().palette();
  const Flat lies = session_.table().at(piece.id);
  const bool chosen = session_.selection().pieces.contains(piece.id);
  const bool previewed = preview.outlines.contains(piece.id);
  const GarmentSnapshot& fitting = session_.snapshot();
  Colour dye{0.5f, 0.5f, 0.5f};
  for (std::size_t k = 0; k < fitting.worn.size(); ++k)
    if (fitting.worn[k].id == piece.id) dye = fitting.frame.cloths[k].colour;
  const auto path = [&](const Outline& o) {
    QPainterPath line;
    const Ring ring = o.flattened(2e-4);
    for (std::size_t i = 0; i < ring.size(); ++i)
      i == 0 ? line.moveTo(onScreen(ring[i] + lies)) : line.lineTo(onScreen(ring[i] + lies));
    line.closeSubpath();
    return line;
  };
  QPainterPath shape = path(outline);
  for (const Outline& hole : piece.holes) shape = shape.subtracted(path(hole));
  QColor fill = shown(dye);
  fill.setAlphaF(Theme::here().dark() ? 0.42f : 0.24f);
  painter.setBrush(fill);
  painter.setPen(Qt::NoPen);
  painter.drawPath(shape);
  if (previewed) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(p.faint, 1, Qt::DashLine));
    painter.drawPath(path(piece.outline));
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(chosen ? p.accent : p.ink, chosen ? 2.2 : 1.4, piece.frozen ? Qt::DotLine : Qt::SolidLine));
  painter.drawPath(shape);
  for (const InternalLine& line : piece.lines)
    for (const Curve& curve : line.curves) {
      QPolygonF points;
      for (const Flat q : curve.flattened(2e-4)) points << onScreen(q + lies);
      painter.setPen(QPen(p.ink, 1, Qt::DashLine));
      painter.drawPolyline(points);
    }
  // Grain, through the middle of the paper.
  Flat low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Flat q : outline.flattened(1e-3)) {
    low = {std::fmin(low.u, q.u), std::fmin(low.v, q.v)};
    high = {std::fmax(high.u, q.u), std::fmax(high.v, q.v)};
  }
  const Flat centre = lerp(low, high, 0.5) + lies;
  const double half = std::min({0.07, length(high - low) * 0.22});
  const QPointF a = onScreen(centre - piece.grain * half), b = onScreen(centre + piece.grain * half);
  painter.setPen(QPen(p.faint, 1.2));
  painter.drawLine(a, b);
  const QPointF way = (b - a) / std::max(1.0, std::hypot(b.x() - a.x(), b.y() - a.y()));
  const QPointF side(-way.y(), way.x());
  painter.drawPolyline(QPolygonF({b - way * 8 + side * 4, b, b - way * 8 - side * 4}));
  painter.drawPolyline(QPolygonF({a + way * 8 + side * 4, a, a + way * 8 - side * 4}));
  for (const Mark& mark : piece.marks) {
    if (mark.edge.empty()) {
      painter.drawEllipse(onScreen(mark.place + lies), 3, 3);
      continue;
    }
    const auto n = outline.find(mark.edge);
    if (!n) continue;
    const Curve& curve = outline.edges[*n].curve;
    const double t = curve.parameterAt(mark.fraction * curve.length());
    const Flat in = leftOf(normalized(curve.tangent(t)));
    painter.setPen(QPen(p.ink, 1.6));
    painter.drawLine(onScreen(curve.at(t) + lies), onScreen(curve.at(t) + in * 0.006 + lies));
  }
  painter.setPen(chosen ? p.accent : p.ink);
  paintName(painter, nameText(piece.name), QRectF(onScreen(low + lies), onScreen(high + lies)).normalized(),
            fitting.document.drape.dirty.contains(piece.id));
  if (session_.tool() == Command::Points) {
    painter.setPen(QPen(p.ink, 1.2));
    painter.setBrush(p.raised);
    for (const Edge& edge : outline.edges) {
      const QPointF c = onScreen(edge.curve.start + lies);
      painter.drawRect(QRectF(c - QPointF(3, 3), QSizeF(6, 6)));
    }
    painter.setBrush(Qt::NoBrush);
  }
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
  const Document& document = session_.snapshot().document;
  for (const auto& [id, piece] : document.pattern.pieces) {
    const auto other = preview.outlines.find(id);
    paintPiece(painter, *piece, other == preview.outlines.end() ? piece->outline : other->second, preview);
  }
  // Seams: both sides in one colour, with ticks that say which end meets which.
  std::size_t n = 0;
  for (const auto& [id, seam] : document.pattern.seams) {
    QColor thread(kThreads[n++ % kThreads.size()]);
    const bool chosen = session_.selection().seam == id;
    for (const auto* side : {&seam.a, &seam.b}) {
      const bool turned = side == &seam.b && seam.reversed;
      double whole = 0, done = 0;
      for (const EdgeSpan& s : *side)
        if (const Piece* piece = document.find(s.piece))
          if (const Edge* edge = findEdge(*piece, s.edge)) whole += edge->curve.length() * (s.to - s.from);
      for (const EdgeSpan& s : *side) {
        const Piece* piece = document.find(s.piece);
        const Edge* edge = piece ? findEdge(*piece, s.edge) : nullptr;
        if (!edge) continue;
        const Flat lies = session_.table().at(piece->id);
        QPolygonF line;
        const double part = edge->curve.length() * (s.to - s.from);
        for (int i = 0; i <= 30; ++i) {
          const double f = s.from + (s.to - s.from) * i / 30;
          const double t = edge->curve.parameterAt(f * edge->curve.length());
          line << onScreen(edge->curve.at(t) + leftOf(normalized(edge->curve.tangent(t))) * (3 / scale_) + lies);
        }
        painter.setPen(QPen(thread, chosen ? 4 : 2.2));
        painter.drawPolyline(line);
        for (const double tick : {0.25, 0.3}) {  // two ticks near the beginning
          const double along = (turned ? 1 - tick : tick) * whole - done;
          if (along < 0 || along > part) continue;
          const double t = edge->curve.parameterAt(s.from * edge->curve.length() + along);
          const Flat in = leftOf(normalized(edge->curve.tangent(t)));
          painter.drawLine(onScreen(edge->curve.at(t) + lies), onScreen(edge->curve.at(t) + in * (9 / scale_) + lies));
        }
        done += part;
      }
    }
  }
  for (const auto& [id, pins] : document.pins)
    for (const Flat pin : pins) paintPin(painter, onScreen(pin + session_.table().at(id)));
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
  if (session_.selection().edge) {
    const EdgeNear& e = *session_.selection().edge;
    const Piece* piece = document.find(e.piece);
    if (const Edge* edge = piece ? findEdge(*piece, e.edge) : nullptr) {
      QPolygonF line;
      const Flat lies = session_.table().at(piece->id);
      for (const Flat q : edge->curve.flattened(2e-4)) line << onScreen(q + lies);
      painter.setPen(QPen(p.accent, 3));
      painter.drawPolyline(line);
    }
  }
  // A ruler in the corner: how large things are.
  const double ruler = step * 5;
  const QPointF left(18, height() - 18.0), right(18 + ruler * scale_, height() - 18.0);
  painter.setPen(QPen(p.faint, 1.4));
  painter.drawLine(left, right);
  painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
  painter.drawLine(right - QPointF(0, 4), right + QPointF(0, 4));
  painter.drawText(left + QPointF(2, -6), lengthText(ruler));
  if (document.pattern.pieces.empty()) {
    painter.setPen(p.faint);
    painter.drawText(rect().adjusted(30, 30, -30, -30), Qt::AlignCenter | Qt::TextWordWrap,
                     inWords(say("Pieces you draw on the body appear here as flat paper pattern.")));
  }
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
