#pragma once
// Continues cloth that was called at rest as plain dynamics, to see how fast it still moves: frames of 1/60 s, no
// damping but backward Euler's own. Metres, seconds. One caller at a time, as settle.
#include "karinui/cloth/settle.h"

namespace karinui {

inline constexpr int kDynamicsFrames = 300;

struct DynamicsReport {
  double drift = 0;          // metres the centre of mass has moved by the end
  double firstTopSpeed = 0;  // m/s of the fastest node in the first ten frames,
  double topSpeed = 0;       // and in all of them
};
Result<DynamicsReport> runDynamics(const ClothLevel& level, const ColliderList& colliders,
                                   const SettleSettings& settings, int frames, const Token& token, Workers& workers);

}  // namespace karinui
