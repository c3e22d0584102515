#pragma once
// Reading a body with the tape: levels, limb lines and girths of any standing A-pose mesh, from plane sections alone.
// measure(), the landmarks of bodies without a template, and the charts all stand on this one reading.
#include <map>
#include <optional>
#include <string>

#include "karinui/body/measurements.h"
#include "karinui/geometry/mesh.h"
#include "karinui/geometry/section.h"

namespace karinui {

struct LimbLine {              // the bones of one arm or leg, in space
  Vec3 top, middle, end, tip;  // shoulder elbow wrist fingertip, or hip knee ankle toes
};

struct Reading {
  std::map<std::string, double> value;
  std::map<std::string, Vec3> landmark;
  std::optional<LimbLine> arm[2], leg[2];  // 0: the body's left (+x), 1: right
};

Reading readBody(const TriangleMesh& mesh);

Vec3 lineCentre(const SectionLoop& loop);  // of its line, by length
// The loop of the section nearest to `near`; nothing if the plane misses the mesh.
std::optional<SectionLoop> loopNear(const TriangleMesh& mesh, Vec3 through, Vec3 normal, Vec3 near);

}  // namespace karinui
