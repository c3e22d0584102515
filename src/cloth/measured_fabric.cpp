#include "karinui/cloth/measured_fabric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "karinui/base/number.h"
#include "karinui/cloth/drape_disc.h"

namespace karinui {

namespace {

constexpr double kGravity = 9.81;                   // m/s2
constexpr double kLightest = 0.005, kHeaviest = 5;  // kg/m2, as checkFabric() has it

double square(double x) { return x * x; }

Message grainSaid(Grain grain) {
  return grain == Grain::Warp   ? say("along the warp")
         : grain == Grain::Weft ? say("along the weft")
                                : say("on the bias");
}

// The elastica from its free tip, in units of the bending length, where it is held level: how long it is, and the angle
// of the line from there to its tip. phi'' = s sin(phi), phi counted from upright.
struct Elastica {
  double length = 0, angle = 0;
};
Elastica elasticaFrom(double tip) {
  constexpr double kStep = 0.002, kHalf = std::numbers::pi / 2;
  double s = 0, phi = tip, slope = 0, reach = 0, fall = 0;
  while (phi < kHalf) {
    const auto bend = [](double at, double angle) { return at * std::sin(angle); };
    const double h = kStep;
    const double a1 = slope, b1 = bend(s, phi), a2 = slope + h / 2 * b1, b2 = bend(s + h / 2, phi + h / 2 * a1);
    const double a3 = slope + h / 2 * b2, b3 = bend(s + h / 2, phi + h / 2 * a2), a4 = slope + h * b3;
    const double b4 = bend(s + h, phi + h * a3);
    const double next = phi + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), middle = phi + h / 2 * slope + h * h / 8 * b1;
    const double share = next > kHalf ? (kHalf - phi) / (next - phi) : 1;  // of the last step
    reach += share * h / 6 * (std::sin(phi) + 4 * std::sin(middle) + std::sin(next));
    fall += share * h / 6 * (std::cos(phi) + 4 * std::cos(middle) + std::cos(next));
    slope += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    phi = next;
    s += share * h;
  }
  return {s, std::atan2(fall, reach)};
}

// As the solver has it (fabric.h).
double bendOnBias(const Fabric& fabric) {
  return 0.5 * (0.5 * (fabric.bendWarp + fabric.bendWeft) + std::sqrt(fabric.bendWarp * fabric.bendWeft));
}

// Readings that are to be positive lengths or masses within what a table gives.
Done checkReadings(const std::vector<double>& readings, double low, double high, const Message& what, double scale,
                   const char* unit) {
  for (const double r : readings)
    if (!(r >= low && r <= high))
      return badInput(say("{0}: a reading of {1} {4}; it must lie between {2} and {3} {4}.", what, fixed(r * scale, 1),
                          fixed(low * scale, 1), fixed(high * scale, 1), unit));
  return {};
}

Done checkTable(const TableReadings& t) {
  if (t.swatchMasses.empty())
    return badInput(
        say("Weigh a swatch first: its length, its width and its mass. All else is counted from its weight."));
  for (const double side : {t.swatchLength, t.swatchWidth})
    if (const Done ok = checkReadings({side}, 0.02, 2, say("Side of the swatch"), 1000, "mm"); !ok) return ok;
  if (const Done ok = checkReadings(t.swatchMasses, 1e-5, 5, say("Mass of the swatch"), 1000, "g"); !ok) return ok;
  if (const Done ok = checkReadings(t.thicknesses, 1e-5, 0.02, say("Thickness"), 1000, "mm"); !ok) return ok;
  if (const Done ok = checkReadings({t.ruler}, 0, 0.01, say("Error of the ruler"), 1000, "mm"); !ok) return ok;
  if (const Done ok = checkReadings({t.scales}, 0, 0.1, say("Error of the scales"), 1000, "g"); !ok) return ok;
  if (const Done ok = checkReadings({t.angle}, 0, 10 * kDegree, say("Error of the angle"), 1 / kDegree, "°"); !ok)
    return ok;
  if (const Done ok = checkReadings(t.drapes, 0.15, 0.93, say("Drape of the disc"), 100, "%"); !ok) return ok;
  if (!t.drapes.empty() &&
      std::any_of(t.overhang.begin(), t.overhang.end(), [](const Overhang& over) { return !over.lengths.empty(); }))
    return badInput(say("Bending is measured by strips or by a disc, not by both; leave one out."));
  bool hung = false;
  for (std::size_t g = 0; g < kGrains; ++g) {
    const Message grain = grainSaid(static_cast<Grain>(g));
    const Overhang& over = t.overhang[g];
    if (const Done ok = checkReadings(over.lengths, 0.005, 1, say("Overhang {0}", grain), 1000, "mm"); !ok) return ok;
    if (const Done ok = checkReadings(over.angles, 5 * kDegree, 80 * kDegree, say("Angle of the overhang {0}", grain),
                                      1 / kDegree, "°");
        !ok)
      return ok;
    if (over.lengths.empty() && !over.angles.empty())
      return badInput(say("The angle of the overhang {0} is given, but not its length.", grain));
    for (const HungWeight& one : t.hung[g]) {
      hung = true;
      if (one.lengths.empty()) return badInput(say("A weight hung {0}, but no length was read under it.", grain));
      if (const Done ok = checkReadings({one.mass}, 0.001, 50, say("Weight hung {0}", grain), 1000, "g"); !ok)
        return ok;
      const double mean = meanOf(one.lengths, 0).value;
      if (!(mean > t.stripLength && mean < 3 * t.stripLength) && t.stripLength > 0)
        return badInput(
            say("The strip {0} is {1} mm long under {2} g and {3} mm without; it must be longer, and less "
                "than three times.",
                grain, fixed(mean * 1000, 1), fixed(one.mass * 1000, 0), fixed(t.stripLength * 1000, 1)));
    }
  }
  if (hung && !(t.stripLength > 0 && t.stripWidth > 0))
    return badInput(
        say("A weight hangs on a strip; say how far apart its marks are without the weight, and how wide it is."));
  if (hung)
    for (const double side : {t.stripLength, t.stripWidth})
      if (const Done ok = checkReadings({side}, 0.005, 2, say("Side of the strip"), 1000, "mm"); !ok) return ok;
  return {};
}

Uncertain bendingOf(const Overhang& over, Uncertain weight, const TableReadings& t) {
  const Uncertain length = meanOf(over.lengths, t.ruler);
  const Uncertain angle = over.angles.empty() ? Uncertain{kPeirceAngle, t.angle} : meanOf(over.angles, t.angle);
  constexpr double kNear = 1e-3;
  const double heavy = elasticaWeight(angle.value);
  const double slope =
      (elasticaWeight(angle.value + kNear) - elasticaWeight(angle.value - kNear)) / (2 * kNear * heavy);
  const double bend = weight.value * kGravity * std::pow(length.value, 3) / heavy;
  return {bend, bend * std::sqrt(square(weight.error / weight.value) + square(3 * length.error / length.value) +
                                 square(slope * angle.error))};
}

// Of a disc that was laid on several times: the mean of warp and weft. A picture's outline is good to a hundredth.
Uncertain bendingOfDisc(const std::vector<double>& drapes, Uncertain weight) {
  constexpr double kOutline = 0.01;
  const Uncertain share = meanOf(drapes, kOutline);
  const double bend = weight.value * kGravity * std::pow(bendingLengthOfDrape(share.value), 3);
  const double length = std::hypot(kDrapeSpread, drapeSlope(share.value) * share.error);
  return {bend, bend * std::hypot(3 * length, weight.error / weight.value)};
}

struct Stretched {
  double force = 0;  // N/m
  Uncertain strain;
};
std::vector<Stretched> stretchedBy(const std::vector<HungWeight>& hung, const TableReadings& t) {
  std::vector<Stretched> all;
  for (const HungWeight& one : hung) {
    const Uncertain length = meanOf(one.lengths, t.ruler);
    all.push_back({one.mass * kGravity / t.stripWidth,
                   {length.value / t.stripLength - 1, std::hypot(length.error, t.ruler) / t.stripLength}});
  }
  return all;
}

// By how much the strains of a curve are to be stretched so that it passes through what was measured.
Uncertain stretchOf(const ThreadCurve& curve, const std::vector<Stretched>& all, const TableReadings& t) {
  double sum = 0, weights = 0;
  std::vector<double> logs;
  for (const Stretched& one : all) {
    const double strain = curve.strainAt(one.force);
    // A wrong width or weight is a wrong force, which moves the strain as steeply as the curve is there.
    const double force = std::hypot(t.ruler / t.stripWidth, t.scales / (one.force * t.stripWidth / kGravity));
    const double steep = one.force / (strain * curve.tangent(strain));
    const double error = std::hypot(one.strain.error / one.strain.value, steep * force);
    const double weight = 1 / std::fmax(1e-12, square(error));
    logs.push_back(std::log(one.strain.value / strain));
    sum += weight * logs.back(), weights += weight;
  }
  const double mean = sum / weights;
  double spread = 0;
  for (const double l : logs) spread += square(l - mean);
  if (logs.size() > 1) spread = std::sqrt(spread / static_cast<double>(logs.size() * (logs.size() - 1)));
  const double value = std::exp(mean);
  return {value, value * std::fmax(std::sqrt(1 / weights), spread)};
}

struct Measured {  // what does not depend on the fabric it is like
  Uncertain weight;
  std::array<std::optional<Uncertain>, kGrains> bend;
  std::array<std::vector<Stretched>, kGrains> stretched;
  std::optional<Uncertain> thickness;
  std::optional<Uncertain> disc;  // bending, the mean of warp and weft
};

// Root mean square of the logarithms of what was measured over what a preset has.
double awayFrom(const Fabric& preset, const Measured& m, const TableReadings& t) {
  std::vector<double> logs{std::log(m.weight.value / preset.weight)};
  if (m.bend[0]) logs.push_back(std::log(m.bend[0]->value / preset.bendWarp));
  if (m.bend[1]) logs.push_back(std::log(m.bend[1]->value / preset.bendWeft));
  if (m.disc) logs.push_back(std::log(2 * m.disc->value / (preset.bendWarp + preset.bendWeft)));
  if (!m.stretched[0].empty()) logs.push_back(std::log(stretchOf(preset.warpCurve(), m.stretched[0], t).value));
  if (!m.stretched[1].empty()) logs.push_back(std::log(stretchOf(preset.weftCurve(), m.stretched[1], t).value));
  if (m.thickness) logs.push_back(std::log(m.thickness->value / preset.thickness));
  return std::sqrt(std::inner_product(logs.begin(), logs.end(), logs.begin(), 0.0) / static_cast<double>(logs.size()));
}

Result<Fabric> likeOf(const Measured& m, const TableReadings& t) {
  if (!t.like.empty()) {
    auto named = preset(t.like);
    if (named && named->law != Fabric::Law::Woven)
      return badInput(say("“{0}” has no bending to compare with; choose another fabric to start from.", t.like));
    return named;
  }
  const Fabric* nearest = nullptr;
  for (const Fabric& one : presets())
    if (one.law == Fabric::Law::Woven && (!nearest || awayFrom(one, m, t) < awayFrom(*nearest, m, t))) nearest = &one;
  return *nearest;
}

void stretchThreads(Fabric& fabric, Grain grain, double by) {
  const bool warp = grain == Grain::Warp;
  (warp ? fabric.stretchWarp : fabric.stretchWeft) /= by;
  (warp ? fabric.toeWarp : fabric.toeWeft) *= by;
  (warp ? fabric.stiffenWarp : fabric.stiffenWeft) /= by;
}

// Shear from strips on the bias.
Result<Uncertain> shearOf(const Fabric& fabric, const std::vector<Stretched>& all) {
  double sum = 0, weights = 0;
  for (const Stretched& one : all) {
    const double half = one.force / 2;
    const double angle = 2 * one.strain.value - fabric.warpCurve().strainAt(half) - fabric.weftCurve().strainAt(half);
    if (!(angle > 0))
      return badInput(
          say("On the bias the strip stretches by {0} %, less than its threads alone would. Measure again, or "
              "measure the stretch of warp and weft too.",
              fixed(100 * one.strain.value, 2)));
    const double sheared = angle + fabric.shearStiffen * angle * angle * angle;
    const double slope = 1 + 3 * fabric.shearStiffen * angle * angle;
    const double error = 2 * one.strain.error * slope / sheared, weight = 1 / std::fmax(1e-12, square(error));
    sum += weight * std::log(half / sheared), weights += weight;
  }
  const double value = std::exp(sum / weights);
  return Uncertain{value, value * std::sqrt(1 / weights)};
}

}  // namespace

