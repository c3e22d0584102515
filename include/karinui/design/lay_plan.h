#pragma once
// The lay plan: how the pieces of a garment lie on the cloth they are cut from, by their cut lines and along the grain,
// and how much cloth that takes. One plan for each fabric. Derived; it changes nothing of the document. On the cloth
// `u` runs along the selvedges and `v` across, from one selvedge (or the fold) to the other. Metres.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/apply.h"
#include "karinui/geometry/nest.h"

namespace karinui {

struct LaySettings {
  double width = 1.5;               // of the cloth between its selvedges, laid open
  bool folded = false;              // lengthwise, right sides together: every cut gives two pieces, one turned over
  double gap = 0.005;               // between cut lines
  bool nap = false;                 // all pieces lie the same way up: nap, or a print with a direction
  double stripes = 0;               // repeat across the cloth, of stripes along it; 0: none
  double rows = 0;                  // repeat along the cloth, of stripes across it; 0: none
  std::optional<double> allowance;  // of seams, in place of the garment's own; 0: cut on the seam lines
  std::string fabric;               // only this one; empty: all
  int tries = 4000;                 // of the search, for each fabric
  std::uint64_t seed = 1;
};

struct LaidPiece {
  PieceId piece;
  PieceId under = {};    // its mirror image, cut with it from the lower layer; none: the same piece, or nothing
  std::size_t copy = 0;  // of the piece, from 0
  bool over = false;     // turned over: the mirror image of its paper
  bool turned = false;   // half round: its grain line points the other way
  bool onFold = false;   // it lies on the fold and is cut whole from both layers
  bool half = false;     // its paper is whole: only half of it lies here, its middle on the fold
  int layers = 1;        // of cloth that give a piece each
  Flat grain{0, 1};      // of its paper
  Flat at;               // where the paper's (0, 0) lies
  Flat reference;        // of its paper: lies on a multiple of the stripes' repeats

  Flat operator()(Flat paper) const;
  // The same, of a step instead of a place.
  Flat step(Flat paper) const;
};

struct FabricLay {
  std::string fabric;
  double width = 1.5;  // as it lies: half the cloth's where it is folded
  double length = 0;   // of the cloth
  double area = 0;     // of what is cut from it, m2
  double use = 0;      // share of the cloth
  std::vector<LaidPiece> pieces;
  std::vector<Ring> cut;  // of each, its cut line where it lies
};

struct LayPlan {
  LaySettings settings;
  Document document;  // that is laid: with whole pieces for halves where the cloth is not folded
  std::vector<FabricLay> fabrics;
  std::vector<Message> notes;
};

// Takes seconds; asks the context's token and tells it how far the search is. Refused: a piece that the cloth is too
// narrow for, settings out of bounds.
Result<LayPlan> layPlan(const Document& document, const LaySettings& settings, Context& context);

// Two pieces that overlap (by more than a hundredth of a millimetre), or one that leaves the cloth; nothing: none.
struct LayClash {
  std::size_t first = 0;
  std::optional<std::size_t> second;  // nothing: the first leaves the cloth
};
std::optional<LayClash> clash(const FabricLay& lay);
std::optional<LayClash> clash(const FabricLay& lay, std::size_t nth);  // of this piece, which is `first`

// By hand: the piece is carried, on the fold only along it, and over stripes by whole repeats. It may clash then.
void moveLaid(FabricLay& lay, std::size_t nth, Flat by, const LaySettings& settings);
// Half round about its middle; over stripes to the nearest place where they lie as before; on the fold it is turned
// over too. Refused: cloth with nap.
Done turnLaid(FabricLay& lay, std::size_t nth, const LaySettings& settings);

// Length, area and use made anew after pieces were moved by hand.
void measureLay(FabricLay& lay, bool folded);

}  // namespace karinui
