#pragma once
// Topstitching, piping and bindings.
#include <optional>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

// topstitch edges="front.hem back.hem" offset=25mm rows=2        topstitch edges=fly.curve rows=2 colour=c08040
struct SewTopstitch {
  static constexpr std::string_view kName = "topstitch";
  static constexpr std::string_view kHelp = "Sews rows of stitches to be seen along edges or inner lines.";
  std::vector<EdgeRef> edges;
  std::optional<Length> offset;
  std::optional<int> rows;
  std::optional<Length> apart;
  std::optional<Length> length;
  std::optional<Dye> colour;
  bool none = false;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges or inner lines", kNeeded);
    visit("offset", self.offset,
          "from the edge to the first row (first: 6 mm); along an inner line the rows lie evenly to both sides",
          kOptional);
    visit("rows", self.rows, "how many rows (first: 1)", kOptional);
    visit("apart", self.apart, "from row to row (first: 6 mm)", kOptional);
    visit("length", self.length, "of a stitch (first: 3 mm)", kOptional);
    visit("colour", self.colour, "of the thread; nothing said: a shade of the cloth's own", kOptional);
    visit("none", self.none, "yes: takes the stitches out", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const SewTopstitch&) const = default;
};

// piping edges="front.neck back.neck" thickness=4mm fabric=silk        piping edges=front.neck none=yes
struct SewPiping {
  static constexpr std::string_view kName = "piping";
  static constexpr std::string_view kHelp = "Catches a cord in a strip of cloth in along edges, free or sewn.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  std::optional<Length> thickness;
  std::string fabric;
  bool none = false;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges", kNeeded);
    visit("thickness", self.thickness, "of the cord (first: 4 mm)", kOptional);
    visit("fabric", self.fabric, "of the strip round the cord; nothing said: the piece's own", kOptional);
    visit("none", self.none, "yes: takes the piping out", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const SewPiping&) const = default;
};

// binding edges="front.neck back.neck" width=8mm fabric=silk        binding edges=front.neck none=yes
struct BindEdges {
  static constexpr std::string_view kName = "binding";
  static constexpr std::string_view kHelp =
      "Finishes free edges by a strip folded over them; they are cut without an allowance.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<EdgeRef> edges;
  std::optional<Length> width;
  std::string fabric;
  bool none = false;
  Choice symmetric = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edges", self.edges, "the edges", kNeeded);
    visit("width", self.width, "how much of the strip is seen on either side (first: 8 mm)", kOptional);
    visit("fabric", self.fabric, "of the strip; nothing said: the piece's own", kOptional);
    visit("none", self.none, "yes: takes the strip off; the edges' seam allowance is as usual again", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
  }
  bool operator==(const BindEdges&) const = default;
};

using TrimmingOperations = OperationList<SewTopstitch, SewPiping, BindEdges>;

}  // namespace karinui
