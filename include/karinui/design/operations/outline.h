#pragma once
// The outline of a piece: cut, reshaped, its edges split, joined, darted and made as long as said.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

// cut piece=sleeve line="10mm,0 10mm,80mm"
struct CutPiece {
  static constexpr std::string_view kName = "cut";
  static constexpr std::string_view kHelp =
      "Cuts along a line on the paper: from the outline inwards a slit, from edge to edge two pieces; across darts as "
      "if "
      "they were closed.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  std::vector<Flat> line;
  std::string name;
  Choice copies = Choice::Auto;
  std::vector<std::string> keeps;
  Choice corners = Choice::Auto;
  std::string edge;
  Choice twins = Choice::Auto;
  Choice symmetric = Choice::Auto;
  Choice quantities = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to cut", kNeeded);
    visit("line", self.line, "places on the paper, beginning or ending on or beyond the outline", kNeeded);
    visit("name", self.name, "the second piece's name, if it falls in two; of more the largest is called so",
          kOptional);
    visit("copies", self.copies, "the symmetric copy too, along the image of the line: auto, yes, no (auto: no)",
          kOptional);
    visit("keeps", self.keeps,
          "which side of the line keeps the piece's name: left or right, as the line runs (otherwise the larger part); "
          "where it goes across darts, for each stretch between them",
          kOptional);
    visit("corners", self.corners, kCornersHelp, kOptional);
    visit("edge", self.edge, kCutEdgeHelp, kOptional);
    visit("twins", self.twins,
          "two parts that are mirror images, as the halves of a back, are symmetric copies from now on: auto, yes, no "
          "(auto: yes, but no in a record that does not have it)",
          kOptional);
    visit("symmetric", self.symmetric,
          "both halves of a symmetric piece, the other along the image of the line: auto, yes, no (auto: no)",
          kOptional);
    visit("quantities", self.quantities,
          "each part is cut as often as the piece was: auto, yes, no (auto: yes, but no in a record that does not have "
          "it)",
          kOptional);
  }
  bool operator==(const CutPiece&) const = default;
};

// reshape piece=front at="…; …" by="…; …": points pulled without force; recorded with the outline it led to.
struct ReshapePiece {
  static constexpr std::string_view kName = "reshape";
  static constexpr std::string_view kHelp = "Pulls places of a piece to new ones and cuts the paper anew to fit.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  std::vector<Flat> at;
  std::vector<Vec3> by;
  Length within{0.12};
  Choice symmetric = Choice::Auto;
  Outline outline;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to reshape", kNeeded);
    visit("at", self.at, "the places that are pulled, on its paper", kOptional);
    visit("by", self.by, "how far each is pulled in space (x,y,z)", kOptional);
    visit("within", self.within, "how far round a pulled place the cloth comes along", kOptional);
    visit("symmetric", self.symmetric,
          "a symmetric piece is pulled on both halves: auto, yes, no (auto: if it is symmetric)", kOptional);
    visit("outline", self.outline, "the new outline; found from at and by if it is not given", kOptional);
  }
  bool operator==(const ReshapePiece&) const = default;
};

// split edge=front.side_left at=0.4
struct SplitEdge {
  static constexpr std::string_view kName = "split";
  static constexpr std::string_view kHelp = "Puts a point on an edge, which becomes two.";
  EdgeRef edge;
  double at = 0.5;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge", kNeeded);
    visit("at", self.at, "how far along it, as a share of its length", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const SplitEdge&) const = default;
};

// join edge=front.side_left
// A record made before `refit` existed names the piece by its id and has `symmetric` decided: it keeps its old meaning.
struct JoinEdges {
  static constexpr std::string_view kName = "join";
  static constexpr std::string_view kHelp = "Takes away the point between an edge and the next; the two become one.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge;
  Choice symmetric = Choice::Auto;
  Choice refit = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge that ends at the point", kNeeded);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
    visit(
        "refit", self.refit,
        "yes: one curve fitted to both edges; no: one that only leaves and arrives as they did (auto: yes, but no in a "
        "record that does not have it)",
        kOptional);
  }
  bool operator==(const JoinEdges&) const = default;
};

// dart edge=front.waist at=0.3 tip=8cm,12cm width=25mm
struct AddDart {
  static constexpr std::string_view kName = "dart";
  static constexpr std::string_view kHelp = "Takes a wedge out of an edge and sews its two sides together.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge;
  double at = 0.5;
  Flat tip;
  Length width{0.02};
  std::string name;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge the dart opens at", kNeeded);
    visit("at", self.at, "the middle of its mouth, as a share of the edge's length", kOptional);
    visit("tip", self.tip, "where it ends, on the paper", kNeeded);
    visit("width", self.width, "how wide it opens, along the edge", kOptional);
    visit("name", self.name, "the name of its sides", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const AddDart&) const = default;
};

