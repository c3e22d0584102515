#include "karinui/session/key_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace karinui {

namespace {

constexpr std::array kSteps{0.002, 0.01, 0.05};  // metres
using Where = PointerSample::Where;
using Phase = PointerSample::Phase;

std::array<double, 2> inPicture(const Sight& sight, Vec3 place) {
  const Vec3 way = place - sight.eye;
  const double deep = std::max(1e-6, -dot(way, sight.back));
  return {dot(way, sight.right) / deep, dot(way, sight.up) / deep};
}

}  // namespace

double KeyHand::step() const { return kSteps[static_cast<std::size_t>(longer_)]; }

PointerSample KeyHand::now(const Sight& sight) const {
  PointerSample sample = last_;
  sample.ray = {sight.eye, normalized(sight.right * x_ + sight.up * y_ - sight.back)};
  sample.facing = sight.back;
  sample.place = place_;
  return sample;
}

void KeyHand::arrow(double right, double up, const Sight& sight) {
  if (last_.where == Where::Table) {
    place_ += Flat{right, up} * step();
    return;
  }
  const double wide = 0.98 * sight.tanHalf * sight.aspect, high = 0.98 * sight.tanHalf;
  x_ = std::clamp(x_ + right * step() / sight.distance, -wide, wide);
  y_ = std::clamp(y_ + up * step() / sight.distance, -high, high);
}

PointerSample KeyHand::said(Phase phase, const Around& around) const {
  PointerSample sample = now(around.sight);
  sample.phase = phase;
  return sample;
}

// From a stop to the one after it; from anywhere else to the nearest.
void KeyHand::goToStop(int by, const Around& around) {
  const std::vector<Stop> stops = stopsOf(around.fitting, around.table, around.stops, last_, around.sight);
  if (stops.empty()) return;
  const double same = last_.reach / 20;
  std::size_t nearest = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto [x, y] = inPicture(around.sight, stops[i].space);
    const double away = last_.where == Where::Table ? distance(stops[i].table, place_) : std::hypot(x - x_, y - y_);
    if (away < least) least = away, nearest = i;
  }
  if (least < same) nearest = (nearest + stops.size() + static_cast<std::size_t>(by)) % stops.size();
  place_ = stops[nearest].table;
  const auto at = inPicture(around.sight, stops[nearest].space);
  x_ = at[0], y_ = at[1];
}

std::vector<PointerSample> KeyHand::strike(KeyStroke key, const PointerSample& with, const Around& around) {
  const bool first = !awake_ || with.where != last_.where;
  last_ = with;
  if (first) {
    awake_ = true, down_ = false;
    goToStop(0, around);
    return {said(Phase::Hover, around)};
  }
  switch (key) {
    case KeyStroke::Left:
      arrow(-1, 0, around.sight);
      break;
    case KeyStroke::Right:
      arrow(1, 0, around.sight);
      break;
    case KeyStroke::Up:
      arrow(0, 1, around.sight);
      break;
    case KeyStroke::Down:
      arrow(0, -1, around.sight);
      break;
    case KeyStroke::Next:
    case KeyStroke::Previous:
      goToStop(key == KeyStroke::Next ? 1 : -1, around);
      break;
    case KeyStroke::Shorter:
    case KeyStroke::Longer:
      longer_ = std::clamp(longer_ + (key == KeyStroke::Longer ? 1 : -1), 0, static_cast<int>(kSteps.size()) - 1);
      return {};
    case KeyStroke::Press:
      if (std::exchange(down_, false)) return {said(Phase::Release, around)};
      if (around.clicks) return {said(Phase::Press, around), said(Phase::Release, around)};
      down_ = true;
      return {said(Phase::Press, around)};
  }
  return {said(down_ ? Phase::Drag : Phase::Hover, around)};
}

}  // namespace karinui
