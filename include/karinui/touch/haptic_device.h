#pragma once
// One interface for every device: pose and buttons in; force, torque or vibration out. `devices` has the adapters, the
// servo uses them, and neither session nor cloth learns of one. Metres, newtons, seconds; y up, z towards the user.
#include <cstdint>
#include <string>

#include "karinui/geometry/bvh.h"

namespace karinui {

constexpr double kServoTick = 0.001;  // seconds: the nominal period of the force loop

struct DeviceRecord {
  std::string name;       // "Inverse3 04AB"
  int freedomIn = 3;      // 3: position, 6: orientation too
  int freedomOut = 0;     // 0: no force, 3: force, 6: torque too
  double force = 0;       // nominal, N
  double stiffness = 0;   // the most that is stable, N/m
  double damping = 0;     // the most that is stable, N s/m
  Box workspace;          // where the tip can go
  double rate = 1000;     // Hz at which it wants to be served
  double scale = 1;       // metres of the scene for a metre of the device
  bool vibrates = false;  // a cue without direction
  enum class Hand { Either, Left, Right } hand = Hand::Either;
};

struct HandSample {
  Rigid tip;                  // where it is (carry) and how it is turned
  Vec3 velocity;              // m/s
  std::uint32_t buttons = 0;  // bit 0 the main button, bit 1 the second, …
  double trigger = 0;         // or pinch, 0..1
  bool ready = false;         // calibrated, powered, and answering
  Vec3 led = {};              // metres it was led in all while its clutch was down and its tip stayed
};

struct HandForce {
  Vec3 force, torque;    // N, N m; on the hand
  double vibration = 0;  // amplitude 0..1
  bool operator==(const HandForce&) const = default;
};

// The servo's thread calls sample() and apply(), in turn and once a tick; neither waits longer than a few ticks nor
// allocates. stop() is called once, when the servo ends: after it the device holds no force.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceRecord& record() const = 0;
  virtual HandSample sample() = 0;
  virtual void apply(const HandForce& force) = 0;
  virtual void stop() = 0;
};

}  // namespace karinui
