#pragma once
// A stranger's JSON. Values are copied, compared and written level by level, each on the stack: what is nested too deep
// is not held. Any thread.
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace karinui::app {

using Json = nlohmann::ordered_json;

inline constexpr int kDeepestJson = 64;

// Nothing: it is no JSON, or nested deeper than kDeepestJson, which `deep` then says.
std::optional<Json> shallowJson(std::string_view text, bool* deep = nullptr);

}  // namespace karinui::app
