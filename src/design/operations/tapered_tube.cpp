#include "design/operations/tapered_tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace karinui {

namespace {

constexpr double kStep = 0.02;   // metres from level to level
constexpr double kBand = 0.04;   // skin this far above and below a level counts there
constexpr double kSlit = 0.002;  // between the two sides

// How wide an outline is at a height.
double widthAt(const Ring& paper, double height) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < paper.size(); ++i) {
    const Flat a = paper[i], b = paper[(i + 1) % paper.size()];
    if ((a.v < height) == (b.v < height)) continue;
    const double u = a.u + (b.u - a.u) * (height - a.v) / (b.v - a.v);
    low = std::fmin(low, u), high = std::fmax(high, u);
  }
  return std::fmax(0, high - low);
}

// Where a ray from a ring's middle leaves it, as a place of that ring.
Flat leaving(const Ring& ring, Flat way) {
  Flat middle;
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Flat a = ring[i] - ring.front(), b = ring[(i + 1) % ring.size()] - ring.front();
    const double part = cross(a, b);
    twice += part, middle += (a + b) * (part / 3);
  }
  middle = ring.front() + middle * (1 / twice);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Flat a = ring[i] - middle, b = ring[(i + 1) % ring.size()] - middle;
    const double ca = cross(way, a), cb = cross(way, b);
    if (ca <= 0 && cb > 0 && ca != cb) return middle + lerp(a, b, ca / (ca - cb));
  }
  return ring.front();
}

}  // namespace

Girth::Girth(Ring ring) : ring_(std::move(ring)) {
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    start_.push_back(length_);
    length_ += distance(ring_[i], ring_[(i + 1) % ring_.size()]);
  }
}

Flat Girth::at(double s) const {
  s -= std::floor(s / length_) * length_;
  const auto next = std::upper_bound(start_.begin(), start_.end(), s);
  const auto i = static_cast<std::size_t>(next - start_.begin()) - 1;
  const Flat a = ring_[i], b = ring_[(i + 1) % ring_.size()];
  const double part = distance(a, b);
  return part > 0 ? lerp(a, b, std::fmin(1, (s - start_[i]) / part)) : a;
}

Flat Girth::outwards(double s) const {
  constexpr double kAbout = 0.005;  // metres to either side
  const Flat way = normalized(at(s + kAbout) - at(s - kAbout));
  return {way.v, -way.u};
}

double Girth::nearest(Flat place) const {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Flat a = ring_[i], way = ring_[(i + 1) % ring_.size()] - a;
    const double whole = dot(way, way);
    const double t = whole > 0 ? std::clamp(dot(place - a, way) / whole, 0.0, 1.0) : 0;
    if (const double d = distance(place, a + way * t); d < least) least = d, best = start_[i] + t * std::sqrt(whole);
  }
  return best;
}

TaperedTube::TaperedTube(const Ring& paper, const std::vector<SkinPlace>& skin, double ease) {
  const FlatBox box = boxOf(paper);
  const int count = std::max(1, static_cast<int>(std::ceil((box.high.v - box.low.v) / kStep)));
  const auto heightOf = [&](int k) { return box.low.v + (box.high.v - box.low.v) * k / count; };
  double widest = box.low.v, most = 0;
  for (int k = 0; k <= count; ++k)
    if (const double width = widthAt(paper, heightOf(k)); width > most) most = width, widest = heightOf(k);
  std::vector<Flat> all;
  for (const SkinPlace& p : skin) all.push_back(p.place);
  Ring tape = hull(std::move(all));
  double off = std::fmax(ease, 1e-4);
  for (int k = 0; k <= count; ++k) {
    const double height = heightOf(k);
    std::vector<Flat> near;
    for (const SkinPlace& p : skin)
      if (std::abs(p.height - height) <= kBand) near.push_back(p.place);
    if (near.size() >= 3) tape = hull(std::move(near));  // else beyond the limb's end
    // A cap grows narrower upwards but stands off as the sleeve does where it is widest.
    if (height <= widest)
      off =
          std::fmax(std::fmax(ease, 1e-4), (widthAt(paper, height) + kSlit - perimeter(tape)) / (2 * std::numbers::pi));
    const Ring ring = grown(tape, off);
    Level level{height, Girth(ring), 0};
    level.front = level.girth.nearest(leaving(ring, {0, -1}));
    levels_.push_back(std::move(level));
  }
}

Vec3 TaperedTube::place(Flat paper, const LimbFrame& limb) const {
  const double from = levels_.front().height, step = (levels_.back().height - from) / double(levels_.size() - 1);
  const double k = std::clamp((paper.v - from) / step, 0.0, static_cast<double>(levels_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(k), levels_.size() - 2);
  const auto at = [&](const Level& level) { return level.girth.at(level.front + paper.u); };
  return limb.inSpace(lerp(at(levels_[i]), at(levels_[i + 1]), k - static_cast<double>(i)), paper.v);
}

}  // namespace karinui
