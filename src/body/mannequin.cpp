// From measurements to a finished mannequin: draw the figure, polygonise, measure, alter, repeat.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "body/anthropometry/contour.h"
#include "body/chart.h"
#include "body/dress_form.h"
#include "body/extremity.h"
#include "body/figure_solver.h"
#include "body/polygonise.h"
#include "body/section_model.h"
#include "karinui/base/number.h"
#include "karinui/body/body.h"

namespace karinui {

namespace {

constexpr double kCoarse = 0.014, kFine = 0.011;  // grid cells, metres
constexpr double kTriangles = 36000;              // at about this many a body is fine enough
constexpr int kCoarseRounds = 30, kFineRounds = 10;
constexpr double kNear = 0.6, kGood = 0.4;  // worst residuals, in tolerances, at which the solver may stop
constexpr double kHopeless = 6;             // and at which a finer grid, which moves the tape by 1 or 2, cannot help
constexpr double kHopelessOnAnyGrid = 12;   // of 140 random figures none that could be made was further off
constexpr std::string_view kOffForm[] = {"crotch", "elbow", "wrist", "knee", "ankle"};  // landmarks a dress form lacks
constexpr double kClearOfTrunk = 0.08;  // metres that shoulders are wider at first, for a stout figure's arms
constexpr double kWaistOfBelly = 0.97;  // of the hip: a waist as wide is likely a belly's
constexpr double kBustMoved = 6, kBustMovedOverRibs = 8;  // tolerances
constexpr double kRibs =
    0.94;  // of the bust: the girth under it of a woman with a belly, whose waist says too much of it
constexpr double kLittleBelly = 0.02, kBelly = 0.1;  // the logarithm of what a belly's girth is scaled by at first
constexpr Derivative kBellysWaist[] = {{"belly_girth", "waist_girth", 7.0}};
constexpr double kMostUnlike = 12;  // standard deviations from the mean of the described figures
constexpr int kMostMissed = 2;      // grids on which what was stated may not be met
constexpr double kNearlyMet = 1.7;  // tolerances: a third of a miss, where the ribs are held
constexpr double kShifts[] = {0, 0.31, 0.57, 0.13, 0.77, 0.43};

// Feet on the floor and exactly as tall as asked for: the polygonised height is off by about a thousandth.
struct Standing {
  double low = 0, scale = 1;
  Vec3 of(Vec3 p) const { return {p.x, (p.y - low) * scale, p.z}; }
  TriangleMesh of(TriangleMesh mesh) const {
    for (Vec3& p : mesh.points) p = of(p);
    return mesh;
  }
  Joints of(Joints at) const {  // those a dress form is cut by
    for (Vec3* joint : {&at.shoulder, &at.armpit, &at.tip, &at.ankle}) *joint = of(*joint);
    at.crown = (at.crown - low) * scale;
    return at;
  }
};

Interval heightsOf(const TriangleMesh& mesh) {
  Interval y;
  for (const Vec3& p : mesh.points) y.include(p.y);
  return y;
}

Standing standing(const TriangleMesh& drawn, double height) {
  const Interval y = heightsOf(drawn);
  return {y.low, height / (y.high - y.low)};
}

bool sound(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  const auto euler = static_cast<long>(report.points) - static_cast<long>(report.triangles) / 2;
  return report.closed() && report.outward && report.shells == 1 && euler == 2 && report.selfCrossings == 0;
}

// A figure as its sections draw it, and what the tape says of it.
struct Drawn {
  FieldGrid field;
  TriangleMesh drawn, mesh;
  Standing stands;
  Figure figure;
  Anthropometry measured;
};
struct Grid {
  double cell = 0, shift = 0;
  int polish = 0;
};
std::optional<Drawn> drawnOn(const Grid& grid, Figure figure, double height, Workers& workers) {
  Drawn made;
  made.figure = std::move(figure);
  made.field = fieldOf(made.figure, grid.cell, grid.shift, workers);
  made.drawn = polygonise(made.field, grid.polish, workers);
  if (made.drawn.faces.empty()) return std::nullopt;
  made.stands = standing(made.drawn, height);
  made.mesh = made.stands.of(made.drawn);
  made.measured = anthropometryOf(made.mesh);
  return made;
}

// The drawn figure with modelled head, hands and feet; they reach exactly from the floor to its height, too.
TriangleMesh modelled(const TriangleMesh& drawn, const FieldGrid& field, const Figure& figure, Standing stands,
                      double height, double neckHeight, Workers& workers) {
  const std::vector<Extremity> ends{headOf(figure, neckHeight / stands.scale + stands.low), handOf(figure),
                                    footOf(figure)};
  TriangleMesh mesh = stands.of(withExtremities(drawn, field, ends, workers));
  const Interval y = heightsOf(mesh);
  const double brow = 0.94 * height, instep = 0.02 * height;  // above and below nothing of the drawn figure is left
  for (Vec3& p : mesh.points) {
    if (p.y > brow) p.y = brow + (p.y - brow) * ((height - brow) / (y.high - brow));
    if (p.y < instep) p.y = (p.y - y.low) * (instep / (instep - y.low));
  }
  return mesh;
}

// The targets: everything stated, and what follows from it for the rest of the torso.
std::vector<Target> targetsFor(const Measurements& stated, const Measurements& complete, const SectionModel& model,
                               const Joints& drawn) {
  std::map<std::string, double> follows = {{"waist_height", drawn.waist}, {"crotch_height", drawn.crotch}};
  for (const char* key : {"bust_girth", "waist_girth", "hip_girth"}) follows[key] = complete.value.at(key);
  const auto usual = model.usual(complete);
  for (const char* key : {"neck_girth", "upper_arm_girth", "wrist_girth"}) follows[key] = usual.at(key);
  if (complete.sex == Sex::Female) {
    follows["bust_height"] = drawn.bust;
    follows["under_bust_girth"] = complete.value.at("under_bust_girth");
  }
  std::vector<Target> targets;
  for (const auto& [key, value] : stated.value)
    if (key != "height") targets.push_back({key, value, true});
  if (stated.value.contains("belly_girth"))  // the waist is what the belly leaves of it
    for (const char* key : {"waist_girth", "waist_height"}) follows.erase(key);
  for (const auto& [key, value] : follows)
    if (!stated.value.contains(key)) targets.push_back({key, value, false});
  return targets;
}

Error unsound() { return refused(say("No sound body could be made from these measurements; leave some out.")); }

// Whether the tape could be taken for all that was stated.
bool allMeasured(const std::vector<Target>& targets, const Anthropometry& measured) {
  return std::all_of(targets.begin(), targets.end(),
                     [&](const Target& target) { return !target.stated || measured.value.contains(target.key); });
}

// What was stated and could not be met, and what stands against it.
struct Unmet {
  std::string key, other;                       // other: empty if it is no single measure
  double wanted = 0, got = 0, otherWanted = 0;  // got: where the solver stopped; 0: it could not be measured
};

Unmet unmetOf(const FigureSolver& solver, const Anthropometry& measured) {
  Residual worst;
  const auto all = residuals(solver.targets(), measured);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (solver.targets()[i].stated && all[i].relative > worst.relative) worst = all[i];
  if (worst.key.empty()) return {};
  Unmet unmet{worst.key, solver.conflictsWith(worst.key), worst.wanted, worst.got, 0};
  for (const Residual& its : all)
    if (its.key == unmet.other) unmet.otherWanted = its.wanted;
  return unmet;
}

// `limit`: the nearest of what was tried that can be made; none: nothing was found.
Error unmetSaid(const Unmet& unmet, std::optional<double> limit) {
  const std::string& key = unmet.key;
  const Message wanted = measureSaid(key, unmet.wanted);
  if (!limit && !unmet.other.empty())
    return refused(say("{0} {1} and {2} {3} do not go together. Change one of them, or leave it out.", key, wanted,
                       unmet.other, measureSaid(unmet.other, unmet.otherWanted)));
  if (!limit)
    return refused(say("No body could be made with {0} {1} beside the other measurements. Change it or leave it out.",
                       key, wanted));
  const Message nearest = measureSaid(key, *limit);
  if (unmet.other.empty())
    return refused(
        say("No body could be made with {0} {1} beside the other measurements; the nearest has {2}. Change it or leave "
            "it out.",
            key, wanted, nearest));
  const Message had = measureSaid(unmet.other, unmet.otherWanted);
  return *limit < unmet.wanted
             ? refused(say("{0} {1} and {2} {3} do not go together: with this {2}, {0} is at most {4}.", key, wanted,
                           unmet.other, had, nearest))
             : refused(say("{0} {1} and {2} {3} do not go together: with this {2}, {0} is at least {4}.", key, wanted,
                           unmet.other, had, nearest));
}

// Girths that no body has together: those that were stated, and which of them alone is in the way.
Error unlikeSaid(const SectionModel& model, const Measurements& wanted, const Measurements& complete) {
  const std::pair<const char*, Message> kNamed[] = {{"bust_girth", say("bust")},
                                                    {"under_bust_girth", say("under the bust")},
                                                    {"waist_girth", say("waist")},
                                                    {"hip_girth", say("hip")}};
  const auto stated = std::count_if(std::begin(kNamed), std::end(kNamed),
                                    [&](const auto& one) { return wanted.value.contains(one.first); });
  std::optional<Message> all, odd;
  double least = kMostUnlike;
  for (const auto& [key, name] : kNamed) {
    const auto value = complete.value.find(key);
    if (value == complete.value.end() || (stated > 1 && !wanted.value.contains(key))) continue;
    const Message one = say("{0} {1}", name, measureSaid(key, value->second));
    all = all ? say("{0}, {1}", *all, one) : one;
    Measurements without = wanted;
    if (stated < 3 || without.value.erase(key) == 0) continue;  // of two either may be meant
    const double far = model.distance(model.completed(without));
    if (far < least) least = far, odd = one;
  }
  const Message height = measureSaid("height", complete.value.at("height"));
  if (odd)
    return refused(
        say("These girths do not belong to one body: {0} at a height of {1}. Without {2} they would; check "
            "that number first.",
            *all, height, *odd));
  return refused(
      say("These girths do not belong to one body: {0} at a height of {1}. Check the numbers.", *all, height));
}

// What a mannequin is made with, and where the solver starts from the drawn figure.
struct Making {
  Workers& workers;
  const Token& token;
  MannequinEnds ends = MannequinEnds::Modelled;
  double wider = 0;    // metres, of the shoulders
  double belly = 0;    // more than 0: the waist may be that of a belly, whose girth is scaled by so much (logarithm)
  bool ribs = false;   // the girth under the bust is held at kRibs where it only follows
  bool stout = false;  // refused where the bust is a shelf of the ribs, off its usual height
};

// Solves for a figure, first on a coarse grid and then on fine ones, until the tape says what was asked for.
class FigureFit {
 public:
  FigureFit(const Making& making, Figure drawn, double height, std::vector<Target> targets)
      : making_(making), drawn_(std::move(drawn)), height_(height), solver_(solverFor(making, std::move(targets))) {}

