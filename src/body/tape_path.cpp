#include "karinui/body/tape_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "body/anthropometry/contour.h"
#include "karinui/body/lines.h"
#include "karinui/geometry/section.h"

namespace karinui {

namespace {

constexpr double kBeside = 0.05;                           // metres that a height stands off the figure
constexpr double kThighBelow = 0.03;                       // metres below the crotch, as measured
constexpr double kNeckLean = 20 * std::numbers::pi / 180;  // of the neck's tape, as measured
constexpr double kUpperArmTape = 0.5;                      // of the way from shoulder to elbow

class Paths {
 public:
  explicit Paths(const Body& body) : body_(body) {}

  std::vector<TapePath> of(std::string_view key) {
    if (key == "height" || key.ends_with("_height")) return upTo(key);
    if (key == "bust_girth" || key == "under_bust_girth" || key == "waist_girth" || key == "hip_girth")
      return line(key.substr(0, key.size() - 6));
    if (key == "neck_base_girth") return line("neck_base");
    if (key == "knee_girth" || key == "ankle_girth" || key == "elbow_girth" || key == "wrist_girth")
      return line(std::string(key.substr(0, key.size() - 6)) + "_left");
    if (key == "shoulder_length") return line("shoulder_left");
    if (key == "high_hip_girth") return level("high_hip_height", {});
    if (key == "belly_girth") return level("belly_height", {});
    if (key == "calf_girth") return level("calf_height", "ankle_left");
    if (key == "thigh_girth") return thigh();
    if (key == "neck_girth") return neck();
    if (key == "upper_arm_girth") return upperArm();
    if (key == "arm_length" || key == "arm_joint_length")
      return straight({"shoulder_left", "elbow_left", "wrist_left"});
    if (key == "upper_arm_length") return straight({"shoulder_left", "elbow_left"});
    if (key == "forearm_length") return straight({"elbow_left", "wrist_left"});
    if (key == "shoulder_width" || key == "shoulder_joint_width") return straight({"shoulder_right", "shoulder_left"});
    if (key == "bust_span") return straight({"bust_right", "bust_left"});
    if (key == "waist_to_hip_length") return straight({"waist_left", "hip_left"});
    if (key == "back_waist_length") return along("centre_back", "neck_back", "waist_back");
    if (key == "front_waist_length") return along("centre_front", "neck_front", "waist_front");
    if (key == "shoulder_slope") return slope();
    if (key == "arm_angle") return arm();
    return {};
  }

 private:
  using Named = std::initializer_list<std::string_view>;
  std::optional<Vec3> landmark(std::string_view name) const {
    const auto at = body_.landmarks().find(std::string(name));
    return at == body_.landmarks().end() ? std::nullopt : std::optional(at->second);
  }
  std::optional<double> measured(std::string_view key) const {
    const auto at = body_.measured().value.find(std::string(key));
    return at == body_.measured().value.end() ? std::nullopt : std::optional(at->second);
  }
  std::vector<TapePath> line(std::string_view name) const {
    const BodyLine* found = bodyLine(body_, name);
    if (!found) return {};
    return {{found->points, found->closed, false}};
  }
  std::vector<TapePath> upTo(std::string_view key) const {
    const auto high = measured(key);
    return high ? upright(*high) : std::vector<TapePath>();
  }
  // From the floor upwards beside the figure, and across to it.
  std::vector<TapePath> upright(double high) const {
    double wide = 0, deep = 0;
    for (const Vec3 p : body_.mesh().points)
      wide = std::max(wide, std::fabs(p.x)), deep = std::max(deep, std::fabs(p.z));
    const Vec3 foot{wide + kBeside, 0, -(deep + kBeside)}, top{foot.x, high, foot.z};
    return {{{foot, top}, false, true}, {{top, {0, high, 0}}, false, true}};
  }
  std::vector<TapePath> ring(Vec3 through, Vec3 normal) const {
    const auto contour = contourNear(body_.mesh(), through, normal, through);
    if (!contour) return {};
    return {{tightTape(contour->points, normal), true, false}};
  }
  std::vector<TapePath> level(std::string_view height, std::string_view by) const {
    const auto high = measured(height);
    const auto near = by.empty() ? std::optional(Vec3{}) : landmark(by);
    if (!high || !near) return {};
    return ring({near->x, *high, near->z}, {0, 1, 0});
  }
  std::vector<TapePath> thigh() const {
    const auto crotch = measured("crotch_height");
    const auto knee = landmark("knee_left");
    if (!crotch || !knee) return {};
    return ring({knee->x, *crotch - kThighBelow, 0}, {0, 1, 0});
  }
  std::vector<TapePath> neck() const {
    const auto high = measured("neck_height");
    const auto front = landmark("neck_front"), back = landmark("neck_back");
    if (!high || !front || !back) return {};
    return ring({0, *high, (front->z + back->z) / 2}, {0, std::cos(kNeckLean), std::sin(kNeckLean)});
  }
  std::vector<TapePath> upperArm() const {
    const auto shoulder = landmark("shoulder_left"), elbow = landmark("elbow_left");
    if (!shoulder || !elbow) return {};
    return ring(lerp(*shoulder, *elbow, kUpperArmTape), normalized(*elbow - *shoulder));
  }
  std::vector<TapePath> straight(Named names) const {
    TapePath path;
    for (const std::string_view name : names) {
      const auto place = landmark(name);
      if (!place) return {};
      path.points.push_back(*place);
    }
    return {path};
  }
  // The part of a line between the levels of two landmarks.
  std::vector<TapePath> along(std::string_view name, std::string_view from, std::string_view to) const {
    const BodyLine* found = bodyLine(body_, name);
    const auto a = landmark(from), b = landmark(to);
    if (!found || !a || !b) return {};
    TapePath path;
    for (const Vec3 p : found->points)
      if (p.y <= a->y + 1e-3 && p.y >= b->y - 1e-3) path.points.push_back(p);
    if (path.points.size() < 2) return straight({from, to});
    return {path};
  }
  std::vector<TapePath> slope() const {
    const auto neck = landmark("neck_left"), tip = landmark("shoulder_left");
    if (!neck || !tip) return {};
    return {{{*neck, *tip}, false, false}, {{*neck, {tip->x, neck->y, neck->z}}, false, true}};
  }
  std::vector<TapePath> arm() const {
    const auto tip = landmark("shoulder_left"), wrist = landmark("wrist_left");
    if (!tip || !wrist) return {};
    return {{{*tip, *wrist}, false, false}, {{*tip, {wrist->x, tip->y, tip->z}}, false, true}};
  }

