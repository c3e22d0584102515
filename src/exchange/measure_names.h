#pragma once
// What each measure is called elsewhere.
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace karinui {

struct MeasureNames {
  std::string_view key, valentina, freeSewing, garmentCode;  // empty: it has none
};

// Names that mean something else than their look: Valentina's neck_circ lies at the neck's base, FreeSewing's hips at
// the hip bones. Their own documentation, 2026.
inline constexpr std::array kMeasureNames{
    MeasureNames{"height", "height", "", "height"},
    MeasureNames{"bust_girth", "bust_circ", "chest", "bust"},
    MeasureNames{"under_bust_girth", "lowbust_circ", "underbust", "underbust"},
    MeasureNames{"waist_girth", "waist_circ", "waist", "waist"},
    MeasureNames{"high_hip_girth", "highhip_circ", "hips", ""},
    MeasureNames{"hip_girth", "hip_circ", "seat", "hips"},
    MeasureNames{"neck_girth", "neck_mid_circ", "neck", ""},
    MeasureNames{"neck_base_girth", "neck_circ", "", ""},
    MeasureNames{"shoulder_width", "width_shoulder", "shoulderToShoulder", "shoulder_w"},
    MeasureNames{"shoulder_length", "shoulder_length", "", ""},
    MeasureNames{"shoulder_slope", "shoulder_slope_neck_side_angle", "shoulderSlope", "shoulder_incl"},
    MeasureNames{"bust_span", "bustpoint_to_bustpoint", "bustSpan", "bust_points"},
    MeasureNames{"arm_length", "arm_shoulder_tip_to_wrist", "shoulderToWrist", "arm_length"},
    MeasureNames{"upper_arm_length", "arm_shoulder_tip_to_elbow", "shoulderToElbow", ""},
    MeasureNames{"upper_arm_girth", "arm_upper_circ", "biceps", ""},
    MeasureNames{"elbow_girth", "arm_elbow_circ", "", ""},
    MeasureNames{"wrist_girth", "arm_wrist_circ", "wrist", "wrist"},
    MeasureNames{"arm_angle", "", "", "arm_pose_angle"},
    MeasureNames{"thigh_girth", "leg_thigh_upper_circ", "upperLeg", "leg_circ"},
    MeasureNames{"knee_girth", "leg_knee_circ", "knee", ""},
    MeasureNames{"calf_girth", "leg_calf_circ", "", ""},
    MeasureNames{"ankle_girth", "leg_ankle_circ", "ankle", ""},
    MeasureNames{"crotch_height", "leg_crotch_to_floor", "inseam", ""},
    MeasureNames{"waist_height", "height_waist_side", "waistToFloor", ""},
    MeasureNames{"waist_to_hip_length", "", "waistToSeat", "hips_line"},
    MeasureNames{"bust_height", "height_bustpoint", "", ""},
    MeasureNames{"armpit_height", "height_armpit", "", ""},
    MeasureNames{"shoulder_height", "height_shoulder_tip", "", ""},
    MeasureNames{"neck_back_height", "height_neck_back", "", ""},
    MeasureNames{"neck_front_height", "height_neck_front", "", ""},
    MeasureNames{"high_hip_height", "height_highhip", "", ""},
    MeasureNames{"hip_height", "height_hip", "", ""},
    MeasureNames{"knee_height", "height_knee", "", ""},
    MeasureNames{"calf_height", "height_calf", "", ""},
    MeasureNames{"ankle_height", "height_ankle", "", ""},
    MeasureNames{"back_waist_length", "neck_back_to_waist_b", "", ""},
    MeasureNames{"front_waist_length", "neck_front_to_waist_f", "", ""},
};

using MeasureSystem = std::string_view MeasureNames::*;
// The key of a name in one system; empty: it has none.
inline std::string_view measureKeyIn(MeasureSystem system, std::string_view name) {
  for (const MeasureNames& row : kMeasureNames)
    if (!name.empty() && row.*system == name) return row.key;
  return {};
}
inline std::string_view measureNameIn(MeasureSystem system, std::string_view key) {
  for (const MeasureNames& row : kMeasureNames)
    if (row.key == key) return row.*system;
  return {};
}

// A measure with a blank before its unit, "88 cm", as a person writes it: without.
inline std::string withUnitClose(std::string_view measure) {
  const std::size_t unit = measure.find_last_of(' '), number = measure.find_last_not_of(' ', unit);
  if (unit == std::string_view::npos || number == std::string_view::npos || unit + 1 == measure.size() ||
      std::isdigit(static_cast<unsigned char>(measure[number])) == 0 ||
      std::isalpha(static_cast<unsigned char>(measure[unit + 1])) == 0)
    return std::string(measure);
  return std::string(measure.substr(0, number + 1)) + std::string(measure.substr(unit + 1));
}

}  // namespace karinui
