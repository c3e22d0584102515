// The continuous collision filter: whatever moves are wished, on the way nothing passes through anything.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/intersection_contour.h"
#include "cloth/self_contact.h"

namespace karinui::test {
namespace {

constexpr double kFilterCell = 0.01;

struct Sheets {
  // `sewn`: along the column u = 0 of both.
  Sheets(std::uint32_t columns, std::uint32_t rows, bool sewn = false) {
    for (int k = 0; k < 2; ++k) addPiece(cloth, gridLattice(columns, rows, kFilterCell), *preset("cotton"));
    const std::uint32_t each = (columns + 1) * (rows + 1);
    for (std::uint32_t n = 0; sewn && n < each; n += columns + 1) cloth.ties.push_back({n, each + n});
    contact = std::make_unique<SelfContact>(cloth, 0.002);
    const std::vector<std::uint8_t> held(cloth.nodeCount, 0);
    contact->setTies(TieMap(cloth, held, std::vector<std::uint8_t>(cloth.ties.size(), 1)));
  }
  // How many of a hundred places on the way stand crossed.
  int crossedOnTheWay(const std::vector<Vec3>& x, const std::vector<Vec3>& move) {
    IntersectionContour contour(cloth);
    int crossed = 0;
    for (int k = 0; k <= 100; ++k) {
      std::vector<Vec3> at = x;
      for (std::size_t n = 0; n < x.size(); ++n) at[n] += move[n] * (k / 100.0);
      contour.find(at, workers);
      crossed += contour.crossings() > 0;
    }
    return crossed;
  }
  Cloth cloth;
  std::unique_ptr<SelfContact> contact;
  Workers workers{1};
};

Vec3 anyWay(std::mt19937& random) {
  std::normal_distribution<double> by;
  return normalized(Vec3{by(random), by(random), by(random)});
}

// Of a gather sewn 2:1: a strip is folded back so that the second of the pair stands over a face of the first, and is
// then sent through it.
TEST(CollisionFilter, BothOfAPairSewnToOneMeetEachOthersFaces) {
  Cloth gathered;
  addPiece(gathered, gridLattice(3, 1, kFilterCell), *preset("cotton"));
  addPiece(gathered, gridLattice(1, 1, kFilterCell), *preset("cotton"));
  const Cloth unsewn = gathered;
  const std::uint32_t b = 1, c = 2;
  gathered.ties = {{8, b, c, 0}};
  std::vector<Vec3> x, move(12);
  const Vec3 fold[] = {{0, 0, 0}, {1, 0, 0}, {0.45, 0, 0.3}, {1.2, 0, 0.7}};
  for (int j = 0; j < 2; ++j)
    for (const Vec3 p : fold) x.push_back((p + Vec3{0, j + 0.3 * (p.z > 0), 0}) * kFilterCell);
  for (const Flat p : gathered.pieces[1].lattice->nodes) x.push_back({p.u, p.v, 0.1});
  move[c] = Vec3{0, 0, -0.006};
  Workers workers{1};
  IntersectionContour contour(unsewn);
  const auto crossed = [&] {
    std::vector<Vec3> at = x;
    for (std::size_t n = 0; n < x.size(); ++n) at[n] += move[n];
    contour.find(at, workers);
    return contour.crossings();
  };
  EXPECT_GT(crossed(), 0u);
  SelfContact contact(gathered, 0.002);
  contact.setTies(TieMap(gathered, std::vector<std::uint8_t>(12, 0), {1}));
  contact.limitMove(x, move, workers);
  EXPECT_EQ(crossed(), 0u);
}

// Two sheets that do not cross, anyhow in space, each node sent through the other sheet.
TEST(CollisionFilter, NothingPassesThroughAnythingOnTheWay) {
  Sheets sheets(3, 3);
  int tried = 0;
  for (unsigned seed = 1; tried < 25; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-1, 1);
    std::vector<Vec3> x, move;
    for (int k = 0; k < 2; ++k) {
      const Vec3 u = anyWay(random), v = normalized(cross(u, anyWay(random)));
      const Vec3 middle = k == 0 ? Vec3{} : anyWay(random) * (0.004 + 0.008 * (by(random) + 1));
      for (const Flat p : sheets.cloth.pieces[0].lattice->nodes)
        x.push_back(middle + u * (p.u - 1.5 * kFilterCell) + v * (p.v - 1.5 * kFilterCell));
    }
    if (sheets.crossedOnTheWay(x, std::vector<Vec3>(x.size())) > 0) continue;
    const Vec3 onto = (x[0] + x[15] - x[16] - x[31]) * 1.0;
    for (std::size_t n = 0; n < x.size(); ++n)
      move.push_back(normalized(onto * (n < 16 ? -1 : 1) + Vec3{by(random), by(random), by(random)} * 0.01) *
                     (0.5 * kFilterCell));
    if (sheets.crossedOnTheWay(x, move) == 0) continue;  // nothing to keep from
    ++tried;
    sheets.contact->detect({x}, sheets.workers);
    sheets.contact->limitMove(x, move, sheets.workers);
    EXPECT_EQ(sheets.crossedOnTheWay(x, move), 0) << "seed " << seed;
  }
}

// Two sheets folded together at their seam, each a little crumpled, one sent through the other: beside the seam, too,
// cloth meets what it is sewn to.
TEST(CollisionFilter, SheetsSewnTogetherDoNotPassThroughEachOther) {
  Sheets sheets(3, 3, true);
  int tried = 0;
  for (unsigned seed = 1; tried < 25; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-1, 1);
    std::vector<Vec3> x, move;
    for (int k = 0; k < 2; ++k)
      for (const Flat p : sheets.cloth.pieces[0].lattice->nodes) {
        const double steep = k == 0 ? 0 : 0.3;
        const Vec3 crumple = p.u > 0 ? Vec3{by(random), 0.2 * by(random), by(random)} * (0.5 * kFilterCell) : Vec3{};
        x.push_back(Vec3{p.u * std::cos(steep), p.u * std::sin(steep), p.v} + crumple);
        move.push_back(p.u > 0 && k == 1
                           ? Vec3{0.3 * by(random), -1 + 0.3 * by(random), 0.3 * by(random)} * (0.5 * kFilterCell)
                           : Vec3{});
      }
    if (sheets.crossedOnTheWay(x, std::vector<Vec3>(x.size())) > 0) continue;
    if (sheets.crossedOnTheWay(x, move) == 0) continue;
    ++tried;
    sheets.contact->detect({x}, sheets.workers);
    sheets.contact->limitMove(x, move, sheets.workers);
    EXPECT_EQ(sheets.crossedOnTheWay(x, move), 0) << "seed " << seed;
  }
}

