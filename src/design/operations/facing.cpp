// Facings: of each piece one for each run of its edges, beneath it and sewn to it along the run. Where the pieces are
// sewn to each other beside the run, their facings are, too.
#include <algorithm>
#include <map>

#include "design/operations/cut_parts.h"
#include "design/operations/lifted_form.h"
#include "design/operations/merged.h"
#include "design/operations/operations.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

// Notches of the run, which its facing shares.
std::vector<Mark> marksOf(const Piece& piece, const RunOnPiece& run) {
  std::vector<Mark> marks;
  for (const Mark& mark : piece.marks)
    if (std::find(run.edges.begin(), run.edges.end(), mark.edge) != run.edges.end()) marks.push_back(mark);
  return marks;
}

// A facing that ends at a folded pleat goes on beyond it as another one, with nothing to hold the two together.
void tellPleated(const Document& before, const std::vector<RunOnPiece>& runs, const Context& context) {
  constexpr double kMeet = 1e-4;  // metres
  if (!context.advise) return;
  const std::vector<PaperPleat> pleats = pleatsOf(before.pattern);
  for (const RunOnPiece& run : runs) {
    const Piece& piece = *before.find(run.piece);
    for (const std::string& edge : run.edges) {
      const Curve& curve = findEdge(piece, edge)->curve;
      const bool beside = std::any_of(pleats.begin(), pleats.end(), [&](const PaperPleat& pleat) {
        return pleat.piece == piece.id &&
               (std::min(distance(pleat.fold, curve.start), distance(pleat.fold, curve.end)) < kMeet ||
                std::min(distance(pleat.place, curve.start), distance(pleat.place, curve.end)) < kMeet);
      });
      if (!beside) continue;
      context.advise(
          {say("“{0}” is pleated beside {1}, and the facing ends there. Face the edge before the pleat is "
               "folded: it is then one facing, and the pleat is folded over it.",
               piece.name, edge)});
      break;
    }
  }
}

// With the same edges of the symmetric copies, those that are not named themselves.
std::vector<EdgeRef> withImages(const Document& document, const FaceEdges& op) {
  std::vector<EdgeRef> edges = op.edges;
  for (const EdgeRef& edge : op.edges)
    for (const PieceId copy : copiesMeant(document, edge.piece.id, op.copies)) {
      const EdgeRef image{PieceRef(copy), *edgeOnCopy(*document.find(copy), *document.find(edge.piece.id), edge.edge)};
      const bool named = std::any_of(edges.begin(), edges.end(), [&](const EdgeRef& one) {
        return one.piece.id == copy && one.edge == image.edge;
      });
      if (!named) edges.push_back(image);
    }
  return edges;
}

// The facings of a piece and of its copy are each other's symmetric copies, where each has as many.
Document withLikeFacings(Document document, const std::map<PieceId, std::vector<PieceId>>& facings) {
  const auto there = [&](PieceId outer) {
    std::vector<PieceId> all;
    if (const auto own = facings.find(outer); own != facings.end())
      for (const PieceId id : own->second)
        if (document.find(id)) all.push_back(id);
    return all;
  };
  for (const auto& [outer, unused] : facings) {
    const PieceId of = document.find(outer)->mirrorOf;
    const std::vector<PieceId> own = there(outer), first = there(of);
    for (std::size_t k = 0; own.size() == first.size() && k < own.size(); ++k)
      document = withLikeness(std::move(document), first[k], own[own.size() - 1 - k]);
  }
  return document;
}

bool lieOnOne(const Document& document, const Seam& seam) {
  const PieceId piece = seam.a.front().piece;
  const auto own = [&](const EdgeSpan& span) {
    return span.piece == piece && document.find(piece)->outline.find(span.edge).has_value();
  };
  return std::all_of(seam.a.begin(), seam.a.end(), own) && std::all_of(seam.b.begin(), seam.b.end(), own);
}

