#pragma once
// Where what is sewn along edges comes to lie: rows of topstitching, cords, bindings; and the strips that are cut for
// them. Metres on paper. Pure; any thread.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "karinui/pattern/allowance.h"

namespace karinui {

struct StitchRow {
  PieceId piece;
  std::vector<Flat> points;
  Topstitch topstitch;
};
// Rows end at the outline; where the edge beside is stitched likewise they meet there.
std::vector<StitchRow> stitchRows(const Pattern& pattern, const Allowances& finish);

// The parallel of an edge, so deep inside the piece, from outline to outline. Nothing: there is no room for it.
std::optional<Curve> parallelInside(const Piece& piece, const std::string& edge, double deep);

// A strip beside an edge: pairs of places, on the edge and inside it. Where two meet at a corner they are mitred.
struct TrimRun {
  PieceId piece;
  std::string edge;
  std::vector<Flat> edgewise, inside;
};
TrimRun runOf(const Piece& piece, const std::string& edge, const Binding& binding, const Allowances& finish);
TrimRun runOf(const Piece& piece, const std::string& edge, const Piping& piping);  // inside: which way the cloth lies
// All pipings and bindings as they are drawn on paper: inside as deep as the cord is thick, or the binding is seen.
std::vector<TrimRun> trimRuns(const Pattern& pattern, const Allowances& finish);

// A strip cut on the bias, for bindings and round cords of one fabric and width, all edges together. It is cut in
// `count` lengths, whose ends lie along the grain and are joined there.
struct BiasStrip {
  std::string fabric;
  double width = 0, length = 0;  // of the strip, as it is sewn on
  int count = 1;
  double cutLength = 0;  // of each, the joins included
};
// `times`: how often pieces are cut whose paper does not say it; missing: once.
using TimesCut = std::map<PieceId, int>;
std::vector<BiasStrip> biasStrips(const Pattern& pattern, const Allowances& finish, const TimesCut& times = {});
// One length of it as a piece of paper. Its id and name are no document's.
std::shared_ptr<const Piece> stripPiece(const BiasStrip& strip, std::size_t number);

}  // namespace karinui
