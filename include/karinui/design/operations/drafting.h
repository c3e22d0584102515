#pragma once
// New pieces: drawn on the body, given by an outline, drafted from measures, copied from pieces there are.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// draw name=front line="landmark:neck_left; torso:bust@0.98; …" mirror=yes
// `edges` speaks of the places one by one: a name for the edge that begins there, or "~" where there is no corner and
// the edge before runs smoothly through. With symmetric=yes the line is one half, from the body's centre to its centre;
// `square` and `level` are settled then. Where `square` was left open, which it is only in documents of before it, the
// line is as drawn; where `level` was, it is 0.6 radians.
struct DrawPiece {
  static constexpr std::string_view kName = "draw";
  static constexpr std::string_view kHelp =
      "Draws a closed line on the body; the cloth inside it becomes a flat piece.";
  std::string name;
  std::vector<BodyPoint> line;
  std::vector<std::string> edges;
  bool mirror = false;
  bool symmetric = false;
  Choice square = Choice::Auto;
  std::optional<Angle> level;
  bool closed = true;
  std::optional<BodyPoint> inside;
  std::optional<Length> ease;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("line", self.line, "places on the body, in order; the line closes by itself", kNeeded);
    visit("edges", self.edges,
          "for each place the name of the edge that begins there, ~ where the line curves on without a corner; or just "
          "the names, from corner to corner",
          kOptional);
    visit("mirror", self.mirror, "yes: also the symmetric copy on the body's other side", kOptional);
    visit("symmetric", self.symmetric, "yes: the line is one half, from centre to centre; the piece is both halves",
          kOptional);
    visit("square", self.square,
          "a half line that comes nearly level to the centre crosses it square to it, one fair line with its likeness: "
          "auto, yes, no (auto: yes)",
          kOptional);
    visit("level", self.level, "how steeply it may come to the centre for that; steeper it is a V (43 degrees)",
          kOptional);
    visit("closed", self.closed, "no: drawn by hand, the line's ends must meet by themselves, within 15 mm", kOptional);
    visit("inside", self.inside, "a place inside the piece, where the line leaves it open which side is meant",
          kOptional);
    visit("ease", self.ease, "distance from the body (otherwise as set for the document)", kOptional);
    visitCloth(self, visit);
  }
  bool operator==(const DrawPiece&) const = default;
};

