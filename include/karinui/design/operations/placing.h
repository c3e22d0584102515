#pragma once
// Where rigid pieces stand: moved, placed on the body, attached to others, layered, removed.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

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
  bool taper = false;
  std::string wrap;
  double arc = 0;
  Choice folded = Choice::Auto;
  bool flat = false;
  Choice bothLegs = Choice::Auto;
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
    visit("taper", self.taper, "yes: at every height as narrow as the piece is there, as a sleeve narrows with the arm",
          kOptional);
    visit("wrap", self.wrap, kWrapHelp, kOptional);
    visit("arc", self.arc,
          "the share of the way round that it takes, 0.5 as a front or back; what is wider stands in upright waves "
          "(otherwise it takes its own width)",
          kOptional);
    visit("folded", self.folded,
          "its pleats stay folded: auto, yes, no (auto: if it has any that run alongside each other, but no in a "
          "record that does not have it)",
          kOptional);
    visit("flat", self.flat,
          "yes: flat before the body there, or behind it, clear of all of it, as a front that is cut in one with its "
          "sleeves",
          kOptional);
    visit("both_legs", self.bothLegs,
          "what goes round the trunk and reaches below the crotch goes round both legs, as they stand: auto, yes, no "
          "(auto: yes, but no in a record that does not have it)",
          kOptional);
  }
  bool operator==(const PlacePiece&) const = default;
};

// attach edge=collar.low to="front.neck_left front.neck_right back.neck"
// attach edge=strap.low to=front.top@0.2:0.25 end=strap.top end_to=back.top@0.75:0.8 over=line:shoulder_left@0.5
struct AttachPiece {
  static constexpr std::string_view kName = "attach";
  static constexpr std::string_view kHelp = "Stands a piece with one edge along a run of edges of others.";
  EdgeRef edge;
  std::vector<EdgeRef> to;
  Angle turn;
  bool turned = false;
  Choice clear = Choice::Auto;
  std::optional<BodyPoint> round;
  std::optional<EdgeRef> end;
  std::vector<EdgeRef> endTo;
  std::optional<BodyPoint> over;
  Choice beyond = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge of the piece that is led there", kNeeded);
    visit("to", self.to, "the run of edges it comes along, joined end to end", kNeeded);
    visit("turn", self.turn, "how far it is folded outwards from where the cloth would go on", kOptional);
    visit("turned", self.turned, "yes: turned over, so that its right side shows once it is folded back, as a collar's",
          kOptional);
    visit("clear", self.clear, kClearHelp, kOptional);
    visit("round", self.round, kRoundHelp, kOptional);
    visit("end", self.end, "of a strap: the edge at its other end, which is led over the body to another run",
          kOptional);
    visit("end_to", self.endTo, "the run that the other end comes to", kOptional);
    visit("over", self.over, kOverHelp, kOptional);
    visit(
        "beyond", self.beyond,
        "what lies beyond the ends of that edge goes on straight: auto, yes, no (auto: yes where there is such, but no "
        "in a record that does not have it)",
        kOptional);
  }
  bool operator==(const AttachPiece&) const = default;
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

struct RemovePieces {
  static constexpr std::string_view kName = "remove";
  static constexpr std::string_view kHelp = "Takes pieces away, with their seams and pins.";
  std::vector<PieceRef> pieces;
  Choice seams = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces to take away", kNeeded);
    visit("seams", self.seams,
          "a seam that runs on over pieces that stay is kept there: auto, yes, no (auto: yes, but no in a record that "
          "does not have it)",
          kOptional);
  }
  bool operator==(const RemovePieces&) const = default;
};

using PlacingOperations = OperationList<MovePiece, PlacePiece, AttachPiece, SetLayer, RemovePieces>;

}  // namespace karinui
