#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/finish.h"
#include "cloth/input_check.h"
#include "cloth/tie_map.h"
#include "karinui/base/number.h"
#include "karinui/cloth/live_hand.h"

namespace karinui {
namespace {

constexpr double kHandStiffness = 2e4;  // N/m of the whole patch: how firmly a hand keeps to its path
constexpr double kMostHandForce = 40;   // N: cloth that resists more holds the hand back
constexpr double kStepLength = 0.5;     // spacings the hand goes in a step; more would outrun the cloth
constexpr double kLiveStepLength = 1;   // spacings, in a live pull
constexpr double kMostSteps = 1200;     // of a hand in a hurry; it waits for the cloth at the end of its path
constexpr double kFarthest = 1000;      // metres from the origin
constexpr double kHeldBack = 0.005;     // metres short of the path's end that are worth telling
constexpr int kMostRestSteps = 400;     // after the path's end; what rests does so in 40 to 150

double wayOf(const std::vector<Vec3>& path) {
  double way = 0;
  for (std::size_t k = 1; k < path.size(); ++k) way += distance(path[k - 1], path[k]);
  return way;
}

// Where the hand is at each step, and how many of the path's points it has reached by then. Every leg has at least one
// step, so that there is a force for each point.
struct Waypoint {
  Vec3 place;
  std::size_t reached = 0;
};
std::vector<Waypoint> waypointsOf(const std::vector<Vec3>& path, double seconds, double spacing) {
  const double way = wayOf(path);
  const double steps = std::max(seconds / kFrame, std::min(kMostSteps, way / (kStepLength * spacing)));
  std::vector<Waypoint> waypoints{{path.front(), 1}};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double part = way > 0 ? distance(path[k - 1], path[k]) / way : 1 / static_cast<double>(path.size() - 1);
    const int count = std::max(1, static_cast<int>(std::lround(part * steps)));
    for (int i = 1; i < count; ++i)
      waypoints.push_back({lerp(path[k - 1], path[k], static_cast<double>(i) / count), k});
    waypoints.push_back({path[k], k + 1});
  }
  return waypoints;
}

std::vector<std::uint8_t> movable(const Cloth& cloth) {
  std::vector<std::uint8_t> live(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live) std::fill_n(live.begin() + piece.firstNode, piece.lattice->nodes.size(), 1);
  for (std::uint32_t node : cloth.pinned) live[node] = 0;
  return live;
}

Done checkGrip(const Grip& grip, const Cloth& cloth) {
  if (grip.nodes.empty()) return badInput(say("The hand holds no cloth."));
  std::vector<std::uint8_t> live(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live) std::fill_n(live.begin() + piece.firstNode, piece.lattice->nodes.size(), 1);
  const auto free = movable(cloth);
  bool any = false;
  for (std::uint32_t node : grip.nodes) {
    if (node >= cloth.nodeCount) return badInput(say("The hand holds cloth that is not there."));
    if (!live[node]) return refused(say("The hand holds a piece that is frozen; make it live to pull it."));
    any = any || free[node];
  }
  if (!any) return refused(say("The hand holds cloth that is pinned; take the pin out to pull it."));
  if (grip.path.empty()) return badInput(say("The hand has no path to follow."));
  for (Vec3 p : grip.path)
    if (!finite(p) || length(p) > kFarthest) return badInput(say("The hand's path leads nowhere sensible."));
  if (!(grip.seconds > 0) || grip.seconds > 600)
    return badInput(say("A pull takes between 0 and 600 seconds, not {0}.", grip.seconds));
  return {};
}

// What moves with the hand: its nodes that are free, and what is sewn to them.
std::vector<NodeIndex> patchOf(const Grip& grip, const Cloth& cloth, std::span<const Vec3> x) {
  const auto free = movable(cloth);
  std::vector<std::uint8_t> in(cloth.nodeCount, 0);
  for (std::uint32_t node : grip.nodes) in[node] = 1;
  for (const Tie& tie : cloth.ties) {
    const bool folded = tie.c != kNoNode;
    if (!(in[tie.a] || in[tie.b] || (folded && in[tie.c])) || length(gapOf(tie, x)) >= cloth.spacing) continue;
    in[tie.a] = in[tie.b] = 1;
    if (folded) in[tie.c] = 1;
  }
  std::vector<NodeIndex> patch;
  for (NodeIndex node = 0; node < cloth.nodeCount; ++node)
    if (in[node] && free[node]) patch.push_back(node);
  return patch;
}

// A hand of limited force: a spring on its patch, softer the further away its place is.
class PullingHand {
 public:
  PullingHand(LevelSolver& solver, std::vector<NodeIndex> nodes) : solver_(solver) {
    hand_.nodes = std::move(nodes);
    const Vec3 middle = meanOfPatch();
    for (NodeIndex node : hand_.nodes) hand_.offset.push_back(solver_.positions()[node] - middle);
  }
  void moveTo(Vec3 place) {
    hand_.middle = place;
    const double firm = std::min(kHandStiffness, kMostHandForce / std::max(1e-9, distanceLeft()));
    hand_.stiffness = firm / static_cast<double>(hand_.nodes.size());
    solver_.setHand(hand_);
  }
  void update() { moveTo(hand_.middle); }
  // The force it feels: cloth that whips may pull harder than the hand holds, and then it slips in the hand.
  Vec3 felt() const {
    const Vec3 force = solver_.handForce();
    return force * std::min(1.0, kMostHandForce / std::max(1e-9, length(force)));
  }
  double distanceLeft() const { return distance(hand_.middle, meanOfPatch()); }

