// Whole pictures of little scenes against kept ones (kept_picture.h), in tests/view/pictures.
#include "view/easel.h"
#include "view/kept_picture.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

class ViewKept : public test::Easel {
 protected:
  void check(const std::string& name, const Image& image) {
    test::expectKept(std::string(KARINUI_SOURCE_DIR) + "/tests/view/pictures/" + name + ".png", image);
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
  options.map = Map::Strain, options.mapTop = 0.05;
  check("strain", draw(frame, options));
}

}  // namespace
}  // namespace karinui
