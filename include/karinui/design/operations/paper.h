#pragma once
// New pieces drawn on paper: rectangle, polygon, ring, and band along a run of edges.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

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
    visitCloth(self, visit);
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
    visitCloth(self, visit);
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
    visitCloth(self, visit);
  }
  bool operator==(const DrawRing&) const = default;
};

// band name=collar of="front.neck_left front.neck_right back.neck" depth=4cm sew=yes
// `eased` is settled where the band is sewn and longer or shorter than its run. Left open, which it is only in
// documents of before it, nothing is declared.
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
  bool turned = false;
  Choice eased = Choice::Auto;
  std::vector<std::string> edges;
  std::string fabric;
  int layer = 0;
  Choice clear = Choice::Auto;
  std::optional<BodyPoint> round;
  std::string wrap;
  Choice joined = Choice::Auto;
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
    visit("turned", self.turned, "yes: turned over, so that its right side shows once it is folded back, as a collar's",
          kOptional);
    visit("clear", self.clear, kClearHelp, kOptional);
    visit("round", self.round, kRoundHelp, kOptional);
    visit("eased", self.eased,
          "the difference that ratio= makes is meant, as ease declares it: auto, yes, no (auto: yes)", kOptional);
    visit("edges", self.edges, "names of its edges: low end_left top end_right; the first is sewn", kOptional);
    visit("wrap", self.wrap, kWrapHelp, kOptional);
    visit("joined", self.joined,
          "along edges that close a ring its ends are sewn to each other: auto, yes, no (auto: no where the garment "
          "opens there, as at a zip or a fly; but yes in a record that does not have it)",
          kOptional);
    visitCloth(self, visit);
  }
  bool operator==(const DrawBand&) const = default;
};

// strap name=strap_left from=front.top@0.1:0.3 to=back.top@0.7:0.9 width=2cm
// `over` is settled where it is left open.
struct DrawStrap {
  static constexpr std::string_view kName = "strap";
  static constexpr std::string_view kHelp =
      "Draws a strap as long as the way over the body from one edge to another, stands it there and sews its ends.";
  std::string name;
  EdgeRef from, to;
  std::optional<BodyPoint> over;
  std::optional<Length> width, length;
  Length ease;
  std::vector<std::string> edges;
  std::string fabric;
  int layer = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the new piece's name", kNeeded);
    visit("from", self.from, "the part of an edge or inner line where it begins", kNeeded);
    visit("to", self.to, "the part where it ends", kNeeded);
    visit("over", self.over, kOverHelp, kOptional);
    visit("width", self.width, "how wide it is, about the middle of each part (otherwise as wide as the parts are)",
          kOptional);
    visit("length", self.length, "its length between the seams (otherwise measured over the body)", kOptional);
    visit("ease", self.ease, "added to the length that is measured; below nothing it is tighter", kOptional);
    visit("edges", self.edges, "names of its edges: low side_right top side_left; low and top are sewn", kOptional);
    visitCloth(self, visit);
  }
  bool operator==(const DrawStrap&) const = default;
};

using PaperOperations = OperationList<DrawRectangle, DrawPolygon, DrawRing, DrawBand, DrawStrap>;

}  // namespace karinui
