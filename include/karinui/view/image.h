#pragma once
// A finished picture in memory: rows from the top, four bytes a pixel (red, green, blue, opacity), in the sRGB values
// that files and screens use. A plain value; any thread may read.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

using Pixel = std::array<std::uint8_t, 4>;

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height

  Image() = default;
  Image(int wide, int high, Pixel filled = {255, 255, 255, 255});
  Pixel at(int x, int y) const;                  // inside the image only
  void set(int x, int y, Pixel p);               // inside the image only
  void paste(const Image& other, int x, int y);  // what sticks out is cut off
};

// Linear light to sRGB and back, one channel in [0, 1] (IEC 61966-2-1).
double encodeSrgb(double linear);
double decodeSrgb(double encoded);
Pixel pixelOf(const Colour& linear);

// The bytes of a PNG file.
Result<std::vector<std::uint8_t>> encodePng(const Image& image);

// Writes the file whole or not at all (base/file.h): a picture that is there stays until the new one is complete.
Done writePng(const std::string& path, const Image& image);

}  // namespace karinui
