#include "karinui/session/keyboard_pointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace karinui {

namespace {

constexpr std::array kSteps{0.002, 0.01, 0.05};  // metres
using Where = PointerSample::Where;
using Phase = PointerSample::Phase;

std::array<double, 2> inPicture(const Viewpoint& viewpoint, Vec3 place) {
  const Vec3 way = place - viewpoint.eye;
  const double deep = std::max(1e-6, -dot(way, viewpoint.back));
  return {dot(way, viewpoint.right) / deep, dot(way, viewpoint.up) / deep};
}

}  // namespace

double KeyboardPointer::step() const { return kSteps[static_cast<std::size_t>(longer_)]; }

PointerSample KeyboardPointer::now(const Viewpoint& viewpoint) const {
  PointerSample sample = last_;
  sample.ray = {viewpoint.eye, normalized(viewpoint.right * x_ + viewpoint.up * y_ - viewpoint.back)};
  sample.facing = viewpoint.back;
  sample.place = place_;
  return sample;
}

void KeyboardPointer::arrow(double right, double up, const Viewpoint& viewpoint) {
  if (last_.where == Where::Table) {
    place_ += Flat{right, up} * step();
    return;
  }
  const double wide = 0.98 * viewpoint.tanHalf * viewpoint.aspect, high = 0.98 * viewpoint.tanHalf;
  x_ = std::clamp(x_ + right * step() / viewpoint.distance, -wide, wide);
  y_ = std::clamp(y_ + up * step() / viewpoint.distance, -high, high);
}

PointerSample KeyboardPointer::said(Phase phase, const Around& around) const {
  PointerSample sample = now(around.viewpoint);
  sample.phase = phase;
  return sample;
}

// From a stop to the one after it; from anywhere else to the nearest.
void KeyboardPointer::goToStop(int by, const Around& around) {
  const std::vector<KeyStop> keyStops =
      keyStopsOf(around.snapshot, around.table, around.keyStops, last_, around.viewpoint);
  if (keyStops.empty()) return;
  const double same = last_.reach / 20;
  std::size_t nearest = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < keyStops.size(); ++i) {
    const auto [x, y] = inPicture(around.viewpoint, keyStops[i].space);
    const double away = last_.where == Where::Table ? distance(keyStops[i].table, place_) : std::hypot(x - x_, y - y_);
    if (away < least) least = away, nearest = i;
  }
  if (least < same) nearest = (nearest + keyStops.size() + static_cast<std::size_t>(by)) % keyStops.size();
  place_ = keyStops[nearest].table;
  const auto at = inPicture(around.viewpoint, keyStops[nearest].space);
  x_ = at[0], y_ = at[1];
}

std::vector<PointerSample> KeyboardPointer::strike(KeyStroke key, const PointerSample& with, const Around& around) {
  const bool first = !awake_ || with.where != last_.where;
  last_ = with;
  if (first) {
    awake_ = true, down_ = false;
    goToStop(0, around);
    return {said(Phase::Hover, around)};
  }
  switch (key) {
    case KeyStroke::Left:
      arrow(-1, 0, around.viewpoint);
      break;
    case KeyStroke::Right:
      arrow(1, 0, around.viewpoint);
      break;
    case KeyStroke::Up:
      arrow(0, 1, around.viewpoint);
      break;
    case KeyStroke::Down:
      arrow(0, -1, around.viewpoint);
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
