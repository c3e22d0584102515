#include "karinui/body/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/chart.h"
#include "karinui/base/number.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

namespace {

// Lengths over which the skin bends, at least: shares of the height, and of the way from the bone to the skin on the
// inner side. A fold does not cross itself while the angle in radians times that way is below the length over 1.25
// (bendRamp): the hip's 2 is for a right angle, the elbow's 2.6 for 120 degrees.
constexpr double kShoulderOver = 0.09, kElbowOver = 0.075, kWristOver = 0.04, kHipOver = 0.125, kKneeOver = 0.09,
                 kAnkleOver = 0.042;
constexpr double kShoulderThick = 1.9, kElbowThick = 2.6, kHipThick = 2, kKneeThick = 2.2;
constexpr double kGroinSlope = 0.66;      // radians: how steeply the line from crotch to hip bone rises
constexpr double kShoulderInside = 0.42;  // of the stretch at the shoulder, on the trunk's side of the armhole
constexpr double kHipAbove = 0.55;        // of that at the hip, above the groin
constexpr double kCrotchWide = 0.018;     // of the height: so far from the middle a leg's skin is wholly its own
constexpr double kAboutArmhole = 0.05, kOffArmhole = 0.085;  // of the height: trunk skin that follows the arm
constexpr int kEvened = 12;                                  // times a field is smoothed along the skin
constexpr double kApart = 0.004;  // metres: hands, arms and thighs keep so far from other skin in a named pose
constexpr double kShares[] = {1, 0.97, 0.94, 0.91};  // of the way into a named pose
constexpr double kThickenedOver = 0.03;              // metres

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

bool isRight(Joint joint) { return joint >= Joint::LeftShoulder && static_cast<int>(joint) % 2 == 0; }
Joint sided(Joint left, int side) { return static_cast<Joint>(static_cast<int>(left) + side); }
std::size_t index(Joint joint) { return static_cast<std::size_t>(joint); }

Rigid about(Vec3 place, const Rigid& turn) {
  Rigid out = turn;
  out.carry = place - turn.turned(place);
  return out;
}
Rigid turnBy(Vec3 vector) {
  const double angle = length(vector);
  return angle > 0 ? turnAbout(vector, angle) : Rigid();
}

// A ball joint's swing out of the hanging position.
Rigid swing(JointAngles angles, int side) { return turnBy({-angles.flex, 0, side ? -angles.abduct : angles.abduct}); }

// What the joint does beyond the own pose: a swing across the bone, and a turn about it.
struct Motion {
  Vec3 axis{1, 0, 0};
  double angle = 0, turn = 0;
};

// Divides a turn into a swing that carries `bone`, and a turn about the bone before it.
Motion divided(const Rigid& turn, Vec3 bone) {
  const Vec3 to = turn.turned(bone);
  const Vec3 across = cross(bone, to);
  Motion motion;
  motion.angle = std::atan2(length(across), dot(bone, to));
  if (length(across) > 1e-12) motion.axis = normalized(across);
  const Rigid rest = after(inverseOf(turnAbout(motion.axis, motion.angle)), turn);
  motion.turn = 2 * std::atan2(dot({rest.x, rest.y, rest.z}, bone), rest.w);
  if (motion.turn > std::numbers::pi) motion.turn -= 2 * std::numbers::pi;
  if (motion.turn < -std::numbers::pi) motion.turn += 2 * std::numbers::pi;
  return motion;
}

// What skin does that has come the share `u` through a joint at `place`: the bone, straight over `length`, lies along
// an arc of that length, and carries the cross-sections as they are.
Rigid bent(Vec3 place, Vec3 bone, double length, const Motion& by, double u) {
  if (u <= 0 || by.angle == 0) return {};
  const Vec3 start = place - bone * (length / 2), inwards = cross(by.axis, bone);
  const double angle = u * by.angle, radius = length / by.angle;
  const Vec3 at = start + bone * (radius * std::sin(angle)) + inwards * (radius * (1 - std::cos(angle)));
  Rigid out = turnAbout(by.axis, angle);
  out.carry = at - out.turned(start + bone * (length * u));
  return out;
}

std::vector<std::vector<std::uint32_t>> neighboursOf(const TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> near(mesh.points.size());
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

}  // namespace

Result<std::shared_ptr<const Skeleton>> Skeleton::of(const BodyPtr& own) {
  if (own->chartNumbers().empty())
    return refused(
        say("This body cannot be posed: its trunk and limbs could not be found. Import one that stands with arms held "
            "off."));
  std::shared_ptr<Skeleton> skeleton(new Skeleton());
  skeleton->own_ = own;
  skeleton->findJoints();
  skeleton->findFields();
  return std::shared_ptr<const Skeleton>(std::move(skeleton));
}

void Skeleton::findJoints() {
  const auto chart = Body::chartFrom(own_->chartNumbers());
  using Part = BodyPoint::Part;
  const auto centre = [&](Part part, double along) { return chart->at(part, along).from; };
  height_ = chart->height;
  const auto set = [&](Joint joint, Vec3 place, Vec3 along, double over) {
    place_[index(joint)] = place, along_[index(joint)] = along, over_[index(joint)] = over;
  };
  const Vec3 up{0, 1, 0};
  const Vec3 hip = centre(Part::Torso, 1), highHip = centre(Part::Torso, 2), bust = centre(Part::Torso, 5);
  set(Joint::Pelvis, hip, up, 0);
  const double low = std::lerp(hip.y, highHip.y, 0.7);
  set(Joint::Spine, {hip.x, (low + bust.y) / 2, std::lerp(highHip.z, bust.z, 0.5)}, up, bust.y - low);
  const Vec3 base = centre(Part::Torso, 8), chin = centre(Part::Torso, 10);
  set(Joint::Neck, lerp(base, chin, 0.5) + up * 0.004, up, std::max(0.02 * height_, chin.y - base.y + 0.012 * height_));
  for (const int side : {0, 1}) {
    const Part arm = side ? Part::RightArm : Part::LeftArm, leg = side ? Part::RightLeg : Part::LeftLeg;
    const Vec3 shoulder = centre(arm, 0), elbow = centre(arm, 2), wrist = centre(arm, 3), tip = centre(arm, 4);
    const Vec3 upper = normalized(elbow - shoulder), fore = normalized(wrist - elbow), hand = normalized(tip - wrist);
    const auto over = [&](double least, double thick, Vec3 from, Vec3 towards) {
      const auto skin = own_->bvh().first(from, towards);
      return std::max(least * height_, skin ? thick * std::min(skin->along, 0.12 * height_) : 0);
    };
    const Vec3 ahead{0, 0, 1};
    set(sided(Joint::LeftShoulder, side), shoulder, upper,
        over(kShoulderOver, kShoulderThick, lerp(shoulder, elbow, 0.4), ahead));
    set(sided(Joint::LeftElbow, side), elbow, normalized(upper + fore), over(kElbowOver, kElbowThick, elbow, ahead));
    set(sided(Joint::LeftWrist, side), wrist, normalized(fore + hand), kWristOver * height_);
    const Vec3 hinge = normalized(cross(upper, ahead));
    hinge_[index(sided(Joint::LeftElbow, side))] = hinge;
    hinge_[index(sided(Joint::LeftWrist, side))] = normalized(ahead - fore * dot(ahead, fore)) * (side ? 1.0 : -1.0);
    JointAngles& own = angles_[index(sided(Joint::LeftShoulder, side))];
    const double out = side ? -upper.x : upper.x, flat = std::hypot(out, upper.z);
    const double raised = std::atan2(flat, -upper.y);
    if (flat > 0) own = {raised * upper.z / flat, raised * out / flat, 0};
    angles_[index(sided(Joint::LeftElbow, side))].flex = std::atan2(dot(cross(upper, fore), hinge), dot(upper, fore));

    const Vec3 crotch = centre(leg, 0), knee = centre(leg, 1), ankle = centre(leg, 2);
    const Vec3 shin = normalized(ankle - knee);
    // The hip joint lies above the middle of the thigh, about as high as the widest hip.
    const Vec3 joint{crotch.x, hip.y, std::lerp(crotch.z, hip.z, 0.5)};
    const Vec3 thigh = normalized(knee - joint);
    set(sided(Joint::LeftHip, side), joint, thigh, over(kHipOver, kHipThick, joint, ahead));
    set(sided(Joint::LeftKnee, side), knee, normalized(thigh + shin), over(kKneeOver, kKneeThick, knee, ahead * -1));
    set(sided(Joint::LeftAnkle, side), ankle, up * -1, kAnkleOver * height_);
    const Vec3 across{1, 0, 0};
    hinge_[index(sided(Joint::LeftKnee, side))] = normalized(across - thigh * dot(across, thigh));
    hinge_[index(sided(Joint::LeftAnkle, side))] = across * -1;
  }
}

void Skeleton::findFields() {
  const TriangleMesh& mesh = own_->mesh();
  const std::size_t n = mesh.points.size();
  const auto near = neighboursOf(mesh);
  const auto chart = Body::chartFrom(own_->chartNumbers());
  using Part = BodyPoint::Part;
  for (std::size_t j = 0; j < kJoints; ++j) field_[j].assign(n, 0), twist_[j].assign(n, 0);
  apart_.assign(n, 0);
  std::vector<std::uint8_t> isArm(n, 0);

  for (const int side : {0, 1}) {
    const Part part = side ? Part::RightArm : Part::LeftArm;
    const Joint shoulder = sided(Joint::LeftShoulder, side), elbow = sided(Joint::LeftElbow, side),
                wrist = sided(Joint::LeftWrist, side);
    const Vec3 top = place(shoulder), upper = along_[index(shoulder)];
    const ChartRay cut = chart->at(part, 0), below = chart->at(part, 1);
    const Vec3 outward = cut.normal;
    // The armhole's plane runs through the armpit: half-way between shoulder joint and the first ring of the arm.
    const auto mark = own_->landmarks().find(side ? "armpit_right" : "armpit_left");
    const Vec3 armpit = mark != own_->landmarks().end() ? mark->second : lerp(top, below.from, 0.5);
    const auto beyond = [&](Vec3 p) { return dot(p - armpit, outward); };
    // Below the armpit, arm and trunk are told apart by the plane half-way between the arm and straight down.
    const Vec3 half = normalized(upper + Vec3{0, -1, 0});
    const Vec3 aside = normalized(Vec3{side ? -1.0 : 1.0, 0, 0} - half * dot(Vec3{side ? -1.0 : 1.0, 0, 0}, half));
    const auto onArm = [&](Vec3 p) { return p.y < armpit.y ? dot(p - armpit, aside) > 0 : beyond(p) > 0; };
    const Vec3 tip = chart->at(part, 4).from;
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i < n; ++i)
      if (squaredLength(mesh.points[i] - tip) < squaredLength(mesh.points[first] - tip)) first = i;
    std::vector<std::uint8_t> mine(n, 0);
    std::vector<std::uint32_t> open{first};
    mine[first] = 1;
    while (!open.empty()) {
      const std::uint32_t i = open.back();
      open.pop_back();
      for (const std::uint32_t j : near[i])
        if (!mine[j] && onArm(mesh.points[j])) mine[j] = 1, open.push_back(j);
    }
    const double over = over_[index(shoulder)], inside = kShoulderInside * over;
    const Vec3 crown = top + Vec3{0, 0.03 * height_, 0};
    const double upperFrom = dot(below.from - top, upper), upperTo = dot(place(elbow) - top, upper);
    const Vec3 fore = normalized(place(wrist) - place(elbow));
    const double foreLength = distance(place(wrist), place(elbow));
    const auto through = [&](Joint joint, Vec3 p) {
      return bendRamp(dot(p - place(joint), along_[index(joint)]) / over_[index(joint)] + 0.5);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec3 p = mesh.points[i];
      const double d = beyond(p);
      double u = bendRamp((d + inside) / over);
      if (!mine[i]) {
        const double off = toSegment(p, armpit, crown);
        u = std::min(u, bendRamp(inside / over)) *
            (1 - smooth((off - kAboutArmhole * height_) / ((kOffArmhole - kAboutArmhole) * height_)));
      } else {  // the armhole's plane is slanted: farther out the arm is cut across
        u = std::max(u, bendRamp((dot(p - armpit, upper) + inside) / over));
      }
      field(shoulder)[i] = static_cast<float>(u);
      if (!mine[i]) continue;
      isArm[i] = 1;
      twist_[index(shoulder)][i] =
          static_cast<float>(bendRamp((dot(p - top, upper) - upperFrom) / (upperTo - upperFrom)));
      field(elbow)[i] = static_cast<float>(through(elbow, p));
      twist_[index(elbow)][i] = static_cast<float>(bendRamp(dot(p - place(elbow), fore) / foreLength));
      field(wrist)[i] = static_cast<float>(through(wrist, p));
      apart_[i] = static_cast<float>(smooth((dot(p - armpit, upper) - 0.03 * height_) / kThickenedOver));
    }
  }

