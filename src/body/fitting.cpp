#include "body/fitting.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

struct Knot {
  double at, factor;
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
      const double d0 = (knots_[i].factor - knots_[i - 1].factor) / h0,
                   d1 = (knots_[i + 1].factor - knots_[i].factor) / h1;
      if (d0 * d1 > 0) slope_[i] = 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
    }
  }
  double at(double x) const {
    if (x <= knots_.front().at) return knots_.front().factor;
    if (x >= knots_.back().at) return knots_.back().factor;
    std::size_t i = 0;
    while (x > knots_[i + 1].at) ++i;
    const double h = knots_[i + 1].at - knots_[i].at, t = (x - knots_[i].at) / h;
    const double a = knots_[i].factor, b = knots_[i + 1].factor;
    return a + (b - a) * t * t * (3 - 2 * t) + h * t * (1 - t) * ((1 - t) * slope_[i] - t * slope_[i + 1]);
  }

 private:
  std::vector<Knot> knots_;
  std::vector<double> slope_;
};

void scale(Station& s, double by) {
  for (double& c : s.shape) c *= by;
}

class Refitting {
 public:
  Refitting(Figure& figure, const std::map<std::string, double>& wanted, const Reading& reading, double damping)
      : figure_(figure), at_(figure.at), wanted_(wanted), reading_(reading), damping_(damping) {}

  void all() {
    const auto torso = torsoSections(figure_);  // where the stations stood when the tape was read
    const auto leg = legSections(figure_);
    const auto arm = armSections(figure_);
    girthsOfTorso(torso);
    girthsOfLeg(leg);
    girthsOfArm();
    levels();
    lengths();
  }

 private:
  std::optional<double> got(const char* key) const {
    const auto it = reading_.value.find(key);
    return it == reading_.value.end() ? std::nullopt : std::optional(it->second);
  }
  bool asked(const char* key) const { return wanted_.contains(key) && got(key); }
  double ratio(const char* key, double power) const {
    if (!asked(key)) return 1;
    return std::clamp(std::pow(wanted_.at(key) / *got(key), power * damping_), 0.8, 1.25);
  }
  double lack(const char* key) const { return asked(key) ? std::clamp(wanted_.at(key) - *got(key), -0.08, 0.08) : 0; }

  void girthsOfTorso(const std::vector<Section>& stood) {
    const bool female = figure_.sex == Sex::Female;
    const double bust = ratio("bust_girth", 1), neck = ratio("neck_girth", 1), hip = ratio("hip_girth", 1);
    const double height = at_.crown, waistAt = at_.waist, narrowest = got("waist_height").value_or(at_.waist);
    std::vector<Knot> knots{{at_.crotch - 0.1, hip},
                            {got("hip_height").value_or(at_.crotch + 0.08 * height), hip},
                            {waistAt, ratio("waist_girth", 1)},
                            {female ? std::max(at_.bust, waistAt + 0.06 * height) : at_.armpit.y - 0.01, bust},
                            {at_.shoulder.y, 1 + 0.5 * (bust - 1)},
                            {std::lerp(at_.shoulder.y, at_.neck, 0.55), 1},
                            {at_.neck, std::pow(neck, 0.8)},
                            {0.858 * height, neck},
                            {0.884 * height, neck},
                            {at_.head + 0.02 * height, 1}};
    if (female && asked("under_bust_girth"))
      knots.push_back({got("under_bust_height").value_or(at_.bust - 0.045 * height), ratio("under_bust_girth", 1)});
    const Profile profile(knots);
    // Where the tape finds a narrower place than the waist (ribs as slim as the waist), that place is let out.
    const bool elsewhere = std::abs(narrowest - waistAt) > 0.008 * height;
    for (std::size_t i = 0; i < stood.size(); ++i) {
      const double y = stood[i].centre.y, off = (y - narrowest) / (0.022 * height),
                   in = (y - waistAt) / (0.022 * height);
      scale(figure_.torso.station[i], profile.at(y));
      if (elsewhere) scale(figure_.torso.station[i], 1 + 0.012 * std::exp(-off * off) - 0.006 * std::exp(-in * in));
    }
  }

