#pragma once
// What connects a device with a session, which does not know of it: owns the device and its force loop, feeds the
// session with what the hand did, and shows the loop what the hand would touch. All functions on one thread, the
// session's. Behind them are two more: the loop (Servo), and one that makes scenes near the tip of what the session
// last showed, so that a picture that takes long to draw is not felt.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "karinui/devices/placement.h"
#include "karinui/haptics/hand_recording.h"
#include "karinui/haptics/stylus_pointer.h"
#include "karinui/session/session.h"
#include "karinui/touch/servo.h"

namespace karinui {

struct HapticSettings {
  ServoSettings servo;              // gain, limit, laws; clutchButtons besides those below
  Placement placement;              // of the device's workspace in the scene
  std::uint32_t clutchButtons = 2;  // bits: the tip stays while the device is led elsewhere
  StylusSettings stylus;
  // False: the session is fed by someone else, a mouse, and only the force is computed, to be shown.
  bool feeds = true;
  bool realTime = true;
  // Seconds: where update() has not been called for so long nothing more is published, and the loop fades the force
  // out.
  double longestPause = 1;
};

class HapticDriver {
 public:
  // The loop begins at once, without a scene and so without force.
  explicit HapticDriver(std::unique_ptr<HapticDevice> device, const HapticSettings& settings = {});
  ~HapticDriver();

  // Called some 30 to 120 times a second. Feeds the session what the hand did since the last time, unless another
  // pointer has a gesture under way (`mayFeed` false), then takes what the session shows, to be felt. `facing`: unit,
  // towards who looks. True: the session was fed.
  bool update(Session& session, Vec3 facing, bool mayFeed = true);
  bool down() const { return feeds_ && pointer_.down(); }  // the main button: other pointers had better wait
  // How far the hand was led since the last time while the clutch was down, metres of the scene.
  Vec3 takeLed();

  const DeviceRecord& record() const { return placed_.record(); }
  ServoTick last() const { return servo_.last(); }
  Servo& servo() { return servo_; }
  void bringTo(Vec3 scene) { placed_.bringTo(scene); }      // calibration: the tip is there now
  void turnTo(const Rigid& turn) { placed_.turnTo(turn); }  // the workspace, as who looks turns
  // From now on update() tells it every tick; null: none. It must outlive this, or be taken away before.
  void record(HandRecording* recording) { recording_ = recording; }
  void testFeel(double seconds);  // instead of the scene a level floor 1 cm below the tip, with a click at its end

 private:
  struct Test {       // of how it feels
    double ends = 0;  // seconds of the servo's clock; 0: none
    Vec3 at;
  };
  void publishScenes();
  std::unique_ptr<HapticDevice> device_;
  PlacedDevice placed_;
  StylusPointer pointer_;
  bool feeds_;
  double longestPause_;
  Vec3 led_, ledTaken_;
  HandRecording* recording_ = nullptr;
  Servo servo_;

  std::mutex mutex_;  // of all below
  std::condition_variable ends_;
  bool ended_ = false;
  TouchSource source_;
  double taken_ = 0;  // when, by the servo's clock
  Test test_;
  std::thread publisher_;  // last: it uses the others
};

}  // namespace karinui
