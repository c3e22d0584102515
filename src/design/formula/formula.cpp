// Formulas written and worked out, term by term on a stack.
#include <algorithm>
#include <cmath>

#include "design/formula/words.h"
#include "design/text/value_text.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

using Kind = FormulaTerm::Kind;
using Terms = std::span<const FormulaTerm>;

// How firmly a part holds together.
enum Binding { kSum = 1, kProduct, kSign, kPower, kWhole };
struct Part {
  std::string text;
  Binding binding = kWhole;
  std::string in(Binding least) const { return binding < least ? "(" + text + ")" : text; }
};

std::string edgeTerm(const FormulaTerm& term) {
  const std::string edge = writeValue(term.edge);
  // Bare where it is read back so; else in brackets.
  const auto bare = Formula::parse(edge);
  FormulaTerm plain = term;
  plain.mirrored = false;
  const bool same = bare && bare->terms().size() == 1 && bare->terms()[0] == plain;
  const std::string all = same ? edge : "[" + edge + "]";
  return term.mirrored ? std::string(kMirror) + "(" + all + ")" : all;
}

std::string written(Terms terms) {
  std::vector<Part> parts;
  const auto taken = [&] {
    Part part = std::move(parts.back());
    parts.pop_back();
    return part;
  };
  const auto pair = [&](std::string_view sign, Binding binding, Binding left, Binding right) {
    const Part b = taken(), a = taken();
    parts.push_back({a.in(left).append(sign).append(b.in(right)), binding});
  };
  for (const FormulaTerm& term : terms) {
    switch (term.kind) {
      case Kind::Number:
        parts.push_back({shortest(term.number) + term.word});
        break;
      case Kind::Name:
        parts.push_back({term.word});
        break;
      case Kind::Edge:
        parts.push_back({edgeTerm(term)});
        break;
      case Kind::Negate:
        parts.push_back({"-" + taken().in(kSign), kSign});
        break;
      case Kind::Add:
        pair(" + ", kSum, kSum, kProduct);
        break;
      case Kind::Subtract:
        pair(" - ", kSum, kSum, kProduct);
        break;
      case Kind::Multiply:
        pair("*", kProduct, kProduct, kSign);
        break;
      case Kind::Divide:
        pair("/", kProduct, kProduct, kSign);
        break;
      case Kind::Power:
        pair("^", kPower, kWhole, kSign);
        break;
      case Kind::Call: {
        std::string inside;
        for (std::size_t i = 0; i < term.arguments; ++i)
          inside = i == 0 ? taken().text : taken().text.append(", ").append(inside);
        parts.push_back({term.word + "(" + inside + ")"});
      }
    }
  }
  return parts.empty() ? std::string() : parts.back().text;
}

// A value and the terms it came from, to quote them.
struct Value {
  Quantity is;
  Terms from;
};

class Working {
 public:
  Working(Terms terms, FormulaNames& names) : terms_(terms), names_(names) {}

