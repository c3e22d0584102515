#include "body/section_model.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace karinui {

extern const char kBodySections[];
extern const std::size_t kBodySectionsSize;

namespace {

using nlohmann::json;
using Row = std::vector<double>;

Row scaled(const json& values, double scale) {
  Row out = values.get<Row>();
  for (double& v : out) v /= scale;
  return out;
}

std::string keyOf(const std::string& predictor) {
  if (predictor.starts_with("bust")) return "bust_girth";
  if (predictor.starts_with("underbust")) return "under_bust_girth";
  if (predictor.starts_with("waist")) return "waist_girth";
  if (predictor.starts_with("hips")) return "hip_girth";
  return "height";
}

std::string keyOfRule(const std::string& rule) {
  static constexpr std::pair<const char*, const char*> kRules[] = {
      {"neck", "neck_girth"}, {"upperarm", "upper_arm_girth"}, {"wrist", "wrist_girth"}, {"thigh", "thigh_girth"},
      {"knee", "knee_girth"}, {"calf", "calf_girth"},          {"ankle", "ankle_girth"}};
  for (const auto& [name, key] : kRules)
    if (rule == name) return key;
  return rule;
}

// Girths of children by their height: lines through size tables from 1.10 to 1.52 m, girls and boys together.
struct Usual {
  const char* key;
  double of110, more;  // metres at 1.10 m, and for each metre beyond
  double at(double height) const { return of110 + more * (height - 1.10); }
};
constexpr Usual kUsualOfChildren[] = {
    {"bust_girth", 0.575, 0.43}, {"waist_girth", 0.54, 0.28},      {"hip_girth", 0.61, 0.51},
    {"neck_girth", 0.265, 0.11}, {"upper_arm_girth", 0.175, 0.13}, {"wrist_girth", 0.120, 0.064},
};

double distanceOf(const Row& p, const std::vector<Row>& inverse) {
  double sum = 0;
  for (std::size_t i = 0; i < inverse.size(); ++i)
    for (std::size_t j = 0; j < inverse.size(); ++j) sum += p[i] * inverse[i][j] * p[j];
  return std::sqrt(std::max(0.0, sum));
}

}  // namespace

Row SectionModel::Rows::at(const Row& p) const {
  Row out = row[0];
  for (std::size_t i = 0; i < p.size() && i + 1 < row.size(); ++i)
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += row[i + 1][k] * p[i];
  return out;
}

SectionModel SectionModel::of(Sex sex) {
  const json all = json::parse(kBodySections, kBodySections + kBodySectionsSize);
  const json& own = all.at("sexes").at(sex == Sex::Female ? "female" : "male");
  const json& scale = all.at("scale");
  SectionModel m;
  m.sex_ = sex;
  for (const json& name : own.at("predictors")) m.keys_.push_back(keyOf(name.get<std::string>()));
  m.mean_ = own.at("mean").get<Row>();
  m.sd_ = own.at("sd").get<Row>();
  m.inverseCovariance_ = own.at("inverse_covariance").get<std::vector<Row>>();
  m.maxDistance_ = own.at("max_distance");
  for (const json& row : own.at("landmarks")) m.landmarks_.row.push_back(scaled(row, scale.at("landmarks")));
  const auto readLimb = [&](const char* name) {
    LimbModel limb;
    const json& station = all.at("stations").at(name);
    limb.frame.harmonics = {station.at("harmonics"), station.at("symmetric")};
    limb.frame.region = station.at("region").get<std::vector<std::string>>();
    limb.frame.fraction = station.at("fraction").get<Row>();
    const json& data = own.at(name);
    const std::size_t count = limb.frame.fraction.size();
    for (const json& row : data.at("shape")) limb.shape.push_back(scaled(row, scale.at("shape")));
    limb.response.resize(count);
    for (const auto& [index, rows] : data.at("shape_response").items())
      for (const json& row : rows) limb.response[std::stoul(index)].row.push_back(scaled(row, scale.at("shape")));
    for (const json& row : data.at("girth")) limb.girth.row.push_back(scaled(row, scale.at("girth")));
    limb.offset.resize(count);
    for (const json& row : data.at("offset"))
      for (std::size_t i = 0; i < count; ++i) limb.offset[i].row.push_back(scaled(row[i], scale.at("offset")));
    return limb;
  };
  m.torso_ = readLimb("torso");
  m.arm_ = readLimb("arm");
  m.leg_ = readLimb("leg");
  m.foot_ = readLimb("foot");
  const Row thumb = scaled(own.at("thumb_radius"), scale.at("landmarks"));
  m.thumbRadius_ = {thumb[0], thumb[1]};
  for (const auto& [name, rule] : own.at("default_rules").items())
    m.rule_[keyOfRule(name)] = rule.at("coef").get<Row>();
  if (sex == Sex::Female) m.defaultUnderbust_ = own.at("default_underbust").get<Row>();
  return m;
}

