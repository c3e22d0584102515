#include "body/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr double kPad = 0.04;
constexpr int kSteps = 4;  // from station to station

Section blended(const Section& a, const Section& b, double t, int coefficients) {
  Section out;
  out.centre = lerp(a.centre, b.centre, t);
  out.side = lerp(a.side, b.side, t);
  out.front = lerp(a.front, b.front, t);
  for (int k = 0; k < coefficients; ++k) out.shape[k] = std::lerp(a.shape[k], b.shape[k], t);
  return out;
}

}  // namespace

Tube::Tube(const std::vector<Section>& stations, Harmonics harmonics) : harmonics_(harmonics) {
  const int n = static_cast<int>(stations.size());
  const auto mix = [&](int i, double t) {
    const Section &b = stations[i], &c = stations[i + 1];
    const Section &before = stations[std::max(0, i - 1)], &after = stations[std::min(n - 1, i + 2)];
    const auto spline = [&](auto part) {
      // The ends are continued straight.
      const auto pb = part(b), pc = part(c);
      const auto pa = i > 0 ? part(before) : pb * 2.0 - pc;
      const auto pd = i + 2 < n ? part(after) : pc * 2.0 - pb;
      return (pb * 2.0 + (pc - pa) * t + (pa * 2.0 - pb * 5.0 + pc * 4.0 - pd) * (t * t) +
              (pb * 3.0 - pa - pc * 3.0 + pd) * (t * t * t)) *
             0.5;
    };
    Section out;
    out.centre = spline([](const Section& s) { return s.centre; });
    out.normal = normalized(spline([](const Section& s) { return s.normal; }));
    out.side = spline([](const Section& s) { return s.side; });
    out.front = spline([](const Section& s) { return s.front; });
    for (int k = 0; k < harmonics_.coefficients(); ++k)
      out.shape[k] = spline([k](const Section& s) { return s.shape[k]; });
    return out;
  };
  for (int i = 0; i + 1 < n; ++i)
    for (int s = 0; s < kSteps; ++s) ring_.push_back(mix(i, double(s) / kSteps));
  ring_.push_back(stations.back());
  for (const Section& s : ring_) level_.push_back({s.centre, s.normal});
  parallel_ = std::all_of(ring_.begin(), ring_.end(),
                          [&](const Section& s) { return squaredLength(s.normal - ring_[0].normal) < 1e-24; });
  for (std::size_t i = 1; i < ring_.size(); ++i)
    parallel_ = parallel_ && dot(ring_[i].centre - ring_[i - 1].centre, ring_[0].normal) > 0;
  for (std::size_t i = 0; i + 1 < ring_.size(); ++i)
    reach_.push_back(std::max(ring_[i].shape[0], ring_[i + 1].shape[0]) * 2.2 + kPad +
                     distance(ring_[i].centre, ring_[i + 1].centre));
}

void Tube::narrow(double x, double y, Column& to) const {
  to.interval.clear();
  if (parallel_) return;  // found by halving
  for (std::size_t k = 0; k < reach_.size(); ++k) {
    const Vec3 middle = lerp(level_[k].centre, level_[k + 1].centre, 0.5);
    const double dx = x - middle.x, dy = y - middle.y;
    if (dx * dx + dy * dy < reach_[k] * reach_[k]) to.interval.push_back(static_cast<std::uint32_t>(k));
  }
}

Tube::Value Tube::at(Vec3 p, const Column& column) const {
  const std::size_t n = ring_.size();
  const auto beyond = [&](std::size_t k) { return dot(p - level_[k].centre, level_[k].normal); };
  const double first = beyond(0), last = beyond(n - 1);
  const auto within = [&](Vec3 centre, double reach) { return squaredLength(p - centre) < reach * reach; };
  Value out;
  std::size_t low = n;
  double t = 0;
  const auto lies = [&](std::size_t k) {
    const double before = beyond(k), now = beyond(k + 1);
    if (!(before >= 0 && now < 0 && within(lerp(level_[k].centre, level_[k + 1].centre, 0.5), reach_[k]))) return false;
    low = k;
    t = before / std::max(before - now, 1e-12);
    return true;
  };
  if (parallel_) {  // the only interval there can be
    std::size_t start = 0, end = n - 1;
    while (end - start > 1) {
      const std::size_t middle = (start + end) / 2;
      (beyond(middle) >= 0 ? start : end) = middle;
    }
    lies(start);
  } else {
    for (const std::uint32_t k : column.interval)
      if (lies(k)) break;
  }
  if (low == n) {
    if (first < 0 && first > -kPad && within(ring_[0].centre, ring_[0].shape[0] * 2.2 + kPad)) {
      low = 0, t = 0;
    } else if (last >= 0 && last < kPad && within(ring_[n - 1].centre, ring_[n - 1].shape[0] * 2.2 + kPad)) {
      low = n - 2, t = 1;
    } else {
      return out;
    }
  }
  const Section here = blended(ring_[low], ring_[low + 1], t, harmonics_.coefficients());
  const Vec3 q = p - here.centre;
  const double a = dot(q, here.front), b = dot(q, here.side), far = std::sqrt(a * a + b * b);
  const double cosine = far > 0 ? a / far : 1, sine = far > 0 ? b / far : 0;
  out.across = std::min(kNowhere, far - radius(here.shape, harmonics_, cosine, sine));
  out.cap = std::max(-first, last);
  return out;
}

void Tube::bounds(Vec3& low, Vec3& high) const {
  low = {1e9, 1e9, 1e9};
  high = {-1e9, -1e9, -1e9};
  for (const Section& s : ring_)
    for (int i = 0; i < 24; ++i) {
      const double t = 2 * std::numbers::pi * i / 24, c = std::cos(t), sn = std::sin(t);
      const Vec3 p = s.centre + (s.front * c + s.side * sn) * radius(s.shape, harmonics_, c, sn);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
}

}  // namespace karinui
