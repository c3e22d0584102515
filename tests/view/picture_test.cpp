#include "karinui/view/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "view/easel.h"
#include "view/little_scenes.h"
#include "view/surface.h"

namespace karinui {
namespace {

using test::ball;
using test::sheet;
using ViewPicture = test::Easel;

SceneFrame covered() {
  SceneFrame frame;
  frame.bodies.push_back(ball({0, 0.5, 0}, 0.5));
  frame.cloths.push_back(sheet(-0.25, 0.25, 0.25, 0.75, 0.52));
  return frame;
}

PictureOptions small(View view = View::Front) {
  PictureOptions options;
  options.view = view;
  options.width = options.height = 200;
  options.lettering = false;
  return options;
}

bool bluish(Pixel p) { return p[2] > p[0] + 30; }
bool warm(Pixel p) { return p[0] > p[2] + 8; }

TEST_F(ViewPicture, ClothCoversTheBodyInFrontAndTheBodyTheClothBehind) {
  const Image front = draw(covered(), small()), back = draw(covered(), small(View::Back));
  EXPECT_TRUE(bluish(front.at(100, 100)));
  EXPECT_TRUE(warm(front.at(100, 190 - 172))) << "skin above the cloth";
  EXPECT_TRUE(warm(back.at(100, 100))) << "seen from behind, the body hides the cloth";
}

TEST_F(ViewPicture, PiecesThatStandApartDoNotMakeTheFigureSmall) {
  SceneFrame frame = covered();
  const Image alone = draw(frame, small());
  frame.cloths.push_back(sheet(3, 0.25, 3.5, 0.75, 0));
  const Image with = draw(frame, small());
  int blue = 0, blueAlone = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) blue += bluish(with.at(x, y)), blueAlone += bluish(alone.at(x, y));
  EXPECT_NEAR(blue, blueAlone, 0.02 * blueAlone);
}

TEST_F(ViewPicture, TheBackdropIsWarmLightAndFallsOffToTheCorners) {
  const Image image = draw(covered(), small());
  const Pixel corner = image.at(2, 2), side = image.at(20, 60);
  for (const Pixel p : {corner, side}) {
    EXPECT_GT(p[0], 180);
    EXPECT_GE(p[0], p[1]);
    EXPECT_GE(p[1], p[2]);
  }
  EXPECT_LT(luminance(corner), luminance(side));
}

// A sheet of 40 cm, looked at so that two pixels are a centimetre and more, and how often a row or column of it changes
// between cloth and ink.
struct Changes {
  int across = 0, up = 0;
};
Changes changesOf(const Image& image, int from, int to, int at) {
  Changes changes;
  const auto light = [&](int x, int y) { return image.at(x, y)[1] > 110; };
  for (int k = from; k < to; ++k) {
    changes.across += light(k, at) != light(k + 1, at);
    changes.up += light(at, k) != light(at, k + 1);
  }
  return changes;
}

TEST_F(ViewPicture, PrintsKeepTheirScaleAndFollowTheGrain) {
  SceneFrame frame;
  frame.cloths.push_back(sheet(-0.2, 0.5, 0.2, 0.9, 0));
  SceneCloth& cloth = frame.cloths[0];
  cloth.colour = {0.02f, 0.02f, 0.03f};
  cloth.look.print = ClothLook::Print::Stripe;
  cloth.look.ink = {0.9f, 0.9f, 0.9f};
  cloth.look.repeat = 0.05;
  cloth.look.relief = 0;
  PictureOptions options = small();
  options.width = options.height = 400;
  options.camera = Camera();
  options.camera->eye = {0, 0.7, 3}, options.camera->target = {0, 0.7, 0};
  options.camera->fieldOfView = 2 * std::atan(0.2 / 3);  // the sheet fills the picture
  // 300 of 400 pixels are 30 cm: six stripes of 5 cm, each with two sides.
  const auto drawn = [&] { return changesOf(draw(frame, options), 50, 350, 200); };
  EXPECT_EQ(drawn().across, 12);
  EXPECT_EQ(drawn().up, 0) << "stripes run along the grain";
  cloth.look.grain = {1, 0};
  EXPECT_EQ(drawn().across, 0);
  EXPECT_EQ(drawn().up, 12) << "and turn with it";
  cloth.look.turn = std::numbers::pi / 2;
  EXPECT_EQ(drawn().across, 12) << "a print may lie across the grain";
  cloth.look.turn = 0, cloth.look.grain = {0, 1};
  cloth.look.repeat = 0.1;
  EXPECT_EQ(drawn().across, 6);
  cloth.look.repeat = 0.0005;  // far finer than a pixel: one even tone, no moire
  EXPECT_EQ(drawn().across, 0);
  cloth.look.print = ClothLook::Print::Dot, cloth.look.repeat = 0.1;
  EXPECT_GT(drawn().across, 2);
  cloth.look.print = ClothLook::Print::Photo;
  cloth.look.photo = std::make_shared<const PrintImage>(PrintImage{2, 1, {255, 255, 255, 0, 0, 0}});
  EXPECT_EQ(drawn().across, 6) << "a photograph of 10 cm";
  cloth.look.photo = std::make_shared<const PrintImage>(PrintImage{2, 1, {255, 255, 255}});
  EXPECT_EQ(drawn().across, 0) << "one that is not whole is left out";
}

TEST_F(ViewPicture, WhatIsBehindSheerClothIsSeenThroughIt) {
  SceneFrame frame;
  frame.bodies.push_back(ball({0, 0.5, 0}, 0.5));
  frame.cloths.push_back(sheet(-0.45, 0.1, 0.45, 0.95, 0.6));
  frame.cloths[0].colour = {0.02f, 0.05f, 0.6f};
  frame.cloths[0].look.weave = ClothLook::Weave::Sheer;
  const Image whole = draw(frame, small());
  frame.cloths[0].look.cover = 0.4f;
  const Image sheer = draw(frame, small());
  const auto red = [](const Image& image) { return image.at(100, 110)[0]; };
  EXPECT_GT(red(sheer), red(whole) + 25) << "skin behind";
  frame.cloths[0].mesh.points.clear(), frame.cloths[0].mesh.faces.clear();
  EXPECT_LT(red(sheer), red(draw(frame, small())) - 5) << "yet the cloth is there";
}

TEST_F(ViewPicture, SatinShinesAndVelvetIsDarkInFrontAndLightAtItsSides) {
  SceneFrame frame;
  frame.cloths.push_back(test::tube({0, 0, 0}, 0.2, 0.8));
  SceneCloth& cloth = frame.cloths[0];
  cloth.colour = {0.25f, 0.03f, 0.05f};
  const auto spread = [&] {
    const Image image = draw(frame, small());
    std::vector<double> row;
    for (int x = 75; x <= 125; ++x) row.push_back(luminance(image.at(x, 110)));
    return std::array<double, 2>{*std::max_element(row.begin(), row.end()), *std::min_element(row.begin(), row.end())};
  };
  const auto plain = spread();
  cloth.look.weave = ClothLook::Weave::Satin, cloth.look.gloss = 0.85f, cloth.look.sharpness = 14;
  EXPECT_GT(spread()[0], plain[0] + 0.05);
  cloth.look = {};
  cloth.look.weave = ClothLook::Weave::Pile, cloth.look.fuzz = 1.3f;
  EXPECT_LT(spread()[1], plain[1]);
}

TEST_F(ViewPicture, BackIsTheMirrorImageOfFront) {
  SceneFrame frame;
  frame.bodies.push_back(ball({0, 0.5, 0}, 0.5));
  frame.bodies.push_back(ball({0.8, 0.2, 0}, 0.2));  // on the body's left only
  frame.bodies[1].colour = {0.1f, 0.2f, 0.7f};
  PictureOptions options = small();
  options.width = 300;
  const Image front = draw(frame, options);
  options.view = View::Back;
  const Image back = draw(frame, options);
  const Eye eye = eyeOf(frameAll(frame, View::Front, 1.5), 1.5);
  const OnPicture middle = project(eye, {0.8, 0.2, 0.0}, 300, 200);
  const int x = static_cast<int>(middle.x), y = static_cast<int>(middle.y);
  EXPECT_GT(x, 150) << "the body's left is on the right of a front view";
  EXPECT_TRUE(bluish(front.at(x, y)));
  EXPECT_FALSE(bluish(front.at(299 - x, y)));
  EXPECT_TRUE(bluish(back.at(299 - x, y)));
  EXPECT_FALSE(bluish(back.at(x, y)));
}

TEST_F(ViewPicture, TheInnerSideOfClothIsDarkerThanTheOuter) {
  SceneFrame frame;
  frame.cloths.push_back(sheet(-0.25, 0.25, 0.25, 0.75, 0));
  const Image outer = draw(frame, small()), inner = draw(frame, small(View::Back));
  EXPECT_GT(luminance(outer.at(100, 100)), 1.3 * luminance(inner.at(100, 100)));
  EXPECT_GT(luminance(inner.at(100, 100)), 0.02) << "but never black";
}

TEST_F(ViewPicture, TheBodyIsNeverADarkSilhouette) {
  SceneFrame frame;
  frame.bodies.push_back(ball({0, 0.5, 0}, 0.5));
  for (const View view : {View::Front, View::Back, View::Left, View::Right, View::Oblique}) {
    const Image image = draw(frame, small(view));
    double sum = 0, least = 1;
    int count = 0;
    for (int y = 40; y < 160; ++y)
      for (int x = 40; x < 160; ++x)
        if (std::hypot(x - 100, y - 100) < 55) {
          const double l = luminance(image.at(x, y));
          sum += l, ++count, least = std::min(least, l);
        }
    EXPECT_GT(sum / count, 0.35) << nameOf(view);
    EXPECT_LT(sum / count, 0.85) << nameOf(view);
    EXPECT_GT(least, 0.08) << nameOf(view);
  }
}

TEST_F(ViewPicture, FeetThrowAShadowOnTheGround) {
  SceneFrame with;
  with.bodies.push_back(ball({0, 0.5, 0}, 0.5));
  PictureOptions options = small();
  options.camera = Camera{{0, 1.2, 4}, {0, 0.5, 0}};
  const OnPicture under = project(eyeOf(*options.camera, 1), {0.12, 0, 0.3}, 200, 200);
  const Image shaded = draw(with, options);
  const Pixel near = shaded.at(static_cast<int>(under.x), static_cast<int>(under.y)),
              far = shaded.at(15, static_cast<int>(under.y));
  EXPECT_LT(luminance(near), 0.8 * luminance(far));
  EXPECT_GT(luminance(near), 0.15 * luminance(far)) << "soft, not a hole";
}

// Every third row of points stands out, as cells do where a fold crosses them: the shading keeps a third of their tilt
// at most, and most of that of a fold of eight cells.
TEST(Surface, RipplesOfSingleCellsAreHardlyShaded) {
  constexpr double kCell = 0.6 / 32;
  const auto tilt = [](const std::function<double(std::uint32_t)>& out) {
    SceneCloth cloth = sheet(-0.3, 0, 0.3, 0.6, 0, 0, 32);
    for (std::uint32_t k = 0; k < 33 * 33; ++k) cloth.mesh.points[k].z += out(k % 33);
    const std::vector<Vec3> own = pointNormals(cloth.mesh);
    Surface surface;
    addMesh(surface, cloth.mesh, {}, cloth.colour, cloth.flat);
    double before = 0, shaded = 0;
    for (std::uint32_t j = 4; j < 29; ++j)
      for (std::uint32_t i = 4; i < 29; ++i) {
        before = std::max(before, std::fabs(own[j * 33 + i].x));
        shaded = std::max<double>(shaded, std::fabs(surface.vertices[j * 33 + i].normal[0]));
      }
    return shaded / before;
  };
  EXPECT_LT(tilt([](auto i) { return i % 3 == 0 ? 0.3 * kCell : 0.0; }), 0.34);
  EXPECT_GT(tilt([](auto i) { return 0.2 * kCell * std::sin(std::numbers::pi / 4 * i); }), 0.75);
}

// The diagonals of a lattice alternate, so that its points have eight neighbours and four in turn; along a straight
// fold the hollow is as deep everywhere.
TEST(Surface, AStraightFoldIsEvenlyShaded) {
  constexpr std::uint32_t kCells = 16, kRow = kCells + 1;
  SceneCloth cloth = sheet(0, 0, 0.16, 0.16, 0, 0, kCells);
  cloth.mesh.faces.clear();
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t p = j * kRow + i, q = p + 1, r = p + kRow + 1, s = p + kRow;
      for (const Triangle& f : (i + j) % 2 ? std::array<Triangle, 2>{{{p, q, s}, {q, r, s}}}
                                           : std::array<Triangle, 2>{{{p, q, r}, {p, r, s}}})
        cloth.mesh.faces.push_back(f);
    }
  for (Vec3& p : cloth.mesh.points) p.z = 0.5 * std::fabs(p.y - 0.08);
  Surface surface;
  addMesh(surface, cloth.mesh, {}, cloth.colour, cloth.flat);
  float least = 1, most = 0;
  for (std::uint32_t i = 4; i <= kCells - 4; ++i) {
    const float hollow = surface.vertices[kCells / 2 * kRow + i].cavity;
    least = std::min(least, hollow), most = std::max(most, hollow);
  }
  EXPECT_GT(least, 0.2f);
  EXPECT_LT(most, 1.25f * least);  // averaged once: a third more
}

