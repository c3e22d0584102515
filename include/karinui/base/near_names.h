#pragma once
// What a person may have meant who wrote a name that is not there.
#include <string>
#include <string_view>
#include <vector>

namespace karinui {

// How many letters are put in, left out or exchanged to make the one the other.
std::size_t edits(std::string_view a, std::string_view b);
// How many of them a mistyped name may have: one where it is short, up to a third of a longer one.
std::size_t mostEdits(std::string_view wanted);
// The nearest of the names, at most three, none where none is near.
std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& names);

}  // namespace karinui
