#include "karinui/design/apply.h"

#include <algorithm>

#include "design/formula/links.h"
#include "design/operations/operations.h"
#include "design/operations/pocket_follows.h"
#include "design/text/field_table.h"
#include "design/text/formula_fields.h"
#include "design/text/value_text.h"
#include "karinui/design/variables.h"

namespace karinui {

namespace {

constexpr std::uint32_t kMostOperations = 1'000'000;  // a garment of a lifetime; keeps ids small
constexpr std::size_t kMostPieces = 1000;             // a suit has some sixty; work grows with their square

// Whether an internal line that a seam or a fastening holds is no longer there.
template <class Sewn>
bool lineGone(const Document& before, const Document& after, const Sewn& seam) {
  const auto gone = [&](const EdgeSpan& span) {
    const Piece *was = before.find(span.piece), *is = after.find(span.piece);
    return was && is && !findEdge(*was, span.edge) && findCurve(*was, span.edge) && !findCurve(*is, span.edge);
  };
  return std::any_of(seam.a.begin(), seam.a.end(), gone) || std::any_of(seam.b.begin(), seam.b.end(), gone);
}

// What is given by formulas, for this document; their edges by ids.
Done workOutFields(const Document& before, Operation& operation, Context& context) {
  if (operation.formulas.empty()) return {};
  DocumentNames names(before, context);
  const auto valueOf = [&](Formula& formula) -> Result<Quantity> {
    auto known = recordedFormula(formula, before);
    if (!known) return known.error();
    formula = *std::move(known);
    return evaluate(formula, names);
  };
  for (const FieldOf& field : fieldsOf(operation)) {
    for (FieldText& formula : operation.formulas) {
      if (formula.name != field.name) continue;
      const auto worked = workedOutField(field.form->kind, formula.value, valueOf);
      if (!worked) return worked.error();
      formula.value = worked->formulas;
      if (Done done = field.form->read(worked->plain, field.value); !done) return done;
    }
  }
  return {};
}

// In lists of edges “front.waist*” is all edges of the outline whose names begin so, in their order there. What no
// edge is called like is left, to be refused with the names that there are.
void nameEachEdge(const Document& before, Operation& operation) {
  for (const FieldOf& field : fieldsOf(operation)) {
    if (field.form->kind != "list of piece.edge") continue;
    std::vector<EdgeRef> all;
    for (EdgeRef& ref : *static_cast<std::vector<EdgeRef>*>(field.value)) {
      const bool several = ref.edge.ends_with('*') && ref.from == 0 && ref.to == 1;
      const std::size_t had = all.size();
      if (PieceRef piece = ref.piece; several && resolve(before, piece))
        for (const Edge& edge : before.find(piece.id)->outline.edges)
          if (edge.name.starts_with(ref.edge.substr(0, ref.edge.size() - 1))) all.push_back({piece, edge.name});
      if (all.size() == had) all.push_back(std::move(ref));
    }
    *static_cast<std::vector<EdgeRef>*>(field.value) = std::move(all);
  }
}

// The edges a field names; of a field of another kind none.
std::vector<EdgeRef> edgesIn(const FieldOf& field) {
  if (field.form->kind == "list of piece.edge") return *static_cast<const std::vector<EdgeRef>*>(field.value);
  if (field.form->kind != "piece.edge") return {};
  EdgeRef edge;  // by its text, for it may be optional
  return readValue(field.form->write(field.value), edge) ? std::vector{edge} : std::vector<EdgeRef>();
}

bool isPart(const EdgeRef& ref) { return ref.from != 0 || ref.to != 1; }

// Parts of edges in the fields of an operation, by the field's name.
std::vector<std::pair<std::string_view, EdgeRef>> partsNamed(Operation& operation) {
  std::vector<std::pair<std::string_view, EdgeRef>> parts;
  for (const FieldOf& field : fieldsOf(operation))
    for (EdgeRef& ref : edgesIn(field))
      if (isPart(ref)) parts.emplace_back(field.name, std::move(ref));
  return parts;
}

// What is done along whole edges leaves a part of one out when it is resolved. It would be done to all of the edge.
Done keptParts(const Document& before, const std::vector<std::pair<std::string_view, EdgeRef>>& named,
               Operation& operation) {
  if (named.empty()) return {};
  const auto kept = partsNamed(operation);
  for (const auto& [field, ref] : named) {
    PieceRef piece = ref.piece;
    if (!resolve(before, piece)) continue;
    const auto same = [&, name = field, edge = ref.edge](const auto& other) {
      PieceRef its = other.second.piece;
      return other.first == name && other.second.edge == edge && resolve(before, its) && its == piece;
    };
    double share = 0;  // several parts may be all of it
    for (const auto& other : named)
      if (same(other)) share += other.second.to - other.second.from;
    if (share >= 1 - 1e-9 || std::any_of(kept.begin(), kept.end(), same)) continue;
    const std::string whole = before.find(piece.id)->name + "." + ref.edge;
    const double at = ref.from > 0 ? ref.from : ref.to;
    return refused(
        say("This is done along whole edges, and “{0}@{1}:{2}” is a part of one. Divide the edge first, split "
            "edge={0} at={3}, and name the part by what it is called then.",
            whole, ref.from, ref.to, at));
  }
  return {};
}

// The formula of a `length`; empty: a plain number.
std::string lengthFormula(const Operation& operation) {
  for (const FieldText& formula : operation.formulas)
    if (formula.name == "to") return formula.value;
  return {};
}

}  // namespace

Result<BodyPtr> bodyOf(const Document& document, Context& context) {
  if (!document.body.chosen())
    return refused(say("There is no body yet; choose one first, for example: body size=jis9ar."));
  return context.bodies.find(document.body, context.blobs, context.workers, context.token);
}

Result<Operation> resolved(const Document& before, Operation operation, Context& context) {
  if (Done done = workOutFields(before, operation, context); !done) return done.error();
  nameEachEdge(before, operation);
  const auto parts = context.recorded ? decltype(partsNamed(operation))() : partsNamed(operation);
  Context own = context;
  own.byFormula = !operation.formulas.empty();
  const Done done =
      std::visit([&](auto& op) { return resolve(before, op, own); }, static_cast<PlainOperation&>(operation));
  if (!done) return done.error();
  if (Done whole = keptParts(before, parts, operation); !whole) return whole.error();
  if (const auto* length = std::get_if<SetLength>(&operation))
    if (Done fine = checkLink(before, length->edge, lengthFormula(operation)); !fine) return fine.error();
  return operation;
}

Result<Document> apply(const Document& before, const Operation& operation, Context& context) {
  if (before.operations >= kMostOperations) return refused(say("This document has too many operations."));
  auto op = resolved(before, operation, context);
  if (!op) return op.error();
  auto after = std::visit([&](const auto& o) { return perform(before, o, context); }, *op);
  if (!after) return after.error();
  if (context.token.cancelled()) return cancelled();
  if (const std::size_t count = after->pattern.pieces.size();
      count > kMostPieces && count > before.pattern.pieces.size())
    return refused(
        say("A document has no more than {0} pieces, and this would make {1}. Remove some, or begin another one.",
            kMostPieces, count));
  if (const auto* length = std::get_if<SetLength>(&*op))
    after = withLink(*std::move(after), length->edge, lengthFormula(*op));
  if (!after->variables.empty()) after = linksFollowed(before, *std::move(after), context);
  after = pocketsFollowed(before, *std::move(after), context);
  // A seam goes with the internal line it was sewn to, and what was said of a seam or a piece goes with it.
  std::erase_if(after->pattern.seams, [&](const auto& seam) { return lineGone(before, *after, seam.second); });
  std::erase_if(after->allowances.fastenings, [&](const auto& own) { return lineGone(before, *after, own.second); });
  std::erase_if(after->eases, [&](const auto& own) { return !after->find(own.first); });
  std::erase_if(after->cutting, [&](const auto& own) { return !after->find(own.first); });
  std::erase_if(after->grading.pieces, [&](const auto& own) { return !after->find(own.first); });
  after->operations = before.operations + 1;
  return after;
}

}  // namespace karinui
