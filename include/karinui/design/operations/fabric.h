#pragma once
// What pieces are cut from: how it drapes and how it looks.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/cloth/fabric.h"
#include "karinui/design/look.h"
#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

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
  std::optional<Dye> wrong, wrongInk;
  std::optional<PrintKind> wrongPrint;
  std::optional<Flat> shift;
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
    visit("wrong", self.wrong, "colour of its wrong side, where that is another one", kOptional);
    visit("wrong_print", self.wrongPrint, "print of its wrong side: none, stripe, check, dot, photo", kOptional);
    visit("wrong_ink", self.wrongInk, "colour of the stripes, checks and dots there", kOptional);
    visit("shift", self.shift, "of pieces: where the print begins on their paper, across and along the grain",
          kOptional);
  }
  bool operator==(const SetLook&) const = default;
};

// match seam=side        match seam=side at=0.3 piece=back
struct MatchPrint {
  static constexpr std::string_view kName = "match";
  static constexpr std::string_view kHelp = "Places a piece on its print so that stripes and checks meet in a seam.";
  SeamRef seam;
  double at = 0;
  PieceRef piece;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("seam", self.seam, "the seam", kNeeded);
    visit("at", self.at, "where they meet: a share of the seam's length, 0 at its start", kOptional);
    visit("piece", self.piece, "the piece whose print moves (otherwise that of the second side)", kOptional);
  }
  bool operator==(const MatchPrint&) const = default;
};

// interface piece="collar stand" fabric=interfacing: the two are one cloth from then on (fused() in cloth/fabric.h).
struct FuseInterfacing {
  static constexpr std::string_view kName = "interface";
  static constexpr std::string_view kHelp = "Fuses an interfacing to pieces: they become heavier, thicker and stiffer.";
  static constexpr bool kDisturbsDrape = true;
  std::vector<PieceRef> pieces;
  std::string fabric;
  bool none = false;
  Choice copies = Choice::Auto;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("piece", self.pieces, "the pieces", kNeeded);
    visit("fabric", self.fabric, "what is fused to them, on the same grain (otherwise interfacing)", kOptional);
    visit("none", self.none, "yes: takes it off", kOptional);
    visit("copies", self.copies, kCopiesHelp, kOptional);
  }
  bool operator==(const FuseInterfacing&) const = default;
};

using FabricOperations = OperationList<SetFabric, SetLook, MatchPrint, FuseInterfacing>;

}  // namespace karinui
