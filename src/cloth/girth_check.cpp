#include "karinui/cloth/girth_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "karinui/geometry/section.h"

namespace karinui {
namespace {

constexpr double kStep = 0.02;       // metres between levels
constexpr double kMostShift = 0.12;  // up or down; a multiple of kStep
constexpr double kTrunk = 0.2;       // metres: what a level cuts farther than this from the middle is an arm
constexpr double kUnderArmpit = 0.03;
constexpr double kMostStrain = 0.5;  // of bias cloth, which gives way until its threads meet

struct Girth {  // of the body at a level
  double length = 0;
  std::vector<Vec3> middles;  // of the trunk, or of both legs
};
std::optional<Girth> girthAt(const Body& body, double height) {
  const Vec3 up{0, 1, 0};
  Girth girth;
  std::vector<Vec3> points;
  for (const SectionLoop& loop : section(body.mesh(), {{0, height, 0}, up})) {
    const Vec3 middle =
        std::accumulate(loop.points.begin(), loop.points.end(), Vec3{}) * (1 / static_cast<double>(loop.points.size()));
    if (!(std::fabs(middle.x) < kTrunk)) continue;
    girth.middles.push_back(middle);
    points.insert(points.end(), loop.points.begin(), loop.points.end());
  }
  if (points.size() < 3) return std::nullopt;
  girth.length = tightTapeLength(points, up);
  return girth;
}

// Beyond the widest that a tape found, a hand lies against the hip or an arm has grown to the trunk.
double mostGirth(const Measurements& measured) {
  double most = 0;
  for (const char* key : {"bust_girth", "waist_girth", "hip_girth"})
    if (const auto at = measured.value.find(key); at != measured.value.end()) most = std::fmax(most, at->second);
  return 1.03 * most;
}

// Nodes that are sewn together are one. Of a pair sewn to one point all three are: gathers are not followed.
std::vector<std::uint32_t> sewnTogether(const Cloth& cloth) {
  std::vector<std::uint32_t> parent(cloth.nodeCount);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    parent[root(tie.b)] = root(tie.a);
    if (tie.c != kNoNode) parent[root(tie.c)] = root(tie.a);
  }
  for (std::uint32_t k = 0; k < parent.size(); ++k) parent[k] = root(k);
  return parent;
}

// The strain of cloth pulled by `tension` (N/m) along a direction on paper. Of small strains the moduli of a woven
// sheet turn as 1/E = cos4/E1 + sin4/E2 + sin2 cos2/G, sin and cos to the angle with the weft.
double strainUnder(const Fabric& fabric, const Lattice& lattice, Flat direction, double tension) {
  if (fabric.law == Fabric::Law::Simcloth) return tension / fabric.stretchWarp;
  const double c = dot(direction, lattice.weft), s = dot(direction, lattice.warp), cc = c * c, ss = s * s;
  const double shear = fabric.shear > 0 ? tension / fabric.shear : kMostStrain;
  return std::fmin(kMostStrain, cc * cc * fabric.weftCurve().strainAt(tension) +
                                    ss * ss * fabric.warpCurve().strainAt(tension) + cc * ss * shear);
}

using Place = std::pair<std::uint32_t, std::uint32_t>;  // between two nodes
struct Cut {                                            // of a face by a level
  std::array<Place, 2> end;
  std::array<Vec3, 2> at;  // where those stand
  double length = 0, stretched = 0;
};

class Levels {
 public:
  Levels(const Cloth& cloth, const ClothState& state)
      : cloth_(cloth), one_(sewnTogether(cloth)), place_(cloth.nodeCount) {
    std::vector<double> count(cloth.nodeCount, 0);
    for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) {
      place_[one_[k]] += state.position[k];
      ++count[one_[k]];
    }
    for (std::uint32_t k = 0; k < cloth.nodeCount; ++k)
      if (count[k] > 0) place_[k] = place_[k] * (1 / count[k]);
  }
  // The shortest loop round all of `middles` at a height.
  std::optional<GirthLoop> loopAt(double height, const std::vector<Vec3>& middles, double tension) const {
    std::vector<Cut> cuts = cutsAt(height, tension);
    std::map<Place, std::vector<std::size_t>> meeting;
    for (std::size_t k = 0; k < cuts.size(); ++k)
      for (const Place& end : cuts[k].end) meeting[end].push_back(k);
    std::optional<GirthLoop> shortest;
    std::vector<std::uint8_t> used(cuts.size(), 0);
    for (std::size_t first = 0; first < cuts.size(); ++first) {
      GirthLoop loop;
      std::vector<double> turned(middles.size(), 0);
      std::size_t at = first;
      int from = 0;
      bool closed = false;
      while (!used[at]) {
        used[at] = 1;
        const Cut& cut = cuts[at];
        loop.garment += cut.length;
        loop.stretched += cut.stretched;
        for (std::size_t m = 0; m < middles.size(); ++m) {
          const Vec3 a = cut.at[from] - middles[m], b = cut.at[1 - from] - middles[m];
          turned[m] += std::atan2(a.z * b.x - a.x * b.z, a.x * b.x + a.z * b.z);
        }
        const Place& end = cut.end[1 - from];
        const std::vector<std::size_t>& there = meeting[end];
        if (there.size() != 2) break;  // an open edge, or more than two layers sewn together
        at = there[0] == at ? there[1] : there[0];
        from = cuts[at].end[0] == end ? 0 : 1;
        closed = at == first;
      }
      const bool round =
          std::all_of(turned.begin(), turned.end(), [](double angle) { return std::fabs(angle) > std::numbers::pi; });
      if (closed && round && (!shortest || loop.stretched < shortest->stretched)) shortest = loop;
    }
    return shortest;
  }

