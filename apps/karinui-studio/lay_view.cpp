#include "lay_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <cmath>

#include "accessibility.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kRim = 34;       // pixels round the cloth, for the ruler and the words
constexpr double kBeyond = 1.08;  // of the cloth's length is seen: room to carry a piece behind the last one
constexpr double kStep = 0.01;    // metres of an arrow key; a tenth of it with Shift
constexpr double kFewPixels = 4;  // stripes that lie closer are not drawn
const QColor kWrong("#b3261e");

QPolygonF polygon(const LayView& view, const Ring& ring) {
  QPolygonF line;
  for (const Flat p : ring) line << view.onScreen(p);
  return line;
}

// The middle of the widest stretch along the cloth, of a few lines; `wide`: how wide it is.
Flat roomiest(const Ring& ring, double& wide) {
  double low = 1e9, high = -1e9;
  for (const Flat p : ring) low = std::min(low, p.v), high = std::max(high, p.v);
  Flat best = ring.front();
  wide = 0;
  for (const double share : {0.5, 0.4, 0.6, 0.25, 0.75}) {
    const double v = low + (high - low) * share;
    std::vector<double> met;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Flat p = ring[i], q = ring[(i + 1) % ring.size()];
      if ((p.v > v) != (q.v > v)) met.push_back(p.u + (q.u - p.u) * (v - p.v) / (q.v - p.v));
    }
    std::sort(met.begin(), met.end());
    for (std::size_t i = 0; i + 1 < met.size(); i += 2)
      if (met[i + 1] - met[i] > wide * 1.05) wide = met[i + 1] - met[i], best = {(met[i] + met[i + 1]) / 2, v};
  }
  return best;
}

}  // namespace

LayView::LayView(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(320, 220);
  Theme::here().keep(this, [this] {
    setAccessibleName(inWords(say("Cloth with its pieces")));
    update();
  });
}

FabricLay* LayView::lay() const {
  return plan_ && fabric_ < plan_->fabrics.size() ? &plan_->fabrics[fabric_] : nullptr;
}

void LayView::setLay(LayPlan* plan, std::size_t fabric) {
  plan_ = plan, fabric_ = fabric;
  held_.reset(), clash_.reset(), chosen_.reset();
  moves_.clear();
  zoom_ = 1, pan_ = {};
  update();
}

// All of the cloth, of the length it had when the piece was taken: it does not move under a hand.
void LayView::frame(double& scale, QPointF& origin) const {
  const FabricLay& cloth = held_ ? held_->before : *lay();
  const double long_ = std::max(cloth.length, 0.05) * kBeyond;
  scale = std::min((width() - 2 * kRim) / long_, (height() - 2 * kRim) / cloth.width) * zoom_;
  origin = zoom_ == 1 ? QPointF(kRim, height() / 2.0 + cloth.width * scale / 2) + pan_ : pan_;
}

QPointF LayView::onScreen(Flat cloth) const {
  double scale = 1;
  QPointF origin;
  if (lay()) frame(scale, origin);
  return origin + QPointF(cloth.u, -cloth.v) * scale;
}
Flat LayView::onCloth(QPointF screen) const {
  double scale = 1;
  QPointF origin;
  if (lay()) frame(scale, origin);
  const QPointF p = (screen - origin) / scale;
  return {p.x(), -p.y()};
}

void LayView::zoom(double by, QPointF about) {
  if (!lay()) return;
  const Flat there = onCloth(about);
  zoom_ = std::clamp(zoom_ * by, 1.0, 40.0);
  pan_ = {};
  if (zoom_ > 1) pan_ = about - onScreen(there);
  update();
}

std::optional<std::size_t> LayView::pieceAt(QPointF screen) const {
  if (!lay()) return std::nullopt;
  const Flat there = onCloth(screen);
  for (std::size_t i = lay()->cut.size(); i-- > 0;)
    if (contains(lay()->cut[i], there)) return i;
  return std::nullopt;
}

std::string LayView::nameOf(const LaidPiece& piece) const {
  std::string name = nameText(plan_->document.find(piece.piece)->name).toStdString();
  if (piece.under) name += " + " + nameText(plan_->document.find(piece.under)->name).toStdString();
  return name;
}

