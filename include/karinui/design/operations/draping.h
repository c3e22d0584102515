#pragma once
// The cloth: draped, pulled, pinned, frozen.
// Conventions of the structs: field.h.
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

// drape        drape live=sleeve        drape stop=120
struct DrapePieces {
  static constexpr std::string_view kName = "drape";
  static constexpr std::string_view kHelp = "Brings the cloth to rest on the body.";
  std::vector<PieceRef> live;
  Vec3 gravity{0, -9.81, 0};
  int stop = 0;
  bool finer = false, insideLast = false, dressed = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("live", self.live, "the pieces that move (otherwise every piece that is not frozen)", kOptional);
    visit("gravity", self.gravity, "metres per second squared (x,y,z)", kOptional);
    visit("stop", self.stop, "after how many of the solver's steps to stop where the cloth is (0: at rest)", kOptional);
    visit(
        "finer", self.finer,
        "yes: without the widest of the cells the cloth is sewn up in; recorded where those had sewn it up with a limb "
        "through it",
        kOptional);
    visit("inside_last", self.insideLast,
          "yes: facings and linings are laid in when the rest hangs; recorded where that was so, as the first time a "
          "garment is draped",
          kOptional);
    visit(
        "dressed", self.dressed,
        "yes: garments are put on one after another, the lowest layer first; recorded where that was so, as the first "
        "time several are draped",
        kOptional);
  }
  bool operator==(const DrapePieces&) const = default;
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
    visit("live", self.live, "the pieces that drape (otherwise the pulled one and those it hangs together with)",
          kOptional);
  }
  bool operator==(const PullCloth&) const = default;
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

using DrapingOperations = OperationList<DrapePieces, PullCloth, PinCloth, UnpinCloth, FreezePieces>;

}  // namespace karinui
