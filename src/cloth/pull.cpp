#include <algorithm>
#include <cmath>

#include "cloth/job.h"
#include "cloth/tie_map.h"
#include "karinui/base/number.h"
#include "karinui/cloth/live_hand.h"

namespace karinui {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr double kHandStiffness = 2e4;  // N/m of the whole patch: how firmly a hand keeps to its path
constexpr double kHandStrength = 40;    // N: cloth that resists more holds the hand back
constexpr double kStride = 0.5;         // spacings the hand goes in a step; more would outrun the cloth
constexpr double kLiveStride = 1;       // spacings, while somebody watches and waits
constexpr double kMostSteps = 1200;     // of a hand in a hurry; it waits for the cloth at the end of its path
constexpr double kFarthest = 1000;      // metres from the origin
constexpr double kHeldBack = 0.005;     // metres short of the path's end that are worth telling

double wayOf(const std::vector<Vec3>& path) {
  double way = 0;
  for (std::size_t k = 1; k < path.size(); ++k) way += distance(path[k - 1], path[k]);
  return way;
}

// Where the hand is at each step, and how many of the path's points it has reached by then. Every leg has a step of its
// own, so that a force can be told for each point.
struct Stop {
  Vec3 place;
  std::size_t reached = 0;
};
std::vector<Stop> stopsOf(const std::vector<Vec3>& path, double seconds, double spacing) {
  const double way = wayOf(path);
  const double steps = std::max(seconds / kFrame, std::min(kMostSteps, way / (kStride * spacing)));
  std::vector<Stop> stops{{path.front(), 1}};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double part = way > 0 ? distance(path[k - 1], path[k]) / way : 1 / static_cast<double>(path.size() - 1);
    const int count = std::max(1, static_cast<int>(std::lround(part * steps)));
    for (int i = 1; i < count; ++i) stops.push_back({lerp(path[k - 1], path[k], static_cast<double>(i) / count), k});
    stops.push_back({path[k], k + 1});
  }
  return stops;
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

// A hand of limited strength: it draws its patch to where it wants it, softer the further that is.
class PullingHand {
 public:
  PullingHand(LevelSolver& solver, std::vector<NodeIndex> nodes) : solver_(solver) {
    hand_.nodes = std::move(nodes);
    const Vec3 middle = meanOfPatch();
    for (NodeIndex node : hand_.nodes) hand_.offset.push_back(solver_.places()[node] - middle);
  }
  void drawTo(Vec3 place) {
    hand_.middle = place;
    const double firm = std::min(kHandStiffness, kHandStrength / std::max(1e-9, shortBy()));
    hand_.stiffness = firm / static_cast<double>(hand_.nodes.size());
    solver_.setHand(hand_);
  }
  void again() { drawTo(hand_.middle); }
  // What it feels: cloth that whips may pull harder than the hand holds, and then it slips in the hand.
  Vec3 felt() const {
    const Vec3 force = solver_.handForce();
    return force * std::min(1.0, kHandStrength / std::max(1e-9, length(force)));
  }
  double shortBy() const { return distance(hand_.middle, meanOfPatch()); }

 private:
  Vec3 meanOfPatch() const {
    Vec3 sum;
    for (NodeIndex node : hand_.nodes) sum += solver_.places()[node];
    return sum * (1.0 / static_cast<double>(hand_.nodes.size()));
  }
  LevelSolver& solver_;
  LevelSolver::Hand hand_;
};

LevelSolver::Stride strideOf(const Cloth& cloth, const SettleSettings& settings) {
  LevelSolver::Stride stride;
  stride.seconds = kFrame;
  stride.keep = 0.9;
  stride.mostMove = cloth.spacing;
  stride.gravity = settings.gravity;
  stride.stop = {40, 150, 0.1};  // what the hand feels is asked at every point of its way
  return stride;
}

}  // namespace

struct LiveHand::Inside {
  Inside(ClothLevel from, const Collider& body, const Grip& grip, const SettleSettings& settings, Workers& workers)
      : level(std::move(from)),
        solver(level.cloth, level.state.position, body, settings,
               settings.clothOnCloth ? clothRadius(level.cloth.spacing, level.cloth.spacing) : 0, workers),
        hand((solver.tieWithin(level.cloth.spacing), solver), patchOf(grip, level.cloth, solver.places())),
        stride(strideOf(level.cloth, settings)),
        middle(grip.path.front()) {}
  ClothLevel level;
  LevelSolver solver;
  PullingHand hand;
  LevelSolver::Stride stride;
  Vec3 middle;
};

