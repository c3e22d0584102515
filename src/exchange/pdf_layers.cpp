#include "pdf_layers.h"
#include "karinui/base/number.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

namespace karinui {

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;  // of a dictionary: key, value as it is written

bool endsWord(char c) { return isSpace(c) || c == '/' || c == '<' || c == '>' || c == '[' || c == ']'; }

// One value from `at` on: a dictionary, a list, a reference or a word.
std::string value(std::string_view text, std::size_t& at) {
  while (at < text.size() && isSpace(text[at])) ++at;
  const std::size_t from = at;
  int depth = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '[' || text.substr(at, 2) == "<<") ++depth, at += c == '<';
    if (c == ']' || text.substr(at, 2) == ">>") {
      if (depth == 0) break;
      at += c == '>';
      if (--depth == 0) return std::string(text.substr(from, ++at - from));
    }
    if (depth == 0 && at > from && c == '/') break;
  }
  std::size_t to = at;
  while (to > from && isSpace(text[to - 1])) --to;
  return std::string(text.substr(from, to - from));
}

Entries entriesOf(std::string_view dictionary) {
  Entries all;
  for (std::size_t at = dictionary.find("<<") + 2; (at = dictionary.find('/', at)) != std::string_view::npos;) {
    std::size_t end = at + 1;
    while (end < dictionary.size() && !endsWord(dictionary[end])) ++end;
    std::string key(dictionary.substr(at, end - at));
    at = end;
    all.emplace_back(std::move(key), value(dictionary, at));
  }
  return all;
}

std::string* find(Entries& all, std::string_view key) {
  for (auto& [name, value] : all)
    if (name == key) return &value;
  return nullptr;
}

std::string written(const Entries& all) {
  std::string out = "<<";
  for (const auto& [key, value] : all) out += " " + key + " " + value;
  return out + " >>";
}

// Entries of both; dictionaries of the same name become one.
void merge(Entries& into, const Entries& other) {
  for (const auto& [key, value] : other) {
    std::string* own = find(into, key);
    if (!own) {
      into.emplace_back(key, value);
    } else if (own->starts_with("<<") && value.starts_with("<<")) {
      Entries both = entriesOf(*own);
      merge(both, entriesOf(value));
      *own = written(both);
    }
  }
}

unsigned long numberIn(std::string_view text) { return std::strtoul(std::string(text).c_str(), nullptr, 10); }

class File {
 public:
  explicit File(std::string bytes) : bytes_(std::move(bytes)) {
    const std::size_t trailer = bytes_.rfind("trailer"), start = bytes_.rfind("startxref");
    if (trailer == std::string::npos || start == std::string::npos || start < trailer) return;
    trailer_ = entriesOf(std::string_view(bytes_).substr(trailer, start - trailer));
    previous_ = numberIn(std::string_view(bytes_).substr(start + 9));
    const std::string *root = find(trailer_, "/Root"), *size = find(trailer_, "/Size");
    if (root && size) root_ = numberIn(*root), next_ = numberIn(*size);
  }
  unsigned long root() const { return root_; }  // 0: no file of cairo's
  unsigned long fresh() { return next_++; }

  std::optional<Entries> object(unsigned long number) const {
    const std::string opening = "\n" + std::to_string(number) + " 0 obj";
    const std::size_t begin = bytes_.rfind(opening);
    const std::size_t end = begin == std::string::npos ? begin : bytes_.find("endobj", begin);
    if (end == std::string::npos) return std::nullopt;
    std::string_view text = std::string_view(bytes_).substr(begin + opening.size(), end - begin - opening.size());
    if (text.find("<<") == std::string_view::npos) return std::nullopt;
    std::string plain;  // without comments
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == '%') at = std::min(text.find('\n', at), text.size() - 1);
      plain += text[at];
    }
    return entriesOf(plain);
  }
  std::optional<Entries> dictionary(const std::string& value) const {  // itself or what it refers to
    return value.starts_with("<<") ? std::optional(entriesOf(value)) : object(numberIn(value));
  }

  void put(unsigned long number, const std::string& text) { added_.emplace_back(number, text); }
  std::string finished() {
    if (bytes_.back() != '\n') bytes_ += '\n';
    std::string table = "xref\n";
    for (const auto& [number, text] : added_) {
      char offset[24];
      std::snprintf(offset, sizeof offset, "%010zu 00000 n \n", bytes_.size());
      table += std::to_string(number) + " 1\n" + offset;
      bytes_ += std::to_string(number) + " 0 obj\n" + text + "\nendobj\n";
    }
    *find(trailer_, "/Size") = std::to_string(next_);
    trailer_.emplace_back("/Prev", std::to_string(previous_));
    const std::size_t at = bytes_.size();
    bytes_ += table + "trailer\n" + written(trailer_) + "\nstartxref\n" + std::to_string(at) + "\n%%EOF\n";
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
  Entries trailer_;
  unsigned long previous_ = 0, root_ = 0, next_ = 0;
  std::vector<std::pair<unsigned long, std::string>> added_;
};

