#include "design/formula/links.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "design/formula/stated.h"
#include "design/operations/operations.h"
#include "karinui/design/formula.h"
#include "karinui/design/step_words.h"
#include "karinui/design/variables.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

constexpr double kSame = 1e-7;  // metres: as long as it is to be
constexpr int kRounds = 8;      // a link may depend on edges that another link has just pulled

double lengthOf(const Document& document, const EdgeRef& edge) {
  const Piece& piece = *document.find(edge.piece.id);
  return piece.outline.edges[*piece.outline.find(edge.edge)].curve.length();
}

// Whether a step made another thing of an edge than a longer or shorter one.
bool parted(const Document& before, const Document& after, const EdgeRef& edge) {
  const Piece *was = before.find(edge.piece.id), *is = after.find(edge.piece.id);
  if (!was || !is || was == is || !was->outline.find(edge.edge) || !is->outline.find(edge.edge)) return false;
  return was->outline.edges.size() != is->outline.edges.size() &&
         std::fabs(lengthOf(before, edge) - lengthOf(after, edge)) > kSame;
}

// The links and edges that a formula depends on, through variables; calls `found` with each edge's link name.
bool anyEdge(const Document& document, const std::string& text, std::set<std::string>& asked,
             const std::function<bool(const std::string&)>& found) {
  const auto formula = Formula::parse(text);
  if (!formula) return false;
  for (const FormulaTerm& term : formula->terms()) {
    if (term.kind == FormulaTerm::Kind::Edge && found(linkName(term.edge))) return true;
    if (term.kind != FormulaTerm::Kind::Name || !asked.insert(term.word).second) continue;
    const auto variable = document.variables.find(term.word);
    if (variable != document.variables.end() && anyEdge(document, variable->second, asked, found)) return true;
  }
  return false;
}

bool names(const Document& document, const std::string& formula, const std::function<bool(const std::string&)>& edge) {
  std::set<std::string> asked;
  return anyEdge(document, formula, asked, edge);
}

// Whether following the links from a formula comes back to `edge`; the way there.
bool comesBack(const Document& document, const std::string& formula, const std::string& edge,
               std::vector<std::string>& way) {
  return names(document, formula, [&](const std::string& other) {
    if (other == edge) return true;
    const auto link = document.variables.find(other);
    if (link == document.variables.end() || std::find(way.begin(), way.end(), other) != way.end()) return false;
    way.push_back(other);
    if (comesBack(document, link->second, edge, way)) return true;
    way.pop_back();
    return false;
  });
}

// Both halves follow where they are alike now.
Choice halves(const Document& document, const EdgeRef& edge) {
  const Piece& piece = *document.find(edge.piece.id);
  const auto symmetry = symmetryOf(piece.outline);
  const std::size_t k = *piece.outline.find(edge.edge);
  if (!symmetry || !symmetry->partner[k]) return Choice::No;
  const double other = piece.outline.edges[*symmetry->partner[k]].curve.length();
  return std::fabs(other - piece.outline.edges[k].curve.length()) < 1e-6 ? Choice::Yes : Choice::No;
}

Result<Document> pulled(const Document& document, const EdgeRef& edge, double metres, Context& context) {
  SetLength follow;
  follow.edge = edge;
  follow.to = Length{metres};
  follow.symmetric = halves(document, edge);
  Context own = context;
  own.advise = {};
  own.byFormula = true;
  own.recorded = true;  // what stays is not recorded here: it is as ever, lest a replay decides otherwise
  if (Done done = resolve(document, follow, own); !done) return done.error();
  return perform(document, follow, own);
}

}  // namespace

std::string linkName(const EdgeRef& edge) { return text(edge.piece.id) + "." + edge.edge; }

std::optional<EdgeRef> linkedEdge(std::string_view variable) {
  if (variable.find('.') == std::string_view::npos) return std::nullopt;
  const auto formula = Formula::parse(variable);
  if (!formula || formula->terms().size() != 1 || formula->terms()[0].kind != FormulaTerm::Kind::Edge)
    return std::nullopt;
  return formula->terms()[0].edge;
}

Done checkLink(const Document& document, const EdgeRef& edge, const std::string& formula) {
  const std::string own = linkName(edge);
  if (names(document, formula, [&](const std::string& other) { return other == own; })) return {};  // once, no link
  std::vector<std::string> way{own};
  if (comesBack(document, formula, own, way)) return formulaCircle(way, own);
  return {};
}

Document withLink(Document document, const EdgeRef& edge, const std::string& formula) {
  const std::string own = linkName(edge);
  const bool itself = names(document, formula, [&](const std::string& other) { return other == own; });
  const bool others = names(document, formula, [](const std::string&) { return true; });
  if (others && !itself)
    document.variables[own] = formula;
  else
    document.variables.erase(own);
  return document;
}

void renameInFormulas(Document& document, PieceId piece, const std::string& from, const std::string& to) {
  const auto isIt = [&](const EdgeRef& edge) { return edge.piece.id == piece && edge.edge == from; };
  std::map<std::string, std::string> renamed;
  for (const auto& [name, text] : document.variables) {
    auto key = name;
    if (const auto edge = linkedEdge(name); edge && isIt(*edge)) key = linkName({PieceRef(piece), to});
    const auto formula = Formula::parse(text);
    const auto changed = formula ? formula->changed([&](FormulaTerm& term) -> Done {
      if (term.kind == FormulaTerm::Kind::Edge && isIt(term.edge)) term.edge.edge = to;
      return {};
    })
                                 : formula;
    renamed[key] = changed ? changed->text() : text;
  }
  document.variables = std::move(renamed);
}

Document linksFollowed(const Document& before, Document document, Context& context) {
  const auto tell = [&](const Message& what, PieceId piece, const std::string& edge) {
    if (context.advise) context.advise({what, piece, edge});
  };
  const auto all = document.variables;
  for (const auto& [name, formula] : all) {
    const auto edge = linkedEdge(name);
    if (!edge) continue;
    const bool other =
        names(document, formula, [&](const std::string& of) { return parted(before, document, *linkedEdge(of)); });
    if (!other && !parted(before, document, *edge)) continue;
    document.variables.erase(name);
    tell(say("{0} is not linked any more: an edge of the link was parted.", edgeSaid(document, *edge)), edge->piece.id,
         edge->edge);
  }
  std::set<std::string> stuck;  // told once
  for (int round = 0; round < kRounds; ++round) {
    bool any = false;
    const auto links = document.variables;
    for (const auto& [name, formula] : links) {
      const auto edge = linkedEdge(name);
      if (!edge || stuck.contains(name)) continue;
      const Piece* piece = document.find(edge->piece.id);
      DocumentNames values(document, context);
      const bool there = piece && piece->outline.find(edge->edge);
      const auto wanted = there ? workedOut(formula, values, kLength) : Result<Quantity>(Error{});
      if (!wanted) {
        document.variables.erase(name);
        if (there)
          tell(say("{0} is not linked any more: {1}", edgeSaid(document, *edge), wanted.error().what), piece->id,
               edge->edge);
        continue;
      }
      if (std::fabs(lengthOf(document, *edge) - wanted->value) < kSame) continue;
      auto after = pulled(document, *edge, wanted->value, context);
      if (!after) {
        stuck.insert(name);
        tell(say("{0} cannot follow the edges it is linked to: {1}", edgeSaid(document, *edge), after.error().what),
             piece->id, edge->edge);
        continue;
      }
      document = *std::move(after);
      any = true;
    }
    if (!any) break;
  }
  return document;
}

}  // namespace karinui
