#include "cloth/detail_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "cloth/helpers.h"
#include "karinui/cloth/fabric.h"

namespace karinui::test {
namespace {

constexpr double kWideCell = 0.02, kSheet = 0.4;  // metres: cells of the coarse level, and the square sheet

Cloth sheet(std::uint32_t cells) {
  Cloth cloth;
  addPiece(cloth, gridLattice(cells, cells, kSheet / cells), textbook(1000, 1e-5, 0.2));
  return cloth;
}

// Waves along u that are two cells of the coarse level long, which it does not show.
Vec3 rippled(std::size_t, Flat at) {
  return {at.u, at.v, 0.003 * std::sin(2 * std::numbers::pi * at.u / (2 * kWideCell))};
}

Rigid turnedBy(double angle) {
  Rigid way = turnAbout({0.6, 0.8, 0}, angle);
  way.carry = {0.1 * angle, 0.2, -0.3 * angle};
  return way;
}

std::vector<Vec3> moved(const std::vector<Vec3>& places, const Rigid& way) {
  std::vector<Vec3> out(places.size());
  std::transform(places.begin(), places.end(), out.begin(), way);
  return out;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, distance(a[k], b[k]));
  return most;
}

TEST(DetailTransfer, LeavesTheClothWhereNothingMoves) {
  const Cloth fine = sheet(40), coarse = sheet(20);
  const std::vector<Vec3> x = standingBy(fine, rippled).position;
  Workers workers;
  DetailTransfer detail(fine, x, coarse);
  // Every coarse node is a fine one here.
  for (std::size_t k = 0; k < coarse.nodeCount; ++k)
    EXPECT_NEAR(distance(detail.start()[k], rippled(0, coarse.pieces[0].lattice->nodes[k])), 0, 1e-12);
  EXPECT_LT(farthest(detail.at(detail.start(), workers), x), 1e-12);
}

TEST(DetailTransfer, GoesRigidlyWithWhatGoesRigidly) {
  const Cloth fine = sheet(40), coarse = sheet(20);
  const std::vector<Vec3> x = standingBy(fine, rippled).position;
  Workers workers;
  DetailTransfer detail(fine, x, coarse);
  for (const double angle : {0.3, 1.0, 2.0, 3.0, 4.5})
    EXPECT_LT(farthest(detail.at(moved(detail.start(), turnedBy(angle)), workers), moved(x, turnedBy(angle))), 1e-6)
        << angle;
}

// A sheet that is rolled to a quarter of a ring has its waves still, at right angles to the ring.
TEST(DetailTransfer, TurnsTheDetailWithTheCloth) {
  constexpr double kRadius = kSheet / (std::numbers::pi / 2);
  const auto rolled = [](double share) {
    return [share](std::size_t, Flat at) {
      if (share == 0) return Vec3{at.u, at.v, 0};
      const double radius = kRadius / share;
      return Vec3{radius * std::sin(at.u / radius), at.v, radius * (1 - std::cos(at.u / radius))};
    };
  };
  const Cloth fine = sheet(80), coarse = sheet(20);
  const std::vector<Vec3> x = standingBy(fine, rippled).position;
  Workers workers;
  DetailTransfer detail(fine, x, coarse);
  std::vector<Vec3> at;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) at = detail.at(standingBy(coarse, rolled(share)).position, workers);
  double most = 0, least = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Vec3 p = at[k];
    const double off = kRadius - std::hypot(p.x, p.z - kRadius);  // inwards, as z was
    EXPECT_NEAR(p.y, x[k].y, 1e-4);
    EXPECT_NEAR(off, x[k].z, 0.0005);
    most = std::max(most, off), least = std::min(least, off);
  }
  EXPECT_NEAR(most, 0.003, 0.0002);
  EXPECT_NEAR(least, -0.003, 0.0002);
}

TEST(DetailTransfer, IsTheSameForAnyNumberOfThreads) {
  const Cloth fine = sheet(40), coarse = sheet(20);
  const std::vector<Vec3> x = standingBy(fine, rippled).position;
  Workers one(1), three(3);
  DetailTransfer a(fine, x, coarse), b(fine, x, coarse);
  const std::vector<Vec3> to = moved(a.start(), turnedBy(1));
  EXPECT_EQ(a.at(to, one), b.at(to, three));
}

}  // namespace
}  // namespace karinui::test