  Result<Drawn> run(Unmet& unmet) {
    if (const Done ok = onCoarseGrid(unmet); !ok) return ok.error();
    if (const Done ok = onFineGrids(unmet); !ok) return ok.error();
    if (making_.stout)
      for (const Residual& residual : residuals(solver_.targets(), now_.measured))
        if (residual.key == "bust_height" && residual.relative > (making_.ribs ? kBustMovedOverRibs : kBustMoved))
          return unsound();
    return std::move(now_);
  }

 private:
  static FigureSolver solverFor(const Making& making, std::vector<Target> targets) {
    std::span<const Derivative> free;
    Alteration start{{"shoulder_width", making.wider}};
    if (making.belly > 0) {  // where it is, is where the waist is
      std::erase_if(targets, [](const Target& target) { return target.key == "waist_height" && !target.stated; });
      free = kBellysWaist;
      start["belly_girth"] = making.belly;
    }
    FigureSolver solver(std::move(targets), free);
    solver.startAt(start);
    return solver;
  }

  // Keeps the last of the figures.
  std::vector<std::optional<Anthropometry>> evaluate(std::span<const Alteration> ways) {
    std::vector<std::optional<Anthropometry>> measured(ways.size());
    const Token& token = making_.token;
    tries_ += static_cast<int>(ways.size());
    if (!token.cancelled()) token.progress(0.95 * (1 - std::exp(-0.06 * tries_)), say("Making the mannequin"));
    const auto make = [&](std::size_t i, Workers& by) {
      if (token.cancelled()) return;
      const Grid grid{cell_ * (1 + 0.07 * shift_), shift_, polish_};
      std::optional<Drawn> figure = drawnOn(grid, altered(drawn_, ways[i]), height_, by);
      if (!figure) return;
      measured[i] = figure->measured;
      if (i + 1 == ways.size()) now_ = *std::move(figure);
    };
    if (ways.size() == 1)
      make(0, making_.workers);
    else
      making_.workers.forBlocks(ways.size(), 1, [&](std::size_t begin, std::size_t) {
        Workers alone;
        make(begin, alone);
      });
    return measured;
  }
  bool makeBest() { return evaluate({&solver_.alteration(), 1}).front().has_value(); }
  double solve(int rounds, double enough, int differences) {
    return solver_.solve([this](std::span<const Alteration> ways) { return evaluate(ways); }, rounds, enough,
                         differences);
  }
  Error notMade() const { return making_.token.cancelled() ? cancelled() : unsound(); }