TEST_F(ViewPicture, SeamsAndEdgesAreDrawnOverTheCloth) {
  SceneFrame frame = covered();
  std::vector<std::uint32_t> seam;
  for (std::uint32_t j = 0; j <= 16; ++j) seam.push_back(j * 17 + 8);
  frame.cloths[0].seams.push_back(seam);
  PictureOptions options = small();
  options.width = options.height = 600;
  const Image image = draw(frame, options);
  int thread = 0, ditch = 0;
  const double cloth = luminance(image.at(330, 300));
  for (int y = 200; y < 400; ++y) {
    double brightest = 0, darkest = 1;
    for (int x = 294; x <= 306; ++x) {
      brightest = std::max(brightest, luminance(image.at(x, y)));
      darkest = std::min(darkest, luminance(image.at(x, y)));
    }
    thread += brightest > 2 * cloth;
    ditch += brightest <= 2 * cloth && darkest < 0.85 * cloth;
  }
  EXPECT_GT(thread, 70) << "white tacking stitches";
  EXPECT_GT(ditch, 30) << "with gaps between them";
  double edge = 1;
  for (int x = 120; x < 260; ++x) edge = std::min(edge, luminance(image.at(x, 300)));
  EXPECT_LT(edge, 0.6 * cloth) << "a dark line where the cloth ends";
}

