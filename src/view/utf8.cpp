#include "view/utf8.h"

#include <cstdint>

namespace karinui {

std::u32string lettersOf(std::string_view utf8) {
  std::u32string letters;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t more = first < 0x80                    ? 0
                             : first >= 0xf0 && first < 0xf5 ? 3
                             : first >= 0xe0                 ? 2
                             : first >= 0xc2                 ? 1
                                                             : 9;
    char32_t letter = more == 0 ? first : first & (0x3fu >> more);
    bool good = more < 9 && first < 0xf5 && i + more < utf8.size();
    for (std::size_t k = 1; good && k <= more; ++k) {
      const auto next = static_cast<unsigned char>(utf8[i + k]);
      good = (next & 0xc0) == 0x80;
      letter = letter << 6 | (next & 0x3fu);
    }
    constexpr char32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    good = good && letter >= kLeast[more] && letter <= 0x10ffff && (letter < 0xd800 || letter > 0xdfff);
    if (good && letter < 0x20) letter = U' ';
    letters.push_back(good ? letter : U'\ufffd');
    i += good ? more + 1 : 1;
  }
  return letters;
}

}  // namespace karinui
