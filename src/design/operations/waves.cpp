#include "design/operations/waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr double kClothInWave = 0.24;  // metres
constexpr double kWidestSwing = 2.1;   // radians: beyond that neighbouring waves touch
constexpr double kWavePlaces = 0.002;  // metres between places

}  // namespace

Waves::Waves(const Girth& girth, double anchor, double low, double high, double arc) : girth_(girth), low_(low) {
  const double width = high - low;
  begins_ = anchor + low * arc / width;
  wave_ = width / std::fmax(1, std::round(width / kClothInWave));
  const auto count = static_cast<std::size_t>(std::ceil(width / kWavePlaces));
  step_ = width / static_cast<double>(count);
  places_.resize(count + 1);
  // The further the direction swings to and fro, the less of the girth is taken.
  double least = 0, most = kWidestSwing;
  for (int i = 0; i < 30; ++i) {
    const double swing = (least + most) / 2;
    (developed(swing).back().along - begins_ > arc ? least : most) = swing;
  }
  places_ = developed(least);
}

// A sine-generated curve (Langbein and Leopold, River Meanders, 1966) along the girth: what stands off it takes less of
// it, the less the more it is curved there.
std::vector<Waves::Place> Waves::developed(double swing) const {
  constexpr double kSide = 0.005;  // metres to either side by which the girth's stretch is known
  std::vector<Place> places{{begins_, 0}};
  for (std::size_t k = 0; k + 1 < places_.size(); ++k) {
    const double way = swing * std::sin(2 * std::numbers::pi * (static_cast<double>(k) + 0.5) * step_ / wave_);
    const Place& last = places.back();
    const double off = std::fmax(last.off + std::sin(way) * step_, 0), mean = (last.off + off) / 2;
    const double longer =
        distance(stands({last.along + kSide, mean}), stands({last.along - kSide, mean})) / (2 * kSide);
    places.push_back({last.along + std::cos(way) * step_ / std::fmax(longer, 0.5), off});
  }
  return places;
}

Flat Waves::stands(Place place) const { return girth_.at(place.along) + girth_.outwards(place.along) * place.off; }

Flat Waves::at(double s) const {
  const double share = std::clamp((s - low_) / step_, 0.0, static_cast<double>(places_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(share), places_.size() - 2);
  const double t = share - static_cast<double>(k);
  return stands(
      {std::lerp(places_[k].along, places_[k + 1].along, t), std::lerp(places_[k].off, places_[k + 1].off, t)});
}

}  // namespace karinui
