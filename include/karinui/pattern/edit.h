#pragma once
// Changes of paper pieces that keep the identity of edges, so that seams and notches follow. Pure: values in, values
// out; any thread. Metres on paper. What makes no sense is refused with its place; an unknown edge is NotFound. Naming:
// when an edge "side" is divided, its first part stays "side", the next becomes "side_2" (or the next free number); new
// edges along a cut are "cut", "cut_2" …
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "karinui/pattern/piece.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

// What became of the edges of a piece: each part [from, to] of an old edge (length fractions) is now a span. Edges that
// are not listed stayed as they were.
struct EdgePart {
  double from = 0, to = 1;
  EdgeSpan now;
};
using EdgeMap = std::map<std::pair<PieceId, std::string>, std::vector<EdgePart>>;

// The seams of the pattern, led over to the new edges. A span over a divided edge becomes several, in order; spans that
// follow each other on one edge become one.
void updateSeams(Pattern& pattern, const EdgeMap& map);
std::vector<EdgeSpan> ledOver(const std::vector<EdgeSpan>& side, const EdgeMap& map);  // of one side
// Where a place on an edge is now; nothing where it was cut away.
std::optional<std::pair<std::string, double>> placeNow(const EdgeMap& map, PieceId piece, const std::string& edge,
                                                       double fraction);

struct CutPieces {
  std::vector<Piece> pieces;  // one with a slit, or two; the first (otherwise the larger) keeps id and name
  EdgeMap edges;
  bool keptLeft = false;  // of two the first lies left of the line, as it runs
};
// Cuts along a line of places. Ends inside the piece and within 5 mm of the outline snap onto it, what runs out of the
// piece is left off, wiggles under 0.2 mm are straightened. A line with one end on the outline makes a slit: its two
// banks are the same curves walked both ways. A line from edge to edge makes two pieces, whose cut edges have the same
// names. Holes, marks, internal lines and the form go with the cloth they lie on; those of `sewnLines` are divided, and
// are in `edges`. Refuses a line that does not reach the outline, crosses itself or a hole, or leaves the piece and
// comes back. `toCorners`: an end that meets the outline within 3 mm of a corner goes to the corner, unless the line
// only takes a strip as thin off an edge.
Result<CutPieces> cutPiece(const Piece& piece, std::vector<Flat> line, PieceId second, const std::string& secondName,
                           const std::set<std::string>& sewnLines = {}, bool toCorners = false);

// The same where the line may go across darts: through one leg it leaves the cloth, and it goes on from the place of
// the other leg that is sewn to it. Across a dart that opens at an edge the piece falls in one part more; a dart with
// two points, a hole, becomes one dart of each part. `darts`: what was crossed, whose seams dividedDart() parts once
// they were led over to the new edges.
struct NewPart {
  PieceId id;
  std::string name;
};
struct CutDart {
  SeamId seam;
  bool turned = false;  // its edges, a hole's before, now run the other way
};
struct CutAcross {
  CutPieces cut;
  std::vector<CutDart> darts;
  std::vector<bool> keptLeft;  // of each stretch of the line that divides: what lies left of it kept the id
};
// `keepLeft`: so it shall be; of stretches beyond its end the larger part keeps the id.
Result<CutAcross> cutAcrossDarts(const Pattern& pattern, const Piece& piece, std::vector<Flat> line,
                                 const std::function<NewPart(std::size_t)>& newPart,
                                 const std::set<std::string>& sewnLines = {}, const std::vector<bool>& keepLeft = {},
                                 bool toCorners = false);
// The seam of a dart that was cut across, in one seam for each pair of pieces; all have its id and name.
std::vector<Seam> dividedDart(Seam seam, bool turned);

struct EditedPiece {
  Piece piece;
  EdgeMap edges;
};
// Puts a corner on an edge, at a fraction of its length (both parts at least 1 mm long).
Result<EditedPiece> splitEdge(const Piece& piece, std::string_view edge, double fraction);

// Takes away the corner at which `edge` ends: it and the next become one, under its name. Two straight edges become one
// straight one. With `refit` the parts of one curve become that curve again, edges that meet smoothly become the fewest
// cubics within 0.1 mm of both, and a corner is rounded: beyond a third of the shorter edge from it the curve stays
// within 0.5 mm of both. Without, edges that meet smoothly keep their shape and others become a curve that leaves and
// arrives as they did.
Result<EditedPiece> joinEdges(const Piece& piece, std::string_view edge, bool refit = false);

// Takes a wedge out of an edge: `width` of it, about a fraction of its length, up to `tip` inside the piece. Its two
// sides are new edges, "name" and "name_2" (or the next free), from the edge to the tip and back.
struct DartedPiece {
  EditedPiece edited;
  std::string to, back;  // the names of the two sides
};
Result<DartedPiece> addDart(const Piece& piece, std::string_view edge, double fraction, double width, Flat tip,
                            const std::string& name);

// Takes out a dart with two points, a hole in the shape of a kite: widest, by `width`, at a share of the way from one
// point to the other. Its edges are new, "name", "name_2" … (or the next free), counter-clockwise; the first two run
// from `from` to `to`. Refuses one that leaves the piece or meets an edge, a hole or a sewn line.
struct DoubleDartedPiece {
  Piece piece;
  std::array<std::string, 4> edges;
};
Result<DoubleDartedPiece> addDoubleDart(const Piece& piece, Flat from, Flat to, double width, double at,
                                        const std::string& name, const std::set<std::string>& sewnLines);

