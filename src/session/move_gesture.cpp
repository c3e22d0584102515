// Carrying and turning a piece as a rigid thing. Near another outline the nearest corners (or else edges) meet.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kSnaps = 0.015;  // metres, as seen
constexpr double kDeep = 0.08;    // metres a snap may draw the piece nearer or further

class MoveGesture : public Gesture {
 public:
  Told feed(const PointerSample& sample, const Hit& hit, const Workbench& bench) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        over_ = hit.piece;
        return {};
      case PointerSample::Phase::Press: {
        if (!hit.piece) return {.why = say("Take hold of a piece to move it.")};
        held_ = hit.piece;
        onTable_ = sample.where == PointerSample::Where::Table;
        turning_ = sample.control;
        from_ = hit.on == Hit::On::Cloth ? hit.point : spaceOf(*bench.fitting, held_, hit.paper).value_or(hit.point);
        fromTable_ = sample.place;
        facing_ = sample.facing;
        start_ = onFacing(sample, from_);
        rigid_ = {};
        by_ = {};
        turn_ = 0;
        snapped_.reset();
        middle_ = middleOf(bench);
        collect(bench);
        return {};
      }
      case PointerSample::Phase::Drag:
      case PointerSample::Phase::Release:
        break;
    }
    if (!held_) return {};
    if (onTable_) {
      aside_ = {held_, sample.place - fromTable_};
      fromTable_ = sample.place;
      if (sample.phase == PointerSample::Phase::Release) return finished({});
      return {};
    }
    const Vec3 now = onFacing(sample, start_);
    snapped_.reset();
    if (turning_) {
      const Vec3 a = start_ - middle_, b = now - middle_;
      turn_ = std::atan2(dot(cross(a, b), facing_), dot(a - facing_ * dot(a, facing_), b));
      turn_ = std::round(turn_ * 1800 / std::numbers::pi) / 1800 * std::numbers::pi;  // tenths of a degree
      rigid_ = turnAbout(facing_, turn_);
      rigid_.carry = middle_ - rigid_.turned(middle_);
    } else {
      by_ = tenth(now - start_);
      if (!sample.alt) snap();
      rigid_ = {};
      rigid_.carry = by_;
    }
    if (sample.phase != PointerSample::Phase::Release) return {};
    MovePiece move;
    move.pieces = {PieceRef(held_)};
    if (turning_) {
      if (turn_ == 0) return finished({});
      move.turn = Turn{facing_, {turn_}};
    } else {
      if (length(by_) < 5e-4) return finished({});
      move.by = by_;
    }
    return finished(std::move(move));
  }

  Preview preview(const Workbench& bench) const override {
    Preview shown;
    if (!held_) {
      if (const Piece* piece = bench.fitting->document.find(over_))
        for (const Edge& edge : piece->outline.edges) showEdge(shown, bench, {PieceRef(over_), edge.name}, kChalk);
      return shown;
    }
    if (onTable_) return shown;
    shown.carried[held_] = rigid_;
    if (snapped_) shown.space.dots.push_back(*snapped_);
    if (!turning_ && length(by_) > 0) {
      shown.space.lines.push_back({{start_, start_ + by_}, kChalk, 2, true});
      shown.space.words.push_back({start_ + by_, bench.said(length(by_))});
    } else if (turning_) {
      shown.space.words.push_back({middle_, std::to_string(std::lround(turn_ * 180 / std::numbers::pi)) + "°"});
    }
    return shown;
  }
  Message hint() const override {
    if (snapped_) return say("Corner meets corner; hold Alt to place it freely.");
    return info(Command::Move).hint;
  }
  bool begun() const override { return static_cast<bool>(held_); }
  std::optional<std::pair<PieceId, Flat>> laidAside() override { return std::exchange(aside_, std::nullopt); }

 private:
  Told finished(std::optional<Operation> operation) {
    held_ = {};
    return {.over = true, .operation = std::move(operation)};
  }

  Vec3 middleOf(const Workbench& bench) const {
    const Piece* piece = bench.fitting->document.find(held_);
    const Ring ring = piece->outline.flattened(1e-3);
    Flat low = ring.front(), high = low;
    for (const Flat p : ring) {
      low = {std::fmin(low.u, p.u), std::fmin(low.v, p.v)};
      high = {std::fmax(high.u, p.u), std::fmax(high.v, p.v)};
    }
    return Stand(*piece)(lerp(low, high, 0.5));
  }

  // Corners of the piece in hand, corners and outlines of the others.
  void collect(const Workbench& bench) {
    mine_.clear();
    theirs_.clear();
    for (const auto& [id, piece] : bench.fitting->document.pattern.pieces) {
      const Stand stand(*piece);
      for (const Edge& edge : piece->outline.edges) (id == held_ ? mine_ : theirs_).push_back(stand(edge.curve.start));
    }
  }

  void snap() {
    double nearest = kSnaps;
    Vec3 step;
    for (const Vec3 a : mine_)
      for (const Vec3 b : theirs_)
        if (const Vec3 way = b - (a + by_); std::fabs(dot(way, facing_)) < kDeep)
          if (const double d = length(way - facing_ * dot(way, facing_)); d < nearest)
            nearest = d, step = way, snapped_ = b;
    if (snapped_) by_ = tenth(by_ + step);
  }

  PieceId held_, over_;
  bool onTable_ = false, turning_ = false;
  Vec3 from_, start_, facing_, middle_, by_;
  Flat fromTable_;
  double turn_ = 0;
  Rigid rigid_;
  std::optional<Vec3> snapped_;
  std::vector<Vec3> mine_, theirs_;
  std::optional<std::pair<PieceId, Flat>> aside_;
};

}  // namespace

std::unique_ptr<Gesture> moveGesture() { return std::make_unique<MoveGesture>(); }

}  // namespace karinui
