#include "shallow_json.h"

namespace karinui::app {

std::optional<Json> shallowJson(std::string_view text, bool* deep) {
  bool tooDeep = false;
  // What lies too deep is dropped while it is read.
  const auto shallow = [&tooDeep](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepestJson) tooDeep = true;
    return depth <= kDeepestJson;
  };
  Json all = Json::parse(text, shallow, false);
  if (all.is_discarded()) return std::nullopt;
  if (deep) *deep = tooDeep;
  if (tooDeep) return std::nullopt;
  return all;
}

}  // namespace karinui::app
