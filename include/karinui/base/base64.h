#pragma once
// Bytes as letters of RFC 4648, with padding, without line breaks. Exact inverses. Pure; any thread.
#include <optional>
#include <string>
#include <string_view>

namespace karinui {

std::string base64(std::string_view bytes);
// Nothing where the text is not what base64() writes: another letter, no padding, bits left over.
std::optional<std::string> fromBase64(std::string_view text);

}  // namespace karinui
