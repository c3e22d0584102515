#include <algorithm>
#include <cmath>

#include "design/operations/copied_joins.h"
#include "design/spoken.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

// Whether one of them is sewn to an edge that has another side only as a ring has.
bool sewnToRings(const Document& document, const std::vector<PieceRef>& pieces) {
  const auto mine = [&](const EdgeSpan& span) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const PieceRef& piece) { return piece.id == span.piece; });
  };
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto& [own, other] : {std::pair{&seam.a, &seam.b}, std::pair{&seam.b, &seam.a}})
      if (std::any_of(own->begin(), own->end(), mine))
        for (const EdgeSpan& span : *other) {
          const EdgeRef part{PieceRef(span.piece), span.edge, span.from, span.to};
          if (!mine(span) && !mirrorImage(document, part) && mirrorImage(document, part, true)) return true;
        }
  return false;
}

}  // namespace

Done resolve(const Document& before, MirrorPiece& op, Context& context) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  decideSeamsWithin(before, op.pieces, op.seams, context);
  if (op.rings == Choice::Yes && !op.sewn)
    return refused(say("Only copies that are sewn as the pieces are have another side of a band: sewn=yes."));
  if (op.rings == Choice::Auto && op.sewn && !context.recorded && sewnToRings(before, op.pieces))
    op.rings = Choice::Yes;
  if (op.pieces.size() > 1) return checkNoNameOfSeveral(op.name);
  if (op.name.empty()) op.name = nameOfCopy(before, before.find(op.pieces.front().id)->name);
  return checkNewName(before, op.name);
}

namespace {

// Whether a piece stands as its own mirror image: a strap that is alike on both sides may cross the middle on its way.
bool standsInItself(const Piece& piece, const PaperSymmetry& symmetry) {
  constexpr double kApart = 0.1;  // metres
  const Stand stand(piece);
  return std::all_of(piece.outline.edges.begin(), piece.outline.edges.end(), [&](const Edge& edge) {
    const Vec3 here = stand(edge.curve.start), there = stand(symmetry.image(edge.curve.start));
    return distance(Vec3{-here.x, here.y, here.z}, there) < kApart;
  });
}

// The copy of a back or a skirt's front, which lie across the middle, stands where it stands itself.
void tellInItself(const Piece& piece, const Context& context) {
  constexpr double kMiddle = 0.03;  // metres
  const auto symmetry = context.advise && piece.form ? symmetryOf(piece.outline) : std::nullopt;
  if (!symmetry || std::fabs(Stand(piece)(symmetry->through).x) > kMiddle || !standsInItself(piece, *symmetry)) return;
  context.advise({say("“{0}” lies on both sides of the body already, and its copy in the same place: take one of them "
                      "away, or move it.",
                      piece.name),
                  piece.id});
}

// With what sews the copies to others, if it is to be; else it is told that there is such.
Document sewnLikewise(Document document, const MirrorPiece& op, const CopiesOf& copies, const Context& context) {
  const std::size_t made = op.seams == Choice::Yes ? seamsWithin(document, op.pieces).size() : 0;
  MirroredSeams likewise = withMirroredSeams(document, op.pieces, copies, made, op.rings == Choice::Yes);
  if (!op.sewn) {
    if (!context.advise || likewise.sewn == 0) return document;
    for (const PieceRef& piece : op.pieces) {
      const PieceId copy = copies.at(piece.id);
      const auto onCopy = [&](const auto& one) {
        const auto holds = [&](const EdgeSpan& span) { return span.piece == copy; };
        return !document.find(one.first) && (std::any_of(one.second.a.begin(), one.second.a.end(), holds) ||
                                             std::any_of(one.second.b.begin(), one.second.b.end(), holds));
      };
      const auto& seams = likewise.document.pattern.seams;
      if (std::any_of(seams.begin(), seams.end(), onCopy))
        context.advise({say("“{0}” is not sewn to other pieces, as “{1}” is; sewn=yes does that, too.",
                            document.find(copy)->name, document.find(piece.id)->name),
                        copy});
    }
    return document;
  }
  if (context.advise)
    for (const auto& [id, piece] : likewise.left)
      context.advise(
          {say("Seam {0} is on the side of “{1}” alone: what it is sewn to there has no mirror image, or one that "
               "is sewn already.",
               spoken(*document.find(id)), document.find(piece)->name),
           copies.at(piece)});
  return std::move(likewise.document);
}

}  // namespace

Result<Document> perform(const Document& before, const MirrorPiece& op, Context& context) {
  Document after = before;
  CopiesOf made;
  for (const PieceRef& piece : op.pieces) {
    const Piece& own = *before.find(piece.id);
    tellInItself(own, context);
    Piece copy = mirrored(own);
    copy.id = mint<PieceId>(before, static_cast<std::uint32_t>(made.size()));
    copy.name = op.name.empty() ? nameOfCopy(after, own.name) : op.name;
    copy.mirrorOf = piece.id;
    made[piece.id] = copy.id;
    if (const auto graded = before.grading.pieces.find(piece.id); graded != before.grading.pieces.end())
      after.grading.pieces[copy.id] = mirroredGrading(graded->second, own.outline, copy.outline);
    copyAllowances(after.allowances, own, copy, true);
    after = withPiece(std::move(after), std::move(copy));
  }
  CopiesOf copies;  // what they are fastened to may have a mirror image, too
  for (const auto& [own, piece] : before.pattern.pieces)
    if (before.find(piece->mirrorOf)) copies[own] = piece->mirrorOf, copies[piece->mirrorOf] = own;
  for (const auto& [own, copy] : made) copies[own] = copy;
  if (op.seams == Choice::Yes) after = withCopiedSeams(std::move(after), op.pieces, made, true);
  after = sewnLikewise(std::move(after), op, made, context);
  return withCopiedFastenings(std::move(after), op.pieces, copies, true, context);
}

}  // namespace karinui
