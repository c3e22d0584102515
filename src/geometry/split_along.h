#pragma once
// A mesh whose faces are split exactly along lines drawn over it.
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/geodesic.h"

namespace karinui {

struct SplitMesh {
  TriangleMesh mesh;                  // the old points first
  std::vector<std::uint32_t> parent;  // of each face: the old face it is part of
  std::vector<std::uint32_t> loop;    // the closed line as points of the mesh; each step is an edge of it
  std::vector<std::uint32_t> side;    // side[i]: the drawn side of the step loop[i] -> loop[i + 1]
};

// The sides join end to end and close. Refuses a line that crosses itself, has an empty side or stays inside one face.
Result<SplitMesh> splitAlong(const SurfaceGuide& guide, std::span<const SurfacePath> sides);

}  // namespace karinui