// double_dart piece=front from=10cm,16cm to=10cm,-14cm width=25mm
struct AddDoubleDart {
  static constexpr std::string_view kName = "double_dart";
  static constexpr std::string_view kHelp =
      "Takes a dart with two points out of the inside of a piece, as in a waist without a seam, and sews its sides.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  Flat from, to;
  Length width{0.02};
  double at = 0.5;
  std::string name;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece it is taken out of", kNeeded);
    visit("from", self.from, "one of its points, on the paper", kNeeded);
    visit("to", self.to, "the other", kNeeded);
    visit("width", self.width, "how wide it is where it is widest", kOptional);
    visit("at", self.at, "where it is widest, as a share of the way from the first point to the other", kOptional);
    visit("name", self.name, "the name of its sides", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const AddDoubleDart&) const = default;
};

// pivot dart=front.dart to=front.shoulder at=0.5
struct PivotDart {
  static constexpr std::string_view kName = "pivot";
  static constexpr std::string_view kHelp =
      "Moves a dart to another edge: cuts the paper there to its point, and turns it until the dart is closed.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef dart;
  EdgeRef to;
  double at = 0.5;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("dart", self.dart, "one of the dart's two sides", kNeeded);
    visit("to", self.to, "the edge it is moved to", kNeeded);
    visit("at", self.at, "how far along that edge, as a share of its length", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const PivotDart&) const = default;
};

// shift_dart dart=front.dart by=2cm
struct ShiftDart {
  static constexpr std::string_view kName = "shift_dart";
  static constexpr std::string_view kHelp =
      "Moves a dart along its edge as it is: its sides keep length and angle, the edge its length.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef dart;
  Length by;
  std::string towards;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("dart", self.dart, "one of the dart's two sides", kNeeded);
    visit("by", self.by, "how far; without towards= as the outline runs, less than nothing the other way", kNeeded);
    visit("towards", self.towards, "the edge towards which it goes, on either side of it", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const ShiftDart&) const = default;
};

// merge a=yoke.dart b=yoke_2.dart_2
struct MergePieces {
  static constexpr std::string_view kName = "merge";
  static constexpr std::string_view kHelp =
      "Lays two pieces edge to edge and makes one of them: the parts of a yoke once its darts are closed, a front and "
      "a "
      "side.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> a, b;
  Choice copies = Choice::Auto;
  Choice sides = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("a", self.a, "the edge, or the run of edges, of the piece that stays where it lies", kNeeded);
    visit("b", self.b, "that of the piece that is laid against it and becomes a part of it", kNeeded);
    visit("copies", self.copies,
          "the symmetric copies of both, too, to each other: auto, yes, no (auto: if they are still alike)", kOptional);
    visit("sides", self.sides,
          "edges that a piece and its symmetric copy both have are called left and right: side_left, side_right; auto, "
          "yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
  }
  bool operator==(const MergePieces&) const = default;
};

// trueup seam=s4        trueup seam="dart_left side_left" within=8cm
struct TrueUp {
  static constexpr std::string_view kName = "trueup";
  static constexpr std::string_view kHelp =
      "Trues the line across the ends of seams: a dart's mouth, a shoulder's ends. Sewn, the edges that go on there "
      "run smoothly.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<SeamRef> seams;
  Length within{0.08};
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("seam", self.seams, "the seams: s5, or names", kNeeded);
    visit("within", self.within, "how far from the seam the edges may bend; of each at most a half", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const TrueUp&) const = default;
};

// fair edges="sleeve.cap_back sleeve.cap_front"
struct FairEdges {
  static constexpr std::string_view kName = "fair";
  static constexpr std::string_view kHelp =
      "Draws edges anew as one fair line between the same ends, without steps and wavering: a sleeve's cap after "
      "slash and spread, a line drawn by hand.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges; those that run on smoothly into each other become one line", kNeeded);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const FairEdges&) const = default;
};

