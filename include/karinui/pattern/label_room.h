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
    bool operator==(const Line&) const = default;
  };
  std::vector<Line> lines;           // one for each line of text, the later ones smaller
  std::optional<PaperStroke> grain;  // along the piece's grain; nothing where there is no room for one
};
LetteredPiece roomFor(const Piece& piece, const std::vector<std::string>& lines);

// Words beside an edge or a line of a piece: where they are wished if they are clear there of the border, of lines and
// of what else is written; else as near to it as they are so, turned or ever smaller. Where the piece has no such room
// they lie over what else is written, but within the piece if that is possible at all.
struct WishedNote {
  std::string words;
  LetteredPiece::Line at;
  bool operator==(const WishedNote&) const = default;
};
inline constexpr double kLeastNote = 0.002;  // metres, of the font
// `lines` and `lettered`: what roomFor() was given and found; `tags`: the middles of the seams' numbers.
std::vector<LetteredPiece::Line> roomForNotes(const Piece& piece, const std::vector<WishedNote>& notes,
                                              const std::vector<std::string>& lines, const LetteredPiece& lettered,
                                              const std::vector<Flat>& tags);

// The width of a line of text, estimated: half-width letters 0.6 of the font's size, all others 1. In the size's unit.
double wordsWidth(std::string_view words, double size);

}  // namespace karinui
