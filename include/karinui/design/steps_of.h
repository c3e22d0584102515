#pragma once
// A paper pattern from elsewhere as the operations that make it here, for importers. Pure; any thread.
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

// Each piece under a usable name that is free in `into` and among themselves, then its sizes where `into` has none,
// then each seam. `grading`: its size that stands is the base.
std::vector<Operation> stepsOf(const Pattern& pattern, const Document& into, const Grading& grading = {});

}  // namespace karinui
