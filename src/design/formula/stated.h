#pragma once
// What names in formulas lead to; workOutStated() is in karinui/design/variables.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"

namespace karinui {

// The key of a measure, from any of its names or what it is called in either language.
std::optional<std::string> measureCalled(std::string_view name);

// The refusal of names that lead back to `name`: "a → b → a", those asked before it left out.
Error formulaCircle(const std::vector<std::string>& asking, const std::string& name);

}  // namespace karinui
