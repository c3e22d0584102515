#include <gtest/gtest.h>

#include <filesystem>

#include "support.h"

namespace karinui {
namespace {

using namespace test;

// What every lattice promises.
void expectSound(const Lattice& lattice, const std::string& what) {
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

TEST(Lay, realDraftsAtAllSpacings) {
  const std::filesystem::path folder = std::string(KARINUI_SHARED_DIR) + "/patterns";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the real drafts are not here";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".json") continue;
    const Draft made = draft(file.path());
    for (const double spacing : {0.04, 0.02, 0.01, 0.005}) {
      const auto laid = lay(made.pattern, spacing);
      ASSERT_TRUE(laid) << file.path() << text(laid.error().what);
      std::size_t slivers = 0, faces = 0;
      double worst = 90;
      for (const auto& [id, lattice] : laid->lattices) {
        expectSound(*lattice, file.path().string() + " " + made.pattern.pieces.at(id)->name);
        for (const Triangle& f : lattice->faces) {
          const double angle = smallestAngle(*lattice, f);
          slivers += angle < 20;
          ++faces;
          worst = std::min(worst, angle);
        }
      }
      std::printf("%s %.0f mm: %zu faces, %zu slivers, worst %.1f, %zu ties\n", file.path().stem().c_str(),
                  spacing * 1e3, faces, slivers, worst, laid->ties.size());
      if (const char* to = std::getenv("KARINUI_PLOT")) {
        std::vector<std::shared_ptr<const Lattice>> all;
        for (const auto& [id, lattice] : laid->lattices) all.push_back(lattice);
        draw(std::string(to) + "/" + file.path().stem().string() + "_" + std::to_string(int(spacing * 1e3)) + ".svg",
             all);
      }
    }
  }
}

}  // namespace
}  // namespace karinui
