#pragma once
// How a figure stands: the angles of its joints. Radians, measured from a person who stands upright with hanging arms,
// palms towards the body; so an angle means the same on every figure. Plain values and pure functions; any thread.
//
// Which way the angles count:
//   flex     forwards: the arm, the thigh, the trunk, the neck; elbow and knee bend; the foot is drawn up. Below 0:
//   back. abduct   sideways, away from the middle: arm and thigh; pelvis, trunk and neck lean to the left. turn about
//   the bone: arm and thigh inwards (the forearm: palm downwards); pelvis, trunk and neck to the left.
// The direction of a ball joint is a swing out of the hanging position by the angle sqrt(flex^2 + abduct^2), towards
// (abduct, flex). An elbow, a knee and an ankle have no abduct; a knee and an ankle no turn.
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/base/result.h"

namespace karinui {

enum class Joint {
  Pelvis,  // the whole figure leans
  Spine,
  Neck,
  LeftShoulder,
  RightShoulder,
  LeftElbow,
  RightElbow,
  LeftWrist,
  RightWrist,
  LeftHip,
  RightHip,
  LeftKnee,
  RightKnee,
  LeftAnkle,
  RightAnkle,
};
inline constexpr std::size_t kJoints = 15;

struct JointAngles {
  double flex = 0, abduct = 0, turn = 0;
  bool operator==(const JointAngles&) const = default;
};

// The joints that are not as in the figure's own pose. Empty: its own pose, as it was made or scanned.
using BodyPose = std::map<Joint, JointAngles>;

std::span<const std::string_view> jointNames();  // by Joint: "left_elbow"
Message jointSaid(Joint joint);                  // "left elbow"
// "left_elbow", or "elbow" for both sides; an unknown name lists all.
Result<std::vector<Joint>> jointsNamed(std::string_view name);

// The least and the greatest angles a person's joint reaches.
struct JointLimits {
  JointAngles least, most;
};
JointLimits limitsOf(Joint joint);
Done withinLimits(const BodyPose& pose);  // says which joint, its angle and the limit

// A pose that has a name. Its numbers never change: documents keep the name.
struct NamedPose {
  std::string_view name;  // "seated"
  Message said;
  BodyPose pose;  // empty: the figure's own
  // Where flesh would press into flesh, these joints are opened by so much at a time, `mostOpened` times at the most.
  BodyPose opening = {};
  int mostOpened = 0;
};
std::span<const NamedPose> namedPoses();
const NamedPose* namedPose(std::string_view name);  // null: there is none

}  // namespace karinui