 private:
  std::vector<Cut> cutsAt(double height, double tension) const {
    std::vector<Cut> cuts;
    for (const ClothPiece& piece : cloth_.pieces) {
      const Lattice& lattice = *piece.lattice;
      for (const Triangle& face : lattice.faces) {
        Cut cut;
        std::array<Flat, 2> paper;
        int ends = 0;
        for (int k = 0; k < 3 && ends < 2; ++k) {
          const std::uint32_t i = face[k], j = face[(k + 1) % 3];
          const std::uint32_t a = one_[piece.firstNode + i], b = one_[piece.firstNode + j];
          const double ya = place_[a].y - height, yb = place_[b].y - height;
          if (a == b || (ya < 0) == (yb < 0)) continue;
          const double share = ya / (ya - yb);
          cut.end[ends] = std::minmax(a, b);
          cut.at[ends] = place_[a] + (place_[b] - place_[a]) * share;
          paper[ends++] = lattice.nodes[i] + (lattice.nodes[j] - lattice.nodes[i]) * share;
        }
        if (ends < 2) continue;
        cut.length = distance(paper[0], paper[1]);
        const Flat way = cut.length > 0 ? (paper[1] - paper[0]) * (1 / cut.length) : lattice.weft;
        cut.stretched = cut.length * (1 + strainUnder(piece.fabric, lattice, way, tension));
        cuts.push_back(cut);
      }
    }
    return cuts;
  }

  const Cloth& cloth_;
  std::vector<std::uint32_t> one_;
  std::vector<Vec3> place_;  // of sewn nodes their middle
};

}  // namespace

std::optional<GirthLoop> tightestLoop(const Cloth& cloth, const ClothState& state, const Body& body) {
  const auto& measured = body.measured().value;
  const auto knee = measured.find("knee_height"), armpit = measured.find("armpit_height");
  if (knee == measured.end() || armpit == measured.end() || !cloth.pinned.empty()) return std::nullopt;
  const auto count = static_cast<int>((armpit->second - kUnderArmpit - knee->second) / kStep);
  std::vector<std::optional<Girth>> girths;
  for (int k = 0; k <= count; ++k) {
    girths.push_back(girthAt(body, knee->second + k * kStep));
    if (girths.back() && girths.back()->length > mostGirth(body.measured())) girths.back().reset();
  }
  const Levels levels(cloth, state);
  std::vector<std::optional<GirthLoop>> loops(girths.size());
  for (std::size_t k = 0; k < girths.size(); ++k)
    if (girths[k])
      loops[k] = levels.loopAt(knee->second + static_cast<double>(k) * kStep, girths[k]->middles,
                               kMostPressure * girths[k]->length / (2 * std::numbers::pi));
  std::optional<GirthLoop> best;
  const int most = static_cast<int>(std::lround(kMostShift / kStep));
  for (int n = 0; n <= 2 * most; ++n) {  // 0, 1, -1, 2, -2 …: of equal ones the least moved
    const int shift = n % 2 ? (n + 1) / 2 : -n / 2;
    std::optional<GirthLoop> worst;
    for (int k = 0; k <= count; ++k) {
      const int on = k + shift;
      if (!loops[k] || on < 0 || on > count || !girths[on]) continue;
      GirthLoop loop = *loops[k];
      loop.height = knee->second + on * kStep;
      loop.body = girths[on]->length;
      if (!worst || loop.shortage() > worst->shortage()) worst = loop;
    }
    if (worst && (!best || worst->shortage() < best->shortage())) best = worst;
  }
  return best;
}

}  // namespace karinui
