// From measurements to a finished mannequin: draw the figure, polygonise, lay the tape, take in or let out, repeat.
#include <algorithm>
#include <cmath>

#include "body/chart.h"
#include "body/fitting.h"
#include "body/polygonise.h"
#include "body/section_model.h"
#include "karinui/base/number.h"
#include "karinui/body/body.h"

namespace karinui {

namespace {

constexpr double kCoarse = 0.013, kFine = 0.011;  // grid cells, metres
constexpr double kTriangles = 36000;              // at about this many a body is fine enough
constexpr int kCoarseRounds = 8, kRounds = 20;
constexpr double kGood = 0.3;  // share of the allowed miss at which there is no more to gain
constexpr double kShifts[] = {0, 0.31, 0.57, 0.13, 0.77, 0.43};

// Feet on the floor and exactly as tall as asked for: the polygonised height is off by about a thousandth.
double stand(TriangleMesh& mesh, double height) {
  double low = 1e9, high = -1e9;
  for (const Vec3& p : mesh.points) low = std::min(low, p.y), high = std::max(high, p.y);
  const double scale = height / (high - low);
  for (Vec3& p : mesh.points) p.y = (p.y - low) * scale;
  return scale;
}

bool sound(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  const auto euler = static_cast<long>(report.points) - static_cast<long>(report.triangles) / 2;
  return report.closed() && report.outward && report.shells == 1 && euler == 2 && report.selfCrossings == 0;
}

struct Try {
  TriangleMesh mesh;
  Figure figure;
  Reading reading;
  double worst = 1e9;
};

double worstOf(const std::map<std::string, double>& wanted, const Reading& reading) {
  double worst = 0;
  for (const Miss& miss : misses(wanted, reading)) worst = std::max(worst, miss.share);
  return worst;
}

std::string centimetres(double metres) { return fixed(metres * 100, 1) + " cm"; }

Error unmet(const std::map<std::string, double>& stated, const Reading& reading) {
  Miss worst;
  for (const Miss& miss : misses(stated, reading))
    if (miss.share > worst.share) worst = miss;
  return refused(
      say("No body could be made with {0} {1} beside the other measurements; the nearest has {2}. Change it or leave "
          "it out.",
          worst.key, centimetres(worst.wanted), centimetres(worst.got)));
}

}  // namespace

Result<BodyPtr> makeMannequin(const Measurements& wanted, Workers& workers, const Token& token) {
  if (const Done ok = plausible(wanted); !ok) return ok.error();
  const auto made = mannequinKeys();
  std::map<std::string, double> stated;
  for (const auto& [key, value] : wanted.value) {
    if (std::find(made.begin(), made.end(), key) == made.end())
      return refused(say("A mannequin cannot be made to {0}; it is only measured. Leave it out.", key));
    stated[key] = value;
  }
  const SectionModel model = SectionModel::of(wanted.sex);
  const Measurements complete = model.completed(wanted);
  if (const Done ok = plausible(complete); !ok) return ok.error();
  if (model.distance(complete) > 9)
    return refused(say(
        "These girths do not belong to one body: bust {0}, waist {1}, hip {2} at a height of {3}. Check the numbers.",
        centimetres(complete.value.at("bust_girth")), centimetres(complete.value.at("waist_girth")),
        centimetres(complete.value.at("hip_girth")), centimetres(complete.value.at("height"))));
  // What is aimed at: everything stated, and the girths that follow for the rest of the torso.
  std::map<std::string, double> aim = stated;
  for (const char* key : {"height", "bust_girth", "waist_girth", "hip_girth"})
    if (const auto it = complete.value.find(key); it != complete.value.end()) aim.insert(*it);
  const std::map<std::string, double> usual = model.usual(complete);
  for (const char* key : {"neck_girth", "upper_arm_girth", "wrist_girth"}) aim.insert({key, usual.at(key)});
  const double height = complete.value.at("height");

  Figure figure = model.draw(complete);
  if (!stated.contains("crotch_height")) {
    // Where the legs are joined softly they meet lower than drawn. Only this much: heavy thighs do touch further down.
    figure.at.crotch += 0.015 * height;
    figure.at.hip.y += 0.015 * height;
  }
  Try best;
  double cell = kFine;
  std::size_t shift = 0;
  for (int round = 0; round < kRounds; ++round) {
    if (token.cancelled()) return cancelled();
    token.progress(0.9 * round / kRounds, say("Fitting the mannequin"));
    const bool coarse = round < kCoarseRounds;
    Try now;
    now.figure = figure;
    now.mesh = polygonise(
        fieldOf(figure, coarse ? kCoarse : cell * (1 + 0.07 * kShifts[shift]), coarse ? 0 : kShifts[shift], workers),
        coarse ? 2 : 4, workers);
    if (now.mesh.faces.empty()) return unmet(stated, {});
    stand(now.mesh, height);
    now.reading = readBody(now.mesh);
    now.worst = worstOf(aim, now.reading);
    if (coarse) {
      cell = std::max(kFine, kCoarse * std::sqrt(static_cast<double>(now.mesh.faces.size()) / kTriangles));
      if (now.worst < 0.7) round = kCoarseRounds - 1;
    } else if (now.worst < best.worst) {
      if (now.worst < 1 && !sound(now.mesh)) {
        shift = (shift + 1) % std::size(kShifts);  // an awkward meeting of grid and surface: another grid
        continue;
      }
      best = now;
      if (best.worst < kGood) break;
    }
    if (round > kCoarseRounds + 6 && best.worst < 0.7) break;
    refit(figure, aim, now.reading, round < 3 ? 1.0 : round < 10 ? 0.75 : 0.5);
  }
  if (worstOf(stated, best.reading) > 1 || best.worst > 1e8) return unmet(stated, best.reading);
  if (!sound(best.mesh)) return unmet(stated, best.reading);

  Body::Parts parts;
  parts.name = "mannequin";
  parts.measured = {wanted.sex, best.reading.value};
  parts.landmarks = best.reading.landmark;
  parts.chart = chartOf(best.figure, best.reading);
  parts.mesh = std::move(best.mesh);
  return Body::make(std::move(parts));
}

}  // namespace karinui
