#pragma once
// How many steps cloth still has to go, by the slope of its energy. What a step lets the energy fall by shrinks about
// evenly on a logarithmic scale, from a millimetre of the cloth's weight to some ten nanometres at rest, though single
// folds that snap make it jump: so means over a window are compared with those of the window before.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

namespace karinui {

class RestForecast {
 public:
  // After each step: what the energy fell by, over the cloth's weight; metres.
  void add(double fall) { logs_.push_back(std::log(std::clamp(std::fabs(fall), kLeast, 1.0))); }
  // None while too few steps were seen or while nothing shrinks.
  std::optional<double> stepsLeft() const {
    if (logs_.size() < 2 * kWindow) return std::nullopt;
    const auto mean = [&](std::size_t back) {
      const auto end = logs_.end() - static_cast<std::ptrdiff_t>(back);
      return std::accumulate(end - static_cast<std::ptrdiff_t>(kWindow), end, 0.0) / kWindow;
    };
    const double now = mean(0), shrinking = (mean(kWindow) - now) / kWindow;
    if (!(shrinking > kLeastShrinking)) return std::nullopt;
    return std::max(0.0, (now - std::log(kAtRest)) / shrinking);
  }

 private:
  static constexpr std::size_t kWindow = 15;  // steps
  static constexpr double kAtRest = 3e-8;     // metres: seen at called rest 1e-9 to 1e-7
  static constexpr double kLeast = 1e-12;
  static constexpr double kLeastShrinking = 0.005;  // of the logarithm, a step: half in 140 steps
  std::vector<double> logs_;
};

}  // namespace karinui
