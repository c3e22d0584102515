#include <cmath>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kFarthestShift = 1;  // metres

Result<Document> shifted(const Document& before, PieceId id, const std::string& leg, double by) {
  const Piece piece = *before.find(id);
  auto moved = shiftDart(piece, leg, by);
  if (!moved) return moved.error();
  if (piece.form) moved->piece.form = followedForm(piece, moved->piece.outline);
  std::vector<PieceId> others;
  Document after = withEdit(before, *moved, &others);
  for (const PieceId other : others) {  // what lies within the copy, too
    const Piece& was = *before.find(other);
    Piece now = *after.find(other);
    if (was.form) now.form = followedForm(was, now.outline);
    for (std::size_t k = 0; k < now.marks.size() && k < piece.marks.size(); ++k)
      if (piece.marks[k].edge.empty() && !(piece.marks[k].place == moved->piece.marks[k].place)) {
        const Flat step = moved->piece.marks[k].place - piece.marks[k].place;
        now.marks[k].place = was.marks[k].place + Flat{-step.u, step.v};
      }
    after = withPiece(std::move(after), std::move(now));
  }
  return after;
}

// 1: as the outline runs; -1: the other way. The edges beside the dart are parts of one; the next ones lie at its ends.
Result<double> direction(const Outline& outline, const PaperDart& dart, const std::string& towards) {
  const auto& edges = outline.edges;
  const std::size_t n = edges.size();
  const auto name = [&](std::size_t edge) -> const std::string& { return edges[edge % n].name; };
  if (towards.empty() || towards == name(dart.back + 1) || towards == name(dart.back + 2)) return 1.0;
  if (towards == name(dart.to + n - 1) || towards == name(dart.to + n - 2)) return -1.0;
  return refused(say("“{0}” lies on neither side of the dart {1}; write towards={2} or towards={3}.", towards,
                     name(dart.to), name(dart.to + n - 2), name(dart.back + 2)));
}

}  // namespace

Done resolve(const Document& before, ShiftDart& op, Context& context) {
  op.dart.from = 0, op.dart.to = 1;
  if (Done done = resolve(before, op.dart); !done) return done;
  if (op.by == 0.0 || !(std::fabs(op.by) <= kFarthestShift))
    return refused(say("A dart is moved along its edge by up to 1 m, not by {0} mm.", fixed(op.by * 1e3, 1)));
  const Piece& piece = *before.find(op.dart.piece.id);
  const auto dart = dartWithLeg(before.pattern, op.dart.piece.id, op.dart.edge);
  if (!dart) return refused(say("“{0}” of {1} is no side of a dart.", op.dart.edge, piece.name));
  const auto& edges = piece.outline.edges;
  op.dart.edge = edges[dart->to].name;
  if (const auto way = direction(piece.outline, *dart, op.towards); !way) return way.error();
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& symmetry) {
    const auto other = symmetry.partner[dart->back];
    return other && *other != dart->to;
  });
}

Result<Document> perform(const Document& before, const ShiftDart& op, Context& context) {
  const PieceId id = op.dart.piece.id;
  const Outline outline = before.find(id)->outline;
  const double by =
      op.by * *direction(outline, *dartWithLeg(before.pattern, op.dart.piece.id, op.dart.edge), op.towards);
  auto after = shifted(before, id, op.dart.edge, by);
  if (after && op.symmetric == Choice::Yes) {
    const auto symmetry = symmetryOf(outline);
    const std::size_t back = (*outline.find(op.dart.edge) + 1) % outline.edges.size();
    after = shifted(*after, id, outline.edges[*symmetry->partner[back]].name, -by);
  }
  if (after) tellSeams(before, *after, context);
  return after;
}

}  // namespace karinui
