#include "xml.h"

#include <charconv>
#include <optional>
#include <set>

#include "exchange/code_pages.h"
#include "karinui/base/number.h"
#include "names.h"
#include "strict_json.h"

namespace karinui {
namespace {

constexpr std::size_t kDeepest = 64, kMostElements = 500000;

bool isName(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == ':' || c == '.';
}

// References to the file's own names stay as they are written.
std::optional<std::string> resolved(std::string_view text, const std::set<std::string>& own) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '<') return std::nullopt;
    if (text[i] != '&') {
      out += text[i];
      continue;
    }
    const std::size_t end = text.find(';', i);
    if (end == std::string_view::npos || end - i > 64) return std::nullopt;
    const std::string_view name = text.substr(i + 1, end - i - 1);
    if (own.contains(std::string(name))) {
      out += text.substr(i, end + 1 - i);
      i = end;
      continue;
    }
    if (name == "amp")
      out += '&';
    else if (name == "lt")
      out += '<';
    else if (name == "gt")
      out += '>';
    else if (name == "quot")
      out += '"';
    else if (name == "apos")
      out += '\'';
    else if (name.size() > 1 && name[0] == '#') {
      const bool hex = name[1] == 'x';
      const std::string_view digits = name.substr(hex ? 2 : 1);
      std::uint32_t code = 0;
      const auto [stop, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), code, hex ? 16 : 10);
      if (problem != std::errc{} || stop != digits.data() + digits.size() || code < 0x20 || code > 0x10FFFF ||
          (code >= 0xD800 && code < 0xE000))
        return std::nullopt;
      appendUtf8(out, code);
    } else {
      return std::nullopt;
    }
    i = end;
  }
  return out;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<std::vector<XmlElement>> run() {
    while (at_ < text_.size()) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string_view::npos) break;
      at_ = open;
      if (!markup()) return badInput(wrong_.empty() ? say("The file is damaged at byte {0}.", at_) : wrong_);
      if (out_.size() > kMostElements) return badInput(say("The file has more than {0} elements.", kMostElements));
    }
    if (out_.empty()) return badInput(say("This file is not XML."));
    if (!open_.empty()) return badInput(say("The file ends too early: \"{0}\" is not closed.", shown(open_.back())));
    return std::move(out_);
  }

 private:
  bool starts(std::string_view what) const { return text_.substr(at_, what.size()) == what; }
  bool skipPast(std::string_view what) {
    const std::size_t found = text_.find(what, at_);
    if (found == std::string_view::npos) return false;
    at_ = found + what.size();
    return true;
  }
  bool markup() {
    if (starts("<!--")) return skipPast("-->");
    if (starts("<![CDATA[")) {
      const std::size_t from = at_ + 9;
      if (!skipPast("]]>")) return false;
      if (!out_.empty() && out_.back().depth + 1 == open_.size())
        out_.back().text += text_.substr(from, at_ - 3 - from);
      return true;
    }
    if (starts("<?")) return skipPast("?>");
    if (starts("<!")) return doctype();
    if (starts("</")) {
      at_ += 2;
      const std::string name = word();
      while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
      if (!starts(">") || open_.empty() || open_.back() != name) return false;
      ++at_;
      open_.pop_back();
      return true;
    }
    ++at_;
    return element();
  }
  // Passed over: no definition that it names is opened. Drawing programs declare short names for addresses within it;
  // these are known by name and never put in. All other declarations of its own are refused.
  bool doctype() {
    const std::size_t end = text_.find_first_of("[>", at_), from = at_;
    if (starts("<!DOCTYPE") && out_.empty() && end != std::string_view::npos) {
      at_ = end + 1;
      if (text_[end] == '>' || declarations()) return true;
    }
    at_ = from;
    wrong_ =
        say("The file has a DOCTYPE with declarations of its own, which are not read for safety. Save it without one "
            "(a drawing as plain SVG).");
    return false;
  }
  // <!ENTITY name "plain words"> … ]>
  bool declarations() {
    const auto blank = [&] {
      while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
    };
    for (;;) {
      blank();
      if (starts("]")) {
        ++at_, blank();
        if (!starts(">")) return false;
        ++at_;
        return true;
      }
      if (!starts("<!ENTITY") || own_.size() >= 100) return false;
      at_ += 8, blank();
      const std::string name = word();
      blank();
      if (name.empty() || at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
      const std::size_t close = text_.find(text_[at_], at_ + 1);
      if (close == std::string_view::npos ||
          text_.substr(at_, close - at_).find_first_of("&%<") != std::string_view::npos)
        return false;
      at_ = close + 1, blank();
      if (!starts(">")) return false;
      ++at_;
      own_.insert(name);
    }
  }
  std::string word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && isName(text_[at_])) ++at_;
    return std::string(text_.substr(from, at_ - from));
  }
  bool element() {
    XmlElement element{word(), {}, open_.size(), {}};
    if (element.name.empty() || (open_.empty() && !out_.empty())) return false;
    if (open_.size() >= kDeepest) {
      wrong_ = say("The file is nested more than {0} levels deep.", kDeepest);
      return false;
    }
    for (;;) {
      while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
      if (starts("/>")) {
        at_ += 2;
        out_.push_back(std::move(element));
        return true;
      }
      if (starts(">")) {
        ++at_;
        open_.push_back(element.name);
        element.text = resolved(text_.substr(at_, text_.find('<', at_) - at_), own_).value_or("");
        out_.push_back(std::move(element));
        return true;
      }
      if (!attribute(element)) return false;
    }
  }
  bool attribute(XmlElement& element) {
    const std::string key = word();
    if (key.empty() || !starts("=")) return false;
    ++at_;
    if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) return false;
    const auto value = resolved(text_.substr(at_ + 1, end - at_ - 1), own_);
    if (!value || !element.attributes.emplace(key, *value).second) return false;
    at_ = end + 1;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<XmlElement> out_;
  std::vector<std::string> open_;
  std::set<std::string> own_;  // names that its DOCTYPE declares
  Message wrong_;
};

}  // namespace

Result<std::vector<XmlElement>> parseXml(std::string_view text) {
  if (text.size() > kLargestJson)
    return badInput(say("The file is too large: at most {0} MB are read.", kLargestJson >> 20));
  const std::string unicode = xmlInUtf8(text);
  if (unicode.find('\0') != std::string_view::npos) return badInput(say("This file is not XML."));
  return Parser(unicode).run();
}

}  // namespace karinui