  Done onCoarseGrid(Unmet& unmet) {
    far_ = solve(kCoarseRounds, kNear, 3);
    if (far_ > kHopeless && (far_ < kHopelessOnAnyGrid || far_ == kNotMeasured) && !making_.token.cancelled()) {
      shift_ = kShifts[1];  // where arms lie at the trunk the tape jumps: from there on another grid
      far_ = solve(kCoarseRounds, kNear, 3);
      shift_ = 0;
      if (far_ <= kHopeless && !makeBest()) return unsound();  // on the usual grid, to count cells
    }
    if (making_.token.cancelled()) return cancelled();
    if (far_ <= kHopeless) return {};
    if (!makeBest()) return notMade();
    unmet = unmetOf(solver_, now_.measured);
    return unsound();
  }

  Done onFineGrids(Unmet& unmet) {
    cell_ = std::max(kFine, kCoarse * std::sqrt(static_cast<double>(now_.mesh.faces.size()) / kTriangles));
    polish_ = 4;
    double missed = 0;
    for (const double other : kShifts) {  // an awkward meeting of grid and surface: another grid
      shift_ = other;
      solve(kFineRounds, kGood, far_ > 1 && far_ < 3 ? 1 : 0);
      if (making_.token.cancelled()) return cancelled();
      if (!makeBest()) return notMade();
      const double worst = worstResidual(solver_.targets(), now_.measured, true);
      if (worst <= 1 && sound(now_.mesh)) return {};
      if (worst <= 1 || !allMeasured(solver_.targets(), now_.measured)) continue;
      missed += making_.ribs && worst < kNearlyMet ? 1.0 / 3 : 1;
      if (missed >= kMostMissed) {
        unmet = unmetOf(solver_, now_.measured);
        return unsound();
      }
    }
    return unsound();
  }

