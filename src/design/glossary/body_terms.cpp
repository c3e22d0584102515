// What measures, places on the body and sizes are called.
#include <algorithm>

#include "design/glossary/terms.h"
#include "karinui/body/sizes.h"

namespace karinui {

namespace {

Message sizeSaid(SizeSystem system, std::string_view label) {
  switch (system) {
    case SizeSystem::JisWomen:
      return say("JIS {0} (women)", label);
    case SizeSystem::EuWomen:
      return say("EU {0} (women)", label);
    case SizeSystem::EuMen:
      return say("EU {0} (men)", label);
    case SizeSystem::JisMen:
      return say("JIS {0} (men)", label);
    case SizeSystem::Misses:
      return say("US misses' {0}", label);
    case SizeSystem::Children:
      return say("{0} (children)", label);
  }
  return {};
}

}  // namespace

TermTable measureTerms() {
  static const std::vector<NamedTerm> all{
      {"ankle_girth", say("Ankle girth")},
      {"ankle_height", say("Ankle height")},
      {"arm_angle", say("Arm angle")},
      {"arm_joint_length", say("Arm length from joint to joint")},
      {"arm_length", say("Arm length")},
      {"armpit_height", say("Armpit height")},
      {"back_waist_length", say("Back waist length")},
      {"belly_girth", say("Belly girth")},
      {"belly_height", say("Belly height")},
      {"bust_girth", say("Bust girth")},
      {"bust_height", say("Bust height")},
      {"bust_span", say("Bust point distance")},
      {"calf_girth", say("Calf girth")},
      {"calf_height", say("Calf height")},
      {"crotch_height", say("Inside leg")},
      {"elbow_girth", say("Elbow girth")},
      {"forearm_length", say("Forearm length")},
      {"front_waist_length", say("Front waist length")},
      {"height", say("Body height")},
      {"high_hip_girth", say("High hip girth")},
      {"high_hip_height", say("High hip height")},
      {"hip_girth", say("Hip girth")},
      {"hip_height", say("Hip height")},
      {"knee_girth", say("Knee girth")},
      {"knee_height", say("Knee height")},
      {"neck_back_height", say("Back neck point height")},
      {"neck_base_girth", say("Neck base girth")},
      {"neck_front_height", say("Front neck point height")},
      {"neck_girth", say("Neck girth")},
      {"neck_height", say("Neck height")},
      {"shoulder_height", say("Shoulder point height")},
      {"shoulder_joint_width", say("Shoulder joint distance")},
      {"shoulder_length", say("Shoulder length")},
      {"shoulder_slope", say("Shoulder slope")},
      {"shoulder_width", say("Shoulder width")},
      {"thigh_girth", say("Thigh girth")},
      {"under_bust_girth", say("Under-bust girth")},
      {"under_bust_height", say("Under-bust height")},
      {"upper_arm_girth", say("Upper arm girth")},
      {"upper_arm_length", say("Upper arm length")},
      {"waist_girth", say("Waist girth")},
      {"waist_height", say("Waist height")},
      {"waist_to_hip_length", say("Waist to hip")},
      {"wrist_girth", say("Wrist girth")},
  };
  return all;
}

TermTable landmarkTerms() {
  static const std::vector<NamedTerm> all{
      {"ankle_left", say("left ankle point")},
      {"ankle_right", say("right ankle point")},
      {"armpit_left", say("left armpit point")},
      {"armpit_right", say("right armpit point")},
      {"bust_left", say("left bust point")},
      {"bust_right", say("right bust point")},
      {"crotch", say("crotch point")},
      {"elbow_left", say("left elbow point")},
      {"elbow_right", say("right elbow point")},
      {"hip_back", say("centre back of the hip")},
      {"hip_front", say("centre front of the hip")},
      {"hip_left", say("left side of the hip")},
      {"hip_right", say("right side of the hip")},
      {"knee_left", say("left knee point")},
      {"knee_right", say("right knee point")},
      {"neck_back", say("back neck point")},
      {"neck_front", say("front neck point")},
      {"neck_left", say("left side neck point")},
      {"neck_right", say("right side neck point")},
      {"shoulder_left", say("left shoulder point")},
      {"shoulder_right", say("right shoulder point")},
      {"under_bust_back", say("centre back of the under-bust")},
      {"under_bust_front", say("centre front of the under-bust")},
      {"under_bust_left", say("left side of the under-bust")},
      {"under_bust_right", say("right side of the under-bust")},
      {"waist_back", say("centre back of the waist")},
      {"waist_front", say("centre front of the waist")},
      {"waist_left", say("left side of the waist")},
      {"waist_right", say("right side of the waist")},
      {"wrist_left", say("left wrist point")},
      {"wrist_right", say("right wrist point")},
  };
  return all;
}

TermTable partTerms() {
  static const std::vector<NamedTerm> all{
      {"left_arm", say("left arm")},   {"left_leg", say("left leg")}, {"right_arm", say("right arm")},
      {"right_leg", say("right leg")}, {"torso", say("trunk")},
  };
  return all;
}

TermTable levelTerms() {
  static const std::vector<NamedTerm> all{
      {"ankle", say("ankle")},
      {"armpit", say("armpit")},
      {"bust", say("bust")},
      {"chin", say("chin")},
      {"crotch", say("crotch level")},
      {"crown", say("crown of the head")},
      {"elbow", say("elbow")},
      {"fingertip", say("fingertip")},
      {"high_hip", say("high hip")},
      {"hip", say("hip")},
      {"knee", say("knee")},
      {"neck", say("neck")},
      {"neck_base", say("neck base")},
      {"shoulder", say("shoulder")},
      {"sole", say("sole of the foot")},
      {"under_bust", say("under bust")},
      {"waist", say("waist")},
      {"wrist", say("wrist")},
  };
  return all;
}

TermTable sizeTerms() {
  static const std::vector<NamedTerm> all = [] {
    std::vector<NamedTerm> terms;
    for (const SizeSeries& series : sizeSeries())
      for (const BuiltInSize& size : series.sizes) terms.push_back({size.name, sizeSaid(series.system, size.label)});
    std::sort(terms.begin(), terms.end(),
              [](const NamedTerm& a, const NamedTerm& b) { return a.identifier < b.identifier; });
    return terms;
  }();
  return all;
}

}  // namespace karinui
