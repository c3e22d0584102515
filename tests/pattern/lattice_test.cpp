#include <gtest/gtest.h>

#include <filesystem>

#include "support.h"

#include "karinui/pattern/edit.h"
#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

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
      EXPECT_LE(slivers * 12, faces) << file.path() << " " << spacing << " worst " << worst;
      if (spacing < 0.006) {
        EXPECT_GT(worst, 12) << file.path();
      }
      if (const char* to = std::getenv("KARINUI_PLOT")) {
        std::vector<std::shared_ptr<const Lattice>> all;
        for (const auto& [id, lattice] : laid->lattices) all.push_back(lattice);
        draw(std::string(to) + "/" + file.path().stem().string() + "_" + std::to_string(int(spacing * 1e3)) + ".svg",
             all);
      }
    }
  }
}

TEST(Lay, randomOutlinesAreSoundAndRepeatable) {
  std::mt19937 random(7);
  for (int k = 0; k < 60; ++k) {
    auto outline = checked(randomOutline(random, 0.3));
    if (!outline) continue;  // now and then two bows meet
    const Pattern pattern = patternOf({pieceOf(1, *outline)});
    for (Edge& edge : outline->edges) edge.name += " again";  // not found among what was laid before
    const Pattern renamed = patternOf({pieceOf(1, *outline)});
    for (const double spacing : {0.05, 0.017}) {
      const auto laid = lay(pattern, spacing), again = lay(renamed, spacing);
      ASSERT_TRUE(laid) << text(laid.error().what);
      EXPECT_TRUE(again->lattices.at({1})->edges.contains(outline->edges[0].name));
      expectSound(*laid->lattices.at({1}), "random outline " + std::to_string(k));
      EXPECT_EQ(laid->lattices.at({1})->nodes, again->lattices.at({1})->nodes);
      EXPECT_EQ(laid->lattices.at({1})->faces, again->lattices.at({1})->faces);
    }
  }
}

TEST(Lay, onlyWhatWasCutAnewIsLaidAnew) {
  Piece front = pieceOf(1, rectangle(0.4, 0.3), "front"), back = pieceOf(2, rectangle(0.5, 0.3), "back");
  const auto before = lay(patternOf({front, back}), 0.01);
  back.name = "the back";
  back.outline = rectangle(0.501, 0.3);
  const auto after = lay(patternOf({front, back}), 0.01), finer = lay(patternOf({front, back}), 0.0099);
  front.grain = {1, 0};
  const auto turned = lay(patternOf({front, back}), 0.01);
  ASSERT_TRUE(before && after && finer && turned);
  EXPECT_EQ(after->lattices.at({1}), before->lattices.at({1}));
  EXPECT_EQ(turned->lattices.at({2}), after->lattices.at({2}));
  EXPECT_NE(after->lattices.at({2}), before->lattices.at({2}));
  EXPECT_NE(finer->lattices.at({1}), before->lattices.at({1}));
  EXPECT_NE(turned->lattices.at({1}), before->lattices.at({1}));

  // Not for ever: after a quarter of a million other nodes it is laid anew, and is the same.
  front.grain = {0, 1};
  for (int k = 0; k < 25; ++k) ASSERT_TRUE(lay(patternOf({pieceOf(1, rectangle(1 + 0.001 * k, 1))}), 0.01));
  const auto anew = lay(patternOf({front}), 0.01);
  EXPECT_NE(anew->lattices.at({1}), before->lattices.at({1}));
  EXPECT_EQ(anew->lattices.at({1})->nodes, before->lattices.at({1})->nodes);
}

TEST(Lay, thinPiecesHaveNodesOnTheirOutlineOnly) {
  for (const double width : {0.03, 0.01, 0.005}) {
    const auto laid = lay(patternOf({pieceOf(1, rectangle(0.8, width))}), 0.04);
    ASSERT_TRUE(laid) << text(laid.error().what);
    const Lattice& lattice = *laid->lattices.at({1});
    expectSound(lattice, "band");
    EXPECT_EQ(lattice.nodes.size(), lattice.border.size());
    EXPECT_EQ(lattice.edges.at("bottom").count, 20u);
  }
}

