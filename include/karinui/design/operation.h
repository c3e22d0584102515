#pragma once
// What can be done to a garment. Each operation is a plain struct of ids and MATERIAL values only (edge and fraction,
// paper u-v, places on the body), never a ray, a pixel or a pose of the cloth; so undo, replay, scripts and
// made-to-measure are one thing. Its fields are listed once, in fields(self, visit): text form, file, help and JSON all
// grow from that list.
//   visit(name, value, help, kNeeded | kOptional)
// A field whose numbers are given by formulas (formula.h) keeps the formulas: see Operation below.
// kDisturbsDrape: cloth that was at rest is brought to rest again after it (see disturbsDrape).
// A field that has its default value is not written. Values and their text forms: values.h.
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/design/document.h"
#include "karinui/design/values.h"

namespace karinui {

enum Need { kOptional, kNeeded };

// body size=jis9ar            body size=eu38 set="bust_girth=90cm; waist=72cm"            body mesh=<hash of a blob>
struct SetBody {
  static constexpr std::string_view kName = "body";
  static constexpr std::string_view kHelp = "Chooses the figure: a built-in size, measurements, or an imported mesh.";
  static constexpr bool kDisturbsDrape = true;
  std::string size;
  std::optional<Sex> sex;
  std::vector<Stated> set;
  std::string mesh;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("size", self.size, "a built-in size to start from: jis9ar, eu38, eu50", kOptional);
    visit("sex", self.sex, "female or male: which family of shapes (a size brings its own)", kOptional);
    visit("set", self.set, "measurements: bust_girth=88cm; waist_girth=70cm, or formulas of each other", kOptional);
    visit("mesh", self.mesh, "an imported mesh, by its name among the document's blobs", kOptional);
  }
  bool operator==(const SetBody&) const = default;
};

// draw name=front line="landmark:neck_left; torso:bust@0.98; …" mirror=yes
// `edges` speaks of the places one by one: a name for the edge that begins there, or "~" where there is no corner and
// the edge before runs smoothly through. With symmetric=yes the line is one half, from the body's centre to its centre.
struct DrawPiece {
  static constexpr std::string_view kName = "draw";
  static constexpr std::string_view kHelp =
      "Draws a closed line on the body; the cloth inside it becomes a flat piece.";
  std::string name;
  std::vector<BodyPoint> line;
  std::vector<std::string> edges;
  bool mirror = false;
  bool symmetric = false;
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
    visit("closed", self.closed, "no: drawn by hand, the line's ends must meet by themselves, within 15 mm", kOptional);
    visit("inside", self.inside, "a place inside the piece, where the line leaves it open which side is meant",
          kOptional);
    visit("ease", self.ease, "distance from the body (otherwise as set for the document)", kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DrawPiece&) const = default;
};

// move piece=sleeve by="0,5cm,10cm" turn="y 90deg"
struct MovePiece {
  static constexpr std::string_view kName = "move";
  static constexpr std::string_view kHelp = "Carries pieces through space as rigid things, and turns them.";
  std::vector<PieceRef> pieces;
  Vec3 by;
  std::optional<Turn> turn;
  std::optional<Flat> about;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces to move", kNeeded);
    visit("by", self.by, "how far: right-left, up, forward (x,y,z)", kOptional);
    visit("turn", self.turn, "axis and angle: \"y 90deg\"", kOptional);
    visit("about", self.about, "the paper place of the first piece they turn about (otherwise its middle)", kOptional);
  }
  bool operator==(const MovePiece&) const = default;
};