// A facing lies close under its piece: where it ends is not seen from outside.
TEST_F(ViewPicture, TheEdgeOfAClothCloseUnderAnotherIsNotSeen) {
  SceneFrame frame = covered();
  PictureOptions options = small();
  options.width = options.height = 600;
  const Image without = draw(frame, options);
  frame.cloths.push_back(sheet(-0.1, 0.4, 0.1, 0.6, 0.5185));
  frame.cloths.back().colour = frame.cloths[0].colour;
  const Image image = draw(frame, options);
  double differs = 0;
  for (int y = 200; y < 400; ++y)
    for (int x = 200; x < 400; ++x)
      differs = std::max(differs, std::fabs(luminance(image.at(x, y)) / luminance(without.at(x, y)) - 1));
  EXPECT_LT(differs, 0.1);
}

TEST_F(ViewPicture, ABodyThatPokesThroughByAMillimetreStaysUnderItsCloth) {
  SceneFrame frame;
  frame.bodies.push_back(ball({0, 0.5, 0}, 0.5, 64));
  frame.cloths.push_back(sheet(-0.02, 0.48, 0.02, 0.52, 0.4988));
  PictureOptions options = small();
  options.camera = Camera{{0, 0.5, 1.2}, {0, 0.5, 0.5}, {0, 1, 0}, 0.12};
  EXPECT_TRUE(bluish(draw(frame, options).at(100, 100)));
}

