#pragma once
// What cloth is made of, in SI units. Directions: warp (along the grain) and weft (across).
#include <span>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

struct Fabric {
  // Woven: anisotropic membrane + bending. Simcloth: the historical law, tension only, no bending.
  enum class Law { Woven, Simcloth };
  std::string name = "cotton";
  Law law = Law::Woven;
  double weight = 0.15;                           // kg/m2
  double stretchWarp = 1000, stretchWeft = 1000;  // N/m per unit strain
  double shear = 40;                              // N/m per radian
  double bendWarp = 1e-5, bendWeft = 1e-5;        // N m; bending that curves the warp (weft) threads
  double compression = 0.05;                      // share of the stretch stiffness that resists squeezing, 0..1
  double toe = 0.002;         // strain over which stiffness rises from the squeeze's to the stretch's
  double thickness = 0.0005;  // m
  double frictionBody = 0.3, frictionCloth = 0.3;
  bool operator==(const Fabric&) const = default;
};

std::span<const Fabric> presets();               // lasts as long as the program
Result<Fabric> preset(std::string_view name);    // NotFound lists those there are
Result<void> checkFabric(const Fabric& fabric);  // refuses absurd values, saying which and what is usual

}  // namespace karinui
