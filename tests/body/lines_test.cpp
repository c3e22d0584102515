#include "karinui/body/lines.h"
#include "karinui/body/sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace karinui {
namespace {

using testing::HasSubstr;

BodyPtr mannequin(std::string_view size) {
  Workers workers(1);
  const Token quiet;
  return *makeMannequin(*builtInSize(size), workers, quiet);
}

// The same skin as a reader of files hands it over: no chart, no landmarks.
BodyPtr stranger(const Body& body) {
  Body::Parts parts;
  parts.name = "stranger";
  parts.mesh = body.mesh();
  return *Body::make(std::move(parts));
}

const BodyLine& line(const Body& body, std::string_view name) {
  const BodyLine* found = bodyLine(body, name);
  EXPECT_TRUE(found) << name;
  static const BodyLine none{"none", {{0, 0, 0}, {0, 0, 0}}, false, 0};
  return found ? *found : none;
}

// The sharpest turn over 3 cm of a line, in degrees.
double sharpest(const BodyLine& line) {
  double most = 0;
  const int n = static_cast<int>(line.points.size()), k = 5;
  for (int i = line.closed ? 0 : k; i + (line.closed ? 0 : k) < n; ++i) {
    const auto at = [&](int j) { return line.points[static_cast<std::size_t>((j + n) % n)]; };
    const Vec3 in = at(i) - at(i - k), out = at(i + k) - at(i);
    most = std::max(most, std::atan2(length(cross(in, out)), dot(in, out)) * 57.2958);
  }
  return most;
}

TEST(BodyLines, EveryLineIsOnTheSkinOfEveryFigure) {
  for (const char* size : {"jis9ar", "eu38", "eu50"}) {
    const BodyPtr own = mannequin(size), other = stranger(*own);
    for (const Body* body : {own.get(), other.get()}) {
      SCOPED_TRACE(std::string(size) + (body == own.get() ? "" : " as a stranger's mesh"));
      EXPECT_EQ(body->lines().size(), bodyLineNames().size());
      for (const BodyLine& one : body->lines()) {
        SCOPED_TRACE(one.name);
        EXPECT_GT(one.length, 0.08);
        if (!one.closed || one.length > 0.3) {
          EXPECT_LT(sharpest(one), 75) << "a line is a fair curve";
        }
        if (one.name.starts_with("armhole")) {
          EXPECT_LT(one.length, 0.56) << "under the arm, not over it";
        }
        for (const Vec3 p : one.points) EXPECT_LT(body->bvh().nearest(p)->distance, 1e-6);
        for (std::size_t i = 1; i < one.points.size(); ++i)
          EXPECT_LT(distance(one.points[i - 1], one.points[i]), 0.015) << "without a gap, " << i;
      }
    }
  }
}

TEST(BodyLines, LieWhereATailorWouldTapeThem) {
  const BodyPtr body = mannequin("jis9ar");
  const auto& marks = body->landmarks();
  EXPECT_NEAR(line(*body, "waist").at(0).y, marks.at("waist_front").y, 0.003);
  EXPECT_NEAR(line(*body, "bust").at(0.25).x, line(*body, "bust").at(0.75).x * -1, 0.004);
  EXPECT_NEAR(line(*body, "waist").length, body->measured().value.at("waist_girth"), 0.02);
  double away = 1;
  line(*body, "princess_front_left").nearest(marks.at("bust_left"), away);
  EXPECT_LT(away, 0.006) << "over the bust point";
  line(*body, "armhole_left").nearest(marks.at("shoulder_left"), away);
  EXPECT_LT(away, 0.012);
  const BodyLine& side = line(*body, "side_left");
  line(*body, "armhole_left").nearest(side.at(0), away);
  EXPECT_LT(away, 0.012) << "the side begins at the armhole";
  for (const double share : {0.05, 0.2, 0.3, 0.45}) EXPECT_GT(side.at(share).x, 0.09) << share;
  for (const Vec3 p : line(*body, "centre_front").points) EXPECT_NEAR(p.x, 0, 0.002);
  EXPECT_LT(line(*body, "crotch").at(0.5).y, marks.at("crotch").y + 0.01) << "between the legs";
}

TEST(BodyLines, APlaceOnALineIsWrittenReadMirroredAndFoundOnAnotherFigure) {
  const auto point = parseBodyPoint("line:side_left@0.25");
  ASSERT_TRUE(point);
  EXPECT_EQ(text(*point), "line:side_left@0.25");
  const BodyPtr body = mannequin("jis9ar"), other = mannequin("eu50");
  const auto here = body->find(*point);
  ASSERT_TRUE(here);
  EXPECT_LT(distance(at(body->mesh(), *here), line(*body, "side_left").at(0.25)), 1e-4);
  const auto there = body->find(*body->mirrored(*point));
  ASSERT_TRUE(there);
  const Vec3 left = at(body->mesh(), *here), right = at(body->mesh(), *there);
  EXPECT_LT(distance(left, {-right.x, right.y, right.z}), 0.004);
  const auto ring = body->mirrored(*parseBodyPoint("line:waist@0.2"));
  ASSERT_TRUE(ring);
  EXPECT_EQ(text(*ring), "line:waist@0.8");
  const auto moved = other->find(*point);
  ASSERT_TRUE(moved);
  EXPECT_LT(distance(at(other->mesh(), *moved), line(*other, "side_left").at(0.25)), 1e-4);
}

TEST(BodyLines, WhatIsNoPlaceOnALineIsRefusedWithTheNamesThereAre) {
  EXPECT_FALSE(parseBodyPoint("line:side_left"));
  EXPECT_FALSE(parseBodyPoint("line:side_left@1.2"));
  const auto unknown = parseBodyPoint("line:belly@0.2");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(text(unknown.error().what), HasSubstr("princess_front_left"));
}

// What a piece is drawn by: each corner once, on both lines, at the same place of either side.
TEST(BodyLines, CrossWhereATailorMarksThem) {
  for (const char* size : {"jis9ar", "eu50"}) {
    const BodyPtr body = mannequin(size);
    const auto crossings = lineCrossings(*body);
    const auto met = [&](std::string_view a, std::string_view b) {
      std::vector<Vec3> places;
      for (const LineCrossing& c : crossings) {
        const BodyLine &one = body->lines()[c.a], &other = body->lines()[c.b];
        EXPECT_LT(distance(one.at(c.onA), other.at(c.onB)), 0.015) << one.name << " " << other.name;
        if ((one.name == a && other.name == b) || (one.name == b && other.name == a)) places.push_back(c.place);
      }
      return places;
    };
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"side_left", "armhole_left"},
                                                                               {"side_left", "waist"},
                                                                               {"side_left", "hip"},
                                                                               {"shoulder_left", "armhole_left"},
                                                                               {"shoulder_left", "neck_base"},
                                                                               {"centre_front", "neck_base"},
                                                                               {"centre_front", "hip"},
                                                                               {"centre_back", "hip"}}) {
      SCOPED_TRACE(std::string(size) + ": " + a + " and " + b);
      const auto places = met(a, b), mirrored = met(mirroredName(a), mirroredName(b));
      ASSERT_EQ(places.size(), 1u);
      ASSERT_EQ(mirrored.size(), 1u);
      EXPECT_NEAR(places[0].x, -mirrored[0].x, 0.004);
      EXPECT_NEAR(places[0].y, mirrored[0].y, 0.004);
    }
    EXPECT_TRUE(met("waist", "hip").empty());
    EXPECT_TRUE(met("side_left", "side_right").empty());
  }
}

}  // namespace
}  // namespace karinui
