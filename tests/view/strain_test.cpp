#include <cmath>

#include "karinui/view/strain_scale.h"
#include "view/easel.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

double lightness(const Colour& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(StrainScale, GetsLighterAllTheWay) {
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(lightness(strainColour(i / 100.0)), lightness(strainColour((i + 1) / 100.0))) << i;
  EXPECT_EQ(strainColour(-3), strainColour(0));
  EXPECT_EQ(strainColour(9), strainColour(1));
  EXPECT_EQ(strainColour(NAN), strainColour(0));
}

TEST(StrainScale, TopIsARoundNumberOverNearlyAll) {
  SceneFrame frame;
  EXPECT_EQ(strainTop(frame), 0);
  for (const auto& [strain, top] : {std::pair{0.0171, 0.02}, {0.043, 0.05}, {0.0005, 0.005}, {0.08, 0.1}, {2.1, 5.0}}) {
    frame.cloths = {test::sheet(0, 0, 1, 1, 0, strain)};
    EXPECT_NEAR(strainTop(frame), top, 1e-9) << strain;
  }
  frame.cloths[0].strain[0] = NAN;
  EXPECT_GT(strainTop(frame), 0);
}

using ViewStrain = test::Easel;

TEST_F(ViewStrain, SlackClothIsBlueTightClothYellowAndTheLegendSaysHowMuch) {
  SceneFrame frame;
  frame.cloths.push_back(test::sheet(-0.4, 0, 0.4, 0.8, 0, 0.05));
  PictureOptions options;
  options.width = options.height = 400;
  options.map = Map::Strain;
  options.mapTop = 0.05;
  options.lettering = false;
  const Image bare = draw(frame, options);
  const Pixel slack = bare.at(50, 250), tight = bare.at(350, 250);
  EXPECT_GT(slack[2], slack[0] + 25);
  EXPECT_GT(tight[0], tight[2] + 60);
  EXPECT_GT(luminance(tight), 3 * luminance(slack));

  options.lettering = true;
  const Image told = draw(frame, options);
  EXPECT_TRUE(picture_->notes().empty()) << text(picture_->notes()[0]);
  // Somewhere on the right a column runs through the scale's colours from yellow down to blue.
  bool found = false;
  for (int x = 250; x < 400 && !found; ++x) {
    const auto near = [&](int y, double share) {
      const Pixel wanted = pixelOf(strainColour(share)), seen = told.at(x, y);
      return std::abs(wanted[0] - seen[0]) + std::abs(wanted[1] - seen[1]) + std::abs(wanted[2] - seen[2]) < 40;
    };
    for (int top = 0; top < 80 && !found; ++top) found = near(top, 1) && near(top + 52, 0.52) && near(top + 104, 0.04);
  }
  EXPECT_TRUE(found);
  int changed = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 200; x < 400; ++x) changed += told.at(x, y) != bare.at(x, y);
  EXPECT_GT(changed, 1500) << "bar, ticks and numbers";
}

TEST_F(ViewStrain, PressureHasTheSameColoursAndAScaleInKilopascals) {
  SceneFrame frame;
  frame.cloths.push_back(test::sheet(-0.4, 0, 0.4, 0.8, 0, 2000));
  PictureOptions options;
  options.width = options.height = 400;
  options.map = Map::Pressure;
  options.mapTop = 2000;
  const Image pressure = draw(frame, options);
  EXPECT_TRUE(picture_->notes().empty());
  // Drawn out by 2,000 instead: but for the scale's words the same picture.
  options.map = Map::Strain;
  const Image strain = draw(frame, options);
  int words = 0, cloth = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      if (pressure.at(x, y) != strain.at(x, y)) ++(y < 200 && x > 200 ? words : cloth);
  EXPECT_GT(words, 100) << "2 kPa, not 200000 %";
  EXPECT_EQ(cloth, 0);
  frame.cloths.clear();
  options.map = Map::Pressure;
  const auto nothing = picture_->draw(frame, options);
  ASSERT_FALSE(nothing);
  EXPECT_NE(text(nothing.error().what).find("no pressure to show yet"), std::string::npos);
  EXPECT_EQ(*mapNamed("pressure"), Map::Pressure);
  EXPECT_NE(text(mapNamed("heat").error().what).find("strain, pressure, or none"), std::string::npos);
}

}  // namespace
}  // namespace karinui
