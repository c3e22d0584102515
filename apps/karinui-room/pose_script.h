#pragma once
// Recorded heads and hands, one change a line, by the number of the picture from which on it holds (72 a second):
//   0 head 0 1.55 0 1 0 0 0                      x y z, then the quaternion w x y z, in the room
//   12 right 0.2 1.1 -0.3 1 0 0 0 trigger 1      also: hold 0.8, stick 0 1, confirm, cancel, scale; what is not named
//   is up 40 left lost                                 out of sight
// and what the program that plays them does:
//   40 wait on     works out everything before the next picture (off: goes on meanwhile, as ever)
//   52 picture menu   leaves both eyes' pictures as menu_left.png and menu_right.png
//   90 end
// and, of a runtime that plays them, what happens to it: focus off|on, visible off|on, session lost, headset gone (for
// a while), instance lost, recentre. # begins a comment. Plain values and pure functions; any thread.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controller_mapper.h"
#include "karinui/base/result.h"

namespace karinui::room {

inline constexpr double kScriptRate = 72;               // pictures a second
inline constexpr long kLongestScript = 24 * 3600 * 72;  // pictures: a day

struct PoseScript {
  std::map<long, Rigid> head;
  std::array<std::map<long, ControllerState>, 2> hands;  // left, right
  struct Event {
    long picture = 0;
    std::string what;  // "wait on", "picture menu", "end", "session lost"
  };
  std::vector<Event> events;  // by their picture

  bool hasHands() const { return !hands[0].empty() || !hands[1].empty(); }
  // What holds at a picture; nothing before the first line.
  std::optional<Rigid> headAt(long picture) const;
  ControllerState handAt(std::size_t side, long picture) const;
  long end() const;  // the picture of "end", else one after the last line
};

// What cannot be read is BadInput and names the line.
Result<PoseScript> parsePoseScript(std::string_view text);
// A hand as a line; handAt() gives it back as floats, as a runtime would.
std::string handLine(long picture, std::size_t side, const ControllerState& hand);
std::string headLine(long picture, const Rigid& head);
// As a runtime hands it on: in floats.
Rigid asFloats(const Rigid& pose);

}  // namespace karinui::room
