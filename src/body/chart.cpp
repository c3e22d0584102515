#include "body/chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr std::array<std::string_view, 12> kTorso{"crotch", "hip",      "high_hip",  "waist", "under_bust", "bust",
                                                  "armpit", "shoulder", "neck_base", "neck",  "chin",       "crown"};
constexpr std::array<std::string_view, 5> kArm{"shoulder", "armpit", "elbow", "wrist", "fingertip"};
constexpr std::array<std::string_view, 4> kLeg{"crotch", "knee", "ankle", "sole"};

using Template = Body::Parts::Template;
using Part = BodyPoint::Part;

struct Marks {  // what a chart is made from
  double height = 0, crotch = 0, waist = 0, underBust = 0, bust = 0, armpit = 0, shoulder = 0, neckBase = 0, neck = 0,
         chin = 0, crown = 0;
  double hipZ = 0, waistZ = 0, bustZ = 0, shoulderZ = 0, neckZ = 0, headZ = 0;
  double middle = 0;
  std::array<LimbAxis, 2> arm, leg;
  std::array<Vec3, 2> armpitPlace;
};

std::vector<Level> armLevels(const LimbAxis& arm, Vec3 armpit, double side, double height) {
  const Vec3 upper = normalized(arm.middle - arm.top), fore = normalized(arm.end - arm.middle),
             hand = normalized(arm.tip - arm.end);
  const Vec3 rise = normalized(Vec3{arm.top.x * 0.985, arm.top.y + 0.05, 0} - Vec3{armpit.x, armpit.y, 0});
  const Vec3 outward = Vec3{rise.y, -rise.x, 0} * side;
  const Vec3 below = Vec3{armpit.x, armpit.y, arm.top.z} + upper * (0.021 * height);
  const Vec3 first = arm.top + upper * dot(below - arm.top, upper);
  return {{arm.top, outward},
          {first, upper},
          {arm.middle, normalized(upper + fore)},
          {arm.end, normalized(fore + hand)},
          {arm.tip - hand * 0.003, hand}};
}

std::shared_ptr<const Template> chartOf(const Marks& m) {
  auto chart = std::make_shared<Template>();
  chart->height = m.height;
  const Vec3 up{0, 1, 0};
  // The hip is taken at a fixed share of the pelvis: where the tape reads most may jump between seat and thighs.
  std::vector<std::pair<double, double>> torso{{m.crotch + 0.004, m.hipZ},
                                               {std::lerp(m.crotch, m.waist, 0.27), m.hipZ},
                                               {std::lerp(m.crotch, m.waist, 0.60), std::lerp(m.hipZ, m.waistZ, 0.6)},
                                               {m.waist, m.waistZ},
                                               {m.underBust, std::lerp(m.waistZ, m.bustZ, 0.7)},
                                               {m.bust, m.bustZ},
                                               {m.armpit, std::lerp(m.bustZ, m.shoulderZ, 0.5)},
                                               {m.shoulder, m.shoulderZ},
                                               {m.neckBase, m.neckZ},
                                               {m.neck, m.neckZ},
                                               {m.chin, m.headZ},
                                               {m.crown - 0.001 * m.height, m.headZ}};
  for (std::size_t i = 0; i < torso.size(); ++i) {
    if (i > 0) torso[i].first = std::max(torso[i].first, torso[i - 1].first + 0.004 * m.height);
    chart->level[0].push_back({{m.middle, torso[i].first, torso[i].second}, up});
  }
  for (const int side : {0, 1}) {
    chart->level[1 + side] = armLevels(m.arm[side], m.armpitPlace[side], side ? -1 : 1, m.height);
    const LimbAxis& leg = m.leg[side];
    const auto axis = [&](double y) {
      return y >= leg.middle.y ? lerp(leg.middle, leg.top, (y - leg.middle.y) / (leg.top.y - leg.middle.y))
                               : lerp(leg.end, leg.middle, (y - leg.end.y) / (leg.middle.y - leg.end.y));
    };
    const Vec3 down{0, -1, 0};
    const double sole = m.crown - m.height + 0.002 * m.height;
    chart->level[3 + side] = {
        {axis(m.crotch - 0.004), down}, {leg.middle, down}, {leg.end, down}, {{leg.end.x, sole, leg.end.z}, down}};
  }
  return chart;
}

