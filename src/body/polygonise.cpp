#include "body/polygonise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace karinui {

namespace {

constexpr int kCorners = 8;

// Corner c of a cell stands at (c & 1, c >> 1 & 1, c >> 2 & 1).
bool inOnePiece(unsigned corners) {
  if (corners == 0) return true;
  unsigned reached = corners & (~corners + 1);
  for (int round = 0; round < kCorners; ++round)
    for (int c = 0; c < kCorners; ++c)
      if (reached >> c & 1)
        for (int axis = 0; axis < 3; ++axis) reached |= corners & (1u << (c ^ (1 << axis)));
  return reached == corners;
}

// Both sides (left and right) of the whole grid, mirror image included.
class Whole {
 public:
  explicit Whole(const FieldGrid& half)
      : cell_(half.cell),
        mirrored_(half.mirrored),
        nx_(half.mirrored ? 2 * half.nx : half.nx),
        ny_(half.ny),
        nz_(half.nz),
        low_{(half.mirrored ? 0.5 - static_cast<double>(half.nx) : 0.5) * half.cell, half.lowY, half.lowZ},
        value_(nx_ * ny_ * nz_) {
    for (std::size_t x = 0; x < nx_; ++x) {
      const std::size_t from = !mirrored_ ? x : x < half.nx ? half.nx - 1 - x : x - half.nx;
      std::copy_n(half.value.begin() + static_cast<std::ptrdiff_t>(half.index(from, 0, 0)), ny_ * nz_,
                  value_.begin() + static_cast<std::ptrdiff_t>(index(x, 0, 0)));
    }
  }

  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return (x * ny_ + y) * nz_ + z; }
  std::size_t nx() const { return nx_; }
  std::size_t ny() const { return ny_; }
  std::size_t nz() const { return nz_; }
  float value(std::size_t i) const { return value_[i]; }
  std::size_t corner(std::size_t cellIndex, int c) const {
    return cellIndex + (c & 1) * ny_ * nz_ + (c >> 1 & 1) * nz_ + (c >> 2 & 1);
  }
  Vec3 world(Vec3 p) const { return low_ + p * cell_; }  // p in cells

  struct Cell {
    std::array<std::size_t, 3> at;
    std::size_t index;
    unsigned inside;  // a bit for each corner
  };
  // The cells the surface passes through, in the grid's order.
  std::vector<Cell> crossed() const {
    std::vector<Cell> out;
    std::vector<std::uint8_t> rows(nz_);  // of four rows of corners, which are inside
    for (std::size_t x = 0; x + 1 < nx_; ++x)
      for (std::size_t y = 0; y + 1 < ny_; ++y) {
        const std::size_t first = index(x, y, 0);
        const float *a = &value_[first], *b = &value_[corner(first, 1)], *c = &value_[corner(first, 2)],
                    *d = &value_[corner(first, 3)];
        for (std::size_t z = 0; z < nz_; ++z)
          rows[z] = static_cast<std::uint8_t>((a[z] < 0) | (b[z] < 0) << 1 | (c[z] < 0) << 2 | (d[z] < 0) << 3);
        for (std::size_t z = 0; z + 1 < nz_; ++z)
          if (const unsigned bits = rows[z] | unsigned{rows[z + 1]} << 4; bits != 0 && bits != 255)
            out.push_back({{x, y, z}, first + z, bits});
      }
    return out;
  }

  // Fills the nearest outer corner of every cell in which inside or outside falls apart, until there is none.
  void fillAwkwardCells() {
    std::array<bool, 256> good{};
    for (unsigned bits = 0; bits < 256; ++bits) good[bits] = inOnePiece(bits) && inOnePiece(~bits & 255u);
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::size_t> fill;
      for (const Cell& cell : crossed()) {
        if (good[cell.inside]) continue;
        std::size_t nearest = 0;
        float least = 1e9f;
        for (int c = 0; c < kCorners; ++c)
          if (const std::size_t i = corner(cell.index, c); !(cell.inside >> c & 1) && value_[i] < least)
            least = value_[i], nearest = i;
        fill.push_back(nearest);
      }
      for (const std::size_t i : fill) {
        const std::size_t x = i / (ny_ * nz_);
        for (const std::size_t at : {i, mirrored_ ? i + (nx_ - 1 - 2 * x) * ny_ * nz_ : i})  // on both sides alike
          if (value_[at] >= 0) value_[at] = -1e-4f, changed = true;
      }
    }
  }

  // Value and slope (per cell) of the trilinear function; p in cells.
  double sample(Vec3 p, Vec3& slope) const {
    const auto split = [](double v, std::size_t n, std::size_t& whole) {
      v = std::clamp(v, 0.0, static_cast<double>(n) - 1.001);
      whole = static_cast<std::size_t>(v);
      return v - static_cast<double>(whole);
    };
    std::size_t x, y, z;
    const double fx = split(p.x, nx_, x), fy = split(p.y, ny_, y), fz = split(p.z, nz_, z);
    double c[kCorners];
    const std::size_t i = index(x, y, z);
    for (int k = 0; k < kCorners; ++k) c[k] = value_[corner(i, k)];
    const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
    const double x00 = mix(c[0], c[1], fx), x10 = mix(c[2], c[3], fx), x01 = mix(c[4], c[5], fx),
                 x11 = mix(c[6], c[7], fx);
    slope.x = mix(mix(c[1] - c[0], c[3] - c[2], fy), mix(c[5] - c[4], c[7] - c[6], fy), fz);
    slope.y = mix(x10 - x00, x11 - x01, fz);
    slope.z = mix(x01, x11, fy) - mix(x00, x10, fy);
    return mix(mix(x00, x10, fy), mix(x01, x11, fy), fz);
  }

 private:
  double cell_;
  bool mirrored_;
  std::size_t nx_, ny_, nz_;
  Vec3 low_;
  std::vector<float> value_;
};

