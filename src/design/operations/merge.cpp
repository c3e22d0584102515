// Two pieces become one along an edge.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "design/formula/links.h"
#include "design/operations/merged.h"
#include "design/operations/new_piece.h"
#include "design/operations/seam_parts.h"
#include "design/spoken.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kTogether = 0.03;  // metres: edges nearer in space than this meet
constexpr double kTurnTold = 1;     // degrees of the grain

std::vector<std::string> namesOf(const std::vector<EdgeRef>& run) {
  std::vector<std::string> names;
  for (const EdgeRef& edge : run) names.push_back(edge.edge);
  return names;
}

OnSpan on(const std::vector<EdgeRef>& run) {
  return [&run](const EdgeSpan& span) {
    return std::any_of(run.begin(), run.end(),
                       [&](const EdgeRef& edge) { return span.piece == edge.piece.id && span.edge == edge.edge; });
  };
}

Result<MergedPieces> mergedIn(const Document& before, const MergePieces& op, std::size_t size) {
  const Piece &a = *before.find(op.a.front().piece.id), &b = *before.find(op.b.front().piece.id);
  if (before.grading.empty()) return mergePieces(a, namesOf(op.a), b, namesOf(op.b));
  const auto mine = inSize(a, before.grading, size), other = inSize(b, before.grading, size);
  if (!mine) return mine.error();
  if (!other) return other.error();
  return mergePieces(*mine, namesOf(op.a), *other, namesOf(op.b));
}

// The differences of the whole are measured between the merged pieces of all sizes.
Done gradeMerged(const Document& before, Document& after, const MergePieces& op,
                 const std::map<std::string, std::string>& names) {
  const PieceId a = op.a.front().piece.id, b = op.b.front().piece.id;
  if (!before.grading.pieces.contains(a) && !before.grading.pieces.contains(b)) return {};
  std::vector<Outline> sizes;
  for (std::size_t size = 0; size < before.grading.sizes.size(); ++size) {
    auto merged = mergedIn(before, op, size);
    if (!merged) return refused(say("In size {0}: {1}", before.grading.sizes[size], merged.error().what));
    renameEdges(merged->piece, merged->edges, names);
    sizes.push_back(merged->piece.outline);
  }
  auto measured = measuredGrading(sizes, before.grading.base);
  if (!measured) return measured.error();
  after.grading.pieces[a] = *std::move(measured);
  after.grading.pieces.erase(b);
  return {};
}

bool oneBodysHalves(const Document& before, const MergePieces& op) {
  const Piece &a = *before.find(op.a.front().piece.id), &b = *before.find(op.b.front().piece.id);
  return a.mirrorOf == b.id || b.mirrorOf == a.id;
}

// The wearer's side that a piece's name tells.
std::string_view sideTold(const std::string& name) {
  for (const std::string_view side : {"left", "right"}) {
    const std::string in(side);
    if (name.starts_with(in + "_") || name.find("_" + in) != std::string::npos) return side;
  }
  return {};
}

// "side" on the left is "side_left", "side_2" is "side_left_2".
std::string onSide(const std::string& edge, std::string_view side) {
  const std::size_t last = edge.find_last_not_of("0123456789");
  const std::size_t at =
      last != std::string::npos && last + 1 < edge.size() && last > 0 && edge[last] == '_' ? last : edge.size();
  return edge.substr(0, at) + "_" + std::string(side) + edge.substr(at);
}

// What edges of the whole are called that both halves have: by their side. Nothing where no name tells the side.
std::map<std::string, std::string> namesBySide(const Piece& a, const Piece& b, const MergedPieces& made) {
  const std::string_view own = sideTold(a.name), other = sideTold(b.name);
  std::map<std::string, std::string> names;
  if (own.empty() || other.empty() || own == other) return names;
  std::set<std::string> taken;
  for (const Edge& edge : made.piece.outline.edges) taken.insert(edge.name);
  for (const Edge& edge : a.outline.edges) {
    const auto at = made.edges.find({b.id, edge.name});
    if (at == made.edges.end() || at->second.empty() || !made.piece.outline.find(edge.name)) continue;
    const std::string mine = onSide(edge.name, own), its = onSide(edge.name, other);
    if (taken.contains(mine) || taken.contains(its)) continue;
    names[edge.name] = mine, names[at->second.front().now.edge] = its;
  }
  return names;
}

