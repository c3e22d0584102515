#pragma once
// The same garment in several sizes: graded, and the size chosen that stands.
// Conventions of the structs: field.h.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"
#include "karinui/pattern/grading.h"

namespace karinui {

// grade sizes="S M L XL" base=M
// grade corners="front.hem front.side_left" by=5mm,0        grade corners=front.hem size=XL by=22mm,-3mm
// grade piece=front like=front_large size=L        grade piece=front points="hem 0 -5 0 0 0 5 0 10 0; …"
struct GradePieces {
  static constexpr std::string_view kName = "grade";
  static constexpr std::string_view kHelp =
      "Grades: says which sizes there are, and how far corners of pieces go from the base size to each other one.";
  std::vector<std::string> sizes;
  std::string base;
  std::vector<EdgeRef> corners;
  Flat by;
  std::string size;
  Choice symmetric = Choice::Auto;
  PieceRef piece;
  PieceRef like;
  GradePoints points;
  bool plain = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("sizes", self.sizes, "the names of the sizes, from the smallest to the largest", kOptional);
    visit("base", self.base, "the size the pieces are drawn in (otherwise the one in the middle)", kOptional);
    visit("corners", self.corners, "the corners where these edges start", kOptional);
    visit("by", self.by, "how far they go from each size to the next larger one (across, up)", kOptional);
    visit("size", self.size, "of this size alone; `by` is then how far they go from the base size", kOptional);
    visit("symmetric", self.symmetric, kBothHalvesHelp, kOptional);
    visit("piece", self.piece, "a piece whose grading is given as a whole, by one of the following", kOptional);
    visit("like", self.like, "a piece with as many edges: what `piece` is in `size`, measured corner by corner",
          kOptional);
    visit("points", self.points,
          "its graded places: edge, share of its length (0: the corner it starts at), and for each size how far it "
          "goes, in millimetres: “hem 0 -5 0 0 0 5 0; …”",
          kOptional);
    visit("plain", self.plain, "yes: the piece is the same in all sizes; without a piece: there are no sizes any more",
          kOptional);
  }
  bool operator==(const GradePieces&) const = default;
};

// size name=L
struct ChooseSize {
  static constexpr std::string_view kName = "size";
  static constexpr std::string_view kHelp = "Chooses the size that stands: the graded pieces take its outlines.";
  static constexpr bool kDisturbsDrape = true;
  std::string name;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "one of the sizes", kNeeded);
  }
  bool operator==(const ChooseSize&) const = default;
};

using SizesOperations = OperationList<GradePieces, ChooseSize>;

}  // namespace karinui
