#include "karinui/geometry/distance_field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "geometry/field_brick.h"
#include "geometry/field_sides.h"

namespace karinui {
namespace {

constexpr std::size_t kStride = 4;     // grid points between two of the coarse grid
constexpr double kMostPoints = 200e6;  // 800 MB: beyond this the cells are too small for the body

double mix(double a, double b, double t) { return a + (b - a) * t; }

// Lower bounds of the distance at the fine points of a brick, from the triangle inequality: the trilinear mean of the
// coarse distances, smooth in space, less the greatest error it can have, which is half the diagonal of a coarse cell
// (the mean distance to its corners is nowhere larger).
class CoarseBound {
 public:
  // `first`: a fine point that is a coarse one too; `distanceAt` tells that of a coarse point.
  template <class DistanceAt>
  CoarseBound(const SpacedGrid& coarse, DistanceAt&& distanceAt, const Count& first)
      : slack_(coarse.step * std::sqrt(3.0) / 2) {
    Count cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = std::min(first[axis] / kStride, coarse.count[axis] - 2);
      from_[axis] = first[axis] - cell[axis] * kStride;
    }
    for (std::size_t k = 0; k < 8; ++k)
      corner_[k] = distanceAt(coarse.index(cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2)));
  }
  double least() const { return *std::min_element(corner_.begin(), corner_.end()) - slack_; }
  // At the fine point so many after the first.
  double at(std::size_t i, std::size_t j, std::size_t k) const {
    const double x = way(i, 0), y = way(j, 1), z = way(k, 2);
    const auto row = [&](std::size_t c) { return mix(corner_[c], corner_[c + 1], x); };
    return mix(mix(row(0), row(2), y), mix(row(4), row(6), y), z) - slack_;
  }

 private:
  double way(std::size_t n, int axis) const { return static_cast<double>(from_[axis] + n) / kStride; }
  std::array<double, 8> corner_;
  Count from_;
  double slack_;
};

// A whole number of coarse cells that covers the extent, at least one.
std::size_t pointsFor(double extent, double cell) {
  return static_cast<std::size_t>(std::fmax(std::ceil(extent / (cell * kStride)), 1)) * kStride + 1;
}

double marginOf(const DistanceField::Settings& settings) { return settings.band + settings.cell; }

Box boxOf(const TriangleMesh& mesh) {
  Box box;
  for (const Triangle& f : mesh.faces)
    for (const std::uint32_t i : f) box.include(mesh.points[i]);
  return box;
}

}  // namespace

Done DistanceField::buildable(const TriangleMesh& mesh, const Settings& settings) {
  if (!(settings.cell > 0) || !(settings.band >= settings.cell))
    return badInput(say("A distance field needs a cell above zero and a band no thinner than a cell."));
  const MeshReport report = inspectTopology(mesh);
  if (report.triangles == 0) return badInput(say("There is no surface to measure distances from."));
  if (report.openEdges > 0)
    return badInput(
        say("The surface is not closed: {0} {0|edge is|edges are} open, so it has no inside.", report.openEdges));
  const Box box = boxOf(mesh);
  if (!finite(box.low) || !finite(box.high)) return badInput(say("The surface has coordinates that are not numbers."));
  const Vec3 extent = box.size() + Vec3{1, 1, 1} * (2 * marginOf(settings));
  const double cells = extent.x * extent.y * extent.z / (settings.cell * settings.cell * settings.cell);
  if (!(cells < kMostPoints))
    return badInput(say("Cells of {0} mm are too small for a surface of this size; use {1} mm or more.",
                        settings.cell * 1e3, std::ceil(settings.cell * std::cbrt(cells / kMostPoints) * 1.1e3)));
  return {};
}

// The grid in bricks of kStride points each way. A brick that is not there yet is made by who asks for it: two threads
// that ask at once both make it, the same bits, and the second one's goes.
class DistanceField::Values {
 public:
  static constexpr std::size_t kPoints = kStride * kStride * kStride;
  using Brick = std::array<float, kPoints>;

  Values(const SpacedGrid& fine, double band, const TriangleMesh& mesh, const Bvh& bvh)
      : grid(fine), band_(band), mesh_(mesh), bvh_(bvh), coarse_{fine.origin, fine.step * kStride, {}} {
    for (int axis = 0; axis < 3; ++axis) coarse_.count[axis] = (grid.count[axis] - 1) / kStride + 1;
    bricks_ = std::vector<std::atomic<const Brick*>>(coarse_.points());
    distance_ = std::vector<std::atomic<double>>(coarse_.points());
    for (auto& known : distance_) known.store(kUnknown, std::memory_order_relaxed);
  }
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;
  ~Values() {
    for (auto& brick : bricks_) delete brick.load(std::memory_order_relaxed);
  }

