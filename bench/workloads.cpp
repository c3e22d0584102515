#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/workload.h"

namespace karinui::bench {
namespace {

struct Panel {  // nx x ny cells; not quite square ones where the scene says so, by a fifth of a percent at most
  std::uint32_t nx = 0, ny = 0;
  double width = 0, height = 0;
  std::uint32_t node(std::uint32_t i, std::uint32_t j) const { return j * (nx + 1) + i; }
};

std::shared_ptr<const Lattice> latticeOf(const Panel& panel) {
  auto lattice = std::make_shared<Lattice>();
  const double hx = panel.width / panel.nx, hy = panel.height / panel.ny;
  lattice->spacing = std::sqrt(hx * hy);
  lattice->columns = panel.nx + 1;
  lattice->rows = panel.ny + 1;
  for (std::uint32_t j = 0; j <= panel.ny; ++j)
    for (std::uint32_t i = 0; i <= panel.nx; ++i) {
      lattice->grid.push_back(panel.node(i, j));
      lattice->nodes.push_back({i * hx, j * hy});
    }
  for (std::uint32_t j = 0; j < panel.ny; ++j)
    for (std::uint32_t i = 0; i < panel.nx; ++i) {
      lattice->cell.push_back(1);
      const std::uint32_t a = panel.node(i, j), c = panel.node(i + 1, j), d = panel.node(i + 1, j + 1),
                          e = panel.node(i, j + 1);
      const bool odd = (i + j) % 2 == 1;
      lattice->faces.push_back(odd ? Triangle{a, c, d} : Triangle{a, c, e});
      lattice->faces.push_back(odd ? Triangle{a, d, e} : Triangle{c, d, e});
    }
  for (std::uint32_t i = 0; i < panel.nx; ++i) lattice->border.push_back(panel.node(i, 0));
  for (std::uint32_t j = 0; j < panel.ny; ++j) lattice->border.push_back(panel.node(panel.nx, j));
  for (std::uint32_t i = panel.nx; i > 0; --i) lattice->border.push_back(panel.node(i, panel.ny));
  for (std::uint32_t j = panel.ny; j > 0; --j) lattice->border.push_back(panel.node(0, j));
  return lattice;
}

Fabric clothOfTheScenes() {
  Fabric f;
  f.name = "bench";
  f.weight = 0.15;
  f.stretchWarp = f.stretchWeft = 1000;
  f.shear = 40;
  f.bendWarp = f.bendWeft = 1e-5;
  f.compression = 0.05;
  f.frictionBody = f.frictionCloth = 0.3;
  return f;
}

// One panel or several alike, each standing as `where` says.
ClothLevel panels(const Panel& panel, int count, const std::function<Vec3(int, Flat)>& where) {
  ClothLevel level;
  const auto lattice = latticeOf(panel);
  level.cloth.spacing = lattice->spacing;
  for (int p = 0; p < count; ++p) {
    level.cloth.pieces.push_back({PieceId{static_cast<std::uint64_t>(p) + 1}, p == 0 ? "front" : "back", lattice,
                                  clothOfTheScenes(), level.cloth.nodeCount, 0, true});
    level.cloth.nodeCount += static_cast<std::uint32_t>(lattice->nodes.size());
    for (Flat place : lattice->nodes) level.state.position.push_back(where(p, place));
  }
  return level;
}

constexpr int kCoarser[] = {4, 2, 1};

std::uint32_t cells(std::uint32_t defined, double scale, int coarser) {
  const double fine = std::fmax(4.0 * coarser, std::round(defined * scale));
  return static_cast<std::uint32_t>(std::ceil(fine / coarser));
}

double scaleTo(std::size_t vertices, double defined) {
  return vertices == 0 ? 1 : std::sqrt(static_cast<double>(vertices) / defined);
}

ClothLevel tunicLevel(const Panel& panel) {
  ClothLevel level = panels(panel, 2, [](int side, Flat p) {
    return Vec3{-0.3 + p.u, -0.43 + p.v, side == 0 ? 0.26 : -0.26};
  });
  const std::uint32_t back = level.cloth.pieces[1].firstNode;
  const auto tie = [&](std::uint32_t i, std::uint32_t j, std::uint32_t seam) {
    level.cloth.ties.push_back({panel.node(i, j), back + panel.node(i, j), kNoNode, seam});
  };
  for (std::uint64_t s = 1; s <= 4; ++s) level.cloth.seams.push_back(SeamId{s});
  const std::uint32_t rows = panel.ny * 59 / 83, columns = panel.nx * 21 / 71;  // of a side seam, of a shoulder
  for (std::uint32_t j = 0; j <= rows; ++j) {
    tie(0, j, 0);
    tie(panel.nx, j, 1);
  }
  for (std::uint32_t i = 0; i <= columns; ++i) {
    tie(i, panel.ny, 2);
    tie(panel.nx - i, panel.ny, 3);
  }
  return level;
}

}  // namespace

Collider::Sample Capsules::sample(Vec3 p) const {
  Sample nearest{1e9, {0, 1, 0}};
  for (const Capsule& c : capsules_) {
    const Vec3 axis = c.b - c.a;
    const double l2 = squaredLength(axis);
    const double t = l2 > 0 ? std::clamp(dot(p - c.a, axis) / l2, 0.0, 1.0) : 0;
    const Vec3 out = p - (c.a + axis * t);
    const double away = length(out), d = away - c.radius;
    if (d < nearest.distance) nearest = {d, away > 0 ? out * (1 / away) : Vec3{0, 1, 0}};
  }
  return nearest;
}

Workload curtain(std::size_t vertices) {
  Workload load{"w1", {}, std::make_unique<Capsules>(std::vector<Capsules::Capsule>{}), nullptr};
  for (const int coarser : kCoarser) {
    const std::uint32_t n = cells(100, scaleTo(vertices, 10201), coarser);
    load.levels.push_back(panels({n, n, 1, 1}, 1, [](int, Flat p) { return Vec3{p.u - 0.5, 1, p.v}; }));
    load.levels.back().cloth.pinned = {0, n};
  }
  return load;
}

Workload sphere(std::size_t vertices) {
  Workload load{"w2", {}, std::make_unique<Capsules>(std::vector<Capsules::Capsule>{{{}, {}, 0.3}}), nullptr};
  for (const int coarser : kCoarser) {
    const std::uint32_t n = cells(100, scaleTo(vertices, 10201), coarser);
    load.levels.push_back(panels({n, n, 1, 1}, 1, [](int, Flat p) { return Vec3{p.u - 0.5, 0.35, p.v - 0.5}; }));
  }
  return load;
}

Workload tunic(std::size_t vertices) {
  Workload load{"w3",
                {},
                std::make_unique<Capsules>(std::vector<Capsules::Capsule>{{{0, -0.16, 0}, {0, 0.16, 0}, 0.14},
                                                                          {{0.10, 0.18, 0}, {0.50, 0.18, 0}, 0.05},
                                                                          {{-0.10, 0.18, 0}, {-0.50, 0.18, 0}, 0.05}}),
                nullptr};
  const double scale = scaleTo(vertices, 12096);
  for (const int coarser : kCoarser)
    load.levels.push_back(tunicLevel({cells(71, scale, coarser), cells(83, scale, coarser), 0.6, 0.7}));
  return load;
}

}  // namespace karinui::bench
