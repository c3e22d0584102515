#pragma once
// A strip of faces laid into the plane, and the taut line between two places through it.
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/geometry/mesh.h"

namespace karinui {

struct TautLine {
  struct Bend {
    std::uint32_t corner = 0;                 // the mesh point the line bends round
    std::size_t firstFace = 0, lastFace = 0;  // indices into the strip: the faces that hold it there
    double angleOutside = 0;                  // the part of those two end faces that lies beyond the line, seen from it
  };
  std::vector<SurfacePoint> places;
  std::vector<Bend> bends;
  double length = 0;
};

// Consecutive faces of the strip share an edge; `from` lies in the first, `to` in the last.
TautLine pullTaut(const TriangleMesh& mesh, std::span<const std::uint32_t> strip, const SurfacePoint& from,
                  const SurfacePoint& to);

}  // namespace karinui
