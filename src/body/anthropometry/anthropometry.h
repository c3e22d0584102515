#pragma once
// Measurements, landmarks and limb axes of any standing A-pose mesh, from plane sections alone. measure(), the
// landmarks of bodies without a template and the charts all stand on this one extraction. The body stands near the
// origin, where readers carry it: within a metre of z = 0. Metres; a pure function, any thread.
#include <map>
#include <optional>
#include <string>

#include "karinui/geometry/mesh.h"

namespace karinui {

struct LimbAxis {              // the joints of one arm or leg, in space
  Vec3 top, middle, end, tip;  // shoulder elbow wrist fingertip, or hip knee ankle toes
};

struct Anthropometry {
  std::map<std::string, double> value;     // by measurementKeys(); what is not found is left out
  std::map<std::string, Vec3> landmark;    // near the skin
  bool belly = false;                      // stands out; else the girth of the belly is that of an ordinary front
  std::optional<LimbAxis> arm[2], leg[2];  // 0: the body's left (+x), 1: right
};

Anthropometry anthropometryOf(const TriangleMesh& mesh);

}  // namespace karinui
