#pragma once
// How this module says places and lengths, in millimetres with one decimal, and what a piece has not.
#include <string>

#include "karinui/base/number.h"
#include "karinui/pattern/piece.h"

namespace karinui {

inline std::string inMm(double metres) { return fixed(metres * 1e3, 1); }
inline std::string inMm(Flat place) {
  std::string words("(");
  words.append(inMm(place.u)).append(", ").append(inMm(place.v)).append(")");
  return words;
}

inline Error noEdge(const Piece& piece, std::string_view edge) {
  return notFound(say("Piece {0} has no edge {1}.", piece.name, edge));
}

}  // namespace karinui