LiveHand::LiveHand() = default;
LiveHand::LiveHand(LiveHand&&) noexcept = default;
LiveHand::~LiveHand() = default;

Result<LiveHand> LiveHand::take(ClothLevel level, const Collider& body, const Grip& grip,
                                const SettleSettings& settings, Workers& workers) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (const auto fine = checkGrip(grip, level.cloth); !fine) return fine.error();
  LiveHand hand;
  hand.inside_ = std::make_unique<Inside>(std::move(level), body, grip, settings, workers);
  return hand;
}

Result<Vec3> LiveHand::to(Vec3 place, const Token& token) {
  Inside& in = *inside_;
  if (!finite(place) || length(place) > kFarthest) return badInput(say("The hand's path leads nowhere sensible."));
  const double way = distance(in.middle, place) / (kLiveStride * in.level.cloth.spacing);
  const int steps = static_cast<int>(std::clamp(std::ceil(way), 1.0, kMostSteps));
  const Vec3 from = in.middle;
  for (int k = 1; k <= steps; ++k) {
    in.middle = lerp(from, place, static_cast<double>(k) / steps);
    in.hand.drawTo(in.middle);
    const auto step = in.solver.step(in.stride, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
  }
  return in.hand.felt();
}

const Cloth& LiveHand::cloth() const { return inside_->level.cloth; }
const std::vector<Vec3>& LiveHand::places() const { return inside_->solver.places(); }

Result<PullReport> pull(ClothLevel& level, const Collider& body, const Grip& grip, const SettleSettings& settings,
                        const Token& token, Workers& workers) {
  const Spent spent;
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (const auto fine = checkGrip(grip, level.cloth); !fine) return fine.error();

  LevelSolver solver(level.cloth, level.state.position, body, settings,
                     settings.clothOnCloth ? clothRadius(level.cloth.spacing, level.cloth.spacing) : 0, workers);
  solver.tieWithin(level.cloth.spacing);
  PullingHand hand(solver, patchOf(grip, level.cloth, solver.places()));

  PullReport report;
  const LevelSolver::Stride stride = strideOf(level.cloth, settings);
  const std::vector<Stop> stops = stopsOf(grip.path, grip.seconds, level.cloth.spacing);
  for (std::size_t k = 0; k < stops.size(); ++k) {
    hand.drawTo(stops[k].place);
    if (k > 0) {
      const auto step = solver.step(stride, token);
      if (token.cancelled()) return cancelled();
      if (!step.finite) return tornApart();
      ++report.end.steps;
      report.end.solves += static_cast<std::size_t>(step.iterations);
    }
    const Vec3 force = hand.felt();
    report.force.resize(stops[k].reached, force);
    report.maxForce = std::max(report.maxForce, length(force));
    token.progress(0.5 * static_cast<double>(k) / static_cast<double>(stops.size()), say("Pulling the cloth"));
  }
  if (grip.letGo) solver.setHand(std::nullopt);
  RestRule rule = finestRule(settings);
  RestOutcome end;
  const auto watch = [&](int, const LevelSolver::Outcome&) {
    if (!grip.letGo) hand.again();
    token.progress(0.5, say("Draping"));
    return true;
  };
  end = rest(solver, settings.gravity, rule, kFrame, token, watch);
  report.end.steps += end.steps;
  report.end.solves += end.solves;
  if (end.falls && !grip.letGo) {  // cloth clear of the body does not fall while a hand holds it
    rule.mostSteps -= static_cast<int>(end.steps);
    if (rule.mostSteps > 0) {
      end = rest(solver, settings.gravity, rule, kFrame, token, watch);
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
  const double left = hand.shortBy();
  level.state.position = finish(solver, body, settings, end, report.end, workers);
  if (!grip.letGo && end.settled && left > kHeldBack)
    report.end.why = say("The cloth held the hand back with {0} N, {1} mm before the end of its path.",
                         fixed(length(report.force.back()), 1), fixed(left * 1000, 0));
  spent.tell(report.end);
  return report;
}

}  // namespace karinui
