#include "session/parts_at.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

using Part = BodyPoint::Part;

// Which limb a line of the figure's section runs round, or the trunk: what most of its places say. A figure that cannot
// be read is all trunk.
Part roundWhat(const Body& body, const SectionLoop& loop) {
  std::map<Part, std::size_t> says;
  const std::size_t stride = std::max<std::size_t>(1, loop.faces.size() / 9);
  for (std::size_t i = 0; i < loop.faces.size(); i += stride)
    ++says[body.describe({loop.faces[i], {1.0 / 3, 1.0 / 3, 1.0 / 3}}).part];
  const auto most =
      std::max_element(says.begin(), says.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == says.end() || most->first == Part::Face ? Part::Torso : most->first;
}

constexpr double kOpenLeg = std::numbers::pi / 4;  // a narrow skirt leaves little more open on the inner side of a leg

}  // namespace

bool allRound(const std::vector<Vec3>& places, const std::vector<Vec3>& figure, double open) {
  Vec3 middle;
  for (const Vec3 p : figure.empty() ? places : figure) middle += p;
  middle *= 1.0 / static_cast<double>(std::max<std::size_t>(1, (figure.empty() ? places : figure).size()));
  std::vector<double> way;
  for (const Vec3 p : places) way.push_back(std::atan2(p.x - middle.x, p.z - middle.z));
  std::sort(way.begin(), way.end());
  double widest = way.empty() ? 7 : way.front() + 2 * std::numbers::pi - way.back();
  for (std::size_t i = 1; i < way.size(); ++i) widest = std::fmax(widest, way[i] - way[i - 1]);
  return widest < open;
}

Part PartsAt::nearest(Vec3 place) const {
  Part best = Part::Torso;
  double least = 1e9;
  for (const auto& [part, line] : figure)
    for (const Vec3 q : line)
      if (const double away = squaredLength(place - q); away < least) least = away, best = part;
  return best;
}

bool PartsAt::legIsClad(Part leg) const {
  const auto round = cloth.find(leg);
  return figure.contains(Part::LeftLeg) && figure.contains(Part::RightLeg) && round != cloth.end() &&
         allRound(round->second, figure.at(leg), kOpenLeg);
}

std::vector<Vec3> PartsAt::trunk(const std::map<Part, std::vector<Vec3>>& of) const {
  std::vector<Vec3> all;
  for (const Part part : {Part::Torso, Part::LeftLeg, Part::RightLeg})
    if (const auto own = of.find(part); own != of.end()) all.insert(all.end(), own->second.begin(), own->second.end());
  return all;
}

PartsAt partsAt(const GarmentSnapshot& snapshot, const Plane& plane) {
  PartsAt parts;
  if (snapshot.body)
    for (const SectionLoop& loop : section(snapshot.body->mesh(), plane)) {
      auto& mine = parts.figure[roundWhat(*snapshot.body, loop)];
      mine.insert(mine.end(), loop.points.begin(), loop.points.end());
    }
  for (const SceneCloth& piece : snapshot.frame.cloths)
    for (const SectionLoop& loop : section(piece.mesh, plane))
      for (const Vec3 p : loop.points) parts.cloth[parts.nearest(p)].push_back(p);
  return parts;
}

}  // namespace karinui
