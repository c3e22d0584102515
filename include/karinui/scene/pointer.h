#pragma once
// What a pointing device says: where it points or where its tip is, and which buttons are down. A mouse, a stylus, a
// controller and a recorded file all speak in these records; the session knows no other hands. Plain values; any
// thread. Metres, y up.
#include <optional>
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct Ray {
  Vec3 origin;
  Vec3 direction{0, 0, -1};  // unit
  bool operator==(const Ray&) const = default;
};

struct PointerSample {
  enum class Phase { Hover, Press, Drag, Release };
  enum class Where { Space, Table };  // around the body, or over the flat pattern on the cutting table
  enum class Device { Mouse, SpaceMouse, Stylus, Controller };
  enum class Hand { Either, Left, Right };
  Phase phase = Phase::Hover;
  Where where = Where::Space;
  double seconds = 0;    // since any fixed moment
  Ray ray;               // in space; of a device with a tip, from the tip on
  Vec3 facing{0, 0, 1};  // unit, towards who looks: without a tip what is dragged moves at right angles to it
  Flat place;            // on the table
  double reach = 0.01;   // how near is touching: radians of a ray, metres of a tip and on the table
  bool shift = false, control = false, alt = false;
  // A device that is held in space: where its tip is (carry) and how it is turned. The main button is the phase.
  std::optional<Rigid> tip;
  bool second = false;  // the second button
  double trigger = 0;   // or pinch, 0..1
  double grip = 0;      // 0..1
  Device device = Device::Mouse;
  Hand hand = Hand::Either;
  bool operator==(const PointerSample&) const = default;
};

// One sample a line, for recordings: "press space 0.25 ox oy oz dx dy dz fx fy fz reach 0.01 shift" or
// "drag table 0.5 u v reach 0.004". After these, what differs from its default: "tip x y z qw qx qy qz", "second",
// "trigger 0.5", "grip 1", "device stylus", "hand left". text() and parse are exact inverses. What cannot be read is
// BadInput.
std::string text(const PointerSample& sample);
Result<PointerSample> parsePointerSample(std::string_view line);

}  // namespace karinui
