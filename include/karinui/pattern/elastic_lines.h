#pragma once
// Elastics along inner lines, as for shirring.
#include "karinui/pattern/allowance.h"

namespace karinui {

// The pattern as it is laid: an inner line that an elastic is sewn to is sewn to itself, so that nodes of the lattice
// lie along it; nothing is tied by that. The ids of these seams are no document's. Pure; any thread.
Pattern withElasticLines(Pattern pattern, const Allowances& finish);

// The further rows of an edge's elastic, from the second on, lie on lines of these names.
std::string elasticRowName(const std::string& edge, int row);
struct ElasticRows {
  int count = 1;
  double spacing = 0;  // metres from the edge to the second row
};
ElasticRows elasticRows(const Piece& piece, const std::string& edge, const Allowances& finish);

}  // namespace karinui
