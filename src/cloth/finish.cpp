#include "cloth/finish.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "cloth/strain.h"
#include "cloth/tie_map.h"
#include "karinui/base/number.h"

namespace karinui {
namespace {

constexpr double kCaught = 1;        // strain of a thread: no fabric is stretched so far in wear
constexpr int kStepsAfterEdit = 60;  // in which cloth that rested before comes to rest again, mostly

// Whether the straight way from one place to another goes through a collider.
bool within(const ColliderList& colliders, Vec3 from, Vec3 way) {
  constexpr int kLooks = 16;
  constexpr double kDeep = 0.003;  // metres
  for (const ColliderList::Entry& entry : colliders)
    for (int k = 1; k < kLooks; ++k)
      if (entry.collider->sample(from + way * (static_cast<double>(k) / kLooks)).distance < -kDeep) return true;
  return false;
}

Message whyOf(const StageResult& end, const LevelSolver& solver, double gap, const ColliderList& colliders) {
  const DrawnOut most = mostDrawnOut(solver.cloth(), solver.positions());
  if (end.settled)
    return most.times > 1 + kCaught
               ? say("Threads of “{0}” are drawn out to {1} times their length, about {2} cm above the floor. Look "
                     "whether the cloth is caught there.",
                     most.piece->name, fixed(most.times, 1), std::round(most.place.y * 100))
               : say("At rest.");
  if (end.torn)
    return say(
        "Stopped after {0} {0|step|steps}, for the cloth is torn: threads of “{1}” are drawn out to {2} times their "
        "length. Something pulls it through the body or through other cloth; place the pieces where they are worn.",
        end.steps, most.piece->name, fixed(most.times, 0));
  if (end.falls)
    return say("Nothing holds the cloth: it slides off and falls. Sew it closed, pin it, or place it on the body.");
  if (!solver.allTied()) return openSeam(solver.cloth(), solver.positions(), gap, colliders);
  return say("Not at rest after {0} {0|step|steps}: it would still move {1} mm.", end.steps, fixed(end.left * 1000, 2));
}

}  // namespace

std::optional<Message> adviceOn(const SettleReport& report) {
  if (!report.settled) return say("The cloth did not come to rest: {0}", report.why);
  if (report.strain.max > kCaught) return report.why;
  return std::nullopt;
}

Message openSeam(const Cloth& cloth, std::span<const Vec3> position, double gap, const ColliderList& colliders) {
  const auto widest = std::max_element(cloth.ties.begin(), cloth.ties.end(), [&](const Tie& one, const Tie& other) {
    return squaredLength(gapOf(one, position)) < squaredLength(gapOf(other, position));
  });
  const std::string a = pieceOf(cloth, widest->a).name, b = pieceOf(cloth, widest->b).name;
  const Vec3 way = gapOf(*widest, position);
  if (within(colliders, position[widest->a], way)) {
    const double high = std::round((position[widest->a] + way * 0.5).y * 100);
    return a == b
               ? say("A seam within “{0}” stays open by {1} mm about {2} cm above the floor: the body is between its "
                     "sides. Leave it open where the neck, an arm or a leg has to come out, or place “{0}” so that "
                     "the sides meet beside the body.",
                     a, fixed(gap * 1000, 1), high)
               : say("A seam of “{0}” and “{1}” stays open by {2} mm about {3} cm above the floor: the body is "
                     "between them. Leave it open where the neck, an arm or a leg has to come out, or place the "
                     "pieces so that they meet beside the body.",
                     a, b, fixed(gap * 1000, 1), high);
  }
  return a == b ? say("A seam within “{0}” stays open by {1} mm; bring its sides nearer or look whether something is "
                      "between them.",
                      a, fixed(gap * 1000, 1))
                : say("A seam of “{0}” and “{1}” stays open by {2} mm; bring the pieces nearer or look whether "
                      "something is between them.",
                      a, b, fixed(gap * 1000, 1));
}

void ResourceUse::tell(SettleReport& report) const {
  report.cpuSeconds = cpuSeconds();
  report.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) report.peakMegabytes = static_cast<double>(usage.ru_maxrss) / 1024;
}

void ResourceUse::leaveOut(const ResourceUse& later) {
  cpu_ += std::clock() - later.cpu_;
  wall_ += std::chrono::steady_clock::now() - later.wall_;
}

Message throughBody(const Penetration& most) {
  return say(
      "The body goes through “{0}”, about {1} cm above the floor, so the drape was ended early. Place the piece where "
      "it is worn, or make it wider there; if an arm is in the way, let the figure hold it elsewhere: pose name=T "
      "raises both, pose name=A lowers them.",
      most.piece->name, std::round(most.place.y * 100));
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

RestCriteria finestCriteria(const SettleSettings& settings, bool rested) {
  RestCriteria criteria{settings.stopMove, settings.stopResidual, settings.stopMove * 10 / 3, 8, settings.maxSteps};
  criteria.newton = 3;
  criteria.creep = 0.5;
  criteria.newtonAfter = rested ? kStepsAfterEdit : 0;
  return criteria;
}

std::vector<Vec3> finish(LevelSolver& solver, const ColliderList& colliders, const SettleSettings& settings,
                         const StageResult& end, SettleReport& report, Workers& workers) {
  const std::size_t inBody = liftOffColliders(solver, colliders, std::min(0.0003, 0.3 * settings.skin), workers);
  const std::vector<Vec3> x = solver.positions();
  const std::size_t intersections = solver.intersections();
  report.settled = end.settled && intersections == 0 && inBody == 0;
  report.residual = end.residual;
  report.step = end.left;
  report.seamGap = widestGap(solver.cloth(), x);
  report.why = whyOf(end, solver, report.seamGap, colliders);
  if (intersections > 0 && !end.torn)
    report.why =
        say("Cloth stands through cloth at {0} {0|place|places}; give it more room, or fewer folds.", intersections);
  else if (end.settled && inBody > 0)
    report.why =
        say("Cloth stands in the body at {0} {0|place|places}; give it more room, or set threads nearer to each other "
            "(set spacing=…).",
            inBody);
  report.penetration = deepestPenetration(solver.cloth(), colliders, x, workers).depth;
  report.strain = strainOf(solver.cloth(), x);
  return x;
}

}  // namespace karinui
