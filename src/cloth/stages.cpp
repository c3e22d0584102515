#include "cloth/stages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/strain.h"

namespace karinui {
namespace {

constexpr double kLongest = 1.0 / 30;   // seconds of a step
constexpr double kCreepLongest = 0.25;  // seconds of a step while cloth creeps
constexpr double kDamping = 0.002;      // share of the velocity taken off per step, growing,
constexpr int kDampAfter = 100;         // after so many steps: the long waves have run by then
constexpr double kLeastKept = 0.5;      // but never below this share
constexpr double kTieGap = 0.002;       // metres: nearer than this a pair is sewn,
constexpr double kTieShare = 0.1;       // or than this share of the spacing
constexpr int kSewSteps = 300, kSewIdle = 100;
constexpr double kGrownAStep = 0.1;    // spacings by which thinner colliders come out
constexpr int kGrownSteps = 10;        // more, by which cloth follows
constexpr int kGrowAfter = 10;         // steps without coming nearer, after which the closing force grows,
constexpr double kGrowth = 1.08;       // by this factor each step,
constexpr double kMostGrowth = 1000;   // to so many times at most
constexpr int kFallSteps = 40;         // steps without contact: the cloth falls
constexpr double kTorn = 10;           // times its length that a thread is drawn out: torn cloth,
constexpr int kTornAfter = 60;         // found after so many steps,
constexpr int kTornEvery = 20;         // every so many,
constexpr int kTornLooks = 3;          // so many times in a row
constexpr int kMostSeparations = 3;    // times intersections of cloth at rest are separated
constexpr int kStillSteps = 60;        // steps in which no node
constexpr double kStill = 1e-4;        // has gone farther than this, metres: still cloth;
constexpr double kStillDoubles = 200;  // twice as far after so many steps: what trembles so long does for ever

// The force that closes open seams grows while they come no nearer.
class SeamPullSchedule {
 public:
  explicit SeamPullSchedule(const LevelSolver& solver) : solver_(solver), narrowest_(gap()) {}
  void update() {  // after each step
    const double now = gap();
    idle_ = now < 0.98 * narrowest_ ? 0 : idle_ + 1;
    narrowest_ = std::fmin(narrowest_, now);
    if (idle_ > kGrowAfter) factor_ = std::fmin(kMostGrowth, kGrowth * factor_);
  }
  double factor() const { return factor_; }
  bool hopeless() const { return idle_ > kSewIdle; }

 private:
  double gap() const { return widestGap(solver_.cloth(), solver_.positions()); }
  const LevelSolver& solver_;
  double narrowest_, factor_ = 1;
  int idle_ = 0;
};

// Cloth none of whose nodes goes anywhere is at rest, though a node may tremble in a sharp fold for ever, where
// contacts come and go with the move they cause, and be out of balance at each step.
class Stillness {
 public:
  explicit Stillness(const LevelSolver& solver) : solver_(solver), from_(solver.positions()) {}
  bool update() {  // after each step: whether the last steps were still
    if (++steps_ < kStillSteps) return false;
    double most = 0;
    for (NodeIndex k : solver_.moving()) most = std::fmax(most, squaredLength(solver_.positions()[k] - from_[k]));
    from_ = solver_.positions();
    all_ += std::exchange(steps_, 0);
    return std::sqrt(most) < kStill * std::exp2(all_ / kStillDoubles);
  }

