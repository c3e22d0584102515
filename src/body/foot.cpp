// A bare foot with its toes side by side. Proportions are shares of its length from heel to toe.
#include "body/extremity.h"
#include "body/rounded_solids.h"

namespace karinui {

namespace {

struct Bone {
  Vec3 from, to;  // x: outwards, y: up, z: from the heel to the toe
  double r0, r1;
};
constexpr Bone kFoot[] = {{{0.000, 0.20, 0.15}, {0.000, 0.10, 0.13}, 0.105, 0.125},       // heel
                          {{0.000, 0.27, 0.24}, {-0.02, 0.100, 0.62}, 0.125, 0.080},      // instep
                          {{0.030, 0.080, 0.16}, {0.110, 0.058, 0.70}, 0.100, 0.060},     // outer edge
                          {{-0.03, 0.10, 0.18}, {-0.080, 0.075, 0.76}, 0.105, 0.080},     // inner edge
                          {{0.000, 0.16, 0.19}, {0.000, 0.12, 0.38}, 0.115, 0.110},       // under the ankle
                          {{-0.02, 0.10, 0.60}, {0.030, 0.065, 0.76}, 0.080, 0.064},      // ball
                          {{-0.055, 0.055, 0.70}, {-0.050, 0.045, 0.86}, 0.052, 0.040}};  // beside the big toe
constexpr Bone kToes[] = {{{-0.095, 0.070, 0.76}, {-0.080, 0.057, 0.946}, 0.066, 0.055},
                          {{-0.020, 0.060, 0.75}, {-0.006, 0.044, 0.950}, 0.048, 0.038},
                          {{0.045, 0.055, 0.73}, {0.054, 0.042, 0.918}, 0.044, 0.036},
                          {{0.098, 0.050, 0.70}, {0.106, 0.040, 0.872}, 0.042, 0.035},
                          {{0.138, 0.046, 0.66}, {0.150, 0.038, 0.815}, 0.042, 0.034}};
constexpr double kLength = 0.147;  // of the height: a foot

}  // namespace

Extremity footOf(const Figure& figure) {
  const Joints& at = figure.at;
  const double size = kLength * at.crown;
  const Vec3 along{std::sin(at.toeOut), 0, std::cos(at.toeOut)}, out{along.z, 0, -along.x};
  const Vec3 heel = Vec3{at.ankle.x, 0, at.ankle.z} + along * at.heel;

  Extremity foot;
  foot.cut = {{at.ankle.x, at.ankle.y + 0.02 * size, at.ankle.z}, {0, -1, 0}};
  foot.tip = heel + along * (0.5 * size);
  foot.gap = 0.005, foot.blend = 0.12 * size;
  foot.paired = true;
  foot.origin = heel;
  foot.axis = {out, {0, 1, 0}, along};
  foot.cell = Vec3{0.0285, 0.030, 0.044} * size;
  foot.low = Vec3{-0.30, -0.10, -0.12} * size;
  foot.high = Vec3{0.33, foot.cut.through.y / size + 0.10, 1.08} * size;
  // The instep begins where the shin ends in front.
  const Section shin = legSections(figure).back();
  const Vec3 front = shin.centre + along * radius(shin.shape, figure.leg.harmonics, 1, 0);
  const double instep = std::max(kFoot[1].from.z, dot(front - heel, along) / size - 0.115);
  foot.solid = [=](Vec3 place) {
    const Vec3 off = place - heel;
    const Vec3 p{dot(off, out) / size, place.y / size, dot(off, along) / size};
    double whole = 1, toes = 1;
    for (const Bone& b : kFoot) {
      const Vec3 from = &b == &kFoot[1] ? Vec3{b.from.x, b.from.y, instep} : b.from;
      whole = smoothUnion(whole, roundedCone(p, from, b.to, b.r0, b.r1), 0.09);
    }
    for (const Bone& b : kToes) toes = smoothUnion(toes, roundedCone(p, b.from, b.to, b.r0, b.r1), 0.03);
    return size * smoothCommon(smoothUnion(whole, toes, 0.06), -p.y, 0.03);
  };
  return foot;
}

}  // namespace karinui
