#pragma once
// A paper pattern from a file of any format of the table that carries one. Opens the file; any thread.
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/formats.h"

namespace karinui {

// BadInput, with a sentence that lists what can be read, where the ending is no pattern's. Of a style in several sizes
// the named one, or the sample size (empty); of a file that holds no sizes only `pattern` is told, and a size is
// refused.
Result<CadPattern> readPatternSize(const std::filesystem::path& file, std::string_view size,
                                   FormatTable table = fileFormats());
Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table = fileFormats());

}  // namespace karinui
