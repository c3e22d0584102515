#pragma once
// What a line drawn on the skin is drawn to: corners and outlines of the pieces that lie there already, the figure's
// landmarks and its middle. Made once for each state of the garment; the session's thread.
#include <optional>
#include <vector>

#include "karinui/session/fitting.h"

namespace karinui {

class DrawSnaps {
 public:
  struct Snap {
    SurfacePoint skin;
    Vec3 point;
    Message what;
    bool corner = false;  // a place, not a line to run along
  };
  void of(FittingPtr fitting);
  // The nearest of them within a finger's breadth, places before lines.
  std::optional<Snap> near(Vec3 place) const;
  // The outline near to every one of these places, and they on it; nothing where one of them is on none.
  std::optional<std::vector<Snap>> along(const std::vector<Vec3>& places) const;

 private:
  struct Outline {
    std::vector<Vec3> points;
    Message what;
  };
  std::optional<Snap> on(const Outline& outline, Vec3 place, double within) const;
  FittingPtr fitting_;
  std::vector<Snap> corners_;
  std::vector<Outline> outlines_;
};

}  // namespace karinui
