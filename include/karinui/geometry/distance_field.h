#pragma once
// The signed distance to a closed mesh on a grid of cells: what cloth asks thousands of times a step. Negative inside.
// Exact (from the mesh) at grid points within `band` of the surface, a lower bound of the distance beyond. Trilinear
// between. Immutable after build; any number of threads may read.
#include <span>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

class DistanceField {
 public:
  struct Settings {
    double cell = 0.005;  // metres
    double band = 0.03;   // metres around the surface where the distance is exact
  };
  // Refuses a surface that is empty, open or not finite, and cells too small for its size.
  static Done buildable(const TriangleMesh& mesh, const Settings& settings);
  // Keeps nothing of mesh and tree. Refuses what is not buildable.
  static Result<DistanceField> build(const TriangleMesh& mesh, const Bvh& bvh, const Settings& settings,
                                     Workers& workers, const Token& token);

  struct Sample {
    double distance = 0;  // metres; outside the grid a lower bound
    Vec3 gradient;        // of the trilinear function; about unit length near the surface
  };
  Sample sample(Vec3 place) const;
  double distance(Vec3 place) const;
  double cell() const { return cell_; }

 private:
  struct Cell;
  Cell cellOf(Vec3 place) const;
  double cell_ = 0;
  Vec3 origin_;
  std::array<std::size_t, 3> count_{};
  std::vector<float> value_;
};

}  // namespace karinui
