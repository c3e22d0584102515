#include "view/stereo.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kLeft[3][3] = {
    {0.4561, 0.500484, 0.176381}, {-0.0400822, -0.0378246, -0.0157589}, {-0.0152161, -0.0205971, -0.00546856}};
constexpr double kRight[3][3] = {
    {-0.0434706, -0.0879388, -0.00155529}, {0.378476, 0.73364, -0.0184503}, {-0.0721527, -0.112961, 1.2264}};

}  // namespace

Image anaglyph(const Image& left, const Image& right) {
  KARINUI_ASSERT(left.width == right.width && left.height == right.height);
  std::array<double, 256> linear;
  for (std::size_t i = 0; i < 256; ++i) linear[i] = decodeSrgb(static_cast<double>(i) / 255);
  std::array<std::uint8_t, 4096> encoded;
  for (std::size_t i = 0; i < encoded.size(); ++i)
    encoded[i] = static_cast<std::uint8_t>(std::lround(255 * encodeSrgb(static_cast<double>(i) / 4095)));
  Image both(left.width, left.height);
  for (std::size_t i = 0; i < both.rgba.size(); i += 4)
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c)
        sum += kLeft[row][c] * linear[left.rgba[i + c]] + kRight[row][c] * linear[right.rgba[i + c]];
      both.rgba[i + row] = encoded[static_cast<std::size_t>(std::lround(4095 * std::fmin(1, std::fmax(0, sum))))];
    }
  return both;
}

}  // namespace karinui
