#include "fastening_offers.h"

#include <algorithm>
#include <cmath>

#include "karinui/design/sewing.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/symmetry.h"

namespace karinui::studio {

namespace {

// Where an edge of the garment stands, so far along it.
std::optional<Vec3> standsAt(const GarmentSnapshot& snapshot, const EdgeRef& ref, double share) {
  const Piece* piece = snapshot.document.find(ref.piece.id);
  const Edge* edge = piece ? findEdge(*piece, ref.edge) : nullptr;
  return edge ? spaceOf(snapshot, piece->id, edge->curve.atFraction(share)) : std::nullopt;
}

}  // namespace

std::optional<EdgeRef> twinOf(const Document& document, const EdgeRef& edge) {
  const Piece* piece = document.find(edge.piece.id);
  const auto k = piece ? piece->outline.find(edge.edge) : std::nullopt;
  if (!k) return std::nullopt;
  for (const auto& [id, other] : document.pattern.pieces)
    if (other->mirrorOf == piece->id || piece->mirrorOf == id)
      if (const auto name = edgeOnCopy(*other, *piece, edge.edge)) return EdgeRef{PieceRef(id), *name};
  const auto symmetry = symmetryOf(piece->outline);
  if (const auto other = symmetry ? symmetry->partner[*k] : std::nullopt; other && *other != *k)
    return EdgeRef{PieceRef(piece->id), piece->outline.edges[*other].name};
  return std::nullopt;
}

bool flyFits(const GarmentSnapshot& snapshot, const SewFly& fly) {
  constexpr double kBeside = 0.05, kFromWaist = 0.15;  // metres
  if (!snapshot.body) return twinOf(snapshot.document, fly.a) == fly.b;
  const auto on = [&](const char* place) -> std::optional<Vec3> {
    const auto point = parseBodyPoint(place);
    const auto there = point ? snapshot.body->find(*point) : Result<SurfacePoint>(point.error());
    return there ? std::optional(at(snapshot.body->mesh(), *there)) : std::nullopt;
  };
  const auto front = on("torso:waist@0"), back = on("torso:waist@0.5");
  const Piece* piece = snapshot.document.find(fly.a.piece.id);
  const Edge* edge = piece ? findEdge(*piece, fly.a.edge) : nullptr;
  if (!edge) return false;
  const auto upper = standsAt(snapshot, fly.a, edge->curve.start.v >= edge->curve.end.v ? 0 : 1);
  if (!front || !back || !upper) return true;
  return std::fabs(upper->x - front->x) < kBeside && std::fabs(upper->y - front->y) < kFromWaist &&
         distance(*upper, *front) < distance(*upper, *back);
}

}  // namespace karinui::studio
