#pragma once
// What is drawn inside a piece or at its edge: grain line, notches, drill holes, internal lines. Names.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

inline constexpr std::string_view kPartnersHelp =
    "of a notch: where it meets the edges this one is sewn to, too: auto, yes, no (auto: yes, but no in a record that "
    "does not have it)";
inline constexpr std::string_view kOverZipsHelp =
    "of a notch: what it meets over a zip has it too: auto, yes, no (auto: yes, but no in a record that does not have "
    "it)";

struct SetGrain {
  static constexpr std::string_view kName = "grain";
  static constexpr std::string_view kHelp = "Turns the grain line of pieces.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<PieceRef> pieces;
  Flat to{0, 1};
  Choice copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces", kNeeded);
    visit("to", self.to, "the warp's direction on paper (u,v)", kNeeded);
    visit("copies", self.copies, kCopiesHelp, kOptional);
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
  Choice copies = Choice::Auto, partners = Choice::Auto, zips = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("edge", self.edge, "the edge to notch", kOptional);
    visit("at", self.at, "how far along it, as a share of its length", kOptional);
    visit("piece", self.piece, "for a drill hole: the piece", kOptional);
    visit("point", self.point, "for a drill hole: the place on its paper", kOptional);
    visit("name", self.name, "the mark's name", kOptional);
    visit("symmetric", self.symmetric, "yes: on the other half of a symmetric piece too", kOptional);
    visit("copies", self.copies, kCopiesHelp, kOptional);
    visit("partners", self.partners, kPartnersHelp, kOptional);
    visit("zips", self.zips, kOverZipsHelp, kOptional);
  }
  bool operator==(const AddNotch&) const = default;
};

// line piece=front along="5cm,10cm; 9cm,10cm" name=pocket        line piece=front_left along=… copies=no
struct AddLine {
  static constexpr std::string_view kName = "line";
  static constexpr std::string_view kHelp = "Draws a line inside a piece: a fold, a pocket, a place to sew to.";
  PieceRef piece;
  std::vector<Flat> along;
  bool smooth = false;
  std::string name;
  Choice copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("along", self.along, "places on its paper", kNeeded);
    visit("smooth", self.smooth, "yes: a curve through the places instead of straight lines", kOptional);
    visit("name", self.name, "the line's name", kOptional);
    visit("copies", self.copies, kCopiesHelp, kOptional);
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
  Choice copies = Choice::Auto, partners = Choice::Auto, zips = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece", kNeeded);
    visit("name", self.names, "the names of what goes", kOptional);
    visit("at", self.at, "or a place on its paper: the nearest within 1 cm goes", kOptional);
    visit("copies", self.copies, kCopiesHelp, kOptional);
    visit("partners", self.partners, kPartnersHelp, kOptional);
    visit("zips", self.zips, kOverZipsHelp, kOptional);
  }
  bool operator==(const EraseMarks&) const = default;
};

// rename piece=p1 to=front        rename edge=front.e3 to=hem        rename seam=s5 to=side
struct Rename {
  static constexpr std::string_view kName = "rename";
  static constexpr std::string_view kHelp = "Gives a piece, an edge or a seam another name.";
  PieceRef piece;
  std::optional<EdgeRef> edge;
  SeamRef seam;
  std::string to;
  Choice copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.piece, "the piece to rename", kOptional);
    visit("edge", self.edge, "or the edge", kOptional);
    visit("seam", self.seam, "or the seam", kOptional);
    visit("to", self.to, "the new name", kNeeded);
    visit("copies", self.copies, "of an edge: on the symmetric copy too, left and right exchanged: auto, yes, no",
          kOptional);
  }
  bool operator==(const Rename&) const = default;
};

using MarksOperations = OperationList<SetGrain, AddNotch, AddLine, EraseMarks, Rename>;

}  // namespace karinui
