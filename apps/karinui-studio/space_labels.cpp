// What is painted over the scene: words, dots, the floating bar, the scale of a map.
#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <functional>

#include "force_feedback.h"
#include "karinui/base/number.h"
#include "karinui/session/menu.h"
#include "karinui/view/strain_scale.h"
#include "orbit.h"
#include "space_view.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// The floating bar as a flat picture, so many pixels wide.
QImage boardPicture(const SceneMenu& panel, int pixels, QFont font) {
  const Palette& p = Theme::here().palette();
  const double wide = length(panel.across), high = length(panel.upward), scale = pixels / wide;
  QImage image(pixels, std::max(1, static_cast<int>(high * scale)), QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const double unit = panel.buttons.front().width * scale;
  QColor board = p.raised;
  board.setAlphaF(0.94f);
  painter.setPen(QPen(p.line, 1.2));
  painter.setBrush(board);
  painter.drawRoundedRect(QRectF(image.rect()).adjusted(1, 1, -1, -1), unit * 0.24, unit * 0.24);
  for (const SceneMenu::Button& b : panel.buttons) {
    const QRectF box(b.left * scale, (high - b.bottom - b.height) * scale, b.width * scale, b.height * scale);
    QColor ink = b.chosen ? p.accent : p.ink;
    if (!b.enabled) ink.setAlphaF(0.3f);
    if (b.chosen || (b.hot && b.enabled)) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(b.chosen ? p.accentSoft : p.window);
      painter.drawRoundedRect(box, unit * 0.17, unit * 0.17);
    }
    drawIcon(painter, b.icon, QRectF(box.center().x() - unit * 0.27, box.top() + unit * 0.1, unit * 0.54, unit * 0.54),
             ink);
    const QString caption = inWords(b.label);
    constexpr double kCaption = 0.25;  // of a button
    font.setPixelSize(std::max(1, static_cast<int>(unit * kCaption)));
    if (const double w = QFontMetricsF(font).horizontalAdvance(caption); w > unit * 1.1)
      font.setPixelSize(std::max(1, static_cast<int>(unit * kCaption * 1.1 * unit / w)));
    painter.setFont(font);
    painter.setPen(ink);
    painter.drawText(QRectF(box.left() - unit * 0.1, box.bottom() - unit * 0.4, box.width() + unit * 0.2, unit * 0.36),
                     Qt::AlignCenter, caption);
  }
  return image;
}

// All that a picture of the floating bar depends on.
QString boardKey(const SceneMenu& panel, int pixels, const QFont& font) {
  const double wide = length(panel.across);
  QStringList key{QString::number(pixels), font.key(), QString::number(Theme::here().dark()),
                  QString::number(length(panel.upward) / wide)};
  for (const SceneMenu::Button& b : panel.buttons) {
    for (const double part : {b.left, b.bottom, b.width, b.height}) key << QString::number(part / wide);
    key << QString::number(b.hot + 2 * b.chosen + 4 * b.enabled) << QString::fromStdString(b.icon) << inWords(b.label);
  }
  return key.join('|');
}

// The floating bar, drawn flat and hung in space by the projection of its corners. `kept`: its last picture.
void paintBoard(QPainter& painter, const SceneMenu& panel, const std::function<QPointF(Vec3)>& at,
                std::pair<QString, QImage>& kept) {
  const QPolygonF seen({at(panel.corner + panel.upward), at(panel.corner + panel.across + panel.upward),
                        at(panel.corner + panel.across), at(panel.corner)});
  const double ratio = painter.device()->devicePixelRatioF();
  const int pixels =
      std::clamp(static_cast<int>(std::hypot(seen[1].x() - seen[0].x(), seen[1].y() - seen[0].y()) * ratio), 64, 4096);
  if (QString key = boardKey(panel, pixels, painter.font()); kept.first != key)
    kept = {std::move(key), boardPicture(panel, pixels, painter.font())};
  const QImage& board = kept.second;
  const QPolygonF flat(QRectF(board.rect()));
  QTransform hang;
  if (QTransform::quadToQuad(QPolygonF({flat[0], flat[1], flat[2], flat[3]}), seen, hang)) {
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setTransform(hang, true);
    painter.drawImage(0, 0, board);
    painter.restore();
  }
}

}  // namespace

QStringList SpaceView::levelWords() const {
  QStringList words;
  for (const Girths& girths : levelShown_)
    for (const bool garment : {true, false}) {
      const std::string length = lengthText(garment ? girths.garment : girths.body).toStdString();
      words << inWords(garment ? say("garment {0}", length) : say("body {0}", length));
    }
  return words;
}