// spread from=skirt.hem to=skirt.waist by=4cm count=5        spread from=sleeve.cap to=sleeve.hem by=3cm to_by=3cm
struct SlashAndSpread {
  static constexpr std::string_view kName = "spread";
  static constexpr std::string_view kHelp =
      "Slashes the paper from edge to edge and spreads it: at one end, hinged at the other, or at both.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef from, to;
  Length by{0.03}, toBy;
  std::optional<double> at, toAt;
  int count = 1;
  bool smooth = true;
  std::string keep;
  Choice symmetric = Choice::Auto;
  Choice once = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("from", self.from, "the edge, or the part of it, from which the paper is slashed", kNeeded);
    visit("to", self.to, "the edge, or the part of it, to which it is slashed", kNeeded);
    visit("by", self.by, "how wide each slash is opened at the first edge; less than nothing: as much is folded out",
          kOptional);
    visit("to_by", self.toBy, "how wide at the other; 0: it is hinged there", kOptional);
    visit("at", self.at, "the place of a single slash on the first edge, as a share of its length", kOptional);
    visit("to_at", self.toAt, "its place on the other", kOptional);
    visit("count", self.count, "how many slashes, evenly over both edges", kOptional);
    visit("smooth", self.smooth, "yes: the edges are trued, in a curve over the opening; no: in straight lines",
          kOptional);
    visit("keep", self.keep,
          "an edge that stays where it is (otherwise one on the fold or, along the grain, with buttons or a zip, or "
          "the larger part)",
          kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
    visit("once", self.once,
          "a slash on the fold that ends in a corner is one slash of both halves, and each gets half of its opening: "
          "auto, yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
  }
  bool operator==(const SlashAndSpread&) const = default;
};

// pleat edge=skirt.waist count=6 depth=2cm        pleat edge=skirt.waist@0.2:0.8 kind=box depth=3cm stitch=10cm
// pleat edge=skirt.waist count=6 depth=3cm taper=16mm taper_length=18cm
// pleat edge=skirt.waist to=skirt.hem count=2 depth=3cm turned=inwards
// pleat lines="skirt.fold skirt.inner skirt.place"
struct AddPleat {
  static constexpr std::string_view kName = "pleat";
  static constexpr std::string_view kHelp =
      "Folds pleats or tucks into an edge: spreads the paper for them and sews their layers together there.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge, to;
  std::vector<EdgeRef> lines;
  PleatKind kind = PleatKind::Knife;
  Length depth{0.02};
  int count = 1;
  std::optional<double> at, toAt;
  enum class Turned { Along, Against, Inwards, Outwards } turned = Turned::Along;
  std::optional<Flat> along;
  Length stitch;
  Length taper, taperLength;
  double hold = 0.9;
  std::string name;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(
        "edge", self.edge,
        "the edge, or the part of it, over which the pleats are spread evenly; with lines: the one from which they run "
        "(otherwise that where they are farther apart, or at their upper end)",
        kOptional);
    visit(
        "lines", self.lines,
        "three inner lines of a paper that has the cloth for a pleat: the fold, the fold inside it, and where the fold "
        "comes to lie",
        kOptional);
    visit("kind", self.kind, "knife, box or inverted", kOptional);
    visit("depth", self.depth,
          "of a fold: a knife pleat takes twice as much of the paper, the others four times; knife pleats deeper than "
          "they "
          "are apart overlap",
          kOptional);
    visit("count", self.count, "how many", kOptional);
    visit("at", self.at, "the place of a single one, as a share of the edge's length", kOptional);
    visit("to", self.to,
          "the edge, or the part of it, at which knife pleats run out: the paper is slashed to there and opened",
          kOptional);
    visit("to_at", self.toAt, "the place there of a single one (otherwise as far along as on the first edge)",
          kOptional);
    visit("turned", self.turned,
          "the folds of knife pleats: along or against the edge's direction, inwards to its middle, or outwards",
          kOptional);
    visit("along", self.along, "their direction on paper (otherwise the grain, or square to the edge)", kOptional);
    visit("stitch", self.stitch, "how far they are sewn down from the edge; a tuck all its length", kOptional);
    visit("taper", self.taper,
          "by how much each fold gives way below the edge, so that the cloth is wider there, as at the hip; the edge "
          "stays as long as it is",
          kOptional);
    visit("taper_length", self.taperLength, "how far from the edge that is reached; 0: at the other end", kOptional);
    visit("hold", self.hold, "how well they are pressed, 0.1 to 0.99; 0: not pressed", kOptional);
    visit("name", self.name, "the name of their edges and lines", kOptional);
    visit("symmetric", self.symmetric,
          "on both halves of a symmetric piece: auto, yes, no (auto: yes where the edge lies on one half, but no in a "
          "record that does not have it)",
          kOptional);
  }
  bool operator==(const AddPleat&) const = default;
};

