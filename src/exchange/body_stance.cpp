#include "exchange/body_stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "karinui/geometry/bvh.h"
#include "karinui/geometry/section.h"

namespace karinui {

namespace {

// Shares of the height, the soles at 0.
constexpr std::array kShins{0.08, 0.13, 0.18, 0.23, 0.28};
constexpr std::size_t kShinsParted = 4;  // so many of them at least show two legs
constexpr std::array kHeads{0.93, 0.96};
constexpr std::array kSoles{0.012, 0.03};
constexpr double kAnkle = 0.075;
constexpr double kTall = 0.7;        // of the longest side: a person is not much wider than tall
constexpr double kAlike = 0.5;       // areas of two legs, the smaller of the larger
constexpr double kBesideLegs = 0.4;  // of a leg's area: anything else there is smaller
constexpr double kWideHead = 0.25;   // with its hair
constexpr double kToes = 0.01;       // a foot's middle lies farther before the ankle's, of the height
constexpr double kSmall = 0.02;      // of the largest area in a section: a finger, a crumb
constexpr double kHips = 0.48, kChest = 0.7, kTrunkStep = 0.02;
constexpr double kBroad = 1.15;                         // as broad as deep: a rounder section has no axis to trust
constexpr std::size_t kTrunkSections = 5;               // so many of those at least
constexpr double kTrunkSpread = std::numbers::pi / 60;  // that agree within, on the median

struct Patch {  // of the solid in a level section
  Box box;
  double area = 0;
};

// The larger first; what lies within another is no part of its own.
std::vector<Patch> patchesAt(const TriangleMesh& mesh, Vec3 up, double height) {
  std::vector<Patch> all;
  for (const SectionLoop& loop : section(mesh, {up * height, up}))
    if (loop.points.size() >= 3) all.push_back({boxOf(loop.points), std::abs(enclosedArea(loop.points, up))});
  std::stable_sort(all.begin(), all.end(), [](const Patch& a, const Patch& b) { return a.area > b.area; });
  std::vector<Patch> own;
  for (const Patch& patch : all) {
    const bool within = std::any_of(own.begin(), own.end(), [&](const Patch& o) {
      const Vec3 away = patch.box.centre() - o.box.centre(), room = o.box.size() * 0.5;
      const double miss = 1e-9 * length(room);  // along the plane's normal there is no room
      return std::abs(away.x) <= room.x + miss && std::abs(away.y) <= room.y + miss &&
             std::abs(away.z) <= room.z + miss;
    });
    if (!within && (own.empty() || patch.area > kSmall * own[0].area)) own.push_back(patch);
  }
  return own;
}

bool twoLegs(const std::vector<Patch>& patches) {
  return patches.size() >= 2 && patches[1].area > kAlike * patches[0].area &&
         (patches.size() == 2 || patches[2].area < kBesideLegs * patches[1].area);
}

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

bool personUp(const TriangleMesh& mesh, Vec3 up, double sole, double height) {
  std::size_t parted = 0;
  for (const double share : kShins) parted += twoLegs(patchesAt(mesh, up, sole + share * height));
  return parted >= kShinsParted && std::all_of(kHeads.begin(), kHeads.end(), [&](double share) {
           const auto head = patchesAt(mesh, up, sole + share * height);
           const Vec3 size = head.empty() ? Vec3{} : head[0].box.size();
           return head.size() == 1 && std::max({size.x, size.y, size.z}) < kWideHead * height;
         });
}

// Second moments of area about the centroid, of a loop in a level plane (Green's theorem over its edges).
struct AreaMoments {
  double xx = 0, zz = 0, xz = 0;
};
AreaMoments areaMoments(const std::vector<Vec3>& loop) {
  const Vec3 from = loop.front();  // near the loop, so that little cancels
  double area = 0, x = 0, z = 0;
  AreaMoments sum;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 a = loop[k] - from, b = loop[(k + 1) % loop.size()] - from;
    const double twice = a.x * b.z - b.x * a.z;
    area += twice / 2;
    x += twice * (a.x + b.x) / 6;
    z += twice * (a.z + b.z) / 6;
    sum.xx += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
    sum.zz += twice * (a.z * a.z + a.z * b.z + b.z * b.z) / 12;
    sum.xz += twice * (2 * a.x * a.z + a.x * b.z + b.x * a.z + 2 * b.x * b.z) / 24;
  }
  const double to = area < 0 ? -1 : 1;  // whichever way it runs
  return {to * (sum.xx - x * x / area), to * (sum.zz - z * z / area), to * (sum.xz - x * z / area)};
}

double medianOf(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

}  // namespace

std::optional<Uprightness> uprightnessOf(const TriangleMesh& mesh) {
  const Box box = boxOf(mesh.points);
  const Vec3 size = box.size();
  std::optional<Uprightness> found;
  for (const int axis : {0, 1, 2}) {
    const double height = along(size, axis);
    if (!(height > 0) || height < kTall * std::max({size.x, size.y, size.z})) continue;
    for (const bool down : {false, true}) {
      const double to = down ? -1 : 1;
      const Vec3 up{axis == 0 ? to : 0, axis == 1 ? to : 0, axis == 2 ? to : 0};
      if (!personUp(mesh, up, down ? -along(box.high, axis) : along(box.low, axis), height)) continue;
      if (found) return std::nullopt;
      found = {axis, down};
    }
  }
  return found;
}

std::optional<Facing> facingOf(const TriangleMesh& mesh) {
  const Vec3 up{0, 1, 0};
  const Box box = boxOf(mesh.points);
  const double height = box.size().y;
  const auto at = [&](double share) { return patchesAt(mesh, up, box.low.y + share * height); };
  const auto ankles = at(kAnkle);
  if (!twoLegs(ankles)) return std::nullopt;
  Vec3 side = ankles[1].box.centre() - ankles[0].box.centre();
  side.y = 0;
  if (!(length(side) > 1e-3 * height)) return std::nullopt;
  side = normalized(side);
  const Vec3 middle = (ankles[0].box.centre() + ankles[1].box.centre()) * 0.5, front = cross(side, up);
  std::array<double, 2> low{1e9, 1e9}, high{-1e9, -1e9};  // of each foot, along `front`
  for (const double share : kSoles)
    for (const SectionLoop& loop : section(mesh, {{0, box.low.y + share * height, 0}, up}))
      for (const Vec3 p : loop.points) {
        const std::size_t foot = dot(p - middle, side) > 0;
        low[foot] = std::min(low[foot], dot(p, front)), high[foot] = std::max(high[foot], dot(p, front));
      }
  std::array<double, 2> toes{};
  for (const std::size_t foot : {0, 1})
    toes[foot] = 0.5 * (low[foot] + high[foot]) - dot(ankles[foot].box.centre(), front);
  const double least = kToes * height;
  const bool ahead = toes[0] > least && toes[1] > least, behind = toes[0] < -least && toes[1] < -least;
  if (!ahead && !behind) return std::nullopt;
  Facing facing{ahead ? front : -1 * front, kShins.back()};
  for (double share = kShins.back(); share < 0.6 && twoLegs(at(share)); share += 0.01) facing.legs = share;
  return facing;
}

std::optional<double> trunkAngle(const TriangleMesh& mesh) {
  const Vec3 up{0, 1, 0};
  const Box box = boxOf(mesh.points);
  std::vector<double> angles;
  for (double share = kHips; share < kChest; share += kTrunkStep) {
    const auto loops = section(mesh, {{0, box.low.y + share * box.size().y, 0}, up});
    const auto areaOf = [&](const SectionLoop& loop) { return std::abs(enclosedArea(loop.points, up)); };
    const auto trunk = std::max_element(
        loops.begin(), loops.end(), [&](const SectionLoop& a, const SectionLoop& b) { return areaOf(a) < areaOf(b); });
    if (trunk == loops.end() || !(areaOf(*trunk) > 0)) continue;
    const AreaMoments m = areaMoments(trunk->points);
    const double mean = (m.xx + m.zz) / 2, apart = std::hypot((m.xx - m.zz) / 2, m.xz);
    if (mean + apart < kBroad * kBroad * (mean - apart)) continue;
    angles.push_back(-0.5 * std::atan2(2 * m.xz, m.xx - m.zz));  // the long axis lies as far from x towards -z
  }
  if (angles.size() < kTrunkSections) return std::nullopt;
  const double middle = medianOf(angles);
  for (double& angle : angles) angle = std::abs(angle - middle);
  if (medianOf(angles) > kTrunkSpread) return std::nullopt;
  return middle;
}

}  // namespace karinui
