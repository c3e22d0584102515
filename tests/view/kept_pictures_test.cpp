// Whole pictures against kept ones. When a change of the look is meant: run
//   KARINUI_ACCEPT_PICTURES=1 build/test/bin/test_view --gtest_filter='ViewKept.*'
// look at tests/view/pictures with your own eyes, and commit them with the change.
#include <png.h>

#include <cstdlib>
#include <cstring>

#include "view/easel.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

Image readPng(const std::string& path) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) return {};
  png.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (!png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr)) return {};
  return image;
}

class ViewKept : public test::Easel {
 protected:
  void check(const std::string& name, const Image& image) {
    const std::string kept = std::string(KARINUI_SOURCE_DIR) + "/tests/view/pictures/" + name + ".png";
    if (std::getenv("KARINUI_ACCEPT_PICTURES")) {
      ASSERT_TRUE(writePng(kept, image));
      return;
    }
    const Image wanted = readPng(kept);
    ASSERT_EQ(wanted.rgba.size(), image.rgba.size()) << kept << " is missing or has another size";
    double sum = 0;
    int far = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
      const int miss = std::abs(int{image.rgba[i]} - int{wanted.rgba[i]});
      sum += miss;
      far += miss > 40;
    }
    const double count = static_cast<double>(image.rgba.size());
    // Other drivers round differently along edges; the look itself must not move.
    const bool same = sum / count < 1.0 && far / count < 0.006;
    const std::string now = ::testing::TempDir() + "karinui_now_" + name + ".png";
    if (!same) (void)writePng(now, image);
    EXPECT_TRUE(same) << "mean miss " << sum / count << " of 255, " << 100 * far / count << " % far off; now: " << now
                      << "\nIf the change is meant, accept it as told at the top of tests/view/kept_pictures_test.cpp.";
  }
};

SceneFrame skirt() {
  SceneFrame frame;
  frame.bodies.push_back(test::ball({0, 0.35, 0}, 0.35, 32));
  frame.bodies.push_back(test::ball({0, 1.0, 0}, 0.30, 32));
  frame.cloths.push_back(test::tube({0, 0.30, 0}, 0.36, 0.55));
  frame.lines.push_back({{{0.3, 1.1, 0.3}, {0.6, 1.3, 0.3}}, {0.8f, 0.1f, 0.1f}, 12, true});
  return frame;
}

TEST_F(ViewKept, Front) {
  PictureOptions options;
  options.width = 180, options.height = 240, options.lettering = false;
  check("front", draw(skirt(), options));
}

TEST_F(ViewKept, ObliqueAnaglyph) {
  PictureOptions options;
  options.width = 180, options.height = 240, options.lettering = false;
  options.view = View::Oblique, options.eyes = Eyes::Anaglyph;
  check("oblique_anaglyph", draw(skirt(), options));
}

TEST_F(ViewKept, Strain) {
  SceneFrame frame = skirt();
  for (const Vec3 p : frame.cloths[0].mesh.points)
    frame.cloths[0].strain.push_back(static_cast<float>(0.05 * (p.x + 0.4) / 0.8));
  PictureOptions options;
  options.width = 180, options.height = 240, options.lettering = false;
  options.map = Map::Strain, options.strainTop = 0.05;
  check("strain", draw(frame, options));
}

}  // namespace
}  // namespace karinui
