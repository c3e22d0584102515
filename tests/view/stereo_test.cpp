#include <cmath>

#include "view/easel.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

using ViewStereo = test::Easel;

// The middle of what is darker than its surroundings in one half of a picture, by channel weights.
Vec3 darkMiddle(const Image& image, int left, int right, std::array<double, 3> weight) {
  double sum = 0, x1 = 0, y1 = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) {
      const Pixel p = image.at(x, y);
      const double dark = std::max(0.0, 100 - (weight[0] * p[0] + weight[1] * p[1] + weight[2] * p[2]));
      sum += dark, x1 += dark * (x - left + 0.5), y1 += dark * (y + 0.5);
    }
  return sum > 0 ? Vec3{x1 / sum, y1 / sum, sum} : Vec3{NAN, NAN, 0};
}

// A black dot of cloth before (or behind) the plane in which the eyes agree.
SceneFrame dotAt(double z) {
  SceneFrame frame;
  frame.cloths.push_back(test::sheet(-0.05, 0.95, 0.05, 1.05, z));
  frame.cloths[0].colour = {0, 0, 0};
  return frame;
}

PictureOptions options(Eyes eyes) {
  PictureOptions o;
  o.eyes = eyes;
  o.width = eyes == Eyes::SideBySide ? 600 : 300;
  o.height = eyes == Eyes::TopBottom ? 800 : 400;
  o.camera = Camera{{0, 1, 3}, {0, 1, 0}};
  o.lettering = false;
  return o;
}

TEST_F(ViewStereo, SideBySideDisparityIsTheFormulasWithinAPixel) {
  for (const double z : {-0.8, 0.0, 0.9}) {
    const PictureOptions o = options(Eyes::SideBySide);
    const Image both = draw(dotAt(z), o);
    const Vec3 left = darkMiddle(both, 0, 300, {0.3, 0.6, 0.1}), right = darkMiddle(both, 300, 600, {0.3, 0.6, 0.1});
    ASSERT_GT(left.z, 0);
    EXPECT_NEAR(left.x - right.x, disparity(*o.camera, 400, o.eyeSeparation, 3 - z), 1.0) << z;
    EXPECT_NEAR(left.y, right.y, 0.5) << "no vertical disparity";
  }
}

TEST_F(ViewStereo, TopBottomHoldsTheLeftEyeAbove) {
  PictureOptions o = options(Eyes::TopBottom);
  const Image both = draw(dotAt(0.9), o);
  Image upper(300, 400), lower(300, 400);
  upper.paste(both, 0, 0);
  lower.paste(both, 0, -400);
  const Vec3 left = darkMiddle(upper, 0, 300, {0.3, 0.6, 0.1}), right = darkMiddle(lower, 0, 300, {0.3, 0.6, 0.1});
  EXPECT_NEAR(left.x - right.x, disparity(*o.camera, 400, o.eyeSeparation, 2.1), 1.0);
  EXPECT_GT(left.x, right.x);
}

TEST_F(ViewStereo, AnaglyphShowsTheLeftEyeInRedAndTheRightInCyan) {
  const PictureOptions o = options(Eyes::Anaglyph);
  const Image both = draw(dotAt(0.9), o);
  const Vec3 red = darkMiddle(both, 0, 300, {1, 0, 0}), cyan = darkMiddle(both, 0, 300, {0, 0.5, 0.5});
  EXPECT_NEAR(red.x - cyan.x, disparity(*o.camera, 400, o.eyeSeparation, 2.1), 2.0);
}

}  // namespace
}  // namespace karinui