  Result<Quantity> all() {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const FormulaTerm& term = terms_[i];
      const std::size_t count = term.kind == Kind::Call     ? term.arguments
                                : term.kind == Kind::Negate ? 1
                                : term.kind <= Kind::Edge   ? 0
                                                            : 2;
      const std::vector<Value> operands(stack_.end() - static_cast<std::ptrdiff_t>(count), stack_.end());
      stack_.resize(stack_.size() - count);
      auto made = value(term, operands);
      if (!made) return made.error();
      const std::size_t first = count == 0 ? i : static_cast<std::size_t>(operands[0].from.data() - terms_.data());
      const Terms from = terms_.subspan(first, i + 1 - first);
      if (!std::isfinite(made->value)) return refused(say("“{0}” has no value.", quoted(from)));
      stack_.push_back({*made, from});
    }
    return stack_.back().is;
  }

 private:
  static std::string quoted(Terms terms) { return written(terms).substr(0, 120); }

  Result<Quantity> value(const FormulaTerm& term, const std::vector<Value>& of) {
    switch (term.kind) {
      case Kind::Number: {
        const FormulaUnit& unit = *formulaUnit(term.word);
        return Quantity{term.number / unit.perUnit, unit.dimension};
      }
      case Kind::Name:
        return names_.named(term.word);
      case Kind::Edge: {
        const auto metres = names_.edgeLength(term.edge, term.mirrored);
        if (!metres) return metres.error();
        return Quantity{*metres, kLength};
      }
      case Kind::Negate:
        return Quantity{-of[0].is.value, of[0].is.dimension};
      case Kind::Add:
      case Kind::Subtract:
        if (of[0].is.dimension != of[1].is.dimension) return apart(of[0], of[1]);
        return Quantity{term.kind == Kind::Add ? of[0].is.value + of[1].is.value : of[0].is.value - of[1].is.value,
                        of[0].is.dimension};
      case Kind::Multiply:
        return bounded({of[0].is.value * of[1].is.value,
                        {of[0].is.dimension.length + of[1].is.dimension.length,
                         of[0].is.dimension.angle + of[1].is.dimension.angle}});
      case Kind::Divide:
        if (of[1].is.value == 0)
          return refused(say("“{0}” is zero; nothing can be divided by it.", quoted(of[1].from)));
        return bounded({of[0].is.value / of[1].is.value,
                        {of[0].is.dimension.length - of[1].is.dimension.length,
                         of[0].is.dimension.angle - of[1].is.dimension.angle}});
      case Kind::Power:
        return power(of[0], of[1]);
      case Kind::Call:
        return called(*formulaFunction(term.word), of);
    }
    return Quantity{};
  }
  static Error apart(const Value& a, const Value& b) {
    return refused(say("“{0}” is {1} and “{2}” is {3}; they do not go together. Write the unit, like 1.5cm or 30deg.",
                       quoted(a.from), dimensionSaid(a.is.dimension), quoted(b.from), dimensionSaid(b.is.dimension)));
  }
  static Error wants(std::string_view who, Dimension wanted, const Value& got) {
    return refused(say("{0}() wants {1}, and “{2}” is {3}.", who, dimensionSaid(wanted), quoted(got.from),
                       dimensionSaid(got.is.dimension)));
  }
  static Result<Quantity> bounded(Quantity q) {
    if (std::abs(q.dimension.length) > 8 || std::abs(q.dimension.angle) > 8)
      return refused(say("Too many lengths are multiplied in this formula."));
    return q;
  }
  static Result<Quantity> power(const Value& base, const Value& exponent) {
    const double n = exponent.is.value;
    if (exponent.is.dimension != kPlainNumber)
      return refused(say("The power “{0}” must be a plain number.", quoted(exponent.from)));
    Dimension dimension = base.is.dimension;
    if (dimension != kPlainNumber) {
      if (n != std::floor(n) || std::fabs(n) > 8)
        return refused(say("Of “{0}” only whole powers make sense.", quoted(base.from)));
      dimension = {dimension.length * static_cast<int>(n), dimension.angle * static_cast<int>(n)};
    }
    return bounded({std::pow(base.is.value, n), dimension});
  }
  static Result<Quantity> called(const FormulaFunction& function, const std::vector<Value>& of) {
    std::vector<double> arguments;
    for (const Value& value : of) arguments.push_back(value.is.value);
    Dimension dimension = of[0].is.dimension;
    switch (function.rule) {
      case FormulaRule::Same:
        for (const Value& value : of)
          if (value.is.dimension != dimension) return apart(of[0], value);
        break;
      case FormulaRule::Root:
        if (dimension.length % 2 != 0 || dimension.angle % 2 != 0)
          return refused(say("“{0}” is {1}; it has no square root.", quoted(of[0].from), dimensionSaid(dimension)));
        dimension = {dimension.length / 2, dimension.angle / 2};
        break;
      case FormulaRule::OfAngle:
        if (dimension != kAngle) return wants(function.name, kAngle, of[0]);
        dimension = kPlainNumber;
        break;
      case FormulaRule::ToAngle:
        if (dimension != kPlainNumber) return wants(function.name, kPlainNumber, of[0]);
        dimension = kAngle;
    }
    return Quantity{function.apply(arguments), dimension};
  }

  Terms terms_;
  FormulaNames& names_;
  std::vector<Value> stack_;
};

}  // namespace

std::string Formula::text() const { return written(terms_); }

Result<Formula> Formula::changed(const std::function<Done(FormulaTerm&)>& change) const {
  std::vector<FormulaTerm> terms = terms_;
  for (FormulaTerm& term : terms)
    if (term.kind == Kind::Name || term.kind == Kind::Edge)
      if (Done done = change(term); !done) return done.error();
  return Formula(std::move(terms));
}

Result<Quantity> evaluate(const Formula& formula, FormulaNames& names) { return Working(formula.terms(), names).all(); }

}  // namespace karinui
