#pragma once
// The tape measure at the pointer: round the garment where the pointer is on cloth, round the body where it is on skin;
// round what is pointed at alone, the trunk or a leg level, an arm square to it. Pure; long for large garments; any
// thread. Metres.
#include <vector>

#include "karinui/session/garment_snapshot.h"

namespace karinui {

struct Tape {
  std::vector<Vec3> line;  // closed, begins and ends nearest to the pointer; empty: nothing to measure there
  double length = 0;
};
Tape tapeAt(const GarmentSnapshot& snapshot, const Hit& hit);

}  // namespace karinui
