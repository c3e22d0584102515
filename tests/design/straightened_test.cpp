// A sheet photographed at a slant by a camera whose map is known.
#include "design/straightened.h"

#include <gtest/gtest.h>

#include <cmath>

#include "karinui/geometry/homography.h"

namespace karinui {
namespace {

// Black dots of 3 mm on white paper of 21 cm x 29.7 cm, seen by the camera.
struct Photograph {
  std::array<Flat, 4> sheet{Flat{0, 0}, {0.21, 0}, {0.21, 0.297}, {0, 0.297}};
  std::array<Flat, 4> seen{Flat{150, 750}, {850, 710}, {750, 125}, {240, 165}};  // pixels, down
  std::vector<Flat> dots{{0.03, 0.04}, {0.18, 0.05}, {0.10, 0.15}, {0.04, 0.26}, {0.17, 0.25}};
  PrintPixels image{1000, 900, {}};
  Photograph() {
    const Homography paper = *Homography::through(seen, sheet);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Flat on = paper({x + 0.5, y + 0.5});
        bool black = false;
        for (const Flat dot : dots) black = black || distance(on, dot) < 0.003;
        for (int c = 0; c < 3; ++c) image.rgb.push_back(black ? 0 : 255);
      }
  }
};

TEST(Straightened, DotsComeToWhereTheyAreOnThePaper) {
  const Photograph photo;
  const auto made = straightened(photo.image, photo.seen, {0.21, 0.297});
  ASSERT_TRUE(made) << text(made.error().what);
  const double pitch = made->width / made->image.width;
  for (const Flat dot : photo.dots) {
    // The middle of what is dark near the place where it should be.
    Flat sum;
    double weight = 0;
    for (int y = 0; y < made->image.height; ++y)
      for (int x = 0; x < made->image.width; ++x) {
        const Flat on = made->middle +
                        Flat{(x + 0.5 - 0.5 * made->image.width) * pitch, (0.5 * made->image.height - y - 0.5) * pitch};
        if (distance(on, dot) > 0.01) continue;
        const double dark =
            255 - made->image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(made->image.width) +
                                       static_cast<std::size_t>(x))];
        sum += on * dark, weight += dark;
      }
    ASSERT_GT(weight, 0);
    EXPECT_LT(distance(sum * (1 / weight), dot), 0.0003);
  }
}

TEST(Straightened, ASideKeepsItsNearestDirectionAndNothingIsMirrored) {
  const Photograph photo;
  // Begun at another corner, and gone round the other way: the same picture, but for where it begins.
  const auto first = straightened(photo.image, photo.seen, {0.21, 0.297});
  const auto upwards =
      straightened(photo.image, {photo.seen[1], photo.seen[2], photo.seen[3], photo.seen[0]}, {0.297, 0.21});
  const auto round =
      straightened(photo.image, {photo.seen[1], photo.seen[0], photo.seen[3], photo.seen[2]}, {0.21, 0.297});
  ASSERT_TRUE(first && upwards && round);
  for (const auto* other : {&*upwards, &*round}) {
    EXPECT_EQ(other->image.width, first->image.width);
    EXPECT_NEAR(other->width, first->width, 1e-9);
    EXPECT_LT(distance(other->middle + Flat{0.21, 0}, first->middle), 1e-9);
    EXPECT_EQ(other->image.rgb, first->image.rgb);
  }
}

TEST(Straightened, WhatIsNoRectangleIsRefused) {
  const Photograph photo;
  EXPECT_FALSE(straightened(photo.image, {photo.seen[0], photo.seen[2], photo.seen[1], photo.seen[3]}, {0.21, 0.297}));
  const Flat inside = lerp(photo.seen[0], photo.seen[2], 0.3);
  EXPECT_FALSE(straightened(photo.image, {photo.seen[0], photo.seen[1], inside, photo.seen[3]}, {0.21, 0.297}))
      << "dented";
  EXPECT_FALSE(straightened(photo.image, photo.seen, {0, 0.297}));
}

}  // namespace
}  // namespace karinui
