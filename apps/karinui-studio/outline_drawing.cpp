#include "outline_drawing.h"

#include <QPainter>
#include <optional>

#include "karinui/design/step_words.h"
#include "theme.h"

namespace karinui::studio {

OutlineDrawing::OutlineDrawing(QWidget* parent) : QWidget(parent) { setMinimumSize(260, 150); }

void OutlineDrawing::show(std::shared_ptr<const Piece> piece) {
  piece_ = std::move(piece);
  update();
}

OutlineDrawing::Drawn OutlineDrawing::drawn() const {
  constexpr double kFine = 5e-4;         // metres
  constexpr double kRim = 44, kGap = 8;  // pixels, for the words above and below; beside the paper
  constexpr double kFlat = 6;            // times as wide as high
  constexpr std::size_t kMostNamed = 8;
  const bool named = piece_->outline.edges.size() <= kMostNamed;
  const auto words = [](const Edge& edge) { return nameText(edge.name) + "  " + lengthText(edge.curve.length()); };
  const auto wideOf = [&](const Edge& edge) { return wordTag(font(), {}, words(edge), rect()).width(); };
  Box box;
  std::vector<Ring> rings{piece_->outline.flattened(kFine)};
  for (const Outline& hole : piece_->holes) rings.push_back(hole.flattened(kFine));
  for (const Flat p : rings.front()) box.include({p.u, p.v, 0});
  const Vec3 size = box.size();
  // Of a band what is said at its ends stands below it: beside it there would be no room for the band.
  const bool flat = size.x > kFlat * size.y;
  double beside = kRim;  // so that what is said at the left and at the right does not meet over a narrow piece
  if (named && !flat)
    for (const Edge& edge : piece_->outline.edges) beside = std::max(beside, wideOf(edge) + 2 * kGap);
  beside = std::min(beside, 0.4 * width());
  const double scale =
      std::min((width() - 2 * beside) / std::max(size.x, 1e-3), (height() - 2 * kRim) / std::max(size.y, 1e-3));
  const auto onScreen = [&](Flat p) {
    return QPointF(width() / 2.0 + (p.u - box.centre().x) * scale, height() / 2.0 - (p.v - box.centre().y) * scale);
  };
  Drawn made;
  for (const Ring& ring : rings) {
    QPolygonF line;
    for (const Flat p : ring) line << onScreen(p);
    made.paper.addPolygon(line);
    made.paper.closeSubpath();
  }
  made.paper.setFillRule(Qt::OddEvenFill);
  if (!named) return made;
  std::vector<double> lengthsOf;
  const auto lengths = [&](const Outline& outline) {
    for (const Edge& edge : outline.edges) {              // outside of the paper, which lies at the left of its edges
      constexpr double kAway = 20, kTag = 10, kRow = 60;  // pixels; a word stands above its place
      const Curve& curve = edge.curve;
      lengthsOf.push_back(curve.length());
      const Flat out = leftOf(normalized(curve.tangent(curve.parameterAt(curve.length() / 2)))) * -kAway;
      const QPointF middle = onScreen(curve.atFraction(0.5));
      const bool atEnd = flat && std::abs(out.u) > std::abs(out.v);
      const double aside = out.u / kAway * (wideOf(edge) / 2 + kGap);
      made.words.emplace_back(
          atEnd ? QPointF(middle.x(), onScreen({0, box.low.y}).y() + kRow) : middle + QPointF(aside, kTag - out.v),
          words(edge));
    }
  };
  lengths(piece_->outline);
  for (const Outline& hole : piece_->holes) lengths(hole);
  pushApart(made.words, std::move(lengthsOf));
  return made;
}

// Words that would lie on each other go aside. Where there is no room for that, the shorter edge goes without.
void OutlineDrawing::pushApart(std::vector<std::pair<QPointF, QString>>& words, std::vector<double> lengths) const {
  constexpr double kApart = 6, kAbove = 20;  // pixels; a word stands so far above its place
  constexpr int kRounds = 60;
  const auto tagOf = [&](std::size_t k) { return wordTag(font(), words[k].first, words[k].second, rect()); };
  const auto meeting = [&]() -> std::optional<std::pair<std::size_t, std::size_t>> {
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t k = i + 1; k < words.size(); ++k)
        if (tagOf(i).intersects(tagOf(k))) return std::pair(i, k);
    return std::nullopt;
  };
  int round = 0;
  while (const auto met = meeting()) {
    const auto [i, k] = *met;
    const QRectF one = tagOf(i), other = tagOf(k);
    if (++round > kRounds || one.width() + other.width() + 4 * kApart > width()) {
      const auto without = static_cast<std::ptrdiff_t>(lengths[i] < lengths[k] ? i : k);
      words.erase(words.begin() + without), lengths.erase(lengths.begin() + without);
      round = 0;
      continue;
    }
    const bool left = one.center().x() <= other.center().x();
    const double by = ((left ? one.right() - other.left() : other.right() - one.left()) + kApart) / 2;
    words[i].first = one.center() + QPointF(left ? -by : by, kAbove);
    words[k].first = other.center() + QPointF(left ? by : -by, kAbove);
  }
}

void OutlineDrawing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& colours = Theme::here().palette();
  painter.fillRect(rect(), colours.paper);
  if (!piece_) return;
  const Drawn now = drawn();
  painter.setPen(QPen(colours.ink, 1.6));
  painter.setBrush(colours.accentSoft);
  painter.drawPath(now.paper);
  for (const auto& [above, words] : now.words) paintWord(painter, above, words, rect());
}

}  // namespace karinui::studio
