// A lining: every lined piece once more, beneath it. Seams between lined pieces are sewn in the lining too; elsewhere
// the lining's edges are caught in with the piece's own, as when a lined garment is bagged out.
#include <algorithm>
#include <set>

#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"

namespace karinui {

namespace {

constexpr double kLeastPart = 0.01;  // of an edge that is sewn by itself

using Copies = std::map<PieceId, PieceId>;  // of each lined piece its lining
using Run = std::vector<EdgeSpan>;

bool inside(const Document& document, const Copies& copies, const Run& side) {
  return std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
    return copies.contains(span.piece) && document.find(span.piece)->outline.find(span.edge);
  });
}
Run lined(const Copies& copies, Run side) {
  for (EdgeSpan& span : side) span.piece = copies.at(span.piece);
  return side;
}

// What of a piece's edges no seam of the lining holds, as runs that go on over corners.
std::vector<Run> freeRuns(const Piece& piece, const std::vector<EdgeSpan>& held, const std::set<std::string>& open,
                          const AllowancePlan& kinds) {
  std::vector<EdgeSpan> left;
  for (const Edge& edge : piece.outline.edges) {
    if (open.contains(edge.name) || kinds.kind(piece.id, edge.name) == EdgeKind::Fold) continue;
    std::vector<std::pair<double, double>> taken;
    for (const EdgeSpan& span : held)
      if (span.piece == piece.id && span.edge == edge.name) taken.emplace_back(span.from, span.to);
    std::sort(taken.begin(), taken.end());
    double from = 0;
    const auto add = [&](double to) {
      if (to - from > kLeastPart) left.push_back({piece.id, edge.name, from, to});
    };
    for (const auto& [begin, end] : taken) add(begin), from = std::max(from, end);
    add(1);
  }
  std::vector<Run> runs;
  const auto& edges = piece.outline.edges;
  const auto goesOn = [&](const EdgeSpan& a, const EdgeSpan& b) {
    return a.to == 1 && b.from == 0 && edges[(*piece.outline.find(a.edge) + 1) % edges.size()].name == b.edge;
  };
  for (const EdgeSpan& span : left) {
    if (runs.empty() || !goesOn(runs.back().back(), span)) runs.emplace_back();
    runs.back().push_back(span);
  }
  if (runs.size() > 1 && goesOn(runs.back().back(), runs.front().front())) {
    runs.back().insert(runs.back().end(), runs.front().begin(), runs.front().end());
    runs.erase(runs.begin());
  }
  return runs;
}

std::vector<PieceId> idsOf(const std::vector<PieceRef>& pieces) {
  std::vector<PieceId> ids;
  for (const PieceRef& ref : pieces) ids.push_back(ref.id);
  return ids;
}

}  // namespace

Done resolve(const Document& before, LinePieces& op, Context& context) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (op.fabric.empty()) op.fabric = "viscose";
  if (Done done = checkFabricName(before, op.fabric); !done) return done;
  for (EdgeRef& edge : op.open) {
    if (Done done = resolve(before, edge); !done) return done;
    if (std::none_of(op.pieces.begin(), op.pieces.end(), [&](const PieceRef& ref) { return ref.id == edge.piece.id; }))
      return refused(
          say("{0} is not lined, so its edge {1} cannot be left open.", before.find(edge.piece.id)->name, edge.edge));
  }
  if (const auto room = withLayersBeneath(before, idsOf(op.pieces)); !room) return room.error();
  if (context.advise && std::any_of(op.pieces.begin(), op.pieces.end(), [&](const PieceRef& ref) {
        return !before.find(ref.id)->form || before.drape.dirty.contains(ref.id);
      }))
    context.advise({say("Drape the garment before it is lined: the lining then lies close inside it.")});
  return {};
}

Result<Document> perform(const Document& before, const LinePieces& op, Context&) {
  auto room = withLayersBeneath(before, idsOf(op.pieces));
  if (!room) return room.error();
  Document after = *std::move(room);
  Copies copies;
  std::uint32_t made = 0;
  for (const PieceRef& ref : op.pieces) copies[ref.id] = mint<PieceId>(before, made++);
  for (const PieceRef& ref : op.pieces) {
    const Piece& outer = *after.find(ref.id);
    Piece lining = outer;
    lining.id = copies.at(ref.id);
    lining.name = usableName(after, outer.name + "_lining");
    lining.fabric = op.fabric, lining.interfacing.clear();
    lining.layer = outer.layer - 1;
    lining.lines.clear();
    std::erase_if(lining.marks, [](const Mark& mark) { return mark.edge.empty(); });
    const auto mirror = copies.find(outer.mirrorOf);
    lining.mirrorOf = mirror == copies.end() ? PieceId() : mirror->second;
    auto form = liftedForm(lining, outer, before.settings.spacing, [](Flat place) {
      return LiftedPlace{place, -kLayersApart};
    });
    if (!form) return form.error();
    lining.form = *std::move(form);
    if (const auto own = before.cutting.find(ref.id); own != before.cutting.end())
      after.cutting[lining.id] = own->second;
    if (const auto own = before.grading.pieces.find(ref.id); own != before.grading.pieces.end())
      after.grading.pieces[lining.id] = own->second;
    after = withPiece(std::move(after), std::move(lining));
  }
  std::uint32_t sewn = 0;
  std::vector<EdgeSpan> held;
  for (const auto& [id, seam] : before.pattern.seams) {
    if (!inside(before, copies, seam.a) || !inside(before, copies, seam.b)) continue;
    held.insert(held.end(), seam.a.begin(), seam.a.end()), held.insert(held.end(), seam.b.begin(), seam.b.end());
    Seam own = seam;
    own.id = mint<SeamId>(before, sewn++);
    own.name.clear();
    own.a = lined(copies, seam.a), own.b = lined(copies, seam.b);
    after.pattern.seams[own.id] = std::move(own);
  }
  const AllowancePlan kinds(before.pattern, before.allowances);
  for (const PieceRef& ref : op.pieces) {
    std::set<std::string> open;
    for (const EdgeRef& edge : op.open)
      if (edge.piece == ref) open.insert(edge.edge);
    for (const Run& run : freeRuns(*before.find(ref.id), held, open, kinds)) {
      Seam seam;
      seam.id = mint<SeamId>(before, sewn++);
      seam.a = run, seam.b = lined(copies, run);
      seam.reversed = false;
      seam.tie = Seam::Tie::Pleat;  // the piece's edge may be sewn to others as well
      after.pattern.seams[seam.id] = std::move(seam);
    }
  }
  return after;
}

}  // namespace karinui
