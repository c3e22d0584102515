#pragma once
// What a run of the room came to, in numbers: pictures, how long each part of the way from the hand to the eye took,
// and what the document holds. One thread.
#include <string>
#include <vector>

#include "karinui/session/session.h"

namespace karinui::room {

// Since any fixed moment, never backwards.
double monotonicSeconds();

// Milliseconds of one part of every picture.
class LatencyStats {
 public:
  void add(double milliseconds) { all_.push_back(milliseconds); }
  std::size_t count() const { return all_.size(); }
  double mean() const;
  double share(double part) const;  // 0.5: the median; 0 of nothing

 private:
  std::vector<double> all_;
};

struct RoomReport {
  std::string runtime, system, driver, space, format;
  std::vector<std::string> profiles;  // left and right, as they last were
  std::vector<std::string> states;    // of the session, in order
  std::vector<std::string> failures;  // calls a runtime refused
  std::vector<std::string> said;      // sentences for the person
  long pictures = 0, undrawn = 0, whileDraping = 0, sessions = 0, pulses = 0;
  LatencyStats input;      // poses sampled until the session has taken them in
  LatencyStats taken;      // until the graphics memory has what is to be drawn
  LatencyStats drawn;      // both eyes' commands given
  LatencyStats submitted;  // poses sampled until xrEndFrame has returned
  LatencyStats waited;     // in xrWaitFrame: the headset's pace
};

// With the document's hashes and its steps as text.
std::string json(const RoomReport& report, const Session& session);

}  // namespace karinui::room
