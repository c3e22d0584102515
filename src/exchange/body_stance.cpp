#include "exchange/body_stance.h"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace karinui
