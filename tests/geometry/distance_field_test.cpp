#include "karinui/geometry/distance_field.h"

#include <gtest/gtest.h>

#include <cstring>

#include "geometry/shapes.h"

namespace karinui {
namespace {

using test::append;
using test::ball;
using test::box;
using test::Numbers;

// A field with the mesh and the tree it is found from.
class Built {
 public:
  Built(TriangleMesh m, const DistanceField::Settings& settings)
      : mesh_(std::move(m)), bvh_(mesh_), field_(DistanceField::of(mesh_, bvh_, settings).value()) {}
  Built(const Built&) = delete;
  Built& operator=(const Built&) = delete;
  const DistanceField* operator->() const { return &field_; }

 private:
  const TriangleMesh mesh_;
  const Bvh bvh_;
  const DistanceField field_;
};

TEST(DistanceField, OfABallIsTheDistanceToItInTheBand) {
  const TriangleMesh m = ball({0.1, 0.2, 0.3}, 0.2, 6);
  const Built field(m, {0.005, 0.03});
  Numbers numbers(1);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p = Vec3{0.1, 0.2, 0.3} + numbers.point(0.4);
    const double d = distance(p, {0.1, 0.2, 0.3}) - 0.2;
    const auto s = field->sample(p);
    EXPECT_EQ(s.distance, field->distance(p));
    if (std::fabs(d) < 0.03 - 0.009) {
      EXPECT_NEAR(s.distance, d, 2e-4);
      // One-sided differences on a curved surface are off by cell / (2 radius) per axis.
      EXPECT_NEAR(length(s.gradient), 1, 0.03);
      EXPECT_GT(dot(normalized(s.gradient), normalized(p - Vec3{0.1, 0.2, 0.3})), 0.995);
    } else {
      EXPECT_EQ(s.distance > 0, d > 0);
      EXPECT_LE(std::fabs(s.distance), std::fabs(d) + 1e-3);
      EXPECT_GE(std::fabs(s.distance), 0.0209);
    }
  }
}

TEST(DistanceField, FarAwayIsALowerBoundThatGrows) {
  const Built field(box({0, 0, 0}, {0.3, 0.2, 0.1}), {0.01, 0.03});
  double last = 0;
  for (double x = 0.32; x < 5; x += 0.01) {
    const auto s = field->sample({x, 0.1, 0.05});
    EXPECT_LE(s.distance, x - 0.3 + 1e-6);
    EXPECT_GE(s.distance, last - 1e-6);
    last = s.distance;
  }
  EXPECT_GT(last, 4.5);
  EXPECT_GT(field->sample({5, 0.1, 0.05}).gradient.x, 0.99);
  EXPECT_GT(field->distance({0.5, 0.5, -3}), 2.9);
}

// The grid begins a whole number of cells before the low sides, so its points lie on them but for rounding.
TEST(DistanceField, FindsASideThatLiesOnTheGrid) {
  Numbers numbers(6);
  for (int n = 0; n < 30; ++n) {
    const Vec3 low = numbers.point(0.7), size = Vec3{0.06, 0.06, 0.06} + numbers.point(0.02);
    const TriangleMesh m = box(low, low + size);
    const Built field(m, {0.005, 0.03});
    const Bvh bvh(m);
    for (int k = 0; k < 200; ++k) {
      const Vec3 middle = low + size * 0.5, off = numbers.point(0.04);
      for (const Vec3 p : {middle + off, Vec3{low.x, middle.y, middle.z} + off * 0.3,
                           Vec3{middle.x, low.y, middle.z} + off * 0.3, Vec3{middle.x, middle.y, low.z} + off * 0.3})
        EXPECT_NEAR(field->distance(p), bvh.signedDistance(p), 0.006);
    }
  }
}

TEST(DistanceField, GradientIsTheDerivativeOfTheDistance) {
  const Built field(ball({}, 0.1, 4), {0.01, 0.03});
  Numbers numbers(2);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = numbers.point(0.3), along = normalized(numbers.point(1));
    const double step = 1e-7;
    const double slope = (field->distance(p + along * step) - field->distance(p - along * step)) / (2 * step);
    EXPECT_NEAR(dot(field->sample(p).gradient, along), slope, 0.2) << n;  // cells' borders have two slopes
  }
}

TEST(DistanceField, KeepsItsSignWhereTheSurfaceCrossesItself) {
  TriangleMesh m = ball({}, 0.1, 4);
  append(m, ball({0.12, 0, 0}, 0.1, 4));
  const Built field(m, {0.004, 0.02});
  EXPECT_LT(field->distance({0.06, 0, 0}), 0);
  EXPECT_LT(field->distance({-0.05, 0, 0}), 0);
  EXPECT_LT(field->distance({0.17, 0, 0}), 0);
  EXPECT_GT(field->distance({0.06, 0.1, 0}), 0);
  EXPECT_GT(field->distance({-0.12, 0, 0}), 0);
}