// Words, dots and the floating bar, as this eye sees them.
void SpaceView::paintOver(QPainter& painter, double sideways, int w, int h) {
  painter.setRenderHint(QPainter::Antialiasing);
  const Eye eye = eyeOf(lens(), static_cast<double>(w) / h, sideways);
  const auto at = [&](Vec3 place) {
    const OnPicture on = project(eye, place, w, h);
    return QPointF(on.x, on.y);
  };
  const QRectF room(0, 0, w * (1 - menuShare(sight())), h);
  const SnapshotPtr fitting = session_.shownPtr();
  for (const auto& [id, pins] : fitting->document.pins)
    for (const Flat pin : pins)
      if (const auto place = spaceOf(*fitting, id, pin)) paintPin(painter, at(*place));
  const Preview preview = session_.preview();
  for (const Vec3 dot : preview.space.dots) {
    painter.setPen(QPen(Qt::white, 2));
    painter.setBrush(QColor("#d4552a"));
    painter.drawEllipse(at(dot), 5, 5);
  }
  for (const Vec3 ring : preview.space.rings) paintRing(painter, at(ring), QColor("#d4552a"));
  if (const auto tip = session_.fingertip(); tip && tip->where == PointerSample::Where::Space)
    paintFingertip(painter, at(tip->ray.origin + tip->ray.direction * camera_.distance()));
  for (const SceneWord& word : preview.space.words)
    paintWord(painter, at(word.place), QString::fromStdString(word.text), room);
  if (force_) force_->paint(painter, at, room);
  // What the tapes say stands beside them: right of the trunk or of the leg that is seen at the right, else left.
  const auto side = [&](const std::vector<Vec3>& line, bool right) {
    QPointF most = at(line.front());
    for (const Vec3 p : line)
      if (const QPointF here = at(p); right ? here.x() > most.x() : here.x() < most.x()) most = here;
    return most;
  };
  const auto middle = [&](const Girths& g) { return (side(g.under, true).x() + side(g.under, false).x()) / 2; };
  const QStringList levels = levelWords();
  for (std::size_t k = 0; k < levelShown_.size(); ++k) {
    const Girths& girths = levelShown_[k];
    const bool right = std::all_of(levelShown_.begin(), levelShown_.end(), [&](const Girths& other) {
      return other.under.empty() || girths.under.empty() || middle(girths) >= middle(other);
    });
    for (const bool garment : {true, false})
      if (const auto& line = garment ? girths.round : girths.under; !line.empty())
        paintWord(painter, side(line, right) + QPointF(right ? 62 : -62, garment ? 14 : 40),
                  levels[static_cast<qsizetype>(2 * k + (garment ? 0 : 1))], room);
  }
  if (!tapeShown_.line.empty()) paintWord(painter, at(tapeShown_.line.front()), lengthText(tapeShown_.length), room);
  if (const auto panel = session_.menu()) paintBoard(painter, *panel, at, bar_);
  if (mapTop_ > 0 && !beside()) paintScale(painter, w, h);
  if (beside()) paintWord(painter, QPointF(room.right() - 60, 44), inWords(say("now")), room);
}

void SpaceView::paintThen(QPainter& painter, int w, int h) const {
  painter.setRenderHint(QPainter::Antialiasing);
  paintWord(painter, QPointF(w - 60.0, 44), beside_.caption, QRectF(0, 0, w, h));
  if (mapTop_ > 0) paintScale(painter, w, h);
}

// What the colours of a map mean: standing in a corner, or lying below the feet where two figures leave it no room.
void SpaceView::paintScale(QPainter& painter, int w, int h) const {
  const Palette& p = Theme::here().palette();
  const bool lying = beside();
  const double room = lying ? std::min(270.0, w - 80.0) : std::min(190.0, h * 0.3);
  const QRectF board = lying ? QRectF(12, h - 76, room + 56, 66) : QRectF(12, 12, 142, room + 54);
  const QRectF bar = lying ? QRectF(board.left() + 28, board.top() + 28, room, 12)
                           : QRectF(board.left() + 10, board.top() + 32, 16, room);
  painter.setPen(Qt::NoPen);
  QColor back = p.raised;
  back.setAlphaF(0.9f);
  painter.setBrush(back);
  painter.drawRoundedRect(board, 10, 10);
  painter.setPen(p.ink);
  painter.drawText(board.topLeft() + QPointF(10, 20), inWords(map_ == FitMap::Strain ? say("strain")
                                                              : map_ == FitMap::Ease ? say("distance to body")
                                                                                     : say("pressure")));
  QLinearGradient scale(bar.bottomLeft(), lying ? bar.bottomRight() : bar.topLeft());
  for (int i = 0; i <= 16; ++i) scale.setColorAt(i / 16.0, shown(strainColour(i / 16.0)));
  painter.setPen(Qt::NoPen);
  painter.setBrush(scale);
  painter.drawRoundedRect(bar, 4, 4);
  painter.setPen(p.ink);
  const int every = lying && room < 240 ? 5 : 1;
  for (int i = 0; i <= 5; i += every) {
    const double v = mapTop_ * i / 5;
    const QString words = map_ == FitMap::Strain ? QString::fromStdString(fixed(100 * v, 1)) + " %"
                          : map_ == FitMap::Ease ? lengthText(v)
                                                 : QString::fromStdString(fixed(v / 1000, 2)) + " kPa";
    if (lying) {
      const QPointF middle(bar.left() + room * i / 5, bar.bottom() + 11);
      painter.drawText(QRectF(middle - QPointF(40, 10), QSizeF(80, 20)), Qt::AlignCenter, words);
    } else {
      painter.drawText(QPointF(bar.right() + 8, bar.bottom() - room * i / 5 + 4), words);
    }
  }
}

}  // namespace karinui::studio