 private:
  Vec3 meanOfPatch() const {
    Vec3 sum;
    for (NodeIndex node : hand_.nodes) sum += solver_.positions()[node];
    return sum * (1.0 / static_cast<double>(hand_.nodes.size()));
  }
  LevelSolver& solver_;
  Hand hand_;
};

// Cloth that was squeezed against other cloth or the body: its unbalanced force, however long one waits, stays.
class Squeeze {
 public:
  bool found(double residual) {
    least_ = std::min(least_, residual);
    if (++steps_ % kWindow != 0) return false;
    const bool stays = least_ > kUnbalanced && least_ > kStays * before_;
    before_ = std::exchange(least_, kHuge);
    return stays;
  }

 private:
  static constexpr int kWindow = 40;          // steps, of which the calmest counts
  static constexpr double kUnbalanced = 2e4;  // node weights
  static constexpr double kStays = 0.9;       // of the calmest of the window before
  static constexpr double kHuge = 1e300;
  int steps_ = 0;
  double least_ = kHuge, before_ = kHuge;
};

LevelSolver::StepOptions stepOptions(const Cloth& cloth, const SettleSettings& settings) {
  LevelSolver::StepOptions options;
  options.seconds = kFrame;
  options.velocityKept = 0.9;
  options.mostMove = cloth.spacing;
  options.gravity = settings.gravity;
  options.stopping = {40, 150, 0.1};  // the hand's force is reported at every point of its path
  return options;
}

}  // namespace

struct LiveHand::Inside {
  Inside(ClothLevel from, const ColliderList& colliders, const Grip& grip, const SettleSettings& settings,
         Workers& workers)
      : level(std::move(from)),
        solver(level.cloth, level.state.position, colliders, settings,
               settings.clothOnCloth ? clothRadius(level.cloth, level.cloth.spacing) : 0, workers),
        hand((solver.tieWithin(level.cloth.spacing), solver), patchOf(grip, level.cloth, solver.positions())),
        options(stepOptions(level.cloth, settings)),
        middle(grip.path.front()) {}
  ClothLevel level;
  LevelSolver solver;
  PullingHand hand;
  LevelSolver::StepOptions options;
  Vec3 middle;
};

LiveHand::LiveHand() = default;
LiveHand::LiveHand(LiveHand&&) noexcept = default;
LiveHand::~LiveHand() = default;

Result<LiveHand> LiveHand::take(ClothLevel level, const ColliderList& colliders, const Grip& grip,
                                const SettleSettings& settings, Workers& workers) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (const auto fine = checkGrip(grip, level.cloth); !fine) return fine.error();
  LiveHand hand;
  hand.inside_ = std::make_unique<Inside>(std::move(level), colliders, grip, settings, workers);
  return hand;
}

