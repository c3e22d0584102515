#pragma once
// Seams between runs of edges.
// Conventions of the structs: field.h.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

// sew a=front.side_left b=back.side_left mirror=yes      sew a="front.armhole_l back.armhole_l" b=sleeve.cap
struct SewEdges {
  static constexpr std::string_view kName = "sew";
  static constexpr std::string_view kHelp = "Joins two runs of edges with a seam.";
  std::vector<EdgeRef> a, b;
  std::string name;
  Choice reversed = Choice::Auto;
  enum class Tie { Auto, OneToOne, TwoToOne, Pleat } tie = Tie::Auto;
  bool mirror = false;
  bool replace = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("a", self.a, "edges of one side, joined end to end", kNeeded);
    visit("b", self.b, "edges of the other side", kNeeded);
    visit("name", self.name, "the seam's name", kOptional);
    visit("reversed", self.reversed, "side b runs against its own direction: auto, yes, no (auto: as the edges lie)",
          kOptional);
    visit("tie", self.tie,
          "auto, 1:1, 2:1 (two points of the longer side on one of the shorter), or pleat (b lies folded in under a)",
          kOptional);
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

// patch piece=pocket on=skirt at="8cm,45cm" open=top
struct SewPatch {
  static constexpr std::string_view kName = "patch";
  static constexpr std::string_view kHelp =
      "Sews a piece onto another, as a patch pocket: draws the placement lines there, and lays the piece over them.";
  static constexpr bool kDisturbsDrape = true;
  PieceRef piece, on;
  Flat at;
  Angle turn;
  std::vector<std::string> open;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece that is sewn on", kNeeded);
    visit("on", self.on, "the piece it is sewn to", kNeeded);
    visit("at", self.at, "the place on the paper of that, where the middle of the sewn piece comes", kNeeded);
    visit("turn", self.turn, "how far the paper of the sewn piece is turned there", kOptional);
    visit("open", self.open, "its edges that are not sewn", kOptional);
  }
  bool operator==(const SewPatch&) const = default;
};

using SewingOperations = OperationList<SewEdges, Unsew, FlipSeam, SewPatch>;

}  // namespace karinui
