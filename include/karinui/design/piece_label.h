#pragma once
// What is written on a piece of paper, on the printed sheet and on the cutting table. Pure; any thread.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

// What is known of a piece beside its name and fabric.
struct CutFacts {
  Cutting cutting;
  bool onFold = false, faceDown = false;
  Message size;      // as sizeSaid() has it; nothing: not told
  std::string date;  // of the print; nothing: not told
  std::string twin;  // the name of what is cut by the same drawing, turned over; nothing: there is none
};
// Whether every measure of the figure is that of the built-in size it starts from.
bool ofItsSize(const BodyChoice& body);
// What size the paper is of: the style's that stands, else the figure's. Nothing: neither has one.
Message sizeSaid(const Document& document);
// Pieces whose paper lies face down on the right side of the cloth: those that are worn with it inwards, where that
// makes a difference to what is cut: neither symmetric, nor on the fold, nor in pairs.
std::set<PieceId> cutFaceDown(const Pattern& pattern, const AllowancePlan& plan,
                              const std::map<PieceId, Cutting>& cutting);
// Line by line: its name, then what to cut, then size and date where they are told.
std::vector<Message> labelOf(const Piece& piece, const CutFacts& facts = {});

}  // namespace karinui
