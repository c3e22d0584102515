#include "karinui/geometry/wrap.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "karinui/geometry/bvh.h"

namespace karinui {
namespace {

constexpr double kMostPoints = 6e6;  // a second or ten of work

struct Grid {
  Vec3 origin;
  double cell = 0;
  std::array<std::size_t, 3> count{};
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * count[1] + j) * count[0] + i; }
  Vec3 place(std::size_t n) const {
    return origin + Vec3{static_cast<double>(n % count[0]), static_cast<double>(n / count[0] % count[1]),
                         static_cast<double>(n / (count[0] * count[1]))} *
                        cell;
  }
};

// Cuts each cell of the grid into six tetrahedra round its diagonal (H. W. Kuhn, 1960): neighbouring cells cut their
// common square the same way, so the surface has no cracks; and a linear function has one clean sheet in a tetrahedron,
// so it has no branching and no crossing either. Source: A. Doi and A. Koide, "An Efficient Method of Triangulating
// Equi-Valued Surfaces by Using Tetrahedral Cells", 1991.
class Skin {
 public:
  Skin(const Grid& grid, const std::vector<float>& value) : grid_(grid), value_(value) {}

  TriangleMesh grow() {
    static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const std::array<std::size_t, 3> step{1, grid_.count[0], grid_.count[0] * grid_.count[1]};
    for (std::size_t k = 0; k + 1 < grid_.count[2]; ++k)
      for (std::size_t j = 0; j + 1 < grid_.count[1]; ++j)
        for (std::size_t i = 0; i + 1 < grid_.count[0]; ++i) {
          const std::size_t base = grid_.index(i, j, k);
          if (oneSided(base, step)) continue;
          for (int o = 0; o < 6; ++o) {
            std::array<std::size_t, 4> corner{base};
            for (int s = 0; s < 3; ++s) corner[s + 1] = corner[s] + step[kOrders[o][s]];
            if (o >= 3) std::swap(corner[2], corner[3]);  // odd orders make the other hand
            cutTetrahedron(corner);
          }
        }
    return std::move(mesh_);
  }

 private:
  bool inside(std::size_t n) const { return value_[n] < 0; }

  bool oneSided(std::size_t base, const std::array<std::size_t, 3>& step) const {
    for (int corner = 1; corner < 8; ++corner) {
      const std::size_t n = base + (corner & 1 ? step[0] : 0) + (corner & 2 ? step[1] : 0) + (corner & 4 ? step[2] : 0);
      if (inside(n) != inside(base)) return false;
    }
    return true;
  }

  std::uint32_t pointBetween(std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] = between_.try_emplace(a * value_.size() + b, mesh_.points.size());
    if (fresh) {
      // Away from the ends, so that no triangle loses its area.
      const double t =
          std::clamp(static_cast<double>(value_[a]) / (static_cast<double>(value_[a]) - value_[b]), 0.05, 0.95);
      mesh_.points.push_back(lerp(grid_.place(a), grid_.place(b), t));
    }
    return it->second;
  }

  // The corners come as a positively turned tetrahedron: seen from the first, the others run clockwise.
  void cutTetrahedron(std::array<std::size_t, 4> c) {
    int within = 0;
    for (std::size_t n : c) within += inside(n);
    if (within == 0 || within == 4) return;
    // Even permutations bring the odd one, or the two inside, to the front.
    const auto turn = [&](int a, int b, int d) {  // a -> b -> d -> a
      const std::size_t keep = c[d];
      c[d] = c[b], c[b] = c[a], c[a] = keep;
    };
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t d) { mesh_.faces.push_back({a, b, d}); };
    if (within == 2) {
      while (!(inside(c[0]) && inside(c[1]))) {
        if (!inside(c[0]))
          turn(0, 1, inside(c[2]) ? 2 : 3);
        else
          turn(1, 2, 3);
      }
      const std::uint32_t p = pointBetween(c[0], c[2]), q = pointBetween(c[0], c[3]), r = pointBetween(c[1], c[3]),
                          s = pointBetween(c[1], c[2]);
      face(p, q, r);
      face(p, r, s);
      return;
    }
    const bool lone = within == 1;  // whether the odd one is the one inside
    for (int tries = 0; inside(c[0]) != lone; ++tries) tries % 2 == 0 ? turn(0, 1, 2) : turn(0, 3, 1);
    const std::uint32_t p = pointBetween(c[0], c[1]), q = pointBetween(c[0], c[2]), r = pointBetween(c[0], c[3]);
    lone ? face(p, q, r) : face(p, r, q);
  }

  const Grid& grid_;
  const std::vector<float>& value_;
  TriangleMesh mesh_;
  std::unordered_map<std::size_t, std::uint32_t> between_;  // only looked up, never walked: its order does not matter
};

}  // namespace

Result<TriangleMesh> wrapped(const TriangleMesh& surface, double cell, Workers& workers, const Token& token) {
  if (surface.faces.empty()) return badInput(say("There is no surface to wrap."));
  Box box;
  for (const Triangle& f : surface.faces)
    for (std::uint32_t i : f) box.include(surface.points[i]);
  const Vec3 extent = box.size() + Vec3{4, 4, 4} * cell;
  const double cells = extent.x * extent.y * extent.z / (cell * cell * cell);
  if (!(cell > 0) || !(cells < kMostPoints))
    return badInput(say("Cells of {0} mm are too small to wrap a surface of this size.", cell * 1e3));
  Grid grid{box.low - Vec3{2, 2, 2} * cell, cell, {}};
  const std::array<double, 3> extents{extent.x, extent.y, extent.z};
  for (int axis = 0; axis < 3; ++axis) grid.count[axis] = static_cast<std::size_t>(std::ceil(extents[axis] / cell)) + 2;

  const Bvh bvh(surface);
  const Message doing = say("Wrapping the surface");
  token.progress(0, doing);
  std::vector<float> value(grid.count[0] * grid.count[1] * grid.count[2]);
  const double farthest = 4 * cell;
  workers.forBlocks(value.size(), 512, [&](std::size_t begin, std::size_t end) {
    if (token.cancelled()) return;
    for (std::size_t n = begin; n < end; ++n) {
      // The distance times how far outside the winding number says we are: on the surface it passes through zero with
      // the distance, and in a hole with the winding number, which is one half on a smooth cap.
      const auto near = bvh.nearest(grid.place(n), farthest);
      const double d = near ? near->distance : farthest;
      const double away = 1 - 2 * bvh.windingNumber(grid.place(n));
      const std::size_t i = n % grid.count[0], j = n / grid.count[0] % grid.count[1],
                        k = n / (grid.count[0] * grid.count[1]);
      const bool border =
          i == 0 || j == 0 || k == 0 || i + 1 == grid.count[0] || j + 1 == grid.count[1] || k + 1 == grid.count[2];
      value[n] = static_cast<float>(border ? farthest : d * std::clamp(away, -1.0, 1.0));
    }
  });
  if (token.cancelled()) return cancelled();
  TriangleMesh skin = Skin(grid, value).grow();
  if (skin.faces.empty()) return badInput(say("The surface encloses nothing, so it cannot be wrapped."));
  token.progress(1, doing);
  return skin;
}

}  // namespace karinui