 private:
  const LevelSolver& solver_;
  std::vector<Vec3> from_;
  int steps_ = 0;  // since then
  double all_ = 0;
};

StageResult& record(StageResult& result, const LevelSolver::StepResult& step, const Token& token) {
  ++result.steps;
  result.solves += static_cast<std::size_t>(step.iterations);
  result.residual = step.residual;
  result.left = step.move;
  result.finite = step.finite;
  result.cancelled = token.cancelled();
  return result;
}

}  // namespace

StageResult closeSeams(LevelSolver& solver, const Token& token, const StepWatcher& watch) {
  StageResult result;
  LevelSolver::StepOptions options;
  options.seconds = kFrame;
  options.velocityKept = 0.9;
  options.mostMove = 0.5 * solver.cloth().spacing;
  options.friction = false;
  options.stopping = {40, 60, 0.1};
  const double tieGap = std::fmax(kTieGap, kTieShare * solver.cloth().spacing);
  SeamPullSchedule schedule(solver);
  for (int k = 0; k < kSewSteps && !solver.allTied(); ++k) {
    const auto step = solver.step(options, token);
    record(result, step, token);
    if (!result.finite || result.cancelled) return result;
    solver.tieWithin(tieGap);
    if (watch && !watch(k, step)) {
      result.stopped = true;
      return result;
    }
    schedule.update();
    if (schedule.hopeless()) break;
    options.seamPull = schedule.factor();
  }
  result.settled = solver.allTied();
  return result;
}

StageResult growColliders(LevelSolver& solver, std::span<ThinnerCollider> colliders, const Token& token,
                          const StepWatcher& watch) {
  StageResult result;
  LevelSolver::StepOptions options;
  options.seconds = kFrame;
  options.velocityKept = 0;
  options.mostMove = 0.5 * solver.cloth().spacing;
  options.stopping = {40, 60, 0.1};
  double most = 0;
  for (const ThinnerCollider& collider : colliders) most = std::fmax(most, collider.by());
  const int parts = static_cast<int>(std::ceil(most / (kGrownAStep * solver.cloth().spacing)));
  for (int k = 0; k < parts + kGrownSteps; ++k) {
    for (ThinnerCollider& collider : colliders) collider.setBy(most * std::max(0, parts - 1 - k) / parts);
    const auto step = solver.step(options, token);
    record(result, step, token);
    if (!result.finite || result.cancelled) return result;
    if (watch && !watch(k, step)) {
      for (ThinnerCollider& collider : colliders) collider.setBy(0);
      result.stopped = true;
      return result;
    }
  }
  result.settled = true;
  return result;
}

StageResult relax(LevelSolver& solver, Vec3 gravity, const RestCriteria& criteria, double firstSeconds,
                  const Token& token, const StepWatcher& watch, int stepsBefore) {
  StageResult result;
  LevelSolver::StepOptions options;
  options.seconds = firstSeconds;
  options.mostMove = solver.cloth().spacing;
  options.gravity = gravity;
  const bool canFall = solver.cloth().pinned.empty() && length(gravity) > 0 &&
                       std::all_of(solver.cloth().pieces.begin(), solver.cloth().pieces.end(),
                                   [](const ClothPiece& p) { return p.live; });
  int calm = 0, withoutContact = 0, separated = 0, drawnOut = 0;
  bool touched = false;
  // Coarse cloth is only on its way.
  const auto isTorn = [&] {
    return criteria.left > 0 && mostDrawnOut(solver.cloth(), solver.positions()).times > kTorn;
  };
  SeamPullSchedule schedule(solver);
  Stillness stillness(solver);
  for (int k = 0; k < criteria.mostSteps; ++k) {
    const int taken = stepsBefore + k;
    options.velocityKept = std::clamp(1 - kDamping * (taken - kDampAfter), kLeastKept, 1.0);
    options.damped = taken > kDampAfter;
    const bool refined = taken >= criteria.newtonAfter && (options.damped || options.seconds > kLongest);
    options.newton = refined ? criteria.newton : 1;
    const auto step = solver.step(options, token);
    record(result, step, token);
    if (!result.finite || result.cancelled) return result;
    if (!solver.allTied()) solver.tieWithin(kTieGap);
    if (criteria.sews && !solver.allTied()) {
      schedule.update();
      if (schedule.hopeless()) return result;
      options.seamPull = schedule.factor();
    }
    if (watch && !watch(k, step)) {
      result.stopped = true;
      return result;
    }
    if (taken >= kTornAfter && taken % kTornEvery == 0) {
      drawnOut = isTorn() ? drawnOut + 1 : 0;
      if (drawnOut == kTornLooks) {
        result.torn = true;
        return result;
      }
    }
    touched = touched || solver.touching() > 0;
    withoutContact = solver.touching() > 0 ? 0 : withoutContact + 1;
    if (canFall && touched && withoutContact > kFallSteps) {
      result.falls = true;
      return result;
    }
    // A longer step may move more at the same speed; what a long step would still move is tested below.
    const double allowed = criteria.move * std::fmax(1.0, options.seconds / kLongest);
    // Cloth that creeps in one direction is given longer steps; cloth that oscillates or snaps is not.
    if (step.shortened)
      options.seconds = std::fmax(0.25 * kFrame, 0.7 * options.seconds);
    else if (step.along > criteria.creep)
      options.seconds = std::fmin(kCreepLongest, 1.1 * options.seconds);
    else
      options.seconds = options.seconds > kLongest ? std::fmax(kLongest, 0.5 * options.seconds)
                                                   : std::fmin(kLongest, 1.1 * options.seconds);
    result.seconds = options.seconds;
    calm = step.move < allowed && step.residual < criteria.residual && solver.allTied() ? calm + 1 : 0;
    const bool still = stillness.update() && options.damped && solver.allTied();
    if (calm < criteria.calmSteps && !still) continue;
    if (criteria.left > 0 && !still) {
      LevelSolver::StepOptions longer = options;
      longer.seconds = 0.25;
      longer.damped = false;
      longer.stopping = {40, 1000, 0.01};
      const auto longStep = solver.predict(longer, token);
      result.solves += static_cast<std::size_t>(longStep.iterations);
      result.left = longStep.move;
      result.residual = longStep.residual;
      result.finite = longStep.finite;
      result.cancelled = token.cancelled();
      if (!result.finite || result.cancelled) return result;
      if (!(longStep.move < criteria.left && longStep.residual < criteria.residual)) {
        // The steps were calm because they were not solved well enough.
        options.stopping.tolerance = std::fmax(0.03, 0.5 * options.stopping.tolerance);
        calm = 0;
        continue;
      }
    }
    // The collision filter keeps sides apart along closest directions and may miss what folds sharply: look once more.
    if (separated < kMostSeparations && solver.separateIntersections()) {
      ++separated;
      calm = 0;
      continue;
    }
    result.torn = isTorn();
    result.settled = !result.torn;
    return result;
  }
  result.falls = canFall && solver.touching() == 0;
  return result;
}

}  // namespace karinui
