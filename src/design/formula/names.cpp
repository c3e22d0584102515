#include <algorithm>
#include <numbers>

#include "design/formula/links.h"
#include "design/formula/stated.h"
#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/variables.h"

namespace karinui {

namespace {

// A chain of variables is worked out one within the other.
constexpr std::size_t kLongestChain = 100;

Error noSuchName(const Document& document, const std::string& name, const std::vector<std::string>& asking) {
  std::string all;
  for (const auto& [own, formula] : document.variables)
    if (!linkedEdge(own) && std::find(asking.begin(), asking.end(), own) == asking.end())
      all += (all.empty() ? "" : ", ") + own;
  const auto key = measurementKey(name);
  if (all.empty()) return refused(say("There is no variable “{0}”. {1}", name, key.error().what));
  return refused(say("There is no variable “{0}”; there are: {2}. {1}", name, key.error().what, all));
}

// The edge that is the mirror image of another: on the other half of a symmetric piece, or on its copy.
Result<double> mirroredLength(const Document& document, const Piece& piece, std::size_t edge) {
  const auto& edges = piece.outline.edges;
  if (const auto symmetry = symmetryOf(piece.outline); symmetry && symmetry->partner[edge])
    return edges[*symmetry->partner[edge]].curve.length();
  for (const auto& [id, other] : document.pattern.pieces) {
    if (id == piece.id || (other->mirrorOf != piece.id && piece.mirrorOf != id)) continue;
    if (other->outline.edges.size() == edges.size())  // a copy's edges run the other way round
      return other->outline.edges[edges.size() - 1 - edge].curve.length();
  }
  return refused(say("Edge {0} of “{1}” has no mirror image.", edges[edge].name, piece.name));
}

}  // namespace

DocumentNames::DocumentNames(const Document& document, Context& context)
    : DocumentNames(document, [&document, &context] { return bodyOf(document, context); }) {}

Result<Quantity> DocumentNames::named(const std::string& name) {
  if (const auto at = known_.find(name); at != known_.end()) return at->second;
  if (const auto variable = document_.variables.find(name); variable != document_.variables.end()) {
    if (std::find(asking_.begin(), asking_.end(), name) != asking_.end()) return formulaCircle(asking_, name);
    if (asking_.size() == kLongestChain) return refused(say("Too many variables depend on each other in a row."));
    const auto formula = Formula::parse(variable->second);
    if (!formula) return formula.error();
    asking_.push_back(name);
    const auto value = evaluate(*formula, *this);
    asking_.pop_back();
    if (value) known_[name] = *value;
    return value;
  }
  const auto key = measureCalled(name);
  if (!key) return noSuchName(document_, name, asking_);
  const Dimension dimension = isAngle(*key) ? kAngle : kLength;
  const auto& stated = document_.body.measurements.value;
  if (const auto at = stated.find(*key); at != stated.end()) return Quantity{at->second, dimension};
  const auto body = figure_();
  if (!body) return body.error();
  const auto& measured = (*body)->measured().value;
  const auto at = measured.find(*key);
  if (at == measured.end()) return refused(say("The measure {0} cannot be taken on this figure.", *key));
  return Quantity{at->second, dimension};
}

Result<double> DocumentNames::edgeLength(const EdgeRef& edge, bool mirrored) {
  EdgeRef here = edge;
  if (Done done = resolve(document_, here); !done) return done.error();
  const Piece& piece = *document_.find(here.piece.id);
  const std::size_t k = *piece.outline.find(here.edge);
  const auto whole = mirrored ? mirroredLength(document_, piece, k) : piece.outline.edges[k].curve.length();
  if (!whole) return whole;
  return *whole * (here.to - here.from);
}

Result<Formula> recordedFormula(const Formula& formula, const Document& document) {
  return formula.changed([&](FormulaTerm& term) -> Done {
    if (term.kind == FormulaTerm::Kind::Edge) return resolve(document, term.edge);
    if (!document.variables.contains(term.word)) term.word = measureCalled(term.word).value_or(term.word);
    return {};
  });
}

std::vector<VariableRow> variablesOf(const Document& document, DocumentNames& names) {
  std::vector<VariableRow> rows;
  for (const auto& [name, formula] : document.variables) rows.push_back({name, formula, names.named(name)});
  return rows;
}

Result<Quantity> workedOut(std::string_view text, DocumentNames& names, std::optional<Dimension> wanted) {
  const auto formula = Formula::parse(text);
  if (!formula) return formula.error();
  const auto value = evaluate(*formula, names);
  if (value && wanted && value->dimension != *wanted)
    return refused(
        say("“{0}” is {1}; here goes {2}.", formula->text(), dimensionSaid(value->dimension), dimensionSaid(*wanted)));
  return value;
}

std::string quantitySaid(Quantity quantity, bool inches) {
  if (quantity.dimension == kLength) return lengthSaid(quantity.value, inches, 2);
  if (quantity.dimension == kAngle) return fixed(quantity.value * 180 / std::numbers::pi, 2) + "°";
  return shortest(quantity.value);
}

}  // namespace karinui
