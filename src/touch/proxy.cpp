#include "karinui/touch/proxy.h"

#include <algorithm>

namespace karinui {

namespace {

constexpr double kOverlap = 1e-7;  // metres: facets are so much larger than they are, so that no ray passes between two

bool within(const Facet& facet, Vec3 place) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = facet.corner[i], side = facet.corner[(i + 1) % 3] - from;
    const Vec3 inward = cross(facet.normal, side);
    if (dot(inward, place - from) < -kOverlap * length(side)) return false;
  }
  return true;
}

}  // namespace

// The facets that the proxy could meet on its way to the device, wherever it slides meanwhile: without friction it
// never ends further from the device than it began.
void Proxy::gather(Vec3 device, const TouchScene& scene, double friction) {
  const double reach = distance(place_, device) * (1 + friction) + 2 * kClear;
  nearCount_ = 0;
  all_ = false;
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    const Facet& facet = scene.facets[i];
    const double most = facet.radius + reach;
    if (squaredLength(facet.middle - device) > most * most) continue;
    if (nearCount_ == kMostNear) {
      all_ = true;
      return;
    }
    near_[nearCount_++] = static_cast<std::uint32_t>(i);
  }
}

double Proxy::firstHit(Vec3 from, Vec3 to, const TouchScene& scene, const Facet*& hit, double& side) const {
  double first = 1;
  hit = nullptr;
  const std::size_t count = all_ ? scene.facets.size() : nearCount_;
  for (std::size_t k = 0; k < count; ++k) {
    const Facet& facet = scene.facets[all_ ? k : near_[k]];
    double before = dot(facet.normal, from - facet.corner[0]), behind = dot(facet.normal, to - facet.corner[0]);
    double here = 1;
    if (facet.twoSided && before < 0) here = -1, before = -before, behind = -behind;
    if (before < 0 || behind >= 0) continue;
    const double share = before / (before - behind);
    if (share >= first && hit) continue;
    if (!within(facet, from + (to - from) * share)) continue;
    first = share;
    hit = &facet;
    side = here;
  }
  return first;
}

namespace {

// The nearest place to `wanted` that keeps all planes: an active set of at most three, found by trying each.
template <class Planes>
bool nearestAllowed(Vec3 wanted, const Planes& planes, std::size_t count, Vec3& best) {
  constexpr double kSlack = 1e-10;
  double least = 1e300;
  const auto consider = [&](Vec3 place) {
    const double away = squaredLength(place - wanted);
    if (!(away < least)) return;
    for (std::size_t i = 0; i < count; ++i)
      if (dot(planes[i].normal, place) < planes[i].offset - kSlack) return;
    least = away;
    best = place;
  };
  consider(wanted);
  const auto lacking = [&](std::size_t i) { return planes[i].offset - dot(planes[i].normal, wanted); };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = planes[i].normal;
    const double p = lacking(i);
    consider(wanted + a * p);
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3 b = planes[j].normal;
      const double q = lacking(j), ab = dot(a, b), bottom = 1 - ab * ab;
      if (bottom < 1e-9) continue;
      consider(wanted + a * ((p - q * ab) / bottom) + b * ((q - p * ab) / bottom));
      for (std::size_t k = j + 1; k < count; ++k) {
        const Vec3 c = planes[k].normal;
        const double det = dot(a, cross(b, c));
        if (std::fabs(det) < 1e-6) continue;
        consider((cross(b, c) * planes[i].offset + cross(c, a) * planes[j].offset + cross(a, b) * planes[k].offset) *
                 (1 / det));
      }
    }
  }
  return least < 1e300;
}

}  // namespace

Proxy::Contact Proxy::follow(Vec3 device, const TouchScene& scene, double friction) {
  if (!placed_) reset(device);
  gather(device, scene, friction);
  const Vec3 before = place_;
  std::array<Plane, kMostPlanes> planes;
  std::size_t count = 0;
  Vec3 goal = device;
  bool arrived = false;
  const Facet* facet = nullptr;
  double side = 1;
  while (!arrived) {
    firstHit(place_, goal, scene, facet, side);
    if (!facet) {
      place_ = goal;
      arrived = true;
      break;
    }
    // As near to the facet as it may come.
    const Vec3 normal = facet->normal * side;
    const double above = dot(normal, place_ - facet->corner[0]), below = dot(normal, goal - facet->corner[0]);
    if (above > kClear) place_ += (goal - place_) * ((above - kClear) / (above - below));
    if (count == kMostPlanes) break;
    planes[count++] = {normal, dot(normal, facet->corner[0]) + std::min(kClear, above)};
    if (!nearestAllowed(device, planes, count, goal)) break;
  }
  Contact contact;
  const Vec3 way = place_ - device;
  const double deep = length(way);
  contact.touching = count > 0 && deep > kClear;
  if (contact.touching && friction > 0) {
    const Vec3 normal = way * (1 / deep);
    Vec3 slide = place_ - before;
    slide = slide - normal * dot(slide, normal);
    const double slid = length(slide), sticks = friction * deep;
    if (slid > 0) {
      const Vec3 back = place_ - slide * std::min(1.0, sticks / slid);
      firstHit(place_, back, scene, facet, side);
      if (!facet) place_ = back;
    }
  }
  contact.proxy = place_;
  if (contact.touching) {
    contact.normal = normalized(place_ - device);
    contact.depth = std::max(0.0, distance(place_, device) - kClear);
  }
  return contact;
}

}  // namespace karinui
