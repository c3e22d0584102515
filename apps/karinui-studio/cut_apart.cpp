#include "cut_apart.h"

#include <algorithm>

#include "karinui/design/sewing.h"

namespace karinui::studio {

namespace {

constexpr double kOnePlace = 1e-5;  // metres: both sides of a cut have the very line
constexpr int kParts = 8;           // of an edge, that are compared

// The same line of the paper, run the other way.
bool parted(const Curve& one, const Curve& other) {
  for (int k = 0; k <= kParts; ++k)
    if (distance(one.atFraction(double(k) / kParts), other.atFraction(1 - double(k) / kParts)) > kOnePlace)
      return false;
  return true;
}

// The free edge on the other side of the cut; nothing for one that is no edge of a cut, or is sewn.
std::optional<EdgeRef> otherSide(const Document& document, const Piece& piece, const Edge& edge) {
  if (!seamsOn(document, {{PieceRef(piece.id), edge.name}}).empty()) return std::nullopt;
  for (const auto& [id, other] : document.pattern.pieces)
    for (const Edge& there : other->outline.edges) {
      const EdgeRef ref{PieceRef(id), there.name};
      if ((id != piece.id || there.name != edge.name) && parted(edge.curve, there.curve) &&
          seamsOn(document, {ref}).empty())
        return ref;
    }
  return std::nullopt;
}

}  // namespace

std::optional<SewEdges> sewnAgain(const Document& document, const EdgeRef& edge) {
  const Piece* piece = document.find(edge.piece.id);
  const auto k = piece ? piece->outline.find(edge.edge) : std::nullopt;
  if (!k) return std::nullopt;
  const auto& edges = piece->outline.edges;
  const auto first = otherSide(document, *piece, edges[*k]);
  if (!first) return std::nullopt;
  SewEdges sew;
  sew.a = {edge};
  sew.b = {*first};
  // A cut with corners, or across darts, has several edges.
  const std::size_t n = edges.size();
  for (const std::size_t step : {std::size_t{1}, n - 1})
    for (std::size_t i = (*k + step) % n; i != *k; i = (i + step) % n) {
      const auto other = otherSide(document, *piece, edges[i]);
      if (!other || other->piece.id != first->piece.id || sew.a.size() + 1 >= n) break;
      const EdgeRef own{edge.piece, edges[i].name};
      if (std::find(sew.a.begin(), sew.a.end(), own) != sew.a.end() ||
          std::find(sew.b.begin(), sew.b.end(), own) != sew.b.end())
        break;
      const bool on = step == 1;  // the other side runs the other way
      sew.a.insert(on ? sew.a.end() : sew.a.begin(), own);
      sew.b.insert(on ? sew.b.begin() : sew.b.end(), *other);
    }
  sew.mirror = static_cast<bool>(mirrorImage(document, sew));
  return sew;
}

}  // namespace karinui::studio
