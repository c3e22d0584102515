#include "cloth/pose_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace karinui {
namespace {

constexpr double kPart = 0.01;       // metres that skin near cloth goes in a part of the way: half a hand's thickness;
constexpr double kFarPart = 0.04;    // other skin, which
constexpr double kFar = 0.06;        // is so far from any cloth
constexpr double kFirstPart = 0.01;  // of the way: the part that is tried first
constexpr double kAim = 0.9;         // of what a part may be: what the next one is aimed at
constexpr int kTries = 20;           // to find where a part ends

// Whether there is cloth near a place of the skin, by cells of kFar and an edge of the cloth.
class ClothNear {
 public:
  ClothNear(const std::vector<Vec3>& cloth, double spacing, const Box& skin) : side_(kFar + spacing) {
    low_ = skin.low - Vec3{1, 1, 1} * (2.5 * side_);  // cloth beside the skin's outermost cells has all cells around it
    const Vec3 high = (skin.high - low_) * (1 / side_);
    count_ = {static_cast<std::size_t>(high.x) + 3, static_cast<std::size_t>(high.y) + 3,
              static_cast<std::size_t>(high.z) + 3};
    near_.assign(count_[0] * count_[1] * count_[2], 0);
    std::vector<std::uint8_t> own = near_;
    for (const Vec3& p : cloth) {
      const Vec3 in = (p - low_) * (1 / side_);
      const auto inside = [](double at, std::size_t count) { return at >= 1 && at < static_cast<double>(count - 1); };
      if (!inside(in.x, count_[0]) || !inside(in.y, count_[1]) || !inside(in.z, count_[2])) continue;
      const auto [cx, cy, cz] = cellAt(in);
      if (std::uint8_t& here = own[number(cx, cy, cz)]; here == 0) {
        here = 1;
        for (std::size_t x = cx - 1; x <= cx + 1; ++x)
          for (std::size_t y = cy - 1; y <= cy + 1; ++y)
            for (std::size_t z = cz - 1; z <= cz + 1; ++z) near_[number(x, y, z)] = 1;
      }
    }
  }
  bool operator()(Vec3 skin) const {
    const auto [x, y, z] = cellAt((skin - low_) * (1 / side_));
    return near_[number(x, y, z)] != 0;
  }

 private:
  static std::array<std::size_t, 3> cellAt(Vec3 in) {
    return {static_cast<std::size_t>(in.x), static_cast<std::size_t>(in.y), static_cast<std::size_t>(in.z)};
  }
  std::size_t number(std::size_t x, std::size_t y, std::size_t z) const { return (x * count_[1] + y) * count_[2] + z; }
  double side_;
  Vec3 low_;
  std::array<std::size_t, 3> count_{};
  std::vector<std::uint8_t> near_;
};

}  // namespace

PoseWay::PoseWay(const Skeleton& skeleton, const BodyPose& from, const BodyPose& to)
    : skeleton_(skeleton), from_(skeleton.whole(from)), to_(skeleton.whole(to)), next_(kFirstPart) {
  placements_ = skeleton_.placements(pose());
  points_ = skeleton_.points(placements_);
}

void PoseWay::goOn(const std::vector<Vec3>& cloth, double spacing) {
  const ClothNear near(cloth, spacing, boxOf(points_));
  std::vector<double> most(points_.size());
  std::transform(points_.begin(), points_.end(), most.begin(),
                 [&](Vec3 p) { return near(p) ? kPart * kPart : kFarPart * kFarPart; });
  const double from = share_;
  const std::vector<Vec3> before = std::move(points_);
  for (int k = 1;; ++k) {
    share_ = from + next_ < 1 ? from + next_ : 1;
    placements_ = skeleton_.placements(pose());
    points_ = skeleton_.points(placements_);
    double used = 0;  // of what it may be
    for (std::size_t i = 0; i < before.size(); ++i)
      used = std::fmax(used, squaredLength(points_[i] - before[i]) / most[i]);
    used = std::sqrt(used);
    next_ = (share_ - from) * kAim / std::fmax(used, 0.1);
    if (used <= 1 || k == kTries) return;
  }
}

}  // namespace karinui
