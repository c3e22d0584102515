#pragma once
// What a piece's name tells of it.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/make_up.h"

namespace karinui {

std::vector<std::string> wordsOf(std::string_view name);  // in small letters
std::optional<PieceReading::Side> sideNamed(std::string_view name);

}  // namespace karinui
