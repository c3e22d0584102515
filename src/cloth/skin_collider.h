#pragma once
// The skin of a body that moves: a mesh whose points are placed anew again and again, faces being the same. Made ready
// in a few milliseconds, where a distance field takes seconds; so it is what stops the cloth on the body's way from
// pose to pose. Distances are right to a tenth of a millimetre near the skin, for the nearest face is looked for among
// those of the nearest points; beyond kReach it only tells that a place is far. One thread places the points, while
// nobody asks.
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/cloth/collider.h"

namespace karinui {

class SkinCollider : public Collider {
 public:
  SkinCollider(std::vector<Triangle> faces, std::size_t points);
  void moveTo(std::vector<Vec3> points, Workers& workers);
  const std::vector<Vec3>& points() const { return points_; }

  Sample sample(Vec3 place) const override;
  double clearance(Vec3 place) const override;
  std::optional<Sample> sampleWithin(Vec3 place, double within, double& clearance) const override;
  // Known where the tree was built since the points were last placed.
  Vec3 intersectionNormal(const std::array<Vec3, 3>& face) const override;
  void buildTree();

  static constexpr double kReach = 0.02;   // metres
  static constexpr double kAtSkin = 0.01;  // from a point of the skin: the clearance is given as none, without a look

 private:
  static constexpr std::size_t kSides = 6;
  static constexpr double kFace =
      0.008;  // metres that the nearest face's points may lie farther than the nearest point
  // Of the points whose skin looks to each of the six sides of a box, the nearest. In a fold there is skin on both
  // sides of a place, and the nearest point need not be of the nearest face.
  struct Near {
    std::array<std::uint32_t, kSides> point{};
    std::array<double, kSides> squared{};  // of their distances; infinite: none is in reach
    std::size_t first = 0;                 // the side of the nearest of all
    bool found() const { return squared[first] < std::numeric_limits<double>::infinity(); }
  };
  Near nearestPoints(Vec3 place) const;
  Sample sampleAt(const Near& near, Vec3 place) const;
  std::array<std::size_t, 3> cellOf(Vec3 place) const;
  Vec3 normalAt(std::uint32_t point) const;

  std::vector<Triangle> faces_;
  std::vector<std::uint32_t> firstFace_, face_;  // those of each point, one after the other
  std::vector<Vec3> points_, normals_;
  struct Ball {
    Vec3 centre;
    double radius = 0;
  };
  std::vector<Ball> ball_;  // round each face
  struct Tree {
    TriangleMesh mesh;
    Bvh boxes;
  };
  std::optional<Tree> tree_;
  Vec3 low_;
  std::array<std::size_t, 3> count_{};
  struct InCell {
    Vec3 place;
    std::uint32_t point = 0, side = 0;
  };
  std::vector<std::uint32_t> firstPoint_;  // of each cell, among
  std::vector<InCell> inCells_;            // the points, cell by cell
};

}  // namespace karinui
