#include "cloth/skin_collider.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth/closest_points.h"
#include "cloth/mesh_distance.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kRounding = 1e-9;  // metres: more than a distance is wrong by

double squareOf(double x) { return x * x; }

// Which of the six sides of a box a direction looks to.
std::uint32_t sideOf(Vec3 v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  if (x >= y && x >= z) return v.x < 0 ? 1 : 0;
  if (y >= z) return v.y < 0 ? 3 : 2;
  return v.z < 0 ? 5 : 4;
}

}  // namespace

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

void SkinCollider::buildTree() {
  tree_.reset();
  const TriangleMesh mesh{points_, faces_};
  tree_.emplace(Tree{mesh, Bvh(mesh)});
}

Vec3 SkinCollider::intersectionNormal(const std::array<Vec3, 3>& face) const {
  return tree_ ? intersectionNormalOf(tree_->mesh, tree_->boxes, face) : Vec3{};
}

std::array<std::size_t, 3> SkinCollider::cellOf(Vec3 place) const {
  const Vec3 in = (place - low_) * (1 / kReach);
  return {static_cast<std::size_t>(in.x), static_cast<std::size_t>(in.y), static_cast<std::size_t>(in.z)};
}

void SkinCollider::moveTo(std::vector<Vec3> points, Workers& workers) {
  points_ = std::move(points);
  tree_.reset();
  normals_.resize(points_.size());
  workers.forBlocks(points_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) normals_[p] = normalAt(static_cast<std::uint32_t>(p));
  });
  ball_.resize(faces_.size());
  workers.forBlocks(faces_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 a = points_[faces_[f][0]], b = points_[faces_[f][1]], c = points_[faces_[f][2]];
      const Vec3 centre = (a + b + c) * (1.0 / 3);
      const double squared =
          std::fmax(squaredLength(a - centre), std::fmax(squaredLength(b - centre), squaredLength(c - centre)));
      ball_[f] = {centre, std::sqrt(squared) + kRounding};
    }
  });
  const Box box = boxOf(points_);
  low_ = box.low - Vec3{1, 1, 1} * (2 * kReach);  // every place within reach has all cells around it
  const auto high = cellOf(box.high);
  count_ = {high[0] + 3, high[1] + 3, high[2] + 3};
  firstPoint_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
  std::vector<std::uint32_t> cell(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const auto c = cellOf(points_[p]);
    cell[p] = static_cast<std::uint32_t>((c[0] * count_[1] + c[1]) * count_[2] + c[2]);
    ++firstPoint_[cell[p] + 1];
  }
  for (std::size_t c = 1; c < firstPoint_.size(); ++c) firstPoint_[c] += firstPoint_[c - 1];
  inCells_.resize(points_.size());
  std::vector<std::uint32_t> next(firstPoint_.begin(), firstPoint_.end() - 1);
  for (std::uint32_t p = 0; p < points_.size(); ++p) inCells_[next[cell[p]]++] = {points_[p], p, sideOf(normals_[p])};
}

// The mean of the normals of its faces, weighted as is exact on a sphere (Max, Weights for Computing Vertex Normals
// from Facet Normals, 1999): no angle and no root.
Vec3 SkinCollider::normalAt(std::uint32_t point) const {
  Vec3 normal;
  for (std::uint32_t k = firstFace_[point]; k < firstFace_[point + 1]; ++k) {
    const Triangle& f = faces_[face_[k]];
    const int own = f[0] == point ? 0 : f[1] == point ? 1 : 2;
    const Vec3 a = points_[f[(own + 1) % 3]] - points_[point], b = points_[f[(own + 2) % 3]] - points_[point];
    const double both = squaredLength(a) * squaredLength(b);
    if (both > 0) normal += cross(a, b) * (1 / both);
  }
  return normalized(normal);
}