// sew a=front.side_left b=back.side_left mirror=yes      sew a="front.armhole_l back.armhole_l" b=sleeve.cap
struct SewEdges {
  static constexpr std::string_view kName = "sew";
  static constexpr std::string_view kHelp = "Joins two runs of edges with a seam.";
  std::vector<EdgeRef> a, b;
  std::string name;
  Choice reversed = Choice::Auto;
  enum class Tie { Auto, OneToOne, TwoToOne } tie = Tie::Auto;
  bool mirror = false;
  bool replace = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("a", self.a, "edges of one side, joined end to end", kNeeded);
    visit("b", self.b, "edges of the other side", kNeeded);
    visit("name", self.name, "the seam's name", kOptional);
    visit("reversed", self.reversed, "side b runs against its own direction: auto, yes, no (auto: as the edges lie)",
          kOptional);
    visit("tie", self.tie, "auto, 1:1, or 2:1 (two points of the longer side on one of the shorter)", kOptional);
    visit("mirror", self.mirror, "yes: also the mirror image of the seam, on the garment's other half", kOptional);
    visit("replace", self.replace, "yes: seams that hold a part of these edges are taken out first", kOptional);
  }
  bool operator==(const SewEdges&) const = default;
};

struct Unsew {
  static constexpr std::string_view kName = "unsew";
  static constexpr std::string_view kHelp = "Takes seams out.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<SeamRef> seams;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("seam", self.seams, "the seams to take out: s5, or names", kNeeded);
  }
  bool operator==(const Unsew&) const = default;
};

// cut piece=sleeve line="10mm,0 10mm,80mm"
struct CutPiece {
  static constexpr std::string_view kName = "cut";
  static constexpr std::string_view kHelp =
      "Cuts along a line on the paper: from the outline inwards a slit, from edge to edge two pieces.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  std::vector<Flat> line;
  std::string name;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to cut", kNeeded);
    visit("line", self.line, "places on the paper, beginning or ending on or beyond the outline", kNeeded);
    visit("name", self.name, "the second piece's name, if it falls in two", kOptional);
  }
  bool operator==(const CutPiece&) const = default;
};

// pull piece=sleeve at="12cm,3cm" by="0,5cm,10cm; 0,10cm,15cm" seconds=1
struct PullCloth {
  static constexpr std::string_view kName = "pull";
  static constexpr std::string_view kHelp = "Takes the cloth at a place along a path while it drapes; feels the force.";
  PieceRef piece;
  Flat at;
  std::vector<Vec3> by;
  double seconds = 1;
  Length patch{0.015};
  bool letGo = true;
  std::vector<PieceRef> live;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to take hold of", kNeeded);
    visit("at", self.at, "where, on its paper", kNeeded);
    visit("by", self.by, "the hand's path: steps away from where it took hold (x,y,z)", kNeeded);
    visit("seconds", self.seconds, "how long the path takes", kOptional);
    visit("patch", self.patch, "radius of what the fingers hold", kOptional);
    visit("let_go", self.letGo, "yes: afterwards the cloth swings back; no: it stays held", kOptional);
    visit("live", self.live, "the pieces that drape (otherwise the pulled one)", kOptional);
  }
  bool operator==(const PullCloth&) const = default;
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

// drape        drape live=sleeve        drape stop=120
struct DrapePieces {
  static constexpr std::string_view kName = "drape";
  static constexpr std::string_view kHelp = "Brings the cloth to rest on the body.";
  std::vector<PieceRef> live;
  Vec3 gravity{0, -9.81, 0};
  int stop = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("live", self.live, "the pieces that move (otherwise every piece that is not frozen)", kOptional);
    visit("gravity", self.gravity, "metres per second squared (x,y,z)", kOptional);
    visit("stop", self.stop, "after how many of the solver's steps to stop where the cloth is (0: at rest)", kOptional);
  }
  bool operator==(const DrapePieces&) const = default;
};

