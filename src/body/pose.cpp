#include "karinui/body/pose.h"

#include <cmath>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::array<std::string_view, kJoints> kJointNames{
    "pelvis",     "spine",       "neck",       "left_shoulder", "right_shoulder",
    "left_elbow", "right_elbow", "left_wrist", "right_wrist",   "left_hip",
    "right_hip",  "left_knee",   "right_knee", "left_ankle",    "right_ankle"};

JointAngles degrees(double flex, double abduct, double turn) {
  return {flex * kDegree, abduct * kDegree, turn * kDegree};
}

// Both sides alike.
void both(BodyPose& pose, Joint left, JointAngles angles) {
  pose[left] = angles;
  pose[static_cast<Joint>(static_cast<int>(left) + 1)] = angles;
}

std::vector<NamedPose> makeNamed() {
  std::vector<NamedPose> all;
  all.push_back({"A", say("Own pose"), {}});

  NamedPose t{"T", say("Arms level"), {}};
  both(t.pose, Joint::LeftShoulder, degrees(0, 90, 0));
  both(t.pose, Joint::LeftElbow, degrees(4, 0, 0));
  all.push_back(t);

  NamedPose down{"arms_down", say("Arms down"), {}};
  both(down.pose, Joint::LeftShoulder, degrees(0, 8, 0));
  both(down.pose, Joint::LeftElbow, degrees(8, 0, 0));
  both(down.opening, Joint::LeftShoulder, degrees(0, 2, 0));
  down.mostOpened = 14;
  all.push_back(down);

  NamedPose forward{"forward", say("Arms forward"), {}};
  both(forward.pose, Joint::LeftShoulder, degrees(90, 4, 0));
  both(forward.pose, Joint::LeftElbow, degrees(4, 0, 0));
  both(forward.opening, Joint::LeftShoulder, degrees(-3, 4, 0));
  forward.mostOpened = 10;
  all.push_back(forward);

  NamedPose over{"overhead", say("Arms overhead"), {}};
  both(over.pose, Joint::LeftShoulder, degrees(60, 140, 0));
  both(over.pose, Joint::LeftElbow, degrees(6, 0, 0));
  both(over.opening, Joint::LeftShoulder, degrees(-2, -5, 0));
  over.mostOpened = 8;
  all.push_back(over);

  NamedPose hands{"hands_on_hips", say("Hands on hips"), {}};
  both(hands.pose, Joint::LeftShoulder, degrees(-8, 54, 70));
  both(hands.pose, Joint::LeftElbow, degrees(92, 0, 0));
  both(hands.opening, Joint::LeftShoulder, degrees(0, 2, 0));
  both(hands.opening, Joint::LeftElbow, degrees(-2, 0, 0));
  hands.mostOpened = 14;
  all.push_back(hands);

  NamedPose step{"step", say("A step"), {}};
  step.pose[Joint::LeftHip] = degrees(26, 3, 0), step.pose[Joint::RightHip] = degrees(-14, 3, 0);
  step.pose[Joint::LeftKnee] = degrees(12, 0, 0), step.pose[Joint::RightKnee] = degrees(16, 0, 0);
  step.pose[Joint::LeftAnkle] = degrees(-6, 0, 0), step.pose[Joint::RightAnkle] = degrees(14, 0, 0);
  step.pose[Joint::LeftShoulder] = degrees(-16, 22, 0), step.pose[Joint::RightShoulder] = degrees(20, 22, 0);
  both(step.opening, Joint::LeftShoulder, degrees(0, 2, 0));
  both(step.opening, Joint::LeftHip, degrees(0, 1, 0));
  step.mostOpened = 10;
  all.push_back(step);

  NamedPose seated{"seated", say("Seated"), {}};
  both(seated.pose, Joint::LeftHip, degrees(86, 6, 0));
  both(seated.pose, Joint::LeftKnee, degrees(86, 0, 0));
  both(seated.pose, Joint::LeftShoulder, degrees(24, 14, 0));
  both(seated.pose, Joint::LeftElbow, degrees(50, 0, 0));
  both(seated.opening, Joint::LeftHip, degrees(-1, 1, 0));
  both(seated.opening, Joint::LeftShoulder, degrees(0, 2, 0));
  seated.mostOpened = 14;
  all.push_back(seated);

  NamedPose bent{"bent", say("Bent forwards"), {}};
  bent.pose[Joint::Pelvis] = degrees(40, 0, 0);
  bent.pose[Joint::Spine] = degrees(32, 0, 0);
  bent.pose[Joint::Neck] = degrees(6, 0, 0);
  both(bent.pose, Joint::LeftHip, degrees(40, 4, 0));
  both(bent.pose, Joint::LeftShoulder, degrees(70, 12, 0));
  bent.opening[Joint::Spine] = degrees(-2, 0, 0);
  both(bent.opening, Joint::LeftShoulder, degrees(-4, 3, 0));
  bent.mostOpened = 10;
  all.push_back(bent);
  return all;
}

}  // namespace