LimbAxis mirrored(LimbAxis line) {
  for (Vec3* p : {&line.top, &line.middle, &line.end, &line.tip}) p->x = -p->x;
  return line;
}

}  // namespace

std::span<const std::string_view> chartLevels(Part part) {
  switch (part) {
    case Part::Torso:
      return kTorso;
    case Part::LeftArm:
    case Part::RightArm:
      return kArm;
    case Part::LeftLeg:
    case Part::RightLeg:
      return kLeg;
    default:
      return {};
  }
}

Vec3 ChartRay::towards(double around) const {
  const double t = 2 * std::numbers::pi * around;
  return front * std::cos(t) + side * std::sin(t);
}

double Template::reach(Part part) const {
  return height * (part == Part::Torso ? 0.20 : part == Part::LeftArm || part == Part::RightArm ? 0.075 : 0.17);
}

ChartRay Template::at(Part part, double along) const {
  const auto& levels = level[static_cast<std::size_t>(part)];
  const double top = static_cast<double>(levels.size() - 1);
  along = std::clamp(along, 0.0, top);
  const auto i = std::min(static_cast<std::size_t>(along), levels.size() - 2);
  const double t = along - static_cast<double>(i);
  ChartRay ray;
  ray.from = lerp(levels[i].centre, levels[i + 1].centre, t);
  ray.normal = normalized(lerp(levels[i].normal, levels[i + 1].normal, t));
  const Vec3 z{0, 0, 1};
  ray.front = normalized(z - ray.normal * dot(z, ray.normal));
  ray.side = part == Part::Torso ? cross(ray.normal, ray.front) : cross(ray.front, ray.normal);
  return ray;
}

std::vector<double> Template::alongOf(Part part, Vec3 place) const {
  const auto beyond = [&](double s) {
    const ChartRay ray = at(part, s);
    return dot(place - ray.from, ray.normal);
  };
  std::vector<double> found;
  const std::size_t n = level[static_cast<std::size_t>(part)].size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    double low = static_cast<double>(i), high = low + 1;
    if (!(beyond(low) >= 0 && beyond(high) <= 0)) continue;
    for (int step = 0; step < 60; ++step) {
      const double s = (low + high) / 2;
      (beyond(s) >= 0 ? low : high) = s;
    }
    found.push_back((low + high) / 2);
  }
  return found;
}

