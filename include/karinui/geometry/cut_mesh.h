#pragma once
// A part of a surface cut off along a plane. Metres. Pure functions, any thread.
#include <optional>
#include <vector>

#include "karinui/geometry/section.h"

namespace karinui {

// Where a point of the mesh that is left comes from: on the way from one point of the uncut mesh to another.
struct CutPoint {
  std::uint32_t from = 0, to = 0;
  double share = 0;
};

struct CutMesh {
  TriangleMesh mesh;  // points that are left over belong to no face
  std::vector<CutPoint> points;
  std::size_t closing = 0;  // the last so many faces close the cut
};

// Takes away what lies where the plane's normal points; of the faces in `only` (by face) if it is given. `close`: the
// cut of a closed mesh is closed with flat faces, whose points are their own, so that it has an edge; a section that
// crosses itself stays open. A point exactly on the plane counts as above it.
CutMesh cutOff(const TriangleMesh& mesh, const Plane& plane, bool close, const std::vector<bool>* only = nullptr);

// The faces above the plane that hang together, over their points above it, with those the plane cuts within `reach` of
// plane.through: an arm, of a plane through the armhole.
std::vector<bool> partAbove(const TriangleMesh& mesh, const Plane& plane, double reach);

}  // namespace karinui