// fabric name=denim piece="front back"        fabric name=my_wool like="wool suiting" weight=0.32
struct SetFabric {
  static constexpr std::string_view kName = "fabric";
  static constexpr std::string_view kHelp = "Describes a fabric, and cuts pieces from it.";
  static constexpr bool kDisturbsDrape = true;
  std::string name, like;
  std::vector<PieceRef> pieces;
  std::optional<Fabric::Law> law;
  std::optional<double> weight, stretchWarp, stretchWeft, stiffenWarp, stiffenWeft, shear, shearStiffen, bendWarp,
      bendWeft, compression, toe, toeWarp, toeWeft, frictionBody, frictionCloth;
  std::optional<Length> thickness;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the fabric's name: a preset, one of the document, or a new one", kNeeded);
    visit("piece", self.pieces, "pieces to cut from it", kOptional);
    visit("like", self.like, "the fabric a new one starts from", kOptional);
    visit("law", self.law, "woven, or simcloth (the historical law)", kOptional);
    visit("weight", self.weight, "kg/m2", kOptional);
    visit("stretch_warp", self.stretchWarp, "N/m for a strain of one at the toe's end, along the grain", kOptional);
    visit("stretch_weft", self.stretchWeft, "N/m for a strain of one at the toe's end, across the grain", kOptional);
    visit("stiffen_warp", self.stiffenWarp, "growth of that by a strain of one, in times itself", kOptional);
    visit("stiffen_weft", self.stiffenWeft, "the same across the grain", kOptional);
    visit("shear", self.shear, "N/m per radian", kOptional);
    visit("shear_stiffen", self.shearStiffen, "growth of that: the force is shear (g + shear_stiffen g^3)", kOptional);
    visit("bend_warp", self.bendWarp, "N m", kOptional);
    visit("bend_weft", self.bendWeft, "N m", kOptional);
    visit("compression", self.compression, "share of the stiffness that resists squeezing, 0 to 1", kOptional);
    visit("toe", self.toe, "strain over which the stretch stiffness rises, both ways", kOptional);
    visit("toe_warp", self.toeWarp, "the same along the grain alone", kOptional);
    visit("toe_weft", self.toeWeft, "the same across the grain alone", kOptional);
    visit("thickness", self.thickness, "a length", kOptional);
    visit("friction_body", self.frictionBody, "against the body", kOptional);
    visit("friction_cloth", self.frictionCloth, "against cloth", kOptional);
  }
  bool operator==(const SetFabric&) const = default;
};

// pin piece=skirt at="0,40cm; 10cm,40cm"        pin edge=skirt.waist
struct PinCloth {
  static constexpr std::string_view kName = "pin";
  static constexpr std::string_view kHelp = "Pins places of the cloth where they are.";
  PieceRef piece;
  std::vector<Flat> at;
  std::vector<EdgeRef> edges;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to pin", kOptional);
    visit("at", self.at, "places on its paper", kOptional);
    visit("edge", self.edges, "edges to pin all along, one pin a centimetre", kOptional);
  }
  bool operator==(const PinCloth&) const = default;
};

struct UnpinCloth {
  static constexpr std::string_view kName = "unpin";
  static constexpr std::string_view kHelp = "Takes pins out: all of a piece, or those near places.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  std::vector<Flat> at;
  Length within{0.02};
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("at", self.at, "places on its paper (otherwise all its pins)", kOptional);
    visit("within", self.within, "how near a pin must be", kOptional);
  }
  bool operator==(const UnpinCloth&) const = default;
};

struct RemovePieces {
  static constexpr std::string_view kName = "remove";
  static constexpr std::string_view kHelp = "Takes pieces away, with their seams and pins.";
  std::vector<PieceRef> pieces;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces to take away", kNeeded);
  }
  bool operator==(const RemovePieces&) const = default;
};

struct DuplicatePiece {
  static constexpr std::string_view kName = "duplicate";
  static constexpr std::string_view kHelp = "Makes a second piece like the first, or like a part of it.";
  PieceRef piece;
  std::string name;
  Vec3 by;
  std::vector<Flat> line;
  std::optional<Flat> part;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to copy", kNeeded);
    visit("name", self.name, "the copy's name", kOptional);
    visit("by", self.by, "how far from the first it stands (x,y,z)", kOptional);
    visit("line", self.line, "a line on the paper, from edge to edge, that divides off the part to copy", kOptional);
    visit("part", self.part, "a place on the paper in the part to copy (otherwise the smaller part)", kOptional);
  }
  bool operator==(const DuplicatePiece&) const = default;
};

struct MirrorPiece {
  static constexpr std::string_view kName = "mirror";
  static constexpr std::string_view kHelp = "Makes the symmetric copy of a piece on the body's other side.";
  PieceRef piece;
  std::string name;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to mirror", kNeeded);
    visit("name", self.name, "the copy's name (otherwise left and right change places in it)", kOptional);
  }
  bool operator==(const MirrorPiece&) const = default;
};

