#include "design/operations/spiral.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kPitch = 0.01;        // metres from turn to turn, which a drape closes
constexpr double kSpiralStep = 0.002;  // metres between places

}  // namespace

Spiral::Spiral(const Girth& girth, double anchor, double low, double high, bool lowOnTop) {
  const auto on = [&](double s) {
    const double beneath = lowOnTop ? high - s : s - low;  // from the end that lies at the bottom
    return girth.at(anchor + s) + girth.outwards(anchor + s) * (kPitch * std::fmax(beneath, 0) / girth.length());
  };
  // A turn that lies on another is longer than the girth: measured along itself, both ways from the anchor.
  const auto walk = [&](double end) {
    std::vector<Place> places{{0, on(0)}};
    const double step = std::copysign(kSpiralStep, end);
    for (double s = step; std::fabs(places.back().s) < std::fabs(end); s += step) {
      const Flat next = on(s);
      places.push_back({places.back().s + std::copysign(distance(places.back().place, next), end), next});
    }
    return places;
  };
  places_ = walk(low);
  std::reverse(places_.begin(), places_.end());
  const std::vector<Place> onwards = walk(high);
  places_.insert(places_.end(), onwards.begin() + 1, onwards.end());
}

Flat Spiral::at(double s) const {
  const auto next = std::lower_bound(places_.begin() + 1, places_.end() - 1, s,
                                     [](const Place& place, double wished) { return place.s < wished; });
  const Place &before = *(next - 1), &after = *next;
  const double part = after.s > before.s ? (s - before.s) / (after.s - before.s) : 0;
  return lerp(before.place, after.place, part);
}

}  // namespace karinui
