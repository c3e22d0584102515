#include "strict_json.h"

#include <algorithm>
#include <set>
#include <vector>

#include "exchange/names.h"

namespace karinui {
namespace {

// Watches the parser's events and stops it; the tree itself is built by a second pass, which then cannot fail.
class Watch : public nlohmann::json_sax<Json> {
 public:
  explicit Watch(std::string_view text) : text_(text) {}
  Message wrong;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t value, const string_t& text) override {
    if (std::isfinite(value)) return true;
    wrong = say("The number {0} is too large.", shown(text));
    return false;
  }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return deeper();
  }
  bool key(string_t& name) override {
    if (keys_.back().insert(name).second) return true;
    wrong = say("The key \"{0}\" stands twice in one object; only one can be meant.", shown(name));
    return false;
  }
  bool end_object() override {
    keys_.pop_back();
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override { return deeper(); }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception&) override {
    const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t column = before.size() - (line == 1 ? 0 : before.rfind('\n') + 1) + 1;
    wrong = position > text_.size()
                ? say("The JSON breaks off in line {0}, column {1}: the file is not whole.", line, column)
                : say("This is not JSON: line {0}, column {1}, near \"{2}\".", line, column, shown(token));
    return false;
  }

 private:
  bool deeper() {
    if (++depth_ <= kDeepestJson) return true;
    wrong = say("The JSON is nested more than {0} levels deep.", kDeepestJson);
    return false;
  }
  std::string_view text_;
  int depth_ = 0;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Result<Json> parseStrictJson(std::string_view text) {
  if (text.size() > kLargestJson)
    return badInput(
        say("The JSON is too large: {0} MB, at most {1} MB are read.", text.size() >> 20, kLargestJson >> 20));
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return badInput(say("The file is empty."));
  try {
    Watch watch(text);
    if (!Json::sax_parse(text.begin(), text.end(), &watch)) return badInput(std::move(watch.wrong));
    return Json::parse(text.begin(), text.end());
  } catch (const std::exception& problem) {
    return badInput(say("This JSON cannot be read: {0}.", shown(problem.what())));
  }
}

const Json* member(const Json& value, const char* key) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(key);
  return found == value.end() ? nullptr : &*found;
}

bool isFinite(const Json& value) {
  return value.is_number() && std::isfinite(value.get<double>()) && std::abs(value.get<double>()) <= 1e9;
}

bool isPoint(const Json& value, std::size_t dimensions) {
  if (!value.is_array() || value.size() != dimensions) return false;
  for (const Json& number : value)
    if (!isFinite(number)) return false;
  return true;
}

std::string shown(std::string_view name) {
  std::string out;
  const std::string_view begin = name.substr(0, 80);
  for (std::size_t i = 0; i < begin.size();) {
    const std::size_t count = utf8Length(name, i);
    const auto byte = static_cast<unsigned char>(name[i]);
    if (count > 0 && i + count > begin.size()) break;
    if (count == 0)
      out += "\xEF\xBF\xBD";
    else if (byte < 0x20 || byte == 0x7f)
      out += ' ';
    else
      out += name.substr(i, count);
    i += std::max<std::size_t>(count, 1);
  }
  if (begin.size() < name.size()) out += "…";
  return out;
}

}  // namespace karinui