  // The eight around a cell, x first.
  std::array<double, 8> around(std::size_t i, std::size_t j, std::size_t k) const {
    const std::size_t x = i % kStride, y = j % kStride, z = k % kStride;
    if (x + 1 < kStride && y + 1 < kStride && z + 1 < kStride) {  // all in one brick
      const float* v = brickAt(i, j, k).data() + inBrick(x, y, z);
      constexpr std::size_t row = kStride, sheet = kStride * kStride;
      return {v[0], v[1], v[row], v[row + 1], v[sheet], v[sheet + 1], v[sheet + row], v[sheet + row + 1]};
    }
    return {at(i, j, k),     at(i + 1, j, k),     at(i, j + 1, k),     at(i + 1, j + 1, k),
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1)};
  }

  Done findAll(Workers& workers, const Token& token) const {
    workers.forBlocks(bricks_.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end && !token.cancelled(); ++n)
        if (!bricks_[n].load(std::memory_order_acquire)) made(n);
    });
    return token.cancelled() ? Done(cancelled()) : Done();
  }

  const SpacedGrid grid;

 private:
  static constexpr double kUnknown = -1;
  static std::size_t inBrick(std::size_t x, std::size_t y, std::size_t z) { return (z * kStride + y) * kStride + x; }

  const Brick& brickAt(std::size_t i, std::size_t j, std::size_t k) const {
    const std::size_t n = coarse_.index(i / kStride, j / kStride, k / kStride);
    const Brick* brick = bricks_[n].load(std::memory_order_acquire);
    return brick ? *brick : made(n);
  }
  double at(std::size_t i, std::size_t j, std::size_t k) const {
    return brickAt(i, j, k)[inBrick(i % kStride, j % kStride, k % kStride)];
  }

  const Brick& made(std::size_t n) const {
    auto brick = std::make_unique<Brick>(found(n));
    const Brick* there = nullptr;
    if (!bricks_[n].compare_exchange_strong(there, brick.get(), std::memory_order_acq_rel)) return *there;
    return *brick.release();
  }

  double coarseDistance(std::size_t n) const {
    const double known = distance_[n].load(std::memory_order_relaxed);
    if (known != kUnknown) return known;
    const Count at = coarse_.split(n, 1);
    const double found = bvh_.nearest(coarse_.place(at[0], at[1], at[2]))->distance;
    distance_[n].store(found, std::memory_order_relaxed);
    return found;
  }

  Brick found(std::size_t n) const {
    const Count first = coarse_.split(n, kStride);
    Count count;
    for (int axis = 0; axis < 3; ++axis) count[axis] = std::min(kStride, grid.count[axis] - first[axis]);
    const CoarseBound bound(
        coarse_, [this](std::size_t corner) { return coarseDistance(corner); }, first);
    FieldBrick exact(grid, mesh_, bvh_);
    const bool near = bound.least() <= band_ && exact.take(first, count, band_);
    std::vector<float> distances;
    distances.reserve(kPoints);
    for (std::size_t k = 0; k < count[2]; ++k)
      for (std::size_t j = 0; j < count[1]; ++j)
        for (std::size_t i = 0; i < count[0]; ++i) {
          const double atLeast = bound.at(i, j, k);
          double d = std::fmax(atLeast, band_);
          if (near && atLeast <= band_)
            d = exact.distanceAt(grid.place(first[0] + i, first[1] + j, first[2] + k), band_).value_or(d);
          distances.push_back(static_cast<float>(d));
        }
    const std::vector<std::int8_t> sides = sidesOf(grid, first, count, distances, bvh_);
    Brick brick{};
    std::size_t m = 0;
    for (std::size_t k = 0; k < count[2]; ++k)
      for (std::size_t j = 0; j < count[1]; ++j)
        for (std::size_t i = 0; i < count[0]; ++i, ++m)
          brick[inBrick(i, j, k)] = distances[m] * static_cast<float>(sides[m]);
    return brick;
  }

  const double band_;
  const TriangleMesh& mesh_;
  const Bvh& bvh_;
  SpacedGrid coarse_;
  mutable std::vector<std::atomic<const Brick*>> bricks_;  // by their first points
  mutable std::vector<std::atomic<double>> distance_;      // of these points to the mesh
};

