#include "dxf_text.h"

#include <cctype>
#include <optional>

#include "exchange/code_pages.h"
#include "exchange/names.h"

namespace karinui {

namespace {

constexpr std::size_t kLongest = 400;  // bytes of a text that are looked at

// Nothing: the bytes are no text of that code page.
std::optional<std::string> decoded(std::string_view bytes, const std::string& codePage) {
  return inUtf8(bytes.substr(0, kLongest), codePage);
}

bool isAscii(std::string_view text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) >= 0x80) return false;
  return true;
}

// "ANSI_932" is CP932; "UTF-8" is none.
std::string pageOf(std::string_view told) {
  std::string digits;
  for (const char c : told)
    if (std::isdigit(static_cast<unsigned char>(c))) digits += c;
  if (told.starts_with("ANSI") || told.starts_with("ansi") || told.starts_with("dos") || told.starts_with("DOS"))
    return digits == "936" ? "GBK" : digits == "950" ? "BIG5" : "CP" + digits;
  return {};
}

// \U+524D, as programs write letters that their code page lacks.
std::string withEscapes(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    std::size_t digits = 0;
    if (text.substr(i, 3) == "\\U+")
      for (; digits < 4 && i + 3 + digits < text.size(); ++digits) {
        const auto c = static_cast<unsigned char>(text[i + 3 + digits]);
        if (!std::isxdigit(c)) break;
        code = code * 16 + static_cast<unsigned>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
      }
    if (digits < 4) {
      out += text[i];
      continue;
    }
    i += 6;
    appendUtf8(out, code);
  }
  return out;
}

// Lettering without how it is lettered: "{\fArial|b0;Front}" of MTEXT, "%%uFront" of TEXT.
std::string plainLettering(std::string_view text) {
  std::string out;
  bool any = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i, 2) == "%%" && i + 2 < text.size() &&
        std::string_view("uUoO").find(text[i + 2]) != std::string_view::npos) {
      i += 2;
      continue;
    }
    const bool code = text[i] == '\\' && i + 1 < text.size() &&
                      std::string_view("fFHhWQTCcAp").find(text[i + 1]) != std::string_view::npos;
    const std::size_t end = code ? text.find_first_of(";\\{}", i + 1) : std::string_view::npos;
    if (end != std::string_view::npos && text[end] == ';') {
      any = true;
      i = end;
      continue;
    }
    out += text[i];
  }
  if (any) std::erase_if(out, [](char c) { return c == '{' || c == '}'; });
  return out;
}

}  // namespace

DxfWords::DxfWords(const DxfFile& file) {
  std::string all;  // what is written in letters of some country
  bool unicode = true, long_ = false;
  const auto add = [&](std::string_view text) {
    if (all.size() >= kLongest || isAscii(text)) return;
    all.append(text.substr(0, kLongest)).append(" ");
    unicode = unicode && cleanText(text).find("\xEF\xBF\xBD") == std::string::npos;
    for (const char c : text) long_ = long_ || static_cast<unsigned char>(c) >= 0xE0;
  };
  const auto addAll = [&](const std::vector<DxfEntity>& entities) {
    for (const DxfEntity& entity : entities) add(entity.text(1));
  };
  for (const DxfBlock& block : file.blocks) add(block.name), addAll(block.entities);
  addAll(file.entities);
  codePage_ = pageOf(file.codePage);
  // Two bytes of a Chinese or Japanese character may be one letter of UTF-8, but theirs have three there.
  const bool twoByted = codePage_ == "GBK" || codePage_ == "BIG5" || codePage_ == "CP932" || codePage_ == "CP949";
  if (unicode && !(twoByted && !long_ && decoded(all, codePage_))) {
    codePage_.clear();
    return;
  }
  if (!codePage_.empty() && decoded("A", codePage_)) return;
  guessed_ = true;
  codePage_ = likelyCodePage(std::string_view(all).substr(0, kLongest));
}

std::string DxfWords::operator()(std::string_view bytes) const {
  const auto first = bytes.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  bytes = bytes.substr(first, bytes.find_last_not_of(" \t") + 1 - first);
  const bool asItIs = codePage_.empty() || isAscii(bytes);
  const std::string letters = asItIs ? std::string(bytes) : decoded(bytes, codePage_).value_or(std::string(bytes));
  return cleanText(withEscapes(plainLettering(letters)));
}

}  // namespace karinui
