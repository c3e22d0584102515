#pragma once
// JSON from strangers: refused when too deep, too large, with a key twice or with a number that is none; and readers of
// its values that say where something is wrong.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t kLargestJson = std::size_t{64} << 20;  // bytes
inline constexpr int kDeepestJson = 64;

Result<Json> parseStrictJson(std::string_view text);

// A member of an object, or null: never throws, `value` may be anything.
const Json* member(const Json& value, const char* key);

bool isFinite(const Json& value);                         // a finite number within +-1e9
bool isPoint(const Json& value, std::size_t dimensions);  // a list of that many finite numbers
inline Flat flatOf(const Json& value) { return {value[0].get<double>(), value[1].get<double>()}; }
inline Vec3 vec3Of(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

// A name from a file, made fit to be shown in a sentence: short and without line breaks.
std::string shown(std::string_view name);

}  // namespace karinui
