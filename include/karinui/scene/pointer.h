#pragma once
// What a pointing device says: where it points, and whether its button is down. A mouse, a stylus and a recorded file
// all speak in these records; the session knows no other hands. Plain values; any thread. Metres, y up.
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct Ray {
  Vec3 origin;
  Vec3 direction{0, 0, -1};  // unit
};

struct PointerSample {
  enum class Phase { Hover, Press, Drag, Release };
  enum class Where { Space, Table };  // around the body, or over the flat pattern on the cutting table
  Phase phase = Phase::Hover;
  Where where = Where::Space;
  double seconds = 0;    // since any fixed moment
  Ray ray;               // in space
  Vec3 facing{0, 0, 1};  // unit, towards who looks: what is dragged moves at right angles to it
  Flat place;            // on the table
  double reach = 0.01;   // how near is touching: radians in space, metres on the table
  bool shift = false, control = false, alt = false;
  bool operator==(const PointerSample& o) const {
    return phase == o.phase && where == o.where && seconds == o.seconds && ray.origin == o.ray.origin &&
           ray.direction == o.ray.direction && facing == o.facing && place == o.place && reach == o.reach &&
           shift == o.shift && control == o.control && alt == o.alt;
  }
};

// One sample a line, for recordings: "press space 0.25 ox oy oz dx dy dz fx fy fz reach 0.01 shift" or
// "drag table 0.5 u v reach 0.004". text() and parse are exact inverses. What cannot be read is BadInput.
std::string text(const PointerSample& sample);
Result<PointerSample> parsePointerSample(std::string_view line);

}  // namespace karinui
