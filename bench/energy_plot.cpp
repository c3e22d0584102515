#include "bench/energy_plot.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui::bench {
namespace {

constexpr double kWidth = 640, kHeight = 400, kLeft = 70, kRight = 620, kTop = 40, kBottom = 350;

struct LogAxis {
  double low = 1, high = 10;  // values, powers of ten
  double from = 0, to = 1;    // on the drawing
  LogAxis(double least, double most, double start, double end)
      : low(std::pow(10, std::floor(std::log10(least)))),
        high(std::pow(10, std::ceil(std::log10(most) + 1e-9))),
        from(start),
        to(end) {}
  double at(double value) const {
    return std::lerp(from, to, std::log(std::max(value, low) / low) / std::log(high / low));
  }
};

std::string at(double x, double y) { return fixed(x, 1) + " " + fixed(y, 1); }
std::string word(double x, double y, const std::string& anchor, const std::string& words) {
  return "<text x=\"" + fixed(x, 0) + "\" y=\"" + fixed(y, 0) + "\" text-anchor=\"" + anchor +
         "\" fill=\"#333\" font-size=\"12\">" + words + "</text>\n";
}
std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
  return "<path d=\"M" + at(x1, y1) + "L" + at(x2, y2) + "\" stroke=\"" + colour + "\"/>\n";
}

}  // namespace

std::string energyPlot(const std::string& scene, const SettleReport& report) {
  if (report.energy.size() < 2) return {};
  constexpr double kMicro = 1e6, kLeast = 0.1;  // microjoules: less is drawn as this
  double lowest = report.energy.front().joules, highest = lowest;
  for (const EnergySample& sample : report.energy) {
    lowest = std::min(lowest, sample.joules);
    highest = std::max(highest, sample.joules);
  }
  const double start = std::max(1e-3, report.energy.front().cpuSeconds);
  const LogAxis x(start, std::max(10 * start, report.energy.back().cpuSeconds), kLeft, kRight);
  const LogAxis y(kLeast, std::max(10 * kLeast, (highest - lowest) * kMicro), kBottom, kTop);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + at(kWidth, kHeight) +
                    "\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (double value = x.low; value < 1.5 * x.high; value *= 10)
    svg += line(x.at(value), kTop, x.at(value), kBottom, "#ddd") +
           word(x.at(value), kBottom + 18, "middle", shortest(value));
  for (double value = y.low; value < 1.5 * y.high; value *= 10)
    svg += line(kLeft, y.at(value), kRight, y.at(value), "#ddd") +
           word(kLeft - 6, y.at(value) + 4, "end", shortest(value));
  svg += word((kLeft + kRight) / 2, kBottom + 38, "middle", "processor seconds");
  svg += word(kLeft, kTop - 18, "start", scene + ": energy above the lowest, microjoules; finest level");
  std::string path;
  for (const EnergySample& sample : report.energy)
    path += (path.empty() ? "M" : "L") + at(x.at(sample.cpuSeconds), y.at((sample.joules - lowest) * kMicro));
  svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"2\"/>\n";
  if (report.continuation && report.fineSteps > 0 && report.fineSteps <= report.energy.size()) {
    const double called = x.at(report.energy[report.fineSteps - 1].cpuSeconds);
    svg += line(called, kTop, called, kBottom, "#c33") + word(called + 4, kTop + 14, "start", "called rest");
  }
  return svg + "</svg>\n";
}

}  // namespace karinui::bench
