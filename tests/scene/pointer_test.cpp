#include "karinui/scene/pointer.h"

#include <gtest/gtest.h>

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

TEST(PointerSample, WhatIsNoLineIsRefused) {
  for (const char* line : {"", "press", "press space 0 1 2", "fly space 0 0 0 0 0 0 1 0 0 1",
                           "press table 0 1 x reach 1", "press table 0 1 2 reach", "press table 0 1 2 reach 1 loudly"})
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
