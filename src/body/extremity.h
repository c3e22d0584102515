#pragma once
// Head, hands and feet of a mannequin are finer than the grid of the whole figure: each is a solid of its own, made
// into a mesh on a finer grid and put in the place of what the sections drew beyond a plane across neck, wrist or
// ankle. Before that plane the skin stays as it is, bit for bit. Metres.
#include <array>
#include <functional>
#include <vector>

#include "body/figure.h"
#include "body/figure_field.h"
#include "karinui/geometry/section.h"

namespace karinui {

struct Extremity {
  Plane cut;            // across the limb; its normal points to the end
  Vec3 tip;             // a place surely beyond the cut: what of the skin hangs together with it is replaced
  double gap = 0;       // from the cut to where the solid begins: the width of the strip between
  double blend = 0;     // from the cut to where the shape is the solid's alone
  bool paired = false;  // made on the left and mirrored; else its grid is the half from x = 0, and mirrored
  // The grid: right-handed unit axes, metres of a cell along each, and the box from `low` to `high` along the axes.
  Vec3 origin;
  std::array<Vec3, 3> axis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 cell, low, high;
  std::function<double(Vec3)> solid;  // its distance, negative inside; in space
};

Extremity headOf(const Figure& figure, double neckHeight);  // `neckHeight`: of the tape around the neck
Extremity handOf(const Figure& figure);                     // the left one
Extremity footOf(const Figure& figure);                     // the left one

// `mesh` is the surface of `field`, the drawn figure. Its points and faces before the cuts keep their place and their
// order; what is new comes after them. No faces: an end does not fit on this figure; a limb has no single section where
// it is to be cut, or what is new crosses something.
TriangleMesh withExtremities(const TriangleMesh& mesh, const FieldGrid& field, const std::vector<Extremity>& ends,
                             Workers& workers);

}  // namespace karinui
