#pragma once
// Text files that another verb reads: what `log` and `dump` wrote.
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui::app {

bool isScript(std::string_view text);  // operations, at least one
Error readByPlay(const std::string& path);
Error readByLoad(const std::string& path);

}  // namespace karinui::app
