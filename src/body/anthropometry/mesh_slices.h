#pragma once
// A mesh cut into level slices, so that a level plane meets only the faces of one slice. Owns copies; any thread.
#include <vector>

#include "karinui/geometry/mesh.h"
#include "karinui/geometry/section.h"

namespace karinui {

class MeshSlices {
 public:
  MeshSlices(const TriangleMesh& mesh, double low, double high);  // from the lowest y to the highest
  std::vector<SectionLoop> section(double y) const;               // of the level plane

 private:
  static constexpr std::size_t kCount = 96;
  std::size_t number(double y) const;

  double low_, thick_;
  std::vector<TriangleMesh> slice_;
};

// The faces with only the points they use, in the order of first use. `renumbered` is room to work in, one entry for
// each point of the mesh, and is given back as it came: empty before the first call.
TriangleMesh compacted(const TriangleMesh& mesh, std::span<const std::uint32_t> faces,
                       std::vector<std::uint32_t>& renumbered);

}  // namespace karinui
