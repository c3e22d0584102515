#include "table_painter.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "table_print.h"
#include "theme.h"

namespace karinui::studio {

QPointF TableOnScreen::at(Flat p) const {
  return {size.width() / 2.0 + (p.u - middle.u) * scale, size.height() / 2.0 - (p.v - middle.v) * scale};
}
Flat TableOnScreen::table(const QPointF& s) const {
  return {middle.u + (s.x() - size.width() / 2.0) / scale, middle.v - (s.y() - size.height() / 2.0) / scale};
}

namespace {

constexpr double kReadable = 8;  // pixels: lettering that is smaller is left out

QPolygonF polygon(const std::vector<Flat>& points, const TableOnScreen& screen) {
  QPolygonF line;
  for (const Flat p : points) line << screen.at(p);
  return line;
}

QPainterPath closedPath(const Ring& ring, const TableOnScreen& screen) {
  QPainterPath path;
  path.addPolygon(polygon(ring, screen));
  path.closeSubpath();
  return path;
}

struct Span {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

// How far a band (from -high to high) can be followed from the origin to either side before it meets a polygon's side;
// no way at all where the polygon is no higher than that there.
Span within(const QPolygonF& ring, double high) {
  Span span{-1e9, 1e9};
  for (const double y : {-high, 0.0, high})
    if (!ring.containsPoint(QPointF(0, y), Qt::OddEvenFill)) return {};
  for (const double y : {-high, 0.0, high})
    for (qsizetype i = 0; i < ring.size(); ++i) {
      const QPointF a = ring[i] - QPointF(0, y), b = ring[(i + 1) % ring.size()] - QPointF(0, y);
      if ((a.y() < 0) == (b.y() < 0)) continue;
      const double x = a.x() - a.y() * (b.x() - a.x()) / (b.y() - a.y());
      if (x < 0) span.from = std::max(span.from, x);
      if (x >= 0) span.to = std::min(span.to, x);
    }
  return span;
}

// The part of such a band that a stroke runs through; nothing where it stays clear.
std::optional<Span> through(const QLineF& stroke, double high) {
  double first = 0, last = 1;
  if (const double rise = stroke.dy(); std::fabs(rise) > 1e-9) {
    const double a = (-high - stroke.y1()) / rise, b = (high - stroke.y1()) / rise;
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  } else if (std::fabs(stroke.y1()) > high) {
    return std::nullopt;
  }
  if (first > last) return std::nullopt;
  const double x = stroke.x1() + first * stroke.dx(), y = stroke.x1() + last * stroke.dx();
  return Span{std::min(x, y), std::max(x, y)};
}

// Where a piece's name goes: near the place the frame has for it, level or upright as tailors write it along the grain,
// within the paper and beside the grain line. Where the whole of it has no such room it goes over the grain line, on a
// ground; else its beginning and end.
struct NamePlace {
  bool whole = false, turned = false, ground = false;
  double from = 0, room = 0;  // pixels, along the writing from the frame's place
};
NamePlace placeFor(const TablePiece& piece, QPointF middle, double wide, double up, const TableOnScreen& screen) {
  constexpr double kClear = 7, kBesideGrain = 6;  // pixels
  const double high = 0.5 * up;
  std::optional<NamePlace> over;
  NamePlace widest;
  for (const bool turned : {false, true}) {
    QTransform local;
    if (turned) local.rotate(90);
    local.translate(-middle.x(), -middle.y());
    Span paper = within(local.map(polygon(ringOf(piece.edges), screen)), high);
    paper.from += kClear, paper.to -= kClear;
    const auto fits = [&](const Span& span) -> std::optional<NamePlace> {
      if (span.length() < wide) return std::nullopt;
      return NamePlace{true, turned, false, std::clamp(-wide / 2, span.from, span.to - wide), wide};
    };
    std::optional<Span> grain;
    if (piece.grain)
      grain = through(local.map(QLineF(screen.at(piece.grain->from), screen.at(piece.grain->to))), high + 2);
    if (!grain) {
      if (const auto place = fits(paper)) return *place;
    } else {
      const auto before = fits({paper.from, std::min(paper.to, grain->from - kBesideGrain)}),
                 behind = fits({std::max(paper.from, grain->to + kBesideGrain), paper.to});
      const auto away = [&](const NamePlace& place) { return std::fabs(place.from + wide / 2); };
      if (before && (!behind || away(*before) <= away(*behind))) return *before;
      if (behind) return *behind;
      if (!over) over = fits(paper);
      if (over) over->ground = true;
    }
    if (paper.length() > widest.room) widest = {false, turned, grain.has_value(), paper.from, paper.length()};
  }
  if (over) return *over;
  return widest;
}

// Smaller where that makes room for the whole of it. Where not even its beginning and end have room it is left out, so
// that it lies over no neighbour, but for a piece that is chosen: over all else then, on a ground. A dot behind the
// name: the piece has yet to be settled.
void paintName(QPainter& painter, const TablePiece& piece, const TableLabel& label, const TableOnScreen& screen) {
  constexpr double kDot = 16, kLeast = 40;  // pixels
  painter.save();
  const double dot = piece.unsettled ? kDot : 0;
  const QPointF middle = screen.at(label.place);
  QString name = inWords(label.words);
  QFont font = painter.font();
  font.setWeight(QFont::DemiBold);
  NamePlace place;
  for (const double points : {10.5, 9.0, 8.0}) {
    font.setPointSizeF(points);
    const QFontMetricsF metrics(font);
    place = placeFor(piece, middle, metrics.horizontalAdvance(name) + dot, metrics.ascent(), screen);
    if (place.whole) break;
  }
  painter.setFont(font);
  const QFontMetricsF metrics(font);
  const double up = metrics.ascent();
  const bool noRoom = !place.whole && place.room < kLeast + dot;
  if (noRoom && piece.chosen) {
    const double all = metrics.horizontalAdvance(name) + dot;
    place = {true, false, true, -all / 2, all};
  } else if (noRoom) {
    if (piece.unsettled) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(Theme::here().palette().accent);
      painter.drawEllipse(middle, 3.5, 3.5);
    }
    painter.restore();
    return;
  }
  name = metrics.elidedText(name, Qt::ElideMiddle, place.room - dot + 1);
  const double wide = metrics.horizontalAdvance(name);
  painter.translate(middle);
  if (place.turned) painter.rotate(-90);
  const QPointF start(place.from, 0.35 * up);
  if (place.ground) {
    QColor ground = Theme::here().palette().paper;
    ground.setAlphaF(0.8f);
    painter.fillRect(QRectF(start.x() - 3, start.y() - 0.92 * up, wide + dot + 6, 1.08 * up), ground);
  }
  painter.drawText(start, name);
  if (piece.unsettled) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(Theme::here().palette().accent);
    painter.drawEllipse(start + QPointF(wide + 9, -4), 3.5, 3.5);
  }
  painter.restore();
}

void paintAsPrinted(QPainter& painter, const TableLabel& label, const TableOnScreen& screen) {
  const double size = label.size * screen.scale;
  if (size < kReadable) return;
  painter.save();
  QFont font = painter.font();
  font.setPixelSize(static_cast<int>(std::lround(size)));
  painter.setFont(font);
  painter.translate(screen.at(label.place));
  if (!label.upright) painter.rotate(-90);
  const QString words = inWords(label.words);
  const QFontMetricsF metrics(font);
  painter.drawText(QPointF(-metrics.horizontalAdvance(words) / 2, 0.35 * metrics.ascent()), words);
  painter.restore();
}

void paintGrain(QPainter& painter, const TableStroke& grain, const TableOnScreen& screen) {
  const QPointF a = screen.at(grain.from), b = screen.at(grain.to);
  painter.setPen(QPen(Theme::here().palette().faint, 1.2));
  painter.drawLine(a, b);
  const QPointF way = (b - a) / std::max(1.0, std::hypot(b.x() - a.x(), b.y() - a.y()));
  const QPointF side(-way.y(), way.x());
  painter.drawPolyline(QPolygonF({b - way * 8 + side * 4, b, b - way * 8 - side * 4}));
  painter.drawPolyline(QPolygonF({a + way * 8 + side * 4, a, a + way * 8 - side * 4}));
}

void paintPiece(QPainter& painter, const TablePiece& piece, const TableOnScreen& screen) {
  const Palette& p = Theme::here().palette();
  QPainterPath shape = closedPath(ringOf(piece.edges), screen);
  for (const auto& hole : piece.holes) shape = shape.subtracted(closedPath(ringOf(hole), screen));
  QColor fill = shown(piece.colour);
  fill.setAlphaF(Theme::here().dark() ? 0.42f : 0.24f);
  painter.setBrush(fill);
  painter.setPen(Qt::NoPen);
  painter.drawPath(shape);
  paintPrint(painter, piece, shape, screen);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(p.faint, 1));
  for (const Ring& cut : piece.cut) painter.drawPath(closedPath(cut, screen));
  if (piece.before) {
    painter.setPen(QPen(p.faint, 1, Qt::DashLine));
    painter.drawPath(closedPath(*piece.before, screen));
  }
  for (const TableSize& size : piece.nest) {
    painter.setPen(QPen(shown(size.colour), 1.2));
    painter.drawPath(closedPath(size.outline, screen));
  }
  painter.setPen(
      QPen(piece.chosen ? p.accent : p.ink, piece.chosen ? 2.2 : 1.4, piece.frozen ? Qt::DotLine : Qt::SolidLine));
  painter.drawPath(shape);
  painter.setPen(QPen(p.ink, 1, Qt::DashLine));
  for (const auto& line : piece.lines) painter.drawPolyline(polygon(line, screen));
  QPen thread(p.ink, 0.8);
  thread.setDashPattern({5, 2});
  painter.setPen(thread);
  for (const auto& row : piece.stitches) painter.drawPolyline(polygon(row, screen));
  QPen trim(p.ink, 1);
  trim.setDashPattern({6, 2, 1, 2});
  painter.setPen(trim);
  for (const TableTrim& one : piece.trims) painter.drawPolyline(polygon(one.line(kTrimPixels / screen.scale), screen));
  if (piece.grain) paintGrain(painter, *piece.grain, screen);
  for (const TableNotch& notch : piece.notches) {
    painter.setPen(QPen(p.ink, notch.own ? 1.6 : 1));
    painter.drawLine(screen.at(notch.stroke.from), screen.at(notch.stroke.to));
  }
  painter.setPen(QPen(p.ink, 1.6));
  const double drill = std::max(3.0, piece.drillRadius * screen.scale);
  for (const Flat hole : piece.drills) painter.drawEllipse(screen.at(hole), drill, drill);
  for (const TableLabel& label : piece.labels) {
    painter.setPen(piece.chosen && label.says == TableLabel::Says::Name ? p.accent : p.ink);
    if (label.says == TableLabel::Says::Name)
      paintName(painter, piece, label, screen);
    else if (label.says != TableLabel::Says::Cut)
      paintAsPrinted(painter, label, screen);
  }
  painter.setPen(QPen(p.ink, 1.2));
  painter.setBrush(p.raised);
  for (const Flat corner : piece.corners) painter.drawRect(QRectF(screen.at(corner) - QPointF(3, 3), QSizeF(6, 6)));
  painter.setBrush(Qt::NoBrush);
}

