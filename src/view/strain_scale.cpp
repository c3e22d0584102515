#include "karinui/view/strain_scale.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

// Stops in OKLab (B. Ottosson, 2020), evenly spaced: lightness rises by the same step, the hue goes blue - grey -
// yellow, the one pair that red-blind, green-blind and full colour vision all tell apart.
struct Stop {
  double light, a, b;
};
constexpr Stop kStops[] = {{0.30, -0.010, -0.105}, {0.41, -0.020, -0.085}, {0.52, -0.022, -0.035},
                           {0.63, -0.012, 0.020},  {0.74, -0.006, 0.070},  {0.85, -0.004, 0.120},
                           {0.96, -0.020, 0.150}};
constexpr int kSteps = static_cast<int>(std::size(kStops)) - 1;

Colour linearOf(const Stop& s) {
  const double l = s.light + 0.3963377774 * s.a + 0.2158037573 * s.b;
  const double m = s.light - 0.1055613458 * s.a - 0.0638541728 * s.b;
  const double n = s.light - 0.0894841775 * s.a - 1.2914855480 * s.b;
  const double l3 = l * l * l, m3 = m * m * m, n3 = n * n * n;
  const auto kept = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
  return {kept(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * n3),
          kept(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * n3),
          kept(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * n3)};
}

}  // namespace

Colour strainColour(double share) {
  if (!(share > 0)) share = 0;
  const double place = std::min(share, 1.0) * kSteps;
  const int low = std::min(static_cast<int>(place), kSteps - 1);
  const double t = place - low;
  const Stop &p = kStops[low], &q = kStops[low + 1];
  return linearOf({p.light + (q.light - p.light) * t, p.a + (q.a - p.a) * t, p.b + (q.b - p.b) * t});
}

double strainTop(const SceneFrame& frame) {
  std::vector<float> all;
  for (const SceneCloth& cloth : frame.cloths)
    if (cloth.strain.size() == cloth.mesh.points.size())
      std::copy_if(cloth.strain.begin(), cloth.strain.end(), std::back_inserter(all),
                   [](float s) { return std::isfinite(s); });
  if (all.empty()) return 0;
  const std::size_t nth = (all.size() - 1) * 99 / 100;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(nth), all.end());
  const double wanted = std::clamp(static_cast<double>(all[nth]), 0.005, 1e6);
  const double ten = std::pow(10, std::floor(std::log10(wanted) + 1e-9));
  for (const double round : {1.0, 2.0, 5.0})
    if (wanted <= round * ten * (1 + 1e-6)) return round * ten;
  return 10 * ten;
}

}  // namespace karinui
