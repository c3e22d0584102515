// A faceless head: skull, brow, cheeks, the ridge of the nose, a hint of the mouth, jaw and chin; no ears.
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
constexpr double kChin = 0.74;                 // of the depth: how far in front the chin is
constexpr double kClear = 0.19;                // of the head: a chin farther from the cut is not met by the drawn one,
constexpr double kLower = 0.10;                // a nearer one, as a man's, reaches down over it by what is missing
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
  const double clear = dot(Vec3{0, chin, middle + kChin * depth * size} - tape, normal);
  const double low = chin - std::clamp(kClear * size - clear, 0.0, kLower * size);
  head.solid = [=, crown = at.crown](Vec3 place) {
    // x: outwards, 1 at the widest of the skull; y: 0 chin, 1 crown; z: 1 the foremost of the section
    const Vec3 p{std::abs(place.x) / size, (place.y - low) / (crown - low), (place.z - middle) / size};
    const double w = half, d = depth;
    const Vec3 neck{0, (level - low) / size + 0.05, (centre - middle) / size};
    double solid = ellipsoid(p, {0, 0.63, -0.10 * d}, {w, 0.37, 0.90 * d});                                     // skull
    solid = smoothUnion(solid, roundedCone(p, {0, 0.52, -0.28 * d}, neck, 0.78 * w, 0.9 * side / size), 0.16);  // nape
    solid =
        smoothUnion(solid, roundedCone(p, {0, 0.55, 0.22 * d}, {0, 0.195, 0.45 * d}, 0.74 * w, 0.14), 0.16);  // face
    solid = smoothUnion(solid, roundedCone(p, {0.44 * w, 0.31, 0.04 * d}, {0.06 * w, 0.095, 0.55 * d}, 0.085, 0.08),
                        0.12);                                                                      // jaw and chin
    solid = smoothUnion(solid, ellipsoid(p, {0, 0.255, 0.56 * d}, {0.28 * w, 0.085, 0.12}), 0.10);  // mouth
    solid = smoothCommon(solid, -ellipsoid(p, {0, 0.49, 1.36 * d}, {0.40, 0.09, 0.155}), 0.10);     // brow and eyes
    return size *
           smoothUnion(solid, roundedCone(p, {0, 0.60, 0.76 * d}, {0, 0.375, 0.895 * d}, 0.02, 0.034), 0.13);  // nose
  };
  return head;
}

}  // namespace karinui
