#pragma once
// Buttons, snaps, hooks, ties and zips: set, opened, closed.
// Conventions of the structs: field.h.
#include <optional>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"
#include "karinui/pattern/fastening.h"

namespace karinui {

// fasten name=front a=right.centre b=left.centre count=6 first=1.5cm last=10cm size=11mm
// fasten kind=zip a=back_left.centre b=back_right.centre length=20cm   a seam there is opened along the zip
// fasten name=front closed=4        fasten name=front none=yes
struct Fasten {
  static constexpr std::string_view kName = "fasten";
  static constexpr std::string_view kHelp =
      "Sets buttons, snaps, hooks, ties or a zip along two runs of edges; closes and opens them.";
  static constexpr bool kDisturbsDrape = true;
  std::string name;
  std::optional<FasteningKind> kind;
  std::vector<EdgeRef> a, b;
  Choice reversed = Choice::Auto;
  enum class From { Auto, Top, Bottom, Start, End } from = From::Auto;
  std::optional<int> count;
  std::optional<Length> spacing, first, last, inset, size, length, gap;
  enum class Holes { Across, Along } holes = Holes::Across;
  std::optional<int> closed;
  std::optional<Length> closedLength;
  bool none = false;
  Choice unpick = Choice::Auto;
  Choice copies = Choice::Auto;
  std::optional<Length> stand;
  // The fields that only some kinds have; a field that is not listed all have.
  static constexpr std::string_view kKindField = "kind";
  static bool has(FasteningKind kind, std::string_view field) {
    const FasteningTraits& traits = traitsOf(kind);
    if (field == "count" || field == "spacing" || field == "last" || field == "inset" || field == "closed")
      return traits.counted;
    if (field == "length" || field == "closed_length") return !traits.counted;
    if (field == "unpick") return !traits.counted || traits.sized;
    if (field == "size" || field == "stand") return traits.sized;
    if (field == "holes") return traits.holed;
    return field != "gap" || traits.gapped;
  }
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "its name; of one that is there, to close, open or take it out", kOptional);
    visit("kind", self.kind, "button, snap, hook, tie or zip (otherwise button)", kOptional);
    visit("a", self.a, "the edges or inner lines that lie over, with the buttonholes, joined end to end", kOptional);
    visit("b", self.b, "those that lie under", kOptional);
    visit("reversed", self.reversed, "side b runs against its own direction: auto, yes, no (auto: as the edges lie)",
          kOptional);
    visit("from", self.from,
          "the end of side a where counting begins and a zip opens: auto, top, bottom (on the paper), start, end "
          "(auto: top)",
          kOptional);
    visit("count", self.count, "how many (otherwise about 8 cm apart)", kOptional);
    visit("spacing", self.spacing, "from one to the next (otherwise evenly from first to last)", kOptional);
    visit("first", self.first, "from the end where counting begins to the first, or to the zip's open end", kOptional);
    visit("last", self.last, "from the last to the other end", kOptional);
    visit("inset", self.inset,
          "from the edges into the pieces (otherwise half of what the ends of a band lap; without a lap 1.5 cm for "
          "buttons "
          "and snaps, 0 for others and on inner lines)",
          kOptional);
    visit("size", self.size, "diameter of a button or snap (otherwise 11 mm)", kOptional);
    visit("length", self.length, "of a zip (otherwise to the end of the edges)", kOptional);
    visit("gap", self.gap, "how far apart a tie holds its places", kOptional);
    visit("holes", self.holes, "buttonholes lie across the edge, or along it", kOptional);
    visit("closed", self.closed, "how many are closed, from where counting begins (otherwise all)", kOptional);
    visit("closed_length", self.closedLength, "how far a zip is closed, from its lower end (otherwise all)", kOptional);
    visit("none", self.none, "yes: takes it out", kOptional);
    visit("unpick", self.unpick,
          "of what is new: a seam between its two sides is opened where a zip comes, and stays sewn beside it; for "
          "buttons and snaps with a stand all along, and what is sewn on above: auto, yes, no (auto: if there is one)",
          kOptional);
    visit("copies", self.copies,
          "of one that is new: between the symmetric copies of its pieces too: auto, yes, no (auto: if both sides have "
          "one, and there is room)",
          kOptional);
    visit("stand", self.stand,
          "of buttons and snaps that are new: both edges are let out by so much first, and what is sewn on above with "
          "them, so that they lap; the places lie where the edges were",
          kOptional);
  }
  bool operator==(const Fasten&) const = default;
};

// fly a=leg_front_left.crotch b=leg_front_right.crotch length=15cm
struct SewFly {
  static constexpr std::string_view kName = "fly";
  static constexpr std::string_view kHelp =
      "Sews a fly: a zip between two edges, a facing under the one that lies over, stitched on in a J, and a shield "
      "behind the zip on the other.";
  static constexpr bool kDisturbsDrape = true;
  EdgeRef a, b;
  std::string name = "fly";
  Length length{0.15}, width{0.035};
  std::string fabric;
  bool shield = true;
  int rows = 2;
  std::optional<Dye> colour;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("a", self.a, "the edge that lies over, from the waist down: it is faced, and stitched", kNeeded);
    visit("b", self.b, "the edge that lies under: it gets the shield", kNeeded);
    visit("name", self.name, "of the zip; before the names of facing, shield and stitched line", kOptional);
    visit("length", self.length, "of the zip, from the waist down", kOptional);
    visit("width", self.width, "from the edge to where the facing is stitched on", kOptional);
    visit("fabric", self.fabric, "of facing and shield (otherwise what their piece is cut from)", kOptional);
    visit("shield", self.shield, "no: without a shield", kOptional);
    visit("rows", self.rows, "of stitches along the J; 0: none to be seen", kOptional);
    visit("colour", self.colour, "of the thread; nothing said: a shade of the cloth's own", kOptional);
  }
  bool operator==(const SewFly&) const = default;
};

using FasteningOperations = OperationList<Fasten, SewFly>;

}  // namespace karinui
