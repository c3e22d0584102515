#include "karinui/body/measurements.h"

#include <algorithm>
#include <array>
#include <vector>

#include "body/plain_name.h"
#include "karinui/base/near_names.h"
#include "karinui/base/number.h"
#include "karinui/body/measure_range.h"

namespace karinui {

namespace {

struct Name {
  std::string_view key;
  std::string_view aliases;    // separated by blanks; written in any of the systems' ways
  double least = 0, most = 0;  // what a child of five or an adult can have, metres (or radians)
  bool made = false;           // a mannequin can be made to it
};

// ISO 8559-1 names; aliases of FreeSewing, GarmentCode, Valentina and everyday speech.
constexpr std::array kNames{
    Name{"ankle_girth", "ankle leg_ankle_circ", 0.12, 0.40, true},
    Name{"ankle_height", "height_ankle", 0.03, 0.20},
    Name{"arm_angle", "arm_pose_angle", 0, 1.6},
    Name{"arm_joint_length", "", 0.24, 0.75, true},
    Name{"arm_length",
         "shoulder_to_wrist arm_shoulder_tip_to_wrist sleeve_length outer_arm_length "
         "shoulder_to_wrist_length",
         0.27, 0.85, true},
    Name{"armpit_height", "height_armpit", 0.68, 1.75, true},
    Name{"back_waist_length", "back_length hps_to_waist_back neck_back_to_waist_b", 0.20, 0.62, true},
    Name{"belly_girth", "belly abdomen abdomen_girth tummy stomach maternity_waist", 0.45, 1.70, true},
    Name{"belly_height", "", 0.40, 1.40},
    Name{"bust_girth", "bust chest chest_girth bust_circ", 0.48, 1.60, true},
    Name{"bust_height", "height_bustpoint chest_height bust_line_height", 0.64, 1.70, true},
    Name{"bust_span", "bust_points bustpoint_to_bustpoint bust_point_to_bust_point", 0.08, 0.40},
    Name{"calf_girth", "calf leg_calf_circ", 0.17, 0.65, true},
    Name{"calf_height", "height_calf", 0.15, 0.60},
    Name{"crotch_height", "inseam inside_leg inside_leg_length leg_crotch_to_floor", 0.38, 1.10, true},
    Name{"elbow_girth", "elbow arm_elbow_circ", 0.13, 0.50, true},
    Name{"forearm_length", "lower_arm_length", 0.11, 0.40},
    Name{"front_waist_length", "neck_front_to_waist_f", 0.17, 0.62},
    Name{"height", "stature body_height", 1.10, 2.25, true},
    Name{"high_hip_girth", "high_hip highhip_circ upper_hip_girth", 0.45, 1.70},
    Name{"high_hip_height", "height_highhip", 0.45, 1.40},
    Name{"hip_girth", "hip hips seat hip_circ", 0.50, 1.75, true},
    Name{"hip_height", "height_hip seat_height", 0.40, 1.30},
    Name{"knee_girth", "knee leg_knee_circ", 0.20, 0.65, true},
    Name{"knee_height", "height_knee", 0.22, 0.75},
    Name{"neck_back_height", "height_neck_back cervical_height", 0.80, 2.0},
    Name{"neck_base_girth", "neck_base neck_circ_base", 0.24, 0.75},
    Name{"neck_front_height", "height_neck_front", 0.78, 2.0},
    Name{"neck_girth", "neck neck_circ collar", 0.21, 0.60, true},
    Name{"neck_height", "", 0.78, 2.0},
    Name{"shoulder_height", "height_shoulder_tip", 0.78, 1.95},
    Name{"shoulder_joint_width", "", 0.17, 0.55},
    Name{"shoulder_length", "shoulder", 0.05, 0.40},
    Name{"shoulder_slope", "shoulder_incl shoulder_inclination", 0, 0.9},
    Name{"shoulder_width", "shoulder_w shoulder_to_shoulder width_shoulder across_shoulder biacromial_breadth", 0.21,
         0.60, true},
    Name{"thigh_girth", "thigh upper_leg leg_circ leg_thigh_upper_circ", 0.28, 1.00, true},
    Name{"under_bust_girth", "underbust under_bust underbust_girth lowbust_circ rib_cage_girth", 0.43, 1.45, true},
    Name{"under_bust_height", "height_underbust underbust_height", 0.60, 1.65},
    Name{"upper_arm_girth", "upper_arm upperarm biceps bicep arm_upper_circ", 0.14, 0.65, true},
    Name{"upper_arm_length", "shoulder_to_elbow arm_shoulder_tip_to_elbow", 0.14, 0.45},
    Name{"waist_girth", "waist waist_circ natural_waist", 0.42, 1.60, true},
    Name{"waist_height", "waist_to_floor height_waist height_waist_side", 0.58, 1.45, true},
    Name{"waist_to_hip_length", "waist_to_hip waist_to_seat hips_line", 0.05, 0.40},
    Name{"wrist_girth", "wrist arm_wrist_circ", 0.10, 0.30, true},
};

template <class Take>
constexpr auto keysWhere(Take take) {
  std::array<std::string_view, kNames.size()> out{};
  std::size_t n = 0;
  for (const Name& name : kNames)
    if (take(name)) out[n++] = name.key;
  return std::pair{out, n};
}

template <class Visit>
void forNames(Visit visit) {
  for (const Name& name : kNames) {
    visit(name.key, name.key);
    std::string_view rest = name.aliases;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      visit(rest.substr(0, end), name.key);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
}

const Name* find(std::string_view key) {
  const auto it = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.key == key; });
  return it == kNames.end() ? nullptr : &*it;
}

}  // namespace

