#include "haptic_cues.h"

#include <algorithm>

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
  pull_.reset();
  touching_ = snapped_ = false;
}

bool HapticCues::snapped(const Session& session) const {
  const Preview preview = session.preview();
  return session.tool() == Command::Move && !preview.carried.empty() && !preview.space.dots.empty();
}

std::optional<HapticPulse> HapticCues::follow(const Session& session, const PointerSample& sample,
                                              std::optional<Vec3> tip, double seconds) {
  const bool before = std::exchange(snapped_, snapped(session));
  if (snapped_ && !before) return kSnap;

  // Where the cloth is held, by its ray's place or by the tip.
  if (sample.phase == PointerSample::Phase::Press && session.tool() == Command::Pull) {
    const auto hit = pick(session.snapshot(), session.table(), sample);
    if (hit.on == Hit::On::Cloth) pull_ = Handling::Pull{hit.piece, hit.paper, hit.point, hit.point, {}};
  }
  if (!session.begun() || session.tool() != Command::Pull) pull_.reset();

  Handling handling;
  Vec3 at = tip.value_or(Vec3{});
  if (pull_) {
    handling.pull = pull_;
    const Preview preview = session.preview();
    if (!tip && !preview.space.dots.empty()) at = preview.space.dots.front();  // the end of the ray
  } else if (!tip) {
    evaluator_.reset();
    touching_ = false;
    return std::nullopt;
  }
  for (const auto& [piece, moved] : session.preview().carried) handling.carried.insert(piece);
  const TouchScene scene = touchSceneOf(session.snapshot(), at, handling);
  const TouchForces forces = evaluator_.evaluate(scene, motor(), TouchLaws(), at, {});
  const bool began = forces.touching && !touching_;
  touching_ = forces.touching;
  if (seconds < next_ && !began) return std::nullopt;
  const double amplitude =
      pull_ ? amplitudeOf(length(forces.pull), kTensionFull) : amplitudeOf(length(forces.contact), kContactFull);
  if (amplitude <= 0 && !began) return std::nullopt;
  next_ = seconds + kEvery;
  return HapticPulse{std::max(amplitude, began ? 0.35 : kLeast), began ? 0.03 : kEvery};
}

}  // namespace karinui::room
