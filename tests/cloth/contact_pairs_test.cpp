// The search for pairs of cloth on cloth, with what it keeps from one search to the next, against one over all nodes,
// faces and edges.
#include <gtest/gtest.h>

#include <set>

#include "cloth/closest_points.h"
#include "cloth/contact_pairs.h"
#include "cloth/helpers.h"

namespace karinui::test {
namespace {

constexpr double kPairCell = 0.01, kPairRadius = 0.002, kMoves = 1.2;
using Nodes = std::array<NodeIndex, 4>;
using Sides = std::pair<int, Nodes>;

// Two sides in either order, each with its nodes in order.
Sides sortedSides(Nodes node, int first) {
  std::sort(node.begin(), node.begin() + first);
  std::sort(node.begin() + first, node.end());
  if (first == 2 && node[2] < node[0]) std::swap_ranges(node.begin(), node.begin() + 2, node.begin() + 2);
  return {first, node};
}

Cloth twoPieces() {
  Cloth cloth;
  for (int k = 0; k < 2; ++k) addPiece(cloth, gridLattice(9, 7, kPairCell), *preset("cotton"));
  return cloth;
}

struct TwoSheets {
  TwoSheets() {
    for (int k = 0; k < 2; ++k)
      for (const Flat p : cloth.pieces[0].lattice->nodes) x.push_back({p.u, p.v, 0.003 * k});
    for (Vec3& p : x) p += step(0.001);
  }
  Vec3 step(double size) { return Vec3{by(random), by(random), by(random)} * size; }
  // As a fold goes over a sheet: both carried along, turned a little, and rubbed.
  void wander(double carried, double rubbed) {
    const Vec3 way = step(carried), axis = step(0.02);
    for (std::size_t n = 0; n < x.size(); ++n)
      x[n] += way + cross(axis, x[n]) + step(rubbed) + (n < x.size() / 2 ? way * 0.1 : Vec3{});
  }
  struct Wanted {
    std::set<Sides> all, surely;  // those whose nearest nodes are no neighbours
    std::set<Sides> sides;        // edges all but two of whose ends are neighbours: of a parallelogram of two faces
  };
  Wanted wanted(const std::vector<Vec3>& move, double within) const {
    Wanted result;
    const auto ask = [&](const Nodes& node, int first) {
      double nearest = 1e300, neighbours = 1e300, apart = 0;
      for (int i = 0; i < first; ++i)
        for (int j = first; j < 4; ++j) {
          if (topology.sewn(node[i], node[j])) return;
          double& least = topology.neighbours(node[i], node[j]) ? neighbours : nearest;
          least = std::min(least, length(x[node[i]] - x[node[j]]));
          if (!move.empty()) apart = std::max(apart, length(move[node[i]] - move[node[j]]));
        }
      const Vec3 p = x[node[0]], q = x[node[1]], r = x[node[2]], s = x[node[3]];
      Vec3 gap;
      if (first == 1) {
        const auto w = closestOnTriangle(p, q, r, s);
        gap = p - (q * w[0] + r * w[1] + s * w[2]);
      } else {
        const auto at = closestOnSegments(p, q, r, s);
        if (move.empty() && (at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1)) return;
        gap = lerp(p, q, at[0]) - lerp(r, s, at[1]);
      }
      if (length(gap) >= within + kMoves * apart) return;
      result.all.insert(sortedSides(node, first));
      if (nearest < neighbours) result.surely.insert(sortedSides(node, first));
      int beside = 0;
      for (int k = 0; k < 4; ++k) beside += topology.neighbours(node[k / 2], node[2 + k % 2]) ? 1 : 0;
      if (first == 2 && beside == 3) result.sides.insert(sortedSides(node, first));
    };
    for (NodeIndex n = 0; n < x.size(); ++n)
      for (const Triangle& f : topology.faces) ask({n, f[0], f[1], f[2]}, 1);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      for (std::size_t f = e + 1; f < topology.edges.size(); ++f)
        ask({topology.edges[e][0], topology.edges[e][1], topology.edges[f][0], topology.edges[f][1]}, 2);
    return result;
  }