bool meetInSpace(const Piece& a, const Piece& b, const MergePieces& op) {
  const Stand mine(a), other(b);
  const auto place = [](const Piece& piece, const std::vector<EdgeRef>& run, double share) {
    double all = 0, at = 0;
    for (const EdgeRef& edge : run) all += findEdge(piece, edge.edge)->curve.length();
    for (const EdgeRef& edge : run) {
      const Curve& curve = findEdge(piece, edge.edge)->curve;
      if (share * all <= at + curve.length() || &edge == &run.back())
        return curve.atFraction(std::clamp((share * all - at) / curve.length(), 0.0, 1.0));
      at += curve.length();
    }
    return Flat{};
  };
  constexpr int kLooks = 8;
  for (int k = 0; k <= kLooks; ++k) {
    const double share = k / double{kLooks};
    if (distance(mine(place(a, op.a, share)), other(place(b, op.b, 1 - share))) > kTogether) return false;
  }
  return true;
}

// Where the cloth of both stands. What stood elsewhere is led along the edge first, if it is to be; cloth that was
// never laid on the body stays flat.
std::shared_ptr<const Form> mergedForm(const Document& before, const MergePieces& op, const PaperMove& move, bool led) {
  const Piece& a = *before.find(op.a.front().piece.id);
  Piece b = *before.find(op.b.front().piece.id);
  if (!a.form && !b.form) return nullptr;
  if (led && !meetInSpace(a, b, op)) {
    if (op.b.size() > 1) return a.form;
    auto along = attached(before, b, op.b.front().edge, runOf(before, op.a), {}, nullptr);
    if (!along) return a.form;
    b = *std::move(along);
  }
  const auto formOf = [&](const Piece& piece) -> std::shared_ptr<const Form> {
    if (piece.form) return piece.form;
    const auto laid = layAlone(piece, before.settings.spacing);
    if (!laid) return nullptr;
    auto flat = std::make_shared<Form>();
    flat->flat = (*laid)->nodes, flat->faces = (*laid)->faces;
    for (const Flat p : flat->flat) flat->space.push_back({p.u, p.v, 0});
    return flat;
  };
  const auto mine = formOf(a), other = formOf(b);
  if (!mine || !other) return a.form;
  auto whole = std::make_shared<Form>(*mine);
  const Rigid there = after(inverseOf(a.pose), b.pose);
  const auto n = static_cast<std::uint32_t>(mine->flat.size());
  for (std::size_t k = 0; k < other->flat.size(); ++k)
    whole->flat.push_back(move(other->flat[k])), whole->space.push_back(there(other->space[k]));
  for (const Triangle& face : other->faces) whole->faces.push_back({face[0] + n, face[1] + n, face[2] + n});
  return whole;
}

// A piece and its symmetric copy became one: it is no left or right one any more.
void tellWhole(const Document& before, const Piece& a, const Context& context) {
  std::string name = a.name;
  for (const char* side : {"_left", "_right", "left_", "right_"})
    if (const auto at = name.find(side); at != std::string::npos) name.erase(at, std::string_view(side).size());
  if (name == a.name || name.empty() || before.pieceNamed(name)) return;
  Rename rename;
  rename.piece.name = a.name, rename.to = name;
  Advice advice{say("“{0}” is both halves in one now; on paper it would better be called “{1}”.", a.name, name)};
  advice.piece = a.id, advice.mend = std::move(rename);
  context.advise(advice);
}