std::string stream(const std::string& content) {
  return "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "\nendstream";
}
std::string reference(unsigned long number) { return std::to_string(number) + " 0 R"; }

// A text string in UTF-16, as PDF wants what is not Latin.
std::string textString(const std::string& utf8) {
  std::string out = "<FEFF";
  const auto unit = [&](std::uint32_t u) {
    char digits[8];
    std::snprintf(digits, sizeof digits, "%04X", static_cast<unsigned>(u));
    out += digits;
  };
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t size = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    std::uint32_t c = size == 1 ? first : first & (0x7Fu >> size);
    for (std::size_t k = 1; k < size && i + k < utf8.size(); ++k)
      c = c << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3Fu);
    if (c >= 0x10000)
      unit(0xD800 + ((c - 0x10000) >> 10)), unit(0xDC00 + ((c - 0x10000) & 0x3FF));
    else
      unit(c);
    i += size;
  }
  return out + ">";
}

std::vector<unsigned long> references(const std::string& list) {
  std::vector<unsigned long> all;
  for (std::size_t at = list.find_first_of("0123456789"); at != std::string::npos;) {
    all.push_back(numberIn(std::string_view(list).substr(at)));
    at = list.find('R', at);
    if (at != std::string::npos) at = list.find_first_of("0123456789", at);
  }
  return all;
}

}  // namespace

std::string layered(std::string pdf, const std::vector<std::string>& names) {
  const std::string before = pdf;
  File file(std::move(pdf));
  auto catalogue = file.root() ? file.object(file.root()) : std::nullopt;
  const std::string* tree = catalogue ? find(*catalogue, "/Pages") : nullptr;
  auto pages = tree ? file.object(numberIn(*tree)) : std::nullopt;
  std::string* kids = pages ? find(*pages, "/Kids") : nullptr;
  if (!kids || names.empty()) return before;
  const unsigned long pagesNumber = numberIn(*tree);
  const std::vector<unsigned long> drawn = references(*kids);
  if (drawn.empty() || drawn.size() % names.size() != 0) return before;

  std::vector<unsigned long> groups, opening;  // of the layers with a name; 0: none
  for (std::size_t i = 0; i < names.size(); ++i)
    groups.push_back(names[i].empty() ? 0 : file.fresh()), opening.push_back(file.fresh());
  const unsigned long closing = file.fresh(), closingShown = file.fresh();
  std::string all;
  for (const unsigned long group : groups)
    if (group) all += " " + reference(group);

  std::vector<std::pair<unsigned long, Entries>> made;
  for (std::size_t first = 0; first < drawn.size(); first += names.size()) {
    Entries page, resources;
    std::string contents = "[";
    for (std::size_t i = 0; i < names.size(); ++i) {
      auto part = file.object(drawn[first + i]);
      if (!part) return before;
      const std::string *content = find(*part, "/Contents"), *own = find(*part, "/Resources");
      const auto used = own ? file.dictionary(*own) : std::nullopt;
      if (!content || !used) return before;
      merge(resources, *used);
      contents += " " + reference(opening[i]) + " " + *content + " " + reference(groups[i] ? closing : closingShown);
      if (i == 0) page = *std::move(part);
    }
    Entries properties;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (groups[i]) properties.emplace_back("/L" + std::to_string(i), reference(groups[i]));
    resources.emplace_back("/Properties", written(properties));
    *find(page, "/Contents") = contents + " ]";
    *find(page, "/Resources") = written(resources);
    made.emplace_back(drawn[first], std::move(page));
  }

  *kids = "[";
  for (const auto& [number, page] : made) *kids += " " + reference(number);
  *kids += " ]";
  if (std::string* count = find(*pages, "/Count")) *count = std::to_string(made.size());
  catalogue->emplace_back("/Version", "/1.5");
  catalogue->emplace_back("/ViewerPreferences", "<< /PrintScaling /None >>");
  catalogue->emplace_back(
      "/OCProperties", "<< /OCGs [" + all + " ] /D << /Name (Karinui) /Order [" + all + " ] /ON [" + all + " ] >> >>");
  file.put(file.root(), written(*catalogue));
  file.put(pagesNumber, written(*pages));
  for (const auto& [number, page] : made) file.put(number, written(page));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (groups[i]) file.put(groups[i], "<< /Type /OCG /Name " + textString(names[i]) + " >>");
    file.put(opening[i], stream(groups[i] ? "/OC /L" + std::to_string(i) + " BDC q" : "q"));
  }
  file.put(closing, stream("Q EMC"));
  file.put(closingShown, stream("Q"));
  return file.finished();
}

}  // namespace karinui
