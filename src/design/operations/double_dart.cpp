#include <cmath>

#include "design/operations/operations.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

// One dart and its seam, on one piece.
Result<Document> darted(const Document& before, const AddDoubleDart& op, PieceId id, Flat from, Flat to,
                        std::uint32_t& seams) {
  const Piece& piece = *before.find(id);
  auto made = addDoubleDart(piece, from, to, op.width, op.at, op.name,
                            linesOfLattice(withElasticLines(before.pattern, before.allowances), piece));
  if (!made) return made.error();
  Document after = withPiece(before, std::move(made->piece));
  Seam seam;
  seam.id = madeBy<SeamId>(before.operations + 1, seams++);
  for (const std::size_t k : {0U, 1U}) seam.a.push_back({id, made->edges[k], 0, 1});
  for (const std::size_t k : {2U, 3U}) seam.b.push_back({id, made->edges[k], 0, 1});
  seam.reversed = true;
  after.pattern.seams[seam.id] = std::move(seam);
  return after;
}

}  // namespace

Done resolve(const Document& before, AddDoubleDart& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.name.empty()) op.name = "dart";
  if (Done done = checkName(op.name); !done) return done;
  return resolveSymmetric(*before.find(op.piece.id), op.symmetric, context, [](const PaperSymmetry&) { return true; });
}

Result<Document> perform(const Document& before, const AddDoubleDart& op, Context&) {
  constexpr double kOnAxis = 1e-4;  // metres
  std::vector<std::array<Flat, 2>> places{{op.from, op.to}};
  const Piece& piece = *before.find(op.piece.id);
  if (op.symmetric == Choice::Yes)
    if (const auto symmetry = symmetryOf(piece.outline)) {
      const Flat from = symmetry->image(op.from), to = symmetry->image(op.to);
      if (distance(from, op.from) > kOnAxis || distance(to, op.to) > kOnAxis) places.push_back({from, to});
    }
  std::uint32_t seams = 0;
  Document after = before;
  for (const auto& [from, to] : places) {
    auto one = darted(after, op, op.piece.id, from, to, seams);
    if (!one) return one;
    for (const PieceId copy : likenesses(before, op.piece.id)) {
      one = darted(*one, op, copy, {-from.u, from.v}, {-to.u, to.v}, seams);
      if (!one) return one;
    }
    after = *std::move(one);
  }
  return after;
}

}  // namespace karinui
