#include "karinui/geometry/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/triangle.h"
#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr std::size_t kStride = 4;     // grid points between two of the coarse grid
constexpr double kMostPoints = 200e6;  // 800 MB: beyond this the cells are too small for the body
constexpr std::int8_t kUnknown = 0;
constexpr std::uint32_t kNoFace = ~0u;

using Count = std::array<std::size_t, 3>;

// A box of evenly spaced points, numbered x first.
struct Grid {
  Vec3 origin;
  double step = 0;
  Count count{};
  std::size_t points() const { return count[0] * count[1] * count[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * count[1] + j) * count[0] + i; }
  Count split(std::size_t n, std::size_t times) const {  // an index into its three, so many times
    return {n % count[0] * times, n / count[0] % count[1] * times, n / (count[0] * count[1]) * times};
  }
  Vec3 place(std::size_t i, std::size_t j, std::size_t k) const {
    return {origin.x + step * static_cast<double>(i), origin.y + step * static_cast<double>(j),
            origin.z + step * static_cast<double>(k)};
  }
};

double mix(double a, double b, double t) { return a + (b - a) * t; }

Corners cornersOf(const TriangleMesh& mesh, std::uint32_t face) {
  const Triangle& f = mesh.faces[face];
  return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

double distanceToFace(const Corners& c, Vec3 place) {
  const auto w = nearestWeights(c, place);
  return distance(c[0] * w[0] + c[1] * w[1] + c[2] * w[2], place);
}

// Distances to the mesh at all points of a coarse grid. Along a row the face nearest to the last point bounds this
// one's distance, which keeps the search in the tree short. A row is one block, so the outcome does not depend on the
// threads.
std::vector<double> coarseDistances(const Grid& grid, const TriangleMesh& mesh, const Bvh& bvh, Workers& workers,
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
      within = distanceToFace(cornersOf(mesh, near->place.face), grid.place(i + 1, j, k)) + 1e-9;
    }
  });
  return distances;
}

// What is known of faces before they are asked exactly: the plane each lies in and a circle around it there. Places are
// from a middle nearby, so that floats tell micrometres.
struct Circles {
  std::vector<float> x, y, z, nx, ny, nz, radius;  // middle, normal
  void clear() {
    for (auto* values : {&x, &y, &z, &nx, &ny, &nz, &radius}) values->clear();
  }
  void add(Vec3 middle, Vec3 normal, double r) {
    x.push_back(static_cast<float>(middle.x));
    y.push_back(static_cast<float>(middle.y));
    z.push_back(static_cast<float>(middle.z));
    nx.push_back(static_cast<float>(normal.x));
    ny.push_back(static_cast<float>(normal.y));
    nz.push_back(static_cast<float>(normal.z));
    radius.push_back(static_cast<float>(r));
  }
};

// By how much each circle comes within `reach` of (x, y, z), as a difference of squares: below zero it does not.
KARINUI_WIDE void comeNear(std::size_t count, const float* __restrict cx, const float* __restrict cy,
                           const float* __restrict cz, const float* __restrict nx, const float* __restrict ny,
                           const float* __restrict nz, const float* __restrict radius, float x, float y, float z,
                           float reach, float* __restrict room) {
  KARINUI_APART
  for (std::size_t k = 0; k < count; ++k) {
    const float a = x - cx[k], b = y - cy[k], c = z - cz[k];
    const float above = a * nx[k] + b * ny[k] + c * nz[k], left = reach * reach - above * above;
    const float beside = std::sqrt(left > 0 ? left : 0) + radius[k];
    room[k] = left < 0 ? left : beside * beside - (a * a + b * b + c * c - above * above);
  }
}

// The points between two of the coarse grid each way are measured together: the faces that can be nearest to any of
// them are looked up in the tree once, and of those a point asks only the few whose circles come near enough.
class Brick {
 public:
  Brick(const Grid& grid, const TriangleMesh& mesh, const Bvh& bvh) : grid_(grid), mesh_(mesh), bvh_(bvh) {}

  // Takes up the faces near the points from `first` on, `count` of them each way; whether any lies within `band` of
  // one.
  bool take(const Count& first, const Count& count, double band) {
    faces_.clear();
    circles_.clear();
    const Vec3 low = grid_.place(first[0], first[1], first[2]);
    const Vec3 high = grid_.place(first[0] + count[0] - 1, first[1] + count[1] - 1, first[2] + count[2] - 1);
    middle_ = (low + high) * 0.5;
    const double half = distance(middle_, high);
    const auto near = bvh_.nearest(middle_, band + half);
    if (!near) return false;
    const double reach = std::fmin(near->distance + 2 * half, band + half) + kRounding;
    const Vec3 around{reach, reach, reach};
    bvh_.touching({middle_ - around, middle_ + around}, [&](std::uint32_t face) {
      const Corners c = cornersOf(mesh_, face);
      const Vec3 centre = (c[0] + c[1] + c[2]) * (1.0 / 3);
      double radius = 0;
      for (Vec3 corner : c) radius = std::fmax(radius, distance(corner, centre));
      if (distance(centre, middle_) - radius > reach) return;
      faces_.push_back(c);
      circles_.add(centre - middle_, normalized(cross(c[1] - c[0], c[2] - c[0])), radius + kRounding);
    });
    last_ = 0;
    return !faces_.empty();
  }

