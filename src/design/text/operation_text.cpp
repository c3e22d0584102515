#include <algorithm>
#include <type_traits>

#include "design/text/formula_fields.h"
#include "design/text/value_text.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

template <class Do>
void forEachOperation(Do&& each) {
  [&]<std::size_t... i>(std::index_sequence<i...>) { (each(std::variant_alternative_t<i, PlainOperation>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<PlainOperation>>());
}

std::string quotedValue(std::string_view value) {
  const bool plain = !value.empty() && std::all_of(value.begin(), value.end(), [](char c) {
    return static_cast<unsigned char>(c) > ' ' && c != '"' && c != '\\' && c != '#' && c != 0x7f;
  });
  if (plain) return std::string(value);
  static constexpr char kHex[] = "0123456789abcdef";
  std::string all = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      all += {'\\', c};
    } else if (byte < ' ' || byte == 0x7f) {
      all += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      all += c;
    }
  }
  return all + '"';
}

int hexDigit(char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; }

struct KeyValue {
  std::string key, value;
};
struct Line {
  std::string name;
  std::vector<KeyValue> values;
};

// Takes a line apart into its name and key=value pairs; nothing is understood yet.
Result<Line> takenApart(std::string_view text) {
  Line line;
  std::size_t at = 0;
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  for (;;) {
    while (at < text.size() && blank(text[at])) ++at;
    if (at == text.size() || text[at] == '#') return line;
    std::string word;
    std::optional<std::size_t> equals;
    while (at < text.size() && !blank(text[at])) {
      const char c = text[at++];
      if (c == '=' && !equals) equals = word.size();
      if (c != '"') {
        word += c;
        continue;
      }
      for (;; ++at) {
        if (at == text.size())
          return badInput(say("The quotation mark after “{0}” is never closed.", word.substr(0, 40)));
        if (text[at] == '"') break;
        if (text[at] != '\\') {
          word += text[at];
        } else if (at + 1 < text.size() && (text[at + 1] == '"' || text[at + 1] == '\\')) {
          word += text[++at];
        } else if (at + 3 < text.size() && text[at + 1] == 'x' && hexDigit(text[at + 2]) >= 0 &&
                   hexDigit(text[at + 3]) >= 0) {
          word += static_cast<char>(hexDigit(text[at + 2]) * 16 + hexDigit(text[at + 3]));
          at += 3;
        } else {
          return badInput(say("After a backslash in quotation marks comes \\, a quotation mark, or x and two digits."));
        }
      }
      ++at;
    }
    if (line.name.empty() && !equals) {
      line.name = word;
    } else if (!equals || *equals == 0) {
      return badInput(
          say("“{0}” stands alone; write name=value, and put values with spaces in quotation marks.", word));
    } else {
      line.values.push_back({word.substr(0, *equals), word.substr(*equals + 1)});
    }
  }
}

// A value as text, or formulas that give it once there is a garment.
template <class Value>
Done readField(std::string_view name, std::string_view text, Value& value, std::vector<FieldText>& formulas) {
  Value read = value;
  const Done done = readValue(text, read);
  if (done) return value = std::move(read), Done();
  const std::string kind = kindOf(&value);
  const auto field = workedOutField(kind, text, [&](Formula&) -> Result<Quantity> {
    return Quantity{0, kind == "number" ? kPlainNumber : kind.ends_with("angle") ? kAngle : kLength};
  });
  if (!field) return seemsFormula(kind, text) ? field.error() : done;
  if (!field->any) return done;
  if (Done whole = readValue(field->plain, read); !whole) return whole;
  formulas.push_back({std::string(name), field->formulas});
  return {};
}

template <class Op>
Result<Operation> filled(const Line& line) {
  Op operation;
  std::vector<FieldText> formulas;
  Done trouble;
  std::size_t used = 0;
  std::string names;
  Op::fields(operation, [&](std::string_view name, auto& value, std::string_view, Need need) {
    names += (names.empty() ? "" : ", ") + std::string(name);
    const auto given = std::find_if(line.values.begin(), line.values.end(), [&](auto& v) { return v.key == name; });
    if (given == line.values.end()) {
      if (need == kNeeded && trouble) trouble = badInput(say("“{0}” needs {1}=….", Op::kName, name));
      return;
    }
    ++used;
    if (Done done = readField(name, given->value, value, formulas); !done && trouble) trouble = done.error();
  });
  for (std::size_t i = 0; i < line.values.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (line.values[i].key == line.values[j].key) return badInput(say("{0}= is given twice.", line.values[i].key));
    }
    if (("; " + names + ",").find(" " + line.values[i].key + ",") == std::string::npos) {
      return badInput(say("“{0}” knows no {1}=; it knows: {2}.", Op::kName, line.values[i].key, names));
    }
  }
  if (!trouble) return trouble.error();
  Operation all(std::move(operation));
  all.formulas = std::move(formulas);
  return all;
}

}  // namespace

