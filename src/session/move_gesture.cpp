// Carrying and turning a piece as a rigid thing: by a ray either in the plane that faces who looks, by a tip both at
// once with all six degrees of freedom. Of several chosen pieces all go along. Near another piece corners meet, or else
// outline meets outline.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/session/touch_scene_of.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kSnaps = 0.015;  // metres, as seen; of a tip in space
constexpr double kAlong = 0.006;  // metres between places of an outline
constexpr double kDeep = 0.08;    // metres a snap may draw the piece nearer or further

class MoveGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        over_ = hit.piece;
        return {};
      case PointerSample::Phase::Press: {
        if (!hit.piece) return {.why = say("Take hold of a piece to move it.")};
        held_ = hit.piece;
        together_ = {held_};
        if (context.chosen && context.chosen->contains(held_)) together_ = *context.chosen;
        onTable_ = sample.where == PointerSample::Where::Table;
        turning_ = sample.control && !sample.tip;
        from_ = hit.on == Hit::On::Cloth ? hit.point : spaceOf(*context.snapshot, held_, hit.paper).value_or(hit.point);
        fromTable_ = sample.place;
        aside_.reset(), laid_ = {};
        facing_ = sample.facing;
        start_ = handAt(sample, from_);
        pressed_ = sample;
        axis_ = facing_;
        rigid_ = {};
        by_ = {};
        turn_ = 0;
        snapped_.reset();
        middle_ = middleOf(context);
        collect(context);
        return {};
      }
      case PointerSample::Phase::Drag:
      case PointerSample::Phase::Release:
        break;
    }
    if (!held_) return {};
    if (onTable_) {
      aside_ = {together_, sample.place - fromTable_};
      laid_ += aside_->by;
      fromTable_ = sample.place;
      if (sample.phase == PointerSample::Phase::Release) return finished({});
      return {};
    }
    snapped_.reset();
    if (turning_) {
      const Vec3 a = start_ - middle_, b = onFacing(sample, start_) - middle_;
      turn_ = tenthOfDegree(std::atan2(dot(cross(a, b), facing_), dot(a - facing_ * dot(a, facing_), b)));
      by_ = {};
    } else if (const auto motion = tipMotion(pressed_, sample)) {
      const Vec3 axis = Vec3{motion->x, motion->y, motion->z} * (motion->w < 0 ? -1 : 1);  // the shorter way round
      turn_ = tenthOfDegree(2 * std::atan2(length(axis), std::fabs(motion->w)));
      axis_ = turn_ != 0 ? tenth(normalized(axis)) : facing_;
      by_ = tenth((*motion)(middle_)-middle_);
    } else {
      by_ = tenth(handAt(sample, start_) - start_);
    }
    turned_ = turnAbout(axis_, turn_);
    turned_.carry = middle_ - turned_.turned(middle_);
    if (!turning_ && !sample.alt) snap();
    rigid_ = turned_;
    rigid_.carry += by_;
    if (sample.phase != PointerSample::Phase::Release) return {};
    MovePiece move;
    move.pieces = {PieceRef(held_)};  // first, for they turn about its middle
    for (const PieceId id : together_)
      if (id != held_) move.pieces.push_back(PieceRef(id));
    if (turn_ != 0) move.turn = Turn{axis_, {turn_}};
    if (length(by_) >= 5e-4) move.by = by_;
    if (!move.turn && length(move.by) == 0) return finished({});
    return finished(std::move(move));
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (!held_) {
      if (const Piece* piece = context.snapshot->document.find(over_))
        for (const Edge& edge : piece->outline.edges) showEdge(shown, context, {PieceRef(over_), edge.name}, kChalk);
      return shown;
    }
    if (onTable_) return shown;
    for (const PieceId id : together_) shown.carried[id] = rigid_;
    if (snapped_) shown.space.dots.push_back(*snapped_);
    if (!turning_ && length(by_) > 0) {
      shown.space.lines.push_back({{start_, start_ + by_}, kChalk, 2, true});
      shown.space.words.push_back({start_ + by_, context.said(length(by_))});
    }
    if (turning_ || turn_ != 0) {
      shown.space.words.push_back({middle_, std::to_string(std::lround(turn_ * 180 / std::numbers::pi)) + "°"});
    }
    return shown;
  }
  Message hint() const override {
    if (snapped_ && onCorner_) return say("Corner meets corner; hold Alt to place it freely.");
    if (snapped_) return say("Outline meets outline; hold Alt to place it freely.");
    return info(Command::Move).hint;
  }
  bool begun() const override { return static_cast<bool>(held_); }
  void addTo(Handling& handling) const override {
    if (!held_ || onTable_) return;
    handling.carried = together_;
    if (snapped_) handling.snap = onCorner_ ? 2 : 1;
  }
  KeyStops keyStops() const override { return held_ ? KeyStops::Corners : KeyStops::Pieces; }
  std::optional<Aside> laidAside() override { return std::exchange(aside_, std::nullopt); }
  std::optional<Aside> putBack() override {
    if (!held_ || !onTable_) return std::nullopt;
    return Aside{together_, Flat{} - laid_};
  }

 private:
  static double tenthOfDegree(double radians) {
    return std::round(radians * 1800 / std::numbers::pi) / 1800 * std::numbers::pi;
  }
  GestureResult finished(std::optional<Operation> operation) {
    held_ = {};
    return {.over = true, .operation = std::move(operation)};
  }

  Vec3 middleOf(const GestureContext& context) const {
    const Piece* piece = context.snapshot->document.find(held_);
    const FlatBox box = boxOf(piece->outline.flattened(1e-3));
    return Stand(*piece)(lerp(box.low, box.high, 0.5));
  }

  // A few lines beside each other and a ball about them: where that is far, so is each of them.
  struct Ball {
    Vec3 middle;
    double radius = 0;
    std::size_t first = 0, end = 0;
  };
  static std::vector<Ball> ballsOf(const std::vector<std::pair<Vec3, Vec3>>& lines) {
    constexpr std::size_t kLines = 16;
    std::vector<Ball> balls;
    for (std::size_t first = 0; first < lines.size(); first += kLines) {
      Ball ball{{}, 0, first, std::min(first + kLines, lines.size())};
      for (std::size_t i = first; i < ball.end; ++i)
        ball.middle += (lines[i].first + lines[i].second) * (0.5 / static_cast<double>(ball.end - first));
      for (std::size_t i = first; i < ball.end; ++i)
        ball.radius =
            std::max({ball.radius, distance(ball.middle, lines[i].first), distance(ball.middle, lines[i].second)});
      balls.push_back(ball);
    }
    return balls;
  }

  // Corners of the pieces in hand, corners and outlines of the others.
  void collect(const GestureContext& context) {
    mine_.clear();
    theirs_.clear();
    myOutline_.clear();
    theirOutline_.clear();
    for (const auto& [id, piece] : context.snapshot->document.pattern.pieces) {
      const Stand stand(*piece);
      const bool mine = together_.contains(id);
      for (const Edge& edge : piece->outline.edges) {
        const Vec3 corner = stand(edge.curve.start);
        mine ? mine_.push_back(corner) : theirs_.push_back({corner, corner});
        const int steps = std::max(1, static_cast<int>(edge.curve.length() / kAlong));
        Vec3 before = corner;
        for (const Flat p : edge.curve.evenly(0, 1, steps)) {
          const Vec3 next = stand(p);
          mine ? myOutline_.push_back(next) : theirOutline_.push_back({before, next});
          before = next;
        }
      }
    }
    theirBalls_ = ballsOf(theirs_);
    outlineBalls_ = ballsOf(theirOutline_);
  }

  void snap() {
    onCorner_ = meet(mine_, theirs_, theirBalls_);
    if (!onCorner_) meet(myOutline_, theirOutline_, outlineBalls_);
  }
  // Brings the nearest place of mine and of their lines together, as seen; false: none is near.
  bool meet(const std::vector<Vec3>& mine, const std::vector<std::pair<Vec3, Vec3>>& theirs,
            const std::vector<Ball>& balls) {
    const auto flat = [&](Vec3 v) { return pressed_.tip ? v : v - facing_ * dot(v, facing_); };
    double nearest = kSnaps * kSnaps;
    Vec3 step;
    for (const Vec3 place : mine) {
      const Vec3 at = turned_(place) + by_;
      for (const Ball& ball : balls) {
        const double reach = ball.radius * (1 + 1e-9) + kSnaps;
        if (squaredLength(flat(ball.middle - at)) > reach * reach) continue;
        for (std::size_t i = ball.first; i < ball.end; ++i) {
          const auto& [from, to] = theirs[i];
          const Vec3 start = from - at, side = flat(to - from);
          const double ss = squaredLength(side);
          const double t = ss > 0 ? std::clamp(-dot(flat(start), side) / ss, 0.0, 1.0) : 0;
          const Vec3 way = start + (to - from) * t;
          if (std::fabs(dot(way, facing_)) > kDeep) continue;
          if (const double d = squaredLength(flat(way)); d < nearest)
            nearest = d, step = way, snapped_ = from + (to - from) * t;
        }
      }
    }
    if (snapped_) by_ = tenth(by_ + step);
    return snapped_.has_value();
  }

  PieceId held_, over_;
  std::set<PieceId> together_;  // with what else is chosen
  bool onTable_ = false, turning_ = false;
  Vec3 from_, start_, facing_, middle_, by_;
  Flat fromTable_;
  PointerSample pressed_;
  Vec3 axis_;
  double turn_ = 0;
  Rigid turned_, rigid_;  // about its middle; and carried
  std::optional<Vec3> snapped_;
  bool onCorner_ = false;
  std::vector<Vec3> mine_, myOutline_;  // corners; places all along
  std::vector<std::pair<Vec3, Vec3>> theirs_, theirOutline_;
  std::vector<Ball> theirBalls_, outlineBalls_;
  std::optional<Aside> aside_;
  Flat laid_;  // on the table, since it was taken hold of
};

}  // namespace

std::unique_ptr<Gesture> moveGesture() { return std::make_unique<MoveGesture>(); }

}  // namespace karinui
