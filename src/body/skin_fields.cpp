#include "body/skin_fields.h"

#include <algorithm>
#include <cmath>

#include "body/chart.h"

namespace karinui {

namespace {

constexpr double kGroinSlope = 0.66;      // radians: how steeply the line from crotch to hip bone rises
constexpr double kShoulderInside = 0.42;  // of the stretch at the shoulder, on the trunk's side of the armhole
constexpr double kHipAbove = 0.55;        // of that at the hip, above the groin
constexpr double kCrotchWide = 0.018;     // of the height: so far from the middle a leg's skin is wholly its own
constexpr double kAboutArmhole = 0.05, kOffArmhole = 0.085;  // of the height: trunk skin that follows the arm
constexpr int kEvened = 12;                                  // times a field is smoothed along the skin
constexpr double kThickenedOver = 0.03;                      // metres

constexpr double kSoft = 0.2;
// From 0 to 1 over [0, 1]: straight, with rounded ends. Its slope is 1.25 at the most.
double bendRamp(double t) {
  constexpr double kSlope = 1 / (1 - kSoft);
  if (t <= 0) return 0;
  if (t >= 1) return 1;
  if (t < kSoft) return kSlope * t * t / (2 * kSoft);
  if (t > 1 - kSoft) return 1 - kSlope * (1 - t) * (1 - t) / (2 * kSoft);
  return kSlope * (t - kSoft / 2);
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighboursOf(const TriangleMesh& mesh) {
  Neighbours near(mesh.points.size());
  for (const Triangle& f : mesh.faces)
    for (int k = 0; k < 3; ++k) near[f[k]].push_back(f[(k + 1) % 3]);  // each edge from both its faces
  return near;
}

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double toSegment(Vec3 p, Vec3 a, Vec3 b) {
  const double t = std::clamp(dot(p - a, b - a) / squaredLength(b - a), 0.0, 1.0);
  return distance(p, lerp(a, b, t));
}

// Marks the points of the skin that hang together with `first` by points for which `belongs` holds.
template <typename Belongs>
std::vector<std::uint8_t> grownFrom(std::uint32_t first, const Neighbours& near, const Belongs& belongs) {
  std::vector<std::uint8_t> found(near.size(), 0);
  std::vector<std::uint32_t> open{first};
  found[first] = 1;
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    for (const std::uint32_t j : near[i])
      if (!found[j] && belongs(j)) found[j] = 1, open.push_back(j);
  }
  return found;
}

std::uint32_t nearestPoint(const TriangleMesh& mesh, Vec3 place) {
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    if (squaredLength(mesh.points[i] - place) < squaredLength(mesh.points[first] - place)) first = i;
  return first;
}

// Smooths along the skin, where two rules meet.
void smoothAlongSkin(std::vector<float>& field, const Neighbours& near) {
  for (int k = 0; k < kEvened; ++k) {
    const std::vector<float> before = field;
    for (std::uint32_t i = 0; i < field.size(); ++i) {
      if (near[i].empty()) continue;
      double sum = 0;
      for (const std::uint32_t j : near[i]) sum += before[j];
      field[i] = static_cast<float>(0.5 * before[i] + 0.5 * sum / static_cast<double>(near[i].size()));
    }
  }
}

class FieldFinder {
 public:
  FieldFinder(const Body& body, const Bones& bones)
      : body_(body),
        bones_(bones),
        mesh_(body.mesh()),
        near_(neighboursOf(mesh_)),
        chart_(Body::chartFrom(body.chartNumbers())),
        isArm_(mesh_.points.size(), 0) {}

  SkinFields find() {
    const std::size_t n = mesh_.points.size();
    for (std::size_t j = 0; j < kJoints; ++j) found_.through[j].assign(n, 0), found_.twist[j].assign(n, 0);
    found_.apart.assign(n, 0);
    for (const int side : {0, 1}) findArm(side);
    findTrunk();
    for (const int side : {0, 1}) findLeg(side);
    for (const Joint joint : {Joint::LeftShoulder, Joint::RightShoulder, Joint::LeftHip, Joint::RightHip})
      smoothAlongSkin(through(joint), near_);
    return std::move(found_);
  }

