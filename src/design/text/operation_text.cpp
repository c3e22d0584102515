#include <algorithm>

#include "design/text/field_table.h"
#include "design/text/formula_fields.h"
#include "design/text/units_meant.h"
#include "karinui/base/near_names.h"

namespace karinui {

namespace {

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
struct ParsedLine {
  std::string name;
  std::vector<KeyValue> values;
};

// Takes a line apart into its name and key=value pairs; nothing is understood yet.
Result<ParsedLine> parseLine(std::string_view text) {
  ParsedLine line;
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
Done readField(const FieldOf& field, std::string_view text, std::vector<FieldText>& formulas) {
  const std::string& kind = field.form->kind;
  const Done done = field.form->read(text, field.value);
  if (done) return done;
  const auto formula = workedOutField(kind, text, [&](Formula&) -> Result<Quantity> {
    return Quantity{0, kind == "number" ? kPlainNumber : kind.ends_with("angle") ? kAngle : kLength};
  });
  if (!formula) return seemsFormula(kind, text) ? formula.error() : done;
  if (!formula->any) {  // numbers with blanks within, as 27 1/2in
    const Done plain = field.form->read(formula->plain, field.value);
    return plain ? plain : done;
  }
  if (Done whole = field.form->read(formula->plain, nullptr); !whole) return whole;
  formulas.push_back({std::string(field.name), formula->formulas});
  return {};
}

Result<Operation> filled(const OperationForm& form, const ParsedLine& line) {
  Operation operation = form.make();
  std::vector<FieldText> formulas;
  Done trouble;
  std::string names;
  for (const FieldOf& field : form.fields(operation)) {
    names += (names.empty() ? "" : ", ") + std::string(field.name);
    const auto given =
        std::find_if(line.values.begin(), line.values.end(), [&](auto& v) { return v.key == field.name; });
    if (given == line.values.end()) {
      if (field.need == kNeeded && trouble) trouble = badInput(say("“{0}” needs {1}=….", form.name, field.name));
      continue;
    }
    // u,v is a direction there, and gravity is an acceleration
    const bool other = form.name == SetGrain::kName || field.name == "grain" || field.name == "gravity";
    Done done = other ? Done() : unitsMeant(field.form->kind, given->value);
    if (done) done = readField(field, given->value, formulas);
    if (!done && trouble) trouble = done.error();
  }
  for (std::size_t i = 0; i < line.values.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (line.values[i].key == line.values[j].key) return badInput(say("{0}= is given twice.", line.values[i].key));
    }
    if (("; " + names + ",").find(" " + line.values[i].key + ",") == std::string::npos) {
      return badInput(say("“{0}” knows no {1}=; it knows: {2}.", form.name, line.values[i].key, names));
    }
  }
  if (!trouble) return trouble.error();
  operation.formulas = std::move(formulas);
  return operation;
}

}  // namespace

bool operator==(const Operation& a, const Operation& b) {
  if (a.formulas != b.formulas) return false;
  if (a.formulas.empty()) return static_cast<const PlainOperation&>(a) == static_cast<const PlainOperation&>(b);
  return text(a) == text(b);
}

std::string_view nameOf(const Operation& operation) { return formOf(operation).name; }

std::vector<FieldText> fieldTexts(const Operation& operation) {
  const OperationForm& form = formOf(operation);
  std::vector<FieldText> all;
  std::size_t i = 0;
  // Only read from: the table is one for reading and writing.
  for (const FieldOf& field : form.fields(const_cast<Operation&>(operation))) {
    const auto formula = std::find_if(operation.formulas.begin(), operation.formulas.end(),
                                      [&](auto& f) { return f.name == field.name; });
    std::string written = formula == operation.formulas.end() ? field.form->write(field.value) : formula->value;
    if (field.need == kNeeded || written != form.usual[i]) all.push_back({std::string(field.name), std::move(written)});
    ++i;
  }
  return all;
}

std::string lineOf(std::string_view name, const std::vector<FieldText>& fields) {
  std::string line(name);
  for (const FieldText& field : fields) line += " " + field.name + "=" + quotedValue(field.value);
  return line;
}

std::string text(const Operation& operation) { return lineOf(nameOf(operation), fieldTexts(operation)); }

Result<Operation> parseOperation(std::string_view text) {
  const auto line = parseLine(text);
  if (!line) return line.error();
  std::vector<std::string> names;
  for (const OperationForm& form : operationForms()) {
    if (line->name == form.name) return filled(form, *line);
    names.emplace_back(form.name);
  }
  if (line->name.empty()) return badInput(say("There is no operation on this line; it begins with its name."));
  const std::string wanted = line->name.substr(0, 60);
  const auto joined = [](const std::vector<std::string>& all) {
    std::string list;
    for (const std::string& name : all) list += (list.empty() ? "" : ", ") + name;
    return list;
  };
  if (const auto near = nearNames(wanted, names); !near.empty())
    return badInput(say("There is no operation “{0}”; near names: {1}.", wanted, joined(near)));
  return badInput(say("There is no operation “{0}”; there are: {1}.", wanted, joined(names)));
}

std::vector<OperationHelp> operationHelp() {
  std::vector<OperationHelp> all;
  for (const OperationForm& form : operationForms()) {
    OperationHelp& help = all.emplace_back(OperationHelp{std::string(form.name), std::string(form.help), {}});
    help.kindField = form.kindField;
    Operation usual = form.make();
    std::size_t i = 0;
    for (const FieldOf& field : form.fields(usual)) {
      help.fields.push_back(
          {std::string(field.name), field.form->kind, std::string(field.help), form.usual[i++], field.need == kNeeded});
      if (form.kindsWith) help.fields.back().kinds = form.kindsWith(field.name);
    }
  }
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
