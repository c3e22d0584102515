#pragma once
// Patterns as the cutting trade exchanges them: DXF of AAMA and of ASTM D 6673 (docs/format/exchange.md). Pure; any
// thread. Metres here; the file's millimetres or inches are told by the file.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/exchange/sheet.h"

namespace karinui {

struct CadPattern {
  struct Row {  // a piece as the file has it
    std::string name, category, annotation, fabric;
    int quantity = 1;                // how many are cut
    std::vector<std::string> sizes;  // that it is drawn in
  };
  std::string style, author, sampleSize;
  std::vector<std::string> sizes;  // of all pieces, in the file's order
  std::vector<Row> rows;           // every piece once
  std::string size;                // the one that was read
  Pattern pattern;                 // its pieces: flat, at the origin, without seams, which such files do not hold
  std::vector<Message> notes;      // what was guessed or left out, a sentence each
};

// One size of the style, by its name in the file; empty: the sample size, which has the most told of it. Half pieces
// are unfolded on their fold line. Refused: what is no such file, and a size it does not have.
Result<CadPattern> readCadPattern(std::string_view bytes, std::string_view size = {});

enum class DxfDialect { Aama, Astm };
// Every piece whole, as one size called "M": cut line and seam line (the seam line alone without an allowance),
// notches, drill holes, grain, cut-outs, internal lines. Curves have so many points that their chords miss by less than
// 0.05 mm: readers that join points by lines and those that join them by curves then agree.
Result<std::string> writeDxf(const Pattern& pattern, DxfDialect dialect, const SheetSettings& settings = {});

}  // namespace karinui
