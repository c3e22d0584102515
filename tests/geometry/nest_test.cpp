#include "karinui/geometry/nest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/ring_distance.h"
#include "geometry/shapes.h"

namespace karinui {
namespace {

using test::Numbers;

// Stars and boxes with bays, as pattern pieces have them.
Ring anyPiece(Numbers& numbers) {
  Ring ring;
  const int count = 5 + static_cast<int>(numbers.below(12));
  for (int n = 0; n < count; ++n) {
    const double a = 2 * std::numbers::pi * n / count, r = numbers.between(0.08, 0.3);
    ring.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return ring;
}

Ring carried(Ring ring, Flat by) {
  for (Flat& p : ring) p += by;
  return ring;
}
Ring turned(Ring ring) {
  for (Flat& p : ring) p = -p;
  return ring;
}

struct Task {
  std::vector<NestShape> shapes;
  std::vector<NestItem> items;
  NestSettings settings;
};
Task anyTask(unsigned seed) {
  Numbers numbers(seed);
  Task task;
  const std::size_t kinds = 2 + numbers.below(4);
  for (std::size_t k = 0; k < kinds; ++k) {
    const Ring ring = anyPiece(numbers);
    const Flat reference = ring[numbers.below(ring.size())];
    task.shapes.push_back({ring, reference});
    task.shapes.push_back({turned(ring), -reference});
    for (std::size_t n = 1 + numbers.below(3); n > 0; --n) task.items.push_back({{2 * k, 2 * k + 1}, false});
  }
  task.settings.width = numbers.between(0.7, 1.5);
  task.settings.gap = seed % 3 == 0 ? 0 : numbers.between(0.001, 0.02);
  task.settings.across = seed % 4 == 1 ? numbers.between(0.01, 0.05) : 0;
  task.settings.along = seed % 4 >= 2 ? numbers.between(0.01, 0.08) : 0;
  task.settings.tries = 80;
  task.settings.seed = seed;
  return task;
}

bool onRepeat(double value, double repeat) {
  const double steps = value / repeat;
  return std::abs(steps - std::round(steps)) * repeat < 1e-6;
}

TEST(Nest, NothingOverlapsAndAllLiesOnTheStrip) {
  Workers workers(2);
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const Task task = anyTask(seed);
    const auto nested = nest(task.shapes, task.items, task.settings, workers, Token());
    ASSERT_TRUE(nested) << seed;
    ASSERT_FALSE(nested->homeless) << seed;
    ASSERT_EQ(nested->places.size(), task.items.size());
    std::vector<Ring> laid;
    for (const NestPlace& place : nested->places) {
      const std::size_t nth = static_cast<std::size_t>(&place - nested->places.data());
      const auto& ways = task.items[nth].ways;
      ASSERT_NE(std::find(ways.begin(), ways.end(), place.way), ways.end());
      laid.push_back(carried(task.shapes[place.way].ring, place.at));
      for (const Flat p : laid.back()) {
        EXPECT_GE(p.u, -1e-9) << seed;
        EXPECT_LE(p.u, nested->length + 1e-9) << seed;
        EXPECT_GE(p.v, -1e-9) << seed;
        EXPECT_LE(p.v, task.settings.width + 1e-9) << seed;
      }
      const Flat reference = task.shapes[place.way].reference + place.at;
      EXPECT_TRUE(task.settings.across == 0 || onRepeat(reference.v, task.settings.across)) << seed;
      EXPECT_TRUE(task.settings.along == 0 || onRepeat(reference.u, task.settings.along)) << seed;
    }
    for (std::size_t i = 0; i < laid.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(apart(laid[i], laid[j]), task.settings.gap) << seed << ": " << i << " and " << j;
  }
}

TEST(Nest, SquaresFillTheStrip) {
  Workers workers(1);
  const Ring square{{0, 0}, {0.25, 0}, {0.25, 0.25}, {0, 0.25}};
  NestSettings settings;
  settings.width = 1.001, settings.gap = 0, settings.tries = 16;
  const auto nested = nest({{square, {}}}, std::vector<NestItem>(8, NestItem{{0}, false}), settings, workers, Token());
  ASSERT_TRUE(nested);
  EXPECT_NEAR(nested->length, 0.5, 1e-3);
}

TEST(Nest, TrianglesLieHeadToToe) {
  Workers workers(1);
  const Ring wedge{{0, 0}, {0.8, 0}, {0, 0.4}};
  NestSettings settings;
  settings.width = 0.402, settings.gap = 0, settings.tries = 200;
  const auto nested = nest({{wedge, {}}, {turned(wedge), {}}}, std::vector<NestItem>(2, NestItem{{0, 1}, false}),
                           settings, workers, Token());
  ASSERT_TRUE(nested);
  EXPECT_LT(nested->length, 0.815);  // by their boxes 1.6
}

TEST(Nest, WhatLiesOnTheEdgeStaysThere) {
  Workers workers(1);
  const Ring half{{0, 0}, {0.4, 0}, {0.4, 0.2}, {0.2, 0.1}, {0, 0.2}};
  NestSettings settings;
  settings.width = 0.75, settings.tries = 80;
  const std::vector<NestItem> items{{{0}, true}, {{0}, false}, {{0}, true}};
  const auto nested = nest({{half, {}}}, items, settings, workers, Token());
  ASSERT_TRUE(nested);
  EXPECT_EQ(nested->places[0].at.v, 0);
  EXPECT_EQ(nested->places[2].at.v, 0);
  EXPECT_LT(nested->length, 0.9);  // the third lies beside one of them
}

TEST(Nest, SameBitsOnAnyThreads) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Task task = anyTask(seed);
    Workers one(1), three(3);
    const auto a = nest(task.shapes, task.items, task.settings, one, Token());
    const auto b = nest(task.shapes, task.items, task.settings, three, Token());
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->length, b->length);
    for (std::size_t i = 0; i < a->places.size(); ++i) {
      EXPECT_EQ(a->places[i].at, b->places[i].at);
      EXPECT_EQ(a->places[i].way, b->places[i].way);
    }
  }
}

