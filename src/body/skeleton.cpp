#include "karinui/body/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/chart.h"
#include "body/joints.h"
#include "body/skin_fields.h"
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
constexpr double kApart = 0.004;  // metres: hands, arms and thighs keep so far from other skin in a named pose
constexpr double kShares[] = {1, 0.97, 0.94, 0.91};  // of the way into a named pose

bool isRight(Joint joint) { return joint >= Joint::LeftShoulder && static_cast<int>(joint) % 2 == 0; }

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

}  // namespace

Result<std::shared_ptr<const Skeleton>> Skeleton::of(const BodyPtr& own) {
  if (own->chartNumbers().empty())
    return refused(
        say("This body cannot be posed: its trunk and limbs could not be found. Import one that stands with arms held "
            "off."));
  std::shared_ptr<Skeleton> skeleton(new Skeleton());
  skeleton->own_ = own;
  skeleton->findJoints();
  SkinFields fields = skinFields(*own, {skeleton->height_, skeleton->place_, skeleton->along_, skeleton->over_});
  skeleton->field_ = std::move(fields.through);
  skeleton->twist_ = std::move(fields.twist);
  skeleton->apart_ = std::move(fields.apart);
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
