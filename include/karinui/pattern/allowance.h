#pragma once
// How edges are finished. Seam allowances: how far beyond its seam line each edge is cut, and how the cut line turns at
// a corner; by the kind of the edge, where an edge or corner has none of its own. Elastics, hems and what else is done
// along single edges (finish.h); fastenings (fastening.h) of runs.
// Metres on paper. Pure; any thread.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "karinui/pattern/darts.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/fastening.h"
#include "karinui/pattern/finish.h"

namespace karinui {

// What is sewn is a seam. Of the other edges those called hem…, neck… and fold… are what they are called, and the rest
// is finished like a seam.
enum class EdgeKind { Seam, Hem, Neckline, Fold };
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

struct Allowances {
  using At = std::pair<PieceId, std::string>;  // an edge; of a corner the edge that starts there
  std::map<EdgeKind, double> kinds;            // where they are not as usual
  std::map<At, double> edges;                  // that have a width of their own
  std::map<At, CornerKind> corners;
  std::map<At, Elastic> elastics;
  std::map<At, Hem> hems;  // their allowance, as that of bindings, is `edges`'
  std::map<At, Topstitch> topstitches;
  std::map<At, Piping> pipings;
  std::map<At, Binding> bindings;
  Fastenings fastenings;
  // All that is done along edges, one after the other.
  template <class Self, class Visit>
  static void eachFinish(Self& self, Visit&& visit) {
    visit(self.elastics), visit(self.hems), visit(self.topstitches), visit(self.pipings), visit(self.bindings);
  }
  bool trimmed() const { return !topstitches.empty() || !pipings.empty() || !bindings.empty(); }
  bool plain() const { return kinds.empty() && edges.empty() && corners.empty(); }  // widths and corners
  bool empty() const { return plain() && elastics.empty() && hems.empty() && !trimmed() && fastenings.empty(); }
  bool operator==(const Allowances&) const = default;
};

// Leads them over to the edges of an edited pattern. Of edges that became one the widest counts, of what is done along
// them what prevails; a corner stays where the edge still starts there. What is no longer there is dropped.
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
  const std::set<std::size_t>& foldedHoles(PieceId piece) const;     // darts with two points: marked, not cut
  bool onFold(const Piece& piece) const;                             // it is half of what is cut
  const Allowances& allowances() const { return allowances_; }

 private:
  Allowances allowances_;
  std::set<Allowances::At> sewn_;
  std::map<std::pair<PieceId, std::size_t>, PaperDart> darts_;  // folded ones
  std::map<PieceId, std::set<std::size_t>> foldedHoles_;
};

}  // namespace karinui
