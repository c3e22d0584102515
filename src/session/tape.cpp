#include "karinui/session/tape.h"

#include <algorithm>

#include "karinui/geometry/section.h"
#include "session/parts_at.h"

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

bool isArm(BodyPoint::Part part) { return part == BodyPoint::Part::LeftArm || part == BodyPoint::Part::RightArm; }

// Cloth lies on the skin that is nearest: in an armpit a section of the figure cannot tell arm and trunk apart.
BodyPoint::Part partUnder(const Body& body, Vec3 place) {
  const auto skin = body.bvh().nearest(place);
  const auto part = skin ? body.describe(skin->place).part : BodyPoint::Part::Torso;
  return part == BodyPoint::Part::Face ? BodyPoint::Part::Torso : part;
}

std::vector<Vec3> clothAlong(const GarmentSnapshot& snapshot, const Plane& level, BodyPoint::Part part, Vec3 hand) {
  constexpr double kWidest = 0.4;  // metres that a sleeve reaches from the hand
  std::vector<Vec3> all;
  if (isArm(part)) {
    for (const SceneCloth& cloth : snapshot.frame.cloths)
      for (const SectionLoop& loop : section(cloth.mesh, level))
        for (const Vec3 p : loop.points)
          if (distance(p, hand) < kWidest && partUnder(*snapshot.body, p) == part) all.push_back(p);
    return all;
  }
  PartsAt parts = partsAt(snapshot, level);
  if (parts.legIsClad(part)) return parts.cloth[part];
  all = parts.trunk(parts.cloth);
  const auto& figure = parts.figure;
  if (snapshot.body && !(figure.contains(BodyPoint::Part::LeftArm) && figure.contains(BodyPoint::Part::RightArm)))
    std::erase_if(all, [&](Vec3 p) { return isArm(partUnder(*snapshot.body, p)); });
  return all;
}

// Square to an arm as tailors measure one, and to the part of it that is nearest; level round all else.
Vec3 acrossOf(const GarmentSnapshot& snapshot, BodyPoint::Part part, Vec3 hand) {
  if (!isArm(part)) return {0, 1, 0};
  const bool left = part == BodyPoint::Part::LeftArm;
  const auto& landmarks = snapshot.body->landmarks();
  const auto joint = [&](const char* name) { return landmarks.find(name + std::string(left ? "_left" : "_right")); };
  const auto shoulder = joint("shoulder"), elbow = joint("elbow"), wrist = joint("wrist");
  for (const auto& one : {shoulder, elbow, wrist})
    if (one == landmarks.end()) return {0, 1, 0};
  const bool upper = distance(hand, shoulder->second) < distance(hand, wrist->second);
  return normalized(upper ? shoulder->second - elbow->second : elbow->second - wrist->second);
}

}  // namespace

Tape tapeAt(const GarmentSnapshot& snapshot, const Hit& hit) {
  Tape tape;
  Plane level{hit.point, {0, 1, 0}};
  if (hit.on == Hit::On::Cloth) {
    const auto part = snapshot.body ? partUnder(*snapshot.body, hit.point) : BodyPoint::Part::Torso;
    level.normal = acrossOf(snapshot, part, hit.point);
    tape.line = clothAlong(snapshot, level, part, hit.point);
  } else if (hit.on == Hit::On::Body && snapshot.body) {
    level.normal = acrossOf(snapshot, snapshot.body->describe(hit.skin).part, hit.point);
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
