#include "cloth/job.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "cloth/lift.h"
#include "cloth/strain.h"
#include "karinui/base/number.h"

namespace karinui {
namespace {

constexpr double kFarthest = 1000;  // metres from the origin: beyond it a place is a mistake

Message whyOf(const RestOutcome& end, const LevelSolver& solver, double gap) {
  if (end.settled) return say("At rest.");
  if (end.falls)
    return say("Nothing holds the cloth: it slides off and falls. Sew it closed, pin it, or place it on the body.");
  if (!solver.allTied())
    return say("A seam stays open by {0} mm; bring its pieces nearer or look whether something is between them.",
               fixed(gap * 1000, 1));
  return say("Not at rest after {0} steps: it would still move {1} mm.", end.steps, fixed(end.left * 1000, 2));
}

}  // namespace

void Spent::tell(SettleReport& report) const {
  report.cpuSeconds = static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
  report.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) report.peakMegabytes = static_cast<double>(usage.ru_maxrss) / 1024;
}

Done checkLevel(const ClothLevel& level) {
  const Cloth& cloth = level.cloth;
  if (level.state.position.size() != cloth.nodeCount)
    return badInput(say("The cloth has {0} points but its state has {1}.", std::size_t{cloth.nodeCount},
                        level.state.position.size()));
  if (!(cloth.spacing > 0) || !std::isfinite(cloth.spacing)) return badInput(say("The cloth has no spacing."));
  std::uint32_t nodes = 0;
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.lattice || piece.firstNode != nodes)
      return badInput(say("The piece “{0}” has not been laid as cloth.", piece.name));
    nodes += static_cast<std::uint32_t>(piece.lattice->nodes.size());
    if (nodes > cloth.nodeCount) break;
    if (const auto fine = checkFabric(piece.fabric); !fine) return fine.error();
    for (std::uint32_t k = piece.firstNode; k < nodes; ++k)
      if (!finite(level.state.position[k]) || length(level.state.position[k]) > kFarthest)
        return badInput(say("The piece “{0}” does not stand anywhere sensible; place it again.", piece.name));
  }
  if (nodes != cloth.nodeCount) return badInput(say("The cloth does not have the points of its pieces."));
  for (const Tie& tie : cloth.ties)
    if (tie.a >= nodes || tie.b >= nodes || (tie.c != kNoNode && tie.c >= nodes))
      return badInput(say("A seam speaks of cloth that is not there."));
  for (std::uint32_t k : cloth.pinned)
    if (k >= nodes) return badInput(say("A pin speaks of cloth that is not there."));
  return {};
}

Done checkSettings(const SettleSettings& s) {
  const bool fine = finite(s.gravity) && length(s.gravity) < 1000 && s.stopMove > 0 && std::isfinite(s.stopMove) &&
                    s.stopResidual > 0 && s.maxSteps > 0 && s.maxSteps < 10'000'000 && s.skin > 0 && s.skin < 0.1;
  if (!fine) return badInput(say("The settings of the drape make no sense (gravity, stop, steps or skin)."));
  return {};
}

Error tornApart() {
  return refused(say("The drape could not be computed: the cloth stands too torn apart. Place the pieces again."));
}

void addContactTimes(SettleReport& report, const LevelSolver& solver) {
  for (const ContactTime& time : solver.contactTimes()) {
    const auto at = std::find_if(report.contactTimes.begin(), report.contactTimes.end(),
                                 [&](const ContactTime& known) { return known.name == time.name; });
    if (at == report.contactTimes.end())
      report.contactTimes.push_back(time);
    else
      at->seconds += time.seconds;
  }
}

RestRule finestRule(const SettleSettings& settings) {
  return {settings.stopMove, settings.stopResidual, settings.stopMove * 10 / 3, 8, settings.maxSteps};
}

std::vector<Vec3> finish(LevelSolver& solver, const ColliderList& colliders, const SettleSettings& settings,
                         const RestOutcome& end, SettleReport& report, Workers& workers) {
  liftOff(solver, colliders, std::min(0.0003, 0.3 * settings.skin), workers);
  const std::vector<Vec3> x = solver.places();
  const std::size_t crossings = solver.crossings();
  report.settled = end.settled && crossings == 0;
  report.residual = end.residual;
  report.step = end.left;
  report.seamGap = widestGap(solver.cloth(), x);
  report.why = whyOf(end, solver, report.seamGap);
  if (crossings > 0)
    report.why = say("Cloth stands through cloth at {0} places; give it more room, or fewer folds.", crossings);
  report.penetration = deepest(solver.cloth(), colliders, x, workers);
  report.strain = strainOf(solver.cloth(), x);
  return x;
}

}  // namespace karinui