Vec3 crossingMean(const Whole& grid, std::size_t cell, Vec3 at) {
  Vec3 sum;
  int count = 0;
  for (int a = 0; a < kCorners; ++a)
    for (int axis = 0; axis < 3; ++axis) {
      const int b = a | 1 << axis;
      if (b == a) continue;
      const double va = grid.value(grid.corner(cell, a)), vb = grid.value(grid.corner(cell, b));
      if ((va < 0) == (vb < 0)) continue;
      Vec3 p{double(a & 1), double(a >> 1 & 1), double(a >> 2 & 1)};
      (axis == 0 ? p.x : axis == 1 ? p.y : p.z) += va / (va - vb);
      sum += p;
      ++count;
    }
  return at + sum * (1.0 / count);
}

Vec3 ontoSurface(const Whole& grid, Vec3 p) {
  for (int step = 0; step < 2; ++step) {
    Vec3 slope;
    const double d = grid.sample(p, slope);
    Vec3 move = slope * (-d / std::max(squaredLength(slope), 1e-12));
    const double far = length(move);
    if (far > 0.5) move *= 0.5 / far;
    p += move;
  }
  return p;
}

using Quad = std::array<std::uint32_t, 4>;

void relax(const Whole& grid, std::vector<Vec3>& points, const std::vector<Quad>& quads, int rounds, Workers& workers) {
  // Neighbours along the quads' sides; every side belongs to two quads and is met once in each direction.
  std::vector<std::uint32_t> start(points.size() + 1, 0), next;
  for (const Quad& q : quads)
    for (int i = 0; i < 4; ++i) ++start[q[i] + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  next.resize(start.back());
  std::vector<std::uint32_t> filled(start.begin(), start.end() - 1);
  for (const Quad& q : quads)
    for (int i = 0; i < 4; ++i) next[filled[q[i]]++] = q[(i + 1) % 4];
  const auto each = [&](const auto& work) {
    workers.forBlocks(points.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  };
  each([&](std::size_t i) { points[i] = ontoSurface(grid, points[i]); });
  std::vector<Vec3> moved(points.size());
  for (int round = 0; round < rounds; ++round) {
    each([&](std::size_t i) {
      Vec3 mean;
      for (std::uint32_t n = start[i]; n < start[i + 1]; ++n) mean += points[next[n]];
      Vec3 step = mean * (1.0 / (start[i + 1] - start[i])) - points[i];
      Vec3 slope;
      grid.sample(points[i], slope);
      const Vec3 normal = normalized(slope);
      step -= normal * dot(step, normal);
      moved[i] = ontoSurface(grid, points[i] + step * 0.5);
    });
    std::swap(points, moved);
  }
}

}  // namespace

TriangleMesh polygonise(const FieldGrid& half, int rounds, Workers& workers) {
  Whole grid(half);
  grid.fillAwkwardCells();
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> pointOf(grid.nx() * grid.ny() * grid.nz(), kNone);
  std::vector<Vec3> points;
  const auto crossed = grid.crossed();
  for (const auto& [at, i, inside] : crossed) {
    pointOf[i] = static_cast<std::uint32_t>(points.size());
    points.push_back(crossingMean(grid, i, Vec3{double(at[0]), double(at[1]), double(at[2])}));
  }
  const std::array<std::size_t, 3> stride{grid.ny() * grid.nz(), grid.nz(), 1};
  std::vector<Quad> quads;
  for (const auto& [at, i, inside] : crossed)
    for (int axis = 0; axis < 3; ++axis) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      if (at[b] == 0 || at[c] == 0) continue;
      const bool here = inside & 1, there = inside >> (1 << axis) & 1;
      if (here == there) continue;
      Quad q{pointOf[i - stride[b] - stride[c]], pointOf[i - stride[c]], pointOf[i], pointOf[i - stride[b]]};
      if (!here) std::swap(q[1], q[3]);
      quads.push_back(q);
    }
  relax(grid, points, quads, rounds, workers);
  TriangleMesh mesh;
  mesh.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points[i] = grid.world(points[i]);
  const auto& p = mesh.points;
  for (const Quad& q : quads) {
    // The shorter diagonal; on a tie the one that keeps left and right alike does not matter.
    if (squaredLength(p[q[0]] - p[q[2]]) <= squaredLength(p[q[1]] - p[q[3]])) {
      mesh.faces.push_back({q[0], q[1], q[2]});
      mesh.faces.push_back({q[0], q[2], q[3]});
    } else {
      mesh.faces.push_back({q[0], q[1], q[3]});
      mesh.faces.push_back({q[1], q[2], q[3]});
    }
  }
  return mesh;
}

}  // namespace karinui
