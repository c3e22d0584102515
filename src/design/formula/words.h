#pragma once
// The units and functions that formulas know.
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "karinui/design/formula.h"

namespace karinui {

struct FormulaUnit {
  std::string_view name;
  double perUnit;  // how many of it make one metre, radian or whole: dividing keeps 12mm the double nearest to 0.012
  Dimension dimension;
};
const FormulaUnit* formulaUnit(std::string_view name);  // null: there is none; "" is a plain number

enum class FormulaRule {
  Same,     // all of one dimension, and so is the result
  Root,     // half the dimension
  OfAngle,  // an angle makes a plain number
  ToAngle,  // a plain number makes an angle
};
struct FormulaFunction {
  std::string_view name;
  std::size_t least, most;  // how many arguments
  FormulaRule rule;
  double (*apply)(std::span<const double> arguments);
};
const FormulaFunction* formulaFunction(std::string_view name);  // null: there is none
std::string_view formulaFunctions();                            // "abs, acos, …"

inline constexpr std::string_view kMirror = "mirror";  // mirror(piece.edge)

}  // namespace karinui
