#include <cmath>

#include "design/operations/operations.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

// The other half's edge that was meant where a dart and the edge it is moved to lie on different halves of the piece,
// and both halves are to be changed alike: two such cuts would cross on the centre. Nothing: they lie on one half.
std::optional<std::string> edgeOnItsHalf(const Outline& outline, const PaperDart& dart, const EdgeRef& to, double at) {
  const auto symmetry = symmetryOf(outline);
  if (!symmetry) return std::nullopt;
  const auto side = [&](Flat place) { return cross(symmetry->axis, place - symmetry->through); };
  const std::size_t edge = *outline.find(to.edge);
  const Flat place = outline.edges[edge].curve.atFraction(at), mouth = outline.edges[dart.to].curve.start;
  const auto partner = symmetry->partner[edge];
  if (side(place) * side(mouth) >= 0 || !partner || *partner == edge) return std::nullopt;
  return outline.edges[*partner].name;
}

// What lies within the copy goes along there as it does within the piece.
Result<Document> withTurnedCopies(Document after, const Document& before, const EdgeRef& dart, const EdgeRef& to,
                                  double at) {
  const Piece& piece = *before.find(dart.piece.id);
  const auto& edges = piece.outline.edges;
  const std::string& back = edges[(*piece.outline.find(dart.edge) + 1) % edges.size()].name;
  for (const PieceId id : likenesses(before, piece.id)) {
    const Piece& copy = *before.find(id);
    const auto turned = pivotDart(copy, *edgeOnCopy(copy, piece, back), *edgeOnCopy(copy, piece, to.edge), 1 - at);
    if (!turned) return turned.error();
    Piece now = *after.find(id);
    now.holes = turned->piece.holes, now.lines = turned->piece.lines, now.form = turned->piece.form;
    for (std::size_t k = 0; k < now.marks.size(); ++k)
      if (now.marks[k].edge.empty()) now.marks[k].place = turned->piece.marks[k].place;
    after = withPiece(std::move(after), std::move(now));
  }
  return after;
}

Result<Document> pivoted(const Document& before, const EdgeRef& dart, const EdgeRef& to, double at, EdgeMap& map) {
  auto moved = pivotDart(*before.find(dart.piece.id), dart.edge, to.edge, at);
  if (!moved) return moved.error();
  Document after = withEdit(before, *moved);
  map = std::move(moved->edges);
  return withTurnedCopies(std::move(after), before, dart, to, at);
}

}  // namespace

Done resolve(const Document& before, PivotDart& op, Context& context) {
  op.dart.from = 0, op.dart.to = 1, op.to.from = 0, op.to.to = 1;
  if (Done done = resolve(before, op.dart); !done) return done;
  if (Done done = resolve(before, op.to); !done) return done;
  const Piece& piece = *before.find(op.dart.piece.id);
  if (op.dart.piece != op.to.piece) return refused(say("A dart is moved to another edge of its own piece."));
  const auto dart = dartWithLeg(before.pattern, op.dart.piece.id, op.dart.edge);
  if (!dart) return refused(say("“{0}” of {1} is no side of a dart.", op.dart.edge, piece.name));
  op.dart.edge = piece.outline.edges[dart->to].name;
  if (!piece.outline.find(op.to.edge)) return refused(say("A dart is moved to another edge of its own piece."));
  if (Done done = resolveSymmetric(
          piece, op.symmetric, context,
          [&](const PaperSymmetry& symmetry) {
            const auto other = symmetry.partner[dart->back];
            return other && *other != dart->to &&
                   imageOf(piece.outline, symmetry, {*piece.outline.find(op.to.edge), op.at}).has_value();
          });
      !done)
    return done;
  if (op.symmetric == Choice::Yes && !context.recorded)
    if (const auto meant = edgeOnItsHalf(piece.outline, *dart, op.to, op.at))
      return refused(
          say("“{0}” lies on the other half of “{1}” than the dart, and both halves are changed alike; write "
              "to={1}.{2}, or symmetric=no for one alone.",
              op.to.edge, piece.name, *meant));
  return {};
}

Result<Document> perform(const Document& before, const PivotDart& op, Context&) {
  const PieceId id = op.dart.piece.id;
  const Outline outline = before.find(id)->outline;
  EdgeMap map;
  auto after = pivoted(before, op.dart, op.to, op.at, map);
  if (!after || op.symmetric != Choice::Yes) return after;
  const auto symmetry = symmetryOf(outline);
  const std::size_t back = (*outline.find(op.dart.edge) + 1) % outline.edges.size();
  const auto image = imageOf(outline, *symmetry, {*outline.find(op.to.edge), op.at});
  const auto there = placeNow(map, id, outline.edges[image->edge].name, image->at);
  if (!there) return refused(say("The darts of both halves would meet; write symmetric=no for one alone."));
  const EdgeRef other{op.dart.piece, outline.edges[*symmetry->partner[back]].name};
  return pivoted(*after, other, {op.dart.piece, there->first}, there->second, map);
}

}  // namespace karinui
