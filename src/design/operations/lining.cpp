// A lining: every lined piece once more, beneath it. Seams between lined pieces are sewn in the lining too; elsewhere
// the lining's edges are caught in with the piece's own, as when a lined garment is bagged out.
#include <algorithm>
#include <map>
#include <set>

#include "design/operations/cut_parts.h"
#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"
#include "karinui/pattern/pockets.h"

namespace karinui {

namespace {

constexpr double kLeastPart = 0.01;  // of an edge that is sewn by itself

using Copies = std::map<PieceId, PieceId>;  // of each lined piece its lining
using LiningRun = std::vector<EdgeSpan>;
using Parts = std::vector<DividedPart::EdgePart>;

bool inside(const Document& document, const Copies& copies, const LiningRun& side) {
  return std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
    return copies.contains(span.piece) && document.find(span.piece)->outline.find(span.edge);
  });
}

// What of `to`, the edges of a piece, are parts `of` a part of it.
Parts composed(const Parts& of, Parts to) {
  std::erase_if(to, [&](DividedPart::EdgePart& part) {
    const auto first = std::find_if(of.begin(), of.end(), [&](const auto& p) { return p.own.edge == part.piece.edge; });
    if (first == of.end()) return true;  // the open edge of another run
    const double from = first->piece.from, whole = first->piece.to - from;
    part.piece = {first->piece.piece, first->piece.edge, from + part.piece.from * whole, from + part.piece.to * whole};
    return false;
  });
  return to;
}

// The lining of a piece: as the piece, or shorter at its runs of open edges.
Result<DividedPart> liningOf(const Piece& outer, const std::vector<RunOnPiece>& open, double shorter) {
  DividedPart lining{outer.outline, {}, {}};
  for (const Edge& edge : outer.outline.edges)
    lining.edges.push_back({{outer.id, edge.name, 0, 1}, {{}, edge.name, 0, 1}});
  if (shorter == 0) return lining;
  Piece piece = outer;
  for (const RunOnPiece& run : open) {
    if (run.piece != outer.id) continue;
    auto shortened = shortenedAt(piece, run.edges, shorter);
    if (!shortened) return shortened.error();
    lining.edges = composed(lining.edges, std::move(shortened->edges));
    piece.outline = lining.outline = std::move(shortened->outline);
  }
  return lining;
}

// Notches go with their places on the edges.
void followMarks(std::vector<Mark>& marks, const Parts& parts) {
  std::erase_if(marks, [&](Mark& mark) {
    for (const auto& part : parts)
      if (part.piece.edge == mark.edge && mark.fraction >= part.piece.from && mark.fraction <= part.piece.to) {
        mark.edge = part.own.edge;
        mark.fraction = (mark.fraction - part.piece.from) / (part.piece.to - part.piece.from);
        return false;
      }
    return true;  // drill holes, too
  });
}