  const double crotch = chart->at(Part::Torso, 0).from.y;
  const Vec3 middle = chart->at(Part::Torso, 0).from;
  const Joint spine = Joint::Spine, neck = Joint::Neck;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 p = mesh.points[i];
    const auto through = [&](Joint joint) { return bendRamp((p.y - place(joint).y) / over_[index(joint)] + 0.5); };
    field(spine)[i] = isArm[i] ? 1.0f : static_cast<float>(through(spine));
    twist_[index(spine)][i] = field(spine)[i];
    if (!isArm[i]) field(neck)[i] = twist_[index(neck)][i] = static_cast<float>(through(neck));
    if (isArm[i]) continue;
    const double wide = kCrotchWide * height_ * std::max(0.06, 1 - smooth((crotch - p.y) / (0.02 * height_)));
    for (const int side : {0, 1}) {
      const Joint hip = sided(Joint::LeftHip, side), knee = sided(Joint::LeftKnee, side),
                  ankle = sided(Joint::LeftAnkle, side);
      const double out = (p.x - middle.x) * (side ? -1 : 1);
      const double share = smooth((out / wide + 1) / 2);
      if (share <= 0) continue;
      const double d = out * std::sin(kGroinSlope) - (p.y - crotch) * std::cos(kGroinSlope);
      field(hip)[i] = static_cast<float>(share * bendRamp(d / over_[index(hip)] + kHipAbove));
      if (p.y > crotch) continue;
      twist_[index(hip)][i] = static_cast<float>(bendRamp((crotch - p.y) / (crotch - place(knee).y)));
      field(knee)[i] =
          static_cast<float>(bendRamp(dot(p - place(knee), along_[index(knee)]) / over_[index(knee)] + 0.5));
      field(ankle)[i] = static_cast<float>(bendRamp((place(ankle).y - p.y) / over_[index(ankle)] + 0.5));
      apart_[i] = static_cast<float>(0.5 * smooth((crotch - 0.04 * height_ - p.y) / kThickenedOver));
    }
  }

  // Along the skin, where two rules meet.
  for (const Joint joint : {Joint::LeftShoulder, Joint::RightShoulder, Joint::LeftHip, Joint::RightHip}) {
    std::vector<float>& here = field(joint);
    for (int k = 0; k < kEvened; ++k) {
      const std::vector<float> before = here;
      for (std::uint32_t i = 0; i < n; ++i) {
        if (near[i].empty()) continue;
        double sum = 0;
        for (const std::uint32_t j : near[i]) sum += before[j];
        here[i] = static_cast<float>(0.5 * before[i] + 0.5 * sum / static_cast<double>(near[i].size()));
      }
    }
  }
}

