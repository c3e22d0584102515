#pragma once
// How the cloth of a piece stands.
#include <cmath>

#include "karinui/pattern/piece.h"

namespace karinui {

// How far the cloth of a piece is stretched or pressed together where it stands, at most.
inline double strained(const Piece& piece) {
  double most = 0;
  for (const auto& face : piece.form->faces)
    for (int k = 0; k < 3; ++k) {
      const auto a = face[static_cast<std::size_t>(k)], b = face[static_cast<std::size_t>((k + 1) % 3)];
      const double flat = distance(piece.form->flat[a], piece.form->flat[b]);
      most = std::fmax(most, std::fabs(distance(piece.form->space[a], piece.form->space[b]) / flat - 1));
    }
  return most;
}

}  // namespace karinui