Measurements SectionModel::completed(const Measurements& stated) const {
  Measurements out = stated;
  out.sex = sex_;
  auto& value = out.value;
  const std::size_t girths = keys_.size() - 1;
  if (!value.contains("height")) {
    // A height that goes with the stated heights and lengths: each is taken as its usual share of the body.
    static constexpr std::pair<const char*, double> kShares[] = {
        {"crotch_height", 0.475}, {"waist_height", 0.635}, {"armpit_height", 0.756}, {"bust_height", 0.732}};
    double sum = 0, count = 0;
    for (const auto& [key, share] : kShares)
      if (const auto it = value.find(key); it != value.end()) sum += it->second / share, ++count;
    value["height"] = count > 0 ? sum / count : sex_ == Sex::Female ? 1.65 : sex_ == Sex::Male ? 1.77 : 1.28;
  }
  const double height = value["height"];
  if (sex_ == Sex::Child)
    for (const Usual& line : kUsualOfChildren) value.emplace(line.key, line.at(height));
  // A missing girth is the likeliest one given the stated: the least distance from the middle of what was seen. The
  // share of what is stated is solved by setting the gradient of p' A p with respect to the missing entries to zero.
  std::vector<std::size_t> missing;
  Row p(girths, 0.0);
  for (std::size_t i = 0; i < girths; ++i) {
    if (const auto it = value.find(keys_[i]); it != value.end())
      p[i] = it->second / height - mean_[i];
    else
      missing.push_back(i);
  }
  for (int round = 0; round < 200; ++round)  // Gauss-Seidel: A is positive definite and at most 4 x 4
    for (const std::size_t i : missing) {
      double others = 0;
      for (std::size_t j = 0; j < girths; ++j)
        if (j != i) others += inverseCovariance_[i][j] * p[j];
      p[i] = -others / inverseCovariance_[i][i];
    }
  for (const std::size_t i : missing) value[keys_[i]] = (p[i] + mean_[i]) * height;
  // Above a belly the waist is wider than it usually is: a man's by half of what the belly has more; a woman's, who may
  // expect a child, by a fifth. Chosen by what figures look like.
  if (const auto belly = value.find("belly_girth"); belly != value.end() && !stated.value.contains("waist_girth"))
    value["waist_girth"] += (sex_ == Sex::Female ? 0.2 : 0.5) * std::max(0.0, belly->second - value["waist_girth"]);
  if (sex_ == Sex::Female && !stated.value.contains("under_bust_girth"))
    value["under_bust_girth"] = defaultUnderbust_[0] * height + defaultUnderbust_[1] * value["bust_girth"] +
                                defaultUnderbust_[2] * value["waist_girth"] + defaultUnderbust_[3] * value["hip_girth"];
  return out;
}

Row SectionModel::predictors(const Measurements& complete) const {
  const double height = complete.value.at("height");
  Row p;
  for (std::size_t i = 0; i + 1 < keys_.size(); ++i) p.push_back(complete.value.at(keys_[i]) / height - mean_[i]);
  p.push_back(height - mean_.back());
  return p;
}

double SectionModel::distance(const Measurements& complete) const {
  return distanceOf(predictors(complete), inverseCovariance_);
}

