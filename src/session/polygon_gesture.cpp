// A piece drawn on the flat pattern click by click. A place with Ctrl lies on a curve, all others are corners; with
// Shift the line from the last place is level, upright or half-way between. The piece keeps the size it was drawn in.
// Over a scan, and with Alt, a click is as fine as the hand.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kSame = 0.004;  // metres: twice the same place

class PolygonGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    const bool table = sample.where == PointerSample::Where::Table;
    if (sample.phase == PointerSample::Phase::Hover) {
      now_ = table ? std::optional(snapped(sample, context)) : std::nullopt;
      return {};
    }
    if (sample.phase != PointerSample::Phase::Press) return {};
    if (!table) return {.why = say("Click on the flat pattern, not on the body.")};
    const Flat place = snapped(sample, context);
    now_.reset();
    const bool closes = places_.size() > 2 && distance(places_.front(), sample.place) < std::fmax(kSame, sample.reach);
    if (closes || (!places_.empty() && distance(places_.back(), place) < kSame)) return confirm(context);
    curved_.push_back(sample.control && !places_.empty());
    places_.push_back(place);
    return {};
  }
  GestureResult confirm(const GestureContext& context) override {
    if (places_.size() < 3) return {.why = say("A polygon needs at least three places.")};
    DrawPolygon polygon;
    polygon.name = usableName(context.snapshot->document, "polygon");
    Flat middle;
    for (const Flat p : places_) middle += p * (1.0 / static_cast<double>(places_.size()));
    // On a scan the paper's places are those of the table, so that it lies there again.
    const bool traced = underlayAt(context.snapshot->document.underlays, middle);
    middle = traced ? Flat{}
                    : Flat{std::round(middle.u / kDragStep) * kDragStep, std::round(middle.v / kDragStep) * kDragStep};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      polygon.points.push_back(tenth(places_[i] - middle));
      if (std::find(curved_.begin(), curved_.end(), true) != curved_.end())
        polygon.edges.push_back(curved_[i] ? "~" : "e" + written(i + 1));
    }
    return {.over = true, .operation = std::move(polygon), .drawnAt = middle};
  }
  bool takeBack() override {
    if (places_.empty()) return false;
    places_.pop_back();
    curved_.pop_back();
    return true;
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (places_.empty()) return shown;
    TableLine line{places_, kChalk, false};
    if (now_) line.points.push_back(*now_);
    for (std::size_t i = 0; i < places_.size(); ++i)
      (curved_[i] ? shown.table.rings : shown.table.dots).push_back(places_[i]);
    const std::size_t n = line.points.size();
    if (n > 1) {
      const Flat last = line.points[n - 1] - line.points[n - 2];
      shown.table.words.push_back({line.points.back(), context.said(length(last)) + "   " + context.said(last.u) +
                                                           " × " + context.said(last.v)});
    }
    shown.table.lines.push_back(std::move(line));
    return shown;
  }
  Message hint() const override {
    return places_.empty()
               ? info(Command::Polygon).hint
               : say("Click on; with Ctrl the line curves on, with Shift it is level, upright or between, with "
                     "Alt exactly where the hand is. Enter closes it.");
  }
  bool begun() const override { return !places_.empty(); }
  bool clicks() const override { return true; }

 private:
  Flat snapped(const PointerSample& sample, const GestureContext& context) const {
    Flat place = sample.place;
    if (sample.shift && !places_.empty()) {
      constexpr double kEighth = std::numbers::pi / 4;
      const Flat way = place - places_.back();
      const double a = std::round(std::atan2(way.v, way.u) / kEighth) * kEighth;
      const Flat along{std::cos(a), std::sin(a)};
      place = places_.back() + along * dot(way, along);
    }
    if (sample.alt || underlayAt(context.snapshot->document.underlays, sample.place)) return tenth(place);
    const auto whole = [](double metres) { return std::round(metres / kDragStep) * kDragStep; };
    return {whole(place.u), whole(place.v)};
  }
  std::vector<Flat> places_;
  std::vector<bool> curved_;
  std::optional<Flat> now_;
};

}  // namespace

std::unique_ptr<Gesture> polygonGesture() { return std::make_unique<PolygonGesture>(); }

}  // namespace karinui
