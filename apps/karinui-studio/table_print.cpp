#include "table_print.h"

#include <QImage>

#include "karinui/scene/table_print.h"
#include "theme.h"

namespace karinui::studio {

namespace {
constexpr double kSmallest = 3;  // pixels between two repeats
}

void paintPicture(QPainter& painter, const PrintImage& picture, const std::array<QPointF, 3>& corners) {
  const QImage image(picture.rgb.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888);
  const QPointF right = corners[1] - corners[0], down = corners[2] - corners[0];
  painter.save();
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setTransform(QTransform(right.x() / picture.width, right.y() / picture.width, down.x() / picture.height,
                                  down.y() / picture.height, corners[0].x(), corners[0].y()),
                       true);
  painter.drawImage(0, 0, image);
  painter.restore();
}

void paintPrint(QPainter& painter, const TablePiece& piece, const QPainterPath& shape, const TableOnScreen& screen) {
  if (piece.look.print == ClothLook::Print::None || !(piece.look.repeat * screen.scale >= kSmallest)) return;
  const TablePrint print = printOn(piece);
  painter.save();
  painter.setClipPath(shape, Qt::IntersectClip);
  painter.setOpacity(print.strength);
  const QColor ink = shown(piece.look.ink);
  painter.setPen(QPen(ink, print.stripe * screen.scale, Qt::SolidLine, Qt::FlatCap));
  for (const TableStroke& stripe : print.stripes) painter.drawLine(screen.at(stripe.from), screen.at(stripe.to));
  painter.setPen(Qt::NoPen);
  painter.setBrush(ink);
  for (const Flat dot : print.dots)
    painter.drawEllipse(screen.at(dot), print.dot * screen.scale, print.dot * screen.scale);
  for (const auto& [corner, right, below] : print.photos)
    paintPicture(painter, *piece.look.photo, {screen.at(corner), screen.at(right), screen.at(below)});
  painter.restore();
}

}  // namespace karinui::studio
