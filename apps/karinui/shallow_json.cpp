#include "shallow_json.h"

#include <algorithm>
#include <string>

namespace karinui::app {

namespace {

// How deep a text's values lie: one in the outermost object lies at 1.
class Depths : public nlohmann::json_sax<Json> {
 public:
  bool tooDeep() const { return deepest_ > kDeepestJson; }

  bool null() override { return here(); }
  bool boolean(bool) override { return here(); }
  bool number_integer(number_integer_t) override { return here(); }
  bool number_unsigned(number_unsigned_t) override { return here(); }
  bool number_float(number_float_t, const string_t&) override { return here(); }
  bool string(string_t&) override { return here(); }
  bool binary(binary_t&) override { return here(); }
  bool key(string_t&) override { return here(); }
  bool start_object(std::size_t) override { return begins(); }
  bool start_array(std::size_t) override { return begins(); }
  bool end_object() override { return ends(); }
  bool end_array() override { return ends(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool here() {
    deepest_ = std::max(deepest_, open_);
    return true;
  }
  bool begins() {
    here();
    ++open_;
    return true;
  }
  bool ends() {
    --open_;
    return true;
  }
  int open_ = 0, deepest_ = 0;
};

}  // namespace

// Looked at first and read then. The library can drop what lies too deep while it reads, but looks through all that an
// array holds so far at the end of each of its objects: a hundred thousand of them took a minute.
std::optional<Json> shallowJson(std::string_view text, bool* deep) {
  Depths depths;
  if (!Json::sax_parse(text, &depths)) return std::nullopt;
  if (deep) *deep = depths.tooDeep();
  if (depths.tooDeep()) return std::nullopt;
  return Json::parse(text, nullptr, false);
}

}  // namespace karinui::app