// rename piece=p1 to=front        rename edge=front.e3 to=hem        rename seam=s5 to=side
struct Rename {
  static constexpr std::string_view kName = "rename";
  static constexpr std::string_view kHelp = "Gives a piece, an edge or a seam another name.";
  PieceRef piece;
  std::optional<EdgeRef> edge;
  SeamRef seam;
  std::string to;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to rename", kOptional);
    visit("edge", self.edge, "or the edge", kOptional);
    visit("seam", self.seam, "or the seam", kOptional);
    visit("to", self.to, "the new name", kNeeded);
  }
  bool operator==(const Rename&) const = default;
};

// place piece=skirt at="torso:waist@0" ease=1cm: wraps the piece round the torso or a limb, its paper place `point`
// there. A sector of a ring stands as a cone instead. A record made before `cone` existed names the piece by its id and
// has ease and point decided: it keeps its old meaning.
struct PlacePiece {
  static constexpr std::string_view kName = "place";
  static constexpr std::string_view kHelp = "Wraps a piece round the torso or a limb at a level of the body.";
  PieceRef piece;
  BodyPoint at;
  std::optional<Flat> point;
  std::optional<Length> ease;
  Angle turn;
  Choice cone = Choice::Auto;
  bool over = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to place", kNeeded);
    visit("at", self.at, "where on the body its middle comes", kNeeded);
    visit("point", self.point, "the paper place that comes there (otherwise the outline's middle)", kOptional);
    visit("ease", self.ease, "distance from the body (otherwise as set for the document)", kOptional);
    visit("turn", self.turn, "how far the paper is turned first", kOptional);
    visit("cone", self.cone,
          "a ring sector as a cone that is open downwards: auto, yes, no (auto: yes, but no in a record that does not "
          "have it)",
          kOptional);
    visit("over", self.over, "yes: round the cloth that is there too, not only round the body", kOptional);
  }
  bool operator==(const PlacePiece&) const = default;
};

struct FreezePieces {
  static constexpr std::string_view kName = "freeze";
  static constexpr std::string_view kHelp = "Keeps pieces as they are: they never drape until thawed.";
  std::vector<PieceRef> pieces;
  bool frozen = true;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces", kNeeded);
    visit("frozen", self.frozen, "no: thaws them", kOptional);
  }
  bool operator==(const FreezePieces&) const = default;
};

struct SetLayer {
  static constexpr std::string_view kName = "layer";
  static constexpr std::string_view kHelp = "Says which pieces lie over which.";
  std::vector<PieceRef> pieces;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces", kNeeded);
    visit("layer", self.layer, "0 next to the skin", kNeeded);
  }
  bool operator==(const SetLayer&) const = default;
};

struct ChangeSettings {
  static constexpr std::string_view kName = "set";
  static constexpr std::string_view kHelp = "Changes the document's settings.";
  std::optional<Length> spacing, ease;
  std::optional<Settings::Collider> collider;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("spacing", self.spacing, "between the lattice's threads", kOptional);
    visit("ease", self.ease, "between the body and new pieces", kOptional);
    visit("collider", self.collider, "what stops the cloth: field, or planes (the historical merged planes)",
          kOptional);
  }
  bool operator==(const ChangeSettings&) const = default;
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
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const AddPiece&) const = default;
};

struct SetGrain {
  static constexpr std::string_view kName = "grain";
  static constexpr std::string_view kHelp = "Turns the grain line of a piece.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  Flat to{0, 1};
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("to", self.to, "the warp's direction on paper (u,v)", kNeeded);
  }
  bool operator==(const SetGrain&) const = default;
};

