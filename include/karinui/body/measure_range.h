#pragma once
// What a body can have of a measure. Pure; any thread.
#include <optional>
#include <string_view>
#include <utility>

namespace karinui {

// Least and most, in metres or radians, of a child of five to an adult; none: there is no such measure.
std::optional<std::pair<double, double>> measureRange(std::string_view key);

}  // namespace karinui
