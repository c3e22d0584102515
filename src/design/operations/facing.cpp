// Facings: of each piece one for each run of its edges, beneath it and sewn to it along the run. Where the pieces are
// sewn to each other beside the run, their facings are, too.
#include "karinui/pattern/facing.h"

#include <algorithm>

#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"

namespace karinui {

namespace {

struct Run {
  PieceId piece;
  std::vector<std::string> edges;
};

// The edges in the order of each outline, those that follow each other together.
std::vector<Run> runsOf(const Document& document, const std::vector<EdgeRef>& edges) {
  std::vector<Run> runs;
  std::vector<PieceId> pieces;
  for (const EdgeRef& edge : edges)
    if (std::find(pieces.begin(), pieces.end(), edge.piece.id) == pieces.end()) pieces.push_back(edge.piece.id);
  for (const PieceId id : pieces) {
    const auto& all = document.find(id)->outline.edges;
    const std::size_t n = all.size();
    const auto meant = [&](std::size_t k) {
      return std::find(edges.begin(), edges.end(), EdgeRef{PieceRef(id), all[k % n].name}) != edges.end();
    };
    std::size_t start = 0;
    while (start < n && meant(start)) ++start;  // begun where no run goes on
    for (std::size_t k = 0; k < n; ++k) {
      if (!meant(start + k)) continue;
      if (k == 0 || !meant(start + k - 1)) runs.push_back({id, {}});
      runs.back().edges.push_back(all[(start + k) % n].name);
    }
  }
  return runs;
}

// The parts of a seam's side that facings have, on the facings.
std::vector<EdgeSpan> faced(const std::vector<EdgeSpan>& side, const std::vector<Facing::Part>& parts) {
  std::vector<EdgeSpan> now;
  for (const EdgeSpan& span : side)
    for (const Facing::Part& part : parts) {
      if (part.piece.piece != span.piece || part.piece.edge != span.edge) continue;
      const double from = std::max(span.from, part.piece.from), to = std::min(span.to, part.piece.to);
      const double whole = part.piece.to - part.piece.from;
      if (to - from < 1e-6) continue;
      EdgeSpan own = part.facing;
      own.from = (from - part.piece.from) / whole, own.to = (to - part.piece.from) / whole;
      now.push_back(own);
    }
  return now;
}

// Notches of the run, which its facing shares.
std::vector<Mark> marksOf(const Piece& piece, const Run& run) {
  std::vector<Mark> marks;
  for (const Mark& mark : piece.marks)
    if (std::find(run.edges.begin(), run.edges.end(), mark.edge) != run.edges.end()) marks.push_back(mark);
  return marks;
}

void gradeLike(Grading& grading, const Piece& piece, const Facing& facing, const Piece& made) {
  if (!grading.pieces.contains(piece.id)) return;
  Grading own = grading;
  EdgeMap map;
  for (const Edge& edge : piece.outline.edges) map[{piece.id, edge.name}];
  for (const Facing::Part& part : facing.parts)
    map[{piece.id, part.piece.edge}].push_back({part.piece.from, part.piece.to, {made.id, part.facing.edge, 0, 1}});
  updateGrading(own, piece, map, {&made});
  grading.pieces[made.id] = own.pieces.at(made.id);
}

}  // namespace

Done resolve(const Document& before, FaceEdges& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are faced: edges=front.neck."));
  std::vector<EdgeRef> once;
  for (EdgeRef& edge : op.edges) {
    edge.from = 0, edge.to = 1;
    if (Done done = resolve(before, edge); !done) return done;
    if (std::find(once.begin(), once.end(), edge) == once.end()) once.push_back(edge);
  }
  op.edges = std::move(once);
  if (!(op.width >= 0.005 && op.width <= 0.5)) return refused(say("A facing is 5 mm to 50 cm deep."));
  if (!op.fabric.empty())
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  if (context.advise && std::any_of(op.edges.begin(), op.edges.end(), [&](const EdgeRef& edge) {
        return !before.find(edge.piece.id)->form || before.drape.dirty.contains(edge.piece.id);
      }))
    context.advise({say("Drape the garment before it is faced: the facing then lies close inside it.")});
  return {};
}

Result<Document> perform(const Document& before, const FaceEdges& op, Context&) {
  const std::vector<Run> runs = runsOf(before, op.edges);
  std::vector<PieceId> outers;
  for (const Run& run : runs) outers.push_back(run.piece);
  auto room = withLayersBeneath(before, outers);
  if (!room) return room.error();
  Document after = *std::move(room);
  std::uint32_t made = 0, sewn = 0;
  const auto sew = [&](Seam seam) {
    seam.id = mint<SeamId>(before, sewn++);
    seam.name.clear();
    after.pattern.seams[seam.id] = std::move(seam);
  };
  std::vector<Facing::Part> beside;  // of all facings, but for the runs themselves
  for (const Run& run : runs) {
    const Piece& outer = *after.find(run.piece);
    auto facing = facingOf(outer, run.edges, op.width);
    if (!facing) return facing.error();
    Piece piece = outer;
    piece.id = mint<PieceId>(before, made++);
    piece.name = usableName(after, outer.name + "_facing");
    piece.outline = facing->outline;
    piece.holes.clear(), piece.lines.clear();
    piece.marks = marksOf(outer, run);
    piece.layer = outer.layer - 1;
    piece.mirrorOf = {}, piece.interfacing.clear();
    if (!op.fabric.empty()) piece.fabric = op.fabric;
    auto form = liftedForm(piece, outer, before.settings.spacing, [](Flat place) {
      return LiftedPlace{place, -kLayersApart};
    });
    if (!form) return form.error();
    piece.form = *std::move(form);
    if (const auto own = before.cutting.find(outer.id); own != before.cutting.end())
      after.cutting[piece.id] = own->second;
    gradeLike(after.grading, outer, *facing, piece);
    Seam seam;
    for (const std::string& edge : run.edges) seam.a.push_back({outer.id, edge}), seam.b.push_back({piece.id, edge});
    seam.reversed = false;
    seam.tie = Seam::Tie::Pleat;  // the piece's edge may be sewn to others as well
    sew(std::move(seam));
    for (Facing::Part& part : facing->parts) {
      part.facing.piece = piece.id;
      if (std::find(run.edges.begin(), run.edges.end(), part.piece.edge) == run.edges.end()) beside.push_back(part);
    }
    after = withPiece(std::move(after), std::move(piece));
  }
  for (const auto& [id, seam] : before.pattern.seams) {
    Seam own = seam;
    own.a = faced(seam.a, beside), own.b = faced(seam.b, beside);
    if (!own.a.empty() && !own.b.empty()) sew(std::move(own));
  }
  return after;
}

}  // namespace karinui
