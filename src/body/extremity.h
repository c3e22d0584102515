#pragma once
// Head, hands and feet of a mannequin are finer than the grid of the whole figure: each is a solid of its own, made
// into a mesh on a finer grid and put in the place of what the sections drew beyond a plane across neck, wrist or
// ankle. Metres.
#include <functional>
#include <vector>

#include "body/figure.h"
#include "body/figure_field.h"
#include "karinui/geometry/section.h"

namespace karinui {

struct Extremity {
  Plane cut;     // across the limb; its normal points to the end
  double gap;    // from there to where the solid begins: the width of the strip between
  double cell;   // of its grid
  double blend;  // the fillet between limb and solid
  double taper;  // so far beyond the cut the limb has lost as much of its radius, and a quarter of it half-way
  Vec3 low, high;
  bool paired;  // made on the left and mirrored
  std::function<double(Vec3)> solid;
};

Extremity headOf(const Figure& figure);
Extremity handOf(const Figure& figure);  // the left one
Extremity footOf(const Figure& figure);  // the left one

// `mesh` is the surface of `field`, the drawn figure. No faces: a limb has no single section where it is to be cut.
TriangleMesh withExtremities(const TriangleMesh& mesh, const FieldGrid& field, const std::vector<Extremity>& ends,
                             Workers& workers);

}  // namespace karinui
