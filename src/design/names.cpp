#include <algorithm>

#include "karinui/design/document.h"

namespace karinui {

namespace {

constexpr std::size_t kLongest = 100;  // bytes: names go into files, drawings and filenames

bool goodByte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0 || c == '_' || c == '-';
}

// "p3" and "s12" are how ids are written.
bool likeAnId(std::string_view name) {
  return name.size() > 1 && (name[0] == 'p' || name[0] == 's') &&
         std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Whole UTF-8 sequences only, none of them longer than they need to be.
bool wholeUtf8(std::string_view name) {
  for (std::size_t i = 0; i < name.size();) {
    const auto lead = static_cast<unsigned char>(name[i]);
    const std::size_t size = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
    if (size == 0 || i + size > name.size()) return false;
    for (std::size_t k = 1; k < size; ++k)
      if ((static_cast<unsigned char>(name[i + k]) & 0xc0) != 0x80) return false;
    i += size;
  }
  return true;
}

}  // namespace

Done checkName(std::string_view name) {
  if (name.empty()) return refused(say("A name is missing."));
  if (name.size() > kLongest) return refused(say("The name “{0}…” is too long.", name.substr(0, 20)));
  if (!wholeUtf8(name)) return refused(say("A name is not readable text."));
  if (!std::all_of(name.begin(), name.end(), goodByte)) {
    return refused(say("The name “{0}” has a space or a sign in it; use letters, digits, _ and -.", name));
  }
  if (name.front() == '-') return refused(say("The name “{0}” begins with a dash; begin it with a letter.", name));
  if (likeAnId(name)) return refused(say("“{0}” looks like a number of a piece or seam; choose another name.", name));
  return {};
}

std::string usableName(const Document& document, std::string_view wanted) {
  std::string name;
  for (const char c : wanted.substr(0, kLongest - 20)) name += goodByte(c) ? c : '_';
  while (!name.empty() && name.front() == '-') name.erase(0, 1);
  if (!checkName(name)) name = "piece" + (likeAnId(name) ? "_" + name : std::string());
  std::string free = name;
  for (int n = 2; document.pieceNamed(free) != nullptr; ++n) free = name + "_" + std::to_string(n);
  return free;
}

}  // namespace karinui
