#pragma once
// What pockets of all kinds have: their edges on both halves, and pieces and seams with ids counted on.
#include <string>
#include <vector>

#include "design/operations/pocket_bag.h"

namespace karinui {

inline constexpr double kBagBeyond = 0.015;     // metres of the edge that the bag has beyond the opening,
inline constexpr double kToNextCorner = 0.005;  // and that it leaves of the edge above

// The same edge of the symmetric copy, or on the other half of a symmetric piece.
std::optional<EdgeRef> edgeOnOtherHalf(const Document& document, const EdgeRef& edge);
// Those the pocket is sewn behind.
std::vector<EdgeRef> pocketEdges(const Document& document, const SewPocket& op);

// Refused where a pocket that is there has a part of the edge between these places, in metres from its upper end down;
// says which, and where there is room.
Done checkFree(const Document& document, const DownEdge& side, double from, double to);

// How slanted pockets are refused and made; slanted_pocket.cpp.
Done checkSlanted(const Document& document, const SewPocket& op, const EdgeRef& edge);
Result<Document> withSlanted(const Document& before, const SewPocket& op, Context& context);

class PocketPieces {
 public:
  PocketPieces(const Document& before, const SewPocket& op, Document now);

  Document after;

  // Room for the bags in two layers beneath these pieces.
  Done room(const std::vector<PieceId>& outers);
  // What the next piece is called: `first` of both halves, else as the copy of that.
  std::string nameOf(const char* what, bool first) const;
  PieceId pieceId();
  // Cut from the bags' cloth, so far beneath `outer`, whose paper it is a part of.
  Result<PieceId> addBag(const DividedPart& paper, std::vector<Mark> marks, const Piece& outer, int under,
                         std::string name);
  Result<std::shared_ptr<const Form>> beneath(const Piece& piece, const Piece& outer,
                                              const std::function<double(Flat)>& apart) const;
  SeamId seamId();
  void sew(std::vector<EdgeSpan> a, std::vector<EdgeSpan> b, Seam::Tie tie, bool reversed,
           const std::string& name = {});
  // What the seam of the opening is called.
  std::string openingName(bool first) const;
  std::uint32_t& freeSeams();  // the number of the next seam that is free, to be counted on

 private:
  const Document& before_;
  const SewPocket& op_;
  std::uint32_t pieces_ = 0, seams_ = 0;
};

}  // namespace karinui