Message LayView::about(std::size_t nth) const {
  const LaidPiece& piece = lay()->pieces[nth];
  const Flat low = boxOf(lay()->cut[nth]).low;
  const std::string along = lengthText(low.u).toStdString(), across = lengthText(low.v).toStdString();
  return piece.onFold ? say("“{0}”, on the fold, {1} along the cloth", nameOf(piece), along)
                      : say("“{0}”, {1} along the cloth and {2} across", nameOf(piece), along, across);
}

void LayView::choose(std::optional<std::size_t> piece) {
  chosen_ = piece;
  if (piece) emit said(about(*piece));
  update();
}

void LayView::take(std::optional<Flat> grip) { held_ = Held{*lay(), {}, false, grip}; }

void LayView::carry() {
  FabricLay& now = *lay();
  now = held_->before;
  moveLaid(now, *chosen_, held_->by, plan_->settings);
  if (held_->turned) (void)turnLaid(now, *chosen_, plan_->settings);  // turn() asked already
  clash_ = clash(now, *chosen_);
  measureLay(now, plan_->settings.folded);
  emit changed();
  update();
}

void LayView::letGo() {
  if (!held_) return;
  if (!clash_) {
    if (lay()->cut != held_->before.cut) moves_.push_back(std::move(held_->before));
    held_.reset();
    emit said(about(*chosen_));
    return update();
  }
  const std::string name = nameOf(lay()->pieces[*chosen_]);
  const Message why = clash_->second ? say("“{0}” would lie over “{1}”; it is back where it was.", name,
                                           nameOf(lay()->pieces[*clash_->second]))
                                     : say("“{0}” would not lie on the cloth; it is back where it was.", name);
  putBack();
  emit said(why);
}

void LayView::putBack() {
  if (!held_) return;
  *lay() = held_->before;
  held_.reset(), clash_.reset();
  emit changed();
  update();
}

void LayView::undo() {
  if (held_) return putBack();
  if (moves_.empty()) return emit said(say("There is no move to take back."));
  *lay() = std::move(moves_.back());
  moves_.pop_back();
  emit changed();
  emit said(say("The last move is taken back."));
  update();
}

void LayView::turn() {
  if (!lay() || !chosen_) return;
  FabricLay asked = *lay();
  if (const Done can = turnLaid(asked, *chosen_, plan_->settings); !can) return emit said(can.error().what);
  const bool alone = !held_;
  if (alone) take({});
  held_->turned = !held_->turned;
  carry();
  if (alone) letGo();
}

void LayView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) {
    if (!held_) panning_ = event->position();
    return;
  }
  if (held_) return letGo();  // held by the keys
  choose(pieceAt(event->position()));
  if (chosen_) take(onCloth(event->position()));
}

void LayView::mouseMoveEvent(QMouseEvent* event) {
  if (panning_) {
    if (zoom_ > 1) pan_ += event->position() - *panning_;
    panning_ = event->position();
    return update();
  }
  if (held_ && held_->grip) {
    held_->by = onCloth(event->position()) - *held_->grip;
    carry();
  } else {
    setCursor(pieceAt(event->position()) ? Qt::OpenHandCursor : Qt::ArrowCursor);
  }
}

void LayView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return panning_.reset();
  if (held_ && held_->grip) letGo();
}

void LayView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  choose(pieceAt(event->position()));
  turn();
}

void LayView::wheelEvent(QWheelEvent* event) {
  zoom(std::pow(1.0015, event->angleDelta().y()), event->position());
  event->accept();
}

