#pragma once
// Cloth that follows a body from one pose to another. The body goes in parts, none of its skin near cloth by more than
// a centimetre in any; in each the cloth is first carried by the skin it lies on, and then takes a step of the solver
// on the body as it stands there. So the outcome depends on the way alone, not on how fast it is gone. The cloth is not
// at rest at the end: that is what settle() is for. The same input gives the same bits for any number of threads.
// Metres. See docs/develop/poses.md.
#include "karinui/body/skeleton.h"
#include "karinui/cloth/settle.h"

namespace karinui {

// What is seen of a way after each of its parts. Called by the caller's thread; it does not influence the outcome.
struct FollowedPart {
  double share = 0;               // of the way, to the end of the part
  const BodyPose& pose;           // there
  const std::vector<Vec3>& skin;  // where the points of the body's mesh are in it
  const Cloth& cloth;
  const std::vector<Vec3>& places;  // of the cloth's nodes
};
using FollowWatcher = std::function<void(const FollowedPart&)>;

struct FollowReport {
  std::size_t parts = 0;  // of the way
};

// `level`: the cloth as it stands on the body in the pose `from`; replaced on success. All its pieces should be live.
// `wider`: the same garment of wider cells, or null. It goes the way in place of the level, in a third of the time, and
// the level follows it with its detail; where that fails, the level goes by itself, and the watcher sees the way anew.
Result<FollowReport> follow(ClothLevel& level, const Cloth* wider, const Skeleton& skeleton, const BodyPose& from,
                            const BodyPose& to, const Token& token, Workers& workers,
                            const FollowWatcher& watcher = {});

// The same way for things that are handled as rigid: of each place how the skin nearest to it goes, or the identity
// where there is none within reach.
std::vector<Rigid> carriedBySkin(const std::vector<Vec3>& places, const Skeleton& skeleton, const BodyPose& from,
                                 const BodyPose& to);

}  // namespace karinui
