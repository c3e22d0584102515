// Working on the paper itself: corners dragged, edges bent or moved, points put on and taken away. What is done to one
// half of a symmetric piece is done to the other, unless Alt is held.
#include <algorithm>
#include <cmath>

#include "karinui/pattern/edit.h"
#include "karinui/pattern/symmetry.h"
#include "session/gestures.h"

namespace karinui {

namespace {

class PointsGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    if (sample.where != PointerSample::Where::Table) {
      if (sample.phase == PointerSample::Phase::Press) return {.why = say("Points are edited on the flat pattern.")};
      return {};
    }
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        hover_ = grip(hit, sample, context);
        putting_ = sample.control;
        return {};
      case PointerSample::Phase::Press:
        held_ = grip(hit, sample, context);
        if (!held_) return {.why = say("Take hold of a corner or an edge of the pattern.")};
        if (sample.control) return over(pointed(sample, context));
        before_ = context.snapshot->document.find(held_->piece)->outline;
        symmetry_ = symmetryOf(before_);
        now_ = before_;
        start_ = sample.place;
        why_.reset();
        return {};
      case PointerSample::Phase::Drag:
      case PointerSample::Phase::Release:
        break;
    }
    if (!held_) return {};
    alone_ = symmetry_ && !sample.alt && !hasImage(sample.shift);
    const Piece* piece = context.snapshot->document.find(held_->piece);
    if (!piece) return over({});
    const Flat lies = context.table->at(held_->piece), to = sample.place - lies;
    auto changed = held_->corner ? corner(*piece, to) : bent(*piece, to, sample.place - start_, sample.shift);
    if (changed && symmetry_ && !sample.alt)
      changed = checked(readable(onBothHalves(before_, *std::move(changed), *symmetry_)));
    why_.reset();
    if (changed)
      now_ = *changed;
    else
      why_ = changed.error().what;
    const bool moved = !(now_ == before_);
    ReshapePiece op;
    op.piece = held_->piece;
    op.outline = now_;
    if (sample.phase == PointerSample::Phase::Drag)
      return {.request = moved && !why_ ? PreviewRequest(OperationPreview{op, true}) : PreviewRequest{}};
    if (why_) return over({}, why_);
    if (!moved) return over({});
    return over(op, alone_ ? std::optional(onlyThisHalf()) : std::nullopt);
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    const auto& here = held_ ? held_ : hover_;
    if (!here) return shown;
    const Flat lies = context.table->at(here->piece);
    if (held_) {
      shown.outlines[held_->piece] = now_;
      const auto n = now_.find(held_->edge);
      if (n) {
        const Curve& curve = now_.edges[*n].curve;
        if (held_->corner) shown.table.dots.push_back(curve.start + lies);
        shown.table.words.push_back({curve.atFraction(0.5) + lies, context.said(curve.length())});
        if (held_->corner) {
          const Curve& other = now_.edges[(*n + now_.edges.size() - 1) % now_.edges.size()].curve;
          shown.table.words.push_back({other.atFraction(0.5) + lies, context.said(other.length())});
        }
      }
      return shown;
    }
    if (here->corner || putting_) shown.table.dots.push_back(here->place + lies);
    if (!here->corner) showEdge(shown, context, {PieceRef(here->piece), here->edge}, kChalk);
    return shown;
  }
  Message hint() const override {
    if (held_ && alone_ && !why_)
      return say("Only this half moves: the other has no such place, because of a slit or dart.");
    return why_ ? *why_ : info(Command::Points).hint;
  }
  bool begun() const override { return held_.has_value(); }
  KeyStops keyStops() const override { return KeyStops::Corners; }

 private:
  struct Grip {
    PieceId piece;
    std::string edge;  // that begins at the corner, or is held
    bool corner = false;
    double fraction = 0;
    Flat place;
  };
  // With Ctrl: a point more on the edge, or the corner taken away.
  Operation pointed(const PointerSample& sample, const GestureContext& context) const {
    const Outline& outline = context.snapshot->document.find(held_->piece)->outline;
    const std::size_t k = *outline.find(held_->edge), n = outline.edges.size();
    const Choice symmetric = sample.alt ? Choice::No : Choice::Auto;
    if (held_->corner)
      return JoinEdges{{PieceRef(held_->piece), outline.edges[(k + n - 1) % n].name}, symmetric, Choice::Yes};
    const double at = roundShare(held_->fraction, sample.reach / outline.edges[k].curve.length());
    return SplitEdge{{PieceRef(held_->piece), held_->edge}, at, symmetric};
  }
  // Whether the other half has what is held; `whole`: the edge with both its ends.
  bool hasImage(bool whole) const {
    const auto k = before_.find(held_->edge);
    if (!k) return true;
    if (held_->corner) return symmetry_->corner[*k].has_value();
    const std::size_t next = (*k + 1) % before_.edges.size();
    return symmetry_->partner[*k] || (whole && symmetry_->corner[*k] && symmetry_->corner[next]);
  }
  // Mirrored numbers without their noise; what did not move stays as it was.
  Outline readable(Outline outline) const {
    const auto clean = [](Flat& now, Flat was) {
      if (!(now == was)) now = {std::round(now.u * 1e7) / 1e7, std::round(now.v * 1e7) / 1e7};
    };
    for (std::size_t k = 0; k < outline.edges.size(); ++k) {
      Curve& now = outline.edges[k].curve;
      const Curve& was = before_.edges[k].curve;
      clean(now.start, was.start), clean(now.end, was.end);
      clean(now.control1, was.control1), clean(now.control2, was.control2);
    }
    return outline;
  }
  static std::optional<Grip> grip(const Hit& hit, const PointerSample& sample, const GestureContext& context) {
    if (!hit.edge) return std::nullopt;
    const Piece* piece = context.snapshot->document.find(hit.edge->piece);
    if (!piece) return std::nullopt;
    const Flat paper = sample.place - context.table->at(piece->id);
    Grip grip{piece->id, hit.edge->edge, false, hit.edge->fraction, paper};
    double nearest = 1.6 * sample.reach;
    for (const Edge& edge : piece->outline.edges)
      if (const double d = distance(edge.curve.start, paper); d < nearest)
        nearest = d, grip.edge = edge.name, grip.corner = true, grip.place = edge.curve.start;
    return grip;
  }

  Result<Outline> corner(const Piece& piece, Flat to) const {
    const Result<Piece> moved = moveCorner(piece, held_->edge, tenth(to));
    if (!moved) return moved.error();
    return checked(moved->outline);
  }

  // The edge drawn so that the place it was taken at comes under the hand; with Shift the whole edge goes along and its
  // neighbours follow at their ends.
  Result<Outline> bent(const Piece& piece, Flat to, Flat by, bool whole) const {
    if (whole) {
      const auto n = piece.outline.find(held_->edge);
      const Edge& edge = piece.outline.edges[*n];
      const Edge& next = piece.outline.edges[(*n + 1) % piece.outline.edges.size()];
      const Result<Piece> first = moveCorner(piece, edge.name, tenth(edge.curve.start + by));
      if (!first) return first.error();
      const Result<Piece> both = moveCorner(*first, next.name, tenth(next.curve.start + by));
      if (!both) return both.error();
      return checked(both->outline);
    }
    Outline outline = piece.outline;
    Curve& curve = outline.edges[*outline.find(held_->edge)].curve;
    const double t = std::clamp(curve.parameterAt(held_->fraction * curve.length()), 0.1, 0.9);
    const double s = 1 - t, share = 3 * s * s * t + 3 * s * t * t;
    if (curve.kind != Curve::Kind::Cubic) {
      const Curve half = curve;
      curve = Curve::cubic(half.start, half.at(1.0 / 3), half.at(2.0 / 3), half.end);
    }
    const Flat miss = (to - curve.at(t)) * (1 / share);
    curve.control1 = tenth(curve.control1 + miss);
    curve.control2 = tenth(curve.control2 + miss);
    return checked(std::move(outline));
  }

  GestureResult over(std::optional<Operation> operation, std::optional<Message> why = {}) {
    held_.reset();
    return {.over = true, .operation = std::move(operation), .why = std::move(why)};
  }

  std::optional<Grip> hover_, held_;
  std::optional<PaperSymmetry> symmetry_;
  bool putting_ = false;
  bool alone_ = false;  // the other half has no such corner or edge
  Outline before_, now_;
  Flat start_;
  std::optional<Message> why_;
};

}  // namespace

std::unique_ptr<Gesture> pointsGesture() { return std::make_unique<PointsGesture>(); }

}  // namespace karinui
