#include "karinui/geometry/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/bvh_build.h"

namespace karinui {

struct Bvh::Tree : BvhArrays {};

namespace {

// Indices of nodes still to visit. A walk keeps at most one per level.
class Pending {
 public:
  bool empty() const { return size_ == 0; }
  void push(std::uint32_t node) { nodes_[size_++] = node; }
  std::uint32_t pop() { return nodes_[--size_]; }

 private:
  std::array<std::uint32_t, kBvhDeepest + 2> nodes_;
  std::size_t size_ = 0;
};

// How far v lies beyond [low, high].
double beyond(double low, double high, double v) {
  const double below = low - v, above = v - high, most = below > above ? below : above;
  return most > 0 ? most : 0;
}

double squaredDistance(const Box& box, Vec3 p) {
  const double x = beyond(box.low.x, box.high.x, p.x);
  const double y = beyond(box.low.y, box.high.y, p.y);
  const double z = beyond(box.low.z, box.high.z, p.z);
  return x * x + y * y + z * z;
}

Vec3 weighted(const Corners& c, const std::array<double, 3>& w) { return c[0] * w[0] + c[1] * w[1] + c[2] * w[2]; }

// A ray prepared for S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", 2013: turned and sheared
// until it is the z axis, so that neighbouring faces judge their common edge by the very same numbers.
class Ray {
 public:
  Ray(Vec3 origin, Vec3 direction) : origin_(origin), direction_(direction) {
    const std::array<double, 3> d = part(direction);
    axis_ = std::fabs(d[0]) > std::fabs(d[1]) ? (std::fabs(d[0]) > std::fabs(d[2]) ? 0 : 2)
                                              : (std::fabs(d[1]) > std::fabs(d[2]) ? 1 : 2);
    const std::array<double, 3> along{d[(axis_ + 1) % 3], d[(axis_ + 2) % 3], d[axis_]};
    shear_ = {along[0] / along[2], along[1] / along[2], 1 / along[2]};
    inverse_ = {1 / direction.x, 1 / direction.y, 1 / direction.z};
  }

  // Where the ray enters the box, or infinity if not before `limit`. Rounding may only make the box larger.
  double enters(const Box& box, double limit) const {
    double enter = 0, leave = limit;
    slab(box.low.x, box.high.x, origin_.x, inverse_.x, enter, leave);
    slab(box.low.y, box.high.y, origin_.y, inverse_.y, enter, leave);
    slab(box.low.z, box.high.z, origin_.z, inverse_.z, enter, leave);
    return enter <= leave * (1 + 1e-12) ? enter : std::numeric_limits<double>::infinity();
  }

  std::optional<Bvh::Hit> meets(const BvhFace& f) const {
    const std::array<double, 3> a = turned(f.corners[0]), b = turned(f.corners[1]), c = turned(f.corners[2]);
    const double u = c[0] * b[1] - c[1] * b[0], v = a[0] * c[1] - a[1] * c[0], w = b[0] * a[1] - b[1] * a[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
    const double whole = u + v + w;
    if (whole == 0) return std::nullopt;
    Bvh::Hit hit;
    hit.place = {f.face, {u / whole, v / whole, w / whole}};
    hit.along = (u * a[2] + v * b[2] + w * c[2]) / whole * shear_[2];
    if (!(hit.along >= 0)) return std::nullopt;
    hit.point = weighted(f.corners, hit.place.weight);
    hit.outside = dot(cross(f.corners[1] - f.corners[0], f.corners[2] - f.corners[0]), direction_) < 0;
    return hit;
  }

 private:
  static std::array<double, 3> part(Vec3 p) { return {p.x, p.y, p.z}; }
  static void slab(double low, double high, double from, double inverse, double& enter, double& leave) {
    if (std::isinf(inverse)) {  // along the slab: inside it all the way, or never
      if (from < low || from > high) leave = -1;
      return;
    }
    const double t = (low - from) * inverse, s = (high - from) * inverse;
    enter = std::max(enter, std::min(t, s));
    leave = std::min(leave, std::max(t, s));
  }
  std::array<double, 3> turned(Vec3 p) const {
    const std::array<double, 3> d = part(p - origin_);
    const double z = d[axis_];
    return {d[(axis_ + 1) % 3] - shear_[0] * z, d[(axis_ + 2) % 3] - shear_[1] * z, z};
  }

  Vec3 origin_, direction_, inverse_;
  std::array<double, 3> shear_{};
  int axis_ = 2;
};

}  // namespace

Box boxOf(const std::vector<Vec3>& points) {
  Box box;
  for (Vec3 p : points) box.include(p);
  return box;
}

Bvh::Bvh(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>(Tree{buildBvh(mesh)})) {}
Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

std::optional<Bvh::Near> Bvh::nearest(Vec3 from, double within) const {
  const Tree& tree = *tree_;
  if (tree.nodes.empty() || !(within >= 0)) return std::nullopt;
  double bestSquared = within * within;
  const BvhFace* best = nullptr;
  std::array<double, 3> weight{};
  Pending pending;
  std::uint32_t index = 0;
  if (!(squaredDistance(tree.nodes[0].box, from) <= bestSquared)) return std::nullopt;
  for (;;) {
    const BvhNode& node = tree.nodes[index];
    if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        const BvhFace& f = tree.faces[k];
        const std::array<double, 3> w = nearestWeights(f.corners, from);
        const double squared = squaredLength(weighted(f.corners, w) - from);
        if (squared < bestSquared || (squared == bestSquared && !best)) {
          bestSquared = squared;
          best = &f;
          weight = w;
        }
      }
    } else {
      std::uint32_t close = index + 1, far = node.first;
      double closeSquared = squaredDistance(tree.nodes[close].box, from);
      double farSquared = squaredDistance(tree.nodes[far].box, from);
      if (farSquared < closeSquared) std::swap(close, far), std::swap(closeSquared, farSquared);
      if (farSquared <= bestSquared) pending.push(far);
      if (closeSquared <= bestSquared) {
        index = close;
        continue;
      }
    }
    do {
      if (pending.empty()) {
        if (!best) return std::nullopt;
        return Near{{best->face, weight}, weighted(best->corners, weight), std::sqrt(bestSquared)};
      }
      index = pending.pop();
    } while (squaredDistance(tree.nodes[index].box, from) > bestSquared);
  }
}

