#include "exchange/code_pages.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>

#include "exchange/names.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr const char* kWestern = "CP1252";

// What files call a code page, in lower case, and what iconv calls it. The system loads its tables by name: a name
// that a stranger wrote is never handed on.
constexpr std::array<std::pair<std::string_view, const char*>, 50> kKnown{{
    {"ascii", "CP1252"},
    {"us-ascii", "CP1252"},
    {"iso-8859-1", "CP1252"},
    {"latin1", "CP1252"},
    {"cp1252", "CP1252"},
    {"windows-1252", "CP1252"},
    {"cp1250", "CP1250"},
    {"windows-1250", "CP1250"},
    {"cp1251", "CP1251"},
    {"windows-1251", "CP1251"},
    {"cp1253", "CP1253"},
    {"windows-1253", "CP1253"},
    {"cp1254", "CP1254"},
    {"windows-1254", "CP1254"},
    {"cp1255", "CP1255"},
    {"windows-1255", "CP1255"},
    {"cp1256", "CP1256"},
    {"windows-1256", "CP1256"},
    {"cp1257", "CP1257"},
    {"windows-1257", "CP1257"},
    {"cp1258", "CP1258"},
    {"windows-1258", "CP1258"},
    {"cp437", "CP437"},
    {"cp775", "CP775"},
    {"cp850", "CP850"},
    {"cp852", "CP852"},
    {"cp855", "CP855"},
    {"cp857", "CP857"},
    {"cp866", "CP866"},
    {"cp874", "CP874"},
    {"iso-8859-2", "ISO-8859-2"},
    {"iso-8859-5", "ISO-8859-5"},
    {"iso-8859-15", "ISO-8859-15"},
    {"koi8-r", "KOI8-R"},
    {"shift_jis", "CP932"},
    {"shift-jis", "CP932"},
    {"sjis", "CP932"},
    {"windows-31j", "CP932"},
    {"cp932", "CP932"},
    {"euc-jp", "EUC-JP"},
    {"gb2312", "GBK"},
    {"gbk", "GBK"},
    {"cp936", "GBK"},
    {"gb18030", "GB18030"},
    {"big5", "BIG5"},
    {"cp950", "BIG5"},
    {"euc-kr", "CP949"},
    {"cp949", "CP949"},
    {"utf-16le", "UTF-16LE"},
    {"utf-16be", "UTF-16BE"},
}};

// Chinese names read as Japanese ones come out with half-width kana, which nobody writes beside kanji.
bool hasHalfWidthKana(std::string_view utf8) {
  for (std::size_t i = 0; i + 2 < utf8.size(); ++i)
    if (utf8[i] == '\xEF' && (utf8[i + 1] == '\xBD' || utf8[i + 1] == '\xBE')) return true;
  return false;
}

// Whether all letters beyond ASCII stand singly within words of Latin letters, as in "Rücken": a Chinese or Japanese
// character has two bytes, and seldom a Latin letter beside it.
bool looksWestern(std::string_view text) {
  const auto latin = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0 &&
           static_cast<unsigned char>(text[i]) < 0x80;
  };
  const auto high = [&](std::size_t i) { return i < text.size() && static_cast<unsigned char>(text[i]) >= 0x80; };
  bool any = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!high(i)) continue;
    std::size_t end = i;
    for (; high(end); ++end) {
      const auto byte = static_cast<unsigned char>(text[end]);
      if (byte < 0xC0 || byte == 0xD7 || byte == 0xF7) return false;
    }
    const bool before = i > 0 && latin(i - 1), after = latin(end);
    if (end - i > 2 || !(before || after)) return false;
    if (end - i == 2 && !(before && after) && text[i + 1] != '\xDF') return false;  // as "Maß", "Größe", "créée"
    any = true;
    i = end;
  }
  return any;
}

std::string lowerCase(std::string_view text) {
  std::string low(text);
  for (char& c : low) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return low;
}

// The encoding that <?xml … encoding="…"?> names; empty: none.
std::string_view encodingOf(std::string_view xml) {
  if (!xml.starts_with("<?xml")) return {};
  xml = xml.substr(0, std::min<std::size_t>(xml.find("?>"), 300));
  const std::size_t key = xml.find("encoding");
  if (key == std::string_view::npos) return {};
  const std::size_t open = xml.find_first_of("\"'", key);
  if (open == std::string_view::npos) return {};
  const std::size_t close = xml.find(xml[open], open + 1);
  return close == std::string_view::npos ? std::string_view{} : trimmed(xml.substr(open + 1, close - open - 1));
}

}  // namespace

bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t count = utf8Length(text, i);
    if (count == 0) return false;
    i += count;
  }
  return true;
}

std::optional<std::string> inUtf8(std::string_view bytes, std::string_view codePage) {
  const std::string low = lowerCase(codePage);
  const auto known = std::find_if(kKnown.begin(), kKnown.end(), [&](const auto& row) { return row.first == low; });
  if (known == kKnown.end()) return std::nullopt;
  const iconv_t table = iconv_open("UTF-8", known->second);
  if (table == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string in(bytes), out(4 * in.size() + 4, '\0');
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  // A character that the end cut in two is no fault.
  const bool good = iconv(table, &from, &left, &to, &room) != static_cast<std::size_t>(-1) || errno == EINVAL;
  iconv_close(table);
  if (!good) return std::nullopt;
  out.resize(out.size() - room);
  return out;
}

std::string likelyCodePage(std::string_view letters) {
  if (looksWestern(letters)) return kWestern;
  const auto japanese = inUtf8(letters, "CP932");
  if (japanese && !hasHalfWidthKana(*japanese)) return "CP932";
  return inUtf8(letters, "GBK") ? "GBK" : kWestern;
}

std::string withoutUtf16(std::string text) {
  const bool little = text.starts_with("\xFF\xFE"), big = text.starts_with("\xFE\xFF");
  if (!little && !big) return text;
  return inUtf8(std::string_view(text).substr(2), little ? "UTF-16LE" : "UTF-16BE").value_or(std::move(text));
}

std::string xmlInUtf8(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return withoutUtf16(std::string(text));
  if (text.starts_with("\xEF\xBB\xBF")) return std::string(text.substr(3));
  const std::string_view told = encodingOf(text);
  const bool unicode = lowerCase(told).starts_with("utf");
  if (!told.empty() && !unicode)
    if (auto known = inUtf8(text, told)) return *std::move(known);
  if (isUtf8(text)) return std::string(text);
  std::string letters;  // with the bytes beside them, which tell whether they stand within a word
  for (std::size_t i = 0; i < text.size() && letters.size() < 400;) {
    const auto high = [&](std::size_t k) { return k < text.size() && static_cast<unsigned char>(text[k]) >= 0x80; };
    if (high(i) || high(i + 1) || (i > 0 && high(i - 1)))
      letters += text[i];
    else if (!letters.empty() && letters.back() != ' ')
      letters += ' ';
    ++i;
  }
  return inUtf8(text, likelyCodePage(letters)).value_or(std::string(text));
}

}  // namespace karinui
