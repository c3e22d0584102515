// Sentences that show how a script says a thing, for those who have the dialogs' labels instead.
#include <algorithm>
#include <map>

#include "karinui/design/step_words.h"

namespace karinui {

namespace {

struct ScriptField {
  std::string key, value;
};
// "hem edges=front.hem width=3cm" within a sentence.
struct ScriptPart {
  std::string operation;  // empty: fields only
  std::vector<ScriptField> fields;
  std::size_t size = 0;  // letters of the sentence
};

bool letterOfWord(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }
std::size_t wordEnd(std::string_view text, std::size_t at) {
  while (at < text.size() && letterOfWord(text[at])) ++at;
  return at;
}

constexpr std::string_view kAndSoOn = "…";

// A value ends where the sentence goes on: at a space, at what no script writes, before the sentence's own stops.
std::size_t valueEnd(std::string_view text, std::size_t at) {
  if (at < text.size() && text[at] == '"') return std::min(text.find('"', at + 1), text.size() - 1) + 1;
  static constexpr std::string_view kWithin = ".,:;-+*/@#{}_";
  std::size_t end = at;
  for (std::size_t i = at; i < text.size();) {
    const char c = text[i];
    const bool more = text.substr(i).starts_with(kAndSoOn);
    if (!more && !std::isalnum(static_cast<unsigned char>(c)) && kWithin.find(c) == std::string_view::npos) break;
    i += more ? kAndSoOn.size() : 1;
    if (more || std::string_view(".,:;").find(c) == std::string_view::npos) end = i;
  }
  return end;
}

const std::vector<OperationHelp>& operations() {
  static const std::vector<OperationHelp> all = operationHelp();
  return all;
}

// What stands at `at`, where a word begins.
std::optional<ScriptPart> scriptAt(std::string_view text, std::size_t at) {
  ScriptPart part;
  std::size_t next = at;
  if (const std::size_t end = wordEnd(text, at); end < text.size() && text[end] == ' ') {
    const std::string_view word = text.substr(at, end - at);
    const auto& all = operations();
    if (std::none_of(all.begin(), all.end(), [&](const OperationHelp& one) { return one.name == word; }))
      return std::nullopt;
    part.operation = word;
    next = end + 1;
  }
  for (;;) {
    const std::size_t end = wordEnd(text, next);
    if (end == next || end >= text.size() || text[end] != '=') break;
    const std::size_t stop = valueEnd(text, end + 1);
    std::string_view value = text.substr(end + 1, stop - end - 1);
    if (value.size() > 1 && value.front() == '"') value = value.substr(1, value.size() - 2);
    part.fields.push_back({std::string(text.substr(next, end - next)), std::string(value)});
    part.size = stop - at;
    if (stop >= text.size() || text[stop] != ' ') break;
    next = stop + 1;
  }
  return part.fields.empty() ? std::nullopt : std::optional(part);
}

bool saysNothing(const std::string& value) { return value.empty() || value.find(kAndSoOn) != std::string::npos; }

const FieldHelp* fieldOf(const OperationHelp& operation, const std::string& key) {
  const auto found =
      std::find_if(operation.fields.begin(), operation.fields.end(), [&](const FieldHelp& f) { return f.name == key; });
  return found == operation.fields.end() ? nullptr : &*found;
}

// In words; nothing: a field of this kind has no such value.
std::optional<Message> readAs(const OperationHelp& operation, const FieldHelp& field, const std::string& value) {
  if (value.starts_with('{')) return say("{0}", value);
  const Message said = valueSaid(Document(), operation.name, field, value);
  if (text(said) != value) return said;
  const bool name = field.kind.ends_with("name") && checkName(value);
  return name || field.kind.ends_with("number") || field.kind.ends_with("piece") ? std::optional(said) : std::nullopt;
}

// The operations that may be meant: those that have all the fields, and can read their values if there are any such.
std::vector<const OperationHelp*> meant(const ScriptPart& part, std::string_view english) {
  std::vector<const OperationHelp*> able, reading;
  for (const OperationHelp& operation : operations()) {
    if (!part.operation.empty() && operation.name != part.operation) continue;
    bool has = true, reads = true;
    for (const ScriptField& given : part.fields) {
      const FieldHelp* field = fieldOf(operation, given.key);
      has = has && field;
      reads = reads && field && (saysNothing(given.value) || readAs(operation, *field, given.value));
    }
    if (has) able.push_back(&operation);
    if (has && reads) reading.push_back(&operation);
  }
  if (!reading.empty()) able = reading;
  // The one the sentence speaks of.
  std::vector<const OperationHelp*> named;
  std::copy_if(able.begin(), able.end(), std::back_inserter(named),
               [&](const OperationHelp* one) { return english.find(one->name) != std::string_view::npos; });
  return named.empty() ? able : named;
}

// "“On both halves: No”"; nothing: no words of ours.
std::optional<std::string> inLabels(const ScriptPart& part, std::string_view english, Language language) {
  const bool labelsOnly = english.starts_with("Say ");  // what it shows is an example only
  const auto all = meant(part, english);
  std::vector<Message> said;
  for (const ScriptField& given : part.fields) {
    if (all.empty()) {
      const auto measure = termSaid(Term::Measure, given.key);
      if (!measure) return std::nullopt;
      said.push_back(say("{0}: {1}", *measure, given.value));
      continue;
    }
    // The label that most of them give it.
    std::map<std::string, int> votes;
    const OperationHelp* first = nullptr;
    int most = 0;
    for (const OperationHelp* one : all) ++votes[text(fieldSaid(one->name, given.key))];
    for (const OperationHelp* one : all)
      if (const int own = votes[text(fieldSaid(one->name, given.key))]; own > most) most = own, first = one;
    const Message label = fieldSaid(first->name, given.key);
    const bool value = !labelsOnly && !saysNothing(given.value);
    said.push_back(
        !value ? label
               : say("{0}: {1}", label,
                     readAs(*first, *fieldOf(*first, given.key), given.value).value_or(say("{0}", given.value))));
  }
  Message whole = listSaid(said);
  if (!part.operation.empty())
    whole = say("{0} ({1})", termSaid(Term::OperationName, part.operation).value_or(say("{0}", part.operation)), whole);
  return text(whole, language);
}

bool endsWithQuote(const std::string& text) { return text.ends_with("“") || text.ends_with("「"); }

}  // namespace

std::string withoutScript(std::string_view english, std::string_view pattern, Language language) {
  if (pattern.find('=') == std::string_view::npos) return std::string(pattern);
  std::string said;
  for (std::size_t i = 0; i < pattern.size();) {
    const bool begins =
        letterOfWord(pattern[i]) &&
        (i == 0 || (!std::isalnum(static_cast<unsigned char>(pattern[i - 1])) && pattern[i - 1] != '-'));
    const auto part = begins ? scriptAt(pattern, i) : std::nullopt;
    const auto labels = part ? inLabels(*part, english, language) : std::nullopt;
    if (labels) {
      const char* const marks[2] = {language == Language::Japanese ? "「" : "“",
                                    language == Language::Japanese ? "」" : "”"};
      const bool quoted = endsWithQuote(said);
      if (language == Language::Japanese && said.ends_with(' ')) said.pop_back();
      said += (quoted ? "" : marks[0]) + *labels + (quoted ? "" : marks[1]);
      i += part->size;
      if (language == Language::Japanese && i < pattern.size() && pattern[i] == ' ') ++i;
      continue;
    }
    // A word that is none of these is taken whole.
    const std::size_t end = begins ? wordEnd(pattern, i) : i + 1;
    said += pattern.substr(i, end - i);
    i = end;
  }
  return said;
}

}  // namespace karinui
