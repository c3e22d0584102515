#include "haptic_cues.h"

#include <algorithm>
#include <utility>

namespace karinui::room {

namespace {

constexpr double kContactFull = 4, kTensionFull = 8;  // newtons
constexpr double kLeast = 0.05;                       // of the amplitude: less is not felt
constexpr double kEvery = 0.05;                       // seconds between two pulses of what goes on
constexpr HapticPulse kSnap{0.7, 0.02};

// No device that pushes: only how hard the laws would have it pushed matters.
DeviceRecord motor() {
  DeviceRecord record;
  record.stiffness = 400, record.damping = 1;
  record.vibrates = true;
  return record;
}

}  // namespace

double amplitudeOf(double newtons, double full) {
  const double share = newtons / full;
  return share < kLeast / 2 ? 0 : std::clamp(share, kLeast, 1.0);
}

void HapticCues::reset() {
  evaluator_.reset();
  clicks_.reset();
  touching_ = false;
}

std::optional<HapticPulse> HapticCues::follow(const Session& session, std::optional<Vec3> tip, double seconds) {
  const TouchSource source = session.touchSource();
  const std::optional<std::uint32_t> before = std::exchange(clicks_, source.handling.clicks);
  if (before && *before != source.handling.clicks) return kSnap;

  const auto& pull = source.handling.pull;
  if (!tip && pull) tip = pull->place;  // the end of the ray
  if (!tip) {
    evaluator_.reset();
    touching_ = false;
    return std::nullopt;
  }
  const TouchForces forces = evaluator_.evaluate(source.sceneAt(*tip), motor(), TouchLaws(), *tip, {});
  const bool began = forces.touching && !touching_;
  touching_ = forces.touching;
  if (seconds < next_ && !began) return std::nullopt;
  const double amplitude =
      pull ? amplitudeOf(length(forces.pull), kTensionFull) : amplitudeOf(length(forces.contact), kContactFull);
  if (amplitude <= 0 && !began) return std::nullopt;
  next_ = seconds + kEvery;
  return HapticPulse{std::max(amplitude, began ? 0.35 : kLeast), began ? 0.03 : kEvery};
}

}  // namespace karinui::room
