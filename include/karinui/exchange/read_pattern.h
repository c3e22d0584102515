#pragma once
// A paper pattern from a file of any format of the table that carries one. Opens the file; any thread.
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/formats.h"

namespace karinui {

// Grade rules for the points of a DXF file.
struct RulesFile {
  std::filesystem::path file;  // empty: the one beside the DXF file that has its name and ends in .rul, if there is one
  bool steps = false;          // as in readGradeRules()
};
// BadInput, with a sentence that lists what can be read, where the ending is no pattern's. Of a style in several sizes
// the named one, or the sample size (empty); of a file that holds no sizes only `pattern` is told, and a size is
// refused. `unit`: what a unit of a DXF file or a drawing is, whatever it tells itself: mm, cm, m, in, pt; empty: as it
// tells. Other files always tell it, and refuse one.
Result<CadPattern> readPatternSize(const std::filesystem::path& file, std::string_view size,
                                   FormatTable table = fileFormats(), const RulesFile& rules = {},
                                   std::string_view unit = {});
Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table = fileFormats());

}  // namespace karinui
