#include "karinui/touch/servo_step.h"

#include <algorithm>

namespace karinui {

namespace {

constexpr double kLongest = 2 * kServoTick;  // what a tick that came late may change at most is that of so long a tick
constexpr double kWeightRise = 5;            // N/s: a piece is taken up and laid down softly
constexpr double kOnset = 0.03;              // seconds a controller vibrates when it comes to touch

bool finite(double value) { return std::isfinite(value); }
Vec3 shortened(Vec3 v, double most) {
  const double l = length(v);
  return l > most ? v * (most / l) : v;
}

}  // namespace

ServoStep::ServoStep(const DeviceRecord& record, const ServoSettings& settings) : record_(record), settings_(settings) {
  setGain(settings.gain);
}

void ServoStep::setGain(double gain) { settings_.gain = finite(gain) ? std::clamp(gain, 0.0, 1.0) : 0; }
void ServoStep::setLimit(double newtons) { settings_.limit = finite(newtons) ? std::max(0.0, newtons) : 0; }
double ServoStep::limit() const { return std::min(settings_.limit, settings_.nominalShare * record_.force); }

bool ServoStep::mayAdopt(double now) const { return !before_ || now - adopted_ >= settings_.blendSeconds; }

const TouchScene* ServoStep::adopt(const TouchScene* scene, double now) {
  const TouchScene* done = before_;
  before_ = scene_;
  scene_ = scene;
  evaluatorBefore_.takeProxy(evaluator_);
  adopted_ = now;
  return done;
}

ServoFault ServoStep::faultOf(const HandSample& hand, double now, double since) const {
  if (off_) return ServoFault::Off;
  const Rigid& tip = hand.tip;
  if (!karinui::finite(tip.carry) || !karinui::finite(hand.velocity) || !finite(tip.w + tip.x + tip.y + tip.z) ||
      !finite(now))
    return ServoFault::NotFinite;
  if (!hand.ready) return ServoFault::NotReady;
  if (!focus_) return ServoFault::NoFocus;
  if (hand.buttons & settings_.clutchButtons) return ServoFault::Clutch;
  if (begun_) {
    const double way = distance(tip.carry, place_) / record_.scale;
    if (way > settings_.farthestJump) return ServoFault::Jump;
    if (way > settings_.fastest * std::max(since, kServoTick) * 1.5) return ServoFault::Speed;
    if (since > settings_.latest) return ServoFault::Late;
  }
  if (length(hand.velocity) > settings_.fastest * record_.scale) return ServoFault::Speed;
  if (!scene_ || !(now - scene_->published <= settings_.stalest)) return ServoFault::Stale;
  return ServoFault::None;
}

void ServoStep::fail(ServoFault fault, double now, bool atOnce) {
  if (state_ == ServoState::Ramping || state_ == ServoState::Armed) {
    state_ = ServoState::Fading;
    fading_ = force_;
    fadeFrom_ = now;
  }
  fault_ = fault;
  calm_ = 0;
  if (!atOnce) return;
  force_ = fading_ = {};
  state_ = fault == ServoFault::Off ? ServoState::Off : ServoState::Waiting;
}

Vec3 ServoStep::slewed(Vec3 wanted, double since, double way, double stiffness, bool& limited) const {
  const Vec3 change = wanted - force_;
  const double rate = dot(change, force_) < 0 ? settings_.falling : settings_.rising;
  const double most = rate * std::min(since, kLongest) + stiffness * way;
  limited = limited || length(change) > most;
  return force_ + shortened(change, most);
}

double ServoStep::click(const TouchScene& scene, double now) {
  if (clicksKnown_ && static_cast<std::int32_t>(scene.clicks - clicks_) > 0) clicked_ = now;
  clicks_ = scene.clicks;
  clicksKnown_ = true;
  return settings_.laws.click && clicked_ >= 0 ? clickForce(now - clicked_) : 0;
}

// What the scenes ask for, blended from one to the next.
TouchForces ServoStep::felt(const HandSample& hand, double now) {
  const Vec3 at = hand.tip.carry;
  TouchForces forces = evaluator_.evaluate(*scene_, record_, settings_.laws, at, hand.velocity);
  if (!before_ || !(now - adopted_ < settings_.blendSeconds)) return forces;
  const TouchForces old = evaluatorBefore_.evaluate(*before_, record_, settings_.laws, at, hand.velocity);
  const double share = std::clamp((now - adopted_) / settings_.blendSeconds, 0.0, 1.0);
  forces.contact = lerp(old.contact, forces.contact, share);
  forces.pull = lerp(old.pull, forces.pull, share);
  forces.cut = lerp(old.cut, forces.cut, share);
  forces.weight = lerp(old.weight, forces.weight, share);
  forces.stored = old.stored + (forces.stored - old.stored) * share;
  forces.touching = forces.touching || old.touching;
  return forces;
}

// From waiting to armed; the share of the force that may leave.
double ServoStep::arm(bool calm, double now) {
  if (state_ == ServoState::Fading && now - fadeFrom_ >= settings_.fadeSeconds) state_ = ServoState::Waiting;
  if (state_ == ServoState::Waiting) {
    calm_ = calm ? calm_ + 1 : 0;
    if (calm_ >= settings_.armTicks) {
      state_ = ServoState::Ramping;
      fault_ = ServoFault::None;
      rampFrom_ = now;
      energy_ = 0;
    }
  }
  if (state_ != ServoState::Ramping) return state_ == ServoState::Armed ? 1.0 : 0.0;
  const double share = std::clamp((now - rampFrom_) / settings_.rampSeconds, 0.0, 1.0);
  if (share >= 1) state_ = ServoState::Armed;
  return share;
}

// The force that leaves while it is ramping or armed: the weight, and all else as the passivity observer and controller
// let it.
void ServoStep::drive(const TouchForces& forces, double pulse, double share, Vec3 moved, double since,
                      ServoTick& told) {
  const double force = settings_.gain * share;
  const Vec3 heavy = shortened(forces.weight * force, settings_.weightShare * record_.force);
  weight_ += shortened(heavy - weight_, kWeightRise * std::min(since, kLongest));
  Vec3 coupled = (forces.coupled() + clickWay(forces) * pulse) * force;
  energy_ = std::min(energy_, force * forces.stored + settings_.energySlack);
  const double way = length(moved);
  if (settings_.passivity && energy_ < 0 && way > 0 && since > 0) {
    const Vec3 heading = moved * (1 / way);
    const double speed = way / since;
    told.damping = std::min(record_.damping, -energy_ / (speed * way));
    coupled += heading * (-told.damping * speed);
    // Nor does it push the hand on any more.
    if (const double along = dot(coupled, heading); along > 0)
      coupled += heading * (-along * std::min(1.0, -energy_ / settings_.energySlack));
  }
  const Vec3 wanted = shortened(coupled + weight_, limit());
  told.limited = length(coupled + weight_) > limit();
  const bool held = forces.touching || squaredLength(forces.pull) > 0;
  force_ = slewed(wanted, since, way, held ? settings_.gain * record_.stiffness : 0, told.limited);
  coupled_ = force_ - weight_;
}

ServoTick ServoStep::tick(const HandSample& hand, double now) {
  ServoTick told;
  told.seconds = now;
  told.hand = hand;
  if (hand.buttons & settings_.offButtons) off_ = true;
  const double since = begun_ ? now - last_ : kServoTick;
  const ServoFault fault = faultOf(hand, now, since);
  const bool lost = fault == ServoFault::NotFinite || fault == ServoFault::NotReady || fault == ServoFault::Clutch ||
                    fault == ServoFault::Jump;  // where the hand was says nothing about where it is
  if (lost) evaluator_.reset(), evaluatorBefore_.reset();
  if (state_ == ServoState::Off && fault != ServoFault::Off) state_ = ServoState::Waiting;
  if (fault != ServoFault::None) fail(fault, now, fault == ServoFault::Off || fault == ServoFault::NotFinite);
  if (fault == ServoFault::NotFinite) {  // nothing of it is kept
    begun_ = false;
    coupled_ = weight_ = {};
    told.state = state_;
    told.fault = fault_;
    return told;
  }
  const Vec3 at = hand.tip.carry;
  const Vec3 moved = begun_ && !lost ? at - place_ : Vec3{};
  energy_ -= dot(coupled_, moved);  // the force was held since the last tick

  TouchForces forces;
  if (scene_ && !lost) forces = felt(hand, now);
  if (!karinui::finite(forces.coupled()) || !karinui::finite(forces.weight) || !finite(forces.stored)) {
    fail(ServoFault::NotFinite, now, true);
    forces = {};
    evaluator_.reset(), evaluatorBefore_.reset();
  }
  const double pulse = scene_ ? click(*scene_, now) : 0;
  if (forces.touching && !touched_) onset_ = now;
  touched_ = forces.touching;

  const bool calm = fault == ServoFault::None && length(forces.coupled()) * settings_.gain < settings_.armBelow;
  const double share = arm(calm, now);
  if (state_ == ServoState::Ramping || state_ == ServoState::Armed) {
    drive(forces, pulse, share, moved, since, told);
    if (record_.vibrates)
      told.out.vibration =
          settings_.gain * std::max(pulse / kClickForce, touched_ && now - onset_ < kOnset ? 0.5 : 0.0);
  } else {
    const double left = state_ == ServoState::Fading ? 1 - (now - fadeFrom_) / settings_.fadeSeconds : 0;
    force_ = coupled_ = fading_ * std::max(0.0, left);
    weight_ = {};
  }
  begun_ = true;
  last_ = now;
  place_ = at;
  told.out.force = force_;
  told.state = state_;
  told.fault = fault_;
  told.touching = forces.touching;
  told.known = forces.known;
  told.proxy = forces.proxy;
  told.energy = energy_;
  return told;
}

Vec3 ServoStep::clickWay(const TouchForces& forces) const {
  const Vec3 way = normalized(forces.coupled());
  return squaredLength(way) > 0 ? way : Vec3{0, 1, 0};
}

}  // namespace karinui
