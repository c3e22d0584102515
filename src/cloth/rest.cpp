#include "cloth/rest.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr double kLongest = 1.0 / 30;   // seconds of a step
constexpr double kCreep = 0.9;          // cosine between steps
constexpr double kCreepLongest = 0.25;  // seconds of a step while cloth creeps
constexpr double kCalming = 0.002;      // share of the velocity taken off per step, growing,
constexpr int kCalmAfter = 100;         // after so many steps: the long waves have run by then
constexpr double kKept = 0.5;           // but never below this share
constexpr double kTieGap = 0.002;       // metres: nearer than this a pair is sewn,
constexpr double kTieShare = 0.1;       // or than this share of the spacing
constexpr int kSewSteps = 300, kSewIdle = 100;
constexpr int kFirmAfter = 10;     // steps without getting nearer, after which open seams are drawn together firmer,
constexpr double kFirmer = 1.08;   // each step so much,
constexpr double kFirmest = 1000;  // up to so many times
constexpr int kFallSteps = 40;     // steps on nothing at all
constexpr int kUntangles = 3;      // times cloth at rest that stands crossed is taken apart

// Open seams are drawn together the firmer the longer they come no nearer.
class Drawing {
 public:
  explicit Drawing(const LevelSolver& solver) : solver_(solver), narrowest_(gap()) {}
  void look() {  // after each step
    const double now = gap();
    idle_ = now < 0.98 * narrowest_ ? 0 : idle_ + 1;
    narrowest_ = std::fmin(narrowest_, now);
    if (idle_ > kFirmAfter) firmness_ = std::fmin(kFirmest, kFirmer * firmness_);
  }
  double firmness() const { return firmness_; }
  bool hopeless() const { return idle_ > kSewIdle; }

 private:
  double gap() const { return widestGap(solver_.cloth(), solver_.places()); }
  const LevelSolver& solver_;
  double narrowest_, firmness_ = 1;
  int idle_ = 0;
};

RestOutcome& note(RestOutcome& so, const LevelSolver::Outcome& step, const Token& token) {
  ++so.steps;
  so.solves += static_cast<std::size_t>(step.iterations);
  so.residual = step.residual;
  so.left = step.move;
  so.finite = step.finite;
  so.cancelled = token.cancelled();
  return so;
}

}  // namespace

RestOutcome sew(LevelSolver& solver, const Token& token, const StepWatcher& watch) {
  RestOutcome so;
  LevelSolver::Stride stride;
  stride.seconds = kFrame;
  stride.keep = 0.9;
  stride.mostMove = 0.5 * solver.cloth().spacing;
  stride.friction = false;
  stride.stop = {40, 60, 0.1};
  const double tieGap = std::fmax(kTieGap, kTieShare * solver.cloth().spacing);
  Drawing drawing(solver);
  for (int k = 0; k < kSewSteps && !solver.allTied(); ++k) {
    const auto step = solver.step(stride, token);
    note(so, step, token);
    if (!so.finite || so.cancelled) return so;
    solver.tieWithin(tieGap);
    if (watch && !watch(k, step)) {
      so.stopped = true;
      return so;
    }
    drawing.look();
    if (drawing.hopeless()) break;
    stride.closing = drawing.firmness();
  }
  so.settled = solver.allTied();
  return so;
}

RestOutcome rest(LevelSolver& solver, Vec3 gravity, const RestRule& rule, double firstSeconds, const Token& token,
                 const StepWatcher& watch) {
  RestOutcome so;
  LevelSolver::Stride stride;
  stride.seconds = firstSeconds;
  stride.mostMove = solver.cloth().spacing;
  stride.gravity = gravity;
  const bool canFall = solver.cloth().pinned.empty() && length(gravity) > 0 &&
                       std::all_of(solver.cloth().pieces.begin(), solver.cloth().pieces.end(),
                                   [](const ClothPiece& p) { return p.live; });
  int calm = 0, alone = 0, untangled = 0;
  bool touched = false;
  Drawing drawing(solver);
  for (int k = 0; k < rule.mostSteps; ++k) {
    stride.keep = std::clamp(1 - kCalming * (k - kCalmAfter), kKept, 1.0);
    stride.calm = k > kCalmAfter;
    const auto step = solver.step(stride, token);
    note(so, step, token);
    if (!so.finite || so.cancelled) return so;
    if (!solver.allTied()) solver.tieWithin(kTieGap);
    if (rule.sews && !solver.allTied()) {
      drawing.look();
      if (drawing.hopeless()) return so;
      stride.closing = drawing.firmness();
    }
    if (watch && !watch(k, step)) {
      so.stopped = true;
      return so;
    }
    touched = touched || solver.touching() > 0;
    alone = solver.touching() > 0 ? 0 : alone + 1;
    if (canFall && touched && alone > kFallSteps) {
      so.falls = true;
      return so;
    }
    // A longer step may move more at the same speed; what a long step would still move is asked below.
    const double allowed = rule.move * std::fmax(1.0, stride.seconds / kLongest);
    // Cloth that creeps one way is given longer steps; cloth that swings or snaps is not.
    if (step.shortened)
      stride.seconds = std::fmax(0.25 * kFrame, 0.7 * stride.seconds);
    else if (step.along > kCreep)
      stride.seconds = std::fmin(kCreepLongest, 1.1 * stride.seconds);
    else
      stride.seconds = stride.seconds > kLongest ? std::fmax(kLongest, 0.5 * stride.seconds)
                                                 : std::fmin(kLongest, 1.1 * stride.seconds);
    calm = step.move < allowed && step.residual < rule.residual && solver.allTied() ? calm + 1 : 0;
    if (calm < rule.calmSteps) continue;
    if (rule.left > 0) {
      LevelSolver::Stride longer = stride;
      longer.seconds = 0.25;
      longer.calm = false;
      longer.stop = {40, 1000, 0.01};
      const auto ahead = solver.predict(longer, token);
      so.solves += static_cast<std::size_t>(ahead.iterations);
      so.left = ahead.move;
      so.residual = ahead.residual;
      so.finite = ahead.finite;
      so.cancelled = token.cancelled();
      if (!so.finite || so.cancelled) return so;
      if (!(ahead.move < rule.left && ahead.residual < rule.residual)) {
        // It was the loosely solved steps that were calm, not the cloth.
        stride.stop.tolerance = std::fmax(0.03, 0.5 * stride.stop.tolerance);
        calm = 0;
        continue;
      }
    }
    // The guard looks along nearest directions and may miss what folds sharply: rest is looked over once more.
    if (untangled < kUntangles && solver.untangle()) {
      ++untangled;
      calm = 0;
      continue;
    }
    so.settled = true;
    return so;
  }
  so.falls = canFall && solver.touching() == 0;
  return so;
}

}  // namespace karinui
