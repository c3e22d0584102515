#pragma once
// How pieces are cut and finished: what is left beyond the seam line.
// Conventions of the structs: field.h.
#include <optional>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"
#include "karinui/pattern/allowance.h"

namespace karinui {

// allowance edges="front.hem back.hem" width=4cm        allowance kind=seam width=12mm
// allowance edges=sleeve.hem start=square_before        allowance edges=front.hem plain=yes
struct SetAllowance {
  static constexpr std::string_view kName = "allowance";
  static constexpr std::string_view kHelp =
      "Says how far beyond the seam line edges are cut, and how the cut line turns at their ends.";
  std::vector<EdgeRef> edges;
  std::optional<EdgeKind> kind;
  bool plain = false;
  std::optional<Length> width;
  std::optional<CornerKind> start, end;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges", kOptional);
    visit("kind", self.kind, "or all edges of a kind that have none of their own: seam, hem, neckline, fold",
          kOptional);
    visit("plain", self.plain, "yes: first as usual", kOptional);
    visit("width", self.width, "from the seam line to the cut line, up to 10 cm", kOptional);
    visit(
        "start", self.start,
        "the corner where the edges start: mitre; points (each cut line ends on the other seam's line); mirror_before, "
        "mirror_after (the allowance of the edge before or after the corner, folded on its seam, matches what it "
        "covers); square_before, square_after (that allowance ends square)",
        kOptional);
    visit("end", self.end, "the corner where they end", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const SetAllowance&) const = default;
};

// ease seam=armhole by=2cm        ease seam=armhole by=0
struct DeclareEase {
  static constexpr std::string_view kName = "ease";
  static constexpr std::string_view kHelp = "Says by how much one side of a seam is longer on purpose.";
  SeamRef seam;
  Length by;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("seam", self.seam, "the seam: s5, or its name", kNeeded);
    visit("by", self.by, "the difference of its two sides; 0: none", kNeeded);
  }
  bool operator==(const DeclareEase&) const = default;
};

// quantity piece=pocket count=2 pairs=yes
struct SetQuantity {
  static constexpr std::string_view kName = "quantity";
  static constexpr std::string_view kHelp = "Says how often pieces are cut from the cloth.";
  std::vector<PieceRef> pieces;
  int count = 1;
  bool pairs = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces", kNeeded);
    visit("count", self.count, "how often each is cut", kNeeded);
    visit("pairs", self.pairs, "yes: half of them turned over, as for a left and a right one", kOptional);
  }
  bool operator==(const SetQuantity&) const = default;
};

// elastic edges="front.waist back.waist" ratio=0.7 strength=12        elastic edges=skirt.waist length=62cm
// elastic edges=skirt.waist none=yes        elastic edges=bodice.shirring ratio=0.6
// elastic edges="front.top back.top" ratio=0.7 rows=5 spacing=1cm
struct SewElastic {
  static constexpr std::string_view kName = "elastic";
  static constexpr std::string_view kHelp =
      "Sews an elastic along edges or inner lines, which gathers the cloth there.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  std::optional<double> ratio;
  std::optional<Length> length;
  std::optional<double> strength;
  std::optional<int> rows;
  std::optional<Length> spacing;
  bool none = false;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges, or inner lines, as for shirring", kNeeded);
    visit("ratio", self.ratio, "its cut length as a share of the edges' (otherwise 0.75)", kOptional);
    visit("length", self.length, "or its cut length, along all of the edges together", kOptional);
    visit("strength", self.strength,
          "newtons with which it pulls when it is drawn out to one and a half times its length (otherwise 10)",
          kOptional);
    visit("rows", self.rows, "how many alike, the others on lines that are drawn beside the edge (otherwise 1)",
          kOptional);
    visit("spacing", self.spacing, "from row to row (otherwise 1 cm)", kOptional);
    visit("none", self.none, "yes: takes the elastic out", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const SewElastic&) const = default;
};

// hem edges=skirt.hem width=4cm under=1cm        hem edges=skirt.hem none=yes
struct TurnHem {
  static constexpr std::string_view kName = "hem";
  static constexpr std::string_view kHelp =
      "Turns edges up and sews them down: the cloth is doubled there, and cut so much longer.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  Length width{0.03};
  Length under{0.01};
  bool none = false;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges", kNeeded);
    visit("width", self.width, "how deep the hem is", kOptional);
    visit("under", self.under, "how much of it is turned in once more, 0 where the edge is neatened", kOptional);
    visit("none", self.none, "yes: lets the hem down; its seam allowance is as usual again", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const TurnHem&) const = default;
};

// fold piece=cuff line=turn angle=150deg hold=0.9        fold piece=cuff line=turn angle=0
// fold piece=sleeve line=turn angle=170deg turned=yes
struct FoldLine {
  static constexpr std::string_view kName = "fold";
  static constexpr std::string_view kHelp = "Folds the cloth along a line inside a piece and presses it.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  std::vector<std::string> lines;
  Angle angle;
  double hold = 0.9;
  bool turned = false, flared = false;
  Choice copies = Choice::Auto, facings = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("line", self.lines, "the names of the lines", kNeeded);
    visit("angle", self.angle, "out of flat, up to 170deg; positive: towards the right side; 0: pressed flat again",
          kNeeded);
    visit("hold", self.hold, "how well it is pressed, 0.1 to 0.99: a free strip rests at about this share of the angle",
          kOptional);
    visit("turned", self.turned,
          "yes: the smaller part beyond the line is laid back over the rest at once, as a cuff is; at an angle of "
          "170deg, "
          "or -170deg to the wrong side",
          kOptional);
    visit(
        "flared", self.flared,
        "yes: what is turned back is cut as the mirror image of what it comes to lie on, wider where the piece narrows "
        "towards the line",
        kOptional);
    visit("copies", self.copies, kCopiesHelp, kOptional);
    visit(
        "facings", self.facings,
        "with turned: what faces it beneath is turned back with it, as a lapel's facing is: auto, yes, no (auto: yes, "
        "but no in a record that does not have it)",
        kOptional);
  }
  bool operator==(const FoldLine&) const = default;
};

using FinishingOperations = OperationList<SetAllowance, DeclareEase, SetQuantity, SewElastic, TurnHem, FoldLine>;

}  // namespace karinui