void LayView::keyPressEvent(QKeyEvent* event) {
  const double step = event->modifiers() & Qt::ShiftModifier ? kStep / 10 : kStep;
  // Over stripes an arrow goes on by a whole repeat at least.
  const auto go = [&](double u, double v) {
    if (!chosen_ || !lay()) return;
    if (!held_) take({});
    const LaySettings& own = plan_->settings;
    held_->by += Flat{u * std::max(step, own.rows), v * std::max(step, own.stripes)};
    carry();
    if (clash_)
      emit said(say("“{0}” does not fit here", nameOf(lay()->pieces[*chosen_])));
    else
      emit said(about(*chosen_));
  };
  if (event->matches(QKeySequence::Undo)) return undo();
  switch (event->key()) {
    case Qt::Key_Left:
      return go(-1, 0);
    case Qt::Key_Right:
      return go(1, 0);
    case Qt::Key_Up:
      return go(0, 1);
    case Qt::Key_Down:
      return go(0, -1);
    case Qt::Key_T:
      return turn();
    case Qt::Key_Plus:
      return zoom(1.25, rect().center());
    case Qt::Key_Minus:
      return zoom(0.8, rect().center());
    case Qt::Key_0:
      return zoom(1e-9, rect().center());
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (held_) return letGo();
      if (lay() && chosen_) take({});
      return;  // never the dialog's button
    case Qt::Key_Escape:
      if (held_) return putBack();
      break;
    default:
      break;
  }
  QWidget::keyPressEvent(event);
}

// From piece to piece, and out of the view behind the last.
bool LayView::focusNextPrevChild(bool next) {
  if (!lay() || !hasFocus()) return QWidget::focusNextPrevChild(next);
  letGo();
  const std::size_t count = lay()->pieces.size();
  if (next ? (chosen_ ? *chosen_ + 1 < count : count > 0) : (chosen_ && *chosen_ > 0)) {
    choose(next ? (chosen_ ? *chosen_ + 1 : 0) : *chosen_ - 1);
    return true;
  }
  choose({});
  return QWidget::focusNextPrevChild(next);
}

void LayView::focusOutEvent(QFocusEvent* event) {
  letGo();
  QWidget::focusOutEvent(event);
}

void LayView::paintCloth(QPainter& painter) const {
  const FabricLay& cloth = *lay();
  const Palette& colours = Theme::here().palette();
  const QRectF used(onScreen({0, cloth.width}), onScreen({cloth.length, 0}));
  // The bolt goes on.
  painter.fillRect(QRectF(used.topLeft(), QPointF(width(), used.bottom())), colours.panel);
  painter.fillRect(used, colours.paper);
  const LaySettings& settings = plan_->settings;
  const double scale = used.height() / cloth.width;
  painter.setPen(QPen(colours.paperLine, 1));
  if (settings.stripes * scale >= kFewPixels)
    for (double v = settings.stripes; v < cloth.width; v += settings.stripes)
      painter.drawLine(onScreen({0, v}), QPointF(width(), onScreen({0, v}).y()));
  if (settings.rows * scale >= kFewPixels)
    for (double u = settings.rows; onScreen({u, 0}).x() < width(); u += settings.rows)
      painter.drawLine(onScreen({u, 0}), onScreen({u, cloth.width}));
  painter.setPen(QPen(colours.faint, 1));
  painter.drawLine(used.topLeft(), QPointF(width(), used.top()));
  painter.drawLine(used.topLeft(), used.bottomLeft());
  painter.setPen(QPen(colours.faint, settings.folded ? 3 : 1));
  painter.drawLine(used.bottomLeft(), QPointF(width(), used.bottom()));
  painter.setPen(QPen(colours.accent, 1.4, Qt::DashLine));
  painter.drawLine(used.topRight(), used.bottomRight());
  // Every 10 cm, or 4 inches; each fifth with its number.
  const double tick = Theme::here().inches() ? 4 * 0.0254 : 0.1;
  painter.setPen(colours.faint);
  for (int k = 0; k * tick <= cloth.length + 1e-9; ++k) {
    const QPointF at = onScreen({k * tick, 0});
    const bool numbered = k % 5 == 0;
    painter.drawLine(at + QPointF(0, 3), at + QPointF(0, numbered ? 9 : 6));
    if (numbered)
      painter.drawText(QRectF(at.x() - 40, at.y() + 10, 80, 18), Qt::AlignHCenter | Qt::AlignTop,
                       lengthText(k * tick, 0));
  }
  if (!settings.folded) return;
  painter.save();
  painter.translate(used.left() - 8, used.bottom());
  painter.rotate(-90);
  painter.drawText(QPointF(0, 0), inWords(say("fold")));
  painter.restore();
}

