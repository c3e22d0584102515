#include "karinui/view/image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "karinui/base/file.h"

namespace karinui {

Image::Image(int wide, int high, Pixel filled) : width(wide), height(high) {
  KARINUI_ASSERT(wide > 0 && high > 0);
  rgba.resize(std::size_t{4} * static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    std::copy(filled.begin(), filled.end(), rgba.begin() + static_cast<std::ptrdiff_t>(i));
}

namespace {

std::size_t placeOf(const Image& image, int x, int y) {
  KARINUI_ASSERT(x >= 0 && y >= 0 && x < image.width && y < image.height);
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

}  // namespace

Pixel Image::at(int x, int y) const {
  const std::uint8_t* p = &rgba[placeOf(*this, x, y)];
  return {p[0], p[1], p[2], p[3]};
}

void Image::set(int x, int y, Pixel p) { std::copy(p.begin(), p.end(), &rgba[placeOf(*this, x, y)]); }

void Image::paste(const Image& other, int x, int y) {
  const int from = std::max(0, -x), to = std::min(other.width, width - x);
  if (from >= to) return;
  for (int row = std::max(0, -y); row < std::min(other.height, height - y); ++row)
    std::memcpy(&rgba[placeOf(*this, x + from, y + row)], &other.rgba[placeOf(other, from, row)],
                std::size_t{4} * static_cast<std::size_t>(to - from));
}

double encodeSrgb(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decodeSrgb(double encoded) {
  encoded = std::clamp(encoded, 0.0, 1.0);
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Pixel pixelOf(const Colour& linear) {
  const auto byte = [](float c) {
    return static_cast<std::uint8_t>(std::lround(255 * encodeSrgb(std::isfinite(c) ? c : 0)));
  };
  return {byte(linear[0]), byte(linear[1]), byte(linear[2]), 255};
}

Result<std::vector<std::uint8_t>> encodePng(const Image& image) {
  KARINUI_ASSERT(image.rgba.size() ==
                 std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  png.flags = PNG_IMAGE_FLAG_FAST;
  // Asking for the exact size first would compress twice; the bound is generous but exact to keep.
  std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = bytes.size();
  const int good = png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgba.data(), 0, nullptr);
  if (!good) return badInput(say("The picture could not be written as PNG: {0}.", png.message));
  bytes.resize(size);
  return bytes;
}

Done writePng(const std::string& path, const Image& image) {
  const auto bytes = encodePng(image);
  if (!bytes) return bytes.error();
  return writeFile(path, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace karinui
