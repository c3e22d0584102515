// Pins: a click on the cloth puts one, a click on one takes it out; with Shift all along an edge.
#include "session/gestures.h"

namespace karinui {

namespace {

class PinGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    piece_ = hit.piece;
    edge_ = sample.shift ? hit.edge : std::nullopt;
    paper_ = tenth(hit.paper);
    there_.reset();
    if (piece_ && !edge_) {
      // In space a finger's breadth of cloth; on the table what is near under the pointer.
      double nearest = sample.where == PointerSample::Where::Table ? sample.reach : kNear;
      if (const auto pins = context.snapshot->document.pins.find(piece_); pins != context.snapshot->document.pins.end())
        for (const Flat pin : pins->second)
          if (const double away = distance(pin, hit.paper); away < nearest) nearest = away, there_ = pin;
    }
    if (sample.phase != PointerSample::Phase::Press) return {};
    if (!piece_ || (hit.on != Hit::On::Cloth && !edge_ && !there_))
      return {.why = say("Click on the cloth to pin it.")};
    if (there_) {
      UnpinCloth out;
      out.piece = piece_;
      out.at = {*there_};
      out.within = {0.001};
      return {.over = true, .operation = std::move(out)};
    }
    PinCloth pin;
    if (edge_) {
      pin.edges = {EdgeRef{PieceRef(edge_->piece), edge_->edge, 0, 1}};
    } else {
      pin.piece = piece_;
      pin.at = {paper_};
    }
    return {.over = true, .operation = std::move(pin)};
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (edge_) showEdge(shown, context, {PieceRef(edge_->piece), edge_->edge}, kChalk);
    if (!piece_ || edge_) return shown;
    const Flat at = there_.value_or(paper_);
    if (const auto place = spaceOf(*context.snapshot, piece_, at)) shown.space.dots.push_back(*place);
    shown.table.dots.push_back(at + context.table->at(piece_));
    return shown;
  }
  Message hint() const override { return there_ ? say("Click to take this pin out.") : info(Command::Pin).hint; }
  bool begun() const override { return false; }
  bool clicks() const override { return true; }

 private:
  static constexpr double kNear = 0.012;  // metres on the cloth
  PieceId piece_;
  std::optional<EdgeNear> edge_;
  Flat paper_;
  std::optional<Flat> there_;  // a pin under the pointer
};

}  // namespace

std::unique_ptr<Gesture> pinGesture() { return std::make_unique<PinGesture>(); }

}  // namespace karinui
