#pragma once
#include <cmath>

#include "karinui/cloth/cloth.h"

namespace karinui {

// The bending stiffness (N m) of a piece's cloth that is rolled up along a unit way on its paper: the energy of
// bending.h for that curvature.
inline double bendAlong(const ClothPiece& piece, Flat way) {
  const double u = dot(way, piece.lattice->weft), v = dot(way, piece.lattice->warp);
  const double bent = u * u * std::sqrt(piece.fabric.bendWeft) + v * v * std::sqrt(piece.fabric.bendWarp);
  return bent * bent;
}

}  // namespace karinui
