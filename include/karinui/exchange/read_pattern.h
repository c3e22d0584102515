#pragma once
// A paper pattern from a file of any kind Karinui reads. Opens the file; any thread.
#include <filesystem>

#include "karinui/base/result.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// .svg: one Karinui drew. Anything else is JSON: karinui-pattern-1 if it says so, else GarmentCode's.
Result<Pattern> readPattern(const std::filesystem::path& file);

}  // namespace karinui
