#include "karinui/cloth/settle.h"

#include <algorithm>
#include <cmath>

#include "cloth/boundary_activation.h"
#include "cloth/continuation.h"
#include "cloth/flat_piece.h"
#include "cloth/input_check.h"
#include "cloth/penetration.h"
#include "cloth/prolong.h"
#include "cloth/rest_forecast.h"
#include "cloth/stages.h"
#include "cloth/strain.h"
#include "cloth/tie_map.h"

namespace karinui {
namespace {

constexpr double kActivationMove = 0.002;  // metres: a neighbour that would move further is to be activated
constexpr double kSewn = 0.5;              // spacings: a pair nearer than this is sewn
constexpr double kNear = 0.1;     // metres: one no farther is drawn together where it is, if no more of the pairs
constexpr double kFew = 1.0 / 3;  // than this are open

bool anyLive(const Cloth& cloth) {
  return std::any_of(cloth.pieces.begin(), cloth.pieces.end(), [](const ClothPiece& p) { return p.live; });
}

bool liesInLayers(const Cloth& cloth) {
  return cloth.pleated || std::any_of(cloth.pieces.begin(), cloth.pieces.end(),
                                      [&](const ClothPiece& p) { return p.layer != cloth.pieces.front().layer; });
}

// Whether the finest level already stands formed, and sewn but for a few pairs that are near each other: then coarser
// levels are not needed.
bool standsFormed(const ClothLevel& finest) {
  const std::vector<Vec3>& x = finest.state.position;
  const std::vector<double> gaps = liveGaps(finest.cloth, x);
  const auto wider = [&](double than) {
    return static_cast<double>(std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return !(gap <= than); }));
  };
  if (wider(kNear) > 0 || wider(kSewn * finest.cloth.spacing) > kFew * static_cast<double>(gaps.size())) return false;
  return std::none_of(finest.cloth.pieces.begin(), finest.cloth.pieces.end(),
                      [&](const ClothPiece& piece) { return piece.live && normalWhereFlat(piece, x); });
}

constexpr double kGrownThrough =
    0.018;  // metres: tight cloth of coarse cells stands up to 10 mm deep, a limb through it 30
constexpr double kOutOfSkin = 0.95;  // of the skin

// A level that was interpolated may stand in the skin.
std::vector<Vec3> outOfSkin(const LevelSolver& solver, const ColliderList& colliders, double offset, Workers& workers) {
  std::vector<Vec3> moves(solver.positions().size());
  const auto& moving = solver.moving();
  workers.forBlocks(moving.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Vec3 place = solver.positions()[moving[n]];
      for (const ColliderList::Entry& entry : colliders) {
        if (!entry.collider->mayBeWithin(place, offset)) continue;
        const Collider::Sample sample = entry.collider->sample(place);
        if (!(sample.distance < kOutOfSkin * offset)) continue;
        const Vec3 out = sample.normal * (kOutOfSkin * offset - sample.distance);
        if (squaredLength(out) > squaredLength(moves[moving[n]])) moves[moving[n]] = out;
      }
    }
  });
  return moves;
}

// Coarse cells cannot hold a crease, but keep one: the hem of a full skirt that turned up beside a seam while it was
// sewn stays so on every finer level. So on coarse levels cloth bends over a cell at least (B = w g h^3, w the weight
// by area). Gathered pieces must fold within cells and keep their own bending.
Cloth bendingOverCells(Cloth cloth, double gravity) {
  std::vector<std::uint8_t> gathered(cloth.nodeCount, 0);
  for (const Tie& tie : cloth.ties)
    if (tie.c != kNoNode && tie.c != tie.b) gathered[tie.a] = gathered[tie.b] = gathered[tie.c] = 1;
  for (ClothPiece& piece : cloth.pieces) {
    const auto first = gathered.begin() + piece.firstNode,
               end = first + static_cast<std::ptrdiff_t>(piece.lattice->nodes.size());
    if (std::find(first, end, 1) != end) continue;
    const double least = piece.fabric.weight * gravity * cloth.spacing * cloth.spacing * cloth.spacing;
    piece.fabric.bendWarp = std::fmax(piece.fabric.bendWarp, least);
    piece.fabric.bendWeft = std::fmax(piece.fabric.bendWeft, least);
  }
  return cloth;
}

constexpr double kSunk = 0.01;  // metres into the body, around a seam that does not close on it
constexpr double kOpen = 0.1;   // spacings: a pair farther apart is open

// Between the sides of seams that stay open.
std::vector<Vec3> openPlaces(const Cloth& cloth, std::span<const Vec3> x) {
  std::vector<Vec3> places;
  for (const Tie& tie : cloth.ties)
    if (const Vec3 gap = gapOf(tie, x); length(gap) > kOpen * cloth.spacing) places.push_back(x[tie.a] + gap * 0.5);
  return places;
}

