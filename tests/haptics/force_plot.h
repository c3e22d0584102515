#pragma once
// Force over time of each operation, as one SVG for the manual in each language: written where KARINUI_PICTURES says.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "karinui/base/number.h"

namespace karinui {

struct ForcePlot {
  std::string name;
  struct Place {
    double seconds = 0, newtons = 0;
    bool down = false;  // the button
  };
  std::vector<Place> places;
};

inline std::string plotsAsSvg(const std::vector<ForcePlot>& plots, bool japanese) {
  constexpr double kWide = 300, kHigh = 150, kLeft = 46, kTop = 34, kGapX = 56, kGapY = 62, kMost = 1.5;
  const auto words = [&](const char* english, const char* other) { return std::string(japanese ? other : english); };
  const auto title = [&](const std::string& name) {
    if (!japanese) return name;
    if (name == "draw") return std::string("描く");
    if (name == "move") return std::string("動かす");
    if (name == "sew") return std::string("縫う");
    if (name == "cut") return std::string("切る");
    if (name == "pull") return std::string("引く");
    return std::string("形を変える");
  };
  const double width = kLeft + 3 * kWide + 2 * kGapX + 20, height = kTop + 2 * kHigh + kGapY + 66;
  const auto n = [](double value) { return fixed(value, 1); };
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + n(width) + " " + n(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n<rect width=\"100%\" "
                    "height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t k = 0; k < plots.size(); ++k) {
    const ForcePlot& plot = plots[k];
    const double x0 = kLeft + static_cast<double>(k % 3) * (kWide + kGapX),
                 y0 = kTop + static_cast<double>(k / 3) * (kHigh + kGapY);
    const double ends = std::max(1.0, std::ceil(plot.places.back().seconds));
    const auto x = [&](double seconds) { return x0 + kWide * seconds / ends; };
    const auto y = [&](double newtons) { return y0 + kHigh * (1 - newtons / kMost); };
    // The button is down.
    for (std::size_t i = 0; i < plot.places.size();) {
      std::size_t j = i;
      while (j < plot.places.size() && plot.places[j].down == plot.places[i].down) ++j;
      if (plot.places[i].down)
        svg += "<rect x=\"" + n(x(plot.places[i].seconds)) + "\" y=\"" + n(y0) + "\" width=\"" +
               n(x(plot.places[j - 1].seconds) - x(plot.places[i].seconds)) + "\" height=\"" + n(kHigh) +
               "\" fill=\"#f3ead9\"/>\n";
      i = j;
    }
    for (const double newtons : {0.0, 0.5, 1.0})
      svg += "<path d=\"M" + n(x0) + " " + n(y(newtons)) + "h" + n(kWide) + "\" stroke=\"#ccc\"/><text x=\"" +
             n(x0 - 6) + "\" y=\"" + n(y(newtons) + 4) + "\" text-anchor=\"end\">" + fixed(newtons, 1) + "</text>\n";
    const double stride = ends > 12 ? 5 : ends > 5 ? 2 : 1;
    for (double s = 0; s <= ends; s += stride)
      svg += "<text x=\"" + n(x(s)) + "\" y=\"" + n(y0 + kHigh + 16) + "\" text-anchor=\"middle\">" + fixed(s, 0) +
             "</text>\n";
    svg += "<text x=\"" + n(x0) + "\" y=\"" + n(y0 - 8) + "\" font-weight=\"bold\">" + title(plot.name) + "</text>\n";
    // The largest of each pixel's worth.
    std::string path;
    const std::size_t stretch = std::max<std::size_t>(1, plot.places.size() / static_cast<std::size_t>(2 * kWide));
    for (std::size_t i = 0; i < plot.places.size(); i += stretch) {
      double most = 0;
      for (std::size_t j = i; j < std::min(i + stretch, plot.places.size()); ++j)
        most = std::max(most, plot.places[j].newtons);
      path += (path.empty() ? "M" : "L") + n(x(plot.places[i].seconds)) + " " + n(y(std::min(most, kMost)));
    }
    svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#b5451f\" stroke-width=\"1.5\"/>\n";
  }
  svg += "<text x=\"" + n(kLeft) + "\" y=\"" + n(height - 14) + "\">" +
         words("newtons over seconds; shaded: the button is down; gain one half, so half of the true force",
               "縦軸はニュートン、横軸は秒。網かけはボタンを押している間。ゲインは半分（実際の力の半分）") +
         "</text>\n</svg>\n";
  return svg;
}

inline void keepPlots(const std::vector<ForcePlot>& plots) {
  const char* folder = std::getenv("KARINUI_PICTURES");
  if (!folder || !*folder) return;
  std::ofstream(std::filesystem::path(folder) / "touch_forces.svg") << plotsAsSvg(plots, false);
  std::ofstream(std::filesystem::path(folder) / "touch_forces.ja.svg") << plotsAsSvg(plots, true);
}

}  // namespace karinui
