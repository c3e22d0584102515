// A ring or a sector of one on the flat pattern: a drag from the middle to the outer edge; then the pointer is where
// the inner edge ends, and the sector opens downwards to both sides up to there. At the middle it has no inner edge.
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kTurn = 5 * kDegree;        // neither is the angle
constexpr double kFreeTurn = 0.2 * kDegree;  // nor that, drawn freely

double whole(double value, double step) { return std::round(value / step) * step; }

class RingGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    const bool table = sample.where == PointerSample::Where::Table;
    step_ = sample.alt ? kFreeStep : kDragStep, turn_ = sample.alt ? kFreeTurn : kTurn;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        if (outer_ > 0 && table) inner_ = sample.place;
        return {};
      case PointerSample::Phase::Press:
        if (!table) return {.why = say("Drag on the flat pattern, not on the body.")};
        if (outer_ > 0)
          inner_ = sample.place;
        else
          middle_ = sample.place, pulled_ = sample.place;
        return {};
      case PointerSample::Phase::Drag:
        if (!table) return {};
        (outer_ > 0 ? inner_ : pulled_) = sample.place;
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!middle_) return {};
    if (table) (outer_ > 0 ? inner_ : pulled_) = sample.place;
    DrawRing ring;
    ring.name = usableName(context.snapshot->document, "ring");
    if (outer_ > 0) {
      const Sector now = sector();
      ring.radius = Length{now.inner};
      ring.depth = Length{outer_ - now.inner};
      ring.angle = Angle{now.angle};
      return {.over = true, .operation = std::move(ring), .drawnAt = middle_};
    }
    outer_ = outerNow();
    inner_ = pulled_;
    if (outer_ >= kShortestDrag) return {};
    ring.inner = Length{0.6};  // half round a waist, knee-long: what is first written in the boxes
    ring.depth = Length{0.5};
    ring.angle = Angle{std::numbers::pi};
    return {.over = true, .asked = std::move(ring)};
  }
  bool takeBack() override {
    if (outer_ <= 0) return false;
    outer_ = 0;
    middle_.reset();
    return true;
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (!middle_) return shown;
    const double outer = outer_ > 0 ? outer_ : outerNow();
    const Sector now = outer_ > 0 ? sector() : Sector{0, 2 * std::numbers::pi};
    TableLine line;
    line.colour = kChalk;
    const auto arc = [&](double radius, double from, double to) {
      for (int k = 0; k <= kSteps; ++k) {
        const double a = from + (to - from) * k / kSteps;
        line.points.push_back(*middle_ + Flat{std::sin(a), -std::cos(a)} * radius);
      }
    };
    arc(outer, -now.angle / 2, now.angle / 2);
    arc(now.inner, now.angle / 2, -now.angle / 2);
    line.points.push_back(line.points.front());
    shown.table.lines.push_back(std::move(line));
    std::string words = context.said(outer);
    if (outer_ > 0)
      words = context.said(now.inner * now.angle) + "   " + context.said(outer - now.inner) + "   " +
              fixed(now.angle / kDegree, 0) + "°";
    shown.table.words.push_back({outer_ > 0 ? inner_ : pulled_, std::move(words)});
    return shown;
  }
  Message hint() const override {
    return outer_ > 0 ? say("Click where the inner edge ends: straight above the middle is a whole ring, the middle "
                            "itself a sector without one. Hold Alt to draw freely.")
           : middle_  ? say("Sizes are whole half centimetres; hold Alt to draw freely.")
                      : info(Command::RingSector).hint;
  }
  bool begun() const override { return middle_.has_value(); }

 private:
  static constexpr int kSteps = 72;
  struct Sector {
    double inner, angle;
  };
  double outerNow() const { return whole(distance(*middle_, pulled_), step_); }
  // Where the pointer is, seen from the middle: its distance, and twice its angle from straight below.
  Sector sector() const {
    const Flat way = inner_ - *middle_;
    const double inner = std::fmin(whole(length(way), step_), outer_ - kShortestDrag);
    const double angle = 2 * whole(std::fabs(std::atan2(way.u, -way.v)), turn_ / 2);
    return {std::fmax(0, inner), std::clamp(angle, kTurn, 2 * std::numbers::pi)};
  }
  std::optional<Flat> middle_;
  Flat pulled_, inner_;
  double outer_ = 0;  // metres; 0: not dragged yet
  double step_ = kDragStep, turn_ = kTurn;
};

}  // namespace

std::unique_ptr<Gesture> ringGesture() { return std::make_unique<RingGesture>(); }

}  // namespace karinui
