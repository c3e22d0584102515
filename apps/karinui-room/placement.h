#pragma once
// Where the fitting stands in the tracked room. Three spaces, all with y up and in metres:
//   room     what the headset tracks: its reference space;
//   stand    the fitting's surroundings, the pattern table among them: the room moved, turned and scaled;
//   fitting  the body's own space, in which the session works: the stand turned about the body's upright axis.
// Plain values and pure functions; any thread.
#include "karinui/geometry/vec.h"
#include "karinui/scene/pointer.h"

namespace karinui::room {

enum class Scale { One, TableTop };
inline constexpr double kTableTopScale = 0.3;  // room metres for a metre of the fitting: a figure of half a metre

struct Placement {
  double scale = 1;    // room metres for a metre of the fitting
  double heading = 0;  // radians about y: how the stand is turned in the room
  double turn = 0;     // radians about y: how the body is turned on its stand
  Vec3 foot;           // in the room: the floor below the body's middle

  Vec3 standToRoom(Vec3 p) const;
  Vec3 roomToStand(Vec3 p) const;
  Vec3 fittingToStand(Vec3 p) const;
  Vec3 standToFitting(Vec3 p) const;
  Vec3 fittingToRoom(Vec3 p) const { return standToRoom(fittingToStand(p)); }
  Vec3 roomToFitting(Vec3 p) const { return standToFitting(roomToStand(p)); }
  // Poses and rays: places as above, directions turned only.
  Rigid roomToStand(const Rigid& pose) const;
  Rigid roomToFitting(const Rigid& pose) const;
};

// A turn about y by `radians`, counter-clockwise seen from above.
Vec3 turnedAboutUp(Vec3 p, double radians);
// The direction a head or hand looks along, and how it is turned about y; looking along -z is 0.
Vec3 forwardOf(const Rigid& pose);
double headingOf(const Rigid& pose);

struct Posture {
  bool seated = false;
  // Height of the real floor in the room; not known where the headset tells none.
  std::optional<double> floor = {};
};
// Before someone whose head is there: at 1:1 the body stands on the floor 1.1 m away, a seated person's floor lowered
// so that the eyes are as high as a fitter's; at table-top scale it stands at the height of a desk.
Placement placedBefore(const Rigid& head, Scale scale, const Posture& posture);

// Takes hold of the room with grips. The tool hand carries the fitting along (at 1:1 the floor keeps its height); the
// other hand turns the body about its upright axis, as a dress form is turned.
class GrabLocomotion {
 public:
  struct Hand {
    bool held = false;
    Vec3 place;  // in the room
  };
  // Moves the placement; true: it moved.
  bool follow(Placement& placement, const Hand& tool, const Hand& other);
  bool holding() const { return carrying_ || turning_; }

 private:
  bool carrying_ = false, turning_ = false;
  Vec3 from_, footFrom_;
  double angleFrom_ = 0, turnFrom_ = 0;
};

}  // namespace karinui::room