Result<std::string> measurementKey(std::string_view anyName) {
  const std::string wanted = plainName(anyName.substr(0, 80));
  std::string found;
  std::vector<std::pair<std::size_t, std::string_view>> near;
  forNames([&](std::string_view name, std::string_view key) {
    const std::string known = plainName(name);
    if (known == wanted) found = key;
    near.emplace_back(edits(known, wanted), key);
  });
  if (!found.empty()) return found;
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string list;
  std::vector<std::string_view> said;
  for (const auto& [far, key] : near) {
    if (said.size() == 3 || far > mostEdits(wanted)) break;
    if (std::find(said.begin(), said.end(), key) != said.end()) continue;
    list += (said.empty() ? "" : ", ") + std::string(key);
    said.push_back(key);
  }
  if (list.empty()) return notFound(say("There is no measurement called \"{0}\".", anyName.substr(0, 80)));
  return notFound(say("There is no measurement called \"{0}\". Near names: {1}.", anyName.substr(0, 80), list));
}

std::span<const std::string_view> measurementKeys() {
  static constexpr auto kKeys = keysWhere([](const Name&) { return true; });
  return {kKeys.first.data(), kKeys.second};
}

std::span<const std::string_view> mannequinKeys() {
  static constexpr auto kKeys = keysWhere([](const Name& n) { return n.made; });
  return {kKeys.first.data(), kKeys.second};
}

bool isAngle(std::string_view key) { return key == "shoulder_slope" || key == "arm_angle"; }

Message measureSaid(std::string_view key, double value) {
  return isAngle(key) ? say("{0}°", fixed(value / kDegree, 0)) : say("{0} cm", fixed(value * 100, 1));
}

std::optional<Sex> sexNamed(std::string_view name) {
  for (const Sex sex : kSexes)
    if (sexName(sex) == name) return sex;
  return std::nullopt;
}

Measurements withOwn(Measurements size, const std::map<std::string, double>& own) {
  if (own.contains("belly_girth")) size.value.erase("waist_girth");
  for (const auto& [key, value] : own) size.value[key] = value;
  return size;
}

std::optional<std::pair<double, double>> measureRange(std::string_view key) {
  const Name* name = find(key);
  return name ? std::optional(std::pair(name->least, name->most)) : std::nullopt;
}

Done plausible(const Measurements& stated) {
  for (const auto& [key, value] : stated.value) {
    const Name* name = find(key);
    if (!name)
      return measurementKey(key) ? badInput(say("There is no measurement called \"{0}\".", key))
                                 : measurementKey(key).error();
    if (!(value >= name->least && value <= name->most))
      return refused(say("{0} cannot be {1}: a body has between {2} and {3}.", key, measureSaid(key, value),
                         measureSaid(key, name->least), measureSaid(key, name->most)));
  }
  // Of two that go together the first is always the smaller one, by at least the given share of the second.
  struct Order {
    std::string_view smaller, larger;
    double most;  // smaller / larger at the most
  };
  static constexpr Order kOrders[] = {
      {"crotch_height", "waist_height", 0.90},
      {"waist_height", "bust_height", 0.96},
      {"waist_height", "armpit_height", 0.96},
      {"bust_height", "armpit_height", 0.998},
      {"armpit_height", "height", 0.82},
      {"crotch_height", "height", 0.56},
      {"waist_height", "height", 0.72},
      {"bust_height", "height", 0.80},
      {"under_bust_girth", "bust_girth", 1.02},
      {"neck_girth", "bust_girth", 0.60},
      {"upper_arm_girth", "bust_girth", 0.50},
      {"wrist_girth", "upper_arm_girth", 0.95},
      {"elbow_girth", "upper_arm_girth", 1.15},
      {"wrist_girth", "elbow_girth", 0.95},
      {"thigh_girth", "hip_girth", 0.75},
      {"knee_girth", "thigh_girth", 0.95},
      {"ankle_girth", "calf_girth", 0.90},
      {"arm_joint_length", "height", 0.36},
      {"arm_length", "height", 0.39},
      {"arm_joint_length", "arm_length", 1.0},
      {"shoulder_width", "height", 0.30},
      {"waist_girth", "hip_girth", 1.45},
      {"waist_girth", "bust_girth", 1.35},
      {"belly_girth", "height", 0.95},
      {"belly_girth", "hip_girth", 1.25},
      {"waist_girth", "belly_girth", 1.0},
      {"hip_girth", "height", 0.95},
      {"bust_girth", "height", 0.95},
      {"waist_girth", "height", 0.90},
      {"bust_girth", "hip_girth", 1.50},
  };
  for (const Order& order : kOrders) {
    const auto a = stated.value.find(std::string(order.smaller)), b = stated.value.find(std::string(order.larger));
    if (a == stated.value.end() || b == stated.value.end()) continue;
    if (a->second > order.most * b->second)
      return refused(say("{0} {1} and {2} {3} do not go together: with this {2}, {0} is at most {4}.", a->first,
                         measureSaid(a->first, a->second), b->first, measureSaid(b->first, b->second),
                         measureSaid(a->first, order.most * b->second)));
  }
  return {};
}

}  // namespace karinui
