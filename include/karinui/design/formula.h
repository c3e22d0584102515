#pragma once
// Numbers given by formulas: "bust_girth/4 + 1.5cm", "front.side_left + back.side_left", "atan(3cm/10cm)". A formula
// knows units and dimensions: a length and a plain number are never added, sin() wants an angle, and nothing is ever
// read as degrees that was not written so. What its names stand for is asked from FormulaNames (variables.h for those
// of a garment).
//
//   sum      product + product - product
//   product  factor * factor / factor
//   factor   -factor, operand ^ factor
//   operand  1.5cm (mm, cm, m, in, deg, rad, %), name, piece.edge, [piece.edge@0:0.5], function(sum, ...), (sum)
//
// Strangers' text is welcome: length, depth and count are bounded. Two exact inverses: parse(text()) is the same
// formula term by term. Plain values; any thread.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/design/values.h"

namespace karinui {

// Powers of metre and radian: {1, 0} a length, {0, 1} an angle, {0, 0} a plain number, {2, 0} an area.
struct Dimension {
  int length = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};
inline constexpr Dimension kLength{1, 0}, kAngle{0, 1}, kPlainNumber{0, 0};
Message dimensionSaid(Dimension dimension);  // "a length"

struct Quantity {
  double value = 0;  // metres, radians, square metres …
  Dimension dimension;
  bool operator==(const Quantity&) const = default;
};

struct FormulaTerm {
  enum class Kind { Number, Name, Edge, Negate, Add, Subtract, Multiply, Divide, Power, Call };
  Kind kind = Kind::Number;
  double number = 0;          // Number: as written, before its unit
  std::string word = {};      // Number: its unit; Name; Call: the function
  EdgeRef edge = {};          // Edge: its length is meant
  bool mirrored = false;      // Edge: that of its mirror image
  std::size_t arguments = 0;  // Call
  bool operator==(const FormulaTerm&) const = default;
};

class Formula {
 public:
  static Result<Formula> parse(std::string_view text);
  std::string text() const;  // the canonical form

  // The operands before what is done with them: "a + b*c" is a b c * +.
  const std::vector<FormulaTerm>& terms() const { return terms_; }
  // The same formula with other terms in place of each name and edge; refused as soon as `change` refuses one.
  Result<Formula> changed(const std::function<Done(FormulaTerm&)>& change) const;

  bool operator==(const Formula&) const = default;

 private:
  explicit Formula(std::vector<FormulaTerm> terms) : terms_(std::move(terms)) {}
  std::vector<FormulaTerm> terms_;
};

class FormulaNames {
 public:
  virtual ~FormulaNames() = default;
  virtual Result<Quantity> named(const std::string& name) = 0;
  virtual Result<double> edgeLength(const EdgeRef& edge, bool mirrored) = 0;  // metres
};

// Refuses what has no finite value, and dimensions that do not go together; the sentence quotes the part of the
// formula.
Result<Quantity> evaluate(const Formula& formula, FormulaNames& names);

// A name that a formula can use and that means nothing else: no unit, no function, no measure.
Done checkVariableName(std::string_view name);

}  // namespace karinui
