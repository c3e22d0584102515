#pragma once
// Patterns as the cutting trade exchanges them: DXF of AAMA and of ASTM D 6673 (docs/format/exchange.md). Pure; any
// thread. Metres here; the file's millimetres or inches are told by the file.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/steps_of.h"
#include "karinui/exchange/sheet.h"

namespace karinui {

struct CadPattern {
  struct Row {  // a piece as the file has it
    std::string name, category, annotation, fabric;
    int quantity = 1;                // how many are cut
    bool pairs = false;              // told as right and left ones
    std::vector<std::string> sizes;  // that it is drawn in
  };
  std::string style, author, sampleSize;
  std::vector<std::string> sizes;  // of all pieces, in the file's order
  std::vector<Row> rows;           // every piece once
  std::string size;                // the one that was read
  Pattern pattern;                 // its pieces: flat, at the origin, without seams, which such files do not hold
  Grading grading;                 // what the other sizes differ by, where there are any; the size read is the base
  std::map<std::string, Fabric> fabrics;  // whose values the file tells, by name
  CuttingNotes cutting;  // how often pieces are cut, where the file tells; seam allowances of pattern JSON
  struct RulePlace {     // a grade rule is named at a point of the file
    PieceId piece;
    std::string edge;
    double at = 0;
    std::size_t rule = 0;
    std::optional<Flat> fold;  // of a half's image: along the fold, about which the rule is mirrored
  };
  std::vector<RulePlace> rules;
  double guessedUnit = 0;      // metres; 0: the file tells its unit, or somebody said it
  std::vector<Message> notes;  // what was guessed or left out, a sentence each
};

// One size of the style, by its name in the file; empty: the sample size, which has the most told of it; and what the
// others differ from it by. Half pieces are unfolded on their fold line. Refused: what is no such file, and a size it
// does not have. `unit`: metres of a unit of the file, whatever it tells itself; 0: as it tells.
Result<CadPattern> readCadPattern(std::string_view bytes, std::string_view size = {}, double unit = 0);

enum class DxfDialect { Aama, Astm };
// Every piece whole, in every size of the grading (settings), each a block of its own; the base size's points name
// their grade rules. A pattern that is not graded has one size, "M". Cut line and seam line (the seam line alone
// without an allowance), notches, drill holes, grain, cut-outs, internal lines. Curves have so many points that their
// chords miss by less than 0.05 mm: readers that join points by lines and those that join them by curves then agree.
Result<std::string> writeDxf(const Pattern& pattern, DxfDialect dialect, const SheetSettings& settings = {});

// Grade rules (RUL), which stand beside a DXF file of one size: how far the points that name them go in each size.
struct GradeRules {
  std::vector<std::string> sizes;
  std::size_t base = 0;                            // the sample size
  std::map<std::size_t, std::vector<Flat>> rules;  // metres, for each size
};
// `steps`: the file says how far a point goes from each size to the next, away from the sample size, not from the
// sample size itself: makers differ in this and their files do not tell.
Result<GradeRules> readGradeRules(std::string_view bytes, bool steps = false);
// The rules of a graded pattern, numbered as writeDxf() numbers them. Refused: one that is not graded.
Result<std::string> writeGradeRules(const Pattern& pattern, const SheetSettings& settings);
// Sizes by rules in place of what the file's other sizes were. Refused: rules that the points name and the table lacks,
// and a table whose sample size is not the size that was read.
Done takeGradeRules(CadPattern& read, const GradeRules& rules);

}  // namespace karinui
