#include "body/figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/section.h"

namespace karinui {

double radius(const Coefficients& c, Harmonics h, double cosine, double sine) {
  double r = c[0], ck = 1, sk = 0;
  for (int k = 1; k <= h.count; ++k) {
    const double next = ck * cosine - sk * sine;
    sk = sk * cosine + ck * sine;
    ck = next;
    r += c[k] * ck;
    if (!h.symmetric) r += c[h.count + k] * sk;
  }
  return r;
}

double hullGirth(const Coefficients& c, Harmonics h) {
  constexpr int kRays = 96;
  std::vector<Flat> ring(kRays);
  for (int i = 0; i < kRays; ++i) {
    const double t = 2 * std::numbers::pi * i / kRays, cosine = std::cos(t), sine = std::sin(t);
    ring[i] = Flat{cosine, sine} * radius(c, h, cosine, sine);
  }
  const std::vector<Flat> hull = convexHull(ring);
  double girth = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) girth += distance(hull[i], hull[(i + 1) % hull.size()]);
  return girth;
}

namespace {

Section inPlane(Vec3 axisPoint, Vec3 normal, Vec3 reference, const Station& s) {
  Section out;
  out.normal = normalized(normal);
  out.front = normalized(reference - out.normal * dot(reference, out.normal));
  out.side = cross(out.normal, out.front);
  out.centre = axisPoint + out.front * s.forward + out.side * s.sideways;
  out.shape = s.shape;
  return out;
}

}  // namespace

std::vector<Section> torsoSections(const Figure& figure) {
  const Joints& at = figure.at;
  const auto level = [&](const std::string& region, double f) {
    if (region == "pelvis") return std::lerp(at.crotch, at.waist, f);
    if (region == "trunk") return std::lerp(at.waist, at.bust, f);
    if (region == "chest") return std::lerp(at.bust, at.shoulder.y, f);
    if (region == "yoke") return std::lerp(at.shoulder.y, at.neck, f);
    if (region == "neck") return std::lerp(at.neck, at.head, f);
    return std::lerp(at.head, at.crown, f);
  };
  std::vector<Section> out;
  for (std::size_t i = 0; i < figure.torso.station.size(); ++i) {
    const Station& s = figure.torso.station[i];
    const double y = level(figure.torso.region[i], figure.torso.fraction[i]);
    out.push_back({{0, y, s.forward}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, s.shape});
  }
  return out;
}

Armscye armscye(const Joints& at) {
  const Vec3 top{at.shoulder.x * 0.985, at.shoulder.y + 0.05, 0}, bottom{at.armpit.x, at.armpit.y, 0};
  const Vec3 up = normalized(top - bottom);
  return {bottom, {up.y, -up.x, 0}};
}

std::vector<Section> armSections(const Figure& figure) {
  const Joints& at = figure.at;
  const Armscye cut = armscye(at);
  const Vec3 upper = normalized(at.elbow - at.shoulder), fore = normalized(at.wrist - at.elbow),
             hand = normalized(at.tip - at.wrist);
  const double upperLength = distance(at.shoulder, at.elbow);
  std::vector<Section> out;
  double turned = 0;  // where the last turning plane meets the upper arm, as a share of it
  const auto& arm = figure.arm;
  for (std::size_t i = 0; i < arm.station.size(); ++i) {
    const double f = arm.fraction[i];
    Vec3 point, normal;
    if (arm.region[i] == "shoulder") {
      normal = normalized(lerp(cut.outward, upper, f));
      const Vec3 anchor = at.armpit + upper * (0.035 * f * at.crown / 1.7);
      const double along = dot(anchor - at.shoulder, normal) / dot(upper, normal);
      point = at.shoulder + upper * along;
      turned = along / upperLength;
    } else if (arm.region[i] == "upper arm") {
      point = lerp(at.shoulder, at.elbow, turned + (1 - turned) * f);
      normal = f < 0.75 ? upper : upper * 0.75 + fore * 0.25;
    } else if (arm.region[i] == "elbow" || arm.region[i] == "forearm") {
      point = lerp(at.elbow, at.wrist, f);
      normal = f == 0 ? upper + fore : f < 0.2 ? upper * 0.25 + fore * 0.75 : f > 0.8 ? fore * 0.8 + hand * 0.2 : fore;
    } else {
      point = lerp(at.wrist, at.tip, f);
      normal = f == 0 ? fore + hand : f < 0.2 ? fore * 0.2 + hand * 0.8 : hand;
    }
    out.push_back(inPlane(point, normal, {0, 0, 1}, arm.station[i]));
  }
  return out;
}

std::vector<Section> legSections(const Figure& figure) {
  const Joints& at = figure.at;
  std::vector<Section> out;
  for (std::size_t i = 0; i < figure.leg.station.size(); ++i) {
    const double f = figure.leg.fraction[i];
    const bool thigh = figure.leg.region[i] == "thigh";
    const double y = thigh ? std::lerp(at.crotch, at.knee.y, f) : std::lerp(at.knee.y, at.ankle.y, f);
    const Vec3 axis = thigh ? lerp(at.knee, at.hip, (y - at.knee.y) / (at.hip.y - at.knee.y))
                            : lerp(at.ankle, at.knee, (y - at.ankle.y) / (at.knee.y - at.ankle.y));
    const Station& s = figure.leg.station[i];
    const Vec3 side{1, 0, 0}, front{0, 0, 1};
    out.push_back({axis + front * s.forward + side * s.sideways, {0, -1, 0}, side, front, s.shape});
  }
  return out;
}

std::vector<Section> footSections(const Figure& figure) {
  const Joints& at = figure.at;
  const Vec3 along{std::sin(at.toeOut), 0, std::cos(at.toeOut)};
  std::vector<Section> out;
  for (std::size_t i = 0; i < figure.foot.station.size(); ++i) {
    const Vec3 floor = Vec3{at.ankle.x, 0, at.ankle.z} + along * std::lerp(at.heel, at.toe, figure.foot.fraction[i]);
    out.push_back(inPlane(floor, along, {0, 1, 0}, figure.foot.station[i]));
  }
  return out;
}

}  // namespace karinui
