#pragma once
// What is written on a piece of paper, on the printed sheet and on the cutting table. Pure; any thread.
#include <vector>

#include "karinui/base/message.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// Line by line: its name, then what to cut.
std::vector<Message> labelOf(const Piece& piece);

}  // namespace karinui
