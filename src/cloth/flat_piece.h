#pragma once
// Whether a piece still lies in a plane, as one does that was never draped.
#include <cmath>
#include <optional>
#include <span>

#include "karinui/cloth/cloth.h"

namespace karinui {

// The plane's unit normal, to the paper's upper side; none: the piece does not lie in one, to 0.1 mm. `x`: of all
// nodes.
inline std::optional<Vec3> normalWhereFlat(const ClothPiece& piece, std::span<const Vec3> x) {
  const std::span<const Vec3> own = x.subspan(piece.firstNode, piece.lattice->nodes.size());
  Vec3 normal;
  for (const Triangle& f : piece.lattice->faces) normal += cross(own[f[1]] - own[f[0]], own[f[2]] - own[f[0]]);
  normal = normalized(normal);
  for (Vec3 p : own)
    if (!(std::fabs(dot(p - own.front(), normal)) <= 1e-4)) return std::nullopt;
  return normal;
}

}  // namespace karinui
