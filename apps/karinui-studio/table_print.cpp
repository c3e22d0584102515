#include "table_print.h"

#include <QImage>
#include <algorithm>
#include <cmath>

#include "karinui/scene/cloth_look.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kSmallest = 3;  // pixels between two repeats
constexpr double kPale = 0.55;
constexpr double kStripe = 0.42, kChecked = 0.5, kDot = 0.19;  // shares of a repeat

// Repeats are counted across and along the print; places of the table are found from them.
struct Repeats {
  Flat lies, across, along;  // where the paper's origin lies on the table; a repeat across and along the print
  double left = 1e9, right = -1e9, low = 1e9, high = -1e9;

  Repeats(const ClothLook& look, const TablePiece& piece, double tall) : lies(piece.lies) {
    const auto [u, v] = printAxes(look);
    across = u * look.repeat, along = v * tall;
    for (const Flat corner :
         {piece.low, Flat{piece.high.u, piece.low.v}, piece.high, Flat{piece.low.u, piece.high.v}}) {
      const Flat paper = corner - lies;
      const double x = dot(paper, u) / look.repeat, y = dot(paper, v) / tall;
      left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
    }
  }
  Flat at(double x, double y) const { return lies + across * x + along * y; }
};

void stripesAcross(QPainter& painter, const Repeats& r, const TableOnScreen& screen) {
  for (double x = std::floor(r.left) + 0.5; x < r.right + 1; ++x)
    painter.drawLine(screen.at(r.at(x, r.low)), screen.at(r.at(x, r.high)));
}
void stripesAlong(QPainter& painter, const Repeats& r, const TableOnScreen& screen) {
  for (double y = std::floor(r.low) + 0.5; y < r.high + 1; ++y)
    painter.drawLine(screen.at(r.at(r.left, y)), screen.at(r.at(r.right, y)));
}
void dots(QPainter& painter, const Repeats& r, const TableOnScreen& screen, double radius) {
  for (double y = std::floor(2 * r.low) / 2; y < r.high + 1; y += 0.5)
    for (double x = std::floor(r.left) + (std::fmod(std::fabs(2 * y), 2) == 1 ? 0.5 : 0); x < r.right + 1; ++x)
      painter.drawEllipse(screen.at(r.at(x, y)), radius, radius);
}
void photographs(QPainter& painter, const Repeats& r, const TableOnScreen& screen, const PrintImage& photo) {
  const QImage image(photo.rgb.data(), photo.width, photo.height, 3 * photo.width, QImage::Format_RGB888);
  for (double y = std::floor(r.low); y < r.high; ++y)
    for (double x = std::floor(r.left); x < r.right; ++x) {
      const QPointF corner = screen.at(r.at(x, y + 1)), right = screen.at(r.at(x + 1, y + 1)) - corner,
                    down = screen.at(r.at(x, y)) - corner;
      const QTransform lie(right.x() / photo.width, right.y() / photo.width, down.x() / photo.height,
                           down.y() / photo.height, corner.x(), corner.y());
      painter.save();
      painter.setTransform(lie, true);
      painter.drawImage(0, 0, image);
      painter.restore();
    }
}

}  // namespace

void paintPrint(QPainter& painter, const TablePiece& piece, const QPainterPath& shape, const TableOnScreen& screen) {
  if (piece.look.print == ClothLook::Print::None) return;
  const ClothLook& look = piece.look;
  const double pixels = look.repeat * screen.scale;
  if (!(pixels >= kSmallest)) return;
  const bool photo = look.print == ClothLook::Print::Photo && look.photo;
  const Repeats repeats(look, piece, photo ? look.repeat * look.photo->height / look.photo->width : look.repeat);
  painter.save();
  painter.setClipPath(shape, Qt::IntersectClip);
  painter.setOpacity(look.print == ClothLook::Print::Check ? kPale / 2 : kPale);
  const QColor ink = shown(look.ink);
  painter.setBrush(ink);
  const auto pen = [&](double share) { painter.setPen(QPen(ink, share * pixels, Qt::SolidLine, Qt::FlatCap)); };
  switch (look.print) {
    case ClothLook::Print::Stripe:
      pen(kStripe);
      stripesAcross(painter, repeats, screen);
      break;
    case ClothLook::Print::Check:
      pen(kChecked);
      stripesAcross(painter, repeats, screen);
      stripesAlong(painter, repeats, screen);
      break;
    case ClothLook::Print::Dot:
      painter.setPen(Qt::NoPen);
      dots(painter, repeats, screen, kDot * pixels);
      break;
    case ClothLook::Print::Photo:
      if (photo) photographs(painter, repeats, screen, *look.photo);
      break;
    case ClothLook::Print::None:
      break;
  }
  painter.restore();
}

}  // namespace karinui::studio
