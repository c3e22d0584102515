#include <cmath>

#include "view/easel.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

using ViewStereo = test::Easel;

// The middle of the dot in one half of a picture, as some channels see it: of the pixels that are darker than half of
// what lies round it.
Vec3 darkMiddle(const Image& image, int left, int right, std::array<double, 3> weight) {
  double sum = 0, x1 = 0, y1 = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) {
      const Pixel p = image.at(x, y);
      if (weight[0] * p[0] + weight[1] * p[1] + weight[2] * p[2] > 100) continue;
      sum += 1, x1 += x - left + 0.5, y1 += y + 0.5;
    }
  return sum > 0 ? Vec3{x1 / sum, y1 / sum, sum} : Vec3{NAN, NAN, 0};
}

// A black dot of cloth before (or behind) the plane in which the eyes agree. It is turned a little: its slanted edges
// cross pixels everywhere, so that its middle is known far better than to a pixel.
SceneFrame dotAt(double z, double size = 1) {
  SceneFrame frame;
  frame.cloths.push_back(test::sheet(-0.05, 0.95, 0.05, 1.05, z));
  frame.cloths[0].colour = {0, 0, 0};
  for (Vec3& p : frame.cloths[0].mesh.points)
    p = {size * (std::cos(0.3) * p.x - std::sin(0.3) * (p.y - 1)),
         1 + size * (std::sin(0.3) * p.x + std::cos(0.3) * (p.y - 1)), p.z};
  return frame;
}

constexpr int kWide = 900, kHigh = 1200;  // of an eye's picture
constexpr double kTenth = 0.1;            // pixels

PictureOptions options(Eyes eyes) {
  PictureOptions o;
  o.eyes = eyes;
  o.width = eyes == Eyes::SideBySide ? 2 * kWide : kWide;
  o.height = eyes == Eyes::TopBottom ? 2 * kHigh : kHigh;
  o.camera = Camera{{0, 1, 3}, {0, 1, 0}};
  o.lettering = false;
  return o;
}

TEST_F(ViewStereo, SideBySideDisparityIsTheFormulasWithinATenthOfAPixel) {
  for (const double z : {-0.8, 0.0, 0.9}) {
    const PictureOptions o = options(Eyes::SideBySide);
    const Image both = draw(dotAt(z), o);
    const Vec3 left = darkMiddle(both, 0, kWide, {0.3, 0.6, 0.1}),
               right = darkMiddle(both, kWide, 2 * kWide, {0.3, 0.6, 0.1});
    ASSERT_GT(left.z, 0);
    EXPECT_NEAR(left.x - right.x, disparity(*o.camera, kHigh, o.eyeSeparation, 3 - z), kTenth) << z;
    EXPECT_NEAR(left.y, right.y, kTenth) << "no vertical disparity";
  }
}

TEST_F(ViewStereo, TopBottomHoldsTheLeftEyeAbove) {
  PictureOptions o = options(Eyes::TopBottom);
  const Image both = draw(dotAt(0.9), o);
  Image upper(kWide, kHigh), lower(kWide, kHigh);
  upper.paste(both, 0, 0);
  lower.paste(both, 0, -kHigh);
  const Vec3 left = darkMiddle(upper, 0, kWide, {0.3, 0.6, 0.1}), right = darkMiddle(lower, 0, kWide, {0.3, 0.6, 0.1});
  EXPECT_NEAR(left.x - right.x, disparity(*o.camera, kHigh, o.eyeSeparation, 2.1), kTenth);
  EXPECT_GT(left.x, right.x);
}

TEST_F(ViewStereo, AnaglyphShowsTheLeftEyeInRedAndTheRightInCyan) {
  const PictureOptions o = options(Eyes::Anaglyph);
  const Image both = draw(dotAt(0.9, 0.16), o);  // so small that the eyes' dots lie apart, or one would tint the other
  const Vec3 red = darkMiddle(both, 0, kWide, {1, 0, 0}), cyan = darkMiddle(both, 0, kWide, {0, 0.5, 0.5});
  EXPECT_NEAR(red.x - cyan.x, disparity(*o.camera, kHigh, o.eyeSeparation, 2.1), kTenth);
}

}  // namespace
}  // namespace karinui
