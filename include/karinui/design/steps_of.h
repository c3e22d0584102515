#pragma once
// A paper pattern from elsewhere as the operations that make it here, for importers. Pure; any thread.
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

// Each piece under a usable name that is free in `into` and among themselves, then each seam.
std::vector<Operation> stepsOf(const Pattern& pattern, const Document& into);

}  // namespace karinui
