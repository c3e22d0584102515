#pragma once
// The way of a strap over the body, as a tape is laid from one edge to another over a shoulder or round the neck.
// Metres.
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/design/apply.h"
#include "karinui/design/document.h"
#include "karinui/design/values.h"

namespace karinui {

// Where a strap is sewn: the middle of a part of an edge, and how that runs.
struct StrapEnd {
  Vec3 middle;
  Vec3 along;  // unit: the edge's own direction
  std::set<PieceId> pieces;
};
StrapEnd strapEnd(const Document& document, const EdgeRef& part);
StrapEnd strapEnd(const Document& document, const std::vector<EdgeRef>& run);

struct StrapWay {
  std::vector<Vec3> place;   // evenly, clear of the body and of the cloth that stands, from one end to the other
  std::vector<Vec3> across;  // unit: along the strap's width, to the right where one looks at it with `from` below
  std::vector<Vec3> out;     // unit: away from the body
  double length = 0;         // of the tape on the skin, or on the cloth that lies on it
  std::shared_ptr<const Bvh> cloth;  // that lies below it; null: none
};
// From `from` to `to` in the plane that goes through both and `over`; none: straight across. `strap` is the piece that
// is led there, should it stand somewhere already.
Result<StrapWay> strapWay(const Document& document, PieceId strap, const Body& body, const StrapEnd& from,
                          const StrapEnd& to, const std::optional<BodyPoint>& over);

// Settles where a strap goes that is not told more: front to back over a shoulder, front to front round the neck, else
// straight across (nothing). Refuses a place that is not on the figure, and to lead a strap where there is no figure.
Done settleWay(const Document& before, const StrapEnd& from, const StrapEnd& to, std::optional<BodyPoint>& over,
               Context& context);

// The piece laid along the way, `low` and `top` being the middles of its two ends on paper.
Result<Piece> laidAlong(const Document& document, Piece piece, Flat low, Flat top, const StrapWay& way,
                        const Body& body);

}  // namespace karinui