// The facings on both sides of a dart become one, whose paper has the dart closed: the larger keeps its grain, the name
// is that of the first. Where they cannot lie edge to edge they stay apart, sewn to each other.
Document closedOver(Document document, const std::vector<SeamId>& darts, std::uint32_t seams, const Context& context) {
  Context silent = context;
  silent.advise = {};
  for (const SeamId dart : darts) {
    const Seam seam = document.pattern.seams.at(dart);
    MergePieces merge;
    for (const auto& [side, run] : {std::pair{&seam.a, &merge.a}, std::pair{&seam.b, &merge.b}})
      for (const EdgeSpan& span : *side) run->push_back({PieceRef(span.piece), span.edge});
    const PieceId a = merge.a.front().piece.id, b = merge.b.front().piece.id;
    if (document.find(a)->outline.area() < document.find(b)->outline.area()) std::swap(merge.a, merge.b);
    if (!resolveRuns(document, merge, silent)) continue;
    const std::string name = document.find(std::min(a, b))->name;
    auto one = merged(document, merge, nullptr, seams, silent, false);
    if (!one) continue;
    document = *std::move(one);
    auto piece = std::make_shared<Piece>(*document.find(merge.a.front().piece.id));
    piece->name = name;
    document.pattern.pieces[piece->id] = std::move(piece);
  }
  return document;
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
  if (op.copies == Choice::Yes) {
    std::vector<PieceRef> pieces;
    for (const EdgeRef& edge : op.edges) pieces.push_back(edge.piece);
    if (Done done = resolveCopies(before, pieces, op.copies, context); !done) return done;
  }
  for (Choice* choice : {&op.eases, &op.closed})
    if (*choice == Choice::Auto && !context.recorded) *choice = Choice::Yes;
  return {};
}

Result<Document> perform(const Document& before, const FaceEdges& op, Context& context) {
  if (context.advise && before.drape.last && std::any_of(op.edges.begin(), op.edges.end(), [&](const EdgeRef& edge) {
        return !before.find(edge.piece.id)->form || before.drape.dirty.contains(edge.piece.id);
      }))
    context.advise({say("Drape the garment before it is faced: the facing then lies close inside it.")});
  const std::vector<RunOnPiece> runs = runsOf(before, withImages(before, op));
  tellPleated(before, runs, context);
  std::vector<PieceId> outers;
  for (const RunOnPiece& run : runs) outers.push_back(run.piece);
  auto room = withLayersBeneath(before, outers);
  if (!room) return room.error();
  Document after = *std::move(room);
  std::uint32_t made = 0, sewn = 0;
  const auto sew = [&](Seam seam) {
    seam.id = mint<SeamId>(before, sewn++);
    seam.name.clear();
    const SeamId id = seam.id;
    after.pattern.seams[id] = std::move(seam);
    return id;
  };
  std::map<PieceId, std::vector<PieceId>> facings;
  std::vector<SeamId> darts;                  // by which facings are sewn to each other
  std::vector<DividedPart::EdgePart> beside;  // of all facings, but for the runs themselves
  for (const RunOnPiece& run : runs) {
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
    gradeParts(after.grading, outer, facing->edges, piece);
    Seam seam;
    for (const std::string& edge : run.edges) seam.a.push_back({outer.id, edge}), seam.b.push_back({piece.id, edge});
    seam.reversed = false;
    seam.tie = Seam::Tie::Pleat;  // the piece's edge may be sewn to others as well
    sew(std::move(seam));
    for (DividedPart::EdgePart& part : facing->edges) {
      part.own.piece = piece.id;
      if (std::find(run.edges.begin(), run.edges.end(), part.piece.edge) == run.edges.end()) beside.push_back(part);
    }
    facings[outer.id].push_back(piece.id);
    after = withPiece(std::move(after), std::move(piece));
  }
  for (const auto& [id, seam] : before.pattern.seams) {
    Seam own = seam;
    own.a = onParts(seam.a, beside), own.b = onParts(seam.b, beside);
    if (own.a.empty() || own.b.empty()) continue;
    const auto ease = op.eases == Choice::Yes ? easeOnParts(before, seam, after, own) : std::nullopt;
    const bool dart = lieOnOne(before, seam);
    const SeamId sewnAs = sew(std::move(own));
    if (ease) after.eases[sewnAs] = *ease;
    if (dart) darts.push_back(sewnAs);
  }
  if (op.closed == Choice::Yes) after = closedOver(std::move(after), darts, sewn, context);
  return op.copies == Choice::Yes ? withLikeFacings(std::move(after), facings) : after;
}

}  // namespace karinui