// What of a piece's edges no seam of the lining holds, as runs that go on over corners.
std::vector<LiningRun> freeRuns(const Piece& piece, const std::vector<EdgeSpan>& held,
                                const std::set<std::string>& open, const AllowancePlan& kinds) {
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
  std::vector<LiningRun> runs;
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

// Beneath what a lining lies: the lined pieces, and the bags of pockets that hang behind them. Of pieces in one layer
// the linings lie in one, too.
std::map<PieceId, PieceId> lowestOf(const Document& document, const std::vector<PieceRef>& pieces) {
  std::map<int, PieceId> lowest;  // by the layer of the lined
  const auto lower = [&](int layer, PieceId id) {
    const auto [at, first] = lowest.emplace(layer, id);
    if (!first && document.find(id)->layer < document.find(at->second)->layer) at->second = id;
  };
  for (const PieceRef& ref : pieces) lower(document.find(ref.id)->layer, ref.id);
  for (const SewnPocket& pocket : pocketsOf(document.pattern)) {
    const Seam& round = document.pattern.seams.at(pocket.round);
    for (const PieceRef& ref : pieces)
      for (const SeamId id : pocket.caught)
        for (const EdgeSpan& span : document.pattern.seams.at(id).a)
          if (span.piece == ref.id)
            for (const PieceId bag : {round.a.front().piece, round.b.front().piece})
              lower(document.find(ref.id)->layer, bag);
  }
  for (const SeamId id : bagsOnLines(document.pattern))
    for (const PieceRef& ref : pieces)
      if (const Seam& seam = *document.find(id); seam.a.front().piece == ref.id)
        lower(document.find(ref.id)->layer, seam.b.front().piece);
  std::map<PieceId, PieceId> all;
  for (const PieceRef& ref : pieces) all[ref.id] = lowest.at(document.find(ref.id)->layer);
  return all;
}

std::vector<PieceId> idsOf(const std::map<PieceId, PieceId>& lowest) {
  std::vector<PieceId> ids;
  for (const auto& [piece, id] : lowest) ids.push_back(id);
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
  if (op.shorter && !(*op.shorter >= 0 && *op.shorter <= 0.5))
    return refused(say("A lining is 0 to 50 cm shorter at its open edges."));
  if (op.shorter && *op.shorter > 0 && op.open.empty())
    return refused(say("Say at which edges the lining is shorter: open=front.hem."));
  if (op.eases == Choice::Auto && !context.recorded) op.eases = Choice::Yes;
  if (const auto room = withLayersBeneath(before, idsOf(lowestOf(before, op.pieces))); !room) return room.error();
  return {};
}

Result<Document> perform(const Document& before, const LinePieces& op, Context& context) {
  const std::map<PieceId, PieceId> lowest = lowestOf(before, op.pieces);
  auto room = withLayersBeneath(before, idsOf(lowest));
  if (!room) return room.error();
  if (context.advise && before.drape.last && std::any_of(op.pieces.begin(), op.pieces.end(), [&](const PieceRef& ref) {
        return !before.find(ref.id)->form || before.drape.dirty.contains(ref.id);
      }))
    context.advise({say("Drape the garment before it is lined: the lining then lies close inside it.")});
  Document after = *std::move(room);
  Copies copies;
  std::uint32_t made = 0;
  for (const PieceRef& ref : op.pieces) copies[ref.id] = mint<PieceId>(before, made++);
  std::vector<EdgeRef> open = op.open;
  for (EdgeRef& edge : open) edge.from = 0, edge.to = 1;
  const std::vector<RunOnPiece> openRuns = runsOf(before, open);
  const double shorter = op.shorter.value_or(Length{0});
  Parts parts;
  std::vector<EdgeSpan> held;  // what no run of free edges has
  for (const PieceRef& ref : op.pieces) {
    const Piece& outer = *after.find(ref.id);
    auto cut = liningOf(outer, openRuns, shorter);
    if (!cut) return cut.error();
    Piece lining = outer;
    lining.id = copies.at(ref.id);
    lining.outline = std::move(cut->outline);
    lining.name = usableName(after, outer.name + "_lining");
    lining.fabric = op.fabric, lining.interfacing.clear();
    lining.layer = after.find(lowest.at(ref.id))->layer - 1;
    lining.lines.clear();
    followMarks(lining.marks, cut->edges);
    for (auto& part : cut->edges) {
      part.own.piece = lining.id;
      held.push_back({ref.id, part.piece.edge, 0, part.piece.from}),
          held.push_back({ref.id, part.piece.edge, part.piece.to, 1});
    }
    const auto mirror = copies.find(outer.mirrorOf);
    lining.mirrorOf = mirror == copies.end() ? PieceId() : mirror->second;
    auto form = liftedForm(lining, outer, before.settings.spacing, [&](Flat place) {
      return LiftedPlace{place, -kLayersApart * (outer.layer - lining.layer)};
    });
    if (!form) return form.error();
    lining.form = *std::move(form);
    if (const auto own = before.cutting.find(ref.id); own != before.cutting.end())
      after.cutting[lining.id] = own->second;
    if (shorter > 0)
      gradeParts(after.grading, outer, cut->edges, lining);
    else if (const auto own = before.grading.pieces.find(ref.id); own != before.grading.pieces.end())
      after.grading.pieces[lining.id] = own->second;
    parts.insert(parts.end(), cut->edges.begin(), cut->edges.end());
    after = withPiece(std::move(after), std::move(lining));
  }
  std::uint32_t sewn = 0;
  for (const auto& [id, seam] : before.pattern.seams) {
    if (!inside(before, copies, seam.a) || !inside(before, copies, seam.b)) continue;
    held.insert(held.end(), seam.a.begin(), seam.a.end()), held.insert(held.end(), seam.b.begin(), seam.b.end());
    Seam own = seam;
    own.id = mint<SeamId>(before, sewn++);
    own.name.clear();
    own.a = onParts(seam.a, parts), own.b = onParts(seam.b, parts);
    if (own.a.empty() || own.b.empty()) continue;
    if (op.eases == Choice::Yes)
      if (const auto ease = easeOnParts(before, seam, after, own)) after.eases[own.id] = *ease;
    after.pattern.seams[own.id] = std::move(own);
  }
  const AllowancePlan kinds(before.pattern, before.allowances);
  for (const PieceRef& ref : op.pieces) {
    std::set<std::string> free;
    for (const EdgeRef& edge : open)
      if (edge.piece == ref) free.insert(edge.edge);
    for (const LiningRun& run : freeRuns(*before.find(ref.id), held, free, kinds)) {
      Seam seam;
      seam.id = mint<SeamId>(before, sewn++);
      seam.a = run, seam.b = onParts(run, parts);
      seam.reversed = false;
      seam.tie = Seam::Tie::Pleat;  // the piece's edge may be sewn to others as well
      after.pattern.seams[seam.id] = std::move(seam);
    }
  }
  return after;
}

}  // namespace karinui
