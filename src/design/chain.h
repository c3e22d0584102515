#pragma once
#include <string>

#include "karinui/base/hash.h"
#include "karinui/design/script.h"

namespace karinui {

// The hash of all operations up to this one, from that of those before it (empty: there were none).
inline std::string chained(const std::string& before, const Operation& operation) {
  return Hasher().add(std::string_view(before)).add(std::string_view(text(operation))).hex();
}

}  // namespace karinui
