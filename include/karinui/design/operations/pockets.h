#pragma once
// Pockets that are a part of the garment's seams. One that is sewn onto a piece is a patch (paper.h).
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

inline constexpr std::string_view kPocketCopiesHelp =
    "in the garment's other half too: auto, yes, no (auto: if its symmetric copy, or the other half of a symmetric "
    "piece, is sewn there alike)";

// pocket edge=front.side_left length=16cm first=4cm depth=15cm fabric=viscose
// pocket kind=slant edge=leg_front_left.outseam inset=4cm length=17cm
struct SewPocket {
  static constexpr std::string_view kName = "pocket";
  static constexpr std::string_view kHelp =
      "Sews a pocket into a seam: its bags hang within, behind an opening between two places of the seam, or behind "
      "the "
      "slanted line along which a front's corner is cut away.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef edge;
  enum class Kind { Seam, Slant } kind = Kind::Seam;
  std::string name = "pocket";
  std::optional<Length> first;
  std::optional<Length> inset;
  Length length{0.16}, depth{0.15}, below{0.10};
  std::string fabric;
  Choice copies = Choice::Auto;
  // The fields that only some kinds have; a field that is not listed all have.
  static constexpr std::string_view kKindField = "kind";
  static bool has(Kind kind, std::string_view field) {
    if (field == "first") return kind == Kind::Seam;
    return field != "inset" || kind == Kind::Slant;
  }
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge of the piece behind which the bags hang, as the side of a front", kNeeded);
    visit("kind", self.kind, "seam: an opening in the seam; slant: along a line that cuts the upper corner away",
          kOptional);
    visit("name", self.name, "before the names of the bags and of the opening's seam", kOptional);
    visit("first", self.first,
          "of an opening in the seam: how far below the edge's upper end it begins (otherwise 4 cm)", kOptional);
    visit("inset", self.inset,
          "of a slanted one: how far from the corner it begins, along the edge above (otherwise 4 cm)", kOptional);
    visit("length", self.length, "of the opening; of a slanted one: how far down the edge it ends", kOptional);
    visit("depth", self.depth, "how far the bags reach in from the seam", kOptional);
    visit("below", self.below, "how far they hang below the opening's lower end", kOptional);
    visit("fabric", self.fabric, "of the bags (otherwise cotton)", kOptional);
    visit("copies", self.copies, kPocketCopiesHelp, kOptional);
  }
  bool operator==(const SewPocket&) const = default;
};

// welt piece=leg_back_left at=-1cm,-9cm
// welt piece=front_left kind=single at=9cm,40cm turn=8deg length=10.5cm below=12cm
struct SewWelt {
  static constexpr std::string_view kName = "welt";
  static constexpr std::string_view kHelp =
      "Sets a welt pocket into a piece: a slit within a stitched box, which a welt or a pair of narrow ones closes, "
      "and "
      "bags that hang behind it.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece;
  Flat at;
  enum class Kind { Jetted, Single } kind = Kind::Jetted;
  std::string name = "pocket";
  Angle turn;
  std::optional<Length> length, width;
  Length below{0.16};
  std::string fabric;
  Choice copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece it is set into", kNeeded);
    visit("at", self.at, "the place on its paper, where the middle of the slit comes", kNeeded);
    visit("kind", self.kind, "jetted: two narrow welts that meet; single: one that stands up over the slit", kOptional);
    visit("name", self.name, "before the names of the welt, the bags and the lines", kOptional);
    visit("turn", self.turn, "how far the slit is turned from level, counter-clockwise", kOptional);
    visit("length", self.length, "of the opening (otherwise 13.5 cm, of a single welt 10.5 cm)", kOptional);
    visit("width", self.width, "of the box: both welts together 1 cm, a single one 2.2 cm", kOptional);
    visit("below", self.below, "how far the bags hang below the box", kOptional);
    visit("fabric", self.fabric, "of the front bag (otherwise cotton)", kOptional);
    visit("copies", self.copies, "on the symmetric copy too: auto, yes, no (auto: if there is one like it)", kOptional);
  }
  bool operator==(const SewWelt&) const = default;
};

using PocketOperations = OperationList<SewPocket, SewWelt>;

}  // namespace karinui
