#pragma once
// What operations that draw a piece on paper share. Metres.
#include <set>
#include <string>
#include <vector>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

// A piece on paper that is not on the body yet stands flat before the figure, beside the others that stand there.
inline constexpr double kPaperHeight = 1.0, kPaperDistance = 0.6, kPaperGap = 0.06;
Rigid beside(const Document& document, const Outline& outline);

struct NewPaper {
  std::string name, fabric;
  int layer = 0;
};
Done checkPaper(const Document& before, const NewPaper& paper);
// The piece, checked, flat before the figure.
Result<Piece> newPiece(const Document& before, const NewPaper& paper, Outline outline, std::vector<Outline> holes = {});
// About u = 0, standing on v = 0; names from the lower edge round.
Outline rectangleOf(double width, double height, const std::vector<std::string>& edges);

// A run of edges in space, in the outlines' own direction.
struct SpaceRun {
  std::vector<Vec3> place;   // evenly by length, ends included
  std::vector<Vec3> onward;  // unit: how the cloth would go on beyond the edge
  double length = 0;         // on paper
  bool closed = false;
  double apart = 0;  // the widest gap in space between edges that follow each other, metres

  bool together() const { return apart < 0.03; }  // one line in space
};
// Edges of outlines in the order in which each goes on where the one before ends, as they are named where that is so;
// nothing: they are no run in any order. A ring that was not named in order begins where the garment opens.
std::optional<std::vector<EdgeRef>> asOneRun(const Document& document, const std::vector<EdgeRef>& edges);
// A run that closes a ring, begun behind the first place that nothing holds together; as it is where there is none.
std::vector<EdgeRef> fromOpening(const Document& document, std::vector<EdgeRef> run);
// Whether the garment opens between the end of an edge and the beginning of the next: what lies beside both is
// fastened, or sewn from farther on only.
bool opensBetween(const Document& document, const EdgeRef& ref, const EdgeRef& next);
// Whether a run closes a ring.
bool closesRing(const Document& document, const std::vector<EdgeRef>& run);
// Puts a run in the outlines' own order; refuses edges that do not follow each other.
Done orderRun(const Document& before, std::vector<EdgeRef>& run);
SpaceRun runOf(const Document& document, const std::vector<EdgeRef>& run);
// The cloth that stands already, but for some pieces. Null: there is none.
std::unique_ptr<Bvh> standingSheets(const Document& document, const std::set<PieceId>& without);
// How a piece goes on beyond an edge: folded outwards by an angle, and turned over, so that its wrong side lies on the
// other's wrong side.
struct FoldedOn {
  double turn = 0;
  bool over = false;
  bool clear = false;     // beyond a right angle, only as far as the body and standing cloth let it
  bool beyond = false;    // what lies beyond the ends of the edge goes on straight; it was crushed into them
  std::string wrap = {};  // the edge on top, where it is led round the body more than once
};
// Auto becomes yes beyond a right angle; a record made before there was a choice keeps its meaning.
void decideClear(double turn, Choice& clear, const Context& context);
// The piece with `edge` along the run, the rest going on from its cloth, clear of `body` (null: none).
Result<Piece> attached(const Document& document, Piece piece, const std::string& edge, const SpaceRun& run,
                       const FoldedOn& fold, const Body* body);
// Where a piece goes round the body whose run's edges stand apart: settled where the skin nearest to the run's middle
// is an arm or a leg that the run does not go round. A record made before this was asked keeps its meaning.
Done decideRound(const Document& before, const std::vector<EdgeRef>& edges, std::optional<BodyPoint>& round,
                 Context& context);
// The same where the run's edges still stand apart, as before a first drape: wrapped round the body at `round`, else
// beside the run's middle. Refuses to turn a piece over there.
Result<Piece> ledTo(const Document& document, Piece piece, const std::string& edge, const SpaceRun& run,
                    const FoldedOn& fold, const Body* body, const std::optional<BodyPoint>& round);
// The lattice of one piece alone.
Result<std::shared_ptr<const Lattice>> layAlone(const Piece& piece, double spacing);
// The piece wrapped round the torso or a limb.
Result<Piece> placed(const Document& document, Piece piece, const PlacePiece& op, const Body& body);

}  // namespace karinui
