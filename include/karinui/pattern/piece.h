#pragma once
// The paper pattern: the truth from which meshes, drapes and prints are made. Plain values, shared and never edited in
// place; any thread may read. Metres on paper.
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/id.h"
#include "karinui/base/result.h"
#include "karinui/geometry/curve.h"
#include "karinui/geometry/mesh.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

// One named side of an outline. Its name is its identity: seams, notches and operations speak of "front.side_left".
// Names are unique within a piece (its holes included), [A-Za-z0-9_-]+; when "side" is cut in two its parts are "side"
// and "side_2"
struct Edge {
  std::string name;
  Curve curve;
  bool operator==(const Edge&) const = default;
};

// A closed curve, counter-clockwise (a hole too), each edge starting exactly where the one before ends. A slit is two
// banks: the outline runs in along a line and back along the very same line; only there may it touch itself.
struct Outline {
  std::vector<Edge> edges;
  bool operator==(const Outline&) const = default;
  double length() const;
  double area() const;  // of the exact curves to 1e-9 m2; holes are not taken off
  Ring flattened(double miss = 1e-5) const;
  std::optional<std::size_t> find(std::string_view edgeName) const;
};
// Refuses open, self-crossing, tiny (< 1 cm2 or an edge < 1 mm) or non-finite outlines, saying where; turns a clockwise
// outline round.
Result<Outline> checked(Outline outline);

// A line along which the cloth is folded and pressed. A free strip rests at about `hold` times the angle, whatever its
// fabric (1 would be a hinge that nothing turns back).
struct Crease {
  static constexpr double kSharpest = 2.96705972839036;  // radians: 170 degrees; cloth turned over is a hem
  double angle = 0;                                      // radians out of flat; positive: towards the right side
  double hold = 0.9;                                     // 0.1 … 0.99
  bool sound() const { return std::abs(angle) <= kSharpest && hold >= 0.1 && hold <= 0.99; }
  bool operator==(const Crease&) const = default;
};

struct InternalLine {
  std::string name;
  std::vector<Curve> curves;
  std::optional<Crease> crease;  // nothing: only drawn
  bool operator==(const InternalLine&) const = default;
};

struct Mark {  // a notch on an edge, or a drill hole where `edge` is empty
  std::string name;
  std::string edge;
  double fraction = 0;  // of the edge's length
  Flat place;           // for a drill hole
  bool operator==(const Mark&) const = default;
};

// The shape in space a piece of cloth holds while it is rigid: places on paper and where each is in space. Empty means
// flat. A drape leaves a new Form. Immutable, shared.
struct Form {
  std::vector<Flat> flat;
  std::vector<Vec3> space;  // before the piece's pose
  std::vector<Triangle> faces;
};

struct Piece {
  PieceId id;
  std::string name;  // unique in a document
  Outline outline;
  std::vector<Outline> holes;
  std::vector<InternalLine> lines;
  std::vector<Mark> marks;
  Flat grain{0, 1};  // unit: the warp's direction on paper
  std::string fabric = "cotton";
  std::string interfacing;           // the fabric fused to its wrong side; empty: none
  int layer = 0;                     // 0 next to the skin
  bool frozen = false;               // never live
  PieceId mirrorOf;                  // symmetric copy of
  Rigid pose;                        // after the form
  std::shared_ptr<const Form> form;  // null: flat, (u, v) -> (u, v, 0)
};

// Part of an edge, by length fractions, from < to. Whole edge by default.
struct EdgeSpan {
  PieceId piece;
  std::string edge;
  double from = 0, to = 1;
  bool operator==(const EdgeSpan&) const = default;
};

// Two runs of spans that are sewn together. Side `a` runs along its outlines' own direction; side `b` runs against its
// own if `reversed` (the usual case for two counter-clockwise outlines facing each other): the whole run is then walked
// from the end of its last span to the start of its first. Spans are listed in the outlines' own order on both sides.
struct Seam {
  SeamId id;
  std::string name;
  std::vector<EdgeSpan> a, b;  // each side: consecutive spans, joined end to end
  bool reversed = true;
  enum class Tie {
    OneToOne,
    TwoToOne,  // two points of the longer side on one of the shorter
    Pleat      // one to one; b is folded in under a, which can be sewn as well (pleats.h)
  } tie = Tie::OneToOne;
  bool operator==(const Seam&) const = default;
};

std::string_view tieName(Seam::Tie tie);  // "1:1", "2:1", "pleat"
std::optional<Seam::Tie> tieNamed(std::string_view name);

struct Pattern {
  std::map<PieceId, std::shared_ptr<const Piece>> pieces;
  std::map<SeamId, Seam> seams;
};

double length(const Pattern& pattern, const std::vector<EdgeSpan>& side);  // metres
const Edge* findEdge(const Piece& piece, std::string_view name);           // on the outline or a hole; null: none
// What a seam can hold: an edge, or an internal line of one curve (of the same name an edge is meant). Null: neither.
const Curve* findCurve(const Piece& piece, std::string_view name);
// The sides of a seam whose edges nothing else can be sewn to.
std::vector<const std::vector<EdgeSpan>*> takenSides(const Seam& seam);
double lengthMismatch(const Pattern& pattern, const Seam& seam);  // length of a - length of b, metres
double easeRatio(const Pattern& pattern, const Seam& seam);       // longer / shorter, >= 1

}  // namespace karinui
