#include "svg_habits.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>

#include "exchange/names.h"
#include "karinui/base/number.h"
#include "svg_path.h"

namespace karinui {

namespace {

constexpr std::size_t kMostDrawn = 200'000, kDeepestClone = 16, kDeepestElement = 256, kMostRules = 5000;

std::string_view localName(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string referenceOf(const XmlElement& use) {
  const std::string* to = use.find("href");
  if (!to) to = use.find("xlink:href");
  return to ? *to : "";
}

// A length in the drawing's own units; nothing: none, or a share of the whole.
std::optional<double> ownUnits(const std::string* text) {
  if (!text) return std::nullopt;
  std::string_view plain = trimmed(*text);
  if (plain.ends_with("px")) plain.remove_suffix(2);
  const auto n = svgNumbers(plain);
  if (!n || n->size() != 1) return std::nullopt;
  return n->front();
}

// What places a drawing (or symbol) within another: its corner, and its viewBox fitted into its size and centred.
std::string viewport(const XmlElement& inner, double x, double y, std::optional<double> wide,
                     std::optional<double> high) {
  std::string all = "translate(" + shortest(x) + "," + shortest(y) + ")";
  const std::string* told = inner.find("viewBox");
  const auto box = told ? svgNumbers(*told) : std::nullopt;
  if (!box || box->size() != 4 || !((*box)[2] > 0) || !((*box)[3] > 0) || !wide || !high) return all;
  const double scale = std::min(*wide / (*box)[2], *high / (*box)[3]);
  if (!(scale > 0)) return all;
  all +=
      " translate(" + shortest((*wide - scale * (*box)[2]) / 2) + "," + shortest((*high - scale * (*box)[3]) / 2) + ")";
  return all + " scale(" + shortest(scale) + ") translate(" + shortest(-(*box)[0]) + "," + shortest(-(*box)[1]) + ")";
}

class Cloning {
 public:
  Cloning(const std::vector<XmlElement>& elements, bool (*leave)(const std::string&))
      : elements_(elements), leave_(leave) {
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (const std::string* id = elements[i].find("id")) byId_.try_emplace(*id, i);
  }

  WithClones run() {
    copy(0, elements_.size(), 0, 0);
    return std::move(out_);
  }

 private:
  std::size_t endOf(std::size_t at) const {
    std::size_t end = at + 1;
    while (end < elements_.size() && elements_[end].depth > elements_[at].depth) ++end;
    return end;
  }
  bool room() {
    if (out_.elements.size() >= kMostDrawn) out_.tooMany = true;
    return !out_.tooMany;
  }

  // The elements from..end, deeper by `deeper`; within so many clones.
  void copy(std::size_t from, std::size_t end, std::size_t deeper, std::size_t clones) {
    for (std::size_t i = from; i < end && room(); ++i) {
      XmlElement element = elements_[i];
      element.depth += deeper;
      const std::string_view name = localName(element.name);
      if (name == "use") {
        if (const std::string to = referenceOf(element); !leave_(to)) {
          clone(std::move(element), to, clones);
          continue;
        }
      } else if (name == "svg" && i > 0) {
        const double x = ownUnits(element.find("x")).value_or(0), y = ownUnits(element.find("y")).value_or(0);
        place(element, viewport(element, x, y, ownUnits(element.find("width")), ownUnits(element.find("height"))));
      }
      out_.elements.push_back(std::move(element));
    }
  }

  static void place(XmlElement& group, const std::string& how) {
    std::string& transform = group.attributes["transform"];
    transform = transform.empty() ? how : transform + " " + how;
    group.name = "g";
  }

  void clone(XmlElement group, const std::string& to, std::size_t clones) {
    const auto found = to.starts_with("#") ? byId_.find(to.substr(1)) : byId_.end();
    if (found == byId_.end() || clones >= kDeepestClone || asking_.contains(found->second) ||
        group.depth >= kDeepestElement) {
      if (told_.insert(to).second) out_.missing.push_back(to);
      return;
    }
    const std::size_t at = found->second, depth = group.depth;
    const XmlElement& target = elements_[at];
    const double x = ownUnits(group.find("x")).value_or(0), y = ownUnits(group.find("y")).value_or(0);
    const std::string_view kind = localName(target.name);
    const bool within = kind == "symbol" || kind == "svg";
    const auto size = [&](const char* key) {
      const auto own = ownUnits(group.find(key));
      return own ? own : ownUnits(target.find(key));
    };
    place(group, within ? viewport(target, x, y, size("width"), size("height"))
                        : "translate(" + shortest(x) + "," + shortest(y) + ")");
    asking_.insert(at);
    const std::size_t end = endOf(at);
    const std::size_t from = within ? at + 1 : at;  // of a symbol what it holds
    if (within)
      for (const char* key : {"id", "class", "inkscape:label", "data-name"})
        if (!group.find(key) && target.find(key)) group.attributes[key] = *target.find(key);
    out_.elements.push_back(std::move(group));
    copy(from, end, depth + 1 - (within ? target.depth + 1 : target.depth), clones + 1);
    asking_.erase(at);
  }

  const std::vector<XmlElement>& elements_;
  bool (*leave_)(const std::string&);
  std::map<std::string, std::size_t> byId_;
  std::set<std::size_t> asking_;
  std::set<std::string> told_;
  WithClones out_;
};

// "key: value" between semicolons.
void declarationsOf(std::string_view text, std::map<std::string, std::string>& into) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size()), colon = text.find(':', at);
    if (colon < end) {
      std::string_view value = trimmed(text.substr(colon + 1, end - colon - 1));
      if (const std::size_t mark = value.find('!'); mark != std::string_view::npos)
        value = trimmed(value.substr(0, mark));
      into[std::string(trimmed(text.substr(at, colon - at)))] = value;
    }
    at = end + 1;
  }
}

}  // namespace

