#pragma once
// Operations as a person reads them.
#include <string>
#include <string_view>

namespace karinui::app {

// Lengths in mm are rounded to 0.01 mm on a screen. Elsewhere, where the text may be played again, only what is one of
// these but for the last digits of a double is: 111.99999999999999mm is 112mm.
std::string withReadableLengths(std::string_view operations);
// An operation as it is echoed: long values in quotes, as an outline of many curves, are cut short with "…".
std::string shortened(const std::string& operation);

}  // namespace karinui::app
