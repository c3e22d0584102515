// How far apart the eyes' pictures show a known place, in the real window, in every way that a screen wants them.
// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>
//
#include <cmath>

#include "karinui/design/script.h"
#include "quad_window.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

constexpr double kApart = 0.3;   // metres between the eyes: so far that the eyes' dots lie beside each other
constexpr double kNearer = 0.9;  // metres the dot is nearer than what is looked at,
constexpr double kAway = 3;      // which is so far away
constexpr double kTenth = 0.1;   // pixels

// A square of cloth, turned so that its edges cross pixels everywhere, seen and not seen by the same eyes.
class StudioStereo : public testing::Test {
 protected:
  void SetUp() override {
    KARINUI_NEEDS_DISPLAY();
    window_.emplace(Pictures::Whole);
    w().session().begin(DocumentFile::inMemory());
    w().rest();
    const auto dot = parseOperation(
        "piece name=dot outline=\"M -30 -30; a L 30 -30; b L 30 30; c L -30 30; d L -30 -30\" pose=\"0,1,0.9 z "
        "17deg\"");
    ASSERT_TRUE(dot) << text(dot.error().what);
    w().session().perform(*dot);
    w().rest();
    ASSERT_EQ(w().count(), 1u);
  }
  Window& w() { return *window_; }

  struct Pair {
    QImage with, without;
  };
  // What `look` has, with the dot and without it.
  template <class Look>
  auto both(Stereo stereo, Look&& look) {
    w().space().setEyes(apart_, 1);
    w().space().setStereo(stereo);
    w().space().setCamera(Camera{{0, 1, kAway}, {0, 1, 0}});
    w().rest();
    auto with = look();
    w().key(Command::Undo);
    w().space().setCamera(Camera{{0, 1, kAway}, {0, 1, 0}});
    w().rest();
    auto without = look();
    w().key(Command::Redo);
    w().rest();
    return std::pair(with, without);
  }
  Pair shown(Stereo stereo) {
    const auto [with, without] = both(stereo, [&] { return w().space().grabFramebuffer(); });
    return {with, without};
  }
  static Pair part(const Pair& all, const QRect& of) { return {all.with.copy(of), all.without.copy(of)}; }

  // The middle of what differs by a quarter of the most (the weave shades the dot itself), as some of the colours tell;
  // near the picture's middle, away from words and the bar.
  static QPointF middle(const Pair& pair, const std::function<double(QRgb)>& seen) {
    const QSize size = pair.with.size();
    double most = 0, sum = 0, x = 0, y = 0;
    const auto differs = [&](int i, int j) {
      return std::fabs(seen(pair.with.pixel(i, j)) - seen(pair.without.pixel(i, j)));
    };
    const int left = size.width() / 2 - 44, right = size.width() / 2 + 44;
    const int top = size.height() / 2 - size.height() / 5, bottom = size.height() / 2 + size.height() / 5;
    for (int j = top; j < bottom; ++j)
      for (int i = left; i < right; ++i) most = std::max(most, differs(i, j));
    for (int j = top; j < bottom; ++j)
      for (int i = left; i < right; ++i)
        if (differs(i, j) > most / 4) sum += 1, x += i + 0.5, y += j + 0.5;
    EXPECT_GT(most, 20) << "the dot is seen";
    EXPECT_GT(sum, 60);
    return {x / sum, y / sum};
  }
  static double grey(QRgb c) { return 0.3 * qRed(c) + 0.6 * qGreen(c) + 0.1 * qBlue(c); }
  // By the formula, in a picture of this height.
  double wanted(int height) const {
    return disparity(Camera{{0, 1, kAway}, {0, 1, 0}}, height, apart_, kAway - kNearer);
  }
  void expectApart(QPointF left, QPointF right, int height) const {
    EXPECT_NEAR(left.x() - right.x(), wanted(height), kTenth);
    EXPECT_NEAR(left.y(), right.y(), kTenth) << "no vertical disparity";
  }
  double apart_ = kApart;
  std::optional<Window> window_;
};

