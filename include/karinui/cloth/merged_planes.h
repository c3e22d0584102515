#pragma once
// The historical collider: adjacent faces of the body whose normals hardly differ are merged into one flat polygon, and
// cloth is tested by segments against polygons. Coarser than the distance field, and it tells how many tests the
// merging saved. Metres. Immutable once built (but for its count of tests); any thread may ask.
#include <atomic>

#include "karinui/cloth/collider.h"
#include "karinui/cloth/settle_report.h"

namespace karinui {

class MergedPlanes : public Collider {
 public:
  struct Settings {
    double angle = 0.12;      // radians a face's normal may differ from its polygon's
    double flatness = 0.001;  // metres a corner may stand off its polygon's plane
    double reach = 0.04;      // metres to both sides a place looks for polygons
  };
  MergedPlanes(BodyPtr body, const Settings& settings);
  explicit MergedPlanes(BodyPtr body) : MergedPlanes(std::move(body), Settings{}) {}

  Sample sample(Vec3 place) const override;
  double clearance(Vec3 place) const override;
  Sample exactSample(Vec3 place) const override;  // by the mesh itself, not by its planes
  Vec3 intersectionNormal(const std::array<Vec3, 3>& face) const override;

  MergeReport report() const;

 private:
  struct Polygon {
    Vec3 centre, normal;                       // its plane, normal out of the body
    std::vector<std::uint32_t> faces;          // of the body's mesh
    std::vector<std::array<Vec3, 2>> outline;  // its boundary's segments, on the plane
  };
  BodyPtr body_;
  Settings settings_;
  std::vector<Polygon> polygons_;
  std::vector<std::vector<std::array<Flat, 2>>> flat_;  // each polygon's outline in its own plane
  std::vector<std::uint32_t> polygonOf_;                // per face
  mutable std::atomic<std::size_t> done_{0}, saved_{0};
};

}  // namespace karinui
