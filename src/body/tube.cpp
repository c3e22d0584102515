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
  upright_ = parallel_ && std::all_of(ring_.begin(), ring_.end(), [](const Section& s) { return s.normal.z == 0; });
  for (std::size_t i = 0; i + 1 < ring_.size(); ++i)
    reach_.push_back(std::max(ring_[i].shape[0], ring_[i + 1].shape[0]) * 2.2 + kPad +
                     distance(ring_[i].centre, ring_[i + 1].centre));
}

bool Tube::between(Vec3 p, std::size_t k, Along& along) const {
  const double before = beyond(p, k), now = beyond(p, k + 1);
  if (!(before >= 0 && now < 0)) return false;
  along = {k, before / std::max(before - now, 1e-12), lerp(level_[k].centre, level_[k + 1].centre, 0.5), reach_[k]};
  return true;
}

Tube::Along Tube::shortOfFirst(Vec3 p) const {
  const double first = beyond(p, 0);
  if (!(first < 0 && first > -kPad)) return {};
  return {0, 0, ring_[0].centre, ring_[0].shape[0] * 2.2 + kPad};
}

Tube::Along Tube::pastLast(Vec3 p) const {
  const std::size_t n = ring_.size();
  const double last = beyond(p, n - 1);
  if (!(last >= 0 && last < kPad)) return {};
  return {n - 2, 1, ring_[n - 1].centre, ring_[n - 1].shape[0] * 2.2 + kPad};
}

// The only interval there can be is found by halving.
Tube::Along Tube::alongParallel(Vec3 p) const {
  std::size_t start = 0, end = ring_.size() - 1;
  while (end - start > 1) {
    const std::size_t middle = (start + end) / 2;
    (beyond(p, middle) >= 0 ? start : end) = middle;
  }
  Along along;
  if (between(p, start, along)) return along;
  along = shortOfFirst(p);
  return along.reach < 0 ? pastLast(p) : along;
}

Section Tube::sectionAt(const Along& along) const {
  return blended(ring_[along.interval], ring_[along.interval + 1], along.t, harmonics_.coefficients());
}

void Tube::narrow(double x, double y, Column& to) const {
  to.interval.clear();
  if (upright_) {
    to.along = alongParallel({x, y, 0});
    if (to.along.reach >= 0) to.here = sectionAt(to.along);
    return;
  }
  if (parallel_) return;
  for (std::size_t k = 0; k < reach_.size(); ++k) {
    const Vec3 middle = lerp(level_[k].centre, level_[k + 1].centre, 0.5);
    const double dx = x - middle.x, dy = y - middle.y;
    if (dx * dx + dy * dy < reach_[k] * reach_[k]) to.interval.push_back(static_cast<std::uint32_t>(k));
  }
}

Tube::Value Tube::at(Vec3 p, const Column& column) const {
  const auto within = [&](const Along& along) {
    return along.reach >= 0 && squaredLength(p - along.middle) < along.reach * along.reach;
  };
  Along along;
  if (upright_) {
    along = column.along;
  } else if (parallel_) {
    along = alongParallel(p);
  } else {
    bool found = false;
    for (const std::uint32_t k : column.interval)
      if ((found = between(p, k, along) && within(along))) break;
    if (!found) found = within(along = shortOfFirst(p));
    if (!found) along = pastLast(p);
  }
  Value out;
  if (!within(along)) return out;
  const Section here = upright_ ? column.here : sectionAt(along);
  const Vec3 q = p - here.centre;
  const double a = dot(q, here.front), b = dot(q, here.side), far = std::sqrt(a * a + b * b);
  const double cosine = far > 0 ? a / far : 1, sine = far > 0 ? b / far : 0;
  out.across = std::min(kNowhere, far - radius(here.shape, harmonics_, cosine, sine));
  out.cap = std::max(-beyond(p, 0), beyond(p, ring_.size() - 1));
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
