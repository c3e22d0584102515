#pragma once
// Is it rest, or only heavy damping? Cloth that was called at rest is run on as plain dynamics: frames of 1/60 s, no
// velocity taken off but by backward Euler itself. Metres, seconds. One caller at a time, as settle.
#include "karinui/cloth/settle.h"

namespace karinui {

inline constexpr int kRunOnFrames = 300;

struct RunOn {
  double drift = 0;          // metres the centre of mass has moved by the end
  double firstTopSpeed = 0;  // m/s of the fastest node in the first ten frames,
  double topSpeed = 0;       // and in all of them
};
Result<RunOn> runOn(const ClothLevel& level, const Collider& body, const SettleSettings& settings, int frames,
                    const Token& token, Workers& workers);

}  // namespace karinui
