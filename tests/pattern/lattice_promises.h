#pragma once
#include <gtest/gtest.h>

#include "support.h"

namespace karinui::test {

// What every lattice promises.
inline void expectSound(const Lattice& lattice, const std::string& what) {
  SCOPED_TRACE(what);
  std::vector<int> used(lattice.nodes.size(), 0);
  double area = 0;
  std::set<std::array<std::uint32_t, 2>> sides;
  for (const Triangle& f : lattice.faces) {
    const double twice = cross(lattice.nodes[f[1]] - lattice.nodes[f[0]], lattice.nodes[f[2]] - lattice.nodes[f[0]]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
    for (int k = 0; k < 3; ++k) {
      used.at(f[k]) = 1;
      EXPECT_TRUE(sides.insert({f[k], f[(k + 1) % 3]}).second) << "two faces on one side of an edge";
    }
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "unused nodes";
  Ring border;
  for (auto n : lattice.border) border.push_back(lattice.nodes[n]);
  double expected = signedArea(border);
  std::size_t ringSides = lattice.border.size();
  for (const auto& hole : lattice.holes) {
    Ring ring;
    for (auto n : hole) ring.push_back(lattice.nodes[n]);
    expected += signedArea(ring);
    ringSides += hole.size();
  }
  EXPECT_NEAR(area, expected, 1e-9);
  // Edges with one face only are exactly those of the outline and the holes.
  std::size_t open = 0;
  for (const auto& [a, b] : sides) open += !sides.contains({b, a});
  EXPECT_EQ(open, ringSides);
  for (std::size_t k = 0; k < lattice.border.size(); ++k)
    EXPECT_TRUE(sides.contains({lattice.border[k], lattice.border[(k + 1) % lattice.border.size()]}));
  for (const auto& [name, edge] : lattice.edges) {
    EXPECT_EQ(edge.fraction.size(), edge.count + 1) << name;
    EXPECT_EQ(edge.nodes.size(), edge.count + 1) << name;
    EXPECT_TRUE(std::is_sorted(edge.fraction.begin(), edge.fraction.end())) << name;
  }
}

}  // namespace karinui::test