// Both sides in one colour, with ticks that say which end meets which.
void paintSeam(QPainter& painter, const TableSeam& seam, const TableOnScreen& screen) {
  constexpr double kInset = 3, kTick = 9;  // pixels
  painter.setPen(QPen(shown(seam.colour), seam.chosen ? 4 : 2.2));
  for (const TableSeam::Side& side : seam.sides) {
    for (const TableSeam::Run& run : side.runs) {
      QPolygonF line;
      for (std::size_t i = 0; i < run.points.size(); ++i)
        line << screen.at(run.points[i] + run.inward[i] * (kInset / screen.scale));
      painter.drawPolyline(line);
    }
    for (const TableSeam::Tick& tick : side.ticks)
      painter.drawLine(screen.at(tick.place), screen.at(tick.place + tick.inward * (kTick / screen.scale)));
  }
}

void paintScan(QPainter& painter, const TableScan& scan, const TableOnScreen& screen) {
  const auto corners = scan.corners();
  painter.save();
  painter.setOpacity(scan.strength);
  paintPicture(painter, scan.image, {screen.at(corners[3]), screen.at(corners[2]), screen.at(corners[0])});
  painter.restore();
}

}  // namespace

void paintTable(QPainter& painter, const TableFrame& frame, const TableOnScreen& screen) {
  for (const TableScan& scan : frame.scans) paintScan(painter, scan, screen);
  for (const TablePiece& piece : frame.pieces) paintPiece(painter, piece, screen);
  for (const TableSeam& seam : frame.seams) paintSeam(painter, seam, screen);
  for (const TablePiece& piece : frame.pieces)
    for (const Flat pin : piece.pins) paintPin(painter, screen.at(pin));
}

void paintChosenEdges(QPainter& painter, const TableFrame& frame, const TableOnScreen& screen) {
  painter.setPen(QPen(Theme::here().palette().accent, 3));
  const auto paint = [&](const std::vector<TableEdge>& edges) {
    for (const TableEdge& edge : edges)
      if (edge.chosen) painter.drawPolyline(polygon(edge.points, screen));
  };
  for (const TablePiece& piece : frame.pieces) {
    paint(piece.edges);
    for (const auto& hole : piece.holes) paint(hole);
  }
}

}  // namespace karinui::studio
