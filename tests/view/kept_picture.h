#pragma once
// A picture against a kept one. When a change of the look is meant: run the test with KARINUI_ACCEPT_PICTURES=1, look
// at the kept pictures with your own eyes, and commit them with the change.
#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "karinui/view/image.h"

namespace karinui::test {

inline Image readPng(const std::string& path) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) return {};
  png.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (!png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr)) return {};
  return image;
}

inline void expectKept(const std::string& kept, const Image& image) {
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
  const std::string now = ::testing::TempDir() + "karinui_now_" + std::filesystem::path(kept).filename().string();
  if (!same) (void)writePng(now, image);
  EXPECT_TRUE(same) << "mean miss " << sum / count << " of 255, " << 100 * far / count << " % far off; now: " << now
                    << "\nIf the change is meant, accept it as told at the top of tests/view/kept_picture.h.";
}

}  // namespace karinui::test