std::span<const std::string_view> jointNames() { return kJointNames; }

Message jointSaid(Joint joint) {
  switch (joint) {
    case Joint::Pelvis:
      return say("Pelvis");
    case Joint::Spine:
      return say("Spine");
    case Joint::Neck:
      return say("Neck joint");
    case Joint::LeftShoulder:
      return say("Left shoulder");
    case Joint::RightShoulder:
      return say("Right shoulder");
    case Joint::LeftElbow:
      return say("Left elbow");
    case Joint::RightElbow:
      return say("Right elbow");
    case Joint::LeftWrist:
      return say("Left wrist");
    case Joint::RightWrist:
      return say("Right wrist");
    case Joint::LeftHip:
      return say("Left hip joint");
    case Joint::RightHip:
      return say("Right hip joint");
    case Joint::LeftKnee:
      return say("Left knee");
    case Joint::RightKnee:
      return say("Right knee");
    case Joint::LeftAnkle:
      return say("Left ankle");
    case Joint::RightAnkle:
      return say("Right ankle");
  }
  return {};
}

Result<std::vector<Joint>> jointsNamed(std::string_view name) {
  std::vector<Joint> found;
  std::string all;
  for (std::size_t j = 0; j < kJoints; ++j) {
    const std::string_view own = kJointNames[j];
    const bool sided = own.starts_with("left_") || own.starts_with("right_");
    if (own == name || (sided && own.substr(own.find('_') + 1) == name)) found.push_back(static_cast<Joint>(j));
    all += (all.empty() ? "" : ", ") + std::string(own);
  }
  if (found.empty())
    return notFound(say("There is no joint “{0}”; there are: {1}. Without left_ or right_ both are meant.", name, all));
  return found;
}

JointLimits limitsOf(Joint joint) {
  switch (joint) {
    case Joint::Pelvis:
      return {degrees(-60, -45, -90), degrees(90, 45, 90)};
    case Joint::Spine:
      return {degrees(-30, -30, -40), degrees(60, 30, 40)};
    case Joint::Neck:
      return {degrees(-40, -35, -70), degrees(40, 35, 70)};
    case Joint::LeftShoulder:
    case Joint::RightShoulder:
      return {degrees(-60, -30, -90), degrees(175, 175, 90)};
    case Joint::LeftElbow:
    case Joint::RightElbow:
      return {degrees(-5, 0, -85), degrees(140, 0, 85)};
    case Joint::LeftWrist:
    case Joint::RightWrist:
      return {degrees(-65, -30, 0), degrees(70, 20, 0)};
    case Joint::LeftHip:
    case Joint::RightHip:
      return {degrees(-30, -20, -40), degrees(115, 60, 40)};
    case Joint::LeftKnee:
    case Joint::RightKnee:
      return {degrees(-5, 0, 0), degrees(135, 0, 0)};
    case Joint::LeftAnkle:
    case Joint::RightAnkle:
      return {degrees(-45, 0, 0), degrees(25, 0, 0)};
  }
  return {};
}

Done withinLimits(const BodyPose& pose) {
  constexpr double kRounding = 1e-9;
  for (const auto& [joint, angles] : pose) {
    const auto [least, most] = limitsOf(joint);
    const std::array<std::tuple<const char*, double, double, double>, 3> each{
        {{"flex", angles.flex, least.flex, most.flex},
         {"abduct", angles.abduct, least.abduct, most.abduct},
         {"turn", angles.turn, least.turn, most.turn}}};
    for (const auto& [field, angle, from, to] : each)
      if (!(angle >= from - kRounding && angle <= to + kRounding))
        return refused(say("{0}: {1}={2}° is more than the joint gives; it reaches from {3}° to {4}°.",
                           jointSaid(joint), field, fixed(angle / kDegree, 0), fixed(from / kDegree, 0),
                           fixed(to / kDegree, 0)));
    // A ball joint is no further from hanging than half a turn.
    if (!(std::hypot(angles.flex, angles.abduct) <= 176 * kDegree))
      return refused(say("{0}: flex and abduct together lead beyond straight up.", jointSaid(joint)));
  }
  return {};
}

std::span<const NamedPose> namedPoses() {
  static const std::vector<NamedPose> all = makeNamed();
  return all;
}

const NamedPose* namedPose(std::string_view name) {
  for (const NamedPose& pose : namedPoses())
    if (pose.name == name) return &pose;
  return nullptr;
}

}  // namespace karinui