struct AddNotch {
  static constexpr std::string_view kName = "notch";
  static constexpr std::string_view kHelp = "Marks a place: a notch on an edge, or a drill hole.";
  EdgeRef edge;
  double at = 0.5;
  PieceRef piece;
  std::optional<Flat> point;
  std::string name;
  bool symmetric = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge to notch", kOptional);
    visit("at", self.at, "how far along it, as a share of its length", kOptional);
    visit("piece", self.piece, "for a drill hole: the piece", kOptional);
    visit("point", self.point, "for a drill hole: the place on its paper", kOptional);
    visit("name", self.name, "the mark's name", kOptional);
    visit("symmetric", self.symmetric, "yes: on the other half of a symmetric piece too", kOptional);
  }
  bool operator==(const AddNotch&) const = default;
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
    visit("symmetric", self.symmetric, "on both halves of a symmetric piece: auto, yes, no (auto: if it is symmetric)",
          kOptional);
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
    visit("symmetric", self.symmetric, "on both halves of a symmetric piece: auto, yes, no (auto: if it is symmetric)",
          kOptional);
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
    visit("symmetric", self.symmetric, "on both halves of a symmetric piece: auto, yes, no (auto: if it is symmetric)",
          kOptional);
  }
  bool operator==(const AddDart&) const = default;
};

// line piece=front along="5cm,10cm; 9cm,10cm" name=pocket
struct AddLine {
  static constexpr std::string_view kName = "line";
  static constexpr std::string_view kHelp = "Draws a line inside a piece: a fold, a pocket, a place to sew to.";
  PieceRef piece;
  std::vector<Flat> along;
  bool smooth = false;
  std::string name;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("along", self.along, "places on its paper", kNeeded);
    visit("smooth", self.smooth, "yes: a curve through the places instead of straight lines", kOptional);
    visit("name", self.name, "the line's name", kOptional);
  }
  bool operator==(const AddLine&) const = default;
};

// erase piece=front at=5cm,10cm        erase piece=front name=pocket
struct EraseMarks {
  static constexpr std::string_view kName = "erase";
  static constexpr std::string_view kHelp = "Takes notches, drill holes and internal lines away.";
  PieceRef piece;
  std::vector<std::string> names;
  std::optional<Flat> at;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("name", self.names, "the names of what goes", kOptional);
    visit("at", self.at, "or a place on its paper: the nearest within 1 cm goes", kOptional);
  }
  bool operator==(const EraseMarks&) const = default;
};

// flip seam=s5
struct FlipSeam {
  static constexpr std::string_view kName = "flip";
  static constexpr std::string_view kHelp = "Sews a seam the other way round.";
  static constexpr bool kDisturbsDrape = true;
  SeamRef seam;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("seam", self.seam, "the seam: s5, or its name", kNeeded);
  }
  bool operator==(const FlipSeam&) const = default;
};

// length edge=front.side_left to=36cm        length edge=front.shoulder_left to=12cm keep=end neighbours=follow
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
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge", kNeeded);
    visit("to", self.to, "its new length", kNeeded);
    visit("keep", self.keep,
          "what stays: auto, start, end, middle (both ends move by half); auto: the end on the centre of a symmetric "
          "piece, else the one whose neighbour is sewn, else the higher one",
          kOptional);
    visit("neighbours", self.neighbours,
          "the edges at a moved end: keep their lengths where they can, or follow (they stretch, and the edge does not "
          "turn)",
          kOptional);
    visit("symmetric", self.symmetric, "on both halves of a symmetric piece: auto, yes, no (auto: if it is symmetric)",
          kOptional);
  }
  bool operator==(const SetLength&) const = default;
};

// look fabric=denim colour=1f3b6e        look piece=front print=stripe ink=ffffff repeat=2cm
// What is not said stays as it was; plain=yes begins anew from what the fabric looks like by itself.
struct SetLook {
  static constexpr std::string_view kName = "look";
  static constexpr std::string_view kHelp = "Colours and prints a fabric, or single pieces.";
  std::string fabric;
  std::vector<PieceRef> pieces;
  bool plain = false;
  std::optional<Finish> finish;
  std::optional<Dye> colour;
  std::optional<PrintKind> print;
  std::optional<Dye> ink;
  std::optional<Length> repeat;
  std::optional<Angle> turn;
  std::string photo;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("fabric", self.fabric, "the fabric, for every piece that is cut from it", kOptional);
    visit("piece", self.pieces, "or single pieces, whatever their fabric looks like", kOptional);
    visit("plain", self.plain, "yes: first as the fabric looks by itself", kOptional);
    visit("finish", self.finish,
          "how its surface looks (in its usual colour): poplin, linen, denim, suiting, tweed, jersey, satin, chiffon, "
          "velvet, leather",
          kOptional);
    visit("colour", self.colour, "of the cloth: red, green and blue in hexadecimal, as 1f3b6e", kOptional);
    visit("print", self.print, "none, stripe, check, dot, photo", kOptional);
    visit("ink", self.ink, "colour of stripes, checks and dots", kOptional);
    visit("repeat", self.repeat, "from one stripe, check or dot to the next; of a photograph its width", kOptional);
    visit("turn", self.turn, "the print's angle to the grain", kOptional);
    visit("photo", self.photo, "the photograph, by its name among the document's blobs", kOptional);
  }
  bool operator==(const SetLook&) const = default;
};