Uncertain meanOf(const std::vector<double>& readings, double tool) {
  const auto n = static_cast<double>(readings.size());
  const double mean = std::accumulate(readings.begin(), readings.end(), 0.0) / n;
  double spread = 0;
  for (const double r : readings) spread += square(r - mean);
  return {mean, readings.size() > 1 ? std::sqrt(spread / (n * (n - 1)) + square(tool)) : tool};
}

double elasticaWeight(double angle) {
  double low = std::log(1e-12), high = std::log(std::numbers::pi / 2);  // of the tip's angle from upright
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (elasticaFrom(std::exp(middle)).angle > angle ? low : high) = middle;
  }
  return std::pow(elasticaFrom(std::exp(low)).length, 3);
}

Result<MeasuredFabric> measuredFabric(const TableReadings& t) {
  if (const Done ok = checkTable(t); !ok) return ok.error();
  Measured m;
  const Uncertain mass = meanOf(t.swatchMasses, t.scales);
  m.weight.value = mass.value / (t.swatchLength * t.swatchWidth);
  m.weight.error = m.weight.value * std::sqrt(square(mass.error / mass.value) + square(t.ruler / t.swatchLength) +
                                              square(t.ruler / t.swatchWidth));
  if (const Done ok = checkReadings({m.weight.value}, kLightest, kHeaviest,
                                    say("Weight of a square metre, from the swatch's mass and sides"), 1000, "g");
      !ok)
    return ok.error();
  for (std::size_t g = 0; g < kGrains; ++g) {
    if (!t.overhang[g].lengths.empty()) m.bend[g] = bendingOf(t.overhang[g], m.weight, t);
    m.stretched[g] = stretchedBy(t.hung[g], t);
  }
  if (!t.thicknesses.empty()) m.thickness = meanOf(t.thicknesses, 0);
  if (!t.drapes.empty()) m.disc = bendingOfDisc(t.drapes, m.weight);
  const Result<Fabric> like = likeOf(m, t);
  if (!like) return like.error();

  MeasuredFabric out;
  out.fabric = *like, out.like = like->name;
  Fabric& fabric = out.fabric;
  const auto take = [&](double Fabric::*field, Uncertain value) {
    fabric.*field = value.value;
    out.numbers.push_back({field, value});
  };
  take(&Fabric::weight, m.weight);
  const auto& [warp, weft, bias] = m.bend;
  if (warp) take(&Fabric::bendWarp, *warp);
  if (weft) take(&Fabric::bendWeft, *weft);
  if (warp && !weft) fabric.bendWeft *= fabric.bendWarp / like->bendWarp;
  if (weft && !warp) fabric.bendWarp *= fabric.bendWeft / like->bendWeft;
  if (bias && !warp && !weft) {
    const double by = bias->value / bendOnBias(*like);
    fabric.bendWarp *= by, fabric.bendWeft *= by;
  }
  if (m.disc)  // warp and weft as they are to each other in the preset
    for (double Fabric::*field : {&Fabric::bendWarp, &Fabric::bendWeft}) {
      const double share = 2 * (*like).*field / (like->bendWarp + like->bendWeft);
      take(field, {m.disc->value * share, m.disc->error * share});
    }
  out.bendBias = bias, out.bendBiasOfFabric = bendOnBias(fabric);
  std::array<std::optional<Uncertain>, 2> by;
  if (!m.stretched[0].empty()) by[0] = stretchOf(like->warpCurve(), m.stretched[0], t);
  if (!m.stretched[1].empty()) by[1] = stretchOf(like->weftCurve(), m.stretched[1], t);
  for (const std::size_t g : {0u, 1u})
    if (const auto own = by[g] ? by[g] : by[1 - g]) {
      stretchThreads(fabric, static_cast<Grain>(g), own->value);
      double Fabric::*field = g == 0 ? &Fabric::stretchWarp : &Fabric::stretchWeft;
      if (by[g]) out.numbers.push_back({field, {fabric.*field, fabric.*field * own->error / own->value}});
    }
  if (!m.stretched[2].empty()) {
    const auto shear = shearOf(fabric, m.stretched[2]);
    if (!shear) return shear.error();
    take(&Fabric::shear, *shear);
  }
  if (m.thickness) take(&Fabric::thickness, *m.thickness);
  if (const auto ok = checkFabric(fabric); !ok) return ok.error();
  return out;
}

}  // namespace karinui