constexpr double kSnagged = 0.5;  // strain of a coarse thread: no seam that closes freely stretches cloth by half

constexpr double kUsualSteps = 100;

int tens(double steps) { return 10 * std::max(1, static_cast<int>(std::lround(steps / 10))); }

// How much of the work is done before this level: a step of it costs as its nodes do.
double shareBefore(const std::vector<ClothLevel>& levels, std::size_t first, std::size_t level) {
  double done = 0, all = 0;
  for (std::size_t l = first; l < levels.size(); ++l) {
    all += levels[l].cloth.nodeCount;
    if (l < level) done += levels[l].cloth.nodeCount;
  }
  return all > 0 ? done / all : 0;
}

}  // namespace

Result<SettleReport> settle(std::vector<ClothLevel>& levels, const ColliderList& colliders,
                            const SettleSettings& settings, const Token& token, Workers& workers,
                            const SettleWatcher& watcher) {
  ResourceUse spent;
  if (levels.empty()) return badInput(say("There is no cloth to drape."));
  for (const ClothLevel& level : levels)
    if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (token.cancelled()) return cancelled();

  ClothLevel& finest = levels.back();
  SettleReport report;
  if (!anyLive(finest.cloth)) {
    report.settled = true;
    report.why = say("No piece is live; nothing was moved.");
    report.seamGap = widestGap(finest.cloth, finest.state.position);
    report.strain = strainOf(finest.cloth, finest.state.position);
    spent.tell(report);
    return report;
  }
  bool formed = standsFormed(finest), sewn = formed, stopped = false, grownThrough = false, layersMeet = true;
  // Pieces are sewn up through each other; where cloth has then gone through itself, once more with contact.
  enum class Sewing { Free, Meeting, FreeAfterAll } sewing = Sewing::Free;
  std::size_t taken = 0;  // steps, over all levels
  std::vector<Vec3> x;
  const BoundaryActivation activation(finest.cloth);
  std::vector<Vec3> forceBefore(activation.empty() ? 0 : finest.cloth.nodeCount), forceAfter;
  for (std::size_t first = formed ? levels.size() - 1 : 0, l = first; l < levels.size();) {
    const bool last = l + 1 == levels.size();
    const Cloth coarse = last ? Cloth() : bendingOverCells(levels[l].cloth, length(settings.gravity));
    const Cloth& cloth = last ? finest.cloth : coarse;
    SettleSettings here = settings;
    here.skin = skinOffset(settings, cloth.spacing, finest.cloth.spacing);
    // Pieces that have yet to be sewn come from anywhere, through each other: cloth meets cloth once they are.
    const bool loose = l == 0 && !sewn && (!last || cloth.pleated) && sewing != Sewing::Meeting;
    std::vector<ThinnerCollider> thinner;
    ColliderList met = colliders;
    if (l == 0 && !sewn && !grownThrough) {
      for (const ColliderList::Entry& entry : colliders) thinner.emplace_back(*entry.collider, settings.sewnThinnerBy);
      met = {};
      for (std::size_t k = 0; k < thinner.size(); ++k) met.add(thinner[k], colliders.entries()[k].friction);
    }
    Prolonged finer;
    if (l > first) finer = prolong(levels[l - 1].cloth, x, cloth, levels[l].state.position);
    LevelSolver solver(cloth, l > first ? finer.linear : levels[l].state.position, met, here,
                       settings.clothOnCloth ? clothRadius(cloth.spacing, finest.cloth.spacing) : 0, workers);
    // The layers of a pleat, and pieces of several layers, lie over one another from the start.
    const bool layered = layersMeet && liesInLayers(cloth);
    solver.enableSelfContact(!loose || layered);
    if (loose && layered) solver.meetOnlyLayers(true);
    const double before = shareBefore(levels, first, l), after = shareBefore(levels, first, l + 1);
    // As long as nothing shrinks, the number of steps left is not known and taken to be the usual one.
    const auto watch = [&](Message doing, double from, double to) {
      const double start = before + (after - before) * from, span = (after - before) * (to - from);
      return [&, start, span, doing = std::move(doing), forecast = RestForecast(), reached = 0.0,
              left = std::optional<double>()](int step, const LevelSolver::StepResult& result) mutable {
        forecast.add(result.work / solver.weight());
        if (const std::optional<double> now = forecast.stepsLeft())
          left = now;
        else if (left)
          left = std::fmax(0.0, *left - 1);
        if (left) left = std::fmin(*left, std::fmax(0.0, settings.maxSteps - step));
        reached = std::fmax(reached, step / (step + left.value_or(kUsualSteps) + 1));
        token.progress(start + span * reached,
                       last && left ? say("{0}, some {1} {1|step|steps} to go", doing, tens(*left)) : doing);
        if (watcher) watcher(cloth, solver.positions());
        const bool asked = settings.stop && settings.stop->askedAfterStep();
        return ++taken != settings.stopAfter && !asked;
      };
    };
    if (sewn) solver.tieWithin(formed ? kSewn * cloth.spacing : kFarApart);
    if (l > first) {  // on the coarse triangles nothing intersects; the rest of the way only as far as that stays so
      for (std::size_t k = 0; k < finer.quadratic.size(); ++k) finer.quadratic[k] -= finer.linear[k];
      solver.moveFiltered(std::move(finer.quadratic));
      solver.moveFiltered(outOfSkin(solver, colliders, here.skin, workers));
    }
    if (formed && !activation.empty()) forceBefore = solver.internalForces();
    StageResult end;
    const auto add = [&] {
      report.steps += end.steps;
      report.solves += end.solves;
    };
    // Once stopped it is only carried on to the finest level.
    if (!stopped && !solver.allTied() && !formed) {
      end = closeSeams(solver, token, watch(say("Drawing the seams together"), 0, 0.4));
      add();
      solver.resetMotion();
      const auto goesOn = [&] { return end.finite && !end.cancelled && !end.stopped; };
      // Layers that snag on each other while they are sewn begin anew, and meet once they are.
      if (goesOn() && loose && layered && !cloth.pleated &&
          (!solver.allTied() || strainOf(cloth, solver.positions()).max > kSnagged)) {
        layersMeet = false;
        continue;
      }
      if (goesOn() && !solver.allTied() && !thinner.empty() && settings.sewnThinnerBy == 0) {
        for (ThinnerCollider& collider : thinner) {
          collider.setPlaces(openPlaces(cloth, solver.positions()));
          collider.setBy(kSunk);
        }
        end = closeSeams(solver, token, watch(say("Drawing the seams together"), 0.1, 0.4));
        add();
        solver.resetMotion();
      }
      if (!thinner.empty() && thinner.front().by() > 0 && goesOn()) {
        end = growColliders(solver, thinner, token, watch(say("Stretching the cloth over the body"), 0.2, 0.4));
        add();
        solver.resetMotion();
        // What was sewn up round a limb that it should lie beside is begun anew on whole colliders.
        if (goesOn() && deepestPenetration(cloth, colliders, solver.positions(), workers) > kGrownThrough) {
          grownThrough = true;
          continue;
        }
      }
    }
    stopped = stopped || end.stopped;
    if (!stopped && end.finite && !end.cancelled) {
      solver.enableSelfContact(true);
      if (loose && layered) solver.meetOnlyLayers(false);
      solver.separateIntersections();
      RestCriteria criteria = last ? finestCriteria(settings, formed && settings.rested)
                                   : RestCriteria{2 * settings.stopMove, 0.75 * settings.stopResidual, 0, 3, 150};
      criteria.sews = formed;
      const bool traced = last && settings.continueAfterRest;
      EnergyTrace trace(solver, settings.gravity, spent);
      StepWatcher draping = watch(say("Draping"), sewn ? 0 : 0.4, 1);
      if (traced) draping = trace.watching(std::move(draping));
      end = relax(solver, settings.gravity, criteria, 1.0 / 60, token, draping);
      add();
      stopped = end.stopped;
      if (last) {
        report.fineSteps = end.steps;
        report.fineSolves = end.solves;
      }
      if (traced && end.settled) {
        const ResourceUse more;
        report.continuation = continueFromRest(solver, settings.gravity, criteria, end, token, trace.watching({}));
        spent.leaveOut(more);
      }
      if (traced) report.energy = trace.take();
    }
    if (end.cancelled || token.cancelled()) return cancelled();
    if (!end.finite) return tornApart();
    addContactTimes(report, solver);
    sewn = solver.allTied();
    if (formed && !sewn && !stopped) {  // it did not close where it stands: start from the coarsest level
      formed = false;
      l = first = 0;
      continue;
    }
    if (last && !activation.empty() && !stopped) forceAfter = solver.internalForces();
    // What goes through itself on a coarse level does so on all finer ones.
    if (!last && first == 0 && !formed && !stopped && sewing != Sewing::FreeAfterAll &&
        (solver.intersections() > 0 || (sewing == Sewing::Meeting && !sewn))) {
      sewing = sewing == Sewing::Free ? Sewing::Meeting : Sewing::FreeAfterAll;
      l = 0;
      sewn = grownThrough = false;
      continue;
    }
    x = last ? finish(solver, colliders, settings, end, report, workers) : solver.positions();
    ++l;
  }
  if (stopped) {
    report.stoppedAfter = taken;
    report.why = say("Stopped after {0} {0|step|steps}, before it came to rest.", taken);
  }
  if (!activation.empty() && !stopped)
    report.toActivate =
        activation.piecesToActivate(forceBefore, forceAfter, x, colliders, settings, kActivationMove, token, workers);
  if (token.cancelled()) return cancelled();
  finest.state.position = std::move(x);
  spent.tell(report);
  return report;
}

}  // namespace karinui
