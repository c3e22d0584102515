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

bool runsDown(const Document& document, const EdgeRef& ref) {
  const Curve& curve = findEdge(*document.find(ref.piece.id), ref.edge)->curve;
  const Flat chord = curve.end - curve.start;
  return std::fabs(chord.v) >= std::fabs(chord.u);
}

// Whether it ends at a hem: nothing is sewn round the corner below.
bool endsFree(const Document& document, const EdgeRef& ref) {
  const Outline& outline = document.find(ref.piece.id)->outline;
  const std::size_t k = *outline.find(ref.edge), n = outline.edges.size();
  const Curve& curve = outline.edges[k].curve;
  const std::size_t below = curve.start.v < curve.end.v ? (k + n - 1) % n : (k + 1) % n;
  return seamsOn(document, {{ref.piece, outline.edges[below].name}}).empty();
}

bool isFastened(const Document& document, const EdgeRef& ref) {
  const auto on = [&](const EdgeSpan& span) { return span.piece == ref.piece.id && span.edge == ref.edge; };
  return std::any_of(document.allowances.fastenings.begin(), document.allowances.fastenings.end(),
                     [&](const auto& own) {
                       return std::any_of(own.second.a.begin(), own.second.a.end(), on) ||
                              std::any_of(own.second.b.begin(), own.second.b.end(), on);
                     });
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

std::optional<Fasten> buttonsAt(const GarmentSnapshot& snapshot, const EdgeRef& over) {
  constexpr double kNear = 0.15;                               // metres between free edges that meet in the middle
  constexpr double kApart = 0.08, kStand = 0.015;              // metres
  constexpr double kShort = 0.1, kFirst = 0.02, kLast = 0.08;  // metres: a hem flies free below the last
  const Document& document = snapshot.document;
  const auto under = twinOf(document, over);
  if (!under || !runsDown(document, over) || isFastened(document, over) || isFastened(document, *under))
    return std::nullopt;
  bool together = false;
  for (const EdgeRef& side : {over, *under})
    for (const SeamId id : seamsOn(document, {side})) {
      const Seam& seam = *document.find(id);
      if (seam.a.size() != 1 || seam.b.size() != 1) return std::nullopt;
      const auto is = [&](const EdgeSpan& span, const EdgeRef& ref) {
        return span.piece == ref.piece.id && span.edge == ref.edge;
      };
      const EdgeSpan &a = seam.a.front(), &b = seam.b.front();
      if (!(is(a, over) && is(b, *under)) && !(is(a, *under) && is(b, over))) return std::nullopt;
      together = true;
    }
  const auto here = standsAt(snapshot, over, 0.5), there = standsAt(snapshot, *under, 0.5);
  if (!together && !(here && there && distance(*here, *there) < kNear)) return std::nullopt;
  if (together && !(endsFree(document, over) && endsFree(document, *under))) return std::nullopt;  // as a crotch
  Fasten buttons;
  buttons.kind = FasteningKind::Button;
  buttons.a = {over}, buttons.b = {*under};
  buttons.size = Length{0.011};
  const double whole = lengthOf(document, buttons.a);
  if (whole < kShort) {  // the end of a collar, or of a cuff
    buttons.count = 1;
    buttons.first = Length{std::round(500 * whole) / 1000};
  } else {
    buttons.first = Length{kFirst}, buttons.last = Length{std::min(kLast, std::floor(250 * whole) / 1000)};
    buttons.count = 1 + static_cast<int>(std::lround((whole - *buttons.first - *buttons.last) / kApart));
  }
  if (together) buttons.stand = Length{kStand};
  return buttons;
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
