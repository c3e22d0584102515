#pragma once
// Sentences with their lengths and names as the person reads them. The library measures in millimetres ("{0} mm" in a
// pattern; "{0} cm" where it speaks of a body); here those are said in other words. A value that is an identifier is
// said by its name; any other is never touched, whatever it holds. A pattern may be said otherwise, too. Thread-safe:
// values only.
#include <functional>
#include <optional>

#include "karinui/base/message.h"

namespace karinui {

using LengthWords = std::string (*)(double metres);  // metres in, "2.54 cm" or "1 in" out
using NameWords = std::function<std::optional<Message>(std::string_view identifier)>;  // nothing: say it as it is
using PatternWords = std::string (*)(std::string_view english, std::string_view pattern, Language language);
std::string text(const Message& message, Language language, LengthWords lengths, const NameWords& names = nullptr,
                 PatternWords patterns = nullptr);

}  // namespace karinui
