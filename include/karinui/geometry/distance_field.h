#pragma once
// The signed distance to a closed mesh on a grid of cells: what cloth asks thousands of times a step. Negative inside.
// Exact (from the mesh) at grid points within `band` of the surface, a lower bound of the distance beyond. Trilinear
// between. Values are found when they are first asked for, some 64 together: cloth asks about few places of the room
// around a body. Who asks first, and from which thread, makes no difference to any bit. Any number of threads may ask.
#include <memory>

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
  // Mesh and tree must outlive it and stay where they are. Refuses what is not buildable.
  static Result<DistanceField> of(const TriangleMesh& mesh, const Bvh& bvh, const Settings& settings);
  // Finds all values at once, with a team of threads. An error only when cancelled.
  Done findAll(Workers& workers, const Token& token) const;
  DistanceField(DistanceField&&) noexcept;
  ~DistanceField();

  struct Sample {
    double distance = 0;  // metres; outside the grid a lower bound
    Vec3 gradient;        // of the trilinear function; about unit length near the surface
  };
  Sample sample(Vec3 place) const;
  double distance(Vec3 place) const;
  double cell() const { return cell_; }

 private:
  class Values;
  struct Cell;
  DistanceField(double cell, std::unique_ptr<Values> values);
  Cell cellOf(Vec3 place) const;
  double cell_ = 0;
  std::unique_ptr<Values> values_;
};

}  // namespace karinui
