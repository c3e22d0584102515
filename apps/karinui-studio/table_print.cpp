#include "table_print.h"

#include <QImage>
#include <QLineF>
#include <algorithm>
#include <vector>

#include "karinui/scene/table_print.h"
#include "theme.h"

namespace karinui::studio {

namespace {
constexpr double kSmallest = 3;  // pixels between two repeats
constexpr double kFine = 0.7;    // pixels of the screen for one of a picture; with fewer some are passed over

// A picture and what it is when halved time and again, each pixel the mean of four. Kept while the picture is.
class Halves {
 public:
  explicit Halves(const std::shared_ptr<const PrintImage>& picture) : of_(picture), half_{whole(*picture)} {}
  static const QImage& of(const std::shared_ptr<const PrintImage>& picture, std::size_t times) {
    static std::vector<Halves> kept;
    std::erase_if(kept, [](const Halves& one) { return one.of_.expired(); });
    auto at = std::find_if(kept.begin(), kept.end(), [&](const Halves& one) { return one.of_.lock() == picture; });
    if (at == kept.end()) at = kept.insert(kept.end(), Halves(picture));
    return at->halved(times);
  }

 private:
  static QImage whole(const PrintImage& picture) {
    return QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888);
  }
  const QImage& halved(std::size_t times) {
    while (half_.size() <= times) {
      const QImage& last = half_.back();
      if (last.width() < 2 || last.height() < 2) break;
      half_.push_back(
          last.scaled(last.width() / 2, last.height() / 2, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    }
    return half_[std::min(times, half_.size() - 1)];
  }
  std::weak_ptr<const PrintImage> of_;
  std::vector<QImage> half_;
};

}  // namespace

void paintPicture(QPainter& painter, const std::shared_ptr<const PrintImage>& picture,
                  const std::array<QPointF, 3>& corners) {
  const QPointF right = corners[1] - corners[0], down = corners[2] - corners[0];
  const QTransform onScreen = painter.deviceTransform();
  const double across = QLineF(onScreen.map(corners[0]), onScreen.map(corners[1])).length() / picture->width;
  std::size_t times = 0;
  for (double scale = across; scale > 0 && scale < kFine; scale *= 2) ++times;
  const QImage& image = Halves::of(picture, times);
  painter.save();
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setTransform(QTransform(right.x() / image.width(), right.y() / image.width(), down.x() / image.height(),
                                  down.y() / image.height(), corners[0].x(), corners[0].y()),
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
    paintPicture(painter, piece.look.photo, {screen.at(corner), screen.at(right), screen.at(below)});
  painter.restore();
}

}  // namespace karinui::studio