// A stranger's pattern may ask for any size: it is refused before the memory is gone.
TEST(Lay, refusesWhatWouldTakeAllMemory) {
  const auto said = [](const std::vector<Piece>& pieces, double spacing) {
    const auto laid = lay(patternOf(pieces), spacing);
    return laid ? "laid" : text(laid.error().what);
  };
  EXPECT_NE(said({pieceOf(1, rectangle(5, 5))}, 0.002).find("would need more than four million nodes at 2.0 mm"),
            std::string::npos);
  std::vector<Piece> many;
  for (std::uint64_t id = 1; id <= 100; ++id) many.push_back(pieceOf(id, rectangle(0.5, 0.5)));
  EXPECT_NE(said(many, 0.002).find("All pieces together would need more than four million nodes"), std::string::npos);
  // A thin tape across the grain: little cloth on a grid of ten thousand million places.
  const Piece tape = pieceOf(1, polygon({{0, 0}, {0.01, 0}, {99.01, 99}, {99, 99}}), "tape");
  const std::string far = said({tape}, 0.001);
  EXPECT_NE(far.find("Piece tape spreads too far for a spacing of 1.0 mm"), std::string::npos) << far;
  Piece along = tape;
  along.grain = {1, 1};
  EXPECT_EQ(said({along}, 0.005), "laid");
  for (const double none : {0.0, -1.0, 1e-9, std::nan(""), HUGE_VAL})
    EXPECT_NE(said({pieceOf(1, rectangle(0.1, 0.1))}, none).find("is not usable"), std::string::npos);
}

TEST(Lay, holesStayOpen) {
  Piece piece = pieceOf(1, rectangle(0.4, 0.3));
  piece.holes = {circle(0.05, {0.2, 0.15}, "hole"), circle(0.006, {0.06, 0.06}, "eyelet")};
  for (const double spacing : {0.04, 0.01}) {
    const auto laid = lay(patternOf({piece}), spacing);
    ASSERT_TRUE(laid) << text(laid.error().what);
    expectSound(*laid->lattices.at({1}), "holes");
    EXPECT_EQ(laid->lattices.at({1})->holes.size(), 2u);
    EXPECT_EQ(laid->lattices.at({1})->edges.at("hole0").hole, 1u);
  }
}

TEST(Lay, aMirroredPieceGetsTheMirroredGrid) {
  Piece left = pieceOf(1, polygon({{0, 0}, {0.31, 0.02}, {0.27, 0.4}, {0.05, 0.37}}));
  left.grain = normalized(Flat{0.1, 1});
  Piece right = mirrored(left);
  right.id = left.id;
  const auto a = lay(patternOf({left}), 0.02), b = lay(patternOf({right}), 0.02);
  ASSERT_TRUE(a && b);
  const Lattice &one = *a->lattices.at({1}), &two = *b->lattices.at({1});
  ASSERT_EQ(one.nodes.size(), two.nodes.size());
  LatticeFinder finder(two.nodes, two.faces);
  for (Flat p : one.nodes) {
    const Flat image{-p.u, p.v};
    const auto near = std::min_element(two.nodes.begin(), two.nodes.end(),
                                       [&](Flat x, Flat y) { return distance(x, image) < distance(y, image); });
    EXPECT_LT(distance(*near, image), 1e-9);
  }
}

TEST(LatticeFinder, findsTheNearestPlace) {
  const auto laid = lay(patternOf({pieceOf(1, circle(0.2))}), 0.02);
  ASSERT_TRUE(laid);
  const Lattice& lattice = *laid->lattices.at({1});
  const LatticeFinder finder(lattice.nodes, lattice.faces);
  Ring border;
  for (auto n : lattice.border) border.push_back(lattice.nodes[n]);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.4, 0.4);
  for (int k = 0; k < 4000; ++k) {
    const Flat place{unit(random), unit(random)};
    const auto found = finder.find(place);
    Flat at{};
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      at += lattice.nodes[found.face[c]] * found.weight[c];
      sum += found.weight[c];
      EXPECT_GE(found.weight[c], 0);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(distance(at, place), contains(border, place) ? 0 : distanceToRing(border, place), 1e-9);
  }
}

// An edge that was taken in leaves the end of a line beyond it: the cloth has the part that lies on it.
TEST(Lay, aSewnLineIsLaidAsFarAsThereIsCloth) {
  for (const double beyond : {-0.0003, 0.0, 0.00005, 0.0003, 0.005, 0.04}) {
    Piece piece = pieceOf(1, rectangle(0.4, 0.4), "one");
    piece.lines.push_back({"line", {Curve::line({-beyond, 0.2}, {0.4 + beyond, 0.2})}, {}});
    Pattern pattern = patternOf({piece, pieceOf(2, rectangle(0.4, 0.1), "two")});
    pattern.seams[{9}] = {{9}, "", {{{2}, "top", 0, 1}}, {{{1}, "line", 0, 1}}, true, Seam::Tie::OneToOne};
    const auto laid = lay(pattern, 0.02);
    ASSERT_TRUE(laid) << beyond << text(laid.error().what);
    expectSound(*laid->lattices.at({1}), std::to_string(beyond));
    if (beyond < 1e-4) continue;
    double area = 0;
    const Lattice& lattice = *laid->lattices.at({1});
    for (const Triangle& f : lattice.faces)
      area += cross(lattice.nodes[f[1]] - lattice.nodes[f[0]], lattice.nodes[f[2]] - lattice.nodes[f[0]]) / 2;
    EXPECT_NEAR(area, 0.16, 1e-9) << beyond;
  }
}

}  // namespace
}  // namespace karinui
