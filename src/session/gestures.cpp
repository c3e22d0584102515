#include "session/gestures.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/base/result.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

std::vector<EdgeRef> Selection::edges() const {
  std::vector<EdgeRef> all;
  for (const EdgeNear& one : more) all.push_back({PieceRef(one.piece), one.edge});
  if (edge) all.push_back({PieceRef(edge->piece), edge->edge});
  return all;
}

std::unique_ptr<Gesture> gestureFor(Command tool) {
  KARINUI_ASSERT(isTool(tool));
  return info(tool).gesture();
}

double tenth(double metres) {
  const double rounded = std::round(metres * 1e4) / 1e4;
  return rounded == 0 ? 0 : rounded;  // no negative zero in the record
}
Flat tenth(Flat p) { return {tenth(p.u), tenth(p.v)}; }
Vec3 tenth(Vec3 p) { return {tenth(p.x), tenth(p.y), tenth(p.z)}; }

Message onlyThisHalf() {
  return say("Only this half was changed: the other half has no such place, because of a slit or dart.");
}

std::vector<PieceId> copiesOf(const Document& document, PieceId id) {
  std::vector<PieceId> all;
  const Piece* piece = document.find(id);
  if (!piece) return all;
  for (const auto& [other, copy] : document.pattern.pieces)
    if (other != id && (copy->mirrorOf == id || piece->mirrorOf == other) &&
        edgeOnCopy(*copy, *piece, piece->outline.edges.front().name))
      all.push_back(other);
  return all;
}

Flat exact(Flat place) {
  constexpr double kSame = 1e-6, kFine = 1e-7;  // metres
  if (const Flat round = tenth(place); distance(round, place) < kSame) return round;
  return {std::round(place.u / kFine) * kFine, std::round(place.v / kFine) * kFine};
}

double roundShare(double share, double near) {
  return std::fabs(share - 0.5) < near ? 0.5 : std::clamp(std::round(share * 1000) / 1000, 0.001, 0.999);
}

Message MiddleSnap::said() const {
  if (onAxis) return say("Here is the middle line of the piece (hold Ctrl to leave it).");
  return say("Here is the middle of {0} (hold Ctrl to leave it).", edge);
}

std::optional<MiddleSnap> middleNear(const Piece& piece, Flat paper, double near) {
  std::optional<MiddleSnap> found;
  double nearest = near;
  const auto take = [&](Flat place, const std::string& edge, bool onAxis) {
    if (distance(place, paper) > nearest || (found && distance(place, paper) == nearest)) return;
    nearest = distance(place, paper), found = MiddleSnap{exact(place), edge, onAxis};
  };
  const auto symmetry = symmetryOf(piece.outline);
  for (std::size_t k = 0; k < piece.outline.edges.size(); ++k) {
    const Edge& edge = piece.outline.edges[k];
    const bool across = symmetry && symmetry->partner[k] == k;
    const auto onAxis = [&](Flat place) { return std::fabs(cross(symmetry->axis, place - symmetry->through)) < 1e-5; };
    if (symmetry && onAxis(edge.curve.start)) take(edge.curve.start, edge.name, true);
    take(edge.curve.atFraction(0.5), edge.name, across);
  }
  if (found || !symmetry) return found;
  const Flat foot = symmetry->through + symmetry->axis * dot(paper - symmetry->through, symmetry->axis);
  take(foot, {}, true);
  return found;
}

double nearMiddle(const PointerSample& sample, const Hit& hit) {
  constexpr double kShare = 0.6;  // of the reach
  const bool metres = sample.where == PointerSample::Where::Table || sample.tip;
  return kShare * sample.reach * (metres ? 1 : hit.along);
}

void showMiddle(Preview& preview, const GestureContext& context, PieceId piece, const MiddleSnap& snap) {
  preview.table.dots.push_back(snap.place + context.table->at(piece));
  if (const auto place = spaceOf(*context.snapshot, piece, snap.place)) preview.space.dots.push_back(*place);
}

Vec3 onFacing(const PointerSample& sample, Vec3 through) {
  const double slope = dot(sample.ray.direction, sample.facing);
  if (std::fabs(slope) < 0.05) return through;  // looking along the plane: nothing sensible
  return sample.ray.origin + sample.ray.direction * (dot(through - sample.ray.origin, sample.facing) / slope);
}

Vec3 handAt(const PointerSample& sample, Vec3 through) {
  return sample.tip ? sample.tip->carry : onFacing(sample, through);
}

