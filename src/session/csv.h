#pragma once
// A row of a table for other programs, by RFC 4180.
#include <string>
#include <vector>

namespace karinui {

std::string csvRow(const std::vector<std::string>& cells);

}  // namespace karinui