  const Body& body_;
};

}  // namespace

std::vector<TapePath> tapePath(const Body& body, std::string_view key) { return Paths(body).of(key); }

Message tapeSaid(std::string_view key) {
  if (key == "height") return say("From the floor to the crown, without shoes.");
  if (key == "bust_girth") return say("Level round the fullest part of the bust, or of the chest.");
  if (key == "under_bust_girth") return say("Level round the ribs, close under the bust.");
  if (key == "waist_girth") return say("Level round the narrowest part between hip and ribs.");
  if (key == "belly_girth") return say("Level round the belly, where it stands out farthest.");
  if (key == "high_hip_girth") return say("Level round the hip bones.");
  if (key == "hip_girth") return say("Level round the fullest part of the seat.");
  if (key == "neck_girth") return say("Round the middle of the neck, leaning forward as it does.");
  if (key == "neck_base_girth") return say("Round the base of the neck, where a collar is sewn on.");
  if (key == "shoulder_width") return say("Straight from shoulder point to shoulder point.");
  if (key == "shoulder_joint_width") return say("Straight between the middles of the shoulder joints.");
  if (key == "shoulder_length") return say("From the side of the neck to the shoulder point.");
  if (key == "shoulder_slope") return say("How far the shoulder falls from level.");
  if (key == "arm_angle") return say("How far the arm is held from level.");
  if (key == "bust_span") return say("Straight from bust point to bust point.");
  if (key == "arm_length") return say("From the shoulder point over the elbow to the wrist.");
  if (key == "arm_joint_length") return say("Along the bones: from the shoulder joint over the elbow to the wrist.");
  if (key == "upper_arm_length") return say("From the shoulder point to the elbow.");
  if (key == "forearm_length") return say("From the elbow to the wrist.");
  if (key == "upper_arm_girth") return say("Round the upper arm, half-way down, across the bone.");
  if (key == "elbow_girth") return say("Round the elbow, across the bone.");
  if (key == "wrist_girth") return say("Round the wrist, above the hand.");
  if (key == "thigh_girth") return say("Level round the thigh, 3 cm below the crotch.");
  if (key == "knee_girth") return say("Level round the knee.");
  if (key == "calf_girth") return say("Level round the fullest part of the calf.");
  if (key == "ankle_girth") return say("Level round the ankle.");
  if (key == "crotch_height") return say("From the floor to the crotch: the inside leg.");
  if (key == "back_waist_length") return say("Down the middle of the back from the neck to the waist.");
  if (key == "front_waist_length") return say("Down the middle of the front from the pit of the neck to the waist.");
  if (key == "waist_to_hip_length") return say("From the waist down to the hip, at the side.");
  if (key.ends_with("_height")) return say("From the floor up to this level.");
  return {};
}

}  // namespace karinui
