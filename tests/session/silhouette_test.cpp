// The drape coefficient from photographs, on painted ones whose areas are known.
#include "karinui/session/silhouette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "karinui/cloth/drape_disc.h"

namespace karinui {
namespace {

constexpr int kWide = 640, kHigh = 480;
using Rgb = std::array<int, 3>;

// Cloth whose rim is at this distance from the middle, by the angle; its print is seen, and everything is a little
// noisy.
PrintPixels photograph(const std::function<double(double)>& rim, Rgb ground, Rgb cloth, int noise = 6,
                       int stripes = 30) {
  PrintPixels image{kWide, kHigh, {}};
  std::mt19937 dice(17);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      const double u = x + 0.5 - 330, v = y + 0.5 - 235;
      const bool on = std::hypot(u, v) < rim(std::atan2(v, u));
      const bool stripe = on && x % 20 < 4;
      for (std::size_t c = 0; c < 3; ++c) {
        const int value =
            (on ? cloth[c] : ground[c]) - (stripe ? stripes : 0) + static_cast<int>(dice() % 7) * noise / 6;
        image.rgb.push_back(static_cast<std::uint8_t>(std::clamp(value, 0, 255)));
      }
    }
  return image;
}
double disc(double) { return 200; }
// r^2 = a^2 + b^2 cos 7t has the area of a circle of radius a.
double folds(double turn) { return std::sqrt(165.0 * 165 + 60 * 60 * std::cos(7 * turn)); }

constexpr Rgb kTable{235, 230, 220}, kBlue{40, 60, 130}, kWhite{250, 250, 250}, kBlack{20, 20, 25};

TEST(Silhouette, CoversWhatItCovers) {
  const double whole = kWide * kHigh;
  const auto flat = coveredShare(photograph(disc, kTable, kBlue));
  ASSERT_TRUE(flat) << text(flat.error().what);
  EXPECT_NEAR(*flat, std::numbers::pi * 200 * 200 / whole, 0.001);
  const auto white = coveredShare(photograph(folds, kBlack, kWhite));  // light cloth on a dark ground
  ASSERT_TRUE(white) << text(white.error().what);
  EXPECT_NEAR(*white, std::numbers::pi * 165 * 165 / whole, 0.001);
}

TEST(Silhouette, TellsTheDrape) {
  const auto drape = drapeOfPhotographs(photograph(disc, kTable, kBlue), photograph(folds, kTable, kBlue));
  ASSERT_TRUE(drape) << text(drape.error().what);
  const double draped = std::pow(165.0 / 200, 2), support = std::pow(kDrapeSupport / kDrapeDisc, 2);
  EXPECT_NEAR(*drape, (draped - support) / (1 - support), 0.003);
  const auto flat = drapeOfPhotographs(photograph(disc, kTable, kBlue), photograph(disc, kTable, kBlue));
  EXPECT_NEAR(*flat, 1, 1e-12);
}

TEST(Silhouette, ASpeckBesideItAndALightOnItDoNotCount) {
  PrintPixels image = photograph(disc, kTable, kBlue, 0);
  const double before = *coveredShare(image);
  const auto paint = [&](int x0, int y0, Rgb colour) {
    for (int y = y0; y < y0 + 12; ++y)
      for (int x = x0; x < x0 + 12; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          image.rgb[3 * (static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x)) + c] =
              static_cast<std::uint8_t>(colour[c]);
  };
  paint(20, 20, kBlue);     // a scrap on the table
  paint(320, 230, kTable);  // a shine in the middle
  EXPECT_DOUBLE_EQ(*coveredShare(image), before);
}

TEST(Silhouette, RefusesWhatTellsNothing) {
  const auto said = [](const Result<double>& found) { return found ? std::string("told") : text(found.error().what); };
  using ::testing::HasSubstr;
  EXPECT_THAT(said(coveredShare({})), HasSubstr("nothing in this photograph"));
  EXPECT_THAT(said(coveredShare(photograph(disc, kTable, {230, 228, 222}, 0, 0))), HasSubstr("hardly be told apart"));
  EXPECT_THAT(said(coveredShare(photograph([](double) { return 300; }, kTable, kBlue))), HasSubstr("reaches the edge"));
  EXPECT_THAT(said(coveredShare(photograph([](double) { return 40; }, kTable, kBlue))), HasSubstr("from nearer"));
  PrintPixels other = photograph(folds, kTable, kBlue);
  other.width /= 2, other.height *= 2;
  EXPECT_THAT(said(drapeOfPhotographs(photograph(disc, kTable, kBlue), other)), HasSubstr("640 by 480 and 320 by 960"));
}

}  // namespace
}  // namespace karinui
