#include "karinui/cloth/floor.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kAbove = 0.002, kLayer = 0.004;  // metres: the innermost layer above the floor, and each over the last
constexpr double kUpright = 0.1;                  // length of a unit normal's horizontal part; less: the cloth lies

class Floor : public Collider {
 public:
  explicit Floor(double height) : height_(height) {}
  Sample sample(Vec3 place) const override { return {place.y - height_, {0, 1, 0}}; }
  double clearance(Vec3 place) const override { return place.y - height_; }

 private:
  double height_;
};

std::vector<Vec3> normalsOf(const ClothPiece& piece, const Vec3* position) {
  std::vector<Vec3> normals(piece.lattice->nodes.size());
  for (const Triangle& f : piece.lattice->faces) {
    const Vec3 area = cross(position[f[1]] - position[f[0]], position[f[2]] - position[f[0]]);
    for (const std::uint32_t node : f) normals[node] += area;
  }
  for (Vec3& n : normals)
    if (length(n) > 0) n = normalized(n);
  return normals;
}

}  // namespace

std::unique_ptr<Collider> floorCollider(double height) { return std::make_unique<Floor>(height); }

void layOnFloor(const Cloth& cloth, ClothState& state, double floor) {
  Vec3 middle;
  for (const Vec3& p : state.position) middle += p * (1.0 / static_cast<double>(state.position.size()));
  for (const ClothPiece& piece : cloth.pieces) {
    Vec3* position = state.position.data() + piece.firstNode;
    const std::size_t nodes = piece.lattice->nodes.size();
    const double height = floor + kAbove + kLayer * std::max(0, piece.layer);
    if (!piece.live || std::none_of(position, position + nodes, [&](const Vec3& p) { return p.y < floor; })) continue;
    const std::vector<Vec3> normals = normalsOf(piece, position);
    double facing = 0;  // above 0: its normals point away from the middle of the cloth
    for (std::size_t i = 0; i < nodes; ++i)
      facing += normals[i].x * (position[i].x - middle.x) + normals[i].z * (position[i].z - middle.z);
    for (std::size_t i = 0; i < nodes; ++i) {
      Vec3& p = position[i];
      if (p.y >= height) continue;
      const Vec3 along{normals[i].x, 0, normals[i].z};
      if (const double upright = length(along); upright > kUpright)
        p += along * (std::copysign(height - p.y, facing) / upright);
      p.y = height;
    }
  }
}

}  // namespace karinui
