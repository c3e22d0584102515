#pragma once
// A paper pattern from a file of any format of the table that carries one. Opens the file; any thread.
#include "karinui/exchange/formats.h"

namespace karinui {

// BadInput, with a sentence that lists what can be read, where the ending is no pattern's.
Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table = fileFormats());

}  // namespace karinui
