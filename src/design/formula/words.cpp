#include "design/formula/words.h"

#include <algorithm>
#include <numbers>

#include "karinui/body/measurements.h"

namespace karinui {

namespace {

using Arguments = std::span<const double>;

constexpr FormulaUnit kUnits[]{
    {"", 1, kPlainNumber}, {"%", 100, kPlainNumber},    {"m", 1, kLength},  {"cm", 100, kLength},
    {"mm", 1000, kLength}, {"in", 1 / 0.0254, kLength}, {"rad", 1, kAngle}, {"deg", 180 / std::numbers::pi, kAngle}};

// sin, cos and the like are those of the C library: their last bit may differ between machines, as all of a drape may.
constexpr FormulaFunction kFunctions[]{
    {"abs", 1, 1, FormulaRule::Same, [](Arguments a) { return std::fabs(a[0]); }},
    {"acos", 1, 1, FormulaRule::ToAngle, [](Arguments a) { return std::acos(a[0]); }},
    {"asin", 1, 1, FormulaRule::ToAngle, [](Arguments a) { return std::asin(a[0]); }},
    {"atan", 1, 1, FormulaRule::ToAngle, [](Arguments a) { return std::atan(a[0]); }},
    {"cos", 1, 1, FormulaRule::OfAngle, [](Arguments a) { return std::cos(a[0]); }},
    {"hypot", 2, 2, FormulaRule::Same, [](Arguments a) { return std::hypot(a[0], a[1]); }},
    {"max", 2, 8, FormulaRule::Same, [](Arguments a) { return *std::max_element(a.begin(), a.end()); }},
    {"min", 2, 8, FormulaRule::Same, [](Arguments a) { return *std::min_element(a.begin(), a.end()); }},
    {"round", 2, 2, FormulaRule::Same, [](Arguments a) { return std::round(a[0] / a[1]) * a[1]; }},
    {"sin", 1, 1, FormulaRule::OfAngle, [](Arguments a) { return std::sin(a[0]); }},
    {"sqrt", 1, 1, FormulaRule::Root, [](Arguments a) { return std::sqrt(a[0]); }},
    {"tan", 1, 1, FormulaRule::OfAngle, [](Arguments a) { return std::tan(a[0]); }},
};

template <class Row, std::size_t n>
const Row* rowNamed(const Row (&rows)[n], std::string_view name) {
  for (const Row& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

}  // namespace

const FormulaUnit* formulaUnit(std::string_view name) { return rowNamed(kUnits, name); }
const FormulaFunction* formulaFunction(std::string_view name) { return rowNamed(kFunctions, name); }
std::string_view formulaFunctions() {
  return "abs, acos, asin, atan, cos, hypot, max, min, mirror, round, sin, sqrt, tan";
}

Message dimensionSaid(Dimension d) {
  if (d == kPlainNumber) return say("a plain number");
  if (d == kLength) return say("a length");
  if (d == kAngle) return say("an angle");
  if (d == Dimension{2, 0}) return say("an area");
  return say("length^{0} angle^{1}", d.length, d.angle);
}

Done checkVariableName(std::string_view name) {
  const auto formula = Formula::parse(name);
  if (name.size() > 60 || !formula || formula->terms().size() != 1 ||
      formula->terms()[0].kind != FormulaTerm::Kind::Name || formula->terms()[0].word != name)
    return refused(say("“{0}” cannot name a variable: a name has letters, digits and _, and begins with a letter.",
                       name.substr(0, 60)));
  if ((!name.empty() && formulaUnit(name)) || formulaFunction(name) || name == kMirror)
    return refused(say("“{0}” means something else in formulas; choose another name.", name));
  if (const auto key = measurementKey(name))
    return refused(say("“{0}” is the measure {1} of the figure; choose another name.", name, *key));
  return {};
}

}  // namespace karinui
