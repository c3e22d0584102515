// A hand as a shop-window mannequin has it: the fingers lie together, so that cloth glides over them and no thread is
// caught, and the thumb stands apart. Proportions are shares of its length from wrist to fingertip.
#include "body/extremity.h"
#include "body/rounded_solids.h"

namespace karinui {

namespace {

struct Finger {
  double across, tip;      // from the middle of the hand towards the thumb; how far its end lies from the wrist
  double knuckle, r0, r1;  // how far its root lies from the wrist; radii at root and end
};
constexpr Finger kFingers[] = {{0.128, 0.925, 0.52, 0.054, 0.041},
                               {0.040, 1.000, 0.54, 0.055, 0.042},
                               {-0.047, 0.945, 0.52, 0.053, 0.041},
                               {-0.126, 0.800, 0.48, 0.047, 0.036}};
constexpr double kTogether = 0.85;  // the fingertips stand this much closer than the knuckles
constexpr double kWristHalf = 0.058;
constexpr double kCut = 0.05;  // behind the wrist

struct ThumbJoint {
  double along, across, palmar, radius;
};
constexpr ThumbJoint kThumb[] = {
    {0.10, 0.105, 0.030, 0.082}, {0.38, 0.235, 0.065, 0.066}, {0.52, 0.315, 0.070, 0.058}, {0.64, 0.355, 0.065, 0.046}};

// The wide way of the hand's section: where its second harmonic is greatest.
Vec3 wideWay(const Section& section, Harmonics harmonics) {
  const double t = 0.5 * std::atan2(section.shape[harmonics.count + 2], section.shape[2]);
  return section.front * std::cos(t) + section.side * std::sin(t);
}

}  // namespace

Extremity handOf(const Figure& figure) {
  const Joints& at = figure.at;
  const double size = distance(at.wrist, at.tip);
  const Vec3 along = normalized(at.tip - at.wrist);
  const auto sections = armSections(figure);
  Vec3 across;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (figure.arm.region[i] == "hand" && figure.arm.fraction[i] < 0.5)
      across = wideWay(sections[i], figure.arm.harmonics);
  across = normalized(across - along * dot(across, along));
  if (dot(across, at.thumb[3] - at.wrist) < 0) across = across * -1.0;
  Vec3 back = cross(along, across);  // of the hand
  if (back.x < 0) back = back * -1.0;

  Extremity hand;
  hand.cut = {at.wrist + along * (kCut * size), along};
  hand.tip = at.tip;
  hand.gap = 0.004, hand.blend = 0.18 * size;
  hand.paired = true;
  // Fingers are long and thin, and so are the cells.
  hand.origin = at.wrist;
  hand.axis = {across, dot(cross(across, back), along) > 0 ? back : back * -1.0, along};
  hand.cell = Vec3{0.0225, 0.025, 0.042} * size;
  hand.low = Vec3{-0.29, -0.17, kCut - 0.10} * size;
  hand.high = Vec3{0.48, 0.17, 1.06} * size;
  hand.solid = [=](Vec3 place) {
    const Vec3 off = place - at.wrist;
    const Vec3 p{dot(off, along) / size, dot(off, across) / size, dot(off, back) / size};
    double palm = 1, fingers = 1;
    for (const Finger& f : kFingers) {
      const Vec3 root{0.16, f.across / 0.135 * kWristHalf, 0}, knuckle{f.knuckle, f.across, 0.012},
          middle{std::lerp(f.knuckle, f.tip, 0.48), f.across * std::lerp(1.0, kTogether, 0.5), 0.016},
          end{f.tip - f.r1, f.across * kTogether, -0.012};
      const double bend = std::lerp(f.r0, f.r1, 0.45);
      palm = smoothUnion(palm, roundedCone(p, root, knuckle, 0.088, 0.064), 0.07);
      const double finger =
          smoothUnion(roundedCone(p, knuckle, middle, f.r0, bend), roundedCone(p, middle, end, bend, f.r1), 0.02);
      fingers = smoothUnion(fingers, finger, 0.022);
    }
    double thumb = 1;
    for (int i = 0; i < 3; ++i) {
      const ThumbJoint &a = kThumb[i], &b = kThumb[i + 1];
      thumb = smoothUnion(
          thumb, roundedCone(p, {a.along, a.across, -a.palmar}, {b.along, b.across, -b.palmar}, a.radius, b.radius),
          0.02);
    }
    return size * smoothUnion(smoothUnion(palm, fingers, 0.03), thumb, 0.12);
  };
  return hand;
}

}  // namespace karinui
