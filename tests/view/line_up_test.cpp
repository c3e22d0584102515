#include "karinui/view/line_up.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/easel.h"
#include "view/little_scenes.h"

namespace karinui {
namespace {

using test::ball;
using ViewLineUp = test::Easel;

// A blue column of this height whose left side has a green knob.
SceneFrame column(double high, Vec3 at = {}) {
  SceneFrame frame;
  frame.bodies.push_back(ball(at + Vec3{0, high / 2, 0}, high / 2));
  frame.bodies[0].colour = {0.05f, 0.1f, 0.8f};
  frame.bodies.push_back(ball(at + Vec3{high / 2, high / 2, 0}, 0.1));
  frame.bodies[1].colour = {0.05f, 0.7f, 0.05f};
  return frame;
}

PictureOptions each() {
  PictureOptions how;
  how.width = 160, how.height = 240, how.lettering = false, how.samples = 1;
  return how;
}

bool blue(Pixel p) { return p[2] > p[0] + 40 && p[2] > p[1] + 40; }
bool green(Pixel p) { return p[1] > p[0] + 40 && p[1] > p[2] + 40; }

// Rows and columns between which pixels of a colour lie.
struct Seen {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1, count = 0;
};
template <class Is>
Seen seen(const Image& image, int from, int to, const Is& is) {
  Seen all;
  for (int y = 0; y < image.height; ++y)
    for (int x = std::max(0, from); x < std::min(to, image.width); ++x)
      if (is(image.at(x, y)))
        all = {std::min(all.left, x), std::max(all.right, x), std::min(all.top, y), std::max(all.bottom, y),
               all.count + 1};
  return all;
}

Image good(Result<Image> image) {
  EXPECT_TRUE(image) << (image ? "" : text(image.error().what));
  return image ? *std::move(image) : Image(1, 1);
}

TEST_F(ViewLineUp, AllStandOnOneFloorAtOneScale) {
  const std::vector<SceneFrame> frames{column(1.6), column(0.8, {5, 0, 3})};
  LineUp pair({{"tall"}, {"small"}}, frames, each());
  const Image image = good(pair.draw());
  const int half = image.width / 2;
  const Seen tall = seen(image, 0, half, blue), small = seen(image, half, image.width, blue);
  EXPECT_NEAR(tall.bottom, small.bottom, 4) << "one floor";
  EXPECT_NEAR(1.0 * (tall.bottom - tall.top) / (small.bottom - small.top), 2, 0.12) << "one scale";
}

TEST_F(ViewLineUp, TheyTurnTogetherAndNoTurnIsCut) {
  const std::vector<SceneFrame> frames{column(1.6), column(1.2)};
  LineUp pair({{"a"}, {"b"}}, frames, each());
  const Image front = good(pair.draw()), left = good(pair.draw(std::numbers::pi / 2)),
              back = good(pair.draw(std::numbers::pi));
  for (const int slot : {0, 1}) {
    const int from = slot * front.width / 2, to = from + front.width / 2, middle = (from + to) / 2;
    EXPECT_GT(seen(front, from, to, green).left, middle) << "the left hand is at the right of the picture";
    EXPECT_LT(seen(back, from, to, green).right, middle);
    const Seen knob = seen(left, from, to, green);
    EXPECT_NEAR((knob.left + knob.right) / 2, middle, 3) << "seen from its left";
  }
  // One distance over all turns: the body of the first is as high in each.
  const auto high = [](const Image& image) {
    const Seen body = seen(image, 0, image.width / 2, [](Pixel p) { return blue(p) || green(p); });
    return body.bottom - body.top;
  };
  EXPECT_NEAR(high(front), high(back), 2);
  EXPECT_NEAR(high(front), high(left), 4);
}

TEST_F(ViewLineUp, ThePicturesJoinAsOne) {
  const std::vector<SceneFrame> frames{column(1), column(1), column(1)};
  LineUp three({{"a"}, {"b"}, {"c"}}, frames, each());
  const Image image = good(three.draw());
  const int margin = (image.width - 3 * each().width) / 2;
  for (const int seam : {1, 2})
    for (int y = margin + 2; y < margin + each().height / 3; ++y) {
      const int x = margin + seam * each().width;
      EXPECT_NEAR(luminance(image.at(x - 1, y)), luminance(image.at(x, y)), 0.02) << "the backdrop goes on";
    }
  const Pixel corner = image.at(margin + 2, margin + 2), middle = image.at(image.width / 2, margin + 2);
  EXPECT_LT(luminance(corner), luminance(middle) - 0.01) << "and falls off to the corners of the whole";
}

TEST_F(ViewLineUp, ASheetOfTurnsHasARowForEach) {
  const std::vector<SceneFrame> frames{column(1.6), column(0.8)};
  LineUp pair({{"a", {}, true}, {"b"}}, frames, each());
  const Image image = good(pair.turns(4));
  EXPECT_NEAR(image.width, 4 * each().width, 12);
  EXPECT_GT(image.height, 2 * each().height);
  const auto upper = [&](int column) {
    Image part(each().width, each().height);
    part.paste(image, -(image.width - 4 * each().width) / 2 - column * each().width, -4);
    return part;
  };
  EXPECT_GT(seen(upper(0), 0, 160, green).left, 80);
  EXPECT_LT(seen(upper(2), 0, 160, green).right, 80);
  const auto red = [](Pixel p) { return p[0] > p[1] + 90 && p[0] > p[2] + 90; };
  const Seen marked = seen(image, 0, image.width, red);
  EXPECT_GT(marked.count, 4 * 100) << "a bar under each picture of the marked one";
  EXPECT_LT(marked.bottom, image.height / 2 + 30) << "and none under the other";
  const Image lone = good(LineUp({{""}}, std::span(frames).first(1), each()).turns(8));
  EXPECT_NEAR(lone.width, 4 * each().width, 12) << "one figure takes two rows for eight turns";
}

TEST_F(ViewLineUp, OneAloneWithoutANameIsThePictureAndKeepsItsFrame) {
  const std::vector<SceneFrame> frames{column(1.6)};
  LineUp lone({{""}}, frames, each());
  lone.keepAll();
  const Image first = good(lone.draw(0.3)), other = good(lone.draw(1.7)), again = good(lone.draw(0.3));
  EXPECT_EQ(first.width, each().width);
  EXPECT_EQ(first.height, each().height);
  EXPECT_NE(first.rgba, other.rgba);
  EXPECT_EQ(first.rgba, again.rgba) << "drawn again from what is kept";
  EXPECT_EQ(first.rgba, good(LineUp({{""}}, frames, each()).draw(0.3)).rgba) << "as drawn anew";
}

TEST_F(ViewLineUp, OneStrainScaleForAllAndNoneWithoutStrain) {
  std::vector<SceneFrame> frames(3);
  frames[0].cloths.push_back(test::sheet(-0.3, 0, 0.3, 1, 0, 0.04));
  frames[1].cloths.push_back(test::sheet(-0.3, 0, 0.3, 1, 0, 0.16));
  frames[2] = column(1);  // wears nothing
  PictureOptions how = each();
  how.map = Map::Strain;
  LineUp three({{"a"}, {"b"}, {"c"}}, frames, how);
  const Image both = good(three.draw());
  PictureOptions alone = how;
  const Image own = good(LineUp({{""}}, std::span(frames).first(1), alone).draw());
  const int y = 130, x = 15;  // right of the sheet's middle it is strained
  const auto at = [&](const Image& image, int u) { return luminance(image.at(u, y)); };
  const int margin = (both.width - 3 * each().width) / 2;
  EXPECT_LT(at(both, margin + 80 + x), at(own, 80 + x) - 0.03) << "on the scale of both the little strain is dark";
  EXPECT_GT(at(both, margin + 160 + 80 + x), at(both, margin + 80 + x) + 0.03);
  EXPECT_FALSE(LineUp({{"c"}}, std::span(frames).last(1), how).draw()) << "there is no strain to show";
}

TEST_F(ViewLineUp, IsStoppedBetweenTwoPictures) {
  const std::vector<SceneFrame> frames{column(1)};
  Token token;
  token.cancel();
  const auto stopped = LineUp({{"a"}}, frames, each()).draw(0, 0, token);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, Error::Kind::Cancelled);
}

}  // namespace
}  // namespace karinui
