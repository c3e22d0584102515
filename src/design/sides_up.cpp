#include "design/sides_up.h"

#include <algorithm>
#include <map>
#include <vector>

#include "karinui/design/sewing.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

// Two pieces sewn edge to edge; alike: with their right sides on one side of the cloth.
struct Join {
  PieceId one, other;
  bool alike = false;
};

bool isOutline(const Document& document, PieceId piece, const std::string& edge) {
  const Piece* found = document.find(piece);
  return found && found->outline.find(edge);
}

// Without seams on the edges that are sewn now: they are in the way, and go or are refused.
std::vector<Join> joinsWithout(const Document& document, const SewEdges& sew) {
  std::vector<SeamId> inTheWay = seamsOn(document, sew.a);
  for (const SeamId id : seamsOn(document, sew.b)) inTheWay.push_back(id);
  std::vector<Join> joins;
  for (const auto& [id, seam] : document.pattern.seams) {
    if (std::find(inTheWay.begin(), inTheWay.end(), id) != inTheWay.end()) continue;
    const SeamSides sides(document.pattern, seam);
    const auto breaks = sides.breaks();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double middle = (breaks[k] + breaks[k + 1]) / 2;
      const SeamPlace a = sides.a.at(middle), b = sides.b.at(middle);
      if (isOutline(document, a.piece, a.edge) && isOutline(document, b.piece, b.edge))
        joins.push_back({a.piece, b.piece, seam.reversed});
    }
  }
  return joins;
}

// Of the pieces that hang together with the first, whether they face as it does. Nothing: a round of them is twisted.
std::optional<std::map<PieceId, bool>> facingAs(PieceId first, const std::vector<Join>& joins) {
  std::map<PieceId, bool> alike{{first, true}};
  for (bool more = true; more;) {
    more = false;
    for (const Join& join : joins) {
      const auto one = alike.find(join.one), other = alike.find(join.other);
      if (one != alike.end() && other != alike.end()) {
        if ((one->second == other->second) != join.alike) return std::nullopt;
      } else if (one != alike.end() || other != alike.end()) {
        const bool known = one != alike.end() ? one->second : other->second;
        alike[one != alike.end() ? join.other : join.one] = known == join.alike;
        more = true;
      }
    }
  }
  return alike;
}

}  // namespace

std::optional<bool> reversedBySides(const Document& document, const SewEdges& sew) {
  for (const auto* side : {&sew.a, &sew.b})
    for (const EdgeRef& edge : *side)
      if (!isOutline(document, edge.piece.id, edge.edge)) return std::nullopt;
  const std::vector<Join> joins = joinsWithout(document, sew);
  std::optional<bool> told;
  for (const EdgeRef& a : sew.a) {
    const auto alike = facingAs(a.piece.id, joins);
    if (!alike) return std::nullopt;
    for (const EdgeRef& b : sew.b) {
      const auto found = alike->find(b.piece.id);
      if (found == alike->end()) continue;
      if (told && *told != found->second) return std::nullopt;
      told = found->second;
    }
  }
  return told;
}

}  // namespace karinui