std::optional<Bvh::Hit> Bvh::first(Vec3 origin, Vec3 unitDirection) const {
  const Tree& tree = *tree_;
  std::optional<Hit> best;
  if (tree.nodes.empty()) return best;
  const Ray ray(origin, unitDirection);
  double limit = std::numeric_limits<double>::max();
  Pending pending;
  pending.push(0);
  while (!pending.empty()) {
    const std::uint32_t index = pending.pop();
    const BvhNode& node = tree.nodes[index];
    if (!(ray.enters(node.box, limit) <= limit)) continue;
    if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        if (const std::optional<Hit> hit = ray.meets(tree.faces[k]); hit && (!best || hit->along < best->along)) {
          best = hit;
          limit = hit->along;
        }
      continue;
    }
    // The nearer child is looked at first, so it is pushed last.
    const std::uint32_t left = index + 1, right = node.first;
    const bool leftFirst = ray.enters(tree.nodes[left].box, limit) <= ray.enters(tree.nodes[right].box, limit);
    pending.push(leftFirst ? right : left);
    pending.push(leftFirst ? left : right);
  }
  return best;
}

std::vector<Bvh::Hit> Bvh::all(Vec3 origin, Vec3 unitDirection) const {
  const Tree& tree = *tree_;
  std::vector<Hit> hits;
  if (tree.nodes.empty()) return hits;
  const Ray ray(origin, unitDirection);
  Pending pending;
  pending.push(0);
  while (!pending.empty()) {
    const std::uint32_t index = pending.pop();
    const BvhNode& node = tree.nodes[index];
    if (ray.enters(node.box, std::numeric_limits<double>::max()) == std::numeric_limits<double>::infinity()) continue;
    if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        if (const std::optional<Hit> hit = ray.meets(tree.faces[k])) hits.push_back(*hit);
      continue;
    }
    pending.push(node.first);
    pending.push(index + 1);
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.along != b.along ? a.along < b.along : a.place.face < b.place.face;
  });
  // A ray through an edge or a corner meets every face there: that is one crossing of the surface, not several.
  const auto same = [](const Hit& a, const Hit& b) {
    return a.outside == b.outside && b.along - a.along <= 1e-12 * (1 + std::fabs(a.along));
  };
  hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  return hits;
}

double Bvh::windingNumber(Vec3 from) const {
  // Source: G. Barill et al., "Fast Winding Numbers for Soups and Clouds", 2018, first order. A node stands for its
  // faces when it is farther than kFar radii.
  constexpr double kFar = 3;
  const Tree& tree = *tree_;
  if (tree.nodes.empty()) return 0;
  double angle = 0;
  Pending pending;
  pending.push(0);
  while (!pending.empty()) {
    const std::uint32_t index = pending.pop();
    const BvhNode& node = tree.nodes[index];
    const BvhDipole& dipole = tree.dipoles[index];
    const Vec3 to = dipole.centre - from;
    const double squared = squaredLength(to);
    if (squared > kFar * kFar * dipole.radius * dipole.radius) {
      angle += dot(dipole.areaNormal, to) / (squared * std::sqrt(squared));
    } else if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        angle += solidAngle(tree.faces[k].corners, from);
    } else {
      pending.push(node.first);
      pending.push(index + 1);
    }
  }
  return angle / (4 * std::numbers::pi);
}

double Bvh::signedDistance(Vec3 from) const {
  const std::optional<Near> near = nearest(from);
  if (!near) return std::numeric_limits<double>::infinity();
  return windingNumber(from) > 0.5 ? -near->distance : near->distance;
}

void Bvh::touching(const Box& box, const std::function<void(std::uint32_t)>& visit) const {
  const Tree& tree = *tree_;
  if (tree.nodes.empty()) return;
  Pending pending;
  pending.push(0);
  while (!pending.empty()) {
    const std::uint32_t index = pending.pop();
    const BvhNode& node = tree.nodes[index];
    if (!meet(node.box, box)) continue;
    if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        Box faceBox;
        for (Vec3 p : tree.faces[k].corners) faceBox.include(p);
        if (meet(faceBox, box)) visit(tree.faces[k].face);
      }
      continue;
    }
    pending.push(node.first);
    pending.push(index + 1);
  }
}

}  // namespace karinui
