#include "outline_drawing.h"

#include <QPainter>
#include <QPainterPath>

#include "karinui/design/step_words.h"
#include "theme.h"

namespace karinui::studio {

OutlineDrawing::OutlineDrawing(QWidget* parent) : QWidget(parent) { setMinimumSize(260, 150); }

void OutlineDrawing::show(std::shared_ptr<const Piece> piece) {
  piece_ = std::move(piece);
  update();
}

void OutlineDrawing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& colours = Theme::here().palette();
  painter.fillRect(rect(), colours.paper);
  if (!piece_) return;
  constexpr double kFine = 5e-4;         // metres
  constexpr double kRim = 44, kGap = 8;  // pixels, for the words above and below; beside the paper
  constexpr std::size_t kMostNamed = 8;
  const bool named = piece_->outline.edges.size() <= kMostNamed;
  const auto words = [](const Edge& edge) { return nameText(edge.name) + "  " + lengthText(edge.curve.length()); };
  const auto wideOf = [&](const Edge& edge) { return wordTag(painter.font(), {}, words(edge), rect()).width(); };
  double beside = kRim;  // so that what is said at the left and at the right does not meet over a narrow piece
  if (named)
    for (const Edge& edge : piece_->outline.edges) beside = std::max(beside, wideOf(edge) + 2 * kGap);
  beside = std::min(beside, 0.4 * width());
  Box box;
  std::vector<Ring> rings{piece_->outline.flattened(kFine)};
  for (const Outline& hole : piece_->holes) rings.push_back(hole.flattened(kFine));
  for (const Flat p : rings.front()) box.include({p.u, p.v, 0});
  const Vec3 size = box.size();
  const double scale =
      std::min((width() - 2 * beside) / std::max(size.x, 1e-3), (height() - 2 * kRim) / std::max(size.y, 1e-3));
  const auto onScreen = [&](Flat p) {
    return QPointF(width() / 2.0 + (p.u - box.centre().x) * scale, height() / 2.0 - (p.v - box.centre().y) * scale);
  };
  QPainterPath path;
  for (const Ring& ring : rings) {
    QPolygonF line;
    for (const Flat p : ring) line << onScreen(p);
    path.addPolygon(line);
    path.closeSubpath();
  }
  path.setFillRule(Qt::OddEvenFill);
  painter.setPen(QPen(colours.ink, 1.6));
  painter.setBrush(colours.accentSoft);
  painter.drawPath(path);
  const auto lengths = [&](const Outline& outline) {
    for (const Edge& edge : outline.edges) {   // outside of the paper, which lies at the left of its edges
      constexpr double kAway = 20, kTag = 10;  // pixels; a word stands above its place
      const Curve& curve = edge.curve;
      const Flat out = leftOf(normalized(curve.tangent(curve.parameterAt(curve.length() / 2)))) * -kAway;
      const double aside = out.u / kAway * (wideOf(edge) / 2 + kGap);
      paintWord(painter, onScreen(curve.atFraction(0.5)) + QPointF(aside, kTag - out.v), words(edge), rect());
    }
  };
  if (!named) return;
  lengths(piece_->outline);
  for (const Outline& hole : piece_->holes) lengths(hole);
}

}  // namespace karinui::studio
