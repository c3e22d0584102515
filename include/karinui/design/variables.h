#pragma once
// What the names in a garment's formulas stand for: its variables, the figure's measures, and the lengths of its edges
// as they are now. A measure that was typed is taken as typed, any other as the tape finds it on the figure.
#include <map>
#include <optional>

#include "karinui/design/apply.h"
#include "karinui/design/formula.h"

namespace karinui {

// For one document, which must outlive it; each variable is worked out once. The figure is asked for when a measure is
// that was not typed. One thread.
class DocumentNames : public FormulaNames {
 public:
  using Figure = std::function<Result<BodyPtr>()>;
  DocumentNames(const Document& document, Figure figure) : document_(document), figure_(std::move(figure)) {}
  DocumentNames(const Document& document, Context& context);
  // Refuses what is neither, and variables that go round in a circle, naming it: "a → b → a".
  Result<Quantity> named(const std::string& name) override;
  Result<double> edgeLength(const EdgeRef& edge, bool mirrored) override;

 private:
  const Document& document_;
  Figure figure_;
  std::map<std::string, Quantity> known_;
  std::vector<std::string> asking_;  // the variables that are being worked out, each by the one before
};

// The formula as it is recorded: edges by the ids of their pieces, measures by their keys ("bust", "バスト" ->
// bust_girth), so that its meaning no longer depends on what things are called. Refuses edges that are not there.
Result<Formula> recordedFormula(const Formula& formula, const Document& document);

// One row of the table of variables.
struct VariableRow {
  std::string name, formula;
  Result<Quantity> value;  // what it is now, or why it has none: an edge that is gone
};
std::vector<VariableRow> variablesOf(const Document& document, DocumentNames& names);

// A formula typed somewhere, and what it is now. Refuses what is not of the dimension, if one is asked for.
Result<Quantity> workedOut(std::string_view formula, DocumentNames& names, std::optional<Dimension> wanted = {});
// Sets the value of every stated measure that has a formula. Names in them are measures stated beside, or those of the
// size; refuses others, and circles.
Done workOutStated(SetBody& body);
// "36.4 cm", "30.0°", "0.25"
std::string quantitySaid(Quantity quantity, bool inches);

}  // namespace karinui
