// A faceless head: skull, brow, cheek bones, the ridge of the nose, jaw and chin; no ears.
// Proportions are shares of its height from chin to crown; its breadth and depth are those of the drawn sections.
#include "body/extremity.h"
#include "body/rounded_solids.h"

namespace karinui {

namespace {

constexpr double kChin = 0.874;   // of the height
constexpr double kLean = 0.35;    // radians by which the neck leans forward
constexpr double kSection = 0.4;  // of the way from head joint to crown: where breadth and depth are taken

}  // namespace

Extremity headOf(const Figure& figure) {
  const Joints& at = figure.at;
  const double size = (1 - kChin) * at.crown, chin = kChin * at.crown;
  std::size_t widest = 0;
  for (std::size_t i = 0; i < figure.torso.station.size(); ++i)
    if (figure.torso.region[i] == "head" && figure.torso.fraction[i] <= kSection) widest = i;
  const Station& skull = figure.torso.station[widest];
  const Harmonics harmonics = figure.torso.harmonics;
  const double half = radius(skull.shape, harmonics, 0, 1) / size, front = radius(skull.shape, harmonics, 1, 0) / size,
               back = radius(skull.shape, harmonics, -1, 0) / size;
  const double depth = (front + back) / 2, middle = skull.forward + (front - back) / 2 * size;

  // The neck where it is cut: its highest section that is no head yet.
  const auto sections = torsoSections(figure);
  const double level = chin - 0.004 * at.crown;
  std::size_t above = 1;
  while (above + 1 < sections.size() && sections[above].centre.y < level) ++above;
  const Section &a = sections[above - 1], &b = sections[above];
  const double share = std::clamp((level - a.centre.y) / (b.centre.y - a.centre.y), 0.0, 1.0);
  const double nape = std::lerp(radius(a.shape, harmonics, -1, 0), radius(b.shape, harmonics, -1, 0), share),
               side = std::lerp(radius(a.shape, harmonics, 0, 1), radius(b.shape, harmonics, 0, 1), share);
  const double z = std::lerp(a.centre.z, b.centre.z, share) - nape + side;

  Extremity head;
  head.cut = {{0, level, z}, {0, std::cos(kLean), std::sin(kLean)}};
  head.gap = 0.006, head.cell = 0.0065, head.blend = 0.20 * size, head.taper = 1.1 * size;
  head.paired = false;
  head.low = {0, level - 0.05, middle - 1.3 * depth * size};
  head.high = {1.3 * half * size, at.crown + 0.02, middle + 1.4 * depth * size};
  head.solid = [=](Vec3 place) {
    // x: outwards, 1 at the widest of the skull; y: 0 chin, 1 crown; z: 1 the foremost of the section
    const Vec3 p{std::abs(place.x) / size, (place.y - chin) / size, (place.z - middle) / size};
    const double w = half, d = depth;
    const Vec3 neck{0, (level - chin) / size + 0.05, (z - middle) / size};
    double solid = ellipsoid(p, {0, 0.63, -0.10 * d}, {w, 0.37, 0.90 * d});                                     // skull
    solid = smoothUnion(solid, roundedCone(p, {0, 0.52, -0.28 * d}, neck, 0.78 * w, 0.9 * side / size), 0.16);  // nape
    solid =
        smoothUnion(solid, roundedCone(p, {0, 0.57, 0.29 * d}, {0, 0.21, 0.45 * d}, 0.74 * w, 0.45 * w), 0.16);  // face
    solid = smoothUnion(solid, roundedCone(p, {0.46 * w, 0.28, 0.10 * d}, {0.10 * w, 0.085, 0.70 * d}, 0.095, 0.07),
                        0.12);                                                                    // jaw
    solid = smoothCommon(solid, -ellipsoid(p, {0, 0.495, 1.27 * d}, {0.36, 0.10, 0.155}), 0.09);  // brow and eyes
    return size *
           smoothUnion(solid, roundedCone(p, {0, 0.62, 0.74 * d}, {0, 0.375, 0.925 * d}, 0.02, 0.038), 0.08);  // nose
  };
  return head;
}

}  // namespace karinui
