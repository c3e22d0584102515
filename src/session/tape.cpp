#include "karinui/session/tape.h"

#include <algorithm>

#include "karinui/geometry/section.h"

namespace karinui {

namespace {

// The loop of the figure's section that comes nearest to the hand: a leg, not both.
std::vector<Vec3> loopOfSkin(const TriangleMesh& skin, const Plane& level, Vec3 hand) {
  std::vector<Vec3> best;
  double nearest = 1e9;
  for (const SectionLoop& loop : section(skin, level))
    for (const Vec3 point : loop.points)
      if (const double d = distance(point, hand); d < nearest) nearest = d, best = loop.points;
  return best;
}

}  // namespace

Tape tapeAt(const GarmentSnapshot& snapshot, const Hit& hit) {
  Tape tape;
  const Plane level{hit.point, {0, 1, 0}};
  if (hit.on == Hit::On::Cloth) {
    for (const SceneCloth& cloth : snapshot.frame.cloths)
      for (const SectionLoop& loop : section(cloth.mesh, level))
        tape.line.insert(tape.line.end(), loop.points.begin(), loop.points.end());
  } else if (hit.on == Hit::On::Body && snapshot.body) {
    tape.line = loopOfSkin(snapshot.body->mesh(), level, hit.point);
  }
  if (tape.line.size() < 3) return {};
  tape.line = tightTape(tape.line, level.normal);
  if (tape.line.empty()) return {};
  const auto nearer = [&](Vec3 a, Vec3 b) { return distance(a, hit.point) < distance(b, hit.point); };
  std::rotate(tape.line.begin(), std::min_element(tape.line.begin(), tape.line.end(), nearer), tape.line.end());
  tape.length = lineLength(tape.line, true);
  tape.line.push_back(tape.line.front());
  return tape;
}

}  // namespace karinui
