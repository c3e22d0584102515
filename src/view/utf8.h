#pragma once
// The letters of a UTF-8 text. What is no UTF-8 becomes U+FFFD, what moves the pen (line breaks, tabs) a space.
#include <string>
#include <string_view>

namespace karinui {

std::u32string lettersOf(std::string_view utf8);

}  // namespace karinui
