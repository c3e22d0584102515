#pragma once
// What cloth is made of, in SI units, as curves of a few numbers each: how warp (along the grain) and weft (across) are
// stretched, how the right angle between them is sheared, how both are bent. Pure values; any thread.
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

// Force per width of threads over their strain. Below zero `squeeze`; over the toe the slope rises evenly to
// `stiffness`; beyond it the slope grows by `stiffening` of itself for each unit of strain, to kFirmest times at most.
// The law is monotone, its slope continuous but at zero where there is no toe.
struct ThreadCurve {
  static constexpr double kFirmest = 30;
  double stiffness = 0, squeeze = 0, toe = 0, stiffening = 0;
  // The strain beyond the toe over which the slope grows.
  double firming() const { return stiffening > 0 ? (kFirmest - 1) / stiffening : 0; }
  double energy(double strain) const;   // J/m2
  double force(double strain) const;    // N/m
  double tangent(double strain) const;  // N/m
  // The two numbers of a tensile test (KES-FB1): the strain at a force, 490 N/m (500 gf/cm) where cloth is no knit, and
  // the linearity: the work done up to there over that of a straight line.
  double strainAt(double force) const;
  double linearity(double force) const;
};

struct Fabric {
  // Woven: anisotropic membrane + bending; knits too. Simcloth: the historical law, tension only, no bending.
  enum class Law { Woven, Simcloth };
  std::string name = "cotton";
  Law law = Law::Woven;
  double weight = 0.15;                           // kg/m2
  double stretchWarp = 1000, stretchWeft = 1000;  // N/m per unit strain, at the toe's end
  double toeWarp = 0.002, toeWeft = 0.002;        // strain over which that is reached, from the squeeze's
  double stiffenWarp = 0, stiffenWeft = 0;        // by how much of itself it grows per unit of strain beyond the toe
  double compression = 0.05;                      // share of the stretch stiffness that resists squeezing, 0..1
  double shear = 40;                              // N/m per radian,
  double shearStiffen = 0;                        // growing by 3 times this of itself per radian squared
  double bendWarp = 1e-5, bendWeft = 1e-5;        // N m; bending that curves the warp (weft) threads; on the bias their
                                            // arithmetic and geometric means' mean, as 618 measured fabrics have it
  double thickness = 0.0005;  // m
  double frictionBody = 0.3, frictionCloth = 0.3;
  bool operator==(const Fabric&) const = default;

  ThreadCurve warpCurve() const { return {stretchWarp, compression * stretchWarp, toeWarp, stiffenWarp}; }
  ThreadCurve weftCurve() const { return {stretchWeft, compression * stretchWeft, toeWeft, stiffenWeft}; }
};

// Two cloths fused over their whole face into one, thread on thread, as an interfacing to a piece: weights,
// thicknesses, stretch and shear add up, and both bend about a common line between them,
//     B = B1 + B2 + K1 K2 / (K1 + K2) d^2,  d = (t1 + t2) / 2
// (laminated beam: S. Timoshenko, Strength of Materials). Friction and law are the outer one's.
Fabric fused(const Fabric& outer, const Fabric& interfacing);

std::span<const Fabric> presets();               // lasts as long as the program
Result<Fabric> preset(std::string_view name);    // NotFound lists those there are
Result<void> checkFabric(const Fabric& fabric);  // refuses absurd values, saying which and what is usual

// How a disc of 30 cm hangs over a support of 18 cm (Cusick): the share of the free ring its shadow covers, and how
// many folds it falls into.
struct DrapeFigure {
  double coefficient = 0;  // percent: 0 hangs straight down, 100 stands straight out
  int folds = 0;
};
// As simulated (`karinui bench cusick`); none for a fabric that is not exactly a preset of woven law.
std::optional<DrapeFigure> drapeFigure(const Fabric& fabric);

}  // namespace karinui
