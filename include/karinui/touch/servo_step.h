#pragma once
// One tick of the force loop, as a pure class: its clock is an argument. Everything that keeps a hand safe is here.
//   1 Force is a virtual coupling (spring and damper) between device and proxy or held place, never a solver's output.
//   2 Stiffness and damping stay within the device's record; a gain of 0..1 over all (default a half).
//   3 |F| <= min(the user's limit, 0.8 of the device's nominal force).
//   4 Slew rate limit: |dF| <= 30 N/s rising, 300 N/s falling, besides what the hand's own motion makes of the coupling
//     (stiffness x way). No step when a scene is replaced.
//   5 Force starts at zero, is armed when less than 0.2 N would act for some ticks, then ramps up; again after every
//     fault, clutch or lost focus.
//   6 Faults fade the force out within 50 ms; what is no number ends it at once.
//   7 A passivity observer and controller (Hannaford and Ryu 2002): damping where the coupling gave more energy than it
//     was given.
//   8 What is carried weighs at most 30 % of the nominal force.
//   9 Emergency off: by the device's button or from outside; zero at once, until it is taken back.
// Energy, the gain and the limits hold for the force that leaves step(). Newtons, metres, seconds. One thread; no
// allocation, no locks, no system calls.
#include <cstdint>

#include "karinui/touch/evaluate.h"

namespace karinui {

struct ServoSettings {
  double gain = 0.5;      // 0..1
  double limit = 3;       // N
  double rising = 30;     // N/s
  double falling = 300;   // N/s
  double armBelow = 0.2;  // N
  int armTicks = 4;
  double rampSeconds = 1.5;
  double blendSeconds = 0.015;  // from scene to scene
  double farthestJump = 0.020;  // metres of the device in a tick
  double fastest = 1.0;         // m/s of the device
  double latest = 0.020;        // seconds between ticks
  double stalest = 0.100;       // seconds since the scene was published
  double fadeSeconds = 0.050;
  double nominalShare = 0.8;
  double weightShare = 0.3;
  double energySlack = 1e-3;  // J
  bool passivity = true;
  std::uint32_t offButtons = 0;     // bits: emergency off
  std::uint32_t clutchButtons = 0;  // bits: the hand is led elsewhere and feels nothing
  TouchLaws laws = {};
};

enum class ServoFault { None, NotFinite, Jump, Speed, Late, Stale, NotReady, Clutch, NoFocus, Off };
enum class ServoState { Waiting, Ramping, Armed, Fading, Off };

struct ServoTick {
  double seconds = 0;  // of the servo's clock
  HandForce out;
  HandSample hand;
  ServoState state = ServoState::Waiting;
  ServoFault fault = ServoFault::None;  // the last one, until the force is armed again
  bool limited = false;                 // the limit or the slew rate limit holds
  bool touching = false;
  bool known = true;
  Vec3 proxy;
  double energy = 0;   // J that the coupling holds, as the passivity observer sees it
  double damping = 0;  // N s/m that the passivity controller adds
};

class ServoStep {
 public:
  explicit ServoStep(const DeviceRecord& record, const ServoSettings& settings = {});

  // The newest scene, and the one that is needed no more (null: none). A scene lives until it is handed back here or
  // this object is gone; up to two are kept.
  const TouchScene* adopt(const TouchScene* scene, double now);
  bool mayAdopt(double now) const;  // the blend before has ended
  ServoTick tick(const HandSample& hand, double now);

  void setGain(double gain);
  void setLimit(double newtons);
  void setLaws(const TouchLaws& laws) { settings_.laws = laws; }
  void setFocus(bool focus) { focus_ = focus; }
  void emergencyOff() { off_ = true; }
  void takeOffBack() { off_ = false; }
  double limit() const;  // N that can leave it

 private:
  ServoFault faultOf(const HandSample& hand, double now, double since) const;
  void fail(ServoFault fault, double now, bool atOnce);
  Vec3 slewed(Vec3 wanted, double since, double way, double stiffness, bool& limited) const;
  double click(const TouchScene& scene, double now);
  TouchForces felt(const HandSample& hand, double now);
  double arm(bool calm, double now);
  void drive(const TouchForces& forces, double pulse, double share, Vec3 moved, double since, ServoTick& told);
  Vec3 clickWay(const TouchForces& forces) const;

  DeviceRecord record_;
  ServoSettings settings_;
  const TouchScene* scene_ = nullptr;
  const TouchScene* before_ = nullptr;  // blended from
  double adopted_ = 0;
  TouchEvaluator evaluator_, evaluatorBefore_;

  bool focus_ = true, off_ = false;
  bool begun_ = false;     // there was a tick before
  double last_ = 0;        // its time,
  Vec3 place_, force_;     // where the hand was and what left;
  Vec3 coupled_, weight_;  // the two parts of that
  ServoState state_ = ServoState::Waiting;
  ServoFault fault_ = ServoFault::None;
  int calm_ = 0;
  double rampFrom_ = 0, fadeFrom_ = 0;
  Vec3 fading_;
  double energy_ = 0;
  std::uint32_t clicks_ = 0;
  bool clicksKnown_ = false;
  double clicked_ = -1;
  bool touched_ = false;
  double onset_ = 0;
};

}  // namespace karinui