 private:
  struct Armhole {
    Vec3 armpit, outward;
    double beyond(Vec3 p) const { return dot(p - armpit, outward); }
  };

  Vec3 place(Joint joint) const { return bones_.place[index(joint)]; }
  Vec3 along(Joint joint) const { return bones_.along[index(joint)]; }
  double over(Joint joint) const { return bones_.over[index(joint)]; }
  std::vector<float>& through(Joint joint) { return found_.through[index(joint)]; }
  std::vector<float>& twist(Joint joint) { return found_.twist[index(joint)]; }
  // How far a point has come through a joint, by its way along the bone.
  double passed(Joint joint, Vec3 p) const { return bendRamp(dot(p - place(joint), along(joint)) / over(joint) + 0.5); }
  double passedUpwards(Joint joint, Vec3 p) const { return bendRamp((p.y - place(joint).y) / over(joint) + 0.5); }

  static BodyPoint::Part armPart(int side) { return side ? BodyPoint::Part::RightArm : BodyPoint::Part::LeftArm; }
  Armhole armholeOf(int side) const;
  std::vector<std::uint8_t> pointsOfArm(int side, const Armhole& armhole) const;
  void findArm(int side);
  void findTrunk();
  void findLeg(int side);

  const Body& body_;
  const Bones& bones_;
  const TriangleMesh& mesh_;
  const Neighbours near_;
  const std::shared_ptr<const Body::Parts::Template> chart_;
  std::vector<std::uint8_t> isArm_;
  SkinFields found_;
};

// Its plane runs through the armpit: half-way between shoulder joint and the first ring of the arm.
FieldFinder::Armhole FieldFinder::armholeOf(int side) const {
  const auto mark = body_.landmarks().find(side ? "armpit_right" : "armpit_left");
  const Vec3 firstRing = chart_->at(armPart(side), 1).from;
  const Vec3 armpit =
      mark != body_.landmarks().end() ? mark->second : lerp(place(sided(Joint::LeftShoulder, side)), firstRing, 0.5);
  return {armpit, chart_->at(armPart(side), 0).normal};
}

std::vector<std::uint8_t> FieldFinder::pointsOfArm(int side, const Armhole& armhole) const {
  // Below the armpit, arm and trunk are told apart by the plane half-way between the arm and straight down.
  const Vec3 half = normalized(along(sided(Joint::LeftShoulder, side)) + Vec3{0, -1, 0});
  const Vec3 sideways{side ? -1.0 : 1.0, 0, 0};
  const Vec3 aside = normalized(sideways - half * dot(sideways, half));
  const std::uint32_t tip = nearestPoint(mesh_, chart_->at(armPart(side), 4).from);
  return grownFrom(tip, near_, [&](std::uint32_t i) {
    const Vec3 p = mesh_.points[i];
    return p.y < armhole.armpit.y ? dot(p - armhole.armpit, aside) > 0 : armhole.beyond(p) > 0;
  });
}

void FieldFinder::findArm(int side) {
  const Joint shoulder = sided(Joint::LeftShoulder, side), elbow = sided(Joint::LeftElbow, side),
              wrist = sided(Joint::LeftWrist, side);
  const Armhole armhole = armholeOf(side);
  const std::vector<std::uint8_t> mine = pointsOfArm(side, armhole);
  const Vec3 top = place(shoulder), upper = along(shoulder), armpit = armhole.armpit;
  const double inside = kShoulderInside * over(shoulder);
  const Vec3 crown = top + Vec3{0, 0.03 * bones_.height, 0};
  const double upperFrom = dot(chart_->at(armPart(side), 1).from - top, upper),
               upperTo = dot(place(elbow) - top, upper);
  const Vec3 fore = normalized(place(wrist) - place(elbow));
  const double foreLength = distance(place(wrist), place(elbow));
  for (std::uint32_t i = 0; i < mesh_.points.size(); ++i) {
    const Vec3 p = mesh_.points[i];
    double u = bendRamp((armhole.beyond(p) + inside) / over(shoulder));
    if (!mine[i]) {
      const double off = toSegment(p, armpit, crown);
      u = std::min(u, bendRamp(inside / over(shoulder))) *
          (1 - smooth((off - kAboutArmhole * bones_.height) / ((kOffArmhole - kAboutArmhole) * bones_.height)));
    } else {  // the armhole's plane is slanted: farther out the arm is cut across
      u = std::max(u, bendRamp((dot(p - armpit, upper) + inside) / over(shoulder)));
    }
    through(shoulder)[i] = static_cast<float>(u);
    if (!mine[i]) continue;
    isArm_[i] = 1;
    twist(shoulder)[i] = static_cast<float>(bendRamp((dot(p - top, upper) - upperFrom) / (upperTo - upperFrom)));
    through(elbow)[i] = static_cast<float>(passed(elbow, p));
    twist(elbow)[i] = static_cast<float>(bendRamp(dot(p - place(elbow), fore) / foreLength));
    through(wrist)[i] = static_cast<float>(passed(wrist, p));
    found_.apart[i] = static_cast<float>(smooth((dot(p - armpit, upper) - 0.03 * bones_.height) / kThickenedOver));
  }
}

void FieldFinder::findTrunk() {
  for (std::uint32_t i = 0; i < mesh_.points.size(); ++i) {
    const Vec3 p = mesh_.points[i];
    through(Joint::Spine)[i] = isArm_[i] ? 1.0f : static_cast<float>(passedUpwards(Joint::Spine, p));
    twist(Joint::Spine)[i] = through(Joint::Spine)[i];
    if (!isArm_[i]) through(Joint::Neck)[i] = twist(Joint::Neck)[i] = static_cast<float>(passedUpwards(Joint::Neck, p));
  }
}

void FieldFinder::findLeg(int side) {
  const Joint hip = sided(Joint::LeftHip, side), knee = sided(Joint::LeftKnee, side),
              ankle = sided(Joint::LeftAnkle, side);
  const double height = bones_.height;
  const Vec3 middle = chart_->at(BodyPoint::Part::Torso, 0).from;
  const double crotch = middle.y;
  for (std::uint32_t i = 0; i < mesh_.points.size(); ++i) {
    if (isArm_[i]) continue;
    const Vec3 p = mesh_.points[i];
    const double wide = kCrotchWide * height * std::max(0.06, 1 - smooth((crotch - p.y) / (0.02 * height)));
    const double out = (p.x - middle.x) * (side ? -1 : 1);
    const double share = smooth((out / wide + 1) / 2);
    if (share <= 0) continue;
    const double d = out * std::sin(kGroinSlope) - (p.y - crotch) * std::cos(kGroinSlope);
    through(hip)[i] = static_cast<float>(share * bendRamp(d / over(hip) + kHipAbove));
    if (p.y > crotch) continue;
    twist(hip)[i] = static_cast<float>(bendRamp((crotch - p.y) / (crotch - place(knee).y)));
    through(knee)[i] = static_cast<float>(passed(knee, p));
    through(ankle)[i] = static_cast<float>(bendRamp((place(ankle).y - p.y) / over(ankle) + 0.5));
    found_.apart[i] = static_cast<float>(0.5 * smooth((crotch - 0.04 * height - p.y) / kThickenedOver));
  }
}

}  // namespace

SkinFields skinFields(const Body& body, const Bones& bones) { return FieldFinder(body, bones).find(); }

}  // namespace karinui
