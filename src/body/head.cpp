// A faceless head: skull, brow, cheek bones, the ridge of the nose, jaw and chin; no ears.
// Proportions are shares of its height from chin to crown; its breadth and depth are those of the drawn sections.
#include "body/extremity.h"
#include "body/rounded_solids.h"

namespace karinui {

namespace {

constexpr double kSection = 0.4;  // of the way from head joint to crown: where breadth and depth are taken
// The skin is cut above the tape around the neck, in its direction (anthropometry/shoulders.cpp): it measures the same.
constexpr Vec3 kNeckNormal{0, 0.935, 0.355};
constexpr double kTapeBehindShoulder = 0.012;  // of the height: the middle of that tape, behind the shoulder joint
constexpr double kAboveTape = 0.006;           // metres, across it
constexpr double kCell = 0.047;                // of the head

}  // namespace

Extremity headOf(const Figure& figure, double neckHeight) {
  const Joints& at = figure.at;
  const double size = (1 - figure.chin) * at.crown, chin = figure.chin * at.crown;
  std::size_t widest = 0;
  for (std::size_t i = 0; i < figure.torso.station.size(); ++i)
    if (figure.torso.region[i] == "head" && figure.torso.fraction[i] <= kSection) widest = i;
  const Station& skull = figure.torso.station[widest];
  const Harmonics harmonics = figure.torso.harmonics;
  const double half = radius(skull.shape, harmonics, 0, 1) / size, front = radius(skull.shape, harmonics, 1, 0) / size,
               back = radius(skull.shape, harmonics, -1, 0) / size;
  const double depth = (front + back) / 2, middle = skull.forward + (front - back) / 2 * size;

  // The neck where it is cut.
  const auto sections = torsoSections(figure);
  const Vec3 normal = normalized(kNeckNormal);
  const Vec3 tape = Vec3{0, neckHeight, at.shoulder.z - kTapeBehindShoulder * at.crown} + normal * kAboveTape;
  const double level = tape.y;
  std::size_t above = 1;
  while (above + 1 < sections.size() && sections[above].centre.y < level) ++above;
  const Section &a = sections[above - 1], &b = sections[above];
  const double share = std::clamp((level - a.centre.y) / (b.centre.y - a.centre.y), 0.0, 1.0);
  const double nape = std::lerp(radius(a.shape, harmonics, -1, 0), radius(b.shape, harmonics, -1, 0), share),
               side = std::lerp(radius(a.shape, harmonics, 0, 1), radius(b.shape, harmonics, 0, 1), share);
  const double centre = std::lerp(a.centre.z, b.centre.z, share) - nape + side;

  Extremity head;
  head.cut = {tape, normal};
  head.tip = {0, at.crown, middle};
  head.gap = 0.006, head.blend = 0.2 * size;
  head.cell = Vec3{kCell, kCell, kCell} * size;
  head.low = {0, chin - 0.05, middle - 1.3 * depth * size};
  head.high = {1.3 * half * size, at.crown + 0.02, middle + 1.4 * depth * size};
  head.solid = [=](Vec3 place) {
    // x: outwards, 1 at the widest of the skull; y: 0 chin, 1 crown; z: 1 the foremost of the section
    const Vec3 p{std::abs(place.x) / size, (place.y - chin) / size, (place.z - middle) / size};
    const double w = half, d = depth;
    const Vec3 neck{0, (level - chin) / size + 0.05, (centre - middle) / size};
    double solid = ellipsoid(p, {0, 0.63, -0.10 * d}, {w, 0.37, 0.90 * d});                                     // skull
    solid = smoothUnion(solid, roundedCone(p, {0, 0.52, -0.28 * d}, neck, 0.78 * w, 0.9 * side / size), 0.16);  // nape
    solid =
        smoothUnion(solid, roundedCone(p, {0, 0.57, 0.29 * d}, {0, 0.25, 0.40 * d}, 0.74 * w, 0.52 * w), 0.16);  // face
    solid = smoothUnion(solid, roundedCone(p, {0.43 * w, 0.28, 0.10 * d}, {0.10 * w, 0.095, 0.68 * d}, 0.10, 0.08),
                        0.14);                                                                   // jaw
    solid = smoothCommon(solid, -ellipsoid(p, {0, 0.50, 1.30 * d}, {0.40, 0.10, 0.155}), 0.12);  // brow and eyes
    return size *
           smoothUnion(solid, roundedCone(p, {0, 0.62, 0.74 * d}, {0, 0.385, 0.925 * d}, 0.02, 0.034), 0.12);  // nose
  };
  return head;
}

}  // namespace karinui