  const Making& making_;
  const Figure drawn_;
  const double height_;
  FigureSolver solver_;
  Drawn now_;  // the figure made last
  double cell_ = kCoarse, shift_ = 0;
  int polish_ = 2, tries_ = 0;
  double far_ = 0;  // the worst residual on the coarse grid
};

// The landmarks that are on a dress form of this mesh.
std::map<std::string, Vec3> landmarksOnForm(std::map<std::string, Vec3> landmarks, const TriangleMesh& form) {
  // Where the hip is so low that the form closes groin and cleft there, its front and back lie on what closes them.
  for (const SectionLoop& loop : section(form, {landmarks.at("hip_front"), {0, 1, 0}}))
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const Vec3 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
      if ((a.x < 0) == (b.x < 0)) continue;
      const Vec3 middle = lerp(a, b, a.x / (a.x - b.x));
      Vec3& place = landmarks.at(a.x < 0 ? "hip_front" : "hip_back");  // counter-clockwise from above
      if (distance(place, middle) > 1e-6) place = middle;
    }
  std::erase_if(landmarks, [](const auto& at) {
    return std::any_of(std::begin(kOffForm), std::end(kOffForm),
                       [&](std::string_view part) { return at.first.starts_with(part); });
  });
  return landmarks;
}

Result<BodyPtr> bodyOf(Drawn figure, Sex sex, double height, const Making& making) {
  const auto& value = figure.measured.value;
  Body::Parts parts;
  parts.name = "mannequin";
  parts.measured = {sex, value};
  parts.landmarks = figure.measured.landmark;
  parts.chart = chartOf(figure.figure, figure.measured);
  if (making.ends == MannequinEnds::Modelled && value.contains("neck_height")) {
    TriangleMesh whole = modelled(figure.drawn, figure.field, figure.figure, figure.stands, height,
                                  value.at("neck_height"), making.workers);
    if (!whole.faces.empty()) figure.mesh = std::move(whole);
  }
  if (making.ends == MannequinEnds::DressForm) {
    const auto armpit = parts.landmarks.find("armpit_left");
    if (!value.contains("neck_height") || armpit == parts.landmarks.end()) return unsound();
    Plane neck = headOf(figure.figure, value.at("neck_height") / figure.stands.scale + figure.stands.low).cut;
    neck.through = figure.stands.of(neck.through);
    figure.mesh =
        dressForm(figure.mesh, figure.stands.of(figure.figure.at), armpit->second, neck, value.at("crotch_height"));
    if (!sound(figure.mesh)) return unsound();
    parts.landmarks = landmarksOnForm(std::move(parts.landmarks), figure.mesh);
  }
  parts.mesh = std::move(figure.mesh);
  return Body::make(std::move(parts));
}

Result<BodyPtr> made(const Measurements& wanted, const Making& making, Unmet& unmet) {
  if (const Done ok = plausible(wanted); !ok) return ok.error();
  const auto keys = mannequinKeys();
  for (const auto& [key, value] : wanted.value)
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      return refused(say("A mannequin cannot be made to {0}; it is only measured. Leave it out.", key));
  const SectionModel model = SectionModel::of(wanted.sex);
  const Measurements complete = model.completed(wanted);
  if (const Done ok = plausible(complete); !ok) return ok.error();
  if (model.distance(complete) > kMostUnlike) return unlikeSaid(model, wanted, complete);
  const double height = complete.value.at("height");
  Figure drawn = model.draw(complete);
  std::vector<Target> targets = targetsFor(wanted, complete, model, drawn.at);
  if (making.ribs)
    for (Target& target : targets)
      if (target.key == "under_bust_girth" && !target.stated)
        target.value = std::fmin(target.value, kRibs * complete.value.at("bust_girth"));
  Result<Drawn> figure = FigureFit(making, std::move(drawn), height, std::move(targets)).run(unmet);
  if (!figure) return figure.error();
  return bodyOf(*std::move(figure), wanted.sex, height, making);
}

// The stated girth without which the others can be met: what the solver's slopes do not tell where it stopped far off.
std::string inTheWay(const Measurements& wanted, const Unmet& unmet, const Making& by) {
  Unmet ignored;
  for (const char* key : {"waist_girth", "hip_girth", "belly_girth", "under_bust_girth", "bust_girth"}) {
    Measurements others = wanted;
    if (key == unmet.key || others.value.erase(key) == 0 || by.token.cancelled()) continue;
    if (made(others, by, ignored)) return key;
  }
  return {};
}

// Where the solver stops is no limit yet: what is told as one has been made. Tried are that place, what follows
// without the measure, and the middle between.
std::optional<double> nearestMade(Measurements wanted, const Unmet& unmet, const Making& by) {
  Unmet ignored;
  const auto canBe = [&](double value) {
    constexpr double kStep = 1e-3;  // metres: as it is told
    value = wanted.value[unmet.key] = std::round(value / kStep) * kStep;
    return !by.token.cancelled() && made(wanted, by, ignored) ? std::optional(value) : std::nullopt;
  };
  if (unmet.got > 0)
    if (const auto here = canBe(unmet.got)) return here;
  wanted.value.erase(unmet.key);
  const auto without = made(wanted, by, ignored);
  if (!without || !(*without)->measured().value.contains(unmet.key)) return std::nullopt;
  const double free = (*without)->measured().value.at(unmet.key);
  if (unmet.got > 0)
    if (const auto middle = canBe(std::midpoint(unmet.got, free))) return middle;
  return canBe(free);
}

}  // namespace