// Moves a dart, whose first side is the edge `leg`, to a place on another edge: the paper is cut there straight to the
// dart's point, and the shorter part between dart and cut is turned about the point until the dart is closed. The new
// dart's sides keep the names; the mouth's two edges meet. Holes, marks, internal lines and the form go with the paper.
// Refuses legs that differ by more than 2 mm, and a cut that leaves the piece.
Result<EditedPiece> pivotDart(const Piece& piece, std::string_view leg, std::string_view edge, double fraction);

// Moves a dart, whose first side is the edge `leg`, along the edge it opens at, by a length in the outline's direction:
// its sides keep length and angle, and the edge on both its sides keeps its length together. A drill hole at its point
// goes with it, all else stays where it is on the cloth. The form is left as it is. Refuses a dart at a corner, and one
// that would go beyond the edge.
Result<EditedPiece> shiftDart(const Piece& piece, std::string_view leg, double by);

// Lays another piece against a piece, edge to edge, and makes one paper of both: the edges of both runs (whole edges,
// each going on where the one before ends) go, and so do their notches. Holes, marks and internal lines of the other
// come along; what would have a name twice gets the next free one. The form is left as it is. `edges` tells what became
// of the edges and lines of both, `move` where the other's paper came to lie. Refuses runs that differ by more than
// 2 mm in length or in shape, and pieces that would lie on each other.
struct PaperMove {
  Flat from, to;  // a place that is turned about, and where it goes
  double radians = 0;
  Flat operator()(Flat place) const;
  Curve operator()(const Curve& curve) const;
};
struct MergedPieces {
  Piece piece;
  EdgeMap edges;
  PaperMove move;
};
Result<MergedPieces> mergePieces(const Piece& piece, std::span<const std::string> run, const Piece& other,
                                 std::span<const std::string> otherRun);

// The whole piece of a half: the half and its mirror image on the straight edge `fold`, which goes. An edge that names
// a side keeps its name and its image gets the other side's; any other gets "_left" or "_right", the half that lies in
// positive u of the fold being the left one. Holes, marks, internal lines and the form are mirrored likewise. Refuses a
// curved fold, and a half that reaches over it.
Result<EditedPiece> unfolded(const Piece& piece, std::string_view fold);

// The same edit on a symmetric copy of the piece; nothing if the copy went its own way since.
std::optional<EditedPiece> editedLikewise(const Piece& copy, const Piece& before, const EditedPiece& edit);

// Carries the corner at which `edge` starts to another place; the two edges there keep their shape near their other
// ends (cubics carry their near control along, arcs keep their bulge).
Result<Piece> moveCorner(const Piece& piece, std::string_view edge, Flat to);

// Carries an edge into the piece by a length (out of it where that is negative), square to the line between its ends,
// which come to stand on tenths of a millimetre; its neighbours follow as with moveCorner.
// `whole`: a chain of cubics goes as a whole, and not its ends alone.
Result<Piece> moveEdge(const Piece& piece, std::string_view edge, double by, bool whole = true);

// How far of a measure goes where along an edge: all of it at `most`, running out smoothly to nothing at `from` and at
// `to`; all of it from the end on where `most` is that end. Shares of the edge's length, from <= most <= to; beyond 0
// and 1 where the edge is a part of what runs out so.
struct Taper {
  double from = 0, most = 0.5, to = 1;
  double share(double at) const;
  double slope(double at) const;
  Taper reversed() const { return {1 - to, 1 - most, 1 - from}; }
  bool operator==(const Taper&) const = default;
};
// Several edges of the outline carried in at once, each square to the line between its ends; chains of cubics go as a
// whole. A corner between two of them goes as far from both. Their ends come to stand on tenths of a millimetre, other
// edges follow as with moveCorner. With a symmetry the edges of both halves are named, and stay each other's image.
struct EdgeCarry {
  std::string edge;
  double by = 0;               // metres into the piece
  std::optional<Taper> taper;  // none: all of the edge as far
  // It stays parallel to where it was, and its ends go along the edges beside it where these lead there, as a hem goes
  // down the side seams of a flared skirt. Such ends are exact. Not with a taper.
  bool follow = false;
};
Result<Piece> carryEdges(const Piece& piece, const std::vector<EdgeCarry>& carries, const PaperSymmetry* symmetry);

// Another outline for a piece; it must name the same edges in the same order (round the curve), so that all seams hold.
Result<Piece> reshaped(const Piece& piece, Outline outline);

// The symmetric copy of a piece (body's left <-> right, x -> -x): paper mirrored in u, form and pose mirrored, left and
// right exchanged in edge names; each edge runs the other way, so that the outline is again counter-clockwise. Id and
// name are left empty.
Piece mirrored(const Piece& piece);
// "left" <-> "right", "_l" <-> "_r" in a name; unchanged if there is neither.
std::string otherSide(const std::string& name);

// Seam::reversed so that the seam is not crossed: places of both sides in space, as many on each, evenly spread from
// start to end in the outlines' own direction. Two outlines that face each other run against each other: that is
// chosen where the places do not tell clearly.
bool facesReversed(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace karinui