void tellMerged(const Document& before, const MergePieces& op, const PaperMove& move, const Context& context) {
  if (!context.advise) return;
  const Piece &a = *before.find(op.a.front().piece.id), &b = *before.find(op.b.front().piece.id);
  if (oneBodysHalves(before, op))
    tellWhole(before, a, context);
  else if (op.copies != Choice::Yes)
    tellUnlike(before, a, context);
  if (a.fabric != b.fabric)
    context.advise({say("“{0}” was of {1}; all of the piece is cut from {2} now.", b.name, b.fabric, a.fabric)});
  const Flat grain = Curve::line({}, b.grain).rotated({}, move.radians).end;
  const double off = std::atan2(std::fabs(cross(a.grain, grain)), std::fabs(dot(a.grain, grain)));
  if (const double degrees = off * 180 / std::numbers::pi; degrees > kTurnTold)
    context.advise({say("The cloth of “{0}” is cut {1} degrees off its own grain now; that of “{2}” is kept.", b.name,
                        fixed(degrees, 0), a.name)});
}

}  // namespace

Done resolveRuns(const Document& before, MergePieces& op, const Context& context) {
  for (auto* run : {&op.a, &op.b}) {
    if (run->empty()) return refused(say("Pieces are merged along an edge of each; say both: a=… b=…."));
    for (EdgeRef& edge : *run) {
      edge.from = 0, edge.to = 1;
      if (Done done = resolve(before, edge); !done) return done;
      if (edge.piece != run->front().piece)
        return refused(say("The run that begins with {0} lies on one piece; merge the others one by one.",
                           spoken(before, run->front())));
    }
    if (run->size() > 1)
      if (auto chained = asOneRun(before, *run); chained && !context.recorded) *run = *std::move(chained);
  }
  if (op.a.front().piece == op.b.front().piece)
    return refused(
        say("{0} and {1} are edges of one piece; two pieces are merged. A dart is closed by moving it to "
            "another edge.",
            spoken(before, op.a.front()), spoken(before, op.b.front())));
  for (const auto& [id, seam] : before.pattern.seams) {
    const bool mine = touches(seam, on(op.a)), other = touches(seam, on(op.b));
    if (mine != other)
      return refused(say("{0} is sewn to something else, by seam {1}; take that out first.",
                         spoken(before, mine ? op.a.front() : op.b.front()), spoken(seam)));
    if (mine && !seam.reversed)
      return refused(say("By seam {0} one piece lies on the other, right side on right side; so they are no one paper.",
                         spoken(seam)));
  }
  for (const auto& [name, fastening] : before.allowances.fastenings)
    if (touches(fastening, on(op.a)) || touches(fastening, on(op.b)))
      return refused(say("“{0}” fastens the edge along which the pieces would be merged; take it off first.", name));
  for (const auto* run : {&op.a, &op.b})
    if (before.grading.pieces.contains(run->front().piece.id) && before.grading.standing != before.grading.base)
      return refused(say("Merge pieces in the base size: choose it first, size name={0}.",
                         before.grading.sizes[before.grading.base]));
  return {};
}

namespace {

// The same along the images of both runs, on copies that are each other's neighbours as their pieces are.
std::vector<MergePieces> onCopies(const Document& document, const MergePieces& op, const Context& context) {
  const Piece &a = *document.find(op.a.front().piece.id), &b = *document.find(op.b.front().piece.id);
  const auto image = [](std::vector<EdgeRef>& run, const Piece& copy, const Piece& piece) {
    for (EdgeRef& edge : run) edge.piece = copy.id, edge.edge = *edgeOnCopy(copy, piece, edge.edge);
    std::reverse(run.begin(), run.end());
  };
  std::vector<MergePieces> all;
  std::set<PieceId> used{a.id, b.id};
  for (const PieceId mine : likenesses(document, a.id))
    for (const PieceId other : likenesses(document, b.id)) {
      if (mine == other || used.contains(mine) || used.contains(other)) continue;
      MergePieces likewise = op;
      image(likewise.a, *document.find(mine), a), image(likewise.b, *document.find(other), b);
      if (!resolveRuns(document, likewise, context)) continue;
      used.insert(mine), used.insert(other);
      all.push_back(std::move(likewise));
    }
  return all;
}

}  // namespace

