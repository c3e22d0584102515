#include "cloth/flat_folds.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "cloth/helpers.h"
#include "cloth/intersection_contour.h"
#include "karinui/cloth/fabric.h"

namespace karinui::test {
namespace {

constexpr double kCoarseCell = 0.02, kSheetSide = 0.4;  // metres: cells of the coarse level, and the square sheets
constexpr double kCrest = 0.003, kSheetsApart = 0.1;

// Two sheets, one before the other.
Cloth sheetsApart(std::uint32_t cells) {
  Cloth cloth;
  for (int k = 0; k < 2; ++k) addPiece(cloth, gridLattice(cells, cells, kSheetSide / cells), textbook(1000, 1e-5, 0.2));
  return cloth;
}

// Waves that wide cells do not show; the crests of each sheet stand towards the other.
Vec3 crested(std::size_t piece, Flat at) {
  const double wave = kCrest * std::sin(2 * std::numbers::pi * at.u / (2 * kCoarseCell));
  return {at.u, at.v, piece == 0 ? wave : kSheetsApart - wave};
}

std::size_t crossingsOf(const Cloth& cloth, const std::vector<Vec3>& x, Workers& workers) {
  IntersectionContour contour(cloth);
  contour.find(x, workers);
  return contour.crossings();
}

// The upper sheet comes down to so far above the lower one where v is less than half of the sheets.
struct Lowered {
  const Cloth fine = sheetsApart(80), coarse = sheetsApart(20);
  Workers workers;
  DetailTransfer detail{fine, standingBy(fine, crested).position, coarse};
  std::vector<Vec3> places, whole;
  explicit Lowered(double gap) : places(detail.start()) {
    for (std::size_t k = coarse.pieces[1].firstNode; k < places.size(); ++k)
      if (places[k].y < kSheetSide / 2) places[k].z = gap;
    whole = detail.at(places, workers);
  }
  std::vector<Vec3> flat() { return withFlatFolds(detail, fine, coarse, places, workers); }
};

TEST(FlatFolds, LieOnTheWideCellsWhereTheirDetailWouldCross) {
  Lowered sheet(1.3 * kCrest);
  ASSERT_GT(crossingsOf(sheet.fine, sheet.whole, sheet.workers), 0u);
  ASSERT_EQ(crossingsOf(sheet.coarse, sheet.places, sheet.workers), 0u);
  const std::vector<Vec3> flat = sheet.flat();
  EXPECT_EQ(crossingsOf(sheet.fine, flat, sheet.workers), 0u);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < flat.size(); ++k)
    if (sheet.whole[k].y > 0.75 * kSheetSide) {
      EXPECT_EQ(flat[k], sheet.whole[k]);
      ++kept;
    }
  EXPECT_GT(kept, 1000u);
}

TEST(FlatFolds, KeepTheirDetailWhereWideCellsCross) {
  Lowered sheet(1.3 * kCrest);
  for (std::size_t k = sheet.coarse.pieces[1].firstNode; k < sheet.places.size(); ++k)
    if (Vec3& p = sheet.places[k]; p.y < kSheetSide / 2) p.z = p.x < kSheetSide / 2 ? -0.007 : 0.012, p.y += 0.004;
  ASSERT_GT(crossingsOf(sheet.coarse, sheet.places, sheet.workers), 0u);
  sheet.whole = sheet.detail.at(sheet.places, sheet.workers);
  const std::vector<Vec3> flat = sheet.flat();
  for (std::size_t k = 0; k < flat.size(); ++k)
    if (std::fabs(sheet.whole[k].x - (kSheetSide - kCoarseCell) / 2) < kCoarseCell / 4 &&
        sheet.whole[k].y < kSheetSide / 4) {
      EXPECT_EQ(flat[k], sheet.whole[k]);
    }
}

TEST(FlatFolds, AreAsTheyWereWhereNothingCrosses) {
  Lowered sheet(kSheetsApart / 2);
  EXPECT_EQ(sheet.flat(), sheet.whole);
}

// A sheet whose middle is a tangle lies smooth there, and as it lay elsewhere.
TEST(FlatFolds, OpenAKnotOfOneSheet) {
  Cloth cloth;
  addPiece(cloth, gridLattice(40, 40, 0.01), textbook(1000, 1e-5, 0.2));
  Workers workers;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-0.03, 0.03);
  const auto inKnot = [](Flat at) { return distance(at, Flat{0.2, 0.2}) < 0.045; };
  const std::vector<Vec3> x =
      standingBy(cloth, [&](std::size_t, Flat at) {
        return inKnot(at) ? Vec3{at.u + off(random), at.v + off(random), off(random)} : Vec3{at.u, at.v, 0};
      }).position;
  ASSERT_GT(crossingsOf(cloth, x, workers), 10u);
  const std::vector<Vec3> smooth = withKnotsSmoothed(cloth, x, workers);
  EXPECT_EQ(crossingsOf(cloth, smooth, workers), 0u);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Flat at = cloth.pieces[0].lattice->nodes[k];
    if (distance(at, Flat{0.2, 0.2}) > 0.09) {
      EXPECT_EQ(smooth[k], x[k]);
    }
    EXPECT_LT(std::fabs(smooth[k].z), 0.01);
  }
}

}  // namespace
}  // namespace karinui::test