Result<Vec3> LiveHand::to(Vec3 place, const Token& token) {
  Inside& in = *inside_;
  if (!finite(place) || length(place) > kFarthest) return badInput(say("The hand's path leads nowhere sensible."));
  const double way = distance(in.middle, place) / (kLiveStepLength * in.level.cloth.spacing);
  const int steps = static_cast<int>(std::clamp(std::ceil(way), 1.0, kMostSteps));
  const Vec3 from = in.middle;
  for (int k = 1; k <= steps; ++k) {
    in.middle = lerp(from, place, static_cast<double>(k) / steps);
    in.hand.moveTo(in.middle);
    const auto step = in.solver.step(in.options, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
  }
  return in.hand.felt();
}

const Cloth& LiveHand::cloth() const { return inside_->level.cloth; }
const std::vector<Vec3>& LiveHand::places() const { return inside_->solver.positions(); }

Result<PullReport> pull(ClothLevel& level, const ColliderList& colliders, const Grip& grip,
                        const SettleSettings& settings, const Token& token, Workers& workers) {
  const ResourceUse spent;
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (const auto fine = checkGrip(grip, level.cloth); !fine) return fine.error();

  LevelSolver solver(level.cloth, level.state.position, colliders, settings,
                     settings.clothOnCloth ? clothRadius(level.cloth, level.cloth.spacing) : 0, workers);
  solver.tieWithin(level.cloth.spacing);
  PullingHand hand(solver, patchOf(grip, level.cloth, solver.positions()));

  PullReport report;
  const LevelSolver::StepOptions options = stepOptions(level.cloth, settings);
  const std::vector<Waypoint> waypoints = waypointsOf(grip.path, grip.seconds, level.cloth.spacing);
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    hand.moveTo(waypoints[k].place);
    if (k > 0) {
      const auto step = solver.step(options, token);
      if (token.cancelled()) return cancelled();
      if (!step.finite) return tornApart();
      ++report.end.steps;
      report.end.solves += static_cast<std::size_t>(step.iterations);
    }
    const Vec3 force = hand.felt();
    report.force.resize(waypoints[k].reached, force);
    report.maxForce = std::max(report.maxForce, length(force));
    token.progress(0.5 * static_cast<double>(k) / static_cast<double>(waypoints.size()), say("Pulling the cloth"));
  }
  if (grip.letGo) solver.setHand(std::nullopt);
  RestCriteria criteria = finestCriteria(settings, false);
  criteria.mostSteps = std::min(criteria.mostSteps, kMostRestSteps);
  StageResult end;
  Squeeze squeeze;
  const auto watch = [&](int, const LevelSolver::StepResult& step) {
    if (!grip.letGo) hand.update();
    token.progress(0.5, say("Draping"));
    return !squeeze.found(step.residual);
  };
  end = relax(solver, settings.gravity, criteria, kFrame, token, watch);
  report.end.steps += end.steps;
  report.end.solves += end.solves;
  if (end.falls && !grip.letGo) {  // cloth clear of the body does not fall while a hand holds it
    criteria.mostSteps -= static_cast<int>(end.steps);
    if (criteria.mostSteps > 0) {
      end = relax(solver, settings.gravity, criteria, kFrame, token, watch);
      report.end.steps += end.steps;
      report.end.solves += end.solves;
    }
    end.falls = false;
  }
  if (end.cancelled || token.cancelled()) return cancelled();
  if (!end.finite) return tornApart();
  if (!grip.letGo) {  // what the hand feels once all is calm
    report.force.back() = hand.felt();
    report.maxForce = std::max(report.maxForce, length(report.force.back()));
  }
  addContactTimes(report.end, solver);
  const double left = hand.distanceLeft();
  level.state.position = finish(solver, colliders, settings, end, report.end, workers);
  if (end.stopped)
    report.end.why =
        say("The pull left the cloth squeezed, and it does not come to rest. Undo it, or pull more gently.");
  if (!grip.letGo && report.end.settled && left > kHeldBack)
    report.end.why = say("The cloth held the hand back with {0} N, {1} mm before the end of its path.",
                         fixed(length(report.force.back()), 1), fixed(left * 1000, 0));
  spent.tell(report.end);
  return report;
}

}  // namespace karinui
