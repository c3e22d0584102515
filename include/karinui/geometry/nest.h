#pragma once
// Nesting: shapes laid on a strip of cloth so that they take little of its length. `u` runs along the strip from 0,
// `v` across it from 0 to its width. Metres. The same input gives the same bits on any number of threads.
//
// Method: bottom-left placement of an order of the shapes, and simulated annealing over orders (Burke, Hellier,
// Kendall, Whitwell 2006: "A new bottom-left-fill heuristic algorithm for the two-dimensional irregular packing
// problem"). Shapes are cut into columns along the strip, exact across it (semi-discrete: Chehrazad, Roose, Wauters
// 2022), so that what is forbidden to a pair of shapes is a table of intervals. At the end pieces slide together
// exactly.
#include <cstdint>
#include <optional>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

struct NestShape {
  Ring ring;       // counter-clockwise, turned as it will lie
  Flat reference;  // of the shape: lies on a multiple of the repeats
};

// One thing to be laid, as any one of several shapes: as it is, or turned half round.
struct NestItem {
  std::vector<std::size_t> ways;  // of the shapes; not empty
  bool onEdge = false;            // laid with v = 0 on the strip's edge: on the fold of the cloth
};

struct NestSettings {
  double width = 1.5;
  double gap = 0.005;       // between shapes; none to the strip's edges
  double across = 0;        // repeat of stripes along the strip, counted across it; 0: none
  double along = 0;         // repeat of stripes across the strip, counted along it; 0: none
  int tries = 4000;         // orders that are tried, over all threads
  std::uint64_t seed = 1;   // another one tries other orders
  double column = 0.002;    // of the search
  double from = 0, to = 1;  // what the token is told at the beginning and at the end
};

struct NestPlace {
  std::size_t way = 0;  // a shape
  Flat at;              // added to its points
};

struct Nesting {
  std::vector<NestPlace> places;        // of each item; empty where one has no place at all
  double length = 0;                    // of the strip that is used
  std::optional<std::size_t> homeless;  // the first item that has no place within the width
};
// Refused: cancelled.
Result<Nesting> nest(const std::vector<NestShape>& shapes, const std::vector<NestItem>& items,
                     const NestSettings& settings, Workers& workers, const Token& token);

// The ring and all within `by` of it, without its bays' narrow ends: its outer border. by > 0.
Ring widened(const Ring& ring, double by);

}  // namespace karinui
