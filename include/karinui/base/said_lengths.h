#pragma once
// Sentences with their lengths as the person reads them. The library measures in millimetres ("{0} mm" in a pattern);
// here those are said in other words. A name is never touched, whatever it holds. Thread-safe: values only.
#include "karinui/base/message.h"

namespace karinui {

using LengthWords = std::string (*)(double metres);  // metres in, "2.54 cm" or "1 in" out
std::string text(const Message& message, Language language, LengthWords lengths);

}  // namespace karinui