TEST_F(ViewPicture, TilesOfALargePictureMeetWithoutASeam) {
  const Image large = draw(covered(), [] {
    PictureOptions options = small();
    options.width = 2400;
    options.height = 64;
    options.samples = 1;
    return options;
  }());
  for (int y = 0; y < large.height; ++y) {
    const Pixel a = large.at(2047, y), b = large.at(2048, y);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 3) << y;
  }
}

TEST_F(ViewPicture, TheSamePictureTwiceIsTheSameBytes) {
  EXPECT_EQ(draw(covered(), small()).rgba, draw(covered(), small()).rgba);
}

// What was worked out for a body is kept while it stays: a picture must not tell what was drawn before it.
TEST_F(ViewPicture, WhatWasDrawnBeforeDoesNotShow) {
  SceneFrame moved = covered(), tinted = covered(), larger = covered(), two = covered();
  for (Vec3& p : moved.cloths[0].mesh.points) p.x += 0.4;  // and with it the middle of the scene
  tinted.bodies[0].colour = {0.1f, 0.5f, 0.2f};
  larger.bodies[0] = ball({0, 0.7, 0}, 0.7);
  two.bodies.push_back(ball({0.8, 0.2, 0}, 0.2));
  for (const SceneFrame& frame : {covered(), moved, tinted, larger, two, covered()}) {
    const Image after = draw(frame, small());
    const auto fresh = (*Picture::open())->draw(frame, small());
    ASSERT_TRUE(fresh);
    EXPECT_EQ(after.rgba, fresh->rgba);
  }
}

