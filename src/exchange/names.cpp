#include "names.h"

namespace karinui {
// RFC 3629, table of well-formed sequences.
std::size_t utf8Length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0u) == 0x80u; };
  const unsigned first = byte(i), second = byte(i + 1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(i + 1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool good = !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F);
    return good && follows(i + 1) && follows(i + 2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool good = !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
    return good && follows(i + 1) && follows(i + 2) && follows(i + 3) ? 4 : 0;
  }
  return 0;
}

std::string cleanText(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size() && out.size() < 197;) {
    const std::size_t count = utf8Length(text, i);
    const std::string_view character = text.substr(i, count);
    // C1 controls and the two code points XML 1.0 has no place for are replaced as well.
    const bool c1 = count == 2 && character[0] == '\xC2' && static_cast<unsigned char>(character[1]) < 0xA0;
    const bool noncharacter = character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
    if (count == 0 || noncharacter)
      out += "\xEF\xBF\xBD";
    else if (c1 || static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7f)
      out += ' ';
    else
      out += character;
    i += count == 0 ? 1 : count;
  }
  return out;
}

void appendUtf8(std::string& out, std::uint32_t code) {
  const auto byte = [&](std::uint32_t value) { out += static_cast<char>(value); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 0x3F)), byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | code >> 18), byte(0x80 | (code >> 12 & 0x3F)), byte(0x80 | (code >> 6 & 0x3F)),
        byte(0x80 | (code & 0x3F));
  }
}

std::string xmlEscaped(std::string_view text) {
  std::string out;
  for (const char c : cleanText(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string oneWord(std::string_view text, std::string_view otherwise) {
  std::string out = cleanText(text);
  for (char& c : out)
    if (c == ' ') c = '_';
  return out.empty() ? std::string(otherwise) : out;
}

std::string edgeWord(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 64)) {
    const bool usable =
        (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (usable)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  return out.find_first_not_of('_') == std::string::npos ? std::string{} : out;
}

std::vector<std::string> brokenInto(std::string_view words, double room,
                                    const std::function<double(std::string_view)>& wide) {
  std::vector<std::string> lines;
  while (!words.empty()) {
    std::size_t end = words.size();
    while (end > 1 && wide(words.substr(0, end)) > room) {
      const std::size_t space = words.rfind(' ', end - 1);
      end = space == std::string_view::npos || space == 0 ? end - 1 : space;
      while (end > 1 && (static_cast<unsigned char>(words[end]) & 0xC0) == 0x80) --end;  // within a character
    }
    lines.emplace_back(words.substr(0, end));
    words.remove_prefix(std::min(words.size(), end < words.size() && words[end] == ' ' ? end + 1 : end));
  }
  return lines;
}

std::string DistinctNames::give(std::string name) {
  if (taken_.insert(name).second) return name;
  for (std::size_t& n = next_.try_emplace(name, 2).first->second;;) {
    std::string next = name + "_" + std::to_string(n++);
    if (taken_.insert(next).second) return next;
  }
}

}  // namespace karinui
