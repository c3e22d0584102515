#pragma once
// How the skin follows its joints: of each point of a body's mesh, how far it has come through every joint.
#include <array>
#include <vector>

#include "body/joints.h"
#include "karinui/body/body.h"

namespace karinui {

// The joints of a body as it stands. Metres; directions are unit vectors.
struct Bones {
  double height = 0;
  std::array<Vec3, kJoints> place{};
  std::array<Vec3, kJoints> along{};   // of the bone that a joint moves
  std::array<double, kJoints> over{};  // of the bone over which the skin bends
};

// Shares from 0 to 1, one for each point of the mesh.
struct SkinFields {
  std::array<std::vector<float>, kJoints> through;  // of the joint's swing
  std::array<std::vector<float>, kJoints> twist;    // of the turn about its bone
  std::vector<float> apart;                         // what may not come near other skin
};

// The body has a chart.
SkinFields skinFields(const Body& body, const Bones& bones);

}  // namespace karinui
