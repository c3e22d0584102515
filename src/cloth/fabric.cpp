#include "karinui/cloth/fabric.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace karinui {
namespace {

// Our own typical cloths. Weights and bending lie inside the classes of the published measurements of 618 fabrics
// (median bending by weight class), stretch and shear inside the ranges of KES measurements of apparel cloth; none is a
// copy of one measured sample.
const std::array<Fabric, 14>& own() {
  using enum Fabric::Law;
  static const std::array<Fabric, 14> kOwn{{
      // name, law, weight, stretch warp weft, toe warp weft, stiffening warp weft, compression, shear, its stiffening,
      // bending warp weft, thickness, friction on body, on cloth
      {"chiffon", Woven, 0.045, 1100, 800, 0.003, 0.004, 590, 250, 0.05, 12, 2, 1.2e-6, 1e-6, 0.00018, 0.25, 0.25},
      {"silk", Woven, 0.075, 1100, 900, 0.002, 0.003, 760, 300, 0.05, 15, 2, 2.2e-6, 1.7e-6, 0.0002, 0.25, 0.22},
      {"viscose", Woven, 0.12, 900, 600, 0.003, 0.005, 570, 200, 0.05, 20, 2, 4.5e-6, 3.5e-6, 0.00028, 0.3, 0.3},
      {"cotton", Woven, 0.15, 1200, 1000, 0.002, 0.002, 390, 260, 0.05, 40, 2, 1.5e-5, 1.1e-5, 0.00032, 0.35, 0.35},
      {"linen", Woven, 0.19, 1500, 1300, 0.002, 0.002, 760, 630, 0.05, 55, 2, 2.2e-5, 1.8e-5, 0.00045, 0.35, 0.35},
      {"wool suiting", Woven, 0.23, 900, 700, 0.003, 0.004, 450, 220, 0.05, 45, 2, 1.8e-5, 1.4e-5, 0.00057, 0.35, 0.4},
      {"wool coating", Woven, 0.42, 1000, 800, 0.004, 0.004, 280, 140, 0.08, 60, 2, 5.5e-5, 4.5e-5, 0.0012, 0.4, 0.45},
      {"denim", Woven, 0.36, 1800, 1200, 0.002, 0.003, 220, 240, 0.05, 100, 2, 7e-5, 5e-5, 0.0009, 0.4, 0.45},
      {"jersey", Woven, 0.19, 120, 90, 0.01, 0.01, 130, 52, 0.1, 30, 0, 6e-6, 5e-6, 0.0007, 0.4, 0.45},
      {"interlock", Woven, 0.22, 250, 150, 0.01, 0.01, 120, 71, 0.1, 36, 0, 1.2e-5, 9e-6, 0.0009, 0.4, 0.45},
      {"velvet", Woven, 0.28, 900, 700, 0.004, 0.005, 300, 170, 0.08, 40, 2, 2e-5, 1.5e-5, 0.0016, 0.4, 0.6},
      {"leather", Woven, 0.5, 3200, 2600, 0.002, 0.002, 25, 20, 0.1, 700, 1, 3.6e-5, 3.2e-5, 0.0008, 0.45, 0.5},
      {"interfacing", Woven, 0.06, 500, 400, 0.003, 0.004, 200, 120, 0.05, 30, 2, 4e-6, 3e-6, 0.0003, 0.3, 0.3},
      {"simcloth", Simcloth, 0.15, 1000, 1000, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0005, 0.3, 0.3},
  }};
  return kOwn;
}

// `karinui bench cusick`: 2,800 vertices, the mean of six times each; in the order above.
constexpr DrapeFigure kDraped[]{{38, 8}, {38, 8}, {42, 8}, {65, 7}, {69, 7}, {56, 7}, {67, 7},
                                {76, 7}, {34, 8}, {46, 8}, {55, 8}, {63, 7}, {57, 7}};

struct Range {
  Message what;
  double value, low, high;
  const char* unit;
};

}  // namespace

std::optional<DrapeFigure> drapeFigure(const Fabric& fabric) {
  const auto at = std::find(own().begin(), own().end(), fabric);
  if (at == own().end() || fabric.law != Fabric::Law::Woven) return {};
  return kDraped[static_cast<std::size_t>(at - own().begin())];
}
std::span<const Fabric> presets() { return own(); }

Fabric fused(const Fabric& outer, const Fabric& interfacing) {
  Fabric both = outer;
  const double apart = (outer.thickness + interfacing.thickness) / 2;
  both.weight += interfacing.weight, both.thickness += interfacing.thickness;
  // What is a number of a curve rather than a stiffness is the mean by the stiffness it belongs to.
  const auto mean = [](double a, double ofA, double b, double ofB) {
    return ofA + ofB > 0 ? (a * ofA + b * ofB) / (ofA + ofB) : 0;
  };
  const auto thread = [&](double Fabric::*stretch, double Fabric::*toe, double Fabric::*stiffen, double Fabric::*bend) {
    const double a = outer.*stretch, b = interfacing.*stretch;
    both.*stretch = a + b;
    both.*toe = mean(outer.*toe, a, interfacing.*toe, b);
    both.*stiffen = mean(outer.*stiffen, a, interfacing.*stiffen, b);
    both.*bend = outer.*bend + interfacing.*bend + a * b / (a + b) * apart * apart;
  };
  thread(&Fabric::stretchWarp, &Fabric::toeWarp, &Fabric::stiffenWarp, &Fabric::bendWarp);
  thread(&Fabric::stretchWeft, &Fabric::toeWeft, &Fabric::stiffenWeft, &Fabric::bendWeft);
  both.compression = mean(outer.compression, outer.stretchWarp, interfacing.compression, interfacing.stretchWarp);
  both.shear = outer.shear + interfacing.shear;
  both.shearStiffen = mean(outer.shearStiffen, outer.shear, interfacing.shearStiffen, interfacing.shear);
  return both;
}

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
      {say("toe of the warp"), fabric.toeWarp, 0, 0.5, ""},
      {say("toe of the weft"), fabric.toeWeft, 0, 0.5, ""},
      {say("stiffening of the warp"), fabric.stiffenWarp, 0, 1e5, ""},
      {say("stiffening of the weft"), fabric.stiffenWeft, 0, 1e5, ""},
      {say("stiffening of the shear"), fabric.shearStiffen, 0, 1000, ""},
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
