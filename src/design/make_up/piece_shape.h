#pragma once
// The outline of a piece as its corners and what lies between them, and the shapes that clothes are made of fitted to
// it. Metres, upright.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/make_up.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

// Corners in the outline's order, darts closed up; between corner k and the next lies run k.
struct Shape {
  struct Corner {
    Flat place;
    double turn = 0;     // radians to the left
    std::size_t at = 0;  // of the outline's edges: the one that starts here
  };
  struct Run {
    std::vector<std::size_t> edges;
    double length = 0;
    double area = 0;  // twice what it and the ways from and to the origin enclose
    Ring line;        // with both ends
  };
  std::vector<Corner> corners;
  std::vector<Run> runs;
  std::vector<std::array<std::size_t, 2>> darts;
  Flat low, high;
  double area = 0;

  std::size_t size() const { return corners.size(); }
  double length(std::size_t from, std::size_t to) const;
  // How far the way from corner to corner bulges outwards (negative: inwards), the area over the square of its chord.
  double bow(std::size_t from, std::size_t to) const;
  Flat place(std::size_t k) const { return corners[k].place; }
  Shape turned(double angle) const;  // about the paper's origin
  Shape mirrored() const;            // left and right change places; corners and runs keep their edges
};
Shape shapeOf(const Piece& piece);

// Where the notches of a run of edges lie, metres from where it begins, in order. With `ends` those at its very ends
// too.
std::vector<double> notchesAlong(const Piece& piece, const std::vector<std::string>& edges, bool ends = false);
inline constexpr double kAtEnd = 0.004;  // nearer to the end of a run a notch is its corner's

// A shape that fitted: how well, and the corner at which each part begins, in order round the outline.
struct ShapeFit {
  PieceRole role = PieceRole::Unknown;  // Front, LegFront and SkirtFront stand for back as well
  double score = 0;
  bool whole = true;                                      // reaches over the centre; else half
  bool mirrored = false;                                  // half: the centre lies at plus
  std::map<PiecePart, std::array<std::size_t, 2>> parts;  // from corner to corner
};
// The best of each kind that fits at all.
std::vector<ShapeFit> fitsOf(const Shape& upright);

}  // namespace karinui