TEST(DistanceField, ABodyIsTheSameForAnyNumberOfThreadsAndOrderOfAsking) {
  const TriangleMesh m = test::readPlainObj(KARINUI_SHARED_DIR "/bodies/f_jis9ar.obj");
  if (m.faces.empty()) GTEST_SKIP() << "the shared bodies are not here";
  const Bvh bvh(m);
  const Built asked(m, {0.01, 0.03}), whole(m, {0.01, 0.03});
  Workers three(3);
  ASSERT_TRUE(whole->findAll(three, Token{}));
  Numbers numbers(3);
  std::vector<Vec3> places;
  for (int n = 0; n < 3000; ++n)
    places.push_back({numbers.between(-0.8, 0.8), numbers.between(0, 1.7), numbers.between(-0.3, 0.3)});
  std::vector<double> found(places.size());
  three.forBlocks(places.size(), 7, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = end; n > begin; --n) found[n - 1] = asked->distance(places[n - 1]);
  });
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double a = whole->distance(places[n]);
    ASSERT_EQ(std::memcmp(&a, &found[n], sizeof a), 0);
    const double exact = bvh.signedDistance(places[n]);
    if (std::fabs(exact) < 0.012) continue;  // a cell's diagonal from the surface the sign may wait
    EXPECT_EQ(a > 0, exact > 0) << exact;
    EXPECT_LE(std::fabs(a), std::fabs(exact) + 0.01);
  }
}

TEST(DistanceField, RefusesWhatHasNoInside) {
  TriangleMesh open = box({0, 0, 0}, {1, 1, 1});
  open.faces.pop_back();
  const auto refusal = DistanceField::of(open, Bvh(open), {});
  ASSERT_FALSE(refusal);
  EXPECT_EQ(text(refusal.error().what), "The surface is not closed: 3 edges are open, so it has no inside.");
  EXPECT_FALSE(DistanceField::of({}, Bvh(TriangleMesh{}), {}));
  const TriangleMesh huge = box({0, 0, 0}, {100, 100, 100});
  EXPECT_FALSE(DistanceField::of(huge, Bvh(huge), {}));
  EXPECT_FALSE(DistanceField::of(huge, Bvh(huge), {0, 0.1}));
  EXPECT_FALSE(DistanceField::of(huge, Bvh(huge), {std::nan(""), 0.1}));
}

TEST(DistanceField, StopsWhenAsked) {
  Workers workers(2);
  const Built field(ball({}, 0.3, 4), {});
  Token token;
  token.cancel();
  const auto stopped = field->findAll(workers, token);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, Error::Kind::Cancelled);
}

// Boxes turned by lot: near the skin the sign is that of the tree of boxes, the distance changes by no more than the
// way gone, and downhill along the gradient lies the skin.
TEST(DistanceField, OfAnyTurnedBoxLeadsToItsSkin) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    TriangleMesh m = box({-0.12, -0.08, -0.1}, {0.12, 0.08, 0.1});
    const Rigid turned = turnAbout(numbers.point(1), numbers.between(0, 3));
    for (Vec3& p : m.points) p = turned(p) + Vec3{0.3, 0.2, -0.1};
    const double cell = 0.005, band = 0.03;
    const Built field(m, {cell, band});
    const Bvh bvh(m);
    int near = 0, leading = 0;
    for (int n = 0; n < 3000; ++n) {
      const Vec3 p = Vec3{0.3, 0.2, -0.1} + numbers.point(0.2), q = p + numbers.point(0.01);
      const double exact = bvh.signedDistance(p);
      const auto s = field->sample(p);
      EXPECT_LE(std::abs(s.distance - field->distance(q)),
                1.8 * distance(p, q) + 1e-6);  // each axis by itself: sqrt(3)
      if (std::abs(exact) > cell) {
        EXPECT_EQ(s.distance > 0, exact > 0);
      }
      if (std::abs(exact) > band - 2 * cell) continue;
      ++near;
      EXPECT_NEAR(s.distance, exact, cell / 2);
      if (length(s.gradient) < 0.5) continue;  // on the ridge between two sides
      const Vec3 skin = p - normalized(s.gradient) * s.distance;
      leading += bvh.nearest(skin)->distance < 0.2 * std::abs(exact) + 1e-4;
    }
    EXPECT_GT(near, 300);
    EXPECT_GT(leading, near * 19 / 20);
  }
}

}  // namespace
}  // namespace karinui