  Cloth cloth = twoPieces();
  std::vector<Vec3> x;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> by{-1, 1};
  ClothTopology topology{cloth, kPairRadius};
  SewnGroups sewn{TieMap(cloth, std::vector<std::uint8_t>(cloth.nodeCount, 0), {}), cloth.nodeCount};
  ContactPairs search{topology, sewn, kPairRadius, kPairCell};
  Workers workers{1};
};

// As in a drape: contacts where the cloth stands, then what may meet during a move, and on to where it leads.
TEST(ContactPairs, EachSearchFindsWhatOneOverEverythingDoes) {
  TwoSheets sheets;
  std::size_t touching = 0, meeting = 0;
  for (int round = 0; round < 24; ++round) {
    SCOPED_TRACE(round);
    std::vector<Vec3> move;
    for (const bool moves : {false, true}) {
      if (moves)
        for (std::size_t n = 0; n < sheets.x.size(); ++n) move.push_back(sheets.step(n % 37 == 0 ? 0.006 : 0.0003));
      const double within = moves ? 0.0003 : 1.1 * kPairRadius;
      const auto found = sheets.search.find({sheets.x, move, within}, sheets.workers);
      std::set<Sides> nodes;
      for (const ContactPair& pair : found)
        EXPECT_TRUE(nodes.insert(sortedSides(pair.node, pair.first)).second) << "found twice";
      const TwoSheets::Wanted wanted = sheets.wanted(move, within);
      std::vector<Sides> missed, added;
      std::set_difference(wanted.surely.begin(), wanted.surely.end(), nodes.begin(), nodes.end(),
                          std::back_inserter(missed));
      std::set_difference(nodes.begin(), nodes.end(), wanted.all.begin(), wanted.all.end(), std::back_inserter(added));
      EXPECT_TRUE(missed.empty()) << testing::PrintToString(missed);
      EXPECT_TRUE(added.empty()) << testing::PrintToString(added);
      (moves ? meeting : touching) += nodes.size();
    }
    // Now and then one node leaps farther than what was kept serves.
    sheets.wander(0.0015, 0.0002);
    if (round % 5 == 3) sheets.x[static_cast<std::size_t>(round)] += Vec3{0, 0, 0.008};
  }
  EXPECT_GT(touching, 1000u);
  EXPECT_GT(meeting, 1000u);
}

// In a crumple cells collapse until opposite sides come as near to each other as cloth may. They are joined at either
// end; their far corners may be as far apart as both sides are long.
TEST(ContactPairs, OppositeSidesOfACollapsedCellMeet) {
  TwoSheets sheets;
  std::size_t meeting = 0;
  for (int round = 0; round < 12; ++round) {
    for (std::size_t n = 0; n < sheets.x.size(); ++n) {
      const Flat p = sheets.topology.paper[n];
      sheets.x[n] = Vec3{0.15 * p.u, p.v + (round % 3 - 1) * 0.35 * p.u, n < sheets.x.size() / 2 ? 0.0 : 0.05} +
                    sheets.step(0.0004);
    }
    std::vector<Vec3> move;
    for (std::size_t n = 0; n < sheets.x.size(); ++n) move.push_back(sheets.step(0.001));
    std::set<Sides> found;
    for (const ContactPair& pair : sheets.search.find({sheets.x, move, 0.0003}, sheets.workers))
      found.insert(sortedSides(pair.node, pair.first));
    const std::set<Sides> wanted = sheets.wanted(move, 0.0003).sides;
    std::vector<Sides> missed;
    std::set_difference(wanted.begin(), wanted.end(), found.begin(), found.end(), std::back_inserter(missed));
    EXPECT_TRUE(missed.empty()) << missed.size() << " of " << wanted.size();
    meeting += wanted.size();
  }
  EXPECT_GT(meeting, 1000u);
}

}  // namespace
}  // namespace karinui::test
