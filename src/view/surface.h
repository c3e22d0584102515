#pragma once
// What the graphics memory is given of a mesh: checked, with smooth normals and the depth of its folds.
#include <cstdint>
#include <vector>

#include "karinui/scene/scene_frame.h"

namespace karinui {

struct SurfaceVertex {
  float place[3];   // relative to the scene's origin
  float normal[3];  // unit, angle-weighted
  float colour[3];  // linear
  float flat[2];    // metres on paper
  float cavity;     // > 0 in a hollow, < 0 on a ridge, about [-1, 1]
  float strain;     // < 0: none known
};

struct Surface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> corners;  // three a face
  std::size_t leftOut = 0;             // faces that could not be drawn
};

// Adds a mesh to the surface. `flat` and `strain` may be empty or of a wrong length: then they are not used.
void addMesh(Surface& surface, const TriangleMesh& mesh, Vec3 origin, const Colour& colour,
             const std::vector<Flat>& flat = {}, const std::vector<float>& strain = {});

// A mesh that is shown again and again while other things move: normals and folds are worked out when it is another
// one. `roughly`: of one whose points have moved the folds stay as they were, and normals are found quickly.
class KeptMesh {
 public:
  void add(Surface& surface, const TriangleMesh& mesh, Vec3 origin, const Colour& colour, bool roughly = false);

 private:
  TriangleMesh mesh_;
  Colour colour_{};
  bool rough_ = false;
  Surface own_;  // about the mesh's own origin
};

// The edge of cloth as thick as it is: bands along its outlines, on its inner side.
void addEdges(Surface& surface, const SceneCloth& cloth, Vec3 origin);

// Adds a round floor, finest in the middle where the shadows are.
void addFloor(Surface& surface, Vec3 centre, double radius);

}  // namespace karinui
