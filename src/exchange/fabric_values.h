#pragma once
// What files tell of a fabric, by the names and in the units of the operation `fabric`.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/cloth/fabric.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// Calls `visit(name, value)` for each number of a fabric.
template <class AnyFabric, class Visit>
void eachFabricValue(AnyFabric& fabric, Visit&& visit) {
  visit("weight", fabric.weight), visit("thickness", fabric.thickness);
  visit("stretch_warp", fabric.stretchWarp), visit("stretch_weft", fabric.stretchWeft);
  visit("toe_warp", fabric.toeWarp), visit("toe_weft", fabric.toeWeft);
  visit("stiffen_warp", fabric.stiffenWarp), visit("stiffen_weft", fabric.stiffenWeft);
  visit("compression", fabric.compression);
  visit("shear", fabric.shear), visit("shear_stiffen", fabric.shearStiffen);
  visit("bend_warp", fabric.bendWarp), visit("bend_weft", fabric.bendWeft);
  visit("friction_body", fabric.frictionBody), visit("friction_cloth", fabric.frictionCloth);
}

std::string_view lawName(Fabric::Law law);
bool lawNamed(std::string_view name, Fabric::Law& law);  // false: there is none of that name

// Of the fabrics known those that the pieces of a pattern are cut from, each once, by name.
std::vector<const Fabric*> fabricsOf(const Pattern& pattern, const std::map<std::string, Fabric>& known);

}  // namespace karinui
