#pragma once
// Which Karinui this is: the version of the project in CMakeLists.txt, as in "0.1.0". Pure; any thread.
#include <string_view>

namespace karinui {

std::string_view version();

}  // namespace karinui
