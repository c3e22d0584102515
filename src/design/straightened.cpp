#include "design/straightened.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/message.h"
#include "karinui/geometry/homography.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

// Of the rectangle's longer side: what is farther out is left off. Nearer where the horizon is in the picture, for
// towards it everything becomes endless.
constexpr double kBeyond = 20, kBeforeHorizon = 2;

Flat flipped(Flat picture) { return {picture.u, -picture.v}; }

// Between the four pixels around a place (from the picture's corner); white beyond the picture.
void sample(const PrintPixels& picture, Flat at, std::uint8_t* rgb) {
  const double x = at.u - 0.5, y = at.v - 0.5;
  if (!(x > -1 && y > -1 && x < picture.width && y < picture.height)) {
    std::fill(rgb, rgb + 3, std::uint8_t{255});
    return;
  }
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto pixel = [&](int i, int j, std::size_t c) {
    const int px = std::clamp(i, 0, picture.width - 1), py = std::clamp(j, 0, picture.height - 1);
    return static_cast<double>(picture.rgb[3 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
                                                static_cast<std::size_t>(px)) +
                                           c]);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const double above = std::lerp(pixel(x0, y0, c), pixel(x0 + 1, y0, c), x - x0),
                 below = std::lerp(pixel(x0, y0 + 1, c), pixel(x0 + 1, y0 + 1, c), x - x0);
    rgb[c] = static_cast<std::uint8_t>(std::lround(std::lerp(above, below, y - y0)));
  }
}

}  // namespace

Result<Straightened> straightened(const PrintPixels& picture, const std::array<Flat, 4>& corners, Flat sides) {
  std::array<Flat, 4> seen;
  std::transform(corners.begin(), corners.end(), seen.begin(), flipped);
  if (!convex(seen))
    return refused(say("These four places are no corners of a rectangle: click them one after the other, round it."));
  constexpr double kLeast = 0.01, kMost = 20;  // metres
  if (!(std::min(sides.u, sides.v) >= kLeast && std::max(sides.u, sides.v) <= kMost))
    return refused(
        say("Say how large the rectangle is, as rectangle=21cm,29.7cm: from the first corner to the second, "
            "and to the third."));
  // The first side keeps the nearest of the four directions, and the picture is not turned over.
  const Flat way = seen[1] - seen[0];
  const Flat along =
      std::fabs(way.u) >= std::fabs(way.v) ? Flat{way.u > 0 ? 1.0 : -1.0, 0} : Flat{0, way.v > 0 ? 1.0 : -1.0};
  const Flat aside = leftOf(along) * (cross(way, seen[2] - seen[1]) > 0 ? 1 : -1);
  const std::array<Flat, 4> paper{Flat{}, along * sides.u, along * sides.u + aside * sides.v, aside * sides.v};
  const auto toPaper = Homography::through(seen, paper), toPicture = Homography::through(paper, seen);
  if (!toPaper || !toPicture)
    return refused(say("These four places are no corners of a rectangle: click them one after the other, round it."));

  FlatBox whole;
  auto [least, most] = boxOf(paper);
  const double sign = toPaper->depth(seen[0]) > 0 ? 1 : -1;
  const double w = picture.width, h = picture.height;
  bool horizon = false;
  for (const Flat corner : {Flat{0, 0}, Flat{w, 0}, Flat{w, -h}, Flat{0, -h}}) {
    horizon = horizon || !(sign * toPaper->depth(corner) > 0);
    if (!horizon) whole.include((*toPaper)(corner));
  }
  const double far = (horizon ? kBeforeHorizon : kBeyond) * std::max(sides.u, sides.v);
  least = least - Flat{far, far}, most = most + Flat{far, far};
  const Flat low = horizon ? least : Flat{std::max(whole.low.u, least.u), std::max(whole.low.v, least.v)};
  const Flat high = horizon ? most : Flat{std::min(whole.high.u, most.u), std::min(whole.high.v, most.v)};

  // As fine as the rectangle was photographed, on the average.
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) area += 0.5 * cross(seen[i], seen[(i + 1) % 4]);
  const Flat size = high - low;
  const double pitch =
      std::max(std::sqrt(sides.u * sides.v / std::fabs(area)), std::max(size.u, size.v) / kMostScanSide);
  Straightened made;
  made.image.width = std::clamp(static_cast<int>(size.u / pitch), 1, kMostScanSide);
  made.image.height = std::clamp(static_cast<int>(size.v / pitch), 1, kMostScanSide);
  made.width = made.image.width * pitch;
  made.middle = {low.u + 0.5 * made.width, high.v - 0.5 * made.image.height * pitch};
  made.image.rgb.resize(std::size_t{3} * static_cast<std::size_t>(made.image.width) *
                        static_cast<std::size_t>(made.image.height));
  const double ahead = toPicture->depth(paper[0]) > 0 ? 1 : -1;
  std::uint8_t* rgb = made.image.rgb.data();
  for (int y = 0; y < made.image.height; ++y)
    for (int x = 0; x < made.image.width; ++x, rgb += 3) {
      const Flat on{low.u + (x + 0.5) * pitch, high.v - (y + 0.5) * pitch};
      sample(picture, ahead * toPicture->depth(on) > 0 ? flipped((*toPicture)(on)) : Flat{-9, -9}, rgb);
    }
  return made;
}

}  // namespace karinui
