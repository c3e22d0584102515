#pragma once
// Grading: the same pieces in several sizes. Of places on a piece's outline it is said how far they go from the base
// size to each other one, as grade rules of the trade do; what lies between goes along. The pieces themselves are in
// the size that stands, so that every alteration of it is one of all sizes. Metres on paper. Pure; any thread.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/pattern/edit.h"

namespace karinui {

// A place on the outline of the size that stands and, for each size in order, how far it is from where the base has it.
struct GradePoint {
  std::string edge;
  double at = 0;  // of the edge's length, below 1; 0: the corner where it starts
  std::vector<Flat> by;
  bool operator==(const GradePoint&) const = default;
};
using GradePoints = std::vector<GradePoint>;  // of one piece

struct Grading {
  std::vector<std::string> sizes;      // from the smallest to the largest, as they were named
  std::size_t base = 0, standing = 0;  // of the sizes: which the differences begin from, which the pieces are in
  std::map<PieceId, GradePoints> pieces;
  bool empty() const { return sizes.empty(); }
  std::optional<std::size_t> find(std::string_view size) const;
  bool operator==(const Grading&) const = default;
};
inline constexpr std::size_t kMostSizes = 60;

// How far a place on an outline in the base size goes, for each size. Along an edge the differences between its graded
// places run smoothly, in a straight line where there are two; a corner without one goes as the outline between the
// graded places before and after it does.
std::vector<Flat> differenceAt(const Outline& outline, const GradePoints& points, std::string_view edge, double at,
                               std::size_t sizes);

// An outline of one size in another. Straight edges stay straight, what goes as a whole keeps its shape, and curves
// stay smooth where they were; they get joints as they need them. There and back again is the same to 1e-6 m. Refused:
// what is no outline.
Result<Outline> graded(const Outline& outline, const Grading& grading, const GradePoints& points, std::size_t from,
                       std::size_t to);

// Where a place within one outline lies in the other, which has the same edges: carried along by mean value coordinates
// (Hormann and Floater 2006).
std::vector<Flat> carriedWithin(const Outline& before, const Outline& after, std::vector<Flat> places);

// The piece in another size: holes, inner lines and drill holes go along with the outline, notches keep their share of
// the edge. Its form is left as it is. A piece without graded places is the same in all sizes.
Result<Piece> inSize(const Piece& piece, const Grading& grading, std::size_t to);

// The differences measured between outlines of all sizes, which have as many edges, in the same order; those of the
// base name them. Graded by them, the base misses no outline by more than kGradedMiss, where that takes no more than
// 100 places on an edge.
inline constexpr double kGradedMiss = 1e-5;
Result<GradePoints> measuredGrading(const std::vector<Outline>& sizes, std::size_t base);

// Leads them over to a piece's edges after an edit: `before` became the pieces of `now`. New corners go as the outline
// went there; of edges that became one the point between is no longer graded.
void updateGrading(Grading& grading, const Piece& before, const EdgeMap& map, const std::vector<const Piece*>& now);
// The places of a piece's mirror image (its edges run the other way, the last one first).
GradePoints mirroredGrading(const GradePoints& points, const Outline& original, const Outline& image);

}  // namespace karinui
