#include "karinui/scene/pointer.h"

#include <gtest/gtest.h>

#include <random>

#include "karinui/scene/icon.h"

namespace karinui {
namespace {

TEST(PointerSample, IsReadBackToTheBit) {
  PointerSample sample;
  sample.phase = PointerSample::Phase::Drag;
  sample.seconds = 0.1 + 0.2;
  sample.ray = {{1.0 / 3, 2, -3}, {0, 0.6, -0.8}};
  sample.facing = {0.1, 0.2, 0.3};
  sample.reach = 0.0123;
  sample.alt = true;
  const auto space = parsePointerSample(text(sample));
  ASSERT_TRUE(space);
  EXPECT_TRUE(*space == sample);
  sample = {};
  sample.where = PointerSample::Where::Table;
  sample.place = {1.0 / 7, -0.25};
  sample.shift = sample.control = true;
  const auto table = parsePointerSample(text(sample));
  ASSERT_TRUE(table);
  EXPECT_TRUE(*table == sample);
}

TEST(PointerSample, RandomPosesAreReadBackToTheBit) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> number;
  const auto some = [&](int most) { return static_cast<int>(random() % static_cast<std::uint64_t>(most)); };
  const auto vector = [&] { return Vec3{number(random), number(random) * 1e-7, number(random) * 1e5}; };
  for (int k = 0; k < 2000; ++k) {
    PointerSample sample;
    sample.phase = static_cast<PointerSample::Phase>(some(4));
    sample.seconds = std::fabs(number(random)) * 100;
    if (some(2)) {
      sample.where = PointerSample::Where::Table;
      sample.place = {number(random), number(random)};
    } else {
      sample.ray = {vector(), normalized(vector())};
      sample.facing = normalized(vector());
    }
    sample.reach = some(2) ? 0.01 : std::fabs(number(random));
    sample.shift = some(2), sample.control = some(2), sample.alt = some(2), sample.second = some(2);
    if (some(2)) {
      sample.tip = turnAbout(vector(), number(random));
      sample.tip->carry = vector();
    }
    if (some(2)) sample.trigger = number(random);
    if (some(2)) sample.grip = number(random);
    sample.device = static_cast<PointerSample::Device>(some(4));
    sample.hand = static_cast<PointerSample::Hand>(some(3));
    const auto again = parsePointerSample(text(sample));
    ASSERT_TRUE(again) << text(sample);
    ASSERT_TRUE(*again == sample) << text(sample);
  }
}

TEST(PointerSample, WhatAMouseDoesNotHaveIsNotWritten) {
  const std::string old = "drag space 0.25 0 1 2 0 0 -1 0 0 1 reach 0.01 shift";
  const auto sample = parsePointerSample(old);
  ASSERT_TRUE(sample);
  EXPECT_FALSE(sample->tip);
  EXPECT_EQ(text(*sample), old);
}

TEST(PointerSample, WhatIsNoLineIsRefused) {
  for (const char* line :
       {"", "press", "press space 0 1 2", "fly space 0 0 0 0 0 0 1 0 0 1", "press table 0 1 x reach 1",
        "press table 0 1 2 reach", "press table 0 1 2 reach 1 loudly", "press table 0 1 2 reach 1 tip 0 0 0 1 0 0",
        "press table 0 1 2 reach 1 device", "press table 0 1 2 reach 1 hand third"})
    EXPECT_FALSE(parsePointerSample(line)) << line;
}

TEST(Icon, EveryStrokeLiesOnItsSquare) {
  EXPECT_GE(icons().size(), 20u);
  for (const Icon& one : icons())
    for (const IconStroke& stroke : one.strokes) {
      EXPECT_GE(stroke.points.size(), 2u) << one.name;
      for (const Flat p : stroke.points) {
        EXPECT_TRUE(p.u >= 0 && p.u <= 24 && p.v >= 0 && p.v <= 24) << one.name;
      }
    }
}

}  // namespace
}  // namespace karinui
