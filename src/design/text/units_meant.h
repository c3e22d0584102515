#pragma once
// A length that lacks its unit is read as metres, and hardly ever meant so: “10” for 10 cm makes a piece as large as a
// room. What this program writes by itself always passes.
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

// Of a field of this kind (kindOf()) as it was typed; formulas have rules of their own.
Done unitsMeant(std::string_view kind, std::string_view text);

}  // namespace karinui
