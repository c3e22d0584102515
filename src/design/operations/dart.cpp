#include <cmath>

#include "design/operations/operations.h"

namespace karinui {

namespace {

struct Dart {
  std::string edge;
  double at = 0;
  Flat tip;
};

// One dart and its seam, on a piece and on its symmetric copies. What became of the edges is left in `map`.
Result<Document> darted(const Document& before, const AddDart& op, const Dart& dart, EdgeMap& map,
                        std::uint32_t& seams) {
  const PieceId id = op.edge.piece.id;
  const Piece& piece = *before.find(id);
  const auto made = addDart(piece, dart.edge, dart.at, op.width, dart.tip, op.name);
  if (!made) return made.error();
  map = made->edited.edges;
  std::vector<PieceId> others;
  Document after = withEdit(before, made->edited, &others);
  const auto sew = [&](PieceId where, const std::string& to, const std::string& back) {
    Seam seam;
    seam.id = madeBy<SeamId>(before.operations + 1, seams++);
    seam.a = {{where, to, 0, 1}};
    seam.b = {{where, back, 0, 1}};
    seam.reversed = true;  // from the mouth to the tip, and back
    after.pattern.seams[seam.id] = std::move(seam);
  };
  sew(id, made->to, made->back);
  const Outline& mine = made->edited.piece.outline;
  for (const PieceId other : others) {  // a copy's edges run the other way round
    const auto& edges = after.find(other)->outline.edges;
    const auto named = [&](const std::string& name) { return edges[edges.size() - 1 - *mine.find(name)].name; };
    sew(other, named(made->back), named(made->to));
  }
  return after;
}

Result<Document> dartedOnHalves(const Document& before, const AddDart& op) {
  const Piece& piece = *before.find(op.edge.piece.id);
  EdgeMap map;
  std::uint32_t seams = 0;
  auto after = darted(before, op, {op.edge.edge, op.at, op.tip}, map, seams);
  if (!after || op.symmetric != Choice::Yes) return after;
  const auto symmetry = symmetryOf(piece.outline);
  const auto image = imageOf(piece.outline, *symmetry, {*piece.outline.find(op.edge.edge), op.at});
  const std::string& other = piece.outline.edges[image->edge].name;
  const Flat tip = symmetry->image(op.tip);
  if (other == op.edge.edge && std::fabs(op.at - 0.5) < 1e-6 && distance(tip, op.tip) < 1e-6) return after;
  const auto there = placeNow(map, piece.id, other, image->at);
  if (!there) return refused(say("The darts of both halves would meet; write symmetric=no for one alone."));
  return darted(*after, op, {there->first, there->second, tip}, map, seams);
}

}  // namespace

Done resolve(const Document& before, AddDart& op, Context& context) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (op.name.empty()) op.name = "dart";
  if (Done done = checkName(op.name); !done) return done;
  if (!(op.width > 0 && op.width <= 1)) return refused(say("A dart is between 1 mm and 1 m wide."));
  const Piece& piece = *before.find(op.edge.piece.id);
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& symmetry) {
    return imageOf(piece.outline, symmetry, {*piece.outline.find(op.edge.edge), op.at}).has_value();
  });
}

Result<Document> perform(const Document& before, const AddDart& op, Context& context) {
  auto after = dartedOnHalves(before, op);
  if (after) tellMisfits(before, *after, context);  // a sewn edge is shorter by what its dart takes up
  return after;
}

}  // namespace karinui
