#pragma once
// Operations as text, one a line: `sew a=front.side_left b=back.side_left`. Values with spaces in quotes, lists with
// ";" or spaces between, # begins a comment, a backslash at the end of a line continues it. Two exact inverses:
// parseOperation(text(op)) == op bit for bit, and text(parse(line)) is the canonical form. docs/format/operations.md.
// Pure; any thread. What cannot be read is BadInput and names the word that is wrong.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

std::string text(const Operation& operation);
Result<Operation> parseOperation(std::string_view line);
// Operations' text without the noise of arithmetic in its lengths: 93.26mm where 93.26000000000001mm is the same
// number. What is read of it is what was written, bit for bit; the text that is hashed, text(operation), stays as it
// is.
std::string withShortLengths(std::string_view operations);
// Refuses a typed length of 2 or more without a unit: it would be metres, and centimetres are meant.
Done unitMeant(std::string_view length);

struct ScriptLine {
  int number = 0;  // of its first line, from 1
  Operation operation;
};
Result<std::vector<ScriptLine>> parseScript(std::string_view script);  // errors name the line

// An operation's fields as names and text, for JSON and lists. Fields that have their default are left out.
std::vector<FieldText> fieldTexts(const Operation& operation);
// The line of an operation of this name with these fields, for parseOperation().
std::string lineOf(std::string_view name, const std::vector<FieldText>& fields);

// What there is, for --help and the manual; grown from the operations' own field lists.
struct FieldHelp {
  std::string name, kind, help, usual;  // usual: the default as text
  bool needed = false;
  std::vector<std::string> kinds = {};  // the values of OperationHelp::kindField that have it; empty: all
};
struct OperationHelp {
  std::string name, help;
  std::vector<FieldHelp> fields;
  std::string kindField = {};  // the field that says of what kind it is, where other fields depend on that
};
std::vector<OperationHelp> operationHelp();

// An outline as text in millimetres, exact: "M u v; name L u v; name C u v u v u v; name A bulge u v".
std::string text(const Outline& outline);
Result<Outline> parseOutline(std::string_view text);  // read, not checked()

}  // namespace karinui
