#pragma once
// The flat pattern of a garment as it lies on the cutting table, ready to be drawn. Pure; any thread.
#include <map>

#include "karinui/pattern/label_room.h"
#include "karinui/scene/table_frame.h"
#include "karinui/session/gesture.h"

namespace karinui {

struct TableFrameOptions {
  Language language = Language::English;     // the lettering is placed for its words in this language
  bool corners = false;                      // a tool moves them
  bool nest = false;                         // graded pieces in all their sizes, over one another
  bool scans = true;                         // what is traced lies under the pattern
  std::map<PieceId, Outline> outlines = {};  // shown instead of the document's, as Preview::outlines
  Underlays underlays = {};                  // likewise
};

// Where pieces have room for their lettering, and what their other sizes are, takes milliseconds a piece: kept from one
// frame to the next for the pieces whose paper is the same. One thread at a time.
class LetteringRooms {
 public:
  const LetteredPiece& of(const Piece& piece, const std::vector<std::string>& words);  // its label, line by line
  // What is said beside its edges and lines, given what is written there already.
  const std::vector<LetteredPiece::Line>& ofNotes(const Piece& piece, const std::vector<WishedNote>& notes,
                                                  const std::vector<std::string>& words, const LetteredPiece& lettered,
                                                  const std::vector<Flat>& tags);
  // The outline in every size, of those that are outlines; where the paper lies at its origin.
  const std::vector<TableSize>& nestOf(const Piece& piece, const Grading& grading);

 private:
  struct Nested {
    Outline outline;
    GradePoints points;
    std::vector<std::string> sizes;
    std::size_t standing = 0;
    std::vector<TableSize> nest;
  };
  std::map<PieceId, Nested> nested_;
  struct Kept {
    Outline outline;
    std::vector<Outline> holes;
    std::vector<InternalLine> lines;
    Flat grain;
    std::vector<std::string> words;
    LetteredPiece room;
  };
  std::map<PieceId, Kept> kept_;
  struct Noted {
    Outline outline;
    std::vector<Outline> holes;
    std::vector<InternalLine> lines;
    std::vector<WishedNote> notes;
    std::vector<std::string> words;
    std::vector<LetteredPiece::Line> lettered;
    std::vector<Flat> tags;
    std::vector<LetteredPiece::Line> places;
  };
  std::map<PieceId, Noted> noted_;
};

// `rooms` (null: nothing is kept) belongs to the caller. While a drag shows another outline, lettering and grain line
// stay where they were.
TableFrame tableFrameOf(const GarmentSnapshot& snapshot, const TableLayout& layout, const Selection& chosen = {},
                        const TableFrameOptions& options = {}, LetteringRooms* rooms = nullptr);

}  // namespace karinui
