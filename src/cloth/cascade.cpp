#include "cloth/cascade.h"

#include <algorithm>
#include <cmath>

#include "cloth/continuation.h"
#include "cloth/penetration.h"
#include "cloth/strain.h"
#include "cloth/thinner_collider.h"

namespace karinui {
namespace {

constexpr double kActivationMove = 0.002;  // metres: a neighbour that would move further is to be activated
// Metres into a collider: tight cloth of coarse cells stands up to 10 mm deep, cloth with a limb through it 30.
constexpr double kGrownThrough = 0.018;
// The same of cloth that a coarse level sewed up on whole colliders. Of fifty garments none stood deeper than 14 mm but
// two, whose sleeves had the wrist through them, 16 cm round, of cells of 64 mm: 17 mm and then 22, and 28. The middle
// of a child's wrist is 20 mm deep.
constexpr double kLimbThrough = 0.0155;
constexpr double kSnagged = 0.5;     // strain of a coarse thread: no seam that closes freely stretches cloth by half
constexpr double kSeamsShare = 0.4;  // of the work on a level whose seams are open

bool liesInLayers(const Cloth& cloth) {
  return cloth.pleated || std::any_of(cloth.pieces.begin(), cloth.pieces.end(),
                                      [&](const ClothPiece& p) { return p.layer != cloth.pieces.front().layer; });
}

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
// Metres by which a seam of coarse cloth that is stretched by more than kSnagged stands open after every way to sew it,
// so that no finer level closes it. The sleeve of a torn armhole stood 69 mm open, stretched by 60 %: 1,350 steps of
// finer levels left it 519 mm open.
constexpr double kNeverCloses = 0.05;
constexpr double kFolded = 0.008;  // metres: the layers of a pleat lie nearer to each other than this

// Between the sides of seams that stay open.
std::vector<Vec3> openPlaces(const Cloth& cloth, std::span<const Vec3> x) {
  std::vector<Vec3> places;
  for (const Tie& tie : cloth.ties)
    if (const Vec3 gap = gapOf(tie, x); length(gap) > kOpen * cloth.spacing) places.push_back(x[tie.a] + gap * 0.5);
  return places;
}

std::vector<ThinnerCollider> thinnerBy(const ColliderList& colliders, double by) {
  std::vector<ThinnerCollider> thinner;
  for (const ColliderList::Entry& entry : colliders) thinner.emplace_back(*entry.collider, by);
  return thinner;
}

ColliderList listOf(const std::vector<ThinnerCollider>& thinner, const ColliderList& whole) {
  if (thinner.empty()) return whole;
  ColliderList list;
  for (std::size_t k = 0; k < thinner.size(); ++k) list.add(thinner[k], whole.entries()[k].friction);
  return list;
}

SettleSettings settingsOn(const Cloth& cloth, const Cloth& finest, SettleSettings settings) {
  settings.skin = skinOffset(settings, cloth.spacing, finest.spacing);
  return settings;
}

bool goesOn(const StageResult& stage) { return stage.finite && !stage.cancelled && !stage.stopped; }

}  // namespace

// The solver of a level, and what it refers to.
struct Cascade::Level {
  Level(const Cascade& cascade, std::size_t number, const CascadeStart& start)
      : finest(number + 1 == cascade.levels_.size()),
        unsewn(number == 0 && !cascade.sewn_),
        coarse(finest ? Cloth() : bendingOverCells(cascade.levels_[number].cloth, length(cascade.settings_.gravity))),
        cloth(finest ? cascade.levels_.back().cloth : coarse),
        settings(settingsOn(cloth, cascade.levels_.back().cloth, cascade.settings_)),
        loose(unsewn && (!finest || cloth.pleated) && start.sewing != CascadeStart::Sewing::Meeting),
        layered(start.layersMeet && liesInLayers(cloth)),
        thinner(unsewn && !start.grownThrough ? thinnerBy(cascade.colliders_, settings.sewnThinnerBy)
                                              : std::vector<ThinnerCollider>()),
        met(listOf(thinner, cascade.colliders_)),
        prolonged(cascade.prolongTo(number, cloth)),
        solver(cloth, prolonged.linear, met, settings,
               settings.clothOnCloth ? clothRadius(cloth, cascade.levels_.back().cloth.spacing) : 0, cascade.workers_),
        progress{solver, finest, shareBefore(cascade.levels_, cascade.first_, number),
                 shareBefore(cascade.levels_, cascade.first_, number + 1)} {
    // The layers of a pleat, and pieces of several layers, lie over one another from the start.
    solver.enableSelfContact(!loose || layered);
    if (loose && layered) solver.meetOnlyLayers(true);
  }

