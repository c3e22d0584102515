#include "geometry/field_brick.h"

#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kRounding = 1e-6;  // metres, more than floats lose on a body

// By how much each circle comes within `reach` of (x, y, z), as a difference of squares: below zero it does not.
KARINUI_WIDE void comeNear(std::size_t count, const float* __restrict cx, const float* __restrict cy,
                           const float* __restrict cz, const float* __restrict nx, const float* __restrict ny,
                           const float* __restrict nz, const float* __restrict radius, float x, float y, float z,
                           float reach, float* __restrict room) {
  KARINUI_APART
  for (std::size_t k = 0; k < count; ++k) {
    const float a = x - cx[k], b = y - cy[k], c = z - cz[k];
    const float above = a * nx[k] + b * ny[k] + c * nz[k], left = reach * reach - above * above;
    const float beside = std::sqrt(left > 0 ? left : 0) + radius[k];
    room[k] = left < 0 ? left : beside * beside - (a * a + b * b + c * c - above * above);
  }
}

}  // namespace

bool FieldBrick::take(const Count& first, const Count& count, double band) {
  faces_.clear();
  circles_.clear();
  const Vec3 low = grid_.place(first[0], first[1], first[2]);
  const Vec3 high = grid_.place(first[0] + count[0] - 1, first[1] + count[1] - 1, first[2] + count[2] - 1);
  middle_ = (low + high) * 0.5;
  const double half = distance(middle_, high);
  const auto near = bvh_.nearest(middle_, band + half);
  if (!near) return false;
  const double reach = std::fmin(near->distance + 2 * half, band + half) + kRounding;
  const Vec3 around{reach, reach, reach};
  bvh_.touching({middle_ - around, middle_ + around}, [&](std::uint32_t face) {
    const Corners c = cornersOf(mesh_, mesh_.faces[face]);
    const Vec3 centre = (c[0] + c[1] + c[2]) * (1.0 / 3);
    double radius = 0;
    for (Vec3 corner : c) radius = std::fmax(radius, distance(corner, centre));
    if (distance(centre, middle_) - radius > reach) return;
    faces_.push_back(c);
    circles_.add(centre - middle_, normalized(cross(c[1] - c[0], c[2] - c[0])), radius + kRounding);
  });
  last_ = 0;
  return !faces_.empty();
}

std::optional<double> FieldBrick::distanceAt(Vec3 place, double band) {
  double best = band * band;
  bool found = false;
  const auto ask = [&](std::size_t k) {
    const Corners& c = faces_[k];
    const auto w = nearestWeights(c, place);
    const double squared = squaredLength(c[0] * w[0] + c[1] * w[1] + c[2] * w[2] - place);
    if (squared > best) return;
    best = squared;
    found = true;
    last_ = k;
  };
  ask(last_);  // what was nearest to the last point
  const Vec3 from = place - middle_;
  room_.resize(faces_.size());
  comeNear(faces_.size(), circles_.x.data(), circles_.y.data(), circles_.z.data(), circles_.nx.data(),
           circles_.ny.data(), circles_.nz.data(), circles_.radius.data(), static_cast<float>(from.x),
           static_cast<float>(from.y), static_cast<float>(from.z), static_cast<float>(std::sqrt(best) + kRounding),
           room_.data());
  for (std::size_t k = 0; k < room_.size(); ++k)
    if (!(room_[k] < 0)) ask(k);
  return found ? std::optional(std::sqrt(best)) : std::nullopt;
}

}  // namespace karinui
