#pragma once
// Fields of operations whose numbers are given by formulas: "bust_girth/4 + 1cm" for a length, "0,waist_height/3" for a
// place, "M 0 0; hem L (bust_girth/4) 0; …" for an outline.
#include <functional>
#include <string>
#include <string_view>

#include "karinui/design/formula.h"

namespace karinui {

struct FieldWorkedOut {
  std::string formulas;  // the field's text in canonical form
  std::string plain;     // the same with numbers, as readValue() takes it
  bool any = false;      // there is a formula in it
};

// `kind` as kindOf() says it. `value` is asked for each formula in turn, and may exchange it by another (with ids for
// names). Refuses kinds that hold no numbers.
using FormulaValue = std::function<Result<Quantity>(Formula&)>;
Result<FieldWorkedOut> workedOutField(std::string_view kind, std::string_view text, const FormulaValue& value);

// Whether a text that is no plain value seems to be meant as a formula.
bool seemsFormula(std::string_view kind, std::string_view text);

}  // namespace karinui
