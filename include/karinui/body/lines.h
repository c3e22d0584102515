#pragma once
// The lines of the body that a tailor drafts and draws by, as a dress form is taped: found from the chart and the
// landmarks of any figure, so that a share of a line's length lies at the anatomically same place on every one. Metres.
// Immutable; any thread.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/body/body.h"

namespace karinui {

struct BodyLine {
  std::string name;          // "side_left"
  std::vector<Vec3> points;  // on the skin, millimetres apart; a closed line does not repeat its first
  bool closed = false;
  double length = 0;

  Vec3 at(double share) const;  // of the length, 0 ... 1
  // The place of the line nearest to `place`, as a share of its length; `away`: how far it is.
  double nearest(Vec3 place, double& away) const;
};

// Every line a body may have. Lines of one side end in _left or _right, and run alike: a share names the mirrored place
// of the other side. Centre lines, side and princess lines run downwards; rings begin in front, the armhole at the
// shoulder point, and go on to the body's left (to its right for those of the right side).
std::span<const std::string_view> bodyLineNames();
Message bodyLineSaid(std::string_view name);                        // "side line, left"
const BodyLine* bodyLine(const Body& body, std::string_view name);  // null: not on this body
std::vector<BodyLine> findBodyLines(const Body& body);              // Body::lines() keeps what this finds
std::string mirroredName(std::string_view name);                    // _left for _right, and back; else the same

// Where two lines meet: the side at the waist, the armhole at the shoulder.
struct LineCrossing {
  std::size_t a = 0, b = 0;  // of Body::lines(), a < b
  double onA = 0, onB = 0;   // shares of their lengths
  Vec3 place;                // on a
};
std::vector<LineCrossing> lineCrossings(const Body& body);

}  // namespace karinui
