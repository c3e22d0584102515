// Pieces drawn on the flat pattern by one drag: a rectangle from corner to corner, a circle from its middle outwards. A
// click asks for the numbers.
#include <cmath>
#include <numbers>

#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kUsual = 0.2;  // metres: what is first written in the boxes

class PaperGesture : public Gesture {
 public:
  explicit PaperGesture(bool round) : round_(round) {}
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    if (sample.phase == PointerSample::Phase::Hover) return {};
    if (sample.phase == PointerSample::Phase::Press) {
      if (sample.where != PointerSample::Where::Table)
        return {.why = say("Drag on the flat pattern, not on the body.")};
      from_ = to_ = sample.place;
      return {};
    }
    if (!from_) return {};
    to_ = sample.place;
    square_ = sample.shift, step_ = sample.alt ? kFreeStep : kDragStep;
    if (sample.phase == PointerSample::Phase::Drag) return {};
    const Flat size = sizeNow();
    const double least = round_ ? size.u : std::fmin(size.u, size.v);
    const Flat from = *from_;
    from_.reset();
    const Document& document = context.snapshot->document;
    const bool clicked = least < kShortestDrag;
    if (round_) {
      DrawRing circle;
      circle.name = usableName(document, "circle");
      circle.depth = Length{clicked ? kUsual : size.u};
      if (clicked) return {.over = true, .asked = std::move(circle)};
      return {.over = true, .operation = std::move(circle), .drawnAt = from};
    }
    DrawRectangle rectangle;
    rectangle.name = usableName(document, "rectangle");
    rectangle.width = Length{clicked ? kUsual : size.u};
    rectangle.height = Length{clicked ? kUsual : size.v};
    if (clicked) return {.over = true, .asked = std::move(rectangle)};
    const Flat middle{
        from.u + std::copysign(size.u, to_.u - from.u) / 2,
        std::fmin(from.v, from.v + std::copysign(size.v, to_.v - from.v))};  // its lower edge lies on v = 0
    return {.over = true, .operation = std::move(rectangle), .drawnAt = middle};
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (!from_) return shown;
    const Flat size = sizeNow();
    TableLine line;
    line.colour = kChalk;
    std::string words;
    if (round_) {
      for (int k = 0; k <= kSteps; ++k) {
        const double a = 2 * std::numbers::pi * k / kSteps;
        line.points.push_back(*from_ + Flat{std::cos(a), std::sin(a)} * size.u);
      }
      words = context.said(size.u);
    } else {
      const Flat far{from_->u + std::copysign(size.u, to_.u - from_->u),
                     from_->v + std::copysign(size.v, to_.v - from_->v)};
      line.points = {*from_, {far.u, from_->v}, far, {from_->u, far.v}, *from_};
      words = context.said(size.u) + " × " + context.said(size.v);
    }
    shown.table.lines.push_back(std::move(line));
    shown.table.words.push_back({to_, std::move(words)});
    return shown;
  }
  Message hint() const override {
    return from_ ? say("Sizes are whole half centimetres; hold Alt to draw freely.") : info(command()).hint;
  }
  bool begun() const override { return from_.has_value(); }

 private:
  static constexpr int kSteps = 72;
  Command command() const { return round_ ? Command::Circle : Command::Rectangle; }
  // Width and height, or the radius twice.
  Flat sizeNow() const {
    const auto whole = [&](double metres) { return std::round(std::fabs(metres) / step_) * step_; };
    const Flat way = to_ - *from_;
    if (round_) return {whole(length(way)), whole(length(way))};
    const double side = whole(std::fmax(std::fabs(way.u), std::fabs(way.v)));
    return square_ ? Flat{side, side} : Flat{whole(way.u), whole(way.v)};
  }
  bool round_, square_ = false;
  double step_ = kDragStep;  // metres that sizes are multiples of
  std::optional<Flat> from_;
  Flat to_;
};

}  // namespace

std::unique_ptr<Gesture> rectangleGesture() { return std::make_unique<PaperGesture>(false); }
std::unique_ptr<Gesture> circleGesture() { return std::make_unique<PaperGesture>(true); }

}  // namespace karinui