TEST(Nest, MoreTriesTakeNoMoreCloth) {
  Workers workers(2);
  double first = 0, last = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Task task = anyTask(seed);
    task.settings.across = task.settings.along = 0;
    for (const int tries : {0, 800}) {
      task.settings.tries = tries;
      const auto nested = nest(task.shapes, task.items, task.settings, workers, Token());
      ASSERT_TRUE(nested);
      (tries == 0 ? first : last) += nested->length;
    }
  }
  EXPECT_LT(last, 0.98 * first);
}

TEST(Nest, TellsWhatHasNoPlace) {
  Workers workers(1);
  const Ring tall{{0, 0}, {0.1, 0}, {0.1, 0.9}, {0, 0.9}}, low{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}};
  NestSettings settings;
  settings.width = 0.8;
  const auto nested = nest({{low, {}}, {tall, {}}}, {{{0}, false}, {{1}, false}}, settings, workers, Token());
  ASSERT_TRUE(nested);
  EXPECT_EQ(nested->homeless, 1u);
  EXPECT_TRUE(nested->places.empty());
  Token stopped;
  stopped.cancel();
  EXPECT_FALSE(nest({{low, {}}}, {{{0}, false}}, settings, workers, stopped));
}

// Stripes and room that agree but for what is lost in the arithmetic: a search that asks two ways whether there is a
// place, and is told yes and no, never ends.
TEST(Nest, EndsWhereStripesHardlyMissTheirRoom) {
  const auto box = [](double wide, double high) { return Ring{{0, 0}, {wide, 0}, {wide, high}, {0, high}}; };
  NestSettings settings;
  settings.width = 1, settings.gap = 0.005, settings.across = 0.1, settings.tries = 400;
  Workers workers(1);
  {  // the one stripe lies half a thousandth of a micrometre beyond the room
    const double reach = 0.03;
    const std::vector<NestShape> shapes{{box(0.2, 1 - reach + 5e-10), {0, 0.1 - reach}}};
    const auto laid = nest(shapes, {{{0}, false}, {{0}, false}}, settings, workers, Token());
    ASSERT_TRUE(laid);
    EXPECT_FALSE(laid->homeless);
    for (const NestPlace& place : laid->places) EXPECT_NEAR(place.at.v, reach, 1e-8);
  }
  {  // the stripe beside a piece lies a ten-thousandth of a micrometre within its gap
    const double high = 0.2 - settings.gap - 2e-4 + 1e-9 + 5e-11;
    const std::vector<NestShape> shapes{{box(0.3, high), {0, 0}}};
    const auto laid = nest(shapes, {{{0}, false}, {{0}, false}, {{0}, false}}, settings, workers, Token());
    ASSERT_TRUE(laid);
    for (const NestPlace& place : laid->places)
      EXPECT_NEAR(place.at.v / settings.across, std::round(place.at.v / settings.across), 1e-8);
  }
}

// Turned half round a piece may have a stripe within the cloth that it has not as it is.
TEST(Nest, LaysWhatHasAPlaceOneWayOnly) {
  NestSettings settings;
  settings.width = 0.95, settings.across = 0.1, settings.tries = 400;
  const Ring ring{{0, 0}, {0.3, 0}, {0.3, 0.9}, {0, 0.9}};
  Workers workers(1);
  const auto laid =
      nest({{ring, {0, 0.02}}, {ring, {0, 0.07}}}, {{{0, 1}, false}, {{0, 1}, false}}, settings, workers, Token());
  ASSERT_TRUE(laid);
  ASSERT_EQ(laid->places.size(), 2u);
  for (const NestPlace& place : laid->places) {
    EXPECT_EQ(place.way, 1u);
    EXPECT_NEAR(place.at.v, 0.03, 1e-8);
  }
}

}  // namespace
}  // namespace karinui
