#pragma once
// A tube round a limb that is at every height as narrow as the piece it is made of: a long sleeve narrows with the arm
// and follows its bend. Metres.
#include <vector>

#include "design/operations/limb.h"

namespace karinui {

// A closed line by arc length.
class Girth {
 public:
  explicit Girth(Ring ring);
  double length() const { return length_; }
  Flat at(double s) const;
  Flat outwards(double s) const;  // unit, the mean of a centimetre about the place
  double nearest(Flat place) const;

 private:
  Ring ring_;
  std::vector<double> start_;
  double length_ = 0;
};

// Lengths round the limb are kept and so are heights along its axis; where the limb bends the paper is sheared, which a
// drape undoes.
class TaperedTube {
 public:
  // `paper` is the outline about the anchor, v towards the head; `skin` the limb's places over its height.
  TaperedTube(const Ring& paper, const std::vector<SkinPlace>& skin, double ease);
  Vec3 place(Flat paper, const LimbFrame& limb) const;

 private:
  struct Level {
    double height = 0;
    Girth girth;
    double front = 0;  // where the girth lies furthest towards the anchor's side
  };
  std::vector<Level> levels_;  // upwards
};

}  // namespace karinui
