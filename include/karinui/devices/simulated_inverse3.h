#pragma once
// A stand-in for the maker's service, as its documentation (3.5) has it: a real WebSocket server on the loopback
// interface, a full inventory on connect, then one state for every message. A simulated hand holds the device; its
// clock goes on by a millisecond with every message. For tests, and to measure a round trip without the device.
#include <functional>
#include <memory>

#include "karinui/touch/simulated_hand.h"

namespace karinui {

class SimulatedInverse3 {
 public:
  struct Grip {  // of the VerseGrip
    double w = 1, x = 0, y = 0, z = 0;
    std::uint32_t buttons = 0;  // bits: a, b, c
    double hall = 0;
  };
  // `aim`: where the hand means to be, by seconds, in the service's axes (right, away, up); on the service's thread.
  // Not plugged: the inventory is empty.
  explicit SimulatedInverse3(std::function<Vec3(double)> aim, bool plugged = true, const HandModel& model = {});
  ~SimulatedInverse3();
  unsigned short port() const;

  // Any thread.
  void setGrip(const Grip& grip);
  void fallSilent();  // does not answer any more
  void hangUp();      // closes the connection
  void setCalibrated(bool calibrated);
  struct Seen {
    std::uint64_t messages = 0;
    bool wrong = false;                             // a message that is not as documented
    double mostForce = 0, lastForce = 0, work = 0;  // N, N, J that the forces did on the hand
  };
  Seen seen() const;
  // Waits until what was seen is so, looking after every message; false: not within the seconds.
  bool wait(const std::function<bool(const Seen&)>& so, double seconds = 60) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace karinui
