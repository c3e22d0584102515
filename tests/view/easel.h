#pragma once
// One Picture for a test program, or a skip with the machine's own reason.
#include <gtest/gtest.h>

#include "karinui/view/picture.h"

namespace karinui::test {

class Easel : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto opened = Picture::open();
    if (opened)
      picture_ = std::move(*opened);
    else
      why_ = text(opened.error().what);
  }
  static void TearDownTestSuite() { picture_.reset(); }
  void SetUp() override {
    if (!picture_) GTEST_SKIP() << "no off-screen OpenGL here: " << why_;
  }

  static Image draw(const SceneFrame& frame, PictureOptions options) {
    auto image = picture_->draw(frame, options);
    EXPECT_TRUE(image) << (image ? "" : text(image.error().what));
    return image ? std::move(*image) : Image(1, 1);
  }
  static double luminance(Pixel p) {
    return 0.2126 * decodeSrgb(p[0] / 255.0) + 0.7152 * decodeSrgb(p[1] / 255.0) + 0.0722 * decodeSrgb(p[2] / 255.0);
  }
  inline static std::unique_ptr<Picture> picture_;
  inline static std::string why_;
};

}  // namespace karinui::test
