#pragma once
// The cutting table in space: where its paper lies, how it is drawn there, and the place of it that a pointing device
// means. Pure; any thread. Metres.
#include <optional>
#include <vector>

#include "karinui/scene/pointer.h"
#include "karinui/scene/table_frame.h"

namespace karinui {

// The paper lies as `across` and `upward` say: steps in space for one metre of paper to the right (u) and up (v), at
// right angles and equally long. Its front is where across x upward points.
struct TablePlacement {
  Vec3 origin;  // of the table's (0, 0)
  Vec3 across{1, 0, 0}, upward{0, 1, 0};
  double scale() const { return length(across); }
  Vec3 normal() const { return normalized(cross(across, upward)); }
  Vec3 at(Flat place, double above = 0) const {
    return origin + across * place.u + upward * place.v + normal() * above;
  }
  Flat below(Vec3 point) const;  // the place under a point, along the normal
};

struct TableMet {
  Flat place;
  double along = 0;  // metres of the ray
};
std::optional<TableMet> meet(const TablePlacement& placement, const Ray& ray);  // nothing from behind

// A sample in space as one on the table: where its ray meets the paper or, of a device with a tip, the place under the
// tip. How near is touching is carried over to metres of the table. Nothing where a ray does not meet the paper.
std::optional<PointerSample> onTable(const TablePlacement& placement, PointerSample sample);

// A line of lettering that lies on the table.
struct SceneLabel {
  Vec3 middle;
  Vec3 along, upward;  // reading direction, unit; the height of the font
  Message words;
};

struct TableScene {
  SceneFrame
      frame;  // pieces as flat cloths, all else as lines; cloth k is piece k of the table's frame; scans after them
  std::vector<SceneLabel> labels;
};
// `above`: how far over the placement's plane the paper lies; the lines lie as far over the paper. A piece whose shown
// outline crosses itself has lines and no cloth's triangles.
TableScene sceneOf(const TableFrame& frame, const TablePlacement& placement, double above = 0.003);

}  // namespace karinui
