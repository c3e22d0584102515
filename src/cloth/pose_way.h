#pragma once
// The way of a body from one pose to another, gone part by part: none is longer than the cloth near the skin bears.
#include <vector>

#include "karinui/body/skeleton.h"

namespace karinui {

class PoseWay {
 public:
  // `skeleton` must outlive it. Both ends are made whole poses.
  PoseWay(const Skeleton& skeleton, const BodyPose& from, const BodyPose& to);
  double share() const { return share_; }  // of the way that is gone
  BodyPose pose() const { return skeleton_.between(from_, to_, share_); }
  // How the body's points stand here, and at the end; and where they are here.
  const std::vector<Rigid>& placements() const { return placements_; }
  std::vector<Rigid> lastPlacements() const { return skeleton_.placements(to_); }
  const std::vector<Vec3>& points() const { return points_; }

  // On to the end of the next part, the cloth standing at `cloth`. The skin moves about evenly along the way, so the
  // part before tells how long the next may be. `spacing`: an edge of the cloth.
  void goOn(const std::vector<Vec3>& cloth, double spacing);

 private:
  const Skeleton& skeleton_;
  BodyPose from_, to_;
  double share_ = 0, next_;
  std::vector<Rigid> placements_;
  std::vector<Vec3> points_;
};

}  // namespace karinui
