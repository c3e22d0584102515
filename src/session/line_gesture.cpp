// Lines inside a piece: clicks make a line of straight parts, a drag a curve. Enter, or a click where it ended, is the
// end; a drag ends with its release. It is drawn on the symmetric copy too, unless Alt is held. A click near an edge is
// on it; with Shift the part is level, upright or half-way between. Elsewhere a place is as round as the pixels tell;
// over a scan, and with Ctrl, it is as fine as the hand.
#include <cmath>
#include <numbers>

#include "karinui/geometry/polygon.h"
#include "karinui/pattern/symmetry.h"
#include "session/gestures.h"

namespace karinui {

namespace {

class LineGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    const bool table = sample.where == PointerSample::Where::Table;
    std::optional<Flat> paper;
    if (table && (piece_ || hit.piece)) paper = sample.place - context.table->at(piece_ ? piece_ : hit.piece);
    if (!table && hit.on == Hit::On::Cloth && (!piece_ || hit.piece == piece_)) paper = hit.paper;
    const bool drags = sample.phase == PointerSample::Phase::Drag;
    middle_.reset();
    if (const Piece* piece = context.snapshot->document.find(piece_ ? piece_ : hit.piece);
        paper && piece && !sample.control)
      middle_ = middleNear(*piece, *paper, nearMiddle(sample, hit));
    on_ = piece_ ? piece_ : hit.piece;
    const auto end = paper ? std::optional(drags                        ? tenth(*paper)
                                           : middle_ && !turned(sample) ? middle_->place
                                           : table                      ? meant(sample, hit, context, *paper)
                                                                        : tenth(*paper))
                           : std::nullopt;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        now_ = end;
        return {};
      case PointerSample::Phase::Press:
        if (!end || !hit.piece) return {.why = say("A line lies inside a piece.")};
        if (!along_.empty() && distance(along_.back(), *end) < kSame)
          return along_.size() > 1 ? finished() : GestureResult{};
        piece_ = hit.piece;
        alone_ = alone_ || sample.alt;
        along_.push_back(*end);
        stroke_ = {*end};
        alongAxis_ = middle_ && middle_->onAxis;
        now_.reset();
        return {};
      case PointerSample::Phase::Drag:
        if (end && !stroke_.empty() && distance(stroke_.back(), *end) > kStep) stroke_.push_back(*end);
        alongAxis_ = alongAxis_ && middle_ && middle_->onAxis;
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    const auto stroke = std::exchange(stroke_, {});
    if (along_.size() != 1 || stroke.size() < 3) return {};
    along_.clear();
    for (const std::size_t i : mattering<Flat>(stroke, kMiss)) along_.push_back(stroke[i]);
    if (end && middle_ && alongAxis_) along_ = {stroke.front(), *end};  // all along the middle line
    if (end && middle_) along_.back() = *end;
    smooth_ = along_.size() > 2;
    return finished();
  }
  GestureResult confirm(const GestureContext&) override {
    if (along_.size() < 2) return {.why = say("A line needs at least two places.")};
    return finished();
  }
  bool takeBack() override {
    if (along_.empty()) return false;
    along_.pop_back();
    stroke_.clear();
    if (along_.empty()) piece_ = {}, alone_ = false;
    return true;
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (middle_ && on_) showMiddle(shown, context, on_, *middle_);
    if (!piece_) return shown;
    std::vector<Flat> line = along_;
    line.insert(line.end(), stroke_.begin(), stroke_.end());
    if (now_) line.push_back(*now_);
    showOnPaper(shown, context, piece_, line, kChalk);
    if (!alone_) showOnCopies(shown, context, piece_, line);
    double length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance(line[i], line[i + 1]);
    if (length > 0) shown.table.words.push_back({line.back() + context.table->at(piece_), context.said(length)});
    return shown;
  }
  Message hint() const override { return middle_ ? say("{0} {1}", middle_->said(), usualHint()) : usualHint(); }
  bool begun() const override { return static_cast<bool>(piece_); }
  bool clicks() const override { return true; }