BodyPose Skeleton::whole(const BodyPose& pose) const {
  BodyPose all = pose;
  for (std::size_t j = 0; j < kJoints; ++j) all.try_emplace(static_cast<Joint>(j), angles_[j]);
  return all;
}

BodyPose Skeleton::between(const BodyPose& from, const BodyPose& to, double share) const {
  BodyPose out = whole(share < 1 ? from : to);
  if (share <= 0 || share >= 1) return out;
  const BodyPose there = whole(to);
  for (auto& [joint, angles] : out) {
    const JointAngles& end = there.at(joint);
    angles = {std::lerp(angles.flex, end.flex, share), std::lerp(angles.abduct, end.abduct, share),
              std::lerp(angles.turn, end.turn, share)};
  }
  return out;
}

std::vector<Rigid> Skeleton::placements(const BodyPose& pose) const {
  const std::size_t n = own_->mesh().points.size();
  std::vector<Rigid> out(n);
  std::array<Motion, kJoints> motion;
  bool moves = false;
  for (const auto& [joint, angles] : pose) {
    const std::size_t j = index(joint);
    const JointAngles own = angles_[j];
    if (angles == own) continue;
    moves = true;
    const int side = isRight(joint) ? 1 : 0;
    if (joint == Joint::Pelvis || joint == Joint::Spine || joint == Joint::Neck) {
      const Vec3 across{angles.flex - own.flex, 0, -(angles.abduct - own.abduct)};
      motion[j].angle = length(across);
      if (motion[j].angle > 0) motion[j].axis = normalized(across);
      motion[j].turn = angles.turn - own.turn;
    } else if (joint <= Joint::RightShoulder || joint == Joint::LeftHip || joint == Joint::RightHip) {
      motion[j] = divided(after(swing(angles, side), inverseOf(swing(own, side))), along_[j]);
      motion[j].turn += (side ? -1 : 1) * (angles.turn - own.turn);
    } else if (joint == Joint::LeftWrist || joint == Joint::RightWrist) {
      const Vec3 bone = along_[j], aside = normalized(cross(bone, Vec3{0, 0, 1}));
      const Vec3 across = hinge_[j] * (angles.flex - own.flex) + aside * (angles.abduct - own.abduct);
      motion[j].angle = length(across);
      if (motion[j].angle > 0) motion[j].axis = normalized(across - bone * dot(across, bone));
    } else {
      motion[j].axis = hinge_[j];
      motion[j].angle = angles.flex - own.flex;
      motion[j].turn = (side ? -1 : 1) * (angles.turn - own.turn);
    }
  }
  if (!moves) return out;

  const auto pass = [&](Joint joint, std::size_t i, Rigid& rigid) {
    const std::size_t j = index(joint);
    const Motion& by = motion[j];
    if (by.turn != 0 && twist_[j][i] > 0) {
      const Vec3 bone = joint == Joint::LeftElbow || joint == Joint::RightElbow
                            ? normalized(place(static_cast<Joint>(j + 2)) - place_[j])
                            : along_[j];
      rigid = after(about(place_[j], turnAbout(bone, by.turn * twist_[j][i])), rigid);
    }
    if (by.angle != 0 && field_[j][i] > 0) rigid = after(bent(place_[j], along_[j], over_[j], by, field_[j][i]), rigid);
  };
  const Motion& leaning = motion[index(Joint::Pelvis)];
  const Rigid pelvis =
      about(place(Joint::Pelvis), after(turnAbout(leaning.axis, leaning.angle), turnAbout({0, 1, 0}, leaning.turn)));
  double low = 1e9;
  for (std::size_t i = 0; i < n; ++i) {
    Rigid& rigid = out[i];
    for (const int side : {0, 1})
      for (const Joint joint :
           {Joint::LeftWrist, Joint::LeftElbow, Joint::LeftShoulder, Joint::LeftAnkle, Joint::LeftKnee, Joint::LeftHip})
        pass(sided(joint, side), i, rigid);
    pass(Joint::Neck, i, rigid);
    pass(Joint::Spine, i, rigid);
    rigid = after(pelvis, rigid);
    low = std::min(low, rigid(own_->mesh().points[i]).y);
  }
  double floor = 1e9;
  for (const Vec3& p : own_->mesh().points) floor = std::min(floor, p.y);
  for (Rigid& rigid : out) rigid.carry.y += floor - low;
  return out;
}