// rectangle name=band width=70cm height=4cm
struct DrawRectangle {
  static constexpr std::string_view kName = "rectangle";
  static constexpr std::string_view kHelp = "Draws a rectangle on paper.";
  std::string name;
  Length width, height;
  std::vector<std::string> edges;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("width", self.width, "across the grain", kNeeded);
    visit("height", self.height, "along the grain", kNeeded);
    visit("edges", self.edges, "names of its edges, from the lower one round (bottom side_left top side_right)",
          kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DrawRectangle&) const = default;
};

// polygon name=yoke points="0,0; 20cm,0; 18cm,9cm; 0,7cm" edges="hem side ~ fold"
// `edges` as in draw. With symmetric=yes the points are one half; the fold is the line from the last to the first.
struct DrawPolygon {
  static constexpr std::string_view kName = "polygon";
  static constexpr std::string_view kHelp = "Draws a piece on paper through places, straight or curved.";
  std::string name;
  std::vector<Flat> points;
  std::vector<std::string> edges;
  bool symmetric = false;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("points", self.points, "places on the paper, in order; the line closes by itself", kNeeded);
    visit("edges", self.edges,
          "for each place the name of the edge that begins there, ~ where the line curves on without a corner",
          kOptional);
    visit("symmetric", self.symmetric, "yes: the places are one half, from fold to fold; the piece is both halves",
          kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DrawPolygon&) const = default;
};

// ring name=skirt inner=72cm depth=60cm angle=180deg        ring name=pouch depth=10cm
struct DrawRing {
  static constexpr std::string_view kName = "ring";
  static constexpr std::string_view kHelp = "Draws a circle, a ring or a sector of one on paper, as for circle skirts.";
  std::string name;
  std::optional<Length> inner, radius;
  std::vector<EdgeRef> of;
  Length depth;
  Angle angle{6.283185307179586};
  std::vector<std::string> edges;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("depth", self.depth, "from the inner edge to the outer one", kNeeded);
    visit("angle", self.angle, "of the sector; 360deg is a whole ring", kOptional);
    visit("inner", self.inner, "length of the inner edge, as of a waist", kOptional);
    visit("of", self.of, "or a run of edges that the inner edge is as long as", kOptional);
    visit("radius", self.radius, "or the inner edge's radius (0: a circle, or a sector of one)", kOptional);
    visit("edges", self.edges, "names of its edges: hem side_left waist side_right", kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DrawRing&) const = default;
};

// band name=collar of="front.neck_left front.neck_right back.neck" depth=4cm sew=yes
struct DrawBand {
  static constexpr std::string_view kName = "band";
  static constexpr std::string_view kHelp =
      "Draws a band as long as a run of edges: a collar, waistband, cuff or facing.";
  std::string name;
  std::vector<EdgeRef> of;
  Length depth;
  double ratio = 1;
  Length extra;
  bool sew = false;
  Angle turn;
  std::vector<std::string> edges;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("of", self.of, "the run of edges, joined end to end", kNeeded);
    visit("depth", self.depth, "how deep the band is", kNeeded);
    visit("ratio", self.ratio, "its length as a share of the run's; below 1 the run is gathered to it", kOptional);
    visit("extra", self.extra, "added to its length, as for a lap; it stays unsewn", kOptional);
    visit("sew", self.sew, "yes: stood along the edges and sewn to them; where they close a ring, its ends too",
          kOptional);
    visit("turn", self.turn, "how far it is folded outwards from where the cloth would go on", kOptional);
    visit("edges", self.edges, "names of its edges: low end_left top end_right; the first is sewn", kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DrawBand&) const = default;
};