 private:
  Message usualHint() const {
    if (!piece_) return info(Command::Line).hint;
    return along_.size() < 2 ? say("Click on; with Shift the line is level, upright or half-way between, with Ctrl "
                                   "exactly where the hand is.")
                             : say("Click on, and Enter ends the line; Ctrl: exactly where the hand is.");
  }
  // With Shift the way is given; it may lead to the middle line.
  bool turned(const PointerSample& sample) const { return sample.shift && !along_.empty(); }
  static constexpr double kSame = 0.003, kStep = 0.003, kMiss = 0.001;  // metres
  GestureResult finished() {
    AddLine line;
    line.piece = piece_;
    line.along = along_;
    line.smooth = smooth_;
    if (alone_) line.copies = Choice::No;
    return {.over = true, .operation = std::move(line)};
  }
  Flat meant(const PointerSample& sample, const Hit& hit, const GestureContext& context, Flat paper) const {
    const Document& document = context.snapshot->document;
    const bool traced = underlayAt(document.underlays, sample.place);
    const double step = traced || sample.control ? 0 : roundness(sample.reach);
    const auto whole = [&](double metres) { return step > 0 ? std::round(metres / step) * step : metres; };
    Flat place{whole(paper.u), whole(paper.v)};
    std::optional<Flat> way;
    if (sample.shift && !along_.empty()) {
      constexpr double kEighth = std::numbers::pi / 4;
      const Flat there = paper - along_.back();
      const double a = std::round(std::atan2(there.v, there.u) / kEighth) * kEighth;
      way = Flat{std::cos(a), std::sin(a)};
      place = along_.back() + *way * whole(dot(there, *way));
    }
    const Piece* piece = document.find(piece_ ? piece_ : hit.piece);
    if (way && piece && middle_ && middle_->onAxis)
      if (const auto symmetry = symmetryOf(piece->outline); symmetry && std::fabs(cross(*way, symmetry->axis)) > 1e-3) {
        const Flat there = along_.back() + *way * (cross(symmetry->through - along_.back(), symmetry->axis) /
                                                   cross(*way, symmetry->axis));
        if (distance(there, paper) < 2 * nearMiddle(sample, hit)) return exact(there);
      }
    return tenth(piece && !traced && !sample.control ? onEdge(*piece, sample.reach, paper, place, way) : place);
  }
  // The place on an edge that is near the hand, beside `place` or, where a way is kept to, on it; else `place`.
  Flat onEdge(const Piece& piece, double reach, Flat paper, Flat place, std::optional<Flat> way) const {
    double nearest = kNear * reach;
    Flat found = place;
    for (const Edge& edge : piece.outline.edges) {
      const auto points = edge.curve.flattened(1e-5);
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double away = distanceToSegment(points[k], points[k + 1], paper);
        if (away >= nearest) continue;
        const Flat along = points[k + 1] - points[k];
        double share = std::clamp(dot(place - points[k], along) / dot(along, along), 0.0, 1.0);
        if (way) {
          const double across = cross(*way, along);
          if (std::fabs(across) < 1e-6 * length(along)) continue;
          share = cross(*way, along_.back() - points[k]) / across;
          if (share < 0 || share > 1) continue;
        }
        nearest = away, found = points[k] + along * share;
      }
    }
    return found;
  }
  // Metres that places are whole multiples of, by how far the hand reaches.
  static double roundness(double reach) { return reach > 9e-3 ? 5e-3 : reach > 1.8e-3 ? 1e-3 : 0; }

  static constexpr double kNear = 0.45;  // of the reach: so near an edge a click is meant to lie on it
  PieceId piece_;
  std::vector<Flat> along_, stroke_;
  std::optional<Flat> now_;
  std::optional<MiddleSnap> middle_;     // where the hand is
  PieceId on_;                           // of which piece
  bool alongAxis_ = false;               // the drag has kept to the middle line
  bool smooth_ = false, alone_ = false;  // alone: not on the symmetric copy
};

}  // namespace

std::unique_ptr<Gesture> lineGesture() { return std::make_unique<LineGesture>(); }

}  // namespace karinui