// piece name=front outline="M 0 0; hem L 500 0; side C 510 100 520 200 500 600; …" at="0,1.2m,0.2m"
// The outline is in millimetres; see docs/format/operations.md.
struct AddPiece {
  static constexpr std::string_view kName = "piece";
  static constexpr std::string_view kHelp = "Adds a piece with a known outline.";
  std::string name;
  Outline outline;
  std::vector<Outline> holes;
  std::vector<InternalLine> lines;
  std::vector<Mark> marks;
  Flat grain{0, 1};
  std::string fabric;
  Rigid pose;
  std::string bent;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("outline", self.outline, "\"M u v; edge L u v; edge C u v u v u v; edge A bulge u v\" in millimetres",
          kNeeded);
    visit("holes", self.holes, "outlines of holes, with | between", kOptional);
    visit("lines", self.lines, "internal lines: \"dart M u v L u v | …\" in millimetres", kOptional);
    visit("marks", self.marks, "notches \"name edge 0.5\" and drill holes \"name u,v\"", kOptional);
    visit("grain", self.grain, "the warp's direction on paper", kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("pose", self.pose, "where it stands: \"x,y,z\", then a turn \"y 90deg\" or a quaternion \"w,x,y,z\"",
          kOptional);
    visit("bent", self.bent, "how it is bent in space before its pose, by its name among the document's blobs",
          kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const AddPiece&) const = default;
};

// block kind=shirt ease=12cm
struct DraftBlock {
  static constexpr std::string_view kName = "block";
  static constexpr std::string_view kHelp = "Drafts ready pieces from the figure's measures, sewn and on the body.";
  enum class Kind { Bodice, Sleeve, Skirt, Trousers, Shirt, Collar, Leggings } kind = Kind::Shirt;
  std::optional<Length> ease, length;
  std::string prefix;
  std::string fabric;
  int layer = 0;
  Choice trued = Choice::Auto;
  bool over = false;
  Choice belly = Choice::Auto;
  enum class Worn { Auto, Holds, Waist, HighHip } worn = Worn::Auto;
  Choice armhole = Choice::Auto;
  std::optional<Length> knee, hem;
  Choice legs = Choice::Auto, meets = Choice::Auto, taper = Choice::Auto, bothLegs = Choice::Auto;
  // The fields that only some kinds have; a field that is not listed all have.
  static constexpr std::string_view kKindField = "kind";
  static bool has(Kind kind, std::string_view field) {
    const bool trousers = kind == Kind::Trousers, below = trousers || kind == Kind::Skirt || kind == Kind::Leggings;
    if (field == "ease") return kind != Kind::Collar;
    if (field == "belly" || field == "worn" || field == "meets") return below;
    if (field == "knee" || field == "hem" || field == "legs") return trousers;
    if (field == "armhole") return kind == Kind::Bodice || kind == Kind::Shirt;
    if (field == "both_legs") return kind == Kind::Skirt || kind == Kind::Bodice || kind == Kind::Shirt;
    return field != "taper" || kind == Kind::Sleeve || kind == Kind::Shirt;
  }
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("kind", self.kind, "bodice, sleeve, skirt, trousers, leggings, shirt or collar", kNeeded);
    visit("ease", self.ease, "added to the widest girth (of a sleeve: the upper arm's; of a collar: none)", kOptional);
    visit("length", self.length, "of the piece (otherwise by the block's own rule)", kOptional);
    visit("prefix", self.prefix, "put before the pieces' names", kOptional);
    visitCloth(self, visit);
    visit("trued", self.trued,
          "its lines go on smoothly across the seams, and what a side is longer on purpose is declared as ease: auto, "
          "yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
    visit("over", self.over, "yes: it stands off the cloth that is there too, as a waistcoat off a shirt", kOptional);
    visit("belly", self.belly,
          "the front of a skirt, trousers or leggings has room for a belly that is wider than the hip, where they are "
          "worn above it: auto, yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
    visit(
        "worn", self.worn,
        "where the upper edge of a skirt, trousers or leggings lies: waist, high_hip, holds (at the waist, or where it "
        "is narrowest below the belly if that holds them better), auto (holds, but waist in a record that does not "
        "have it)",
        kOptional);
    visit(
        "armhole", self.armhole,
        "the armhole of a bodice or a shirt is at least 12 cm longer than the upper arm is round, its underarm as low "
        "as that takes: auto, yes, no (auto: yes, but no in a record that does not have it)",
        kOptional);
    visit("knee", self.knee, "of trousers: how wide a leg is round the knee (otherwise by the block's own rule)",
          kOptional);
    visit("hem", self.hem, "of trousers: how wide a leg is round the hem (otherwise by the block's own rule)",
          kOptional);
    visit("legs", self.legs,
          "knee and hem of trousers are wider or narrower as the hip is by its ease: auto, yes, no (auto: yes, but no "
          "in a record that does not have it)",
          kOptional);
    visit(
        "meets", self.meets,
        "the waist of a skirt, trousers or leggings is as long as the open waist of a bodice that is there, and its "
        "darts go on in the bodice's: auto, yes, no (auto: for a skirt and trousers yes where a bodice fits, but no in "
        "a record that does not have it)",
        kOptional);
    visit("taper", self.taper,
          "sleeves stand before they are sewn up as tubes that narrow with the arm and follow its bend: auto, yes, no "
          "(auto: yes, but no in a record that does not have it)",
          kOptional);
    visit("both_legs", self.bothLegs,
          "a skirt, bodice or shirt that reaches below the crotch first stands round both legs, as they stand: auto, "
          "yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
  }
  bool operator==(const DraftBlock&) const = default;
};

struct DuplicatePiece {
  static constexpr std::string_view kName = "duplicate";
  static constexpr std::string_view kHelp = "Makes second pieces like the first, or one like a part of it.";
  std::vector<PieceRef> pieces;
  std::string name;
  Vec3 by;
  std::vector<Flat> line;
  std::optional<Flat> part;
  Choice seams = Choice::Auto;
  Choice corners = Choice::Auto;
  std::string edge;
  Choice named = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces to copy", kNeeded);
    visit("name", self.name, "the copy's name, of one piece", kOptional);
    visit("by", self.by, "how far from the first the copy stands (x,y,z)", kOptional);
    visit("line", self.line, "a line on the paper, from edge to edge, that divides off the part to copy", kOptional);
    visit("part", self.part, "a place on the paper in the part to copy (otherwise the smaller part)", kOptional);
    visit("seams", self.seams, kSeamsWithinHelp, kOptional);
    visit("corners", self.corners, kCornersHelp, kOptional);
    visit("edge", self.edge, kCutEdgeHelp, kOptional);
    visit("named", self.named,
          "an edge of which the part has one bit is called as the whole edge: auto, yes, no (auto: yes, but no in a "
          "record that does not have it)",
          kOptional);
  }
  bool operator==(const DuplicatePiece&) const = default;
};

struct MirrorPiece {
  static constexpr std::string_view kName = "mirror";
  static constexpr std::string_view kHelp = "Makes the symmetric copies of pieces on the body's other side.";
  std::vector<PieceRef> pieces;
  std::string name;
  Choice seams = Choice::Auto;
  bool sewn = false;
  Choice rings = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces to mirror", kNeeded);
    visit("name", self.name, "the copy's name, of one piece (otherwise left and right change places in it)", kOptional);
    visit("seams", self.seams, kSeamsWithinHelp, kOptional);
    visit(
        "sewn", self.sewn,
        "yes: also sewn as the pieces are to others, to their symmetric copies or other halves; lines they are sewn to "
        "are drawn there",
        kOptional);
    visit("rings", self.rings,
          "with sewn: also where the other side is that of the same edge, as on a waistband that is sewn up at a side: "
          "auto, yes, no (auto: yes, but no in a record that does not have it)",
          kOptional);
  }
  bool operator==(const MirrorPiece&) const = default;
};

// lining piece="front back" fabric=viscose open="front.hem back.hem" shorter=25mm
struct LinePieces {
  static constexpr std::string_view kName = "lining";
  static constexpr std::string_view kHelp =
      "Lines pieces: cuts each a second time, inside, sewn to it where it is not sewn to another lined one.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<PieceRef> pieces;
  std::string fabric;
  std::vector<EdgeRef> open;
  std::optional<Length> shorter;
  Choice eases = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces that are lined", kNeeded);
    visit("fabric", self.fabric, "what the lining is cut from (otherwise viscose)", kOptional);
    visit("open", self.open, "edges the lining is not sewn to, as a hem it hangs free at", kOptional);
    visit("shorter", self.shorter, "by how much the lining ends before the open edges", kOptional);
    visit("eases", self.eases, kEasesHelp, kOptional);
  }
  bool operator==(const LinePieces&) const = default;
};

