// A dart by two clicks or one drag: from the edge it opens at to its tip, or, begun inside the piece, from one of its
// two points to the other.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/pattern/edit.h"
#include "session/gestures.h"

namespace karinui {

namespace {

class DartGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    const bool press = sample.phase == PointerSample::Phase::Press;
    if (sample.phase == PointerSample::Phase::Drag && (!hit.edge || point_)) dragged_ = true;
    if (!piece_) {
      hover_ = hit.edge;
      return press ? begin(sample, hit, context) : GestureResult{};
    }
    // Two clicks, or one drag.
    const bool release = sample.phase == PointerSample::Phase::Release, ends = press || (release && dragged_);
    if (release && !dragged_) return {};
    tip_ = placeOn(piece_, sample, hit, context);
    why_.reset();
    if (tip_ && point_ && sample.shift) tip_ = straight(*tip_);
    if (release && point_ && tip_ && distance(*tip_, *point_) < kClick) {  // the hand shook
      dragged_ = false, tip_.reset();
      return {};
    }
    if (!tip_) return ends ? GestureResult{.why = say("The dart ends inside the same piece.")} : GestureResult{};
    const Piece& piece = *context.snapshot->document.find(piece_);
    const double width = context.options.dartWidth;
    if (point_) {
      if (const auto made = addDoubleDart(piece, *point_, *tip_, width, 0.5, "dart", {}); !made)
        why_ = made.error().what;
    } else if (const auto made = addDart(piece, mouth_.edge, mouth_.fraction, width, *tip_, "dart"); !made) {
      why_ = made.error().what;
    }
    if (!ends) return {};
    if (why_) return {.why = why_};
    return {.over = true, .operation = made(context, sample.alt ? Choice::No : Choice::Auto)};
  }
  bool takeBack() override {
    point_.reset();
    return static_cast<bool>(std::exchange(piece_, {}));
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    const PieceId id = piece_ ? piece_ : hover_ ? hover_->piece : PieceId();
    if (!context.snapshot->document.find(id)) return shown;
    const Colour& colour = why_ ? kBad : piece_ && tip_ ? kGood : kChalk;
    const double width = context.options.dartWidth;
    std::vector<Flat> wedge = point_ ? kite(width) : opening(context, piece_ ? mouth_ : *hover_, width);
    if (!point_ && piece_ && tip_) wedge.insert(wedge.begin() + 1, *tip_);
    showOnPaper(shown, context, id, wedge, colour);
    if (piece_ && tip_) {
      const Flat start = point_ ? *point_ : lerp(wedge.front(), wedge.back(), 0.5);
      shown.table.words.push_back(
          {*tip_ + context.table->at(id), context.said(width) + " × " + context.said(distance(start, *tip_))});
    }
    return shown;
  }
  Message hint() const override {
    if (why_) return *why_;
    if (point_) return say("Now click the dart's other point; with Shift it is level, upright or half-way between.");
    return piece_ ? say("Now click where the dart ends.") : info(Command::Dart).hint;
  }
  bool begun() const override { return static_cast<bool>(piece_); }
  KeyStops keyStops() const override { return piece_ ? KeyStops::Pieces : KeyStops::Edges; }
  bool clicks() const override { return true; }

 private:
  static constexpr double kMiddle = 0.004;  // metres from an edge's middle that mean the middle
  static constexpr double kClick = 0.01;    // metres that a hand moves in a click

  GestureResult begin(const PointerSample& sample, const Hit& hit, const GestureContext& context) {
    tip_.reset(), point_.reset(), dragged_ = false;
    if (hit.edge) {
      piece_ = hit.edge->piece, mouth_ = *hit.edge;
      mouth_.fraction = roundShare(mouth_.fraction, kMiddle / lengthOf(context, {PieceRef(piece_), mouth_.edge}));
      return {};
    }
    point_ = placeOn(hit.piece, sample, hit, context);
    if (!point_) return {.why = say("A dart begins on the edge of a piece or inside it.")};
    piece_ = hit.piece;
    return {};
  }
  static std::optional<Flat> placeOn(PieceId piece, const PointerSample& sample, const Hit& hit,
                                     const GestureContext& context) {
    if (!piece) return std::nullopt;
    if (sample.where == PointerSample::Where::Table) return tenth(sample.place - context.table->at(piece));
    return hit.piece == piece && hit.on == Hit::On::Cloth ? std::optional(tenth(hit.paper)) : std::nullopt;
  }
  // In the nearest of the eight directions of the compass.
  Flat straight(Flat place) const {
    constexpr double kEighth = std::numbers::pi / 4;
    const Flat there = place - *point_;
    const double turn = std::round(std::atan2(there.v, there.u) / kEighth) * kEighth;
    const Flat way{std::cos(turn), std::sin(turn)};
    return tenth(*point_ + way * dot(there, way));
  }
  static std::vector<Flat> opening(const GestureContext& context, const EdgeNear& at, double width) {
    const Edge* edge = findEdge(*context.snapshot->document.find(at.piece), at.edge);
    if (!edge) return {};
    const double half = width / 2 / edge->curve.length();
    return {edge->curve.atFraction(std::clamp(at.fraction - half, 0.0, 1.0)),
            edge->curve.atFraction(std::clamp(at.fraction + half, 0.0, 1.0))};
  }
  std::vector<Flat> kite(double width) const {
    if (!tip_ || distance(*tip_, *point_) < kShortestDrag) return {*point_};
    const Flat middle = lerp(*point_, *tip_, 0.5), half = leftOf(normalized(*tip_ - *point_)) * (width / 2);
    return {*point_, middle - half, *tip_, middle + half, *point_};
  }
  Operation made(const GestureContext& context, Choice symmetric) const {
    const Length width{context.options.dartWidth};
    if (point_) {
      AddDoubleDart op;
      op.piece = piece_, op.from = *point_, op.to = *tip_, op.width = width, op.symmetric = symmetric;
      return op;
    }
    AddDart op;
    op.edge = {PieceRef(piece_), mouth_.edge};
    op.at = mouth_.fraction, op.tip = *tip_, op.width = width, op.symmetric = symmetric;
    return op;
  }

  std::optional<EdgeNear> hover_;
  PieceId piece_;              // in which it was begun,
  EdgeNear mouth_;             // at an edge
  std::optional<Flat> point_;  // or at a point inside
  std::optional<Flat> tip_;
  std::optional<Message> why_;
  bool dragged_ = false;  // away from where it began, with the button held
};

}  // namespace

std::unique_ptr<Gesture> dartGesture() { return std::make_unique<DartGesture>(); }

}  // namespace karinui
