#pragma once
// What a new piece is before its numbers are typed. GUI thread.
#include <optional>

#include "karinui/design/operation.h"
#include "karinui/session/garment_snapshot.h"
#include "karinui/session/gesture.h"

namespace karinui::studio {

// The edges an operation goes along: all that are chosen, or the whole run of edges that the one belongs to.
std::vector<EdgeRef> runChosen(const Document& document, const Selection& selection, const EdgeRef& edge);
// A band along a run of edges, the first of which says what it is: a collar of a neckline, a waistband of a waist, a
// cuff of a sleeve's hem, by what the edge and its piece are called; sewn, where none of the run is sewn yet.
DrawBand bandAlong(const Document& document, const EdgeRef& edge, std::vector<EdgeRef> run);

// A strap from one place to another, 2 cm wide, of the fabric where it begins; of a short edge, as wide as that is.
DrawStrap strapBetween(const Document& document, const EdgeNear& from, const std::optional<EdgeNear>& to);

// Pleats about 6 cm apart all along an edge, as the dialog first offers them.
FaceEdges facingAlong(const Document& document, std::vector<EdgeRef> run);  // on symmetric copies too
AddPleat pleatsIn(const Document& document, const EdgeRef& edge);
// Pleats that are drawn: the line is their fold, and beside it lie the fold inside and where the fold comes to lie. One
// to either side at most.
std::vector<AddPleat> drawnPleats(const Piece& piece, const std::string& fold);
// From the middle of an edge straight into its piece, to the first edge met there; to none where the edge is not there.
SlashAndSpread slashFrom(const Document& document, const EdgeRef& edge);
// Open at its uppermost edge, as a hand goes into a pocket; at none where that is all there is to sew.
SewPatch patchOf(const Document& document, PieceId piece);
// Buttons about 8 cm apart along an edge that laps over another, as the dialog first offers them.
Fasten fastenedTo(const Document& document, const EdgeRef& over, const EdgeRef& under);
// A zip of 20 cm at most, from the upper end of a seam; without sides where it is not there.
Fasten zipIn(const Document& document, SeamId seam);
// Over this edge, in the seam that joins it alone to one edge; nothing where it has none.
std::optional<SewFly> flyAt(const Document& document, const EdgeRef& over);
// As the dialog first offers it: what is along the edges or the inner line already, otherwise with the usual numbers.
SewElastic elasticAlong(const Document& document, std::vector<EdgeRef> edges);   // or along a line
SewElastic shirringAlong(const Document& document, std::vector<EdgeRef> edges);  // five rows of a weak elastic
SewTopstitch topstitchAlong(const Document& document, std::vector<EdgeRef> edges);
SewPiping pipingAlong(const Document& document, std::vector<EdgeRef> edges);
BindEdges bindingAlong(const Document& document, std::vector<EdgeRef> edges);
// A lining that hangs free at the lower edges that are not sewn, an inch shorter; at none if there are none.
LinePieces hangingLining(const Document& document, const std::vector<PieceRef>& pieces);
// The sizes as they are, or three to begin with.
GradePieces sizesOf(const Document& document);
// How the corner nearest to a place of an edge goes from size to size, as it does already. Once there are sizes.
GradePieces gradedCorner(const Document& document, const EdgeNear& near);
FoldLine turningAlong(const Document& document, PieceId piece, const std::string& line);

}  // namespace karinui::studio