TEST_F(ViewPicture, BrokenScenesGiveAPictureAndASentence) {
  SceneFrame frame = covered();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  frame.cloths[0].mesh.points[0] = {nan, 0, 0};
  frame.bodies[0].mesh.points[700] = {1e300, 0, 0};
  frame.cloths[0].mesh.faces.push_back({0, 1, 4000000000u});
  frame.cloths[0].seams.push_back({0, 99999, 3});
  frame.cloths[0].colour = {static_cast<float>(nan), 7, -1};
  frame.lines.push_back({{{nan, nan, nan}, {0, 1, 0}}, {}, -4, true});
  frame.lines.push_back({{{0, 1, 0}}});
  const Image image = draw(frame, small());
  ASSERT_EQ(picture_->notes().size(), 1u);
  EXPECT_NE(text(picture_->notes()[0]).find("left out"), std::string::npos);
  EXPECT_TRUE(warm(image.at(100, 18))) << "the rest of the body is where it was";

  const Image empty = draw({}, small());
  EXPECT_GT(luminance(empty.at(100, 100)), 0.4);
  ASSERT_EQ(picture_->notes().size(), 1u);
  EXPECT_NE(text(picture_->notes()[0]).find("nothing to see"), std::string::npos);
}

TEST_F(ViewPicture, WhatCannotBeDrawnIsRefusedWithASentence) {
  const auto refusal = [&](auto change) {
    PictureOptions options = small();
    change(options);
    auto image = picture_->draw(covered(), options);
    EXPECT_FALSE(image);
    return image ? std::string() : text(image.error().what);
  };
  EXPECT_NE(refusal([](auto& o) { o.width = 0; }).find("0x200"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.height = 100000; }).find("8192"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.samples = 9; }).find("9"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.eyeSeparation = NAN; }).find("eyes"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.camera = Camera{{0, 0, 0}, {0, 0, 0}}; }).find("camera"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.map = Map::Strain; }).find("settle"), std::string::npos);
}

TEST(PictureSize, IsReadAndRefused) {
  EXPECT_EQ((*sizeNamed("1200x1600")), (std::array<int, 2>{1200, 1600}));
  for (const char* bad : {"", "12", "x", "1200x", "x900", "-5x100", "99999x10", "100x100x100", "1e3x1e3"})
    EXPECT_FALSE(sizeNamed(bad)) << bad;
  EXPECT_EQ(*mapNamed("strain"), Map::Strain);
  EXPECT_FALSE(mapNamed("heat"));
}

}  // namespace
}  // namespace karinui