// A crumpled sheet squeezed into a ball, again and again: in its sharp folds the nearest nodes are often neighbours,
// and nothing pushes apart what comes ever nearer.
TEST(CollisionFilter, ACrumpledSheetDoesNotPassThroughItself) {
  Sheets sheets(3, 3);
  int tried = 0;
  for (unsigned seed = 1; tried < 100; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-1, 1);
    const auto any = [&](double far) { return Vec3{by(random), by(random), by(random)} * far; };
    std::vector<Vec3> x;
    for (int k = 0; k < 2; ++k)
      for (const Flat p : sheets.cloth.pieces[0].lattice->nodes)
        x.push_back(k == 0 ? Vec3{p.u, p.v, 0} + any(0.3 * kFilterCell) : Vec3{p.u, p.v, 1});
    if (sheets.crossedOnTheWay(x, std::vector<Vec3>(x.size())) > 0) continue;
    ++tried;
    for (int step = 0; step < 12; ++step) {
      const Vec3 middle = (x[0] + x[3] + x[12] + x[15]) * 0.25;
      std::vector<Vec3> way(x.size());
      for (int n = 0; n < 16; ++n) way[n] = (middle - x[n]) * 0.2 + any(0.2 * kFilterCell);
      sheets.contact->limitMove(x, way, sheets.workers);
      ASSERT_EQ(sheets.crossedOnTheWay(x, way), 0) << "seed " << seed << ", step " << step;
      for (std::size_t n = 0; n < x.size(); ++n) x[n] += way[n];
    }
  }
}

// Two strips on edge, one across the other: only their edges meet.
TEST(CollisionFilter, StripsOnEdgeDoNotPassThroughEachOther) {
  Sheets sheets(6, 1);
  std::vector<Vec3> x, move;
  for (int k = 0; k < 2; ++k)
    for (const Flat p : sheets.cloth.pieces[0].lattice->nodes) {
      const double along = p.u - 2.6 * kFilterCell;
      x.push_back(k == 0 ? Vec3{along, 0.012 + p.v, 0} : Vec3{0, p.v, along});
      move.push_back(k == 0 ? Vec3{0, -0.05, 0} : Vec3{});
    }
  ASSERT_GT(sheets.crossedOnTheWay(x, move), 0);
  sheets.contact->detect({x}, sheets.workers);
  sheets.contact->limitMove(x, move, sheets.workers);
  EXPECT_EQ(sheets.crossedOnTheWay(x, move), 0);
  EXPECT_LT(move[0].y, 0) << "it goes as far as it may";
}

// A sheet on its corner, over the middle of each face of another in turn: there is one pair, that corner and that face,
// and all hangs on its being found.
TEST(CollisionFilter, ACornerAloneDoesNotPassThroughAFace) {
  const auto lattice = gridLattice(3, 3, kFilterCell);
  for (const std::size_t poking : {0u, 1u})
    for (const Triangle& face : lattice->faces) {
      Sheets sheets(3, 3);
      const Flat spot = (lattice->nodes[face[0]] + lattice->nodes[face[1]] + lattice->nodes[face[2]]) * (1.0 / 3);
      const ClothState stands = standingBy(sheets.cloth, [&](std::size_t piece, Flat p) {
        if (piece != poking) return Vec3{p.u, p.v, 0};
        return Vec3{spot.u + 0.7 * (p.u - p.v), spot.v, 0.0004 + 0.7 * (p.u + p.v)};
      });
      std::vector<Vec3> move(sheets.cloth.nodeCount);
      Vec3& down = move[poking * 16];
      down = {0, 0, -0.0008};
      ASSERT_GT(sheets.crossedOnTheWay(stands.position, move), 0);
      const Vec3 wished = down;
      sheets.contact->limitMove(stands.position, move, sheets.workers);
      EXPECT_NE(down, wished);
      EXPECT_EQ(sheets.crossedOnTheWay(stands.position, move), 0);
      EXPECT_LT(down.z, -0.0001) << "it goes as far as it may";
    }
}

}  // namespace
}  // namespace karinui::test
