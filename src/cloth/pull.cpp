#include <algorithm>
#include <cmath>

#include "cloth/job.h"
#include "karinui/cloth/settle.h"

namespace karinui {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr double kHandStiffness = 2000;  // N/m of the whole patch: how firmly a hand keeps to its path

// How far along the path each of its points lies, from 0 to 1.
std::vector<double> fractions(const std::vector<Vec3>& path) {
  std::vector<double> at(path.size(), 0);
  for (std::size_t k = 1; k < path.size(); ++k) at[k] = at[k - 1] + distance(path[k - 1], path[k]);
  const double whole = at.back();
  for (std::size_t k = 1; k < path.size(); ++k)
    at[k] = whole > 0 ? at[k] / whole : static_cast<double>(k) / static_cast<double>(path.size() - 1);
  return at;
}

Vec3 along(const std::vector<Vec3>& path, const std::vector<double>& at, double fraction) {
  for (std::size_t k = 1; k < path.size(); ++k)
    if (fraction <= at[k])
      return at[k] > at[k - 1] ? lerp(path[k - 1], path[k], (fraction - at[k - 1]) / (at[k] - at[k - 1])) : path[k];
  return path.back();
}

Done checkGrip(const Grip& grip, const Cloth& cloth) {
  if (grip.nodes.empty()) return badInput(say("The hand holds no cloth."));
  std::vector<std::uint8_t> live(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live) std::fill_n(live.begin() + piece.firstNode, piece.lattice->nodes.size(), 1);
  for (std::uint32_t node : grip.nodes) {
    if (node >= cloth.nodeCount) return badInput(say("The hand holds cloth that is not there."));
    if (!live[node]) return refused(say("The hand holds a piece that is frozen; make it live to pull it."));
  }
  if (grip.path.empty()) return badInput(say("The hand has no path to follow."));
  for (Vec3 p : grip.path)
    if (!finite(p) || length(p) > 1000) return badInput(say("The hand's path leads nowhere sensible."));
  if (!(grip.seconds > 0) || grip.seconds > 600)
    return badInput(say("A pull takes between 0 and 600 seconds, not {0}.", grip.seconds));
  return {};
}

}  // namespace

Result<PullReport> pull(ClothLevel& level, const Collider& body, const Grip& grip, const SettleSettings& settings,
                        const Token& token, Workers& workers) {
  const Spent spent;
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (const auto fine = checkGrip(grip, level.cloth); !fine) return fine.error();

  LevelSolver solver(level.cloth, level.state.position, body, settings,
                     settings.clothOnCloth ? clothRadius(level.cloth.spacing, level.cloth.spacing) : 0, workers);
  solver.tieWithin(level.cloth.spacing);
  LevelSolver::Hand hand;
  hand.nodes = grip.nodes;
  std::sort(hand.nodes.begin(), hand.nodes.end());
  hand.nodes.erase(std::unique(hand.nodes.begin(), hand.nodes.end()), hand.nodes.end());
  const double share = 1.0 / static_cast<double>(hand.nodes.size());
  Vec3 middle;
  for (NodeIndex node : hand.nodes) middle += solver.places()[node] * share;
  for (NodeIndex node : hand.nodes) hand.offset.push_back(solver.places()[node] - middle);
  hand.stiffness = kHandStiffness * share;

  PullReport report;
  LevelSolver::Stride stride;
  stride.seconds = kFrame;
  stride.keep = 0.9;
  stride.mostMove = level.cloth.spacing;
  stride.gravity = settings.gravity;
  const std::vector<double> at = fractions(grip.path);
  const int steps = std::max(1, static_cast<int>(std::ceil(grip.seconds / kFrame)));
  for (int k = 0; k <= steps; ++k) {
    const double fraction = static_cast<double>(k) / steps;
    hand.middle = along(grip.path, at, fraction);
    solver.setHand(hand);
    if (k > 0) {
      const auto step = solver.step(stride, token);
      if (token.cancelled()) return cancelled();
      if (!step.finite) return tornApart();
      ++report.end.steps;
      report.end.solves += static_cast<std::size_t>(step.iterations);
    }
    const Vec3 force = solver.handForce();
    while (report.force.size() < at.size() && at[report.force.size()] <= fraction + 1e-12)
      report.force.push_back(force);
    report.maxForce = std::max(report.maxForce, length(force));
    token.progress(0.5 * fraction, say("Pulling the cloth"));
  }
  if (grip.letGo) solver.setHand(std::nullopt);
  const RestOutcome end = rest(solver, settings.gravity, finestRule(settings), kFrame, token,
                               [&](int, const LevelSolver::Outcome&) { token.progress(0.5, say("Draping")); });
  if (end.cancelled || token.cancelled()) return cancelled();
  if (!end.finite) return tornApart();
  report.end.steps += end.steps;
  report.end.solves += end.solves;
  if (!grip.letGo) {  // what the hand feels once all is calm
    report.force.back() = solver.handForce();
    report.maxForce = std::max(report.maxForce, length(report.force.back()));
  }
  level.state.position = finish(solver, body, settings, end, report.end, workers);
  spent.tell(report.end);
  return report;
}

}  // namespace karinui