WithClones withClones(const std::vector<XmlElement>& elements, bool (*leave)(const std::string& reference)) {
  return Cloning(elements, leave).run();
}

SvgStyles::SvgStyles(const std::vector<XmlElement>& elements) {
  for (const XmlElement& element : elements)
    if (localName(element.name) == "style") read(element.text);
}

void SvgStyles::read(std::string_view sheet) {
  std::string plain;  // without comments
  for (std::size_t at = 0; at < sheet.size();) {
    const std::size_t open = std::min(sheet.find("/*", at), sheet.size());
    plain += sheet.substr(at, open - at);
    const std::size_t close = sheet.find("*/", std::min(open + 2, sheet.size()));
    at = close == std::string_view::npos ? sheet.size() : close + 2;
  }
  const std::string_view text = plain;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    if (open == std::string_view::npos) return;
    const std::string_view selectors = trimmed(text.substr(at, open - at));
    std::size_t close = open + 1;
    for (int depth = 1; close < text.size(); ++close)
      if ((depth += text[close] == '{' ? 1 : text[close] == '}' ? -1 : 0) == 0) break;
    at = close + 1;
    if (selectors.starts_with("@")) continue;  // of print, of fonts
    const std::string_view body = text.substr(open + 1, std::min(close, text.size()) - open - 1);
    for (std::size_t from = 0; from < selectors.size();) {
      const std::size_t end = std::min(selectors.find(',', from), selectors.size());
      const std::string_view one = trimmed(selectors.substr(from, end - from));
      from = end + 1;
      if (one.size() < 2 || one[0] != '.' || one.find_first_of(" .#:>[+~*", 1) != std::string_view::npos) continue;
      if (rules_.size() < kMostRules) declarationsOf(body, rules_[std::string(one.substr(1))]);
    }
  }
}

std::string SvgStyles::of(const XmlElement& element, const std::string& key) const {
  if (const std::string* style = element.find("style")) {
    std::map<std::string, std::string> own;
    declarationsOf(*style, own);
    if (const auto found = own.find(key); found != own.end()) return found->second;
  }
  if (const std::string* classes = element.find("class"); classes && !rules_.empty()) {
    std::string last;
    for (std::size_t at = 0; at < classes->size();) {
      const std::size_t end = std::min(classes->find_first_of(" \t\r\n", at), classes->size());
      if (const auto rule = rules_.find(classes->substr(at, end - at)); rule != rules_.end())
        if (const auto found = rule->second.find(key); found != rule->second.end()) last = found->second;
      at = end + 1;
    }
    if (!last.empty()) return last;
  }
  const std::string* own = element.find(key);
  return own ? *own : std::string();
}

bool isFromIllustrator(std::string_view svg, const XmlElement& root) {
  if (svg.substr(0, 4000).find("Adobe Illustrator") != std::string_view::npos) return true;
  // Its newer way out leaves no name, but a layer's name on the drawing itself.
  return root.find("data-name") != nullptr && root.find("id") != nullptr;
}

int pixelsPerInch(std::string_view svg, const XmlElement& root) {
  if (isFromIllustrator(svg, root)) return 72;
  const std::string* version = root.find("inkscape:version");
  if (!version) return 96;
  int major = 0, minor = 0;
  const char *at = version->data(), *end = at + version->size();
  const auto [point, bad] = std::from_chars(at, end, major);
  if (bad == std::errc{} && point != end && *point == '.') std::from_chars(point + 1, end, minor);
  return bad == std::errc{} && major == 0 && minor < 92 ? 90 : 96;
}

std::string illustratorName(std::string_view id) {
  // "_1_" at the end tells several things of one name apart.
  if (id.size() > 3 && id.back() == '_') {
    const std::size_t before = id.find_last_not_of("0123456789", id.size() - 2);
    if (before != std::string_view::npos && before > 0 && before + 2 < id.size() && id[before] == '_')
      id = id.substr(0, before);
  }
  std::string out;
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id.substr(i, 2) == "_x") {
      const std::size_t end = id.find('_', i + 2);
      std::uint32_t code = 0;
      if (end != std::string_view::npos && end - i >= 4 && end - i <= 7) {
        const auto [stop, bad] = std::from_chars(id.data() + i + 2, id.data() + end, code, 16);
        if (bad == std::errc{} && stop == id.data() + end && code >= 0x20 && code < 0x110000 &&
            !(code >= 0xD800 && code < 0xE000)) {
          appendUtf8(out, code);
          i = end;
          continue;
        }
      }
    }
    out += id[i];
  }
  return out;
}

}  // namespace karinui
