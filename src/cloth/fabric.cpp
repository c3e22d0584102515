#include "karinui/cloth/fabric.h"

#include <array>
#include <cmath>

namespace karinui {
namespace {

// Our own typical cloths. Weights and bending lie inside the classes of the published measurements of 618 fabrics
// (median bending by weight class), stretch and shear inside the ranges of KES measurements of apparel cloth; none is a
// copy of one measured sample.
const std::array<Fabric, 8>& own() {
  using enum Fabric::Law;
  static const std::array<Fabric, 8> kOwn{{
      // name, law, weight, warp, weft, shear, bendWarp, bendWeft, compression, toe, thickness, body, cloth
      {"cotton", Woven, 0.15, 1200, 1000, 40, 1.1e-5, 8.5e-6, 0.05, 0.002, 0.00032, 0.35, 0.35},
      {"chiffon", Woven, 0.045, 700, 500, 12, 1.3e-6, 1.1e-6, 0.05, 0.002, 0.00018, 0.25, 0.25},
      {"silk", Woven, 0.075, 900, 700, 18, 3.6e-6, 2.8e-6, 0.05, 0.002, 0.0002, 0.25, 0.22},
      {"wool suiting", Woven, 0.23, 900, 700, 45, 1.8e-5, 1.4e-5, 0.05, 0.002, 0.00057, 0.35, 0.4},
      {"denim", Woven, 0.36, 1800, 1200, 90, 3.6e-5, 2.4e-5, 0.05, 0.002, 0.0009, 0.4, 0.45},
      {"jersey", Woven, 0.19, 120, 90, 30, 6e-6, 5e-6, 0.1, 0.004, 0.0007, 0.4, 0.45},
      {"linen", Woven, 0.19, 1500, 1300, 55, 2.2e-5, 1.8e-5, 0.05, 0.002, 0.00045, 0.35, 0.35},
      {"simcloth", Simcloth, 0.15, 1000, 1000, 0, 0, 0, 0, 0, 0.0005, 0.3, 0.3},
  }};
  return kOwn;
}

struct Range {
  Message what;
  double value, low, high;
  const char* unit;
};

}  // namespace

std::span<const Fabric> presets() { return own(); }

Result<Fabric> preset(std::string_view name) {
  std::string known;
  for (const Fabric& fabric : own()) {
    if (fabric.name == name) return fabric;
    known += (known.empty() ? "" : ", ") + fabric.name;
  }
  return notFound(say("There is no fabric “{0}” in the shop; there are: {1}.", name, known));
}

Result<void> checkFabric(const Fabric& fabric) {
  const Range ranges[] = {
      {say("weight"), fabric.weight, 0.005, 5, "kg/m2"},
      {say("stretch along the warp"), fabric.stretchWarp, 1, 1e6, "N/m"},
      {say("stretch along the weft"), fabric.stretchWeft, 1, 1e6, "N/m"},
      {say("shear"), fabric.shear, 0, 1e6, "N/m"},
      {say("bending of the warp"), fabric.bendWarp, 0, 1, "N m"},
      {say("bending of the weft"), fabric.bendWeft, 0, 1, "N m"},
      {say("compression"), fabric.compression, 0, 1, ""},
      {say("toe"), fabric.toe, 0, 0.5, ""},
      {say("thickness"), fabric.thickness, 1e-5, 0.02, "m"},
      {say("friction on the body"), fabric.frictionBody, 0, 5, ""},
      {say("friction on cloth"), fabric.frictionCloth, 0, 5, ""},
  };
  for (const Range& range : ranges)
    if (!std::isfinite(range.value) || range.value < range.low || range.value > range.high)
      return badInput(say("The fabric “{0}” has a {1} of {2}; it must lie between {3} and {4} {5}.", fabric.name,
                          range.what, range.value, range.low, range.high, range.unit));
  return {};
}

}  // namespace karinui
