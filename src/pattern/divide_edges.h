#pragma once
// Dividing edges at places, with names and maps: shared by all edits.
#include <set>

#include "karinui/pattern/edit.h"

namespace karinui {

struct EdgePlace {
  std::size_t edge = 0;
  double t = 0;  // the curve's parameter, inside (0, 1)
};

constexpr double kLeastEdge = 1e-3;  // metres an edge has at least

std::set<std::string> edgeNames(const Piece& piece);
// `name` if it is free, else name_2, name_3 …; takes it.
std::string freeName(const std::string& name, std::set<std::string>& taken);
void divideEdges(Outline& outline, std::vector<EdgePlace> places, std::set<std::string> taken, PieceId piece,
                 EdgeMap& map);
EdgeMap composed(const EdgeMap& first, const EdgeMap& second);  // one change after another
// Notches go with their part of the edge.
void followMarks(Piece& piece, const EdgeMap& map);

}  // namespace karinui
