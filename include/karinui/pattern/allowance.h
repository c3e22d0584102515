#pragma once
// How edges are finished. Seam allowances: how far beyond its seam line each edge is cut, and how the cut line turns at
// a corner; by the kind of the edge, where an edge or corner has none of its own. Elastics and hems: of single edges;
// fastenings (fastening.h): of runs.
// Metres on paper. Pure; any thread.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "karinui/pattern/darts.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/fastening.h"

namespace karinui {

// What is sewn is a seam. Of the other edges those called hem…, neck… and fold… are what they are called, and the rest
// is finished like a seam.
enum class EdgeKind { Seam, Hem, Neckline, Fold };
inline constexpr EdgeKind kEdgeKinds[] = {EdgeKind::Seam, EdgeKind::Hem, EdgeKind::Neckline, EdgeKind::Fold};
inline constexpr double kWidestAllowance = 0.1;
double usualAllowance(EdgeKind kind);

// How the cut lines of two edges are led to each other where the outline turns outwards.
enum class CornerKind {
  Mitre,         // both go on until they meet, or, where that is farther than 3.5 widths, are cut square
  Points,        // each ends on the line of the other's seam, and a straight cut joins the two
  MirrorBefore,  // the allowance of the edge before, folded on its seam line, lies edge to edge with what it covers
  MirrorAfter,
  SquareBefore,  // the allowance of the edge before ends square to it
  SquareAfter,
};
CornerKind mirrored(CornerKind kind);  // of the same corner, walked the other way

// An elastic sewn along an edge, as even over all of it.
struct Elastic {
  double ratio = 0.75;   // its cut length over the edge's
  double strength = 10;  // N with which it pulls when it is drawn out to one and a half times its cut length
  double stiffness() const { return 2 * strength; }  // N per unit of strain: its force grows evenly
  bool operator==(const Elastic&) const = default;
};
inline constexpr double kTightestElastic = 0.2, kLoosestElastic = 0.99;
inline constexpr double kWeakestElastic = 0.1, kStrongestElastic = 500;  // N

// An edge turned up: folded at the edge, `width` deep, and `under` of it turned in once more.
struct Hem {
  double width = 0.03, under = 0.01;                  // metres
  double allowance() const { return width + under; }  // what is cut beyond the edge
  bool operator==(const Hem&) const = default;
};
inline constexpr double kNarrowestHem = 0.003;
bool sound(const Elastic& elastic);  // within what is above
bool sound(const Hem& hem);

struct Allowances {
  using At = std::pair<PieceId, std::string>;  // an edge; of a corner the edge that starts there
  std::map<EdgeKind, double> kinds;            // where they are not as usual
  std::map<At, double> edges;                  // that have a width of their own
  std::map<At, CornerKind> corners;
  std::map<At, Elastic> elastics;
  std::map<At, Hem> hems;  // their allowance is `edges`'
  Fastenings fastenings;
  bool plain() const { return kinds.empty() && edges.empty() && corners.empty(); }  // widths and corners
  bool empty() const { return plain() && elastics.empty() && hems.empty() && fastenings.empty(); }
  bool operator==(const Allowances&) const = default;
};

// Leads them over to the edges of an edited pattern. Of edges that became one the widest counts, of elastics the
// tightest; a corner stays where the edge still starts there. What is no longer there is dropped.
void updateAllowances(Allowances& allowances, const EdgeMap& map, const Pattern& now);
// Gives a copy what its original has. `mirror`: the copy is its mirror image, whose edges run the other way, the last
// one first.
void copyAllowances(Allowances& allowances, const Piece& original, const Piece& copy, bool mirror);

// What they come to on a pattern.
class AllowancePlan {
 public:
  AllowancePlan(const Pattern& pattern, Allowances allowances);

  EdgeKind kind(PieceId piece, const std::string& edge) const;
  double width(PieceId piece, const std::string& edge) const;
  // Where `after` starts at the end of `before`. A hem is mirrored, so that it lies flat when it is turned up.
  CornerKind corner(PieceId piece, const std::string& before, const std::string& after) const;
  double width(EdgeKind kind) const;
  const PaperDart* foldedDart(PieceId piece, std::size_t to) const;  // that begins with this edge; null: none
  bool onFold(const Piece& piece) const;                             // it is half of what is cut
  const Allowances& allowances() const { return allowances_; }

 private:
  Allowances allowances_;
  std::set<Allowances::At> sewn_;
  std::map<std::pair<PieceId, std::size_t>, PaperDart> darts_;  // folded ones
};

}  // namespace karinui
