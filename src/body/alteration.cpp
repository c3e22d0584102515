#include "body/alteration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

struct Knot {
  double at, amount;
};

// A curve through the knots that never swings beyond them (Fritsch and Carlson's monotone cubic), flat outside.
class Profile {
 public:
  explicit Profile(std::vector<Knot> knots) {
    std::stable_sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.at < b.at; });
    for (const Knot& k : knots)
      if (knots_.empty() || k.at - knots_.back().at > 1e-6) knots_.push_back(k);
    const std::size_t n = knots_.size();
    slope_.assign(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h0 = knots_[i].at - knots_[i - 1].at, h1 = knots_[i + 1].at - knots_[i].at;
      const double d0 = (knots_[i].amount - knots_[i - 1].amount) / h0,
                   d1 = (knots_[i + 1].amount - knots_[i].amount) / h1;
      if (d0 * d1 > 0) slope_[i] = 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
    }
  }
  double at(double x) const {
    if (x <= knots_.front().at) return knots_.front().amount;
    if (x >= knots_.back().at) return knots_.back().amount;
    std::size_t i = 0;
    while (x > knots_[i + 1].at) ++i;
    const double h = knots_[i + 1].at - knots_[i].at, t = (x - knots_[i].at) / h;
    const double a = knots_[i].amount, b = knots_[i + 1].amount;
    return a + (b - a) * t * t * (3 - 2 * t) + h * t * (1 - t) * ((1 - t) * slope_[i] - t * slope_[i + 1]);
  }

 private:
  std::vector<Knot> knots_;
  std::vector<double> slope_;
};

void scale(Station& s, double logarithm) {
  for (double& c : s.shape) c *= std::exp(logarithm);
}

class Altering {
 public:
  Altering(const Figure& drawn, const Alteration& by) : figure_(drawn), at_(figure_.at), by_(by) {}

  Figure all() {
    levels();
    lengths();
    girthsOfTorso();
    narrowestAtTheWaist();
    belly();
    girthsOfLeg();
    girthsOfArm();
    return std::move(figure_);
  }

 private:
  double by(const char* key) const {
    const auto it = by_.find(key);
    return it == by_.end() ? 0 : it->second;
  }
  bool own(const char* key) const { return by_.contains(key); }

  void moveArm(Vec3 by) {
    for (Vec3* joint : {&at_.shoulder, &at_.armpit, &at_.elbow, &at_.wrist, &at_.tip}) *joint += by;
    for (Vec3& joint : at_.thumb) joint += by;
  }