// facing edges="front.neck back.neck" width=5cm
struct FaceEdges {
  static constexpr std::string_view kName = "facing";
  static constexpr std::string_view kHelp =
      "Faces edges: cuts the strip beside them once more, inside, sewn to them and to the next facing.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  Length width{0.06};
  std::string fabric;
  Choice eases = Choice::Auto, closed = Choice::Auto, copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges, as a neckline or the front edges", kNeeded);
    visit("width", self.width, "how deep the facing is", kOptional);
    visit("fabric", self.fabric, "what it is cut from (otherwise what its piece is)", kOptional);
    visit("eases", self.eases, kEasesHelp, kOptional);
    visit(
        "closed", self.closed,
        "the facing goes on over the piece's darts, closed, in one: auto, yes, no (auto: yes, but no in a record that "
        "does not have it)",
        kOptional);
    visit("copies", self.copies, "the same edges of the symmetric copies too: auto, yes, no (auto: no)", kOptional);
  }
  bool operator==(const FaceEdges&) const = default;
};

// unfold edge=half_front.fold
struct UnfoldPiece {
  static constexpr std::string_view kName = "unfold";
  static constexpr std::string_view kHelp = "Makes a whole piece of a half, mirrored on a straight edge.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the straight edge that is the fold", kNeeded);
  }
  bool operator==(const UnfoldPiece&) const = default;
};

using DraftingOperations =
    OperationList<DrawPiece, AddPiece, DraftBlock, DuplicatePiece, MirrorPiece, LinePieces, FaceEdges, UnfoldPiece>;

}  // namespace karinui
