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
constexpr std::string_view kOffForm[] = {"crotch", "elbow", "wrist", "knee", "ankle"};  // landmarks a dress form lacks
constexpr double kClearOfTrunk = 0.08;  // metres that shoulders are wider at first, for a stout figure's arms
constexpr double kWaistOfBelly = 0.97;  // of the hip: a waist as wide is likely a belly's
constexpr double kBustMoved = 6;        // tolerances
constexpr double kLittleBelly = 0.02, kBelly = 0.1;  // the logarithm of what a belly's girth is scaled by at first
constexpr Derivative kBellysWaist[] = {{"belly_girth", "waist_girth", 7.0}};
constexpr double kMostUnlike = 12;  // standard deviations from the mean of the described figures
constexpr int kMostMissed = 2;      // grids on which what was stated may not be met
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
  bool stout = false;  // refused where the bust is a shelf of the ribs, off its usual height
};

Result<BodyPtr> made(const Measurements& wanted, const Making& making, Unmet& unmet) {
  Workers& workers = making.workers;
  const Token& token = making.token;
  const MannequinEnds ends = making.ends;
  if (const Done ok = plausible(wanted); !ok) return ok.error();
  const auto keys = mannequinKeys();
  for (const auto& [key, value] : wanted.value) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      return refused(say("A mannequin cannot be made to {0}; it is only measured. Leave it out.", key));
  }
  const SectionModel model = SectionModel::of(wanted.sex);
  const Measurements complete = model.completed(wanted);
  if (const Done ok = plausible(complete); !ok) return ok.error();
  if (model.distance(complete) > kMostUnlike) return unlikeSaid(model, wanted, complete);
  const double height = complete.value.at("height");
  const Figure drawn = model.draw(complete);
  std::vector<Target> targets = targetsFor(wanted, complete, model, drawn.at);
  std::span<const Derivative> free;
  Alteration start{{"shoulder_width", making.wider}};
  if (making.belly > 0) {  // where it is, is where the waist is
    std::erase_if(targets, [](const Target& target) { return target.key == "waist_height" && !target.stated; });
    free = kBellysWaist;
    start["belly_girth"] = making.belly;
  }
  FigureSolver solver(std::move(targets), free);
  solver.startAt(start);

  Drawn now;  // the figure made last
  double cell = kCoarse, shift = 0;
  int polish = 2, tries = 0;
  const FigureSolver::Evaluate evaluate = [&](std::span<const Alteration> ways) {
    std::vector<std::optional<Anthropometry>> measured(ways.size());
    tries += static_cast<int>(ways.size());
    if (!token.cancelled()) token.progress(0.95 * (1 - std::exp(-0.06 * tries)), say("Making the mannequin"));
    const auto make = [&](std::size_t i, Workers& by) {
      if (token.cancelled()) return;
      const Grid grid{cell * (1 + 0.07 * shift), shift, polish};
      std::optional<Drawn> figure = drawnOn(grid, altered(drawn, ways[i]), height, by);
      if (!figure) return;
      measured[i] = figure->measured;
      if (i + 1 == ways.size()) now = *std::move(figure);
    };
    if (ways.size() == 1)
      make(0, workers);
    else
      workers.forBlocks(ways.size(), 1, [&](std::size_t begin, std::size_t) {
        Workers alone;
        make(begin, alone);
      });
    return measured;
  };
  const auto evaluateOne = [&](const Alteration& by) { return evaluate({&by, 1}).front(); };
  double far = solver.solve(evaluate, kCoarseRounds, kNear, 3);
  if (far > kHopeless &&
      !token.cancelled()) {  // where arms lie at the trunk the tape jumps: from there on another grid
    shift = kShifts[1];
    far = solver.solve(evaluate, kCoarseRounds, kNear, 3);
    shift = 0;
    if (far <= kHopeless && !evaluateOne(solver.alteration())) return unsound();  // on the usual grid, to count cells
  }
  if (token.cancelled()) return cancelled();
  const auto none = [&] { return token.cancelled() ? cancelled() : unsound(); };
  if (far > kHopeless) {
    if (!evaluateOne(solver.alteration())) return none();
    unmet = unmetOf(solver, now.measured);
    return unsound();
  }
  cell = std::max(kFine, kCoarse * std::sqrt(static_cast<double>(now.mesh.faces.size()) / kTriangles));
  polish = 4;
  bool met = false;
  int missed = 0;
  for (const double other : kShifts) {  // an awkward meeting of grid and surface: another grid
    shift = other;
    solver.solve(evaluate, kFineRounds, kGood, far > 1 && far < 3 ? 1 : 0);
    if (token.cancelled()) return cancelled();
    if (!evaluateOne(solver.alteration())) return none();
    met = worstResidual(solver.targets(), now.measured, true) <= 1;
    if (met && sound(now.mesh)) break;
    if (!met && allMeasured(solver.targets(), now.measured) && ++missed == kMostMissed) {
      unmet = unmetOf(solver, now.measured);
      return unsound();
    }
    met = false;
  }
  if (!met) return unsound();
  if (making.stout)
    for (const Residual& residual : residuals(solver.targets(), now.measured))
      if (residual.key == "bust_height" && residual.relative > kBustMoved) return unsound();

  Body::Parts parts;
  parts.name = "mannequin";
  parts.measured = {wanted.sex, now.measured.value};
  parts.landmarks = now.measured.landmark;
  parts.chart = chartOf(now.figure, now.measured);
  const auto& value = now.measured.value;
  if (ends == MannequinEnds::Modelled && value.contains("neck_height")) {
    TriangleMesh whole =
        modelled(now.drawn, now.field, now.figure, now.stands, height, value.at("neck_height"), workers);
    if (!whole.faces.empty()) now.mesh = std::move(whole);
  }
  if (ends == MannequinEnds::DressForm) {
    const auto armpit = now.measured.landmark.find("armpit_left");
    if (!value.contains("neck_height") || armpit == now.measured.landmark.end()) return unsound();
    Plane neck = headOf(now.figure, value.at("neck_height") / now.stands.scale + now.stands.low).cut;
    neck.through = now.stands.of(neck.through);
    now.mesh = dressForm(now.mesh, now.stands.of(now.figure.at), armpit->second, neck, value.at("crotch_height"));
    if (!sound(now.mesh)) return unsound();
    // Where the hip is so low that the form closes groin and cleft there, its front and back lie on what closes them.
    for (const SectionLoop& loop : section(now.mesh, {parts.landmarks.at("hip_front"), {0, 1, 0}}))
      for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const Vec3 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
        if ((a.x < 0) == (b.x < 0)) continue;
        const Vec3 middle = lerp(a, b, a.x / (a.x - b.x));
        Vec3& place = parts.landmarks.at(a.x < 0 ? "hip_front" : "hip_back");  // counter-clockwise from above
        if (distance(place, middle) > 1e-6) place = middle;
      }
    std::erase_if(parts.landmarks, [](const auto& at) {
      return std::any_of(std::begin(kOffForm), std::end(kOffForm),
                         [&](std::string_view part) { return at.first.starts_with(part); });
    });
  }
  parts.mesh = std::move(now.mesh);
  return Body::make(std::move(parts));
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
  std::vector<std::pair<double, double>> others{{kClearOfTrunk, 0}, {2 * kClearOfTrunk, 0}};  // wider; a belly
  if (stated("waist_girth") > 0 && stated("belly_girth") == 0) {
    const bool likely = stated("waist_girth") > kWaistOfBelly * stated("hip_girth");
    others.insert(likely ? others.begin() : others.end(),
                  {{0, kBelly}, {kClearOfTrunk, kLittleBelly}, {kClearOfTrunk, kBelly}});
  }
  for (const auto& [wider, has] : others) {
    Unmet ignored;
    auto other = made(wanted, {workers, token, ends, wider, has, true}, ignored);
    if (other || token.cancelled()) return other;
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