std::map<std::string, double> SectionModel::usual(const Measurements& complete) const {
  const Row p = predictors(complete);
  const double height = complete.value.at("height"), bust = complete.value.at("bust_girth");
  std::map<std::string, double> out;
  for (const auto& [key, c] : rule_) {
    double share = c[0];
    for (std::size_t i = 0; i < p.size(); ++i) share += c[i + 1] * p[i];
    out[key] = share * height;
  }
  // Necks, arms and wrists of the described figures are thinner than those of the people in size tables; these lines
  // run through the tables' women (bust 83 to 116 cm) and men (chest 94 to 100 cm).
  if (sex_ == Sex::Child) {
    for (const Usual& line : kUsualOfChildren) out[std::string(line.key)] = line.at(height);
    return out;
  }
  const bool female = sex_ == Sex::Female;
  out["neck_girth"] = 0.19 * bust + 0.10 * height + (female ? 0.012 : 0.032);
  out["upper_arm_girth"] = 0.36 * bust - (female ? 0.036 : 0.042);
  out["wrist_girth"] = 0.053 * bust + 0.065 * height + (female ? 0.003 : 0.006);
  return out;
}

Limb SectionModel::drawLimb(const LimbModel& model, const Row& clipped, const Row& girths, double height) const {
  Limb limb = model.frame;
  const Row girth = model.girth.at(girths);
  for (std::size_t i = 0; i < limb.fraction.size(); ++i) {
    Row c = model.shape[i];
    for (std::size_t r = 0; r < model.response[i].row.size(); ++r)
      for (std::size_t k = 0; k < c.size(); ++k) c[k] += model.response[i].row[r][k] * clipped[r];
    Station s;
    std::copy(c.begin(), c.end(), s.shape.begin());
    const double to = girth[i] * height / hullGirth(s.shape, limb.harmonics);
    for (double& v : s.shape) v *= to;
    const Row offset = model.offset[i].at(clipped);
    s.forward = offset[0] * height;
    s.sideways = offset[1] * height;
    limb.station.push_back(s);
  }
  return limb;
}

