#pragma once
// Reads numbers out of JSON where it lies, without allocating: for the servo's thread. Of what is no JSON it says that
// it is not there.
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace karinui {

class JsonScan {
 public:
  explicit JsonScan(std::string_view text) : text_(text) {}

  // The value of an object's member, of an array's first element: again as text. Nothing: not there.
  std::optional<JsonScan> member(std::string_view name) const {
    std::string_view rest = text_;
    if (!take(rest, '{')) return std::nullopt;
    while (!take(rest, '}')) {
      std::string_view key, value;
      if (!string(rest, key) || !take(rest, ':') || !skip(rest, value)) return std::nullopt;
      if (key == name) return JsonScan(value);
      take(rest, ',');
    }
    return std::nullopt;
  }
  template <class Visit>  // visit(JsonScan element) -> bool: go on
  void each(Visit&& visit) const {
    std::string_view rest = text_;
    if (!take(rest, '[')) return;
    while (!take(rest, ']')) {
      std::string_view value;
      if (!skip(rest, value) || !visit(JsonScan(value))) return;
      take(rest, ',');
    }
  }
  std::optional<double> number() const {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;  // no nan, no inf
  }
  std::optional<double> number(std::string_view name) const {
    const auto found = member(name);
    return found ? found->number() : std::nullopt;
  }
  // A boolean, or `otherwise`.
  bool flag(std::string_view name, bool otherwise) const {
    const auto found = member(name);
    if (!found) return otherwise;
    return found->text_ == "true" || (found->text_ != "false" && found->text_ != "0" && otherwise);
  }
  bool isString(std::string_view value) const {
    return text_.size() == value.size() + 2 && text_.front() == '"' && text_.substr(1, value.size()) == value;
  }
  std::string_view text() const { return text_; }

 private:
  static void space(std::string_view& rest) {
    const std::size_t at = rest.find_first_not_of(" \t\r\n");
    rest.remove_prefix(at == std::string_view::npos ? rest.size() : at);
  }
  static bool take(std::string_view& rest, char one) {
    space(rest);
    if (rest.empty() || rest.front() != one) return false;
    rest.remove_prefix(1);
    return true;
  }
  static bool string(std::string_view& rest, std::string_view& inside) {
    if (!take(rest, '"')) return false;
    std::size_t end = 0;
    while (end < rest.size() && rest[end] != '"') end += rest[end] == '\\' ? 2 : 1;
    if (end >= rest.size()) return false;
    inside = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    return true;
  }
  // Over one value of any kind.
  static bool skip(std::string_view& rest, std::string_view& value) {
    space(rest);
    const std::string_view from = rest;
    int deep = 0;
    do {
      space(rest);
      if (rest.empty()) return false;
      const char one = rest.front();
      std::string_view ignored;
      if (one == '"') {
        if (!string(rest, ignored)) return false;
      } else if (one == '{' || one == '[') {
        ++deep, rest.remove_prefix(1);
      } else if (one == '}' || one == ']') {
        if (--deep < 0) return false;
        rest.remove_prefix(1);
      } else if (one == ',' || one == ':') {
        if (deep == 0) return false;
        rest.remove_prefix(1);
      } else {
        const std::size_t end = rest.find_first_of(",:{}[]\" \t\r\n");
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end);
      }
    } while (deep > 0);
    value = from.substr(0, from.size() - rest.size());
    return !value.empty();
  }
  std::string_view text_;
};

}  // namespace karinui