std::vector<double> numbersOf(const Template& chart) {
  std::vector<double> numbers{chart.height};
  for (const auto& levels : chart.level)
    for (const Level& level : levels)
      for (const Vec3& v : {level.centre, level.normal}) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

std::shared_ptr<const Template> templateFrom(std::span<const double> numbers) {
  auto chart = std::make_shared<Template>();
  std::size_t levels = 0;
  for (std::size_t part = 0; part < chart->level.size(); ++part) {
    chart->level[part].resize(chartLevels(static_cast<Part>(part)).size());
    levels += chart->level[part].size();
  }
  if (numbers.size() != 1 + 6 * levels) return nullptr;
  for (const double number : numbers)
    if (!std::isfinite(number)) return nullptr;
  std::size_t next = 0;
  const auto point = [&] {
    const double x = numbers[next], y = numbers[next + 1], z = numbers[next + 2];
    next += 3;
    return Vec3{x, y, z};
  };
  chart->height = numbers[next++];
  for (auto& part : chart->level)
    for (Level& level : part) level.centre = point(), level.normal = point();
  return chart;
}

std::shared_ptr<const Template> chartOf(const Figure& figure, const Anthropometry& measured) {
  const Joints& at = figure.at;
  const auto torso = torsoSections(figure);
  const auto depth = [&](double y) {
    for (std::size_t i = 1; i < torso.size(); ++i)
      if (torso[i].centre.y >= y)
        return lerp(torso[i - 1].centre, torso[i].centre,
                    (y - torso[i - 1].centre.y) / (torso[i].centre.y - torso[i - 1].centre.y))
            .z;
    return torso.back().centre.z;
  };
  Marks m;
  m.height = m.crown = at.crown;
  // The levels are those the tape finds on the finished mesh; where it found none, those of the drawing.
  const auto level = [&](const char* key, double drawn) {
    const auto it = measured.value.find(key);
    return it == measured.value.end() ? drawn : it->second;
  };
  m.crotch = level("crotch_height", at.crotch), m.waist = level("waist_height", at.waist);
  m.bust = level("bust_height", at.bust);
  m.armpit = std::max(level("armpit_height", at.armpit.y), m.bust + 0.01 * at.crown);
  m.underBust = std::max(level("under_bust_height", m.bust - 0.075), std::lerp(m.waist, m.bust, 0.3));
  m.shoulder = at.shoulder.y, m.chin = at.head;
  m.neckBase = (level("neck_front_height", at.neck) + level("neck_back_height", at.neck)) / 2;
  m.neck = std::lerp(m.neckBase, m.chin, 0.35);
  m.hipZ = depth(std::lerp(m.crotch, m.waist, 0.27)), m.waistZ = depth(m.waist), m.bustZ = depth(m.bust);
  m.shoulderZ = depth(m.shoulder), m.neckZ = depth(m.neck), m.headZ = depth(std::lerp(at.head, at.crown, 0.5));
  m.arm[0] = {at.shoulder, at.elbow, at.wrist, at.tip};
  // The middle of the leg runs through its sections, not through the hip joint.
  const auto leg = legSections(figure);
  m.leg[0].top = leg.front().centre;
  const auto onLeg = [&](double y) {
    std::size_t i = 1;
    while (i + 1 < leg.size() && leg[i].centre.y > y) ++i;
    const Vec3 a = leg[i - 1].centre, b = leg[i].centre;
    return lerp(a, b, (a.y - y) / (a.y - b.y));
  };
  m.leg[0].middle = onLeg(level("knee_height", at.knee.y));
  m.leg[0].end = onLeg(level("ankle_height", at.ankle.y));
  m.leg[0].tip = {at.ankle.x, 0, at.ankle.z};
  m.armpitPlace = {at.armpit, Vec3{-at.armpit.x, at.armpit.y, at.armpit.z}};
  m.arm[1] = mirrored(m.arm[0]), m.leg[1] = mirrored(m.leg[0]);
  return chartOf(m);
}

std::shared_ptr<const Template> chartOf(const Anthropometry& measured) {
  const auto value = [&](const char* key) {
    const auto it = measured.value.find(key);
    return it == measured.value.end() ? -1.0 : it->second;
  };
  const auto& l = measured.landmark;
  for (const char* key : {"height", "crotch_height", "waist_height", "bust_height", "armpit_height"})
    if (value(key) <= 0) return nullptr;
  for (const int side : {0, 1})
    if (!measured.arm[side] || !measured.leg[side]) return nullptr;
  for (const char* key : {"waist_front", "waist_back", "hip_front", "hip_back", "armpit_left", "armpit_right",
                          "neck_front", "neck_back", "under_bust_front", "under_bust_back"})
    if (!l.contains(key)) return nullptr;
  const auto middleOf = [&](const char* front, const char* back) { return (l.at(front).z + l.at(back).z) / 2; };
  Marks m;
  m.height = value("height");
  const double floor = l.at("waist_front").y - value("waist_height");
  m.crown = floor + m.height;
  m.crotch = floor + value("crotch_height"), m.waist = floor + value("waist_height");
  m.armpit = floor + value("armpit_height");
  m.bust = std::min(floor + value("bust_height"), m.armpit - 0.012 * m.height);
  m.underBust = std::max(m.bust - 0.045 * m.height, std::lerp(m.waist, m.bust, 0.3));
  m.shoulder = (measured.arm[0]->top.y + measured.arm[1]->top.y) / 2;
  m.neckBase = (l.at("neck_front").y + l.at("neck_back").y) / 2;
  m.neck = m.neckBase + 0.022 * m.height, m.chin = m.neckBase + 0.063 * m.height;
  m.middle = l.at("waist_front").x;
  m.hipZ = middleOf("hip_front", "hip_back"), m.waistZ = middleOf("waist_front", "waist_back");
  m.bustZ = middleOf("under_bust_front", "under_bust_back");
  m.shoulderZ = m.bustZ;
  m.neckZ = m.headZ = middleOf("neck_front", "neck_back");
  for (const int side : {0, 1}) {
    m.arm[side] = *measured.arm[side];
    m.leg[side] = *measured.leg[side];
    m.armpitPlace[side] = l.at(side ? "armpit_right" : "armpit_left");
  }
  return chartOf(m);
}

}  // namespace karinui
