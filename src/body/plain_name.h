#pragma once
// A name however it is written: letters and digits only, lower case. "waistGirth", "waist girth" and "waist_girth" are
// one.
#include <string>
#include <string_view>

namespace karinui {

inline std::string plainName(std::string_view name) {
  std::string out;
  for (const char c : name)
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      out += c;
    else if (c >= 'A' && c <= 'Z')
      out += static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace karinui