bool operator==(const Operation& a, const Operation& b) {
  if (a.formulas != b.formulas) return false;
  if (a.formulas.empty()) return static_cast<const PlainOperation&>(a) == static_cast<const PlainOperation&>(b);
  return text(a) == text(b);
}

std::string_view nameOf(const Operation& operation) {
  return std::visit([](const auto& op) { return std::decay_t<decltype(op)>::kName; }, operation);
}

std::vector<FieldText> fieldTexts(const Operation& operation) {
  std::vector<FieldText> all;
  std::visit(
      [&](const auto& op) {
        using Op = std::decay_t<decltype(op)>;
        const Op usual;
        std::vector<std::string> defaults;
        Op::fields(usual, [&](auto, const auto& value, auto, Need) { defaults.push_back(writeValue(value)); });
        std::size_t i = 0;
        Op::fields(op, [&](std::string_view name, const auto& value, auto, Need need) {
          const auto formula = std::find_if(operation.formulas.begin(), operation.formulas.end(),
                                            [&](auto& f) { return f.name == name; });
          std::string written = formula == operation.formulas.end() ? writeValue(value) : formula->value;
          if (need == kNeeded || written != defaults[i]) all.push_back({std::string(name), std::move(written)});
          ++i;
        });
      },
      operation);
  return all;
}

std::string lineOf(std::string_view name, const std::vector<FieldText>& fields) {
  std::string line(name);
  for (const FieldText& field : fields) line += " " + field.name + "=" + quotedValue(field.value);
  return line;
}

std::string text(const Operation& operation) { return lineOf(nameOf(operation), fieldTexts(operation)); }

Result<Operation> parseOperation(std::string_view text) {
  const auto line = takenApart(text);
  if (!line) return line.error();
  std::optional<Result<Operation>> found;
  std::string names;
  forEachOperation([&](auto op) {
    using Op = decltype(op);
    names += (names.empty() ? "" : ", ") + std::string(Op::kName);
    if (line->name == Op::kName) found = filled<Op>(*line);
  });
  if (found) return *std::move(found);
  if (line->name.empty()) return badInput(say("There is no operation on this line; it begins with its name."));
  return badInput(say("There is no operation “{0}”; there are: {1}.", line->name.substr(0, 60), names));
}

namespace {

// Of an operation whose kind says what else it has: which kinds have a field, where not all do.
template <class Op>
void tellKinds(OperationHelp& help) {
  using Kind = typename decltype(Op::kind)::value_type;
  help.kindField = Op::kKindField;
  for (FieldHelp& field : help.fields) {
    const std::string words = kindOf(static_cast<const Kind*>(nullptr));
    std::size_t all = 0;
    for (std::size_t from = 0; from <= words.size(); ++all) {
      const std::size_t end = std::min(words.find('|', from), words.size());
      std::string word = words.substr(from, end - from);
      from = end + 1;
      Kind kind{};
      if (readValue(word, kind) && Op::has(kind, field.name)) field.kinds.push_back(std::move(word));
    }
    if (field.kinds.size() == all) field.kinds.clear();
  }
}

}  // namespace

std::vector<OperationHelp> operationHelp() {
  std::vector<OperationHelp> all;
  forEachOperation([&](auto op) {
    using Op = decltype(op);
    OperationHelp& help = all.emplace_back(OperationHelp{std::string(Op::kName), std::string(Op::kHelp), {}});
    Op::fields(op, [&](std::string_view name, auto& value, std::string_view what, Need need) {
      help.fields.push_back({std::string(name), kindOf(&value), std::string(what), writeValue(value), need == kNeeded});
    });
    if constexpr (requires { Op::kKindField; }) tellKinds<Op>(help);
  });
  return all;
}

Result<std::vector<ScriptLine>> parseScript(std::string_view script) {
  std::vector<ScriptLine> lines;
  if (script.starts_with("\xEF\xBB\xBF")) script.remove_prefix(3);
  if (script.find('\0') != std::string_view::npos) return badInput(say("This is not a script: it is not text."));
  int number = 0;
  while (!script.empty()) {
    const int first = number + 1;
    std::string line;
    for (bool more = true; more && !script.empty();) {
      const std::size_t end = script.find('\n');
      std::string_view part = script.substr(0, end);
      script.remove_prefix(end == std::string_view::npos ? script.size() : end + 1);
      ++number;
      while (!part.empty() && (part.back() == '\r' || part.back() == ' ' || part.back() == '\t')) part.remove_suffix(1);
      more = part.ends_with('\\');
      if (more) part.remove_suffix(1);
      line += part;
      if (more) line += ' ';
    }
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    auto operation = parseOperation(line);
    if (!operation) {
      return Error{operation.error().kind, say("Line {0}: {1}", first, operation.error().what)};
    }
    lines.push_back({first, *std::move(operation)});
  }
  return lines;
}

}  // namespace karinui