  bool finest, unsewn;
  Cloth coarse;
  const Cloth& cloth;
  SettleSettings settings;
  // Its pieces have yet to be sewn and come from anywhere, through each other: cloth meets cloth once they are.
  bool loose;
  bool layered;
  std::vector<ThinnerCollider> thinner;
  ColliderList met;
  Prolonged prolonged;
  LevelSolver solver;
  DrapeProgress::Level progress;
};

Cascade::Cascade(const std::vector<ClothLevel>& levels, const ColliderList& colliders, const SettleSettings& settings,
                 const Token& token, Workers& workers, const SettleWatcher& watcher)
    : levels_(levels),
      colliders_(colliders),
      settings_(settings),
      token_(token),
      workers_(workers),
      progress_(settings, token, watcher),
      activation_(levels.back().cloth) {}

Prolonged Cascade::prolongTo(std::size_t level, const Cloth& cloth) const {
  if (level == first_) return {levels_[level].state.position, {}};
  return prolong(levels_[level - 1].cloth, positions, cloth, levels_[level].state.position);
}

void Cascade::count(const StageResult& stage) {
  report.steps += stage.steps;
  report.solves += stage.solves;
}

Result<std::optional<CascadeStart>> Cascade::descend(const CascadeStart& start) {
  first_ = start.formed ? levels_.size() - 1 : 0;
  sewn_ = start.formed;
  for (std::size_t l = first_; l < levels_.size(); ++l) {
    Level level(*this, l, start);
    LevelSolver& solver = level.solver;
    if (sewn_) solver.tieWithin(start.formed ? kSewn * level.cloth.spacing : kFarApart);
    if (l > first_) {  // on the coarse triangles nothing intersects; the rest of the way only as far as that stays so
      std::vector<Vec3>& moves = level.prolonged.quadratic;
      for (std::size_t k = 0; k < moves.size(); ++k) moves[k] -= level.prolonged.linear[k];
      solver.moveFiltered(std::move(moves));
      solver.moveFiltered(outOfSkin(solver, colliders_, level.settings.skin, workers_));
    }
    std::vector<Vec3> forceBefore(activation_.empty() ? 0 : level.cloth.nodeCount);
    if (start.formed && !activation_.empty()) forceBefore = solver.internalForces();
    StageResult end;
    // Once stopped or given up it is only carried on to the finest level.
    if (!ended() && !solver.allTied() && !start.formed)
      if (const auto anew = sew(level, start, end)) return anew;
    stopped_ = stopped_ || end.stopped;
    if (!ended() && end.finite && !end.cancelled) end = relaxed(level, start);
    stopped_ = stopped_ || end.stopped;
    if (end.cancelled || token_.cancelled()) return cancelled();
    if (!end.finite) return tornApart();
    addContactTimes(report, solver);
    sewn_ = solver.allTied();
    if (settings_.giveUpCrossed && !ended() && !level.finest && solver.intersections() > 0)
      givenUp_ = GivenUp{say("Garments that are draped at once stand through each other."), false, true};
    if (settings_.giveUpThroughBody && !ended() && !level.finest)
      if (const Penetration most = deepestPenetration(level.cloth, colliders_, solver.positions(), workers_);
          most.depth > kLimbThrough)
        givenUp_ = GivenUp{throughBody(most), true};
    if (const auto anew = wentWrong(level, start)) return anew;
    if (!level.finest) {
      positions = solver.positions();
      if (!ended()) givenUp_ = hopeless(level, start, end);
      continue;
    }
    const std::vector<Vec3> forceAfter = activation_.empty() || ended() ? std::vector<Vec3>() : solver.internalForces();
    positions = finish(solver, colliders_, settings_, end, report, workers_);
    if (givenUp_ && !stopped_) {
      report.why = givenUp_->why;
      report.throughBody = givenUp_->throughBody;
      report.crossed = givenUp_->crossed;
    }
    if (!activation_.empty() && !ended())
      report.toActivate = activation_.piecesToActivate(forceBefore, forceAfter, positions, colliders_, settings_,
                                                       kActivationMove, token_, workers_);
  }
  if (token_.cancelled()) return cancelled();
  if (stopped_) {
    report.stoppedAfter = progress_.steps();
    report.why = say("Stopped after {0} {0|step|steps}, before it came to rest.", report.stoppedAfter);
  }
  spent_.tell(report);
  return std::optional<CascadeStart>();
}

std::optional<CascadeStart> Cascade::sew(Level& level, const CascadeStart& start, StageResult& end) {
  LevelSolver& solver = level.solver;
  const auto closing = [&](double from) {
    return progress_.watch(level.progress, say("Drawing the seams together"), from, kSeamsShare);
  };
  const auto done = [&](const StageResult& stage) {
    end = stage;
    count(stage);
    solver.resetMotion();
  };
  // The layers of a pleat lie in their order, and are sewn where they lie: drawn together first, they would pass
  // through each other, since nothing keeps a node from the faces at its partner.
  if (level.cloth.pleated) solver.tieWithin(kFolded, true);
  done(closeSeams(solver, token_, closing(0)));
  CascadeStart anew = start;
  // Layers that snag on each other while they are sewn begin anew, and meet once they are.
  if (goesOn(end) && level.loose && level.layered && !level.cloth.pleated &&
      (!solver.allTied() || strainOf(level.cloth, solver.positions()).max > kSnagged)) {
    anew.layersMeet = false;
    return anew;
  }
  if (goesOn(end) && !solver.allTied() && !level.thinner.empty() && settings_.sewnThinnerBy == 0) {
    for (ThinnerCollider& collider : level.thinner) {
      collider.setPlaces(openPlaces(level.cloth, solver.positions()));
      collider.setBy(kSunk);
    }
    done(closeSeams(solver, token_, closing(0.1)));
  }
  if (!level.thinner.empty() && level.thinner.front().by() > 0 && goesOn(end)) {
    done(growColliders(solver, level.thinner, token_,
                       progress_.watch(level.progress, say("Stretching the cloth over the body"), 0.2, kSeamsShare)));
    // What was sewn up round a limb that it should lie beside is begun anew on whole colliders.
    if (goesOn(end) &&
        deepestPenetration(level.cloth, colliders_, solver.positions(), workers_).depth > kGrownThrough) {
      anew.grownThrough = true;
      return anew;
    }
  }
  return std::nullopt;
}

StageResult Cascade::relaxed(Level& level, const CascadeStart& start) {
  LevelSolver& solver = level.solver;
  solver.enableSelfContact(true);
  if (level.loose && level.layered) solver.meetOnlyLayers(false);
  solver.separateIntersections();
  RestCriteria criteria = level.finest ? finestCriteria(settings_, start.formed && settings_.rested)
                                       : RestCriteria{2 * settings_.stopMove, 0.75 * settings_.stopResidual, 0, 3, 150};
  criteria.sews = start.formed;
  const bool traced = level.finest && settings_.continueAfterRest;
  EnergyTrace trace(solver, settings_.gravity, spent_);
  StepWatcher draping = progress_.watch(level.progress, say("Draping"), sewn_ ? 0 : kSeamsShare, 1);
  if (traced) draping = trace.watching(std::move(draping));
  const StageResult end = relax(solver, settings_.gravity, criteria, 1.0 / 60, token_, draping);
  count(end);
  if (level.finest) {
    report.fineSteps = end.steps;
    report.fineSolves = end.solves;
  }
  if (traced && end.settled) {
    const ResourceUse more;
    report.continuation = continueFromRest(solver, settings_.gravity, criteria, end, token_, trace.watching({}));
    spent_.leaveOut(more);
  }
  if (traced) report.energy = trace.take();
  return end;
}

std::optional<CascadeStart> Cascade::wentWrong(Level& level, const CascadeStart& start) const {
  using Sewing = CascadeStart::Sewing;
  if (ended()) return std::nullopt;
  CascadeStart anew = start;
  anew.formed = false;
  if (start.formed)  // did it close where it stands?
    return sewn_ ? std::nullopt : std::optional(anew);
  // What goes through itself on a coarse level does so on all finer ones.
  if (level.finest || start.sewing == Sewing::FreeAfterAll ||
      !(level.solver.intersections() > 0 || (start.sewing == Sewing::Meeting && !sewn_)))
    return std::nullopt;
  anew.sewing = start.sewing == Sewing::Free ? Sewing::Meeting : Sewing::FreeAfterAll;
  anew.grownThrough = false;
  return anew;
}

std::optional<Cascade::GivenUp> Cascade::hopeless(const Level& level, const CascadeStart& start,
                                                  const StageResult& end) const {
  const Cloth& cloth = level.cloth;
  if (const double gap = widestGap(cloth, positions); start.sewing == CascadeStart::Sewing::FreeAfterAll && !sewn_ &&
                                                      gap > kNeverCloses && strainOf(cloth, positions).max > kSnagged)
    return GivenUp{openSeam(cloth, positions, gap, colliders_), false};
  if (end.settled || start.formed) return std::nullopt;
  if (const Penetration most = deepestPenetration(cloth, colliders_, positions, workers_); most.depth > kGrownThrough)
    return GivenUp{throughBody(most), true};
  return std::nullopt;
}

}  // namespace karinui
