#pragma once
// A sentence for a person, kept as an English pattern and its values so that it can be said in any language.
//   say("The line crosses itself {0} mm from the {1}.", "12", "shoulder")
// The pattern is the key of the Japanese catalogue (data/messages.ja.tsv); a check finds patterns without a
// translation. A value may itself be a sentence, which is then said in the same language: say("Line {0}: {1}", 4,
// error.what). Thread-safe: values only.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace karinui {

enum class Language { English, Japanese };

struct Message {
  struct Value;
  // English, with {0} {1} … where the values go; "{0} {0|edge|edges}" is "1 edge", "2 edges".
  std::string pattern;
  std::vector<Value> values;  // at most ten
  bool empty() const { return pattern.empty(); }
};
// Already written out (numbers with their unit, names), or a sentence within the sentence.
struct Message::Value : std::variant<std::string, Message> {
  using variant::variant;
};

// Writes a value into a sentence: text as it is, numbers in their shortest exact form.
std::string written(double value);
std::string written(long long value);
inline std::string written(int value) { return written(static_cast<long long>(value)); }
inline std::string written(std::size_t value) { return written(static_cast<long long>(value)); }
inline std::string written(std::string_view value) { return std::string(value); }
inline std::string written(const char* value) { return value; }
inline std::string written(const std::string& value) { return value; }
inline Message written(const Message& value) { return value; }

template <class... Values>
Message say(std::string_view pattern, const Values&... values) {
  return Message{std::string(pattern), {Message::Value(written(values))...}};
}

// The sentence in a language; a pattern that has no translation is said in English.
std::string text(const Message& message, Language language = Language::English);
std::string text(const Message::Value& value, Language language = Language::English);

// The person's language from the environment (LC_ALL, LC_MESSAGES, LANG): Japanese if it begins with "ja".
Language spokenHere();

}  // namespace karinui