  void raiseArm(double angle) {  // about the shoulder, in the plane of the front
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](Vec3 p) {
      const Vec3 d = p - at_.shoulder;
      return at_.shoulder + Vec3{c * d.x - s * d.y, s * d.x + c * d.y, d.z};
    };
    for (Vec3* joint : {&at_.elbow, &at_.wrist, &at_.tip}) *joint = turned(*joint);
    for (Vec3& joint : at_.thumb) joint = turned(joint);
  }

  void levels() {
    const double crotch = by("crotch_height"), armpit = by("armpit_height"), back = by("back_waist_length");
    at_.crotch += crotch;
    at_.hip.y += crotch;
    at_.knee.y += crotch * 0.6;
    at_.waist += by("waist_height");
    at_.bust += by("bust_height");
    moveArm({0, 0.5 * armpit, 0});
    at_.armpit.y += 0.5 * armpit;
    at_.neck += 0.25 * armpit;
    at_.neck += back;  // nape and shoulders rise; a waist that nobody stated gives way by itself
    if (!own("armpit_height")) moveArm({0, 0.6 * back, 0});
    // Whatever is altered, the levels keep their order.
    const double gap = 0.02 * at_.crown;
    at_.head = std::max(at_.head, at_.shoulder.y + 2.5 * gap);
    at_.neck = std::clamp(at_.neck, at_.shoulder.y + gap, at_.head - gap);
    at_.waist = std::clamp(at_.waist, at_.crotch + 4 * gap, std::max(at_.crotch + 4 * gap, at_.shoulder.y - 4 * gap));
    at_.bust = std::clamp(at_.bust, at_.waist + 2 * gap, std::max(at_.waist + 2 * gap, at_.shoulder.y - gap));
  }

  void lengths() {
    moveArm({by("shoulder_width") / 2, 0, 0});
    raiseArm(-by("arm_angle"));
    const double drawn = distance(at_.shoulder, at_.elbow) + distance(at_.elbow, at_.wrist);
    const double longer = std::max(0.5, 1 + by("arm_length") / drawn);
    const Vec3 elbow = at_.shoulder + (at_.elbow - at_.shoulder) * longer;
    const Vec3 wrist = elbow + (at_.wrist - at_.elbow) * longer;
    const Vec3 carried = wrist - at_.wrist;
    at_.elbow = elbow;
    at_.wrist = wrist;
    at_.tip += carried;
    for (Vec3& joint : at_.thumb) joint += carried;
  }

  void girthsOfTorso() {
    const bool female = figure_.sex == Sex::Female;
    const double hip = by("hip_girth"), bust = by("bust_girth"), neck = by("neck_girth"), height = at_.crown;
    const double lower = kAdultChin - figure_.chin;  // a child's neck, as its chin
    std::vector<Knot> knots{{at_.crotch - 0.1, hip},
                            {std::lerp(at_.crotch, at_.waist, 0.25), hip},
                            {at_.waist, by("waist_girth")},
                            {female ? at_.bust : std::max(at_.armpit.y - 0.01, at_.waist + 0.1 * height), bust},
                            {at_.shoulder.y, 0.5 * bust},
                            {std::lerp(at_.shoulder.y, at_.neck, 0.55), 0},
                            {at_.neck, 0.8 * neck},
                            {(0.858 - lower) * height, neck},
                            {(0.884 - lower) * height, neck},
                            {std::max(at_.head, (0.89 - lower) * height) + 0.02 * height, 0}};
    if (own("under_bust_girth"))
      knots.push_back({std::max(at_.bust - 0.075, std::lerp(at_.waist, at_.bust, 0.35)), by("under_bust_girth")});
    const Profile profile(knots);
    const auto stood = torsoSections(figure_);
    for (std::size_t i = 0; i < stood.size(); ++i) scale(figure_.torso.station[i], profile.at(stood[i].centre.y));
  }

  // A belly, of a child to come or of good living: the front grows most at the navel and not at all at ribs and groin,
  // the sides follow, the back stays. r(t) (1 + b v(y) f(t)), f(t) = ((1 + cos t) / 2)^2; v falls off as a cosine
  // squared.
  void belly() {
    if (!own("belly_girth")) return;
    constexpr double kOfGirth = 3;  // of the front, for one of the girth
    const double low = std::lerp(at_.crotch, at_.waist, 0.18), navel = std::lerp(at_.crotch, at_.waist, 0.8),
                 high = at_.bust - 0.03 * at_.crown;
    const auto stood = torsoSections(figure_);
    const int m = figure_.torso.harmonics.count;
    for (std::size_t i = 0; i < stood.size(); ++i) {
      const double y = stood[i].centre.y, off = (y - navel) / (y > navel ? high - navel : navel - low);
      if (std::abs(off) >= 1) continue;
      const double fall = std::cos(off * std::numbers::pi / 2), amount = kOfGirth * by("belly_girth") * fall * fall;
      const double even = 0.375, once = 0.5, twice = 0.125;  // of f: 1, cos t, cos 2t
      const Coefficients before = figure_.torso.station[i].shape;
      Coefficients& shape = figure_.torso.station[i].shape;
      // cos kt cos jt = (cos (k+j)t + cos (k-j)t) / 2; harmonics beyond the last are dropped.
      for (int k = 0; k <= m; ++k)
        for (const auto& [j, share] : {std::pair{0, even}, {1, once}, {2, twice}})
          for (const int to : {k + j, std::abs(k - j)})
            if (to <= m) shape[to] += amount * share * before[k] / 2;
    }
  }

  // Ribs drawn slimmer than the waist would be found by the tape as the waist: they are let out to a shallow bowl
  // around it, a hundredth and a half wider four fingers away. Hips below a belly may be slimmer than it.
  void narrowestAtTheWaist() {
    const auto stood = torsoSections(figure_);
    const Harmonics harmonics = figure_.torso.harmonics;
    const double reach = 0.045 * at_.crown;
    double waist = 0, total = 0;
    std::vector<double> girth(stood.size());
    for (std::size_t i = 0; i < stood.size(); ++i) {
      girth[i] = hullGirth(stood[i].shape, harmonics);
      const double off = (stood[i].centre.y - at_.waist) / (0.3 * reach), weight = std::exp(-off * off);
      waist += weight * girth[i], total += weight;
    }
    if (total < 1e-9) return;
    waist /= total;
    for (std::size_t i = 0; i < stood.size(); ++i) {
      const double y = stood[i].centre.y, off = (y - at_.waist) / reach;
      if (y < at_.crotch || y > at_.bust - 0.06 * at_.crown) continue;  // above, ribs may be slimmer
      if (own("belly_girth") && y < at_.waist) continue;
      const double least = waist * (1 + 0.015 * std::min(off * off, 1.5));
      if (girth[i] < least) scale(figure_.torso.station[i], std::log(least / girth[i]));
    }
  }

  void girthsOfLeg() {
    const double hip = by("hip_girth"), thigh = own("thigh_girth") ? by("thigh_girth") : hip;
    const double knee = by("knee_girth"), ankle = by("ankle_girth");
    const double calf = own("calf_girth") ? by("calf_girth") : (knee + ankle) / 2;
    const double calfAt = std::lerp(at_.ankle.y, at_.knee.y, 0.69), kneeAt = at_.knee.y;
    const Profile profile(
        {{at_.crotch, thigh}, {at_.crotch - 0.03, thigh}, {kneeAt, knee}, {calfAt, calf}, {at_.ankle.y, ankle}});
    const double depth = by(kThighDepth);
    const auto stood = legSections(figure_);
    for (std::size_t i = 0; i < stood.size(); ++i) {
      const double high = std::clamp((stood[i].centre.y - kneeAt) / (at_.crotch - kneeAt), 0.0, 1.0);
      Station& station = figure_.leg.station[i];
      scale(station, profile.at(stood[i].centre.y));
      // r(t) (1 + d cos 2t): longer from front to back, shorter from side to side.
      deepen(station, depth * high);
    }
  }

  void deepen(Station& station, double depth) const {
    if (depth == 0) return;
    const int m = figure_.leg.harmonics.count;
    const Coefficients before = station.shape;
    // cos kt cos 2t = (cos (k+2)t + cos (k-2)t) / 2, sin likewise; harmonics beyond the last are dropped.
    const auto add = [&](int k, double cosine, double sine) {
      const int to = std::abs(k);
      if (to > m) return;
      station.shape[to] += depth / 2 * cosine;
      if (to > 0) station.shape[m + to] += depth / 2 * (k < 0 ? -sine : sine);
    };
    for (int k = 0; k <= m; ++k) {
      const double cosine = before[k], sine = k > 0 ? before[m + k] : 0;
      add(k + 2, cosine, sine);
      add(k - 2, cosine, sine);
    }
  }

  void girthsOfArm() {
    const double upper = by("upper_arm_girth"), wrist = by("wrist_girth");
    const double elbow = own("elbow_girth") ? by("elbow_girth") : (upper + wrist) / 2;
    const Limb& arm = figure_.arm;
    // Along the arm: 0 armscye, 1 upper arm, 2 elbow, 3 wrist, 4 fingertips.
    const Profile profile({{0, 0.35 * upper},
                           {0.6, upper},
                           {1.3, upper},
                           {2, elbow},
                           {2.88, wrist},
                           {3.05, wrist},
                           {3.4, 0.3 * wrist},
                           {4, 0}});
    for (std::size_t i = 0; i < arm.station.size(); ++i) {
      const double f = arm.fraction[i];
      const std::string& r = arm.region[i];
      const double along = r == "shoulder"    ? 0.6 * f
                           : r == "upper arm" ? 0.6 + 1.4 * f
                           : r == "elbow"     ? 2
                           : r == "forearm"   ? 2 + f
                                              : 3 + f;
      scale(figure_.arm.station[i], profile.at(along));
    }
  }

  Figure figure_;
  Joints& at_;
  const Alteration& by_;
};

}  // namespace

std::string parameterOf(std::string_view measurement) {
  if (measurement == "height") return {};  // the finished mesh is scaled to it
  if (measurement == "arm_joint_length") return "arm_length";
  if (measurement == "shoulder_joint_width") return "shoulder_width";
  return std::string(measurement);
}

Figure altered(const Figure& drawn, const Alteration& by) { return Altering(drawn, by).all(); }

}  // namespace karinui
