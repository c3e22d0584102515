// How much nearer to each other nodes may have come, against all pairs of them.
#include "cloth/approach_bound.h"

#include <gtest/gtest.h>

#include <random>

namespace karinui::test {
namespace {

constexpr double kStood = 0.02, kNear = 0.012;  // metres: pairs that stood so far apart, and how near none is to come

struct Crowd {
  explicit Crowd(unsigned seed) : random(seed) {
    for (int k = 0; k < 400; ++k) x.push_back(anywhere(0.1));
  }
  Vec3 anywhere(double size) { return Vec3{by(random), by(random), by(random)} * size; }
  // All carried along and turned, each a little by itself, and the two halves towards each other.
  std::vector<Vec3> gone(Vec3 way, Vec3 axis, double own, double closing = 0) {
    std::vector<Vec3> to;
    for (const Vec3 p : x)
      to.push_back(way + cross(axis, p) + anywhere(own) + Vec3{p.x < 0 ? closing : -closing, 0, 0});
    return to;
  }
  std::mt19937 random;
  std::uniform_real_distribution<double> by{-1, 1};
  std::vector<Vec3> x;
};

std::vector<Vec3> sums(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> sum = a;
  for (std::size_t k = 0; k < a.size(); ++k) sum[k] += b[k];
  return sum;
}

// What it lets pass has no pair that came too near; what it does not may have some.
TEST(ApproachBound, NeverLetsAPairPass) {
  int passed = 0, refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Crowd crowd(seed);
    ApproachBound bound;
    bound.make(crowd.x, 0.03);
    const double size = 0.0001 * std::exp2(seed % 5), share = 1.2, closing = 0.00001 * (seed % 300);
    const std::vector<Vec3> now = sums(crowd.x, crowd.gone(crowd.anywhere(0.01), crowd.anywhere(0.001), size, closing));
    const std::vector<Vec3> move = crowd.gone(crowd.anywhere(0.01), crowd.anywhere(0.001), size, closing);
    const bool passes = bound.excess({now, move, share}, kStood, kNear) <= 0;
    bool near = false;
    for (std::size_t a = 0; a < now.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        near = near || (length(crowd.x[a] - crowd.x[b]) >= kStood &&
                        length(now[a] - now[b]) - share * length(move[a] - move[b]) < kNear);
    EXPECT_FALSE(passes && near) << seed;
    (passes ? passed : refused) += 1;
  }
  EXPECT_GT(passed, 100);
  EXPECT_GT(refused, 50);
}

TEST(ApproachBound, CountsHowTheyPartNotHowFarTheyGo) {
  Crowd crowd(1);
  ApproachBound bound;
  bound.make(crowd.x, 0.03);
  const std::vector<Vec3> carried = sums(crowd.x, crowd.gone({0.02, 0, 0}, {}, 0));
  EXPECT_NEAR(bound.excess({carried, {}}, kStood, kNear), kNear - kStood, 1e-12);
  const std::vector<Vec3> move(crowd.x.size(), Vec3{0, 0.02, 0});
  EXPECT_NEAR(bound.excess({carried, move, 1.2}, kStood, kNear), kNear - kStood, 1e-12);
  // One goes otherwise.
  std::vector<Vec3> parted = carried;
  parted[7] += Vec3{0, 0, kStood - kNear + 1e-4};
  EXPECT_GT(bound.excess({parted, {}}, kStood, kNear), 0);
}

}  // namespace
}  // namespace karinui::test