// attach edge=collar.low to="front.neck_left front.neck_right back.neck"
struct AttachPiece {
  static constexpr std::string_view kName = "attach";
  static constexpr std::string_view kHelp = "Stands a piece with one edge along a run of edges of others.";
  EdgeRef edge;
  std::vector<EdgeRef> to;
  Angle turn;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge of the piece that is led there", kNeeded);
    visit("to", self.to, "the run of edges it comes along, joined end to end", kNeeded);
    visit("turn", self.turn, "how far it is folded outwards from where the cloth would go on", kOptional);
  }
  bool operator==(const AttachPiece&) const = default;
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

// block kind=shirt ease=12cm
struct DraftBlock {
  static constexpr std::string_view kName = "block";
  static constexpr std::string_view kHelp = "Drafts ready pieces from the figure's measures, sewn and on the body.";
  enum class Kind { Bodice, Sleeve, Skirt, Trousers, Shirt, Collar } kind = Kind::Shirt;
  std::optional<Length> ease, length;
  std::string prefix;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("kind", self.kind, "bodice, sleeve, skirt, trousers, shirt or collar", kNeeded);
    visit("ease", self.ease, "added to the widest girth (of a sleeve: the upper arm's; of a collar: none)", kOptional);
    visit("length", self.length, "of the piece (otherwise by the block's own rule)", kOptional);
    visit("prefix", self.prefix, "put before the pieces' names", kOptional);
    visit("fabric", self.fabric, "what it is cut from", kOptional);
    visit("layer", self.layer, "0 next to the skin", kOptional);
  }
  bool operator==(const DraftBlock&) const = default;
};

// variable name=cuff value="wrist_girth + 4cm"        variable name=cuff remove=yes
struct SetVariable {
  static constexpr std::string_view kName = "variable";
  static constexpr std::string_view kHelp = "Gives a formula a name, for other formulas; worked out where it is used.";
  std::string name, value;
  bool remove = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "letters, digits and _; no measure's name", kNeeded);
    visit("value", self.value, "a length, an angle or a number: 4cm, wrist_girth + 4cm, front.side_left/3", kOptional);
    visit("remove", self.remove, "yes: there is no such variable any more", kOptional);
  }
  bool operator==(const SetVariable&) const = default;
};

struct FieldText {
  std::string name, value;
  bool operator==(const FieldText&) const = default;
};

using PlainOperation =
    std::variant<SetBody, DrawPiece, MovePiece, SewEdges, Unsew, CutPiece, PullCloth, ReshapePiece, DrapePieces,
                 SetFabric, PinCloth, UnpinCloth, RemovePieces, DuplicatePiece, MirrorPiece, Rename, PlacePiece,
                 FreezePieces, SetLayer, ChangeSettings, AddPiece, SetGrain, AddNotch, SplitEdge, JoinEdges, AddDart,
                 AddLine, EraseMarks, FlipSeam, SetLength, SetLook, DrawRectangle, DrawPolygon, DrawRing, DrawBand,
                 AttachPiece, UnfoldPiece, DraftBlock, SetVariable>;

// One of the above. The fields named in `formulas` are given by formulas: what the struct holds there is their value as
// it was last worked out (nothing after reading a text), and resolved() works them out anew for the document at hand.
// So the same operation gives a longer edge on a larger figure. Two operations with formulas are alike when their texts
// are.
struct Operation : PlainOperation {
  using PlainOperation::variant;
  std::vector<FieldText> formulas;  // in the fields' order, in canonical form
};
bool operator==(const Operation& a, const Operation& b);

std::string_view nameOf(const Operation& operation);

// Whether cloth that was at rest should be brought to rest again after it: said by the operation's struct.
inline bool disturbsDrape(const Operation& operation) {
  return std::visit(
      []<class Op>(const Op&) {
        return requires { Op::kDisturbsDrape; };
      },
      operation);
}

}  // namespace karinui
