#pragma once
// Pleats of paper: cloth folded in along parallel lines, so that three layers lie over one another. A knife pleat of
// depth d takes 2 d of the paper, a box or inverted pleat, which is two of them, 4 d; the edge, pleated, is as long as
// before. Knife pleats that are deeper than they are apart overlap as a kilt's do: each covers d - s of the next.
// Pleats that taper are deeper at the edge than beyond: each fold gives way by e between the edge and a line at the
// distance L from it, by e (2 x - x^2) at x L, so that the folded cloth widens from the waist to the hip.
// Metres on paper. Pure; any thread.
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "karinui/pattern/edit.h"
#include "karinui/pattern/spread.h"

namespace karinui {

enum class PleatKind {
  Knife,     // one fold
  Box,       // two folds turned away from each other, 2 d apart; behind them the cloth meets in the middle
  Inverted,  // two folds turned to each other, which meet in front
};

struct PleatPlan {
  std::string edge;           // of the outline, that is pleated
  std::vector<double> at;     // fractions of it, ascending: the fold of a knife pleat, else the middle
  std::vector<bool> toStart;  // of each knife pleat: its fold is turned to the edge's start, not to its end
  PleatKind kind = PleatKind::Knife;
  double depth = 0.02;     // of a fold, at the edge
  double taper = 0;        // e, of a fold; half of it is the depth it loses
  double taperLength = 0;  // L; 0: as far as the pleats go
  Flat along;              // unit: the lines' direction into the piece
  std::string name = "pleat";
  bool sewnBeyond = false;  // the edge where the pleats end is sewn, too, and so is pleated
};

// A fold of depth d, by the places across the lines at the edge: flat, the fold lies at `at`, the cloth under it in
// [low, low + d]; on the paper, `strip` begins the 2 d that are folded in.
struct PleatFold {
  double at = 0, low = 0, strip = 0;
  bool toStart = false;
  std::string fold, inner, place;  // the internal lines: pressed outwards and inwards, and where the fold comes to lie
};

// Where a place of pleated paper lies when the paper is folded: the place of the flat paper, and how many layers it is
// lifted above that (0 to 2).
struct FoldedPlace {
  Flat place;
  double lifted = 0;
  // Of a place on a fold: the way to stand clear of another fold that meets it there, as behind a box pleat. Where two
  // coincide, contact knows of neither on which side of the other it lies.
  Flat clear{};
};

// A line paper is folded along.
struct FoldAxis {
  Flat at, along;                                                       // unit
  double beside(Flat place) const { return cross(place - at, along); }  // > 0: right of it
  Flat mirroredWay(Flat way) const { return along * (2 * dot(way, along)) - way; }
  Flat mirrored(Flat place) const { return at + mirroredWay(place - at); }
};

// A pleat whose lines meet: the paper lies as if the part beside the edge's start had stayed, and the rest were turned.
struct PleatWedge {
  FoldAxis fold, inner, place;
  bool toStart = false;
  PaperMove back;                    // of the folded paper to where it lay before it was slashed
  std::function<Flat(Flat)> opened;  // of a place of that paper to the new one; none: the paper was not slashed
  FoldedPlace folded(Flat place) const;
  // Where places of the folded paper lie if it is spread evenly, about the point where the lines meet, over the room
  // the paper takes.
  std::function<Flat(Flat)> reopened(const Outline& paper) const;

 private:
  FoldedPlace closed(Flat place) const;  // with the part beside the edge's start where it is
};

struct PleatedPiece {
  EditedPiece edited;  // with the internal lines
  // What is folded in, b, and what it lies under, a; to be sewn with Seam::Tie::Pleat.
  struct Layer {
    EdgeSpan a, b;
    bool reversed = true;
  };
  std::vector<Layer> layers;
  std::vector<std::string> beyond;  // new parts of the edge in which the pleats end, if that is not sewn
  std::string beyondOf;             // its name
  std::vector<PleatFold> folds;     // ascending
  Flat across;                      // unit: from the edge's start to its end, at right angles to the lines
  double depth = 0;
  double taper = 0, taperFrom = 0, taperTo = 0;  // of a fold; between these heights along the lines
  double foldsShare = 0.5;     // of what a fold gives way by: what its fold line moves; its place moves by the rest
  std::size_t linesAdded = 0;  // the last ones of the piece
  bool overlapping = false;    // each covers a part of the next
  bool drawn = false;          // the old paper has the cloth for it already
  std::optional<PleatWedge> wedge;       // of a drawn pleat whose lines meet; `folds` then tells names only
  FoldedPlace folded(Flat place) const;  // of a place of the new paper; where it tapers, to both sides of the old one
  Flat spread(Flat place) const;         // where a place of the old paper is on the new one; of the top layer
  double opened(Flat place) const;       // by how much a fold has given way at the height of a place
};

// Spreads the paper along a line for each fold, draws the lines, and cuts both edges so that they lie edge to edge when
// the paper is folded. Refuses lines that run out elsewhere or through anything, pleats that do not fit on an edge,
// those that overlap but are not knife pleats turned one way, and a taper that leaves no fold or whose other end is
// sewn.
Result<PleatedPiece> addPleats(const Piece& piece, const PleatPlan& plan);

// A knife pleat by three lines that are drawn inside a piece, whose paper has the cloth for it: folded along the first,
// and inwards along the second, the first comes to lie on the third. What ends across them is cut so that it lies edge
// to edge when the paper is folded; the three lines are drawn anew from edge to edge. They run alongside each other, or
// come nearer to each other and may meet at the edge where they end. Refuses lines that meet inside the piece, an inner
// fold that does not lie halfway, and what addPleats() refuses.
struct DrawnPleat {
  std::string fold, inner, place;
  Flat along;  // unit: from the pleated edge into the piece
  std::string name = "pleat";
  bool sewnBeyond = false;
};
Result<PleatedPiece> foldDrawn(const Piece& piece, const DrawnPleat& drawn);

// A knife pleat that runs out at another edge: the paper is slashed from the pleated edge to there, opened by twice the
// depth, and what it opened by is folded in. `slash.by` says how much; `toBy`, `smooth` and `shared` are not looked at.
// The other edge runs on in a curve where the paper was bent. Refuses what spreadPiece() and foldDrawn() refuse.
Result<PleatedPiece> addPleatTo(const Piece& piece, const Slash& slash, bool toStart, const std::string& name);

// The pleats of a pattern, at each edge they are sewn into: the corners of the outline in which a fold, the fold inside
// it and the line where it comes to lie end.
struct PaperPleat {
  PieceId piece;
  std::string edge;  // of what is folded in, beside the fold
  Flat fold, inner, place;
  Flat along;  // unit: into the piece
};
std::vector<PaperPleat> pleatsOf(const Pattern& pattern);

// Where places of a pleated piece lie when its paper is folded flat.
struct PaperFolding {
  std::function<FoldedPlace(Flat)> folded;
  bool together = false;  // layers that are sewn to each other lie together there, no higher at a fold than beside it
};
// Nothing where it has no pleats, or they do not all run alongside each other, equally deep at every height.
std::optional<PaperFolding> foldingOf(const Pattern& pattern, PieceId piece);

// The internal lines of a piece that are edges of its lattice: those a seam holds, and those along which a pleat is
// folded or cloth is turned over.
std::set<std::string> linesOfLattice(const Pattern& pattern, const Piece& piece);

}  // namespace karinui
