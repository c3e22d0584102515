#include "bench/cusick.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace karinui::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUneven = 0.005;  // metres at the rim: how smoothly a hand lays it on
constexpr double kGrain = 0.0005;  // metres: the shadow is counted in squares of it

Result<ClothLevel> discOf(const Fabric& fabric, double spacing, unsigned seed) {
  auto piece = std::make_shared<Piece>();
  piece->id = PieceId{1};
  piece->name = "disc";
  piece->fabric = fabric.name;
  const double bulge = std::tan(kPi / 8);
  const Flat corner[] = {{kDisc, 0}, {0, kDisc}, {-kDisc, 0}, {0, -kDisc}};
  for (int k = 0; k < 4; ++k)
    piece->outline.edges.push_back({"rim" + std::to_string(k), Curve::arc(corner[k], corner[(k + 1) % 4], bulge)});
  Pattern pattern;
  pattern.pieces[piece->id] = piece;
  const auto laid = lay(pattern, spacing);
  if (!laid) return laid.error();
  auto cloth = assemble(pattern, *laid, {{fabric.name, fabric}}, {});
  if (!cloth) return cloth.error();
  ClothLevel level{std::move(*cloth), {}};
  std::minstd_rand random(seed + 1);  // the same numbers everywhere, unlike the library's distributions
  double phase[10];
  for (double& p : phase) p = 2 * kPi * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
  const auto& nodes = level.cloth.pieces[0].lattice->nodes;
  for (std::uint32_t k = 0; k < nodes.size(); ++k) {
    const Flat p = nodes[k];
    const double r = std::hypot(p.u, p.v), turn = std::atan2(p.v, p.u);
    double wave = 0;
    for (int n = 2; n < 10; ++n) wave += std::cos(n * turn + phase[n]) / std::sqrt(8.0);
    const double out = std::fmax(0.0, (r - kSupport) / (kDisc - kSupport));
    level.state.position.push_back({p.u, kUneven * out * out * wave, -p.v});
    // The grid steps along the support's rim; so much wider it holds as much as the disc would.
    if (r < kSupport + 0.25 * spacing) level.cloth.pinned.push_back(k);
  }
  return level;
}

int foldsOf(const ClothLevel& disc) {
  const Lattice& lattice = *disc.cloth.pieces[0].lattice;
  double strongest = 0;
  int folds = 0;
  for (int n = 2; n <= 16; ++n) {
    double c = 0, s = 0;
    for (const std::uint32_t k : lattice.border) {
      const Flat p = lattice.nodes[k];
      const Vec3 x = disc.state.position[k];
      const double turn = std::atan2(p.v, p.u), r = std::hypot(x.x, x.z);
      c += r * std::cos(n * turn), s += r * std::sin(n * turn);
    }
    if (std::hypot(c, s) > strongest) strongest = std::hypot(c, s), folds = n;
  }
  return folds;
}

}  // namespace

double shadowOf(const Cloth& cloth, const ClothState& state) {
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
  for (const Vec3 p : state.position)
    for (int a = 0; a < 2; ++a) {
      low[a] = std::fmin(low[a], a == 0 ? p.x : p.z);
      high[a] = std::fmax(high[a], a == 0 ? p.x : p.z);
    }
  const auto count = [&](int a) { return static_cast<std::size_t>((high[a] - low[a]) / kGrain) + 2; };
  const std::size_t columns = count(0), rows = count(1);
  std::vector<std::uint8_t> dark(columns * rows, 0);
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces) {
      Flat c[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = state.position[piece.firstNode + f[k]];
        c[k] = {(p.x - low[0]) / kGrain, (p.z - low[1]) / kGrain};
      }
      if (cross(c[1] - c[0], c[2] - c[0]) < 0) std::swap(c[1], c[2]);
      const auto [u0, u1] = std::minmax({c[0].u, c[1].u, c[2].u});
      const auto [v0, v1] = std::minmax({c[0].v, c[1].v, c[2].v});
      for (auto j = static_cast<std::size_t>(v0); j <= static_cast<std::size_t>(v1); ++j)
        for (auto i = static_cast<std::size_t>(u0); i <= static_cast<std::size_t>(u1); ++i) {
          const Flat middle{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5};
          bool inside = true;
          for (int k = 0; k < 3; ++k) inside = inside && cross(c[(k + 1) % 3] - c[k], middle - c[k]) >= 0;
          if (inside) dark[j * columns + i] = 1;
        }
    }
  return kGrain * kGrain * static_cast<double>(std::count(dark.begin(), dark.end(), 1));
}

Result<Draped> cusick(const Fabric& fabric, std::size_t vertices, unsigned seed, Workers& workers, const Token& token) {
  if (const auto fine = checkFabric(fabric); !fine) return fine.error();
  const double area = kPi * kDisc * kDisc;
  const double spacing = vertices == 0 ? 0.005 : std::sqrt(area / static_cast<double>(vertices));
  auto level = discOf(fabric, spacing, seed);
  if (!level) return level.error();
  std::vector<ClothLevel> levels{std::move(*level)};
  SettleSettings settings;
  settings.maxSteps = 1200;
  const Capsules nothing({});
  const auto report = settle(levels, nothing, settings, token, workers);
  if (!report) return report.error();
  Draped draped;
  draped.report = *report;
  draped.disc = std::move(levels.back());
  const double support = kPi * kSupport * kSupport;
  draped.coefficient = 100 * (shadowOf(draped.disc.cloth, draped.disc.state) - support) / (area - support);
  draped.folds = foldsOf(draped.disc);
  return draped;
}

}  // namespace karinui::bench
