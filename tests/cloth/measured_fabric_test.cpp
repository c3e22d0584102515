// Readings from a table, made of a known fabric, give that fabric back; their errors are those of repeated trials.
#include "karinui/cloth/measured_fabric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cloth/helpers.h"

namespace karinui {
namespace {

using test::kGravity;

// What a ruler and scales without error would read of a fabric.
TableReadings readingsOf(const Fabric& fabric) {
  TableReadings t;
  t.swatchLength = 0.12, t.swatchWidth = 0.1;
  t.swatchMasses = {fabric.weight * 0.012};
  const double bias = 0.25 * (fabric.bendWarp + fabric.bendWeft) + 0.5 * std::sqrt(fabric.bendWarp * fabric.bendWeft);
  const double bends[] = {fabric.bendWarp, fabric.bendWeft, bias};
  t.stripLength = 0.2, t.stripWidth = 0.025;
  for (std::size_t g = 0; g < kGrains; ++g) {
    t.overhang[g].lengths = {2 * std::cbrt(bends[g] / (fabric.weight * kGravity))};  // Peirce
    for (const double mass : {0.2, 0.5}) {
      const double hangs = g == 2 ? mass / 10 : mass, force = hangs * kGravity / t.stripWidth, half = force / 2;
      double strain = (g == 0 ? fabric.warpCurve() : fabric.weftCurve()).strainAt(force);
      if (g == 2) {
        double low = 0, high = half / fabric.shear;  // of the angle between the threads
        for (int k = 0; k < 60; ++k) {
          const double angle = (low + high) / 2;
          (fabric.shear * (angle + fabric.shearStiffen * angle * angle * angle) < half ? low : high) = angle;
        }
        strain = (fabric.warpCurve().strainAt(half) + fabric.weftCurve().strainAt(half) + low) / 2;
      }
      t.hung[g].push_back({hangs, {t.stripLength * (1 + strain)}});
    }
  }
  t.thicknesses = {fabric.thickness};
  return t;
}

TEST(MeasuredFabric, EveryFabricOfTheShopIsFoundAgain) {
  for (const Fabric& fabric : presets()) {
    if (fabric.law != Fabric::Law::Woven) continue;
    const auto found = measuredFabric(readingsOf(fabric));
    ASSERT_TRUE(found) << fabric.name << ": " << text(found.error().what);
    EXPECT_EQ(found->like, fabric.name);
    const auto same = [&](double a, double b, const char* what) {
      EXPECT_NEAR(a, b, 0.002 * b) << fabric.name << what;
    };
    same(found->fabric.weight, fabric.weight, " weight");
    same(found->fabric.bendWarp, fabric.bendWarp, " bend warp");
    same(found->fabric.bendWeft, fabric.bendWeft, " bend weft");
    same(found->fabric.stretchWarp, fabric.stretchWarp, " stretch warp");
    same(found->fabric.stretchWeft, fabric.stretchWeft, " stretch weft");
    same(found->fabric.toeWeft, fabric.toeWeft, " toe weft");
    same(found->fabric.shear, fabric.shear, " shear");
    same(found->bendBias->value, found->bendBiasOfFabric, " bias");
  }
}

// A cloth between those of the shop: its curve goes through what was measured.
// Linen and jersey weigh the same: what tells them apart here is one reading, along one thread.
TEST(MeasuredFabric, OneReadingTellsFabricsOfOneWeightApart) {
  for (const char* name : {"linen", "jersey"}) {
    const TableReadings all = readingsOf(*preset(name));
    for (const std::size_t grain : {0u, 1u})
      for (const bool bent : {true, false}) {
        TableReadings t = all;
        for (std::size_t g = 0; g < kGrains; ++g) {
          if (g != grain || !bent) t.overhang[g] = {};
          if (g != grain || bent) t.hung[g].clear();
        }
        t.thicknesses.clear();
        const auto found = measuredFabric(t);
        ASSERT_TRUE(found) << text(found.error().what);
        EXPECT_EQ(found->like, name) << (bent ? "bent along " : "stretched along ") << grain;
      }
  }
}

TEST(MeasuredFabric, ACurveGoesThroughWhatWasMeasured) {
  TableReadings t = readingsOf(*preset("linen"));
  for (HungWeight& one : t.hung[0]) one.lengths[0] = t.stripLength + 1.7 * (one.lengths[0] - t.stripLength);
  const auto found = measuredFabric(t);
  ASSERT_TRUE(found);
  for (const HungWeight& one : t.hung[0]) {
    const double force = one.mass * kGravity / t.stripWidth;
    EXPECT_NEAR(found->fabric.warpCurve().strainAt(force), one.lengths[0] / t.stripLength - 1, 1e-5);
    EXPECT_NEAR(found->fabric.warpCurve().linearity(force), preset(found->like)->warpCurve().linearity(force), 0.05);
  }
  // One way only: the other goes in proportion.
  t.hung[1].clear(), t.hung[2].clear(), t.overhang[1] = {}, t.like = "linen";
  const auto one = measuredFabric(t);
  ASSERT_TRUE(one);
  const Fabric linen = *preset("linen");
  EXPECT_NEAR(one->fabric.stretchWeft / linen.stretchWeft, one->fabric.stretchWarp / linen.stretchWarp, 1e-9);
  EXPECT_NEAR(one->fabric.bendWeft / linen.bendWeft, one->fabric.bendWarp / linen.bendWarp, 1e-9);
}

// The elastica of a table: heaviness and where its tip lies.
TEST(MeasuredFabric, TheElasticaIsTheTablesAndPeirces) {
  const struct {
    double gamma, fall, reach;
  } rows[] = {{1, .12347, .99125},  {2, .23851, .96689},  {5, .49591, .84666},
              {10, .70020, .65635}, {20, .82988, .44523}, {50, .90792, .24502}};
  for (const auto& row : rows)
    EXPECT_NEAR(elasticaWeight(std::atan2(row.fall, row.reach)), row.gamma, 0.002 * row.gamma);
  EXPECT_NEAR(std::cbrt(elasticaWeight(kPeirceAngle)), 2, 0.001);
}

// Hands that read wrong by as much as is said, many times over: the numbers spread as is told. With angles
// and masses read exactly, what ruler and lengths do is not lost beside them.
TEST(MeasuredFabric, ErrorsAreThoseOfRepeatedTrials) {
  constexpr int kTrials = 200;
  TableReadings exact = readingsOf(*preset("cotton"));
  exact.scales = 0.00005;
  for (const bool lengthsAlone : {false, true}) {
    if (lengthsAlone) exact.angle = exact.scales = 0;
    std::mt19937 chance(7);
    const auto off = [&](double by) { return by > 0 ? std::normal_distribution<double>(0, by)(chance) : 0; };
    std::array<std::vector<double>, 3> found;
    MeasuredFabric one;
    for (int trial = 0; trial < kTrials; ++trial) {
      TableReadings t = exact;
      t.like = "cotton", t.thicknesses.clear();
      t.swatchLength += off(t.ruler), t.swatchWidth += off(t.ruler), t.swatchMasses[0] += off(t.scales);
      t.overhang[0] = {{exact.overhang[0].lengths[0] + off(t.ruler)}, {kPeirceAngle + off(t.angle)}};
      t.overhang[1] = t.overhang[2] = {};
      t.stripLength += off(t.ruler);
      for (HungWeight& hung : t.hung[0]) hung.lengths[0] += off(t.ruler);
      t.hung[0].erase(t.hung[0].begin());
      t.hung[1].clear(), t.hung[2].clear();
      const auto measured = measuredFabric(t);
      ASSERT_TRUE(measured) << text(measured.error().what);
      if (trial == 0) one = *measured;
      found[0].push_back(std::log(measured->fabric.weight));
      found[1].push_back(std::log(measured->fabric.bendWarp));
      found[2].push_back(std::log(measured->fabric.stretchWarp));
    }
    const double Fabric::*fields[] = {&Fabric::weight, &Fabric::bendWarp, &Fabric::stretchWarp};
    for (std::size_t k = 0; k < found.size(); ++k) {
      double mean = 0, spread = 0;
      for (const double x : found[k]) mean += x / kTrials;
      for (const double x : found[k]) spread += (x - mean) * (x - mean) / (kTrials - 1);
      for (const MeasuredNumber& number : one.numbers)
        if (number.field == fields[k]) {
          const double told = number.value.error / number.value.value;
          EXPECT_NEAR(told / std::sqrt(spread), 1, 0.2) << k << " " << told << " lengths alone " << lengthsAlone;
        }
    }
  }
  // More readings mend what is chance, not what is the tool's.
  EXPECT_NEAR(meanOf({1, 1.2, 0.8, 1, 1.1, 0.9}, 0).error, 0.0577, 1e-4);
  EXPECT_NEAR(meanOf({1, 1, 1, 1}, 0.3).error, 0.3, 1e-12);
}

TEST(MeasuredFabric, RefusesWhatNoClothDoes) {
  const auto why = [](const TableReadings& t) {
    const auto found = measuredFabric(t);
    return found ? std::string() : text(found.error().what);
  };
  const TableReadings good = readingsOf(*preset("cotton"));
  EXPECT_EQ(why(good), "");
  TableReadings t = good;
  t.swatchMasses.clear();
  EXPECT_NE(why(t).find("swatch"), std::string::npos);
  t = good, t.overhang[1].angles = {1.5};
  EXPECT_NE(why(t).find("along the weft"), std::string::npos);
  t = good, t.overhang[0].lengths.push_back(std::nan(""));
  EXPECT_NE(why(t), "");
  t = good, t.hung[0][0].lengths = {0.19};
  EXPECT_NE(why(t).find("must be longer"), std::string::npos);
  t = good, t.hung[2] = {{0.5, {0.2005}}};
  EXPECT_NE(why(t).find("bias"), std::string::npos);
  t = good, t.stripWidth = 0;
  EXPECT_NE(why(t).find("say how far apart its marks are"), std::string::npos);
  t = good, t.swatchMasses = {100 * good.swatchMasses.front()};
  EXPECT_NE(why(t).find("Weight of a square metre"), std::string::npos);
  t = good, t.like = "gold";
  EXPECT_NE(why(t).find("gold"), std::string::npos);
}

// The table of docs/user/fabrics.md: what the simulated tester makes of the shop's fabrics, of which the line from
// drape to bending was drawn.
TEST(MeasuredFabric, BendingIsToldByTheDrapeOfADisc) {
  const std::pair<const char*, double> drapes[] = {{"jersey", 0.34}, {"silk", 0.38},         {"viscose", 0.42},
                                                   {"velvet", 0.55}, {"wool suiting", 0.56}, {"cotton", 0.65},
                                                   {"linen", 0.69},  {"denim", 0.76}};
  for (const auto& [name, drape] : drapes) {
    const auto fabric = preset(name);
    ASSERT_TRUE(fabric);
    TableReadings t;
    t.swatchLength = 0.3, t.swatchWidth = 0.3, t.swatchMasses = {fabric->weight * 0.09}, t.scales = 1e-5;
    t.drapes = {drape};
    const auto found = measuredFabric(t);
    ASSERT_TRUE(found) << text(found.error().what);
    ASSERT_EQ(found->numbers.size(), 3u);
    const Uncertain warp = found->numbers[1].value, weft = found->numbers[2].value;
    const double mean = (warp.value + weft.value) / 2, error = (warp.error + weft.error) / 2;
    EXPECT_NEAR(mean, (fabric->bendWarp + fabric->bendWeft) / 2, 2.5 * error) << name;
    EXPECT_GT(error / mean, 0.15) << name << ": a disc does not tell bending better than that";
    EXPECT_LT(error / mean, 0.25) << name;
  }
}

TEST(MeasuredFabric, ADiscStandsInPlaceOfStrips) {
  TableReadings t = readingsOf(*preset("cotton"));
  t.drapes = {0.64, 0.62};
  const auto both = measuredFabric(t);
  ASSERT_FALSE(both);
  EXPECT_NE(text(both.error().what).find("by strips or by a disc"), std::string::npos);
  t.overhang = {};
  EXPECT_TRUE(measuredFabric(t));
  t.drapes = {0.05};
  const auto limp = measuredFabric(t);
  ASSERT_FALSE(limp);
  EXPECT_NE(text(limp.error().what).find("15.0 and 93.0 %"), std::string::npos) << text(limp.error().what);
}

}  // namespace
}  // namespace karinui
