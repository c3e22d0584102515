#include "cloth/skin_collider.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth/closest_points.h"

namespace karinui {

SkinCollider::SkinCollider(std::vector<Triangle> faces, std::size_t points)
    : faces_(std::move(faces)), firstFace_(points + 1, 0) {
  for (const Triangle& f : faces_)
    for (const std::uint32_t p : f) ++firstFace_[p + 1];
  for (std::size_t p = 0; p < points; ++p) firstFace_[p + 1] += firstFace_[p];
  face_.resize(3 * faces_.size());
  std::vector<std::uint32_t> next(firstFace_.begin(), firstFace_.end() - 1);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (const std::uint32_t p : faces_[f]) face_[next[p]++] = f;
}

std::array<std::size_t, 3> SkinCollider::cellOf(Vec3 place) const {
  const Vec3 in = (place - low_) * (1 / kReach);
  return {static_cast<std::size_t>(in.x), static_cast<std::size_t>(in.y), static_cast<std::size_t>(in.z)};
}

void SkinCollider::moveTo(std::vector<Vec3> points) {
  points_ = std::move(points);
  normals_ = pointNormals({points_, faces_});
  const Box box = boxOf(points_);
  low_ = box.low - Vec3{1, 1, 1} * (2 * kReach);  // every place within reach has all cells around it
  const auto high = cellOf(box.high);
  count_ = {high[0] + 3, high[1] + 3, high[2] + 3};
  firstPoint_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
  const auto number = [&](Vec3 p) {
    const auto c = cellOf(p);
    return (c[0] * count_[1] + c[1]) * count_[2] + c[2];
  };
  for (const Vec3& p : points_) ++firstPoint_[number(p) + 1];
  for (std::size_t c = 1; c < firstPoint_.size(); ++c) firstPoint_[c] += firstPoint_[c - 1];
  point_.resize(points_.size());
  std::vector<std::uint32_t> next(firstPoint_.begin(), firstPoint_.end() - 1);
  for (std::uint32_t p = 0; p < points_.size(); ++p) point_[next[number(points_[p])]++] = p;
}

Collider::Sample SkinCollider::sample(Vec3 place) const {
  const Sample far{kReach, {0, 1, 0}};
  const Vec3 in = (place - low_) * (1 / kReach);
  const auto outside = [](double at, std::size_t count) { return !(at >= 1 && at < static_cast<double>(count) - 1); };
  if (outside(in.x, count_[0]) || outside(in.y, count_[1]) || outside(in.z, count_[2])) return far;
  const auto cell = cellOf(place);
  std::uint32_t nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t x = cell[0] - 1; x <= cell[0] + 1; ++x)
    for (std::size_t y = cell[1] - 1; y <= cell[1] + 1; ++y) {
      const std::size_t row = (x * count_[1] + y) * count_[2] + cell[2];
      for (std::uint32_t k = firstPoint_[row - 1]; k < firstPoint_[row + 2]; ++k)
        if (const double d = squaredLength(points_[point_[k]] - place); d < best) best = d, nearest = point_[k];
    }
  if (!std::isfinite(best)) return far;
  best = std::numeric_limits<double>::infinity();
  Sample found = far;
  for (std::uint32_t k = firstFace_[nearest]; k < firstFace_[nearest + 1]; ++k) {
    const Triangle& f = faces_[face_[k]];
    const auto w = closestOnTriangle(place, points_[f[0]], points_[f[1]], points_[f[2]]);
    const Vec3 off = place - (points_[f[0]] * w[0] + points_[f[1]] * w[1] + points_[f[2]] * w[2]);
    const double d = squaredLength(off);
    if (!(d < best)) continue;
    best = d;
    found.normal = normalized(normals_[f[0]] * w[0] + normals_[f[1]] * w[1] + normals_[f[2]] * w[2]);
    found.distance = std::copysign(std::sqrt(d), dot(off, found.normal));
  }
  return found;
}

double SkinCollider::clearance(Vec3 place) const { return std::fmin(kReach, sample(place).distance); }

}  // namespace karinui
