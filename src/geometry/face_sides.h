#pragma once
// The sides of a mesh's faces, edge by edge, for whoever asks which faces meet where.
#include <cstdint>
#include <vector>

#include "karinui/geometry/mesh.h"

namespace karinui {

// One side of one face, named by its lower and higher end so that the faces of an edge lie together.
struct FaceSide {
  std::uint32_t low = 0, high = 0, face = 0;
  std::uint32_t from = 0;  // 0, 1, 2: the corner of the face it begins at
  bool forward = false;    // the face runs from low to high
  bool sameEdge(const FaceSide& other) const { return low == other.low && high == other.high; }
};

// By their lower ends, then their higher ends, then their faces. Dealt out by the lower end, which few sides share, and
// sorted among those: a sort of all would take as long as all else that is asked of a body that is opened.
std::vector<FaceSide> sidesByEdge(const TriangleMesh& mesh);

}  // namespace karinui
