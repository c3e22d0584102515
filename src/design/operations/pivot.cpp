#include <cmath>

#include "design/operations/operations.h"
#include "karinui/pattern/darts.h"

namespace karinui {

namespace {

std::optional<PaperDart> dartWith(const Document& document, const EdgeRef& side) {
  const Outline& outline = document.find(side.piece.id)->outline;
  for (const PaperDart& dart : dartsOf(document.pattern))
    if (dart.piece == side.piece.id &&
        (outline.edges[dart.to].name == side.edge || outline.edges[dart.back].name == side.edge))
      return dart;
  return std::nullopt;
}

}  // namespace

Done resolve(const Document& before, PivotDart& op, Context& context) {
  op.dart.from = 0, op.dart.to = 1, op.to.from = 0, op.to.to = 1;
  if (Done done = resolve(before, op.dart); !done) return done;
  if (Done done = resolve(before, op.to); !done) return done;
  const Piece& piece = *before.find(op.dart.piece.id);
  if (op.dart.piece != op.to.piece) return refused(say("A dart is moved to another edge of its own piece."));
  const auto dart = dartWith(before, op.dart);
  if (!dart) return refused(say("“{0}” of {1} is no side of a dart.", op.dart.edge, piece.name));
  op.dart.edge = piece.outline.edges[dart->to].name;
  if (!piece.outline.find(op.to.edge)) return refused(say("A dart is moved to another edge of its own piece."));
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& symmetry) {
    const auto other = symmetry.partner[dart->back];
    return other && *other != dart->to &&
           imageOf(piece.outline, symmetry, {*piece.outline.find(op.to.edge), op.at}).has_value();
  });
}

Result<Document> perform(const Document& before, const PivotDart& op, Context&) {
  const PieceId id = op.dart.piece.id;
  const Outline outline = before.find(id)->outline;
  const auto moved = pivotDart(*before.find(id), op.dart.edge, op.to.edge, op.at);
  if (!moved) return moved.error();
  Document after = withEdit(before, *moved);
  if (op.symmetric != Choice::Yes) return after;
  const auto symmetry = symmetryOf(outline);
  const std::size_t back = (*outline.find(op.dart.edge) + 1) % outline.edges.size();
  const auto image = imageOf(outline, *symmetry, {*outline.find(op.to.edge), op.at});
  const auto there = placeNow(moved->edges, id, outline.edges[image->edge].name, image->at);
  if (!there) return refused(say("The darts of both halves would meet; write symmetric=no for one alone."));
  const auto likewise =
      pivotDart(*after.find(id), outline.edges[*symmetry->partner[back]].name, there->first, there->second);
  if (!likewise) return likewise.error();
  return withEdit(std::move(after), *likewise);
}

}  // namespace karinui
