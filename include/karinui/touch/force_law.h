#pragma once
// The laws a hand may feel, each as its formula. Force is what acts on the hand. Pure functions, no allocation.
#include "karinui/touch/touch_scene.h"

namespace karinui {

// How cloth that is pulled is felt: by Eq. (1) of the published system, by the fabric's own curve, or by the solver's
// last force and its stiffness there.
enum class PullLaw { None, Springs, Curve, Tangent };

// Which laws are felt. Reshaping the pattern has none.
struct TouchLaws {
  bool contact = true, friction = true, weight = true, click = true, cutting = true;
  bool weave = false;
  PullLaw pull = PullLaw::Curve;
  bool operator==(const TouchLaws&) const = default;
};

inline constexpr double kGravity = 9.81;       // m/s2
inline constexpr double kClickForce = 0.25;    // N
inline constexpr double kClickSeconds = 0.04;  // a raised cosine: 20 N/s at the steepest

// F = -(N.P) N, times the stiffness. P: from the surface to the device; zero on the outer side.
Vec3 contactForce(Vec3 penetration, Vec3 normal, double stiffness);
Vec3 weightForce(double mass);
// K (x_k - x)(l - L)/l where l = |x - x_k| > L, else nothing: Eq. (1), as it acts on the hand at x.
Vec3 springTension(Vec3 place, Vec3 neighbour, double natural, double stiffness);
// The curve's force at an extension, its slope held to `steepest` N/m.
double tension(const TensionCurve& curve, double extension, double steepest);
double storedEnergy(const TensionCurve& curve, double extension, double steepest);  // J
// Against the velocity: all of it from 5 cm/s on, less below.
Vec3 cuttingForce(double resistance, Vec3 velocity);
// By how much of itself the contact force changes at a place of the weave.
double weaveShare(const Weave& weave, Vec3 place);
double clickForce(double secondsSince);  // N

}  // namespace karinui
