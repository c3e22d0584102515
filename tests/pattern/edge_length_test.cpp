// Typed lengths: met exactly, the kept end fixed, nothing else changed, both halves alike.
#include "karinui/pattern/edge_length.h"

#include <gtest/gtest.h>

#include "karinui/pattern/edit.h"
#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

std::string why(const auto& result) { return result ? std::string("it was not refused") : text(result.error().what); }

// A bodice front, both halves, its axis at u = 0: hem, side, armhole (curved), shoulder, neck, and their images.
Outline bodice() {
  Outline half;
  half.edges = {{"hem_left", Curve::line({0, 0}, {0.24, 0})},
                {"side_left", Curve::line({0.24, 0}, {0.25, 0.34})},
                {"armhole_left", Curve::cubic({0.25, 0.34}, {0.17, 0.36}, {0.16, 0.46}, {0.17, 0.56})},
                {"shoulder_left", Curve::line({0.17, 0.56}, {0.07, 0.6})},
                {"neck_left", Curve::cubic({0.07, 0.6}, {0.06, 0.54}, {0.03, 0.52}, {0, 0.52})}};
  Outline whole = half;
  for (auto edge = half.edges.rbegin(); edge != half.edges.rend(); ++edge)
    whole.edges.push_back({otherSide(edge->name), edge->curve.mirrored({}, {0, 1}).reversed()});
  const auto good = checked(whole);
  EXPECT_TRUE(good);
  return *good;
}
double lengthOf(const Outline& outline, const char* edge) { return outline.edges[*outline.find(edge)].curve.length(); }
const Curve& curveOf(const Outline& outline, const std::string& edge) {
  return outline.edges[*outline.find(edge)].curve;
}

TEST(EdgeLength, ASideMadeLongerLowersTheWholeHemAndTheArmholeStays) {
  const Outline before = bodice();
  const auto symmetry = symmetryOf(before);
  ASSERT_TRUE(symmetry);
  const auto after = withLength(before, {"side_left", 0.36, KeptEnd::End, true}, &*symmetry);
  ASSERT_TRUE(after) << why(after);
  EXPECT_NEAR(lengthOf(*after, "side_left"), 0.36, 1e-9);
  EXPECT_NEAR(lengthOf(*after, "side_right"), 0.36, 1e-9);
  for (const char* edge :
       {"armhole_left", "armhole_right", "shoulder_left", "shoulder_right", "neck_left", "neck_right"})
    EXPECT_EQ(curveOf(*after, edge), curveOf(before, edge)) << edge;
  EXPECT_NEAR(lengthOf(*after, "hem_left"), 0.24, 1e-12);
  EXPECT_NEAR(lengthOf(*after, "hem_right"), 0.24, 1e-12);
  EXPECT_NEAR(curveOf(*after, "hem_left").start.v, curveOf(*after, "hem_left").end.v, 1e-12) << "the hem stays level";
  EXPECT_NEAR(curveOf(*after, "hem_left").start.u, 0, 1e-12) << "and its middle on the axis";
  EXPECT_EQ(curveOf(*after, "side_left").end, curveOf(before, "side_left").end);
}

// A hem in curves is carried as it is, from whichever half the side is typed.
TEST(EdgeLength, ACurvedHemGoesDownAsItIs) {
  Outline before = bodice();
  const Curve curved[] = {Curve::cubic({0, 0}, {0.04, 0}, {0.08, 0.002}, {0.12, 0.005}),
                          Curve::cubic({0.12, 0.005}, {0.16, 0.008}, {0.2, 0.01}, {0.24, 0})};
  before.edges[*before.find("hem_left")].curve = Curve::joined(curved);
  before.edges[*before.find("hem_right")].curve = Curve::joined(curved).mirrored({}, {0, 1}).reversed();
  const auto symmetry = symmetryOf(before);
  ASSERT_TRUE(symmetry);
  for (const char* side : {"side_left", "side_right"}) {
    const auto after = withLength(
        before, {side, 0.4, side == std::string("side_left") ? KeptEnd::End : KeptEnd::Start, true}, &*symmetry);
    ASSERT_TRUE(after) << why(after);
    for (const char* hem : {"hem_left", "hem_right"}) {
      const Curve &was = curveOf(before, hem), &is = curveOf(*after, hem);
      const Flat by = is.start - was.start;
      EXPECT_NEAR(by.u, 0, 1e-12);
      for (const double f : {0.2, 0.5, 0.8, 1.0})
        EXPECT_LT(distance(is.atFraction(f), was.atFraction(f) + by), 1e-9) << side << " " << hem << " " << f;
    }
  }
}