  void girthsOfLeg(const std::vector<Section>& stood) {
    const double hip = ratio("hip_girth", 1), thigh = asked("thigh_girth") ? ratio("thigh_girth", 1) : hip;
    const double knee = ratio("knee_girth", 1), ankle = ratio("ankle_girth", 1);
    const double kneeAt = got("knee_height").value_or(at_.knee.y),
                 calfAt = got("calf_height").value_or(0.2 * at_.crown);
    const double ankleAt = got("ankle_height").value_or(at_.ankle.y);
    const double calf = asked("calf_girth") ? ratio("calf_girth", 1) : std::sqrt(knee * ankle);
    const Profile profile(
        {{at_.crotch, thigh}, {at_.crotch - 0.03, thigh}, {kneeAt, knee}, {calfAt, calf}, {ankleAt, ankle}});
    for (std::size_t i = 0; i < stood.size(); ++i) scale(figure_.leg.station[i], profile.at(stood[i].centre.y));
  }

  void girthsOfArm() {
    const double upper = ratio("upper_arm_girth", 1), wrist = ratio("wrist_girth", 1);
    const double elbow = asked("elbow_girth") ? ratio("elbow_girth", 1) : std::sqrt(upper * wrist);
    const Limb& arm = figure_.arm;
    // Along the arm: 0 armscye, 1 upper arm, 2 elbow, 3 wrist, 4 fingertips. The armscye answers to the bust, too.
    const Profile profile({{0, 1 + 0.35 * (upper - 1)},
                           {0.6, upper},
                           {1.3, upper},
                           {2, elbow},
                           {2.88, wrist},
                           {3.05, wrist},
                           {3.4, 1 + 0.3 * (wrist - 1)},
                           {4, 1}});
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

  void moveArm(Vec3 by) {
    for (Vec3* joint : {&at_.shoulder, &at_.armpit, &at_.elbow, &at_.wrist, &at_.tip}) *joint += by;
    for (Vec3& joint : at_.thumb) joint += by;
  }

  void levels() {
    const double crotch = lack("crotch_height");
    at_.crotch += crotch;
    at_.hip.y += crotch;
    at_.knee.y += crotch * 0.6;
    if (const double d = lack("waist_height"); std::abs(d) < 0.015)
      at_.waist += 0.5 * d;
    else
      at_.waist = wanted_.at("waist_height");
    at_.bust += 0.8 * lack("bust_height");
    moveArm({0, lack("armpit_height"), 0});
    if (const double d = std::clamp(0.6 * lack("back_waist_length"), -0.015, 0.015); d != 0) {
      // The waist goes down where nobody said how high it is; else the nape goes up as far as a neck allows.
      if (!asked("waist_height")) {
        at_.waist -= d;
      } else {
        const double up = std::clamp(at_.neck + d, 0.835 * at_.crown, 0.862 * at_.crown) - at_.neck;
        at_.neck += up;
        if (!asked("armpit_height")) moveArm({0, 0.6 * up, 0});
      }
    }
    // Whatever was asked for, the levels keep their order.
    const double gap = 0.02 * at_.crown;
    at_.waist = std::max(at_.waist, at_.crotch + 4 * gap);
    at_.bust = std::clamp(at_.bust, at_.waist + 2 * gap, std::max(at_.waist + 2 * gap, at_.shoulder.y - gap));
    at_.neck = std::clamp(at_.neck, at_.shoulder.y + gap, at_.head - gap);
  }

  void lengths() {
    moveArm({damping_ * lack("shoulder_width") / 2, 0, 0});
    const char* length = asked("arm_length") ? "arm_length" : "shoulder_to_wrist_length";
    if (!asked(length)) return;
    const double longer = (*got("arm_length") + lack(length)) / *got("arm_length");
    const Vec3 elbow = at_.shoulder + (at_.elbow - at_.shoulder) * longer;
    const Vec3 wrist = elbow + (at_.wrist - at_.elbow) * longer;
    const Vec3 carried = wrist - at_.wrist;
    at_.elbow = elbow;
    at_.wrist = wrist;
    at_.tip += carried;
    for (Vec3& joint : at_.thumb) joint += carried;
  }

  Figure& figure_;
  Joints& at_;
  const std::map<std::string, double>& wanted_;
  const Reading& reading_;
  double damping_;
};

}  // namespace

std::vector<Miss> misses(const std::map<std::string, double>& wanted, const Reading& reading) {
  std::vector<Miss> out;
  for (const auto& [key, value] : wanted) {
    const auto it = reading.value.find(key);
    Miss miss{key, value, it == reading.value.end() ? 0 : it->second, 0};
    miss.share = std::abs(miss.got - value) / (key.ends_with("_girth") ? 0.003 : 0.005);
    out.push_back(miss);
  }
  return out;
}

void refit(Figure& figure, const std::map<std::string, double>& wanted, const Reading& reading, double damping) {
  Refitting(figure, wanted, reading, damping).all();
}

}  // namespace karinui