namespace {

// A dressmaker's figure has a plain head: without eyes, mouth and ears, which sections of one radius per direction only
// hint at as hollows. Above the chin the fine harmonics go, and what is left is evened from station to station.
void calmHead(Figure& figure) {
  auto& station = figure.torso.station;
  const auto stood = torsoSections(figure);
  const double chin = 0.885 * figure.at.crown, brow = 0.915 * figure.at.crown;
  std::vector<double> share;
  for (const Section& s : stood) share.push_back(std::clamp((s.centre.y - chin) / (brow - chin), 0.0, 1.0));
  for (std::size_t i = 0; i < station.size(); ++i)
    for (int k = 3; k <= figure.torso.harmonics.count; ++k) station[i].shape[k] *= 1 - share[i];
  constexpr int kFieldRounds = 12;
  for (int round = 0; round < kFieldRounds; ++round) {
    const auto before = station;
    for (std::size_t i = 1; i + 4 < station.size(); ++i) {  // the crowded last stations round the crown off
      if (share[i] == 0) continue;
      const double below = stood[i].centre.y - stood[i - 1].centre.y, above = stood[i + 1].centre.y - stood[i].centre.y;
      const double t = below / (below + above), w = 0.5 * share[i];
      for (int k = 1; k < kMostCoefficients; ++k) {  // the shape apart from its size: the skull keeps its girths
        const auto at = [&](std::size_t j) { return before[j].shape[k] / before[j].shape[0]; };
        station[i].shape[k] += w * (std::lerp(at(i - 1), at(i + 1), t) - at(i)) * before[i].shape[0];
      }
      station[i].forward += w * (std::lerp(before[i - 1].forward, before[i + 1].forward, t) - before[i].forward);
    }
  }
}

// The thumb lies along the hand, half-way from where it was described: a spread one is caught by every sleeve.
void calmThumb(Joints& at) {
  const Vec3 hand = normalized(at.tip - at.wrist);
  const std::array<Vec3, 4> spread = at.thumb;
  for (std::size_t i = 1; i < spread.size(); ++i) {
    const Vec3 bone = spread[i] - spread[i - 1];
    at.thumb[i] = at.thumb[i - 1] + normalized(normalized(bone) * 0.45 + hand * 0.55) * length(bone);
  }
}

// A child's legs are shorter for its height, its shoulders narrower and its head is larger. Heights between floor,
// crotch, chin and crown are stretched evenly; shares of the height at 1.10 m, and at 1.52 m from where on they are an
// adult's. Arms and shoulders are those of JIS L 4002 (at 1.10 m 35 and 27 cm).
void takeChildsProportions(Figure& figure) {
  Joints& at = figure.at;
  const double height = at.crown, grown = std::clamp((height - 1.10) / (1.52 - 1.10), 0.0, 1.0);
  const double crotchWas = at.crotch, crotch = std::lerp(0.443, std::max(0.443, crotchWas / height), grown) * height;
  const double chinWas = figure.chin * height, chin = std::lerp(0.828, 0.864, grown) * height;
  const auto level = [&](double y) {
    if (y <= crotchWas) return y * crotch / crotchWas;
    if (y <= chinWas) return std::lerp(crotch, chin, (y - crotchWas) / (chinWas - crotchWas));
    return std::lerp(chin, height, (y - chinWas) / (height - chinWas));
  };
  constexpr double kArm = 1.07, kShoulders = 0.91;
  const Vec3 shoulder = at.shoulder, now{shoulder.x * kShoulders, level(shoulder.y), shoulder.z};
  for (Vec3* joint : {&at.elbow, &at.wrist, &at.tip}) *joint = now + (*joint - shoulder) * kArm;
  for (Vec3& joint : at.thumb) joint = now + (joint - shoulder) * kArm;
  for (Vec3* joint : {&at.shoulder, &at.armpit, &at.hip, &at.knee, &at.ankle}) joint->y = level(joint->y);
  at.shoulder.x = now.x, at.armpit.x *= kShoulders;
  for (double* y : {&at.waist, &at.bust, &at.neck, &at.head}) *y = level(*y);
  at.crotch = crotch, figure.chin = chin / height;
  const double larger = (height - chin) / (height - chinWas);
  for (std::size_t i = 0; i < figure.torso.station.size(); ++i) {
    if (figure.torso.region[i] != "head") continue;
    const double by = std::lerp(1, larger, std::min(1.0, figure.torso.fraction[i] / 0.15));
    for (double& c : figure.torso.station[i].shape) c *= by;
    figure.torso.station[i].forward *= by;
  }
}

}  // namespace

Figure SectionModel::draw(const Measurements& complete) const {
  const double height = complete.value.at("height");
  Row girths = predictors(complete), clipped = girths;
  const std::size_t n = keys_.size() - 1;
  clipped[n] = std::clamp(clipped[n], -2.2 * sd_[n], 2.2 * sd_[n]);
  girths[n] = clipped[n];
  const double far = distanceOf(clipped, inverseCovariance_);
  if (far > maxDistance_)
    for (std::size_t i = 0; i < n; ++i) clipped[i] *= maxDistance_ / far;

  Figure figure;
  figure.sex = sex_;
  const Row v = landmarks_.at(clipped);
  std::size_t next = 0;
  const auto number = [&] { return v[next++] * height; };
  const auto point = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3{x, y, z};
  };
  Joints& at = figure.at;
  for (double* level : {&at.crotch, &at.waist, &at.bust, &at.neck, &at.head, &at.heel, &at.toe}) *level = number();
  for (Vec3* joint : {&at.armpit, &at.shoulder, &at.elbow, &at.wrist, &at.hip, &at.knee, &at.ankle, &at.tip})
    *joint = point();
  for (Vec3& joint : at.thumb) joint = point();
  at.toeOut = v[next];
  at.crown = height;
  figure.torso = drawLimb(torso_, clipped, girths, height);
  figure.arm = drawLimb(arm_, clipped, girths, height);
  figure.leg = drawLimb(leg_, clipped, girths, height);
  figure.foot = drawLimb(foot_, clipped, girths, height);
  calmHead(figure);
  calmThumb(at);
  figure.thumbRadius = {thumbRadius_[0] * height, thumbRadius_[1] * height};
  if (sex_ == Sex::Child) takeChildsProportions(figure);
  return figure;
}

}  // namespace karinui
