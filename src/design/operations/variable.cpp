#include "design/formula/links.h"
#include "design/operations/operations.h"
#include "karinui/design/variables.h"

namespace karinui {

namespace {

// The variables whose formulas use this one.
std::string usersOf(const Document& document, const std::string& name) {
  std::string all;
  for (const auto& [own, text] : document.variables) {
    const auto formula = Formula::parse(text);
    if (!formula) continue;
    for (const FormulaTerm& term : formula->terms()) {
      if (term.kind != FormulaTerm::Kind::Name || term.word != name) continue;
      all += (all.empty() ? "" : ", ") + own;
      break;
    }
  }
  return all;
}

}  // namespace

Done resolve(const Document& before, SetVariable& op, Context& context) {
  constexpr std::size_t kMost = 500;
  const bool known = before.variables.contains(op.name);
  if (op.remove) {
    if (!op.value.empty()) return refused(say("A variable gets a value or is removed, not both."));
    if (!known) return refused(say("There is no variable “{0}”.", op.name));
    if (const std::string users = usersOf(before, op.name); !users.empty())
      return refused(say("“{0}” is used by {1}; change that first.", op.name, users));
    return {};
  }
  if (!known)
    if (Done done = checkVariableName(op.name); !done) return done;
  if (!known && before.variables.size() >= kMost) return refused(say("There are too many variables."));
  const auto read = Formula::parse(op.value);
  if (!read) return read.error();
  const auto formula = recordedFormula(*read, before);
  if (!formula) return formula.error();
  op.value = formula->text();
  if (const auto edge = linkedEdge(op.name)) {
    if (Done done = checkLink(before, *edge, op.value); !done) return done;
    DocumentNames names(before, context);
    const auto length = workedOut(op.value, names, kLength);
    return length ? Done() : Done(length.error());
  }
  Document after = before;
  after.variables[op.name] = op.value;
  const auto value = DocumentNames(after, context).named(op.name);
  return value ? Done() : Done(value.error());
}

Result<Document> perform(const Document& before, const SetVariable& op, Context&) {
  Document after = before;
  if (op.remove)
    after.variables.erase(op.name);
  else
    after.variables[op.name] = op.value;
  return after;
}

}  // namespace karinui