TEST(EdgeLength, NeighboursTurnAboutTheirFarEnds) {
  const Outline before = rectangle(0.4, 0.3);  // bottom, right, top, left
  const auto after = withLength(before, {"right", 0.32, KeptEnd::Start, true}, nullptr);
  ASSERT_TRUE(after) << why(after);
  // Two circles: 0.32 about (0.4, 0), 0.4 about (0, 0.3).
  const Flat corner = curveOf(*after, "right").end;
  EXPECT_NEAR(distance(corner, {0.4, 0}), 0.32, 1e-12);
  EXPECT_NEAR(distance(corner, {0, 0.3}), 0.4, 1e-12);
  EXPECT_EQ(curveOf(*after, "bottom"), curveOf(before, "bottom"));
  EXPECT_EQ(curveOf(*after, "left"), curveOf(before, "left"));
  const auto follows = withLength(before, {"right", 0.32, KeptEnd::Start, false}, nullptr);
  ASSERT_TRUE(follows);
  EXPECT_NEAR(curveOf(*follows, "right").end.u, 0.4, 1e-12) << "along the edge's own direction";
  EXPECT_NEAR(curveOf(*follows, "right").end.v, 0.32, 1e-12);
  EXPECT_NEAR(lengthOf(*follows, "top"), std::hypot(0.4, 0.02), 1e-12);
  const auto middle = withLength(before, {"right", 0.32, KeptEnd::Middle, false}, nullptr);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(curveOf(*middle, "right").start.v, -0.01, 1e-12);
  EXPECT_NEAR(curveOf(*middle, "right").end.v, 0.31, 1e-12);
}

TEST(EdgeLength, TheNeckGrowsAtTheCentreAlone) {
  const Outline before = bodice();
  const auto symmetry = symmetryOf(before);
  const double wanted = lengthOf(before, "neck_left") + 0.01;
  const auto after = withLength(before, {"neck_left", wanted, KeptEnd::Start, true}, &*symmetry);
  ASSERT_TRUE(after) << why(after);
  EXPECT_NEAR(lengthOf(*after, "neck_left"), wanted, 1e-9);
  EXPECT_NEAR(lengthOf(*after, "neck_right"), wanted, 1e-9);
  EXPECT_NEAR(curveOf(*after, "neck_left").end.u, 0, 1e-12);
  for (const char* edge : {"hem_left", "side_left", "armhole_left", "shoulder_left", "shoulder_right"})
    EXPECT_EQ(curveOf(*after, edge), curveOf(before, edge)) << edge;
  // A level hem cannot grow by sliding its middle up and down.
  EXPECT_NE(why(withLength(before, {"hem_left", 0.26, KeptEnd::End, true}, &*symmetry)).find("centre line"),
            std::string::npos);
}

// Closed form: an edge across the axis. Each end moves out by half, and up or down so that the sides keep their length.
TEST(EdgeLength, AnEdgeAcrossTheCentreGrowsOnBothSides) {
  const Outline before = rectangle(0.4, 0.3, {-0.2, 0});
  const auto symmetry = symmetryOf(before);
  ASSERT_TRUE(symmetry);
  const auto after = withLength(before, {"top", 0.42, KeptEnd::Middle, true}, &*symmetry);
  ASSERT_TRUE(after) << why(after);
  EXPECT_NEAR(lengthOf(*after, "top"), 0.42, 1e-12);
  EXPECT_NEAR(curveOf(*after, "top").start.u, 0.21, 1e-12);
  EXPECT_NEAR(curveOf(*after, "top").start.v, std::sqrt(0.09 - 0.0001), 1e-12);
  EXPECT_NEAR(lengthOf(*after, "left"), 0.3, 1e-12);
  EXPECT_NEAR(lengthOf(*after, "right"), 0.3, 1e-12);
  EXPECT_NE(why(withLength(before, {"top", 0.42, KeptEnd::Start, true}, &*symmetry)).find("crosses the centre"),
            std::string::npos);
}

