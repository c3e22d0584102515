#pragma once
// Both eyes' pictures of a room, drawn off the screen.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "karinui/view/image.h"
#include "karinui/view/offscreen.h"
#include "person.h"
#include "room_renderer.h"

namespace karinui::room::test {

// A headset's views: canted outward angles larger than inward ones, and lower than upper.
inline constexpr FieldOfView kLeftFov{-0.90, 0.70, 0.72, -0.80}, kRightFov{-0.70, 0.90, 0.72, -0.80};
inline constexpr double kEyesApart = 0.063;

inline Rigid eyeOf(const Rigid& head, bool right) {
  Rigid eye = head;
  eye.carry += head.turned({right ? kEyesApart / 2 : -kEyesApart / 2, 0, 0});
  return eye;
}

class EyePictures : public ::testing::Test {
 protected:
  static constexpr int kWide = 960, kHigh = 960;
  static void SetUpTestSuite() {
    auto opened = OffscreenContext::open();
    if (!opened) {
      why_ = text(opened.error().what);
      return;
    }
    context_ = std::move(*opened);
    const OffscreenContext::Current current(*context_);
    auto made = RoomRenderer::make(true);
    if (made)
      picture_ = std::move(*made);
    else
      why_ = text(made.error().what);
  }
  static void TearDownTestSuite() {
    if (!context_) return;
    {
      const OffscreenContext::Current current(*context_);
      picture_.reset();
    }
    context_.reset();
  }
  void SetUp() override {
    if (!picture_) GTEST_SKIP() << "no off-screen OpenGL here: " << why_;
  }

  static Image eyePicture(const Rigid& eye, const FieldOfView& fov) {
    return tile(eye, fov, {.x = 0, .y = 0, .width = kWide, .height = kHigh});
  }
  // Part of a larger picture.
  static Image tile(const Rigid& eye, const FieldOfView& fov, const DrawArea& area) {
    const int wide = area.width, high = area.height;
    const OffscreenContext::Current current(*context_);
    GLuint target = 0, stores[2] = {};
    glGenFramebuffers(1, &target);
    glGenRenderbuffers(2, stores);
    glBindRenderbuffer(GL_RENDERBUFFER, stores[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, wide, high);
    glBindRenderbuffer(GL_RENDERBUFFER, stores[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, wide, high);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, stores[0]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, stores[1]);
    EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    picture_->draw(eye, fov, area);
    Image image(wide, high), flipped(wide, high);
    glReadPixels(0, 0, wide, high, GL_RGBA, GL_UNSIGNED_BYTE, flipped.rgba.data());
    const auto row = static_cast<std::ptrdiff_t>(4 * wide);
    for (int y = 0; y < high; ++y)
      std::copy_n(flipped.rgba.begin() + row * (high - 1 - y), row, image.rgba.begin() + row * y);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &target);
    glDeleteRenderbuffers(2, stores);
    return image;
  }

  static void take(const FittingRoom& room, const Person& person) {
    const OffscreenContext::Current current(*context_);
    picture_->take(room, person.head, person.seconds);
  }
  // Takes in, draws both eyes side by side, and leaves them where pictures are wanted.
  static Image show(const FittingRoom& room, const Person& person, const std::string& name) {
    take(room, person);
    Image both(2 * kWide, kHigh);
    both.paste(eyePicture(eyeOf(person.head, false), kLeftFov), 0, 0);
    both.paste(eyePicture(eyeOf(person.head, true), kRightFov), kWide, 0);
    if (const char* folder = std::getenv("KARINUI_PICTURES")) {
      EXPECT_TRUE(writePng((std::filesystem::path(folder) / (name + ".png")).string(), both));
    }
    return both;
  }

  inline static std::unique_ptr<OffscreenContext> context_;
  inline static std::unique_ptr<RoomRenderer> picture_;
  inline static std::string why_;
};

}  // namespace karinui::room::test
