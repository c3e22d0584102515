#include "karinui/geometry/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/field_brick.h"
#include "geometry/field_sides.h"

namespace karinui {
namespace {

constexpr std::size_t kStride = 4;     // grid points between two of the coarse grid
constexpr double kMostPoints = 200e6;  // 800 MB: beyond this the cells are too small for the body

double mix(double a, double b, double t) { return a + (b - a) * t; }

double distanceToFace(const Corners& c, Vec3 place) {
  const auto w = nearestWeights(c, place);
  return distance(c[0] * w[0] + c[1] * w[1] + c[2] * w[2], place);
}

// Distances to the mesh at all points of a coarse grid. Along a row the face nearest to the last point bounds this
// one's distance, which keeps the search in the tree short. A row is one block, so the outcome does not depend on the
// threads.
std::vector<double> coarseDistances(const SpacedGrid& grid, const TriangleMesh& mesh, const Bvh& bvh, Workers& workers,
                                    const Token& token) {
  std::vector<double> distances(grid.points(), 0.0);
  workers.forBlocks(grid.count[1] * grid.count[2], 1, [&](std::size_t row, std::size_t) {
    if (token.cancelled()) return;
    const std::size_t j = row % grid.count[1], k = row / grid.count[1];
    double within = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grid.count[0]; ++i) {
      const auto near = bvh.nearest(grid.place(i, j, k), within);
      distances[grid.index(i, j, k)] = near->distance;
      // A nanometre more, so that a grid point on the face itself finds it.
      within = distanceToFace(cornersOf(mesh, mesh.faces[near->place.face]), grid.place(i + 1, j, k)) + 1e-9;
    }
  });
  return distances;
}

// Lower bounds of the distance at the fine points of a brick, from the triangle inequality: the trilinear mean of the
// coarse distances, smooth in space, less the greatest error it can have, which is half the diagonal of a coarse cell
// (the mean distance to its corners is nowhere larger).
class CoarseBound {
 public:
  // `first`: a fine point that is a coarse one too.
  CoarseBound(const SpacedGrid& coarse, const std::vector<double>& distances, const Count& first)
      : slack_(coarse.step * std::sqrt(3.0) / 2) {
    Count cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = std::min(first[axis] / kStride, coarse.count[axis] - 2);
      from_[axis] = first[axis] - cell[axis] * kStride;
    }
    for (std::size_t k = 0; k < 8; ++k)
      corner_[k] = distances[coarse.index(cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2))];
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

Result<DistanceField> DistanceField::build(const TriangleMesh& mesh, const Bvh& bvh, const Settings& settings,
                                           Workers& workers, const Token& token) {
  if (const Done possible = buildable(mesh, settings); !possible) return possible.error();
  const Box box = boxOf(mesh);
  const double margin = marginOf(settings);
  const Vec3 extent = box.size() + Vec3{1, 1, 1} * (2 * margin);
  SpacedGrid grid{
      box.low - Vec3{1, 1, 1} * margin,
      settings.cell,
      {pointsFor(extent.x, settings.cell), pointsFor(extent.y, settings.cell), pointsFor(extent.z, settings.cell)}};
  SpacedGrid coarse{grid.origin, grid.step * kStride, {}};
  for (int axis = 0; axis < 3; ++axis) coarse.count[axis] = (grid.count[axis] - 1) / kStride + 1;

  const Message doing = say("Measuring the space around the body");
  token.progress(0, doing);
  const std::vector<double> coarseDistance = coarseDistances(coarse, mesh, bvh, workers, token);
  token.progress(0.2, doing);

  DistanceField field;
  field.cell_ = grid.step;
  field.origin_ = grid.origin;
  field.count_ = grid.count;
  field.value_.assign(grid.points(), 0.0f);
  workers.forBlocks(coarse.points(), 16, [&](std::size_t begin, std::size_t end) {
    FieldBrick brick(grid, mesh, bvh);
    for (std::size_t n = begin; n < end && !token.cancelled(); ++n) {
      const Count first = coarse.split(n, kStride);
      Count count;
      for (int axis = 0; axis < 3; ++axis) count[axis] = std::min(kStride, grid.count[axis] - first[axis]);
      const CoarseBound bound(coarse, coarseDistance, first);
      const bool near = bound.least() <= settings.band && brick.take(first, count, settings.band);
      for (std::size_t k = 0; k < count[2]; ++k)
        for (std::size_t j = 0; j < count[1]; ++j)
          for (std::size_t i = 0; i < count[0]; ++i) {
            const Count at{first[0] + i, first[1] + j, first[2] + k};
            const double atLeast = bound.at(i, j, k);
            double d = std::fmax(atLeast, settings.band);
            if (near && atLeast <= settings.band)
              d = brick.distanceAt(grid.place(at[0], at[1], at[2]), settings.band).value_or(d);
            field.value_[grid.index(at[0], at[1], at[2])] = static_cast<float>(d);
          }
    }
  });
  token.progress(0.8, doing);
  const std::vector<std::int8_t> sides = sidesOf(grid, field.value_, bvh, token);
  if (token.cancelled()) return cancelled();
  for (std::size_t n = 0; n < sides.size(); ++n) field.value_[n] *= sides[n];
  token.progress(1, doing);
  return field;
}

// The cell a place lies in, or the nearest one: its eight values, x first, and where in it.
struct DistanceField::Cell {
  std::array<double, 8> value;
  std::array<double, 3> at;
  Vec3 outside;  // metres beyond the grid
};

DistanceField::Cell DistanceField::cellOf(Vec3 place) const {
  const std::array<double, 3> from{(place.x - origin_.x) / cell_, (place.y - origin_.y) / cell_,
                                   (place.z - origin_.z) / cell_};
  std::array<std::size_t, 3> c;
  std::array<double, 3> outside;
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(count_[axis] - 1);
    const double inside = std::fmin(std::fmax(from[axis], 0), last);  // not a number: 0
    outside[axis] = (from[axis] - inside) * cell_;
    c[axis] = std::min(static_cast<std::size_t>(inside), count_[axis] - 2);
    cell.at[axis] = inside - static_cast<double>(c[axis]);
  }
  cell.outside = {outside[0], outside[1], outside[2]};
  const std::size_t nx = count_[0], nxy = nx * count_[1];
  const float* v = &value_[c[2] * nxy + c[1] * nx + c[0]];
  cell.value = {v[0], v[1], v[nx], v[nx + 1], v[nxy], v[nxy + 1], v[nxy + nx], v[nxy + nx + 1]};
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
  const double inSpacedGrid = mix(y0, y1, f[2]);
  return off == Vec3{} ? inSpacedGrid : std::sqrt(squaredLength(off) + inSpacedGrid * inSpacedGrid);
}

}  // namespace karinui
