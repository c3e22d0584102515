#pragma once
// Names and words that may stand in a file of another program.
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace karinui {

// How many bytes the UTF-8 character at `i` has; 0 where there is none.
std::size_t utf8Length(std::string_view text, std::size_t i);

// Valid UTF-8 without control characters: what is neither becomes U+FFFD or a space. At most 200 bytes.
std::string cleanText(std::string_view text);

// A code point, below 0x110000, in UTF-8.
void appendUtf8(std::string& out, std::uint32_t code);

// Something no XML reader misunderstands, within an element or an attribute.
std::string xmlEscaped(std::string_view text);

// One word: cleaned, white space as '_'. Empty becomes `otherwise`.
std::string oneWord(std::string_view text, std::string_view otherwise);

// [A-Za-z0-9_-]+, as edges are named; empty where nothing of the text is usable.
std::string edgeWord(std::string_view text);

// In lines that are no wider than `room`; words are kept whole where there are spaces.
std::vector<std::string> brokenInto(std::string_view words, double room,
                                    const std::function<double(std::string_view)>& wide);

// Names of which no two are the same.
class DistinctNames {
 public:
  DistinctNames(std::initializer_list<std::string> taken = {}) : taken_(taken) {}
  // The name, or the first of name_2, name_3 … that was not given yet. A file of the same name over and over costs no
  // more than one of different names.
  std::string give(std::string name);

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> next_;  // the number to try first; what is taken stays taken
};

}  // namespace karinui