Result<BodyPtr> makeMannequin(const Measurements& wanted, Workers& workers, const Token& token, MannequinEnds ends) {
  const Making by{workers, token, ends};
  Unmet unmet;
  auto body = made(wanted, by, unmet);
  if (body || unmet.key.empty()) return body;
  // The arms of a stout figure, as it is drawn, lie in its trunk, where no tape goes round them. And whose waist is as
  // wide as the hip has a belly there.
  const auto stated = [&](const char* key) { return wanted.value.contains(key) ? wanted.value.at(key) : 0; };
  struct Start {
    double wider, belly;
    bool ribs = false;
  };
  std::vector<Start> others{{kClearOfTrunk, 0}, {2 * kClearOfTrunk, 0}};
  if (stated("waist_girth") > 0 && stated("belly_girth") == 0) {
    const bool likely = stated("waist_girth") > kWaistOfBelly * stated("hip_girth");
    others.insert(likely ? others.begin() : others.end(),
                  {{0, kBelly}, {kClearOfTrunk, kLittleBelly}, {kClearOfTrunk, kBelly}});
    if (likely && wanted.sex == Sex::Female)
      others.insert(stated("waist_girth") > stated("hip_girth") ? others.begin() : others.end(),
                    {{kClearOfTrunk, 0.3 * kBelly, true}, {1.5 * kClearOfTrunk, 0.5 * kBelly, true}});
  }
  for (const Start& start : others) {
    Unmet ignored;
    auto other = made(wanted, {workers, token, ends, start.wider, start.belly, start.ribs, true}, ignored);
    if (other || token.cancelled()) return other;
  }
  // What was taken for the waist may be the belly, as the widest place there.
  if (stated("waist_girth") > kWaistOfBelly * stated("hip_girth") && stated("belly_girth") == 0 &&
      stated("under_bust_girth") == 0) {
    Measurements ofBelly = wanted;
    ofBelly.value["belly_girth"] = stated("waist_girth");
    ofBelly.value.erase("waist_girth");
    Unmet ignored;
    if (made(ofBelly, by, ignored))
      return refused(
          say("No body could be made with waist_girth {0} beside the other measurements. If it was taken where the "
              "belly is widest, state it as belly_girth in its place: such a figure can be made.",
              measureSaid("waist_girth", stated("waist_girth"))));
  }
  // Ribs narrower than the waist are more in its way than the hip, whatever the slopes say.
  const double ribs = stated("under_bust_girth");
  if (unmet.key == "waist_girth" && ribs > 0 && ribs < unmet.wanted)
    unmet.other = "under_bust_girth", unmet.otherWanted = ribs;
  else if (unmet.other.empty())
    if (const std::string other = inTheWay(wanted, unmet, by); !other.empty())
      unmet.other = other, unmet.otherWanted = wanted.value.at(other);
  const auto limit = nearestMade(wanted, unmet, by);
  if (token.cancelled()) return cancelled();
  return unmetSaid(unmet, limit);
}

}  // namespace karinui