TEST_F(StudioStereo, SideBySideIsTheFormulaWithinATenthOfAPixel) {
  apart_ = kApart / 4;  // else the dot lies below the floating bar in pictures so narrow
  const Pair all = shown(Stereo::SideBySide);
  const int half = all.with.width() / 2, high = all.with.height();
  expectApart(middle(part(all, {0, 0, half, high}), grey), middle(part(all, {half, 0, half, high}), grey), high);
}

TEST_F(StudioStereo, TopBottomIsTheFormulaWithinATenthOfAPixel) {
  const Pair all = shown(Stereo::TopBottom);
  const int wide = all.with.width(), half = all.with.height() / 2;
  expectApart(middle(part(all, {0, 0, wide, half}), grey), middle(part(all, {0, half, wide, half}), grey), half);
}

TEST_F(StudioStereo, AnaglyphIsTheFormulaWithinATenthOfAPixel) {
  const Pair all = shown(Stereo::Anaglyph);
  const QPointF left = middle(all, [](QRgb c) { return qRed(c); }),
                right = middle(all, [](QRgb c) { return (qGreen(c) + qBlue(c)) / 2.0; });
  // A little of each eye is seen in the other's colours: only what the glasses are for is asked.
  EXPECT_NEAR(left.x() - right.x(), wanted(all.with.height()), kTenth);
}

// The rows as the screen counts them: the lowest is the right eye's.
TEST_F(StudioStereo, RowByRowIsTheFormulaWithinATenthOfAPixel) {
  const Pair all = shown(Stereo::Interleaved);
  const int wide = all.with.width(), high = all.with.height();
  QPointF middles[2];
  for (const int eye : {0, 1}) {
    const auto rowsOf = [&](const QImage& image) {
      QImage rows(wide, high / 2, QImage::Format_RGB32);
      for (int j = 0; j < high / 2; ++j)
        for (int i = 0; i < wide; ++i)
          rows.setPixel(i, j, image.pixel(i, high - 1 - (2 * (high / 2 - 1 - j) + 1 - eye)));
      return rows;
    };
    middles[eye] = middle({rowsOf(all.with), rowsOf(all.without)}, grey);
  }
  EXPECT_NEAR(middles[0].x() - middles[1].x(), wanted(high), kTenth);
  EXPECT_NEAR(2 * (middles[0].y() - middles[1].y()), 1, 2 * kTenth) << "a row of the one lies above one of the other";
}

// A screen for two pictures at once is not to be had under Xvfb. What is proved: the two pictures that QuadWindow is
// given are those of the left and the right eye, and it draws the first into the left buffer and the second into the
// right one, whatever they are; here they are two attachments of a framebuffer. Not proved: that a graphics card shows
// GL_BACK_LEFT to the left eye.
TEST_F(StudioStereo, TwoBuffersHoldEachEyesPictureWithinATenthOfAPixel) {
  const auto [with, without] = both(Stereo::Anaglyph, [&] {
    SpaceView& space = w().space();
    const int wide = space.width(), high = space.height();
    space.makeCurrent();
    unsigned target = 0, into[2] = {};
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glGenTextures(2, into);
    for (unsigned k = 0; k < 2; ++k) {
      glBindTexture(GL_TEXTURE_2D, into[k]);
      glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, wide, high, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + k, GL_TEXTURE_2D, into[k], 0);
    }
    glViewport(0, 0, wide, high);
    EyesApart().draw(space.eyes(), {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
    std::array<QImage, 2> seen;
    for (unsigned k = 0; k < 2; ++k) {
      QImage upward(wide, high, QImage::Format_RGBA8888);
      glReadBuffer(GL_COLOR_ATTACHMENT0 + k);
      glReadPixels(0, 0, wide, high, GL_RGBA, GL_UNSIGNED_BYTE, upward.bits());
      seen[k] = upward.mirrored();
    }
    glDeleteTextures(2, into);
    glDeleteFramebuffers(1, &target);
    space.doneCurrent();
    return seen;
  });
  expectApart(middle({with[0], without[0]}, grey), middle({with[1], without[1]}, grey), with[0].height());
}

}  // namespace
}  // namespace karinui::studio