void LayView::paintPiece(QPainter& painter, std::size_t nth) const {
  const FabricLay& cloth = *lay();
  const LaidPiece& laid = cloth.pieces[nth];
  const Palette& colours = Theme::here().palette();
  const bool wrong = held_ && clash_ && (nth == *chosen_ || clash_->second == nth);
  const bool chosen = chosen_ == nth;
  QPainterPath cut;
  cut.addPolygon(polygon(*this, cloth.cut[nth]));
  cut.closeSubpath();
  QColor fill = wrong ? kWrong : chosen ? colours.accentSoft : colours.raised;
  if (wrong) fill.setAlpha(nth == *chosen_ ? 150 : 70);
  painter.setPen(QPen(wrong ? kWrong : chosen ? colours.accent : colours.ink, chosen || wrong ? 2.2 : 1.3));
  painter.setBrush(fill);
  painter.drawPath(cut);
  painter.save();
  painter.setClipPath(cut);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colours.faint, 1, Qt::DashLine));
  const Piece& piece = *plan_->document.find(laid.piece);
  constexpr double kFine = 5e-4;  // metres
  std::vector<const Outline*> outlines{&piece.outline};
  for (const Outline& hole : piece.holes) outlines.push_back(&hole);
  for (const Outline* outline : outlines) {
    QPolygonF line;
    for (const Flat p : outline->flattened(kFine)) line << onScreen(laid(p));
    painter.drawPolygon(line);
  }
  double wide = 0;
  const Flat place = roomiest(cloth.cut[nth], wide);
  const QPointF middle = onScreen(place);
  const double pixels = onScreen({wide, 0}).x() - onScreen({0, 0}).x();
  painter.setPen(wrong ? kWrong.darker(150) : colours.ink);
  QString more;
  if (laid.onFold)
    more = inWords(say("on the fold"));
  else if (laid.layers == 2)
    more = inWords(laid.under ? say("two layers") : say("two layers: cut 2"));
  else if (laid.over)
    more = inWords(say("turned over"));
  // A strip across the cloth is lettered across it, in one line.
  constexpr double kNarrow = 70;
  const double tall = cut.boundingRect().height();
  const bool strip = pixels < kNarrow && tall > pixels;
  const QString name = QString::fromStdString(nameOf(laid));
  const auto line = [&](double down, double room, const QString& words) {
    const QString shown = painter.fontMetrics().elidedText(words, Qt::ElideRight, static_cast<int>(room) - 8);
    painter.drawText(QRectF(-room / 2, down, room, 20), Qt::AlignCenter, shown);
  };
  painter.save();
  painter.translate(middle);
  if (strip) {
    painter.rotate(-90);
    const QString both = name + " · " + more;
    const bool fits = !more.isEmpty() && painter.fontMetrics().horizontalAdvance(both) <= tall * 0.75 - 8;
    line(-10, tall * 0.75, fits ? both : name);
  } else {
    line(-16, pixels, name);
    line(16, pixels, more);
  }
  painter.restore();
  // The grain, its head where the paper's points.
  const Flat way = laid.step(laid.grain);
  const QPointF along = QPointF(way.u, -way.v) * std::min(pixels * 0.32, 60.0);
  const QPointF centre = middle + QPointF(0, strip ? tall * 0.42 : 10);
  const QPointF from = centre - along, to = centre + along;
  const QPointF back = along * (6 / std::max(1.0, std::hypot(along.x(), along.y())));
  const QPointF side(-back.y() * 0.6, back.x() * 0.6);
  painter.drawLine(from, to);
  painter.drawLine(to, to - back + side);
  painter.drawLine(to, to - back - side);
  painter.restore();
}

void LayView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& colours = Theme::here().palette();
  painter.fillRect(rect(), colours.window);
  if (!lay()) return;
  paintCloth(painter);
  for (std::size_t i = 0; i < lay()->pieces.size(); ++i)
    if (i != chosen_) paintPiece(painter, i);
  if (chosen_) paintPiece(painter, *chosen_);
  if (!hasFocus()) return;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colours.accent, 1));
  painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
}

}  // namespace karinui::studio