  // The distance where it is at most `band`.
  std::optional<double> distanceAt(Vec3 place, double band) {
    double best = band * band;
    bool found = false;
    const auto ask = [&](std::size_t k) {
      const Corners& c = faces_[k];
      const auto w = nearestWeights(c, place);
      const double squared = squaredLength(c[0] * w[0] + c[1] * w[1] + c[2] * w[2] - place);
      if (squared > best) return;
      best = squared;
      found = true;
      last_ = k;
    };
    ask(last_);  // what was nearest to the last point
    const Vec3 from = place - middle_;
    room_.resize(faces_.size());
    comeNear(faces_.size(), circles_.x.data(), circles_.y.data(), circles_.z.data(), circles_.nx.data(),
             circles_.ny.data(), circles_.nz.data(), circles_.radius.data(), static_cast<float>(from.x),
             static_cast<float>(from.y), static_cast<float>(from.z), static_cast<float>(std::sqrt(best) + kRounding),
             room_.data());
    for (std::size_t k = 0; k < room_.size(); ++k)
      if (!(room_[k] < 0)) ask(k);
    return found ? std::optional(std::sqrt(best)) : std::nullopt;
  }

 private:
  static constexpr double kRounding = 1e-6;  // metres, more than floats lose on a body
  const Grid& grid_;
  const TriangleMesh& mesh_;
  const Bvh& bvh_;
  Vec3 middle_;
  std::vector<Corners> faces_;
  Circles circles_;
  std::vector<float> room_;
  std::size_t last_ = 0;
};

// Lower bounds of the distance at the fine points of a brick, from the triangle inequality: the trilinear mean of the
// coarse distances, smooth in space, less the greatest error it can have, which is half the diagonal of a coarse cell
// (the mean distance to its corners is nowhere larger).
class CoarseBound {
 public:
  // `first`: a fine point that is a coarse one too.
  CoarseBound(const Grid& coarse, const std::vector<double>& distances, const Count& first)
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

// Between two grid points whose distances sum to more than their spacing the surface cannot pass, so both lie on the
// same side. One winding number therefore settles a whole region.
class SideFinder {
 public:
  SideFinder(const Grid& grid, const std::vector<float>& distance, const Bvh& bvh)
      : grid_(grid), distance_(distance), bvh_(bvh), sides_(distance.size(), kUnknown) {}

  std::vector<std::int8_t> find(const Token& token) {
    std::size_t n = 0;
    for (std::size_t k = 0; k < grid_.count[2]; ++k) {
      if (token.cancelled()) break;
      for (std::size_t j = 0; j < grid_.count[1]; ++j)
        for (std::size_t i = 0; i < grid_.count[0]; ++i, ++n) {
          if (sides_[n] != kUnknown) continue;
          sides_[n] = bvh_.windingNumber(grid_.place(i, j, k)) > 0.5 ? -1 : 1;
          spread(n);
        }
    }
    return std::move(sides_);
  }

 private:
  void spread(std::size_t seed) {
    const std::size_t nx = grid_.count[0], nxy = nx * grid_.count[1];
    std::vector<std::size_t> pending{seed};
    while (!pending.empty()) {
      const std::size_t n = pending.back();
      pending.pop_back();
      const auto pass = [&](bool there, std::size_t next) {
        if (!there || sides_[next] != kUnknown) return;
        if (distance_[n] + distance_[next] <= grid_.step * (1 + 1e-5)) return;
        sides_[next] = sides_[n];
        pending.push_back(next);
      };
      const std::size_t i = n % nx, j = n / nx % grid_.count[1], k = n / nxy;
      pass(i > 0, n - 1);
      pass(i + 1 < nx, n + 1);
      pass(j > 0, n - nx);
      pass(j + 1 < grid_.count[1], n + nx);
      pass(k > 0, n - nxy);
      pass(k + 1 < grid_.count[2], n + nxy);
    }
  }

  const Grid& grid_;
  const std::vector<float>& distance_;
  const Bvh& bvh_;
  std::vector<std::int8_t> sides_;
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
    return badInput(say("The surface is not closed: {0} edges are open, so it has no inside.", report.openEdges));
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
  Grid grid{
      box.low - Vec3{1, 1, 1} * margin,
      settings.cell,
      {pointsFor(extent.x, settings.cell), pointsFor(extent.y, settings.cell), pointsFor(extent.z, settings.cell)}};
  Grid coarse{grid.origin, grid.step * kStride, {}};
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
    Brick brick(grid, mesh, bvh);
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
  const std::vector<std::int8_t> sides = SideFinder(grid, field.value_, bvh).find(token);
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
  const double inGrid = mix(y0, y1, f[2]);
  return off == Vec3{} ? inGrid : std::sqrt(squaredLength(off) + inGrid * inGrid);
}

}  // namespace karinui