TEST(EdgeLength, OnRandomOutlinesTheLengthIsMetAndTheRestStays) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> unit(0, 1);
  int done = 0, kept = 0, refusals = 0;
  for (int round = 0; round < 400; ++round) {
    const auto outline = checked(randomOutline(random, 0.3));
    if (!outline) continue;
    const std::size_t n = outline->edges.size(), k = static_cast<std::size_t>(unit(random) * static_cast<double>(n));
    LengthChange change;
    change.edge = outline->edges[k].name;
    change.to = outline->edges[k].curve.length() * (0.7 + 0.6 * unit(random));
    change.keep = static_cast<KeptEnd>(round % 3);
    change.neighboursKeep = round % 2 == 0;
    const auto after = withLength(*outline, change, nullptr);
    if (!after) {
      EXPECT_FALSE(text(after.error().what).empty());
      ++refusals;
      continue;
    }
    ++done;
    ASSERT_TRUE(checked(*after)) << "still simple";
    ASSERT_NEAR(after->edges[k].curve.length(), change.to, 1e-8);
    if (change.keep == KeptEnd::Start) {
      ASSERT_EQ(after->edges[k].curve.start, outline->edges[k].curve.start);
    }
    if (change.keep == KeptEnd::End) {
      ASSERT_EQ(after->edges[k].curve.end, outline->edges[k].curve.end);
    }
    for (std::size_t e = 0; e < n; ++e) {
      const bool next = e == (k + 1) % n && change.keep != KeptEnd::End,
                 before = e == (k + n - 1) % n && change.keep != KeptEnd::Start;
      if (e == k) continue;
      if (!next && !before) {
        ASSERT_EQ(after->edges[e], outline->edges[e]);
      } else if (change.neighboursKeep &&
                 std::fabs(after->edges[e].curve.length() - outline->edges[e].curve.length()) < 1e-9) {
        ++kept;
      }
    }
  }
  EXPECT_GT(done, 250);
  EXPECT_GT(kept, 80) << "neighbours that kept their lengths";
}

TEST(EdgeLength, OnSymmetricOutlinesTheSymmetryStays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int done = 0;
  for (int round = 0; round < 200; ++round) {
    // Half a star, and its image.
    Outline half, whole;
    std::vector<Flat> corner;
    const int count = 3 + round % 4;
    for (int i = 0; i <= count; ++i) {
      const double angle = std::numbers::pi * (i + (i == 0 || i == count ? 0 : 0.3 * unit(random))) / count,
                   radius = 0.3 * (0.7 + 0.3 * unit(random));
      corner.push_back({i == 0 || i == count ? 0 : radius * std::sin(angle), -radius * std::cos(angle)});
    }
    for (int i = 0; i < count; ++i) {
      const Flat a = corner[i], b = corner[i + 1], out = leftOf(b - a) * (0.1 * unit(random));
      half.edges.push_back(
          {"e" + std::to_string(i) + "_left", Curve::cubic(a, lerp(a, b, 0.3) + out, lerp(a, b, 0.7), b)});
    }
    whole = half;
    for (auto edge = half.edges.rbegin(); edge != half.edges.rend(); ++edge)
      whole.edges.push_back({otherSide(edge->name), edge->curve.mirrored({}, {0, 1}).reversed()});
    const auto outline = checked(whole);
    const auto symmetry = outline ? symmetryOf(*outline) : std::nullopt;
    if (!symmetry) continue;
    const std::size_t k = static_cast<std::size_t>(unit(random) * static_cast<double>(outline->edges.size()));
    LengthChange change{outline->edges[k].name, 0, round % 2 == 0 ? KeptEnd::Start : KeptEnd::End, round % 3 != 0};
    change.to = outline->edges[k].curve.length() * (0.9 + 0.2 * unit(random));
    const auto after = withLength(*outline, change, &*symmetry);
    if (!after) continue;
    ++done;
    EXPECT_NEAR(after->edges[k].curve.length(), change.to, 1e-8);
    EXPECT_NEAR(after->edges[*symmetry->partner[k]].curve.length(), change.to, 1e-8);
    for (std::size_t e = 0; e < outline->edges.size(); ++e) {
      const Curve image = symmetry->image(after->edges[e].curve).reversed();
      const Curve& other = after->edges[*symmetry->partner[e]].curve;
      for (const double f : {0.0, 0.3, 0.5, 0.8, 1.0}) EXPECT_LT(distance(image.at(f), other.at(f)), 1e-12);
    }
  }
  EXPECT_GT(done, 100);
}

TEST(EdgeLength, RefusesInWords) {
  const Outline before = rectangle(0.4, 0.3);
  EXPECT_NE(why(withLength(before, {"lid", 0.2, KeptEnd::Start, true}, nullptr)).find("no edge lid"),
            std::string::npos);
  Outline dented = polygon({{0, 0}, {0.4, 0}, {0.4, 0.3}, {0.2, 0.05}, {0, 0.3}});
  EXPECT_NE(why(withLength(dented, {"e2", 0.45, KeptEnd::Start, false}, nullptr)).find("crosses"), std::string::npos);
}

}  // namespace
}  // namespace karinui