Result<Document> merged(const Document& before, const MergePieces& op, const Piece* likewise, std::uint32_t& minted,
                        const Context& context, bool led) {
  const PieceId a = op.a.front().piece.id, b = op.b.front().piece.id;
  auto made = mergePieces(*before.find(a), namesOf(op.a), *before.find(b), namesOf(op.b));
  if (!made) return made.error();
  if (likewise) nameLikeImage(made->piece, made->edges, *likewise);
  std::map<std::string, std::string> names;
  if (op.sides == Choice::Yes && oneBodysHalves(before, op))
    names = namesBySide(*before.find(a), *before.find(b), *made);
  renameEdges(made->piece, made->edges, names);
  tellMerged(before, op, made->move, context);
  Document after = before;
  const OnSpan gone = [&](const EdgeSpan& span) { return on(op.a)(span) || on(op.b)(span); };
  for (const auto& [id, seam] : before.pattern.seams)
    if (touches(seam, gone)) after.pattern.seams.erase(id);
  keepParts(before, after, gone, minted);
  updateSeams(after.pattern, made->edges);
  made->piece.form = mergedForm(before, op, made->move, led);
  made->piece.mirrorOf = PieceId();
  if (const auto pins = before.pins.find(b); pins != before.pins.end()) {
    for (const Flat pin : pins->second) after.pins[a].push_back(made->move(pin));
    after.pins.erase(b);
  }
  after.looks.pieces.erase(b), after.looks.shifts.erase(b);
  after.pattern.pieces.erase(b);
  after = withPiece(std::move(after), std::move(made->piece));
  after.drape.dirty.erase(b);
  updateAllowances(after.allowances, made->edges, after.pattern);
  for (auto& [id, shared] : after.pattern.pieces) {
    if (shared->mirrorOf != a && shared->mirrorOf != b) continue;
    Piece piece = *shared;
    piece.mirrorOf = PieceId();
    shared = std::make_shared<const Piece>(std::move(piece));
  }
  for (const Edge& edge : before.find(a)->outline.edges)
    if (const auto now = names.find(edge.name); now != names.end()) renameInFormulas(after, a, edge.name, now->second);
  if (Done done = gradeMerged(before, after, op, names); !done) return done.error();
  return after;
}

Done resolve(const Document& before, MergePieces& op, Context& context) {
  if (Done done = resolveRuns(before, op, context); !done) return done;
  if (op.sides == Choice::Auto && !context.recorded && oneBodysHalves(before, op)) op.sides = Choice::Yes;
  if (op.copies == Choice::Auto && context.recorded) return {};
  const bool some = !onCopies(before, op, context).empty();
  if (!some && op.copies == Choice::Yes && !context.recorded && !context.byFormula)
    return refused(
        say("“{0}” and “{1}” have no symmetric copies that are like them and meet as they do; leave copies= "
            "away.",
            before.find(op.a.front().piece.id)->name, before.find(op.b.front().piece.id)->name));
  if (!some && op.copies == Choice::No) op.copies = Choice::Auto;  // nothing is to be decided
  if (some && op.copies == Choice::Auto) op.copies = Choice::Yes;
  return {};
}

Result<Document> perform(const Document& before, const MergePieces& op, Context& context) {
  std::uint32_t minted = 0;
  auto after = merged(before, op, nullptr, minted, context);
  if (!after || op.copies != Choice::Yes) return after;
  Context silent = context;
  silent.advise = {};
  const PieceId whole = op.a.front().piece.id;
  for (const MergePieces& likewise : onCopies(before, op, context)) {
    const auto own = after->pattern.pieces.at(whole);
    after = merged(*after, likewise, own.get(), minted, silent);
    if (!after) return after;
    const PieceId copy = likewise.a.front().piece.id;
    const bool copied = before.find(copy)->mirrorOf == whole;
    after = copied ? withLikeness(*std::move(after), whole, copy) : withLikeness(*std::move(after), copy, whole);
  }
  return after;
}

}  // namespace karinui
