// Crotch, armpit, and the girths of the trunk from hip to bust.
#include <numbers>

#include "body/anthropometry/extremum.h"
#include "body/anthropometry/survey.h"

namespace karinui {

namespace {

// --- Crotch: the lowest level at which one contour reaches across the plane of symmetry
constexpr double kSurelyTrunk = 0.58, kLowestCrotch = 0.25, kCrotchStep = 0.01;
constexpr double kWidth = 0.05;  // narrower contours in the middle are no trunk
constexpr int kCrotchHalvings = 12;

// --- Armpit: the highest level at which trunk and arms are three contours
constexpr double kArmpitFrom = 0.70, kArmpitLowest = 0.60, kArmpitHighest = 0.86;
constexpr double kArmpitDown = 0.01, kArmpitUp = 0.005;
constexpr double kPartLine = 0.07;  // shorter contours are fingers, or slivers
constexpr int kArmpitHalvings = 10;
constexpr double kGapBelow = 0.006;    // the gap between arm and trunk is taken this far below the armpit
constexpr double kTrunkCentre = 0.03;  // the trunk's centre lies no farther from the plane of symmetry

// --- Hip: the tape takes both thighs together, without the hands beside them
constexpr double kHipReach = 0.12;                // of a contour's centre from the plane of symmetry
constexpr double kHipLine = 0.08;                 // shorter contours are hands
constexpr double kHipFrom = 0.01, kHipTo = 0.20;  // metres above the crotch
constexpr int kHipSamples = 20;
constexpr double kValley = 0.01;  // metres of girth: what lies above a narrower place below a belly is the belly

// --- Bust
constexpr double kUnderArmpit = 0.003;      // metres: no tape nearer to the armpit
constexpr double kBustPointsBelow = 0.055;  // below the armpit
constexpr double kBustPointOut = 0.028;     // a bust point lies farther out than the breastbone
constexpr double kBustReach = 0.012;        // of the tape's level from that of the bust points
constexpr double kNoWaist = 0.95;           // of the chest: a waist as wide has none
constexpr double kBosomOut = 0.002;         // less is no bust above a belly
constexpr int kBustPointSamples = 14, kBustSamples = 13;
constexpr double kChestFrom = 0.72;  // of the way from the crotch to the armpit
constexpr int kChestSamples = 22;
constexpr double kUnderBust = 0.075;                      // metres below the bust
constexpr double kFlat = 0.040, kFullBeyondFlat = 0.030;  // bust less under-bust girth: a flat chest; a full bust
constexpr double kBustPointSide = 0.02;                   // metres from the plane of symmetry

// --- Belly: the level at which the middle of the front is foremost
constexpr double kBellyFrom = 0.18, kBellyTo = 0.66;  // of the way from the crotch to the armpit
constexpr int kBellySamples = 24;
constexpr double kStandsOut = 0.02, kAllBelly = 0.035;  // beyond the straight line between these levels: a belly …
constexpr double kHipUnderBelly = 0.09;  // … that the tape round the hip leaves out: metres above the crotch

// --- Waist
constexpr double kWaistAboveCrotch = 0.10, kWaistAboveHip = 0.05, kWaistRoom = 0.16;  // metres
constexpr double kRibs = 0.065;  // below the bust: no waist is sought above, ribs may be slimmer
constexpr int kWaistSamples = 28;
constexpr double kBellyOver = 0.03;  // metres of girth that a belly above such a narrow place is wider
constexpr double kNoWaistUnder = 2;  // a belly that stands out by half or more has its waist on its own level

bool legsMeet(const Survey& body, double y) {
  for (const SectionLoop& contour : body.slices.section(y)) {
    const Interval e = widthOf(contour);
    if (e.low < body.middle && e.high > body.middle && e.high - e.low > kWidth * body.stature) return true;
  }
  return false;
}

int countParts(const Survey& body, double y) {
  int count = 0;
  for (const SectionLoop& contour : body.slices.section(y))
    count += lineLength(contour.points, true) > kPartLine * body.stature;
  return count;
}

std::optional<SectionLoop> trunkContour(const Survey& body, double y) {
  std::optional<SectionLoop> best;
  double most = 0;
  for (SectionLoop& contour : body.slices.section(y)) {
    const Interval e = widthOf(contour);
    const double line = lineLength(contour.points, true);
    if (e.low < body.middle && e.high > body.middle && line > most) most = line, best = std::move(contour);
  }
  return best;
}

double trunkGirth(const Survey& body, double y) {
  const auto contour = trunkContour(body, y);
  return contour ? tightTapeLength(contour->points, {0, 1, 0}) : 0;
}

double hipGirth(const Survey& body, double y) {
  std::vector<Vec3> points;
  for (const SectionLoop& contour : body.slices.section(y))
    if (std::abs(contourCentre(contour).x - body.middle) < kHipReach * body.stature &&
        lineLength(contour.points, true) > kHipLine * body.stature)
      points.insert(points.end(), contour.points.begin(), contour.points.end());
  return points.size() < 3 ? 0 : tightTapeLength(points, {0, 1, 0});
}

// The widest level round the seat. Where a belly is as wide, the trunk is narrower between the two.
GirthLevel hipLevel(const Survey& body, double low, double high) {
  const auto girth = [&](double y) { return hipGirth(body, y); };
  const GirthLevel widest = extremum(Extremum::Largest, low, high, kHipSamples, girth);
  if (widest.y < body.crotch + kHipUnderBelly) return widest;
  const GirthLevel narrow = extremum(Extremum::Smallest, low, widest.y, kHipSamples, girth);
  if (!(narrow.y > low)) return widest;
  const GirthLevel seat = extremum(Extremum::Largest, low, narrow.y, kHipSamples, girth);
  return seat.girth - narrow.girth > kValley && widest.girth - narrow.girth > kValley ? seat : widest;
}

double foremostBust(const Survey& body, double y) {
  double most = -1;
  if (const auto contour = trunkContour(body, y))
    for (const Vec3& p : contour->points)
      if (std::abs(p.x - body.middle) > kBustPointOut * body.stature) most = std::max(most, p.z);
  return most;
}

// Where a ray from the middle of the trunk leaves it; t runs from the front to the left.
Vec3 onTrunk(const Survey& body, double y, double t) {
  const auto contour = trunkContour(body, y);
  if (!contour) return {body.middle, y, 0};
  const Vec3 c = contourCentre(*contour), d{std::sin(t), 0, std::cos(t)}, n{d.z, 0, -d.x};
  const Vec3 origin{body.middle, c.y, c.z};
  Vec3 best = c;
  double far = 0;
  for (std::size_t i = 0; i < contour->points.size(); ++i) {
    const Vec3 a = contour->points[i] - origin, b = contour->points[(i + 1) % contour->points.size()] - origin;
    const double sa = dot(a, n), sb = dot(b, n);
    if ((sa > 0) == (sb > 0)) continue;
    const Vec3 p = lerp(a, b, sa / (sa - sb));
    if (dot(p, d) > far) far = dot(p, d), best = p + origin;
  }
  return best;
}

// A woman's bust is taken around the bust points, so that a full arm does not draw the tape up into the armpit; a man's
// chest where it is widest, which may be right under the armpit. How much a bust stands out says which it is. Without a
// waist, what is widest far below the armpits is the belly, and a bust is what stands out from the slope above it.
GirthLevel measureBust(Survey& body) {
  const auto girth = [&](double y) { return trunkGirth(body, y); };
  const auto front = [&](double y) { return foremostBust(body, y); };
  const double highest = body.armpit - kUnderArmpit, reach = kBustReach * body.stature;
  const double lowest = body.armpit - kBustPointsBelow * body.stature;
  const auto foremost = [&](const auto& out) {
    return extremum(Extremum::Largest, lowest, highest, kBustPointSamples, [&](double y) { return 1 + out(y); });
  };
  const auto taped = [&](const GirthLevel& points) {
    return plateauExtremum(Extremum::Largest, points.y - reach, std::min(highest, points.y + reach), kBustSamples,
                           girth);
  };
  const GirthLevel points = foremost(front), bust = taped(points);
  body.bosom =
      std::clamp(((bust.girth - girth(bust.y - kUnderBust)) / body.stature - kFlat) / kFullBeyondFlat, 0.0, 1.0);
  if (body.bosom >= 0.5) return bust;
  const double from = body.crotch + kChestFrom * (body.armpit - body.crotch);
  const GirthLevel chest = extremum(Extremum::Largest, from, highest, kChestSamples, girth);
  if (chest.y >= lowest) return chest;
  const GirthLevel waist =
      extremum(Extremum::Smallest, body.crotch + kWaistAboveCrotch, std::max(from, lowest), kWaistSamples, girth);
  if (waist.girth < kNoWaist * chest.girth) return chest;
  if (points.y > lowest) return bust;
  const double low = front(lowest), high = front(highest);
  const GirthLevel bosom =
      foremost([&](double y) { return front(y) - std::lerp(low, high, (y - lowest) / (highest - lowest)); });
  return bosom.girth > 1 + kBosomOut * body.stature ? taped(bosom) : bust;
}

struct Belly {
  double y = 0;
  double standsOut = 0;  // 0: the hip's tape takes all of it; 1: none
};
Belly findBelly(const Survey& body) {
  const auto front = [&](double y) { return profileAt(body, y).front.z; };
  const double low = std::lerp(body.crotch, body.armpit, kBellyFrom),
               high = std::lerp(body.crotch, body.armpit, kBellyTo);
  Belly belly{extremum(Extremum::Largest, low, high, kBellySamples, [&](double y) { return 1 + front(y); }).y};
  const double straight = std::lerp(front(low), front(high), (belly.y - low) / (high - low));
  const double out = (front(belly.y) - straight) / body.stature;
  belly.standsOut = std::clamp((out - kStandsOut) / (kAllBelly - kStandsOut), 0.0, 1.0);
  return belly;
}

void markBustPoints(Survey& body, double y) {
  const auto contour = trunkContour(body, y);
  if (!contour) return;
  for (const int side : {0, 1}) {
    Vec3 best{0, 0, -1e9};  // the foremost on each side
    for (const Vec3& p : contour->points)
      if ((side ? body.middle - p.x : p.x - body.middle) > kBustPointSide && p.z > best.z) best = p;
    body.found.landmark[sided("bust", side)] = best;
  }
  body.set("bust_span", distance(body.found.landmark["bust_left"], body.found.landmark["bust_right"]));
}

}  // namespace

bool findCrotch(Survey& body) {
  double high = body.floor + kSurelyTrunk * body.stature, low = high;
  if (!legsMeet(body, high)) return false;
  while (legsMeet(body, low)) {
    high = low;
    low -= kCrotchStep * body.stature;
    if (low < body.floor + kLowestCrotch * body.stature) return false;
  }
  for (int i = 0; i < kCrotchHalvings; ++i) {
    const double y = (low + high) / 2;
    (legsMeet(body, y) ? high : low) = y;
  }
  body.crotch = high;
  body.set("crotch_height", body.aboveFloor(high));
  return true;
}

bool findArmpit(Survey& body) {
  double low = body.floor + kArmpitFrom * body.stature;
  while (countParts(body, low) < 3 && low > body.floor + kArmpitLowest * body.stature)
    low -= kArmpitDown * body.stature;
  if (countParts(body, low) < 3) return false;
  double high = low;
  while (countParts(body, high) >= 3) {
    low = high;
    high += kArmpitUp * body.stature;
    if (high > body.floor + kArmpitHighest * body.stature) return false;
  }
  for (int i = 0; i < kArmpitHalvings; ++i) {
    const double y = (low + high) / 2;
    (countParts(body, y) >= 3 ? low : high) = y;
  }
  body.armpit = low;
  body.set("armpit_height", body.aboveFloor(low));
  return true;
}

void measureTrunk(Survey& body) {
  const auto girth = [&](double y) { return trunkGirth(body, y); };
  const GirthLevel bust = measureBust(body);
  const double underBust = bust.y - kUnderBust;
  const Belly belly = findBelly(body);
  body.found.belly = belly.standsOut > 0;
  const GirthLevel hip =
      hipLevel(body, body.crotch + kHipFrom, body.crotch + std::lerp(kHipTo, kHipUnderBelly, belly.standsOut));
  const double ribs = std::max(bust.y - kRibs * body.stature, body.crotch + kWaistRoom);
  GirthLevel waist =
      plateauExtremum(Extremum::Smallest, std::max(body.crotch + kWaistAboveCrotch, hip.y + kWaistAboveHip), ribs,
                      kWaistSamples, girth);
  // Below a belly the trunk is narrow, too; where it is narrow above as well, the waist is there.
  const GirthLevel widest = extremum(Extremum::Largest, waist.y, ribs, kWaistSamples, girth);
  if (widest.y > waist.y && widest.y < ribs && widest.girth - waist.girth > kBellyOver) {
    const GirthLevel above = plateauExtremum(Extremum::Smallest, widest.y, ribs, kWaistSamples, girth);
    if (widest.girth - above.girth > kValley) waist = above;
  }
  // Under a man's belly that stands out, where no narrower place lies above it, the trunk is narrow too, but that is
  // the hip.
  const double noWaist = std::fmin(1, kNoWaistUnder * belly.standsOut) * std::clamp(1 - 2 * body.bosom, 0.0, 1.0);
  if (noWaist > 0 && waist.y < belly.y) {
    waist.y = std::lerp(waist.y, belly.y, noWaist);
    waist.girth = girth(waist.y);
  }
  const double highHip = (body.crotch + waist.y) / 2;
  body.waist = waist.y;
  const struct {
    const char *girthKey, *heightKey;
    GirthLevel at;
  } levels[] = {{"hip_girth", "hip_height", hip},
                {"high_hip_girth", "high_hip_height", {hipGirth(body, highHip), highHip}},
                {"belly_girth", "belly_height", {girth(belly.y), belly.y}},
                {"waist_girth", "waist_height", waist},
                {"under_bust_girth", "under_bust_height", {girth(underBust), underBust}},
                {"bust_girth", "bust_height", bust}};
  for (const auto& level : levels) {
    body.set(level.girthKey, level.at.girth);
    body.set(level.heightKey, body.aboveFloor(level.at.y));
  }
  body.set("waist_to_hip_length", waist.y - hip.y);

  body.found.landmark["crotch"] = onTrunk(body, body.crotch + 0.002, 0);
  static constexpr const char* kQuarters[] = {"_front", "_left", "_back", "_right"};
  for (const auto& [name, y] : {std::pair{"waist", waist.y}, {"hip", hip.y}, {"under_bust", underBust}})
    for (int i = 0; i < 4; ++i)
      body.found.landmark[std::string(name) + kQuarters[i]] = onTrunk(body, y, i * std::numbers::pi / 2);
  markBustPoints(body, bust.y);
}

double armpitGap(const Survey& body, int side) {
  const double sign = outward(side);
  Interval gap{0, 1e9};
  for (const SectionLoop& contour : body.slices.section(body.armpit - kGapBelow * body.stature)) {
    if (lineLength(contour.points, true) < kPartLine * body.stature) continue;
    const double centre = contourCentre(contour).x - body.middle;
    for (const Vec3& p : contour.points) {
      const double x = sign * (p.x - body.middle);
      if (std::abs(centre) < kTrunkCentre * body.stature)
        gap.low = std::max(gap.low, x);
      else if (sign * centre > 0)
        gap.high = std::min(gap.high, x);
    }
  }
  return (gap.low + gap.high) / 2;
}

}  // namespace karinui