std::vector<Vec3> Skeleton::points(const std::vector<Rigid>& placements) const {
  std::vector<Vec3> out = own_->mesh().points;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = placements[i](out[i]);
  return out;
}

std::size_t Skeleton::crossings(const BodyPose& pose, double apart) const {
  TriangleMesh mesh{points(placements(pose)), own_->mesh().faces};
  if (apart > 0) {
    const std::vector<Vec3> normals = pointNormals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) mesh.points[i] += normals[i] * (apart * apart_[i]);
  }
  return selfCrossings(mesh).size();
}

std::size_t Skeleton::usualCrossings(bool apart) const {
  std::call_once(counting_[apart], [&] { usual_[apart] = crossings({}, apart ? kApart : 0); });
  return usual_[apart];
}

void Skeleton::prepare() const { usualCrossings(false), usualCrossings(true); }

Result<BodyPose> Skeleton::named(const NamedPose& named) const {
  if (named.pose.empty()) return named.pose;
  // Where a fold of the skin would still pass through itself, the figure goes nearly so far.
  for (const double share : kShares) {
    BodyPose pose = share < 1 ? between({}, named.pose, share) : named.pose;
    for (int k = 0; k <= named.mostOpened; ++k) {
      if (crossings(pose, kApart) <= usualCrossings(true)) return pose;
      for (const auto& [joint, by] : named.opening) {
        JointAngles& angles = pose[joint];
        angles.flex += by.flex, angles.abduct += by.abduct, angles.turn += by.turn;
      }
    }
  }
  return refused(say("This figure cannot stand in the pose “{0}” without flesh passing into flesh.", named.said));
}

Result<BodyPtr> posed(const Skeleton& skeleton, const BodyPose& pose) {
  if (const Done ok = withinLimits(pose); !ok) return ok.error();
  const BodyPtr& own = skeleton.body();
  if (pose.empty()) return own;
  Body::Parts parts;
  parts.name = own->name();
  parts.mesh = {skeleton.points(skeleton.placements(pose)), own->mesh().faces};
  if (selfCrossings(parts.mesh).size() > skeleton.usualCrossings(false))
    return refused(say("In this pose the figure's skin would pass through itself; bend or turn the joint less."));
  parts.measured = own->measured();
  for (const auto& [name, place] : own->landmarks())
    if (const auto near = own->bvh().nearest(place)) parts.landmarks[name] = at(parts.mesh, near->place);
  parts.own = own;
  parts.pose = pose;
  return Body::make(std::move(parts));
}

}  // namespace karinui
