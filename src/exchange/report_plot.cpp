#include "report_plot.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui {
namespace {

constexpr double kTitleSize = 4.2, kLabelSize = 3.2, kSmall = 2.6, kRow = 13, kBar = 10;  // mm
constexpr double kName = 42, kCount = 34;                        // mm, left and right of the axis
constexpr double kLight = 0.68, kDark = 0.15, kLineGrey = 0.45;  // greys
constexpr std::size_t kBars = 40;

// 1, 2 or 5 times a power of ten, not below `value`.
double roundStep(double value) {
  const double ten = std::pow(10, std::floor(std::log10(std::fmax(value, 1e-9))));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * ten >= value * (1 - 1e-9)) return step * ten;
  return 10 * ten;
}

// From a round number to a round number. One value far off does not squeeze the others: what lies beyond 98 of 100 may
// lie beyond the axis, and is counted in its last bar.
struct Axis {
  double low = 0, step = 1;
  int steps = 1;
  bool more = false, less = false;  // there are values beyond its ends
  double high() const { return low + step * steps; }
  double share(double value) const { return std::clamp((value - low) / (high() - low), 0.0, 1.0); }
};
Axis axisOf(const ReportPlot& plot) {
  std::vector<double> all;
  for (const ReportPlot::Row& row : plot.rows) all.insert(all.end(), row.values.begin(), row.values.end());
  std::sort(all.begin(), all.end());
  const auto beyond = static_cast<std::ptrdiff_t>(all.size() / 50);
  double low = std::fmin(0, plot.limit), high = std::fmax(0, plot.limit);
  if (!all.empty()) low = std::fmin(low, *(all.begin() + beyond)), high = std::fmax(high, *(all.end() - 1 - beyond));
  if (high <= low) high = low + 1;
  Axis axis;
  axis.step = roundStep((high - low) / 8);
  axis.low = axis.step * std::floor(low / axis.step * (1 + 1e-9));
  axis.steps = std::max(1, static_cast<int>(std::ceil((high - axis.low) / axis.step - 1e-9)));
  axis.more = !all.empty() && all.back() > axis.high(), axis.less = !all.empty() && all.front() < axis.low;
  return axis;
}

void words(PdfCanvas& canvas, const std::string& what, Mm at, double size, bool centred = false) {
  canvas.words({at, size, true, what}, centred);
}

}  // namespace

double plotHigh(const ReportPlot& plot) { return kTitleSize + 6 + kRow * static_cast<double>(plot.rows.size()) + 9; }

void drawPlot(PdfCanvas& canvas, const ReportPlot& plot, Mm corner, double wide, Language language) {
  const Axis axis = axisOf(plot);
  const double left = corner.x + kName, across = wide - kName - kCount;
  const auto at = [&](double value) { return left + across * axis.share(value); };
  words(canvas, text(plot.heading, language), {corner.x, corner.y + 3}, kTitleSize);
  const double top = corner.y + kTitleSize + 6;
  double base = top;
  for (const ReportPlot::Row& row : plot.rows) {
    base += kRow;
    const std::string name = text(row.name, language);
    const double size = kLabelSize * std::fmin(1, (kName - 3) / std::fmax(1, canvas.wide(name, kLabelSize)));
    words(canvas, name, {corner.x, base - 4}, size);
    // A bar lies on one side of the limit: those of values beyond it are dark.
    std::vector<std::size_t> within(kBars), beyond(kBars);
    std::size_t bad = 0;
    for (const double value : row.values) {
      const bool out = plot.least ? value < plot.limit : value > plot.limit;
      bad += out;
      ++(out ? beyond : within)[std::min(kBars - 1, static_cast<std::size_t>(axis.share(value) * kBars))];
    }
    std::size_t most = 1;
    for (std::size_t i = 0; i < kBars; ++i) most = std::max(most, within[i] + beyond[i]);
    for (std::size_t i = 0; i < kBars; ++i) {
      const double x = left + across * static_cast<double>(i) / kBars, barWide = across / kBars - 0.3;
      double from = base;
      for (const auto& [count, grey] : {std::pair(within[i], kLight), {beyond[i], kDark}}) {
        if (count == 0) continue;
        const double to = from - kBar * static_cast<double>(count) / static_cast<double>(most);
        canvas.colour(grey);
        canvas.moveTo({x, from}), canvas.lineTo({x + barWide, from}), canvas.lineTo({x + barWide, to});
        canvas.lineTo({x, to}), canvas.close(), canvas.fill();
        from = to;
      }
    }
    canvas.colour(kLineGrey);
    canvas.moveTo({left, base}), canvas.lineTo({left + across, base}), canvas.stroke(0.2, false);
    canvas.colour(0);
    const std::string counted = row.values.empty() ? text(say("Nothing is known."), language)
                                                   : text(say("{0} of {1} beyond", bad, row.values.size()), language);
    words(canvas, counted, {left + across + 3, base - 4}, kLabelSize);
    if (row.values.empty()) continue;
    std::vector<double> sorted = row.values;
    std::sort(sorted.begin(), sorted.end());
    const double middle = at(sorted[(sorted.size() - 1) / 2]);  // half of them are no greater
    canvas.moveTo({middle, base + 1.2}), canvas.lineTo({middle, base - 1.6}), canvas.stroke(0.6, false);
  }
  canvas.colour(0);
  canvas.moveTo({at(plot.limit), top}), canvas.lineTo({at(plot.limit), base});
  canvas.stroke(0.25, std::vector<double>{1, 1});
  for (int i = 0; i <= axis.steps; ++i) {
    const double value = axis.low + axis.step * i;
    std::string label = shortest(std::round(value * 1e6) / 1e6 + 0.0);
    if (i == 0 && axis.less) label = "≤ " + label;
    if (i == axis.steps) label = (axis.more ? "≥ " : "") + label + " " + plot.unit;
    canvas.moveTo({at(value), base}), canvas.lineTo({at(value), base + 1}), canvas.stroke(0.2, false);
    words(canvas, label, {at(value), base + 3.4}, kSmall, true);
  }
}

}  // namespace karinui
