#pragma once
// Exact distances to a mesh at the points of a grid that lie close to it, a box of them at a time: the faces that can
// be nearest to any of them are looked up in the tree once, and of those a point asks only the few that come near
// enough. One thread at a time.
#include <optional>
#include <vector>

#include "geometry/spaced_grid.h"
#include "geometry/triangle.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

class FieldBrick {
 public:
  // All must outlive this.
  FieldBrick(const SpacedGrid& grid, const TriangleMesh& mesh, const Bvh& bvh) : grid_(grid), mesh_(mesh), bvh_(bvh) {}
  // Takes up the faces near the points from `first` on, `count` of them each way; whether any lies within `band` of
  // one.
  bool take(const Count& first, const Count& count, double band);
  // The distance where it is at most `band`.
  std::optional<double> distanceAt(Vec3 place, double band);

 private:
  // What is known of faces before they are asked exactly: the plane each lies in and a circle around it there. Places
  // are from a middle nearby, so that floats tell micrometres.
  struct Circles {
    std::vector<float> x, y, z, nx, ny, nz, radius;  // middle, normal
    void clear() {
      for (auto* values : {&x, &y, &z, &nx, &ny, &nz, &radius}) values->clear();
    }
    void add(Vec3 middle, Vec3 normal, double r) {
      x.push_back(static_cast<float>(middle.x));
      y.push_back(static_cast<float>(middle.y));
      z.push_back(static_cast<float>(middle.z));
      nx.push_back(static_cast<float>(normal.x));
      ny.push_back(static_cast<float>(normal.y));
      nz.push_back(static_cast<float>(normal.z));
      radius.push_back(static_cast<float>(r));
    }
  };

  const SpacedGrid& grid_;
  const TriangleMesh& mesh_;
  const Bvh& bvh_;
  Vec3 middle_;
  std::vector<Corners> faces_;
  Circles circles_;
  std::vector<float> room_;
  std::size_t last_ = 0;
};

}  // namespace karinui
