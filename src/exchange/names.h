#pragma once
// Names that may stand in a file of another program.
#include <set>
#include <string>
#include <string_view>

namespace karinui {

// Valid UTF-8 without control characters: what is neither becomes U+FFFD or a space. At most 200 bytes.
std::string cleanText(std::string_view text);

// Something no XML reader misunderstands, within an element or an attribute.
std::string xmlEscaped(std::string_view text);

// One word: cleaned, white space as '_'. Empty becomes `otherwise`.
std::string oneWord(std::string_view text, std::string_view otherwise);

// [A-Za-z0-9_-]+, as edges are named; empty where nothing of the text is usable.
std::string edgeWord(std::string_view text);

// The name, or name_2, name_3 … until it is not in `taken`, where it is then entered.
std::string distinct(std::string name, std::set<std::string>& taken);

}  // namespace karinui
