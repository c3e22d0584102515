#pragma once
// A tree of boxes over the faces of a mesh: nearest place, rays, and everything near a box. Built once, then read by
// any number of threads. Keeps its own copy of what it needs; the mesh may go away. Metres.
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "karinui/geometry/mesh.h"

namespace karinui {

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  // What is no number changes nothing. Written out: std::fmin calls the library, and this runs millions of times.
  void include(Vec3 p) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  bool empty() const { return low.x > high.x; }
  Vec3 centre() const { return (low + high) * 0.5; }
  Vec3 size() const { return high - low; }
};
Box boxOf(const std::vector<Vec3>& points);

class Bvh {
 public:
  explicit Bvh(const TriangleMesh& mesh);
  ~Bvh();
  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;

  struct Near {
    SurfacePoint place;
    Vec3 point;
    double distance = 0;  // >= 0
  };
  std::optional<Near> nearest(Vec3 from, double within = std::numeric_limits<double>::infinity()) const;

  struct Hit {
    SurfacePoint place;
    Vec3 point;
    double along = 0;      // distance along the unit direction
    bool outside = false;  // the ray came from the outer side of the face
  };
  std::optional<Hit> first(Vec3 origin, Vec3 unitDirection) const;
  // All faces the ray meets, sorted along it.
  std::vector<Hit> all(Vec3 origin, Vec3 unitDirection) const;

  // Distance with sign: negative inside. The sign comes from the generalized winding number, so small self-crossings
  // and holes do not flip it.
  double signedDistance(Vec3 from) const;
  double windingNumber(Vec3 from) const;  // 1 inside, 0 outside for a clean closed mesh

  // Calls visit(face) for every face whose box touches the box.
  void touching(const Box& box, const std::function<void(std::uint32_t)>& visit) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace karinui