SkinCollider::Near SkinCollider::nearestPoints(Vec3 place) const {
  Near near;
  near.squared.fill(std::numeric_limits<double>::infinity());
  const Vec3 in = (place - low_) * (1 / kReach);
  const auto outside = [](double at, std::size_t count) { return !(at >= 1 && at < static_cast<double>(count) - 1); };
  if (outside(in.x, count_[0]) || outside(in.y, count_[1]) || outside(in.z, count_[2])) return near;
  const auto cell = cellOf(place);
  const auto before = [](double at, std::size_t own) { return (at - static_cast<double>(own)) * kReach; };
  const double x0 = before(in.x, cell[0]), y0 = before(in.y, cell[1]);
  // How far the columns of cells are: those before, its own, those after.
  const std::array<double, 3> xAway{x0, 0, kReach - x0}, yAway{y0, 0, kReach - y0};
  constexpr std::array<std::array<std::size_t, 2>, 9> kOwnFirst{
      {{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 0}, {0, 2}, {2, 0}, {2, 2}}};
  double enough = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : kOwnFirst) {
    if (!(xAway[x] * xAway[x] + yAway[y] * yAway[y] < enough)) continue;
    const std::size_t column = ((cell[0] + x - 1) * count_[1] + cell[1] + y - 1) * count_[2] + cell[2];
    for (std::uint32_t k = firstPoint_[column - 1]; k < firstPoint_[column + 2]; ++k) {
      const InCell& own = inCells_[k];
      if (const double d = squaredLength(own.place - place); d < near.squared[own.side])
        near.squared[own.side] = d, near.point[own.side] = own.point;
    }
    near.first =
        static_cast<std::size_t>(std::min_element(near.squared.begin(), near.squared.end()) - near.squared.begin());
    enough = squareOf(std::sqrt(near.squared[near.first]) + kFace);
  }
  return near;
}

Collider::Sample SkinCollider::sample(Vec3 place) const { return sampleAt(nearestPoints(place), place); }

Collider::Sample SkinCollider::sampleAt(const Near& near, Vec3 place) const {
  double best = std::numeric_limits<double>::infinity(), length = best;  // `best`: its square
  Vec3 normal, way;
  std::uint32_t looked = std::numeric_limits<std::uint32_t>::max();  // the point whose faces were looked at first
  const auto look = [&](std::uint32_t point) {
    for (std::uint32_t k = firstFace_[point]; k < firstFace_[point + 1]; ++k) {
      const Triangle& f = faces_[face_[k]];
      const Ball& ball = ball_[face_[k]];
      if (f[0] == looked || f[1] == looked || f[2] == looked) continue;
      if (squaredLength(place - ball.centre) > squareOf(length + ball.radius)) continue;
      const auto w = closestOnTriangle(place, points_[f[0]], points_[f[1]], points_[f[2]]);
      const Vec3 off = place - (points_[f[0]] * w[0] + points_[f[1]] * w[1] + points_[f[2]] * w[2]);
      const double d = squaredLength(off);
      if (!(d < best)) continue;
      best = d, length = std::sqrt(d);
      way = off;
      normal = normals_[f[0]] * w[0] + normals_[f[1]] * w[1] + normals_[f[2]] * w[2];
    }
  };
  if (near.found()) look(near.point[near.first]), looked = near.point[near.first];
  for (std::size_t side = 0; side < kSides; ++side)
    if (side != near.first && near.squared[side] < squareOf(length + kFace)) look(near.point[side]);
  if (!std::isfinite(best)) return {kReach, {0, 1, 0}};
  normal = normalized(normal);
  return {std::copysign(std::sqrt(best), dot(way, normal)), normal};
}

// A place at the skin is sampled anyway, so its clearance is given as none. The nearest points are looked for once.
std::optional<Collider::Sample> SkinCollider::sampleWithin(Vec3 place, double within, double& clearance) const {
  const Near near = nearestPoints(place);
  if (near.found() && near.squared[near.first] < kAtSkin * kAtSkin) {
    clearance = 0;
    return clearance < within ? std::optional(sampleAt(near, place)) : std::nullopt;
  }
  const Sample sample = sampleAt(near, place);
  clearance = std::fmin(kReach, sample.distance);
  return clearance < within ? std::optional(sample) : std::nullopt;
}

double SkinCollider::clearance(Vec3 place) const {
  double clear = 0;
  sampleWithin(place, 0, clear);
  return clear;
}

}  // namespace karinui
