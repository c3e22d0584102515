// A dart by two clicks: the edge it opens at, and its tip inside the piece.
#include <algorithm>
#include <cmath>

#include "karinui/pattern/edit.h"
#include "session/gestures.h"

namespace karinui {

namespace {

class DartGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    const bool press = sample.phase == PointerSample::Phase::Press;
    if (sample.phase == PointerSample::Phase::Drag && !hit.edge) dragged_ = true;
    if (!mouth_) {
      hover_ = hit.edge;
      if (!press) return {};
      if (!hit.edge) return {.why = say("A dart begins on the edge of a piece.")};
      const double whole = lengthOf(context, {PieceRef(hit.edge->piece), hit.edge->edge});
      mouth_ = hit.edge;
      mouth_->fraction = roundShare(hit.edge->fraction, kMiddle / whole);
      tip_.reset();
      dragged_ = false;
      return {};
    }
    // Two clicks, or one drag from the edge to the tip.
    const bool release = sample.phase == PointerSample::Phase::Release, ends = press || (release && dragged_);
    if (release && !dragged_) return {};
    const bool table = sample.where == PointerSample::Where::Table;
    tip_.reset();
    why_.reset();
    if (table)
      tip_ = tenth(sample.place - context.table->at(mouth_->piece));
    else if (hit.piece == mouth_->piece && hit.on == Hit::On::Cloth)
      tip_ = tenth(hit.paper);
    if (!tip_) return ends ? GestureResult{.why = say("The dart ends inside the same piece.")} : GestureResult{};
    const Piece* piece = context.snapshot->document.find(mouth_->piece);
    const auto dart = addDart(*piece, mouth_->edge, mouth_->fraction, context.options.dartWidth, *tip_, "dart");
    if (!dart) why_ = dart.error().what;
    if (!ends) return {};
    if (why_) return {.why = why_};
    AddDart op;
    op.edge = {PieceRef(mouth_->piece), mouth_->edge};
    op.at = mouth_->fraction;
    op.tip = *tip_;
    op.width = {context.options.dartWidth};
    op.symmetric = sample.alt ? Choice::No : Choice::Auto;
    return {.over = true, .operation = std::move(op)};
  }
  bool takeBack() override { return std::exchange(mouth_, std::nullopt).has_value(); }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    const auto& on = mouth_ ? mouth_ : hover_;
    if (!on) return shown;
    const Piece* piece = context.snapshot->document.find(on->piece);
    const Edge* edge = piece ? findEdge(*piece, on->edge) : nullptr;
    if (!edge) return shown;
    const double whole = edge->curve.length(), half = context.options.dartWidth / 2 / whole;
    const Flat a = edge->curve.atFraction(std::clamp(on->fraction - half, 0.0, 1.0)),
               b = edge->curve.atFraction(std::clamp(on->fraction + half, 0.0, 1.0));
    const std::vector<Flat> wedge = mouth_ && tip_ ? std::vector<Flat>{a, *tip_, b} : std::vector<Flat>{a, b};
    showOnPaper(shown, context, on->piece, wedge, why_ ? kBad : mouth_ && tip_ ? kGood : kChalk);
    if (mouth_ && tip_)
      shown.table.words.push_back(
          {*tip_ + context.table->at(on->piece),
           context.said(context.options.dartWidth) + " × " + context.said(distance(lerp(a, b, 0.5), *tip_))});
    return shown;
  }
  Message hint() const override {
    if (why_) return *why_;
    return mouth_ ? say("Now click where the dart ends.") : info(Command::Dart).hint;
  }
  bool begun() const override { return mouth_.has_value(); }
  KeyStops keyStops() const override { return mouth_ ? KeyStops::Pieces : KeyStops::Edges; }
  bool clicks() const override { return true; }

 private:
  static constexpr double kMiddle = 0.004;  // metres from an edge's middle that mean the middle
  std::optional<EdgeNear> hover_, mouth_;
  std::optional<Flat> tip_;
  std::optional<Message> why_;
  bool dragged_ = false;  // off the edge, with the button held
};

}  // namespace

std::unique_ptr<Gesture> dartGesture() { return std::make_unique<DartGesture>(); }

}  // namespace karinui
