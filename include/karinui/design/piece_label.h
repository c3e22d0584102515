#pragma once
// What is written on a piece of paper, on the printed sheet and on the cutting table. Pure; any thread.
#include <string>
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

// What is known of a piece beside its name and fabric.
struct CutFacts {
  Cutting cutting;
  bool onFold = false;
  std::string size, date;  // of the figure, of the print; nothing: not told
};
// Line by line: its name, then what to cut, then size and date where they are told.
std::vector<Message> labelOf(const Piece& piece, const CutFacts& facts = {});

}  // namespace karinui
