#include "session/print_tile.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr int kSide = 256;  // pixels of a tile
constexpr int kFiner = 4;   // samples a pixel, each way

// How much of the ink there is at a place of the repeat, as the renderer's shader has it.
double inkAt(ClothLook::Print print, double x, double y) {
  const auto stripe = [](double s, double share) { return std::fabs(s - std::floor(s) - 0.5) * 2 < share ? 1.0 : 0.0; };
  const auto off = [](double s) { return s - std::floor(s) - 0.5; };
  switch (print) {
    case ClothLook::Print::Stripe:
      return stripe(x, 0.42);
    case ClothLook::Print::Check:
      return 0.5 * (stripe(x, 0.5) + stripe(y, 0.5));
    case ClothLook::Print::Dot:
      return std::min(std::hypot(off(x), off(y)), std::hypot(off(x + 0.5), off(y + 0.5))) < 0.19 ? 1 : 0;
    default:
      return 0;
  }
}

// IEC 61966-2-1, the other way.
std::uint8_t onScreen(double linear) {
  const double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(s, 0.0, 1.0)));
}

}  // namespace

std::optional<SpatialLook::Tile> printTile(const ClothLook& look, const Colour& cloth) {
  if (look.print == ClothLook::Print::None) return std::nullopt;
  SpatialLook::Tile tile;
  const auto [across, along] = printAxes(look);
  tile.across = across, tile.along = along, tile.origin = look.origin;
  tile.wide = tile.high = look.repeat;
  if (look.print == ClothLook::Print::Photo) {
    if (!look.photo) return std::nullopt;
    tile.width = look.photo->width, tile.height = look.photo->height;
    tile.high = look.repeat * tile.height / tile.width;
    tile.rgb = look.photo->rgb;
    return tile;
  }
  tile.width = tile.height = kSide;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      double ink = 0;
      for (int j = 0; j < kFiner; ++j)
        for (int i = 0; i < kFiner; ++i)
          ink += inkAt(look.print, (column + (i + 0.5) / kFiner) / kSide, 1 - (row + (j + 0.5) / kFiner) / kSide);
      ink /= kFiner * kFiner;
      for (std::size_t c = 0; c < 3; ++c)
        tile.rgb.push_back(
            onScreen((1 - ink) * static_cast<double>(cloth[c]) + ink * static_cast<double>(look.ink[c])));
    }
  return tile;
}

}  // namespace karinui
