#pragma once
// The skeleton under a figure, found from its chart, and the skin that follows it. Every joint bends the skin over a
// stretch of the limb along an arc; so each cross-section stays as it was, however far the joint is bent. See
// docs/develop/poses.md. Metres, the body's space; immutable, any thread.
#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "karinui/body/body.h"

namespace karinui {

class Skeleton {
 public:
  // `own`: a figure in its own pose. Refused where trunk and limbs could not be found on it.
  static Result<std::shared_ptr<const Skeleton>> of(const BodyPtr& own);

  const BodyPtr& body() const { return own_; }
  Vec3 place(Joint joint) const { return place_[static_cast<std::size_t>(joint)]; }  // in the own pose
  JointAngles own(Joint joint) const { return angles_[static_cast<std::size_t>(joint)]; }
  // All joints' angles, those not named in `pose` being the figure's own.
  BodyPose whole(const BodyPose& pose) const;

  // So far on the way from one pose to another, 0 … 1: all joints' angles.
  BodyPose between(const BodyPose& from, const BodyPose& to, double share) const;
  // Finds what the first pose is compared with, a tenth of a second before it is asked for.
  void prepare() const;

  // Of each point of the body's mesh: from where it is in the own pose to where it is in this one. The figure stands on
  // the floor, its pelvis over the same place. Exactly nothing moves in the empty pose.
  std::vector<Rigid> placements(const BodyPose& pose) const;
  std::vector<Vec3> points(const std::vector<Rigid>& placements) const;

  // The pose of a name on this figure, opened until no flesh presses into other flesh.
  Result<BodyPose> named(const NamedPose& pose) const;
  // Pairs of faces of the skin that cross in this pose; `apart`: as if hands, arms and thighs were thicker by so much.
  std::size_t crossings(const BodyPose& pose, double apart = 0) const;

 private:
  Skeleton() = default;
  std::size_t usualCrossings(bool apart) const;  // those of the own pose
  void findJoints();

  BodyPtr own_;
  double height_ = 0;
  std::array<Vec3, kJoints> place_{};
  std::array<Vec3, kJoints> along_{};   // unit, of the bone that a joint moves, in the own pose
  std::array<Vec3, kJoints> hinge_{};   // unit: a positive flex turns about it; of elbow, wrist, knee, ankle
  std::array<double, kJoints> over_{};  // metres of the bone over which the skin bends
  std::array<JointAngles, kJoints> angles_{};
  std::array<std::vector<float>, kJoints>
      field_;  // of each point of the skin: how far it has come through the joint, 0 … 1
  std::array<std::vector<float>, kJoints> twist_;  // the same for a turn about the bone
  std::vector<float> apart_;                       // of each point: what may not come near other skin, 0 … 1
  mutable std::array<std::once_flag, 2> counting_;
  mutable std::array<std::size_t, 2> usual_{};

  friend Result<BodyPtr> posed(const Skeleton& skeleton, const BodyPose& pose);
};

// The figure as it stands in a pose, its mesh's faces being those of `own`: a SurfacePoint is the same place of the
// skin. Its measures are those of the own pose. Refused: angles beyond a joint's limits, and a pose in which its skin
// would cross itself.
Result<BodyPtr> posed(const Skeleton& skeleton, const BodyPose& pose);

}  // namespace karinui
