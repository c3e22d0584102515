#include "view/legend.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/view/strain_scale.h"

namespace karinui {
namespace {

double emOf(const Image& image) { return std::max(9.0, std::min(image.height / 56.0, image.width / 30.0)); }

}  // namespace

void writeCaptions(Image& image, Lettering& lettering, const std::vector<std::string>& captions) {
  const double em = emOf(image);
  double y = 2.2 * em;
  for (const std::string& caption : captions) {
    // The first line is the title; a long one shrinks until it fits.
    double size = y < 2.5 * em ? em * 1.15 : em * 0.95;
    const double room = image.width - 2.4 * em, wide = lettering.width(caption, size);
    if (wide > room) size *= room / wide;
    lettering.write(image, caption, 1.2 * em, y, size, kInk);
    y += 1.6 * em;
  }
}

void drawLegend(Image& image, Lettering& lettering, Map map, double top, Language language) {
  const double em = emOf(image);
  const std::string title = text(map == Map::Pressure ? say("pressure") : say("strain"), language),
                    unit = map == Map::Pressure ? " kPa" : " %";
  const int high = static_cast<int>(std::lround(std::max(12 * em, image.height * 0.2))),
            wide = static_cast<int>(std::lround(1.1 * em));
  // Ticks at round numbers: fifths of 5 %, quarters of 2 %.
  const double number = map == Map::Pressure ? top / 1000 : 100 * top,
               share = number / std::pow(10, std::floor(std::log10(number) + 1e-9));
  const int ticks = std::fabs(share - 5) < 1e-6 || std::fabs(share - 1) < 1e-6 ? 5 : 4;
  int decimals = 0;
  while (decimals < 3 && std::fabs(number / ticks * std::pow(10, decimals) -
                                   std::round(number / ticks * std::pow(10, decimals))) > 1e-6)
    ++decimals;
  double labelWide = 0;
  for (int i = 0; i <= ticks; ++i)
    labelWide = std::max(labelWide, lettering.width(fixed(number * i / ticks, decimals) + unit, em * 0.85));
  const int left = static_cast<int>(image.width - 1.2 * em - labelWide - 0.5 * em - wide),
            upper = static_cast<int>(3.2 * em);
  const double titleWide = lettering.width(title, em);
  lettering.write(image, title, std::min<double>(left, image.width - 1.2 * em - titleWide), 2.2 * em, em, kInk);
  for (int y = -1; y <= high; ++y)
    for (int x = -1; x <= wide; ++x) {
      const int px = left + x, py = upper + y;
      if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
      const bool frame = x < 0 || y < 0 || x == wide || y == high;
      image.set(px, py, frame ? kInk : pixelOf(strainColour(1 - (y + 0.5) / high)));
    }
  for (int i = 0; i <= ticks; ++i) {
    const double y = upper + high * (1 - static_cast<double>(i) / ticks);
    for (int x = 0; x < static_cast<int>(0.3 * em); ++x) {
      const int px = left + wide + x, py = std::min(static_cast<int>(y), image.height - 1);
      if (px >= 0 && px < image.width) image.set(px, py, kInk);
    }
    lettering.write(image, fixed(number * i / ticks, decimals) + unit, left + wide + 0.5 * em, y + 0.3 * em, em * 0.85,
                    kInk);
  }
}

}  // namespace karinui
