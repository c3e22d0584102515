#pragma once
// Where a piece has room for its lettering and its grain line: the largest lettering that stays clear of every line,
// then the longest grain line that stays clear of the lettering too. Takes milliseconds a piece. Metres on paper. Pure;
// any thread.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/pattern/markings.h"

namespace karinui {

struct LetteredPiece {
  struct Line {  // centred on its place
    Flat place;
    double size = 0.004;  // of the font
    bool upright = true;  // else turned to read from below upwards
  };
  std::vector<Line> lines;           // one for each line of text, the later ones smaller
  std::optional<PaperStroke> grain;  // along the piece's grain; nothing where there is no room for one
};
LetteredPiece roomFor(const Piece& piece, const std::vector<std::string>& lines);

// The width of a line of text, estimated: half-width letters 0.6 of the font's size, all others 1. In the size's unit.
double wordsWidth(std::string_view words, double size);

}  // namespace karinui