DistanceField::DistanceField(double cell, std::unique_ptr<Values> values) : cell_(cell), values_(std::move(values)) {}
DistanceField::DistanceField(DistanceField&&) noexcept = default;
DistanceField::~DistanceField() = default;

Result<DistanceField> DistanceField::of(const TriangleMesh& mesh, const Bvh& bvh, const Settings& settings) {
  if (const Done possible = buildable(mesh, settings); !possible) return possible.error();
  const Box box = boxOf(mesh);
  const double margin = marginOf(settings);
  const Vec3 extent = box.size() + Vec3{1, 1, 1} * (2 * margin);
  const SpacedGrid grid{
      box.low - Vec3{1, 1, 1} * margin,
      settings.cell,
      {pointsFor(extent.x, settings.cell), pointsFor(extent.y, settings.cell), pointsFor(extent.z, settings.cell)}};
  return DistanceField(settings.cell, std::make_unique<Values>(grid, settings.band, mesh, bvh));
}

Done DistanceField::findAll(Workers& workers, const Token& token) const { return values_->findAll(workers, token); }

// The cell a place lies in, or the nearest one: its eight values, x first, and where in it.
struct DistanceField::Cell {
  std::array<double, 8> value;
  std::array<double, 3> at;
  Vec3 outside;  // metres beyond the grid
};

DistanceField::Cell DistanceField::cellOf(Vec3 place) const {
  const SpacedGrid& grid = values_->grid;
  const std::array<double, 3> from{(place.x - grid.origin.x) / cell_, (place.y - grid.origin.y) / cell_,
                                   (place.z - grid.origin.z) / cell_};
  std::array<std::size_t, 3> c;
  std::array<double, 3> outside;
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(grid.count[axis] - 1);
    const double inside = std::fmin(std::fmax(from[axis], 0), last);  // not a number: 0
    outside[axis] = (from[axis] - inside) * cell_;
    c[axis] = std::min(static_cast<std::size_t>(inside), grid.count[axis] - 2);
    cell.at[axis] = inside - static_cast<double>(c[axis]);
  }
  cell.outside = {outside[0], outside[1], outside[2]};
  cell.value = values_->around(c[0], c[1], c[2]);
  return cell;
}

// A place outside the grid is judged from the nearest place of the grid's box. The box is convex and holds the mesh,
// so the way from there to the mesh and the way to the box are at a right angle or wider: the root is a lower bound.
DistanceField::Sample DistanceField::sample(Vec3 place) const {
  const auto& [v, f, off] = cellOf(place);
  const double x00 = mix(v[0], v[1], f[0]), x10 = mix(v[2], v[3], f[0]);
  const double x01 = mix(v[4], v[5], f[0]), x11 = mix(v[6], v[7], f[0]);
  const double y0 = mix(x00, x10, f[1]), y1 = mix(x01, x11, f[1]);
  Sample s;
  s.distance = mix(y0, y1, f[2]);
  s.gradient = {mix(mix(v[1] - v[0], v[3] - v[2], f[1]), mix(v[5] - v[4], v[7] - v[6], f[1]), f[2]) / cell_,
                mix(x10 - x00, x11 - x01, f[2]) / cell_, (y1 - y0) / cell_};
  if (off == Vec3{}) return s;
  // Where the place is beyond the box along an axis, moving along it does not move the place it is judged from.
  const double atBox = s.distance;
  const Vec3 along{off.x == 0 ? s.gradient.x : 0, off.y == 0 ? s.gradient.y : 0, off.z == 0 ? s.gradient.z : 0};
  s.distance = std::sqrt(squaredLength(off) + atBox * atBox);
  s.gradient = (off + along * atBox) * (1 / s.distance);
  return s;
}

double DistanceField::distance(Vec3 place) const {
  const auto& [v, f, off] = cellOf(place);
  const double y0 = mix(mix(v[0], v[1], f[0]), mix(v[2], v[3], f[0]), f[1]);
  const double y1 = mix(mix(v[4], v[5], f[0]), mix(v[6], v[7], f[0]), f[1]);
  const double inGrid = mix(y0, y1, f[2]);
  return off == Vec3{} ? inGrid : std::sqrt(squaredLength(off) + inGrid * inGrid);
}

}  // namespace karinui
