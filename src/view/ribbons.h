#pragma once
// Lines as flat ribbons that always face the eye: edges of the cloth, tacking stitches, strokes, arrows, tapes.
#include <cstdint>
#include <vector>

#include "karinui/scene/scene_frame.h"

namespace karinui {

struct RibbonVertex {
  float from[3], to[3];  // the piece of line, relative to the scene's origin
  float place[2];        // x: 0 at from, 1 at to; y: -1 or +1, the side
  float halfWidth[2];    // metres at from and at to
  float along[2];        // metres from the line's start, at from and at to
  float colour[3];       // linear
  float lift;            // metres drawn nearer to the eye than it is, so that the cloth does not swallow it
  float stitch[2];       // length of a stitch and of its gap in metres; 0: unbroken
};

struct Ribbons {
  std::vector<RibbonVertex> vertices;
  std::vector<std::uint32_t> corners;
  std::size_t leftOut = 0;  // pieces of line that could not be drawn
};

struct RibbonLook {
  Colour colour{};
  double widthMm = 1;
  double liftMm = 3;
  double stitchMm = 0, gapMm = 0;
  bool arrow = false;
};
void addRibbon(Ribbons& ribbons, const std::vector<Vec3>& line, Vec3 origin, const RibbonLook& look);

// All lines of a frame in the house's way.
Ribbons ribbonsOf(const SceneFrame& frame, Vec3 origin);

}  // namespace karinui
