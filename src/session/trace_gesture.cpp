// The scan that is traced: dragged to where it should lie, with Ctrl turned; or two places clicked on it and told how
// far they are apart on the paper. Four places are the corners of a rectangle, of a photograph taken at a slant.
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"
#include "session/gestures.h"

namespace karinui {

namespace {

// A hundredth of a millimetre: a pattern is six times as long as its printed square, and so is what is missed here.
double hundredth(double metres) {
  const double rounded = std::round(metres * 1e5) / 1e5;
  return rounded == 0 ? 0 : rounded;
}
Flat hundredth(Flat place) { return {hundredth(place.u), hundredth(place.v)}; }

class TraceGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    const bool table = sample.where == PointerSample::Where::Table;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        now_ = table && !places_.empty() && !asks() ? std::optional(sample.place) : std::nullopt;
        return {};
      case PointerSample::Phase::Press:
        if (!table) return {.why = say("Scans lie on the flat pattern; point there.")};
        return press(sample, context);
      case PointerSample::Phase::Drag:
        if (!pressed_ || !table) return {};
        if (places_.empty() && distance(*pressed_, sample.place) > sample.reach) carried_ = true;
        if (carried_) carry(sample);
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!pressed_) return {};
    const Flat place = hundredth(*std::exchange(pressed_, std::nullopt));
    if (carried_) {
      LayUnderlay op;
      op.name = name_;
      if (turned_)
        op.turn = Angle{lies_.turn};
      else
        op.at = lies_.at;
      return {.over = true, .operation = std::move(op)};
    }
    if (!places_.empty() && distance(places_.back(), place) < sample.reach)
      return {.why = say("These two places lie on each other; take two that are far apart.")};
    places_.push_back(place);
    now_.reset();
    if (places_.size() < 4) return {};
    LayUnderlay op;
    op.name = name_, op.corners = places_;
    // A sheet of A4, as it seems to lie: what is first written in the box.
    const double first = distance(places_[0], places_[1]) + distance(places_[2], places_[3]),
                 second = distance(places_[1], places_[2]) + distance(places_[3], places_[0]);
    op.rectangle = first > second ? Flat{0.297, 0.21} : Flat{0.21, 0.297};
    return {.over = true, .asked = std::move(op)};
  }

  GestureResult confirm(const GestureContext& context) override {
    return asks() ? choose(current_, context) : GestureResult();
  }
  bool takeBack() override {
    typing_ = false;
    if (places_.empty()) return false;
    if (!std::exchange(corners_, false)) places_.pop_back();
    return true;
  }

  std::optional<DropMenu> dropMenu(const GestureContext& context) const override {
    if (!asks()) return std::nullopt;
    const double apart = distance(places_[0], places_[1]), unit = context.inches ? 0.0254 : 0.01;
    DropMenu menu;
    menu.title = {say("These places are {0} apart as the scan lies.", context.said(apart))};
    menu.items = {{say("Type how far apart they are")},
                  {say("The side of a square of 10 cm")},
                  {say("The grain line: turn it upright")},
                  {say("Corners of a rectangle: click the other two")}};
    menu.current = current_;
    menu.number = DropMenu::Number{context.inches ? say("inches apart on the paper") : say("cm apart on the paper"),
                                   std::round(apart / unit * 100) / 100,
                                   0.1,
                                   1000,
                                   2,
                                   typing_,
                                   unit};
    menu.where = PointerSample::Where::Table;
    menu.table = places_[1];
    return menu;
  }
  GestureResult choose(std::size_t item, const GestureContext& context) override {
    if (!asks()) return {};
    LayUnderlay op;
    op.name = name_;
    switch (item) {
      case 0:  // a face without keys takes the number as it stands by choosing it again
        if (std::exchange(typing_, true)) return chooseNumber(dropMenu(context)->number->value, context);
        return {};
      case 1:
        return scaled(0.1, context);
      case 2:
        op.upright = places_;
        return {.over = true, .operation = std::move(op)};
      case 3:
        corners_ = true;
        return {};
      default:
        return {};
    }
  }
  GestureResult chooseNumber(double typed, const GestureContext& context) override {
    return asks() ? scaled(typed * (context.inches ? 0.0254 : 0.01), context) : GestureResult();
  }
  void moveInMenu(int by, const GestureContext&) override {
    constexpr int kItems = 4;
    typing_ = false;
    current_ = static_cast<std::size_t>((static_cast<int>(current_) + by % kItems + kItems) % kItems);
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (carried_ && pressed_) shown.underlays[name_] = lies_;
    shown.table.dots = places_;
    TableLine line{places_, kChalk, false};
    if (now_) line.points.push_back(*now_);
    if (places_.size() == 3 || (corners_ && line.points.size() == 4)) line.points.push_back(places_[0]);
    if (line.points.size() < 2) return shown;
    if (now_) shown.table.words.push_back({*now_, context.said(distance(places_.back(), *now_))});
    shown.table.lines.push_back(std::move(line));
    return shown;
  }
  Message hint() const override {
    if (corners_) return say("Click the other corners of the rectangle, one after the other.");
    if (asks()) return say("Say how far apart these places are on the paper.");
    return places_.size() == 1 ? say("Click the place at the other end.") : info(Command::Trace).hint;
  }
  bool begun() const override { return carried_ || !places_.empty(); }
  bool clicks() const override { return true; }

 private:
  bool asks() const { return places_.size() == 2 && !corners_; }
  GestureResult press(const PointerSample& sample, const GestureContext& context) {
    if (asks()) return {};  // the menu is open
    const Underlays& all = context.snapshot->document.underlays;
    const std::string* under = underlayAt(all, sample.place);
    if (places_.empty()) {
      if (!under)
        return {.why = all.empty() ? say("There is no scan yet: Work, Lay a scan under the pattern.")
                                   : say("There is no scan here; point at one.")};
      name_ = *under;
      lies_ = before_ = all.at(name_);
    } else if (!before_.holds(sample.place)) {
      return {.why = say("This place is not on the same scan.")};
    }
    pressed_ = sample.place;
    carried_ = false;
    return {};
  }
  void carry(const PointerSample& sample) {
    lies_ = before_;
    turned_ = sample.control;
    if (!turned_) return void(lies_.at = hundredth(before_.at + sample.place - *pressed_));
    const Flat from = *pressed_ - before_.at, to = sample.place - before_.at;
    lies_.turn = std::remainder(before_.turn + angleFrom(from, to), 2 * std::numbers::pi);
    lies_.turn = std::round(lies_.turn * 1e5) / 1e5;
  }
  GestureResult scaled(double apart, const GestureContext& context) const {
    LayUnderlay op;
    op.name = name_, op.between = places_, op.apart = Length{apart};
    // Grown over pieces that it lay clear of, it goes aside: left of all of them, as it first came.
    Underlay grown = before_;
    const Flat held = before_.inPicture(places_[0]);
    grown.width *= apart / distance(places_[0], places_[1]);
    grown.at += places_[0] - grown.onTable(held);
    if (covers(grown, context) && !covers(before_, context)) {
      constexpr double kClear = 0.05;  // metres between the scan and the pieces
      op.between.clear(), op.apart = {};
      op.width = Length{hundredth(grown.width)};
      op.at = hundredth(grown.at + Flat{leftOfAll(context) - kClear - boxOf(grown).high.u, 0});
    }
    return {.over = true, .operation = std::move(op)};
  }
  static FlatBox boxOf(const Underlay& lies) {
    FlatBox box;
    for (const Flat corner :
         {Flat{0, 0}, Flat{1.0 * lies.wide, 0}, Flat{0, 1.0 * lies.high}, Flat{1.0 * lies.wide, 1.0 * lies.high}})
      box.include(lies.onTable(corner));
    return box;
  }
  // Whether it comes to lie under a piece.
  static bool covers(const Underlay& lies, const GestureContext& context) {
    const FlatBox box = boxOf(lies);
    for (const auto& worn : context.snapshot->worn) {
      FlatBox piece;
      for (const Flat p : worn.ring) piece.include(p + context.table->at(worn.id));
      if (piece.low.u < box.high.u && box.low.u < piece.high.u && piece.low.v < box.high.v && box.low.v < piece.high.v)
        return true;
    }
    return false;
  }
  static double leftOfAll(const GestureContext& context) {
    double left = HUGE_VAL;
    for (const auto& worn : context.snapshot->worn)
      for (const Flat p : worn.ring) left = std::fmin(left, p.u + context.table->at(worn.id).u);
    return left;
  }

  std::string name_;
  Underlay before_, lies_;  // as it was when the hand came, and as the hand has it
  std::vector<Flat> places_;
  std::optional<Flat> pressed_, now_;
  bool carried_ = false, turned_ = false, corners_ = false, typing_ = false;
  std::size_t current_ = 0;
};

}  // namespace

std::unique_ptr<Gesture> traceGesture() { return std::make_unique<TraceGesture>(); }

}  // namespace karinui
