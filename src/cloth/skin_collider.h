#pragma once
// The skin of a body that moves: a mesh whose points are placed anew again and again, faces being the same. Made ready
// in a few milliseconds, where a distance field takes seconds; so it is what stops the cloth on the body's way from
// pose to pose. Distances are exact within kReach of the skin; farther off it only tells that it is far. One thread
// places the points, while nobody asks.
#include <span>
#include <vector>

#include "karinui/cloth/collider.h"

namespace karinui {

class SkinCollider : public Collider {
 public:
  SkinCollider(std::vector<Triangle> faces, std::size_t points);
  void moveTo(std::vector<Vec3> points);
  const std::vector<Vec3>& points() const { return points_; }

  Sample sample(Vec3 place) const override;
  double clearance(Vec3 place) const override;

  static constexpr double kReach = 0.02;  // metres

 private:
  std::array<std::size_t, 3> cellOf(Vec3 place) const;

  std::vector<Triangle> faces_;
  std::vector<std::uint32_t> firstFace_, face_;  // those of each point, one after the other
  std::vector<Vec3> points_, normals_;
  Vec3 low_;
  std::array<std::size_t, 3> count_{};
  std::vector<std::uint32_t> firstPoint_, point_;  // those in each cell
};

}  // namespace karinui