// length edge=front.side_left to=36cm        length edge=front.shoulder_left to=12cm keep=end neighbours=follow
// length edge=sleeve.under_front to=45cm partners=yes
// The edge keeps its shape, scaled; its other end moves. Every edge but it and its neighbours at the moved ends (and
// their mirror images) stays bit for bit.
struct SetLength {
  static constexpr std::string_view kName = "length";
  static constexpr std::string_view kHelp = "Makes an edge as long as said; says which end stays and what follows.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge;
  Length to;
  enum class Keep { Auto, Start, End, Middle } keep = Keep::Auto;
  enum class Neighbours { Keep, Follow } neighbours = Neighbours::Keep;
  Choice symmetric = Choice::Auto;
  Choice partners = Choice::No;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge", kNeeded);
    visit("to", self.to, "its new length", kNeeded);
    visit("keep", self.keep,
          "what stays: auto, start, end, middle (both ends move by half); auto: the end on the centre of a symmetric "
          "piece; middle where the edges at both ends are sewn to each other; else the end whose neighbour is sewn, "
          "else the higher one",
          kOptional);
    visit("neighbours", self.neighbours,
          "the edges at a moved end: keep their lengths where they can, or follow (they stretch, and the edge does not "
          "turn)",
          kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
    visit("partners", self.partners,
          "the edge it is sewn to, end to end, becomes longer or shorter by as much, at the same end: yes, no",
          kOptional);
  }
  bool operator==(const SetLength&) const = default;
};

// lengthen edges="front.armhole back.armhole_left" by=15mm
struct Lengthen {
  static constexpr std::string_view kName = "lengthen";
  static constexpr std::string_view kHelp =
      "Makes a run of edges longer or shorter by so much, and what it is sewn to by as much: an armhole with its cap.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  Length by;
  enum class Beside { Along, Keep, Follow } beside = Beside::Along;
  bool partners = true;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges; of two that are each other's mirror image one is meant", kNeeded);
    visit("by", self.by, "by how much they become longer together; less than nothing: shorter", kNeeded);
    visit("beside", self.beside,
          "the edges beside the ends that move: slide (an end goes along the edge beside it, all as far: an armhole "
          "deeper down the side), keep (their lengths where they can: an armhole out to the side), follow (they "
          "stretch)",
          kOptional);
    visit("partners", self.partners,
          "what they are sewn to becomes longer or shorter by as much, so that each seam keeps its ease", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const Lengthen&) const = default;
};

// takein edges=front.side_left by=1cm        takein edges="front.side_left, back.side_left" by=-5mm partners=no
// takein edges=front.side_left by=1cm at=0.6
struct TakeIn {
  static constexpr std::string_view kName = "takein";
  static constexpr std::string_view kHelp =
      "Takes the garment in: carries edges, and those sewn to them, into their pieces; lets it out where the measure "
      "is "
      "negative.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  Length by{0.01};
  Choice partners = Choice::Yes;
  Choice symmetric = Choice::Auto;
  Choice whole = Choice::Auto;
  Choice together = Choice::Auto;
  std::optional<double> at;
  bool moves = false;
  Choice follow = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges", kNeeded);
    visit("by", self.by, "how far each goes into its piece, square to the line between its ends", kOptional);
    visit("at", self.at,
          "as far only there, as a share of the edge's length, and from there to nothing at its ends; 0 and 1 are the "
          "ends themselves (without it: all along)",
          kOptional);
    visit("partners", self.partners, "the edges they are sewn to go as far, so that the seams still fit: yes, no",
          kOptional);
    visit("moves", self.moves,
          "yes: what they are sewn to is let out as far instead, so that the seam moves, as a shoulder seam forward",
          kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
    visit("whole", self.whole,
          "all of a curved edge goes, not its ends alone: auto, yes, no (auto: yes, but no in a record that does not "
          "have it)",
          kOptional);
    visit("together", self.together,
          "edges that meet keep their corner as far from both, and what symmetric copies are sewn to goes too: auto, "
          "yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
    visit(
        "follow", self.follow,
        "each stays parallel to where it was, and its ends go along the edges beside it, as a hem down the side "
        "seams of a flared skirt: auto, yes, no (auto: yes for hems that go as far all along, but no in a record that "
        "does not have it)",
        kOptional);
  }
  bool operator==(const TakeIn&) const = default;
};

using OutlineOperations =
    OperationList<CutPiece, ReshapePiece, SplitEdge, JoinEdges, AddDart, AddDoubleDart, PivotDart, ShiftDart,
                  MergePieces, AddPleat, SetLength, Lengthen, TakeIn, TrueUp, FairEdges, SlashAndSpread>;

}  // namespace karinui
