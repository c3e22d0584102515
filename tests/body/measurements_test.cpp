#include <gtest/gtest.h>

#include <cmath>

#include "karinui/body/body.h"
#include "karinui/body/sizes.h"

namespace karinui {
namespace {

TEST(Measurements, NamesOfEverySystemMeanTheSame) {
  for (const char* name : {"bust_girth", "bust", "bustGirth", "Bust Girth", "chest", "bust_circ"})
    EXPECT_EQ(measurementKey(name).value(), "bust_girth") << name;
  EXPECT_EQ(measurementKey("seat").value(), "hip_girth");
  EXPECT_EQ(measurementKey("biceps").value(), "upper_arm_girth");
  EXPECT_EQ(measurementKey("inseam").value(), "crotch_height");
  for (const auto& key : measurementKeys()) EXPECT_EQ(measurementKey(key).value(), key);
}

TEST(Measurements, AnUnknownNameListsNearOnes) {
  const auto result = measurementKey("waste_girth");
  ASSERT_FALSE(result);
  EXPECT_NE(text(result.error().what).find("waist_girth"), std::string::npos);
  EXPECT_EQ(text(measurementKey("taille").error().what), "There is no measurement called \"taille\".");
  EXPECT_FALSE(measurementKey(""));
  EXPECT_FALSE(measurementKey(std::string(100000, 'x')));
}

TEST(Measurements, BuiltInSizes) {
  for (const auto& size : builtInSizes()) EXPECT_TRUE(builtInSize(size));
  for (const SizeSeries& series : sizeSeries()) {
    bool usual = false;
    for (std::size_t i = 0; i < series.sizes.size(); ++i) {
      const BuiltInSize& size = series.sizes[i];
      usual = usual || size.name == series.usual;
      EXPECT_EQ(builtInSize(size.name)->sex, series.sex) << size.name;
      EXPECT_EQ(plainSize(size.name), size.name);
      if (i == 0) continue;
      const BuiltInSize& smaller = series.sizes[i - 1];
      EXPECT_TRUE(smaller.bust < size.bust && smaller.waist < size.waist && smaller.hip < size.hip &&
                  smaller.height <= size.height)
          << smaller.name << " before " << size.name;
    }
    EXPECT_TRUE(usual) << series.usual;
  }
  EXPECT_EQ(plainSize("EU 44 W"), "eu44w");
  EXPECT_EQ(plainSize("EU 38 W"), "eu38");
  EXPECT_EQ(plainSize("eu50m"), "eu50");
  EXPECT_EQ(plainSize("eu38m"), "eu38m") << "there is none";
  EXPECT_EQ(plainSize("my own"), "my own");
  EXPECT_DOUBLE_EQ(builtInSize("jis9ar")->value.at("waist_girth"), 0.64);
  EXPECT_EQ(builtInSize("eu50")->sex, Sex::Male);
  const auto none = builtInSize("EU 44");  // whose?
  ASSERT_FALSE(none);
  EXPECT_EQ(text(none.error().what), "There is no size called \"EU 44\". Sizes: eu44w, eu44m.");
}

TEST(Measurements, WhatNoBodyCanHaveIsRefused) {
  Workers workers(1);
  const Token token;
  const auto refusedWith = [&](std::map<std::string, double> value, const char* word) {
    const auto body = makeMannequin({Sex::Female, std::move(value)}, workers, token);
    ASSERT_FALSE(body) << word;
    EXPECT_NE(text(body.error().what).find(word), std::string::npos) << text(body.error().what);
  };
  refusedWith({{"bust_girth", 8.8}}, "bust_girth");
  refusedWith({{"height", std::nan("")}}, "height");
  refusedWith({{"waist_girth", -1}}, "waist_girth");
  refusedWith({{"height", 1.6}, {"crotch_height", 1.05}}, "crotch_height");
  refusedWith({{"bust_girth", 0.7}, {"waist_girth", 1.4}}, "waist_girth");
  refusedWith({{"bust_span", 0.2}}, "bust_span");
  refusedWith({{"elbow", 0.2}}, "elbow");
}

}  // namespace
}  // namespace karinui