std::optional<Rigid> tipMotion(const PointerSample& from, const PointerSample& to) {
  if (!from.tip || !to.tip) return std::nullopt;
  Rigid motion = after(*to.tip, {from.tip->w, -from.tip->x, -from.tip->y, -from.tip->z, {}});
  motion.carry = to.tip->carry - motion.turned(from.tip->carry);
  return motion;
}

namespace {

template <class Point>
void between(std::span<const Point> line, std::size_t from, std::size_t to, double miss,
             std::vector<std::size_t>& kept) {
  std::size_t worst = from;
  double most = miss;
  for (std::size_t i = from + 1; i < to; ++i)
    if (const double away = awayFromSegment(line[from], line[to], line[i]); away > most) most = away, worst = i;
  if (worst == from) return;
  between(line, from, worst, miss, kept);
  kept.push_back(worst);
  between(line, worst, to, miss, kept);
}

}  // namespace

template <class Point>
std::vector<std::size_t> mattering(std::span<const Point> line, double miss) {
  if (line.empty()) return {};
  std::vector<std::size_t> kept{0};
  if (line.size() == 1) return kept;
  between(line, 0, line.size() - 1, miss, kept);
  kept.push_back(line.size() - 1);
  return kept;
}
template std::vector<std::size_t> mattering(std::span<const Flat>, double);
template std::vector<std::size_t> mattering(std::span<const Vec3>, double);

std::vector<Flat> edgeOnTable(const GestureContext& context, const EdgeRef& part) {
  std::vector<Flat> line;
  const Piece* piece = context.snapshot->document.find(part.piece.id);
  const Edge* edge = piece ? findEdge(*piece, part.edge) : nullptr;
  if (!edge) return line;
  const Flat lies = context.table->at(piece->id);
  for (const Flat p : edge->curve.evenly(part.from, part.to, 40)) line.push_back(p + lies);
  return line;
}

double lengthOf(const GestureContext& context, const EdgeRef& part) {
  const Piece* piece = context.snapshot->document.find(part.piece.id);
  const Edge* edge = piece ? findEdge(*piece, part.edge) : nullptr;
  return edge ? edge->curve.length() * (part.to - part.from) : 0;
}

void showEdge(Preview& preview, const GestureContext& context, const EdgeRef& part, const Colour& colour) {
  auto space = edgeInSpace(*context.snapshot, part);
  if (space.empty()) return;
  preview.space.lines.push_back({std::move(space), colour, 4, false});
  preview.table.lines.push_back({edgeOnTable(context, part), colour, false});
}

std::string easeSaid(const GestureContext& context, double one, double other) {
  constexpr double kNothing = 5e-5;  // metres: too little to be told in any unit
  const double spare = std::fabs(other - one);
  const std::string sign = other >= one || spare < kNothing ? "+" : "−";
  return context.said(one) + " / " + context.said(other) + "   " + sign + context.said(spare) + " (" + sign +
         fixed(one > 0 ? 100 * spare / one : 0, 1) + " %)";
}

void showOnPaper(Preview& preview, const GestureContext& context, PieceId id, const std::vector<Flat>& line,
                 const Colour& colour) {
  constexpr double kStride = 0.008;  // metres: cloth bends between the places
  const Piece* piece = context.snapshot->document.find(id);
  if (!piece || line.empty()) return;
  const Flat lies = context.table->at(id);
  const Stand stand(*piece);
  SceneLine space{{}, colour, 3, false};
  TableLine table{{}, colour, false};
  for (std::size_t i = 0; i < line.size(); ++i) {
    table.points.push_back(line[i] + lies);
    const Flat next = line[std::min(i + 1, line.size() - 1)];
    const int steps = std::max(1, static_cast<int>(distance(line[i], next) / kStride));
    for (int k = 0; k < steps; ++k) space.points.push_back(stand(lerp(line[i], next, static_cast<double>(k) / steps)));
  }
  preview.space.lines.push_back(std::move(space));
  preview.table.lines.push_back(std::move(table));
}

void showOnCopies(Preview& preview, const GestureContext& context, PieceId piece, std::vector<Flat> line) {
  for (Flat& p : line) p.u = -p.u;
  for (const PieceId copy : copiesOf(context.snapshot->document, piece))
    showOnPaper(preview, context, copy, line, kPartner);
}

}  // namespace karinui
