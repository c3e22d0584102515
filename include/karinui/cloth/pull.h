#pragma once
// Pulls a patch of cloth along a path while the cloth drapes, then brings all to rest. Metres, seconds, newtons.
// Threads, determinism and errors as of settle.
#include "karinui/cloth/settle.h"

namespace karinui {

struct Grip {
  std::vector<std::uint32_t> nodes;  // of the finest level
  std::vector<Vec3> path;            // where the grip's middle goes, first = where it is; straight between
  double seconds = 1.0;              // how long the path takes
  bool letGo = false;                // afterwards free, otherwise held at the end
};
struct PullReport {
  SettleReport end;
  std::vector<Vec3> force;  // newtons the hand feels, one per path point; only beyond natural length
  double maxForce = 0;
};
Result<PullReport> pull(ClothLevel& level, const ColliderList& colliders, const Grip& grip,
                        const SettleSettings& settings, const Token& token, Workers& workers);

}  // namespace karinui
