// What several operations need.
#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"
#include "design/operations/pocket_follows.h"
#include "design/operations/sewn_runs.h"
#include "karinui/base/number.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/truing.h"

namespace karinui {

namespace {

std::string names(const Document& document) {
  std::string all;
  for (const auto& [id, piece] : document.pattern.pieces) all += (all.empty() ? "" : ", ") + piece->name;
  return all;
}

Error noSuchPiece(const Document& document, const std::string& wanted) {
  if (document.pattern.pieces.empty()) return refused(say("There is no piece “{0}”; there are no pieces yet.", wanted));
  return refused(say("There is no piece “{0}”; there are: {1}.", wanted, names(document)));
}

}  // namespace

Done resolve(const Document& before, PieceRef& ref) {
  if (!ref) return refused(say("Say which piece is meant."));
  const Piece* piece = ref.id ? before.find(ref.id) : before.pieceNamed(ref.name);
  if (!piece) return noSuchPiece(before, ref.id ? text(ref.id) : ref.name);
  ref = PieceRef(piece->id);
  return {};
}

Done resolve(const Document& before, SeamRef& ref) {
  if (!ref) return refused(say("Say which seam is meant."));
  if (ref.id) {
    if (before.find(ref.id)) return {};
    return refused(say("There is no seam “{0}”.", text(ref.id)));
  }
  for (const auto& [id, seam] : before.pattern.seams) {
    if (seam.name != ref.name) continue;
    ref = SeamRef(id);
    return {};
  }
  return refused(say("There is no seam “{0}”.", ref.name));
}

Done resolve(const Document& before, EdgeRef& ref) {
  if (Done done = resolve(before, ref.piece); !done) return done;
  const Piece& piece = *before.find(ref.piece.id);
  if (!piece.outline.find(ref.edge)) {
    if (std::any_of(piece.lines.begin(), piece.lines.end(), [&](const auto& line) { return line.name == ref.edge; }))
      return refused(say("“{0}” is an inner line of {1}; this is done along its edges.", ref.edge, piece.name));
    std::string edges;
    for (const Edge& edge : piece.outline.edges) edges += (edges.empty() ? "" : ", ") + edge.name;
    return refused(say("“{0}” has no edge “{1}”; it has: {2}.", piece.name, ref.edge, edges));
  }
  if (!(ref.from >= 0 && ref.from < ref.to && ref.to <= 1)) {
    return refused(say("The part of {0}.{1} runs from {2} to {3}; it must run forward between 0 and 1.", piece.name,
                       ref.edge, ref.from, ref.to));
  }
  return {};
}

Done resolve(const Document& before, std::vector<PieceRef>& refs) {
  if (refs.empty()) return refused(say("Say which pieces are meant."));
  for (PieceRef& ref : refs)
    if (Done done = resolve(before, ref); !done) return done;
  std::vector<PieceRef> once;
  for (const PieceRef& ref : refs)
    if (std::find(once.begin(), once.end(), ref) == once.end()) once.push_back(ref);
  refs = std::move(once);
  return {};
}

Document withPiece(Document document, Piece piece) {
  document.drape.dirty.insert(piece.id);
  const auto dirtied = [&](const auto& all) {
    for (const auto& [id, sewn] : all) {
      bool touched = false;
      for (const auto* side : {&sewn.a, &sewn.b})
        for (const EdgeSpan& span : *side) touched = touched || span.piece == piece.id;
      if (!touched) continue;
      for (const auto* side : {&sewn.a, &sewn.b})
        for (const EdgeSpan& span : *side) document.drape.dirty.insert(span.piece);
    }
  };
  dirtied(document.pattern.seams), dirtied(document.allowances.fastenings);
  const PieceId id = piece.id;
  document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
  return document;
}

Document withOwnEdit(Document document, const EditedPiece& edit) {
  updateGrading(document.grading, *document.find(edit.piece.id), edit.edges, {&edit.piece});
  updateSeams(document.pattern, edit.edges);
  document = withPiece(std::move(document), edit.piece);
  updateAllowances(document.allowances, edit.edges, document.pattern);
  return document;
}

Document withEdit(Document document, const EditedPiece& edit, std::vector<PieceId>* others) {
  const auto before = document.pattern.pieces.at(edit.piece.id);
  document = withOwnEdit(std::move(document), edit);
  const auto all = document.pattern.pieces;
  for (const auto& [id, other] : all) {
    if (id == before->id || (other->mirrorOf != before->id && before->mirrorOf != id)) continue;
    const auto likewise = editedLikewise(*other, *before, edit);
    if (!likewise) continue;
    document = withOwnEdit(std::move(document), *likewise);
    if (others) others->push_back(id);
  }
  return document;
}

std::vector<PieceId> likenesses(const Document& document, PieceId id) {
  const Piece& piece = *document.find(id);
  std::vector<PieceId> all;
  for (const auto& [other, copy] : document.pattern.pieces)
    if (other != id && (copy->mirrorOf == id || piece.mirrorOf == other) &&
        edgeOnCopy(*copy, piece, piece.outline.edges.front().name))
      all.push_back(other);
  return all;
}

Done resolveCopies(const Document& before, const std::vector<PieceRef>& pieces, Choice& copies,
                   const Context& context) {
  if (copies == Choice::Auto && context.recorded) return {};
  if (std::any_of(pieces.begin(), pieces.end(),
                  [&](const PieceRef& ref) { return !likenesses(before, ref.id).empty(); })) {
    if (copies == Choice::Auto) copies = Choice::Yes;
    return {};
  }
  if (copies == Choice::No) copies = Choice::Auto;  // nothing is to be decided
  if (copies == Choice::Yes && !context.recorded && !context.byFormula)
    return refused(
        say("“{0}” has no symmetric copy that is like it; leave copies= away.", before.find(pieces.front().id)->name));
  return {};
}

std::vector<PieceId> copiesMeant(const Document& document, PieceId piece, Choice copies) {
  return copies == Choice::Yes ? likenesses(document, piece) : std::vector<PieceId>();
}

std::string nameOfCopy(const Document& document, const std::string& name) {
  const std::string other = otherSide(name);
  return usableName(document, other == name ? name + "_mirrored" : other);
}

Document withLikeness(Document document, PieceId piece, PieceId copy) {
  const Piece &own = *document.find(piece), &other = *document.find(copy);
  if (!edgeOnCopy(other, own, own.outline.edges.front().name)) return document;
  auto like = std::make_shared<Piece>(other);
  like->mirrorOf = piece;
  document.pattern.pieces[copy] = std::move(like);
  return document;
}

Done resolveWhole(const Document& before, std::vector<EdgeRef>& edges, Choice symmetric, Context& context) {
  if (edges.empty()) return refused(say("Say which edges are meant."));
  for (EdgeRef& edge : edges) {
    edge.from = 0, edge.to = 1;
    if (Done done = resolve(before, edge); !done) return done;
  }
  for (const EdgeRef& edge : edges) {
    const Piece& piece = *before.find(edge.piece.id);
    const std::size_t k = *piece.outline.find(edge.edge);
    const auto both = [&](const PaperSymmetry& paper) { return paper.partner[k].has_value(); };
    Choice here = symmetric;
    if (Done done = resolveSymmetric(piece, here, context, both); !done) return done;
  }
  return {};
}

void tellSeams(const Document& before, const Document& after, const Context& context) {
  constexpr double kTold = 5e-5;  // metres: smaller changes are not spoken of
  if (!context.advise) return;
  const std::set<SeamId> pockets = seamsOfPockets(before.pattern);  // these follow yet
  for (const auto& [id, seam] : after.pattern.seams) {
    if (pockets.contains(id)) continue;
    const auto old = before.pattern.seams.find(id);
    if (old == before.pattern.seams.end()) continue;  // new, as that of a dart
    const double was = lengthMismatch(before.pattern, old->second), is = lengthMismatch(after.pattern, seam);
    if (std::fabs(is - was) < kTold) continue;
    const Message longer = longerSaid(after, refsOf(seam.a), refsOf(seam.b));
    const auto ease = after.eases.find(id);
    if (ease == after.eases.end())
      context.advise({longer});
    else if (!SeamTruing{id, length(after.pattern, seam.a), length(after.pattern, seam.b), ease->second, false}.fits())
      context.advise({say("{0} An ease of {1} mm is declared.", longer, fixed(ease->second * 1e3, 1))});
  }
}

void tellMisfits(const Document& before, const Document& after, const Context& context) {
  constexpr double kPlainly = 5e-3, kShare = 0.1;  // metres; of the shorter side
  if (!context.advise) return;
  const std::set<SeamId> pockets = seamsOfPockets(before.pattern);  // these follow yet
  for (const auto& [id, seam] : after.pattern.seams) {
    if (pockets.contains(id)) continue;
    const auto old = before.pattern.seams.find(id);
    if (old == before.pattern.seams.end()) continue;  // new, as that of a dart
    const double was = lengthMismatch(before.pattern, old->second), is = lengthMismatch(after.pattern, seam);
    if (seam.tie != Seam::Tie::OneToOne || std::fabs(is) <= std::fabs(was)) continue;
    const double shorter = std::fmin(length(after.pattern, seam.a), length(after.pattern, seam.b));
    if (std::fabs(is - was) >= std::fmin(kPlainly, kShare * shorter))
      context.advise({longerSaid(after, refsOf(seam.a), refsOf(seam.b))});
  }
}

void tellUnlike(const Document& before, const Piece& piece, const Context& context) {
  if (!context.advise) return;
  for (const auto& [id, other] : before.pattern.pieces)
    if (id != piece.id && (other->mirrorOf == piece.id || piece.mirrorOf == id))
      context.advise({say("“{0}” and “{1}” are no longer alike: what is done to one is not done to the other any more.",
                          piece.name, other->name)});
}

void tellLengths(const Piece& before, const Piece& after, const Context& context) {
  if (!context.advise) return;
  const auto inMm = [](double metres) { return fixed(metres * 1e3, 1); };
  Message all;
  for (const Edge& edge : before.outline.edges) {
    const double was = edge.curve.length(), is = findEdge(after, edge.name)->curve.length();
    if (std::fabs(is - was) < 5e-5) continue;
    all = all.empty() ? say("{0}: {1} mm → {2} mm", edge.name, inMm(was), inMm(is))
                      : say("{0}; {1}: {2} mm → {3} mm", all, edge.name, inMm(was), inMm(is));
  }
  if (!all.empty()) context.advise({say("{0}.", all)});
}

const InternalLine& lineNamed(const Piece& piece, const std::string& name) {
  return *std::find_if(piece.lines.begin(), piece.lines.end(), [&](const InternalLine& l) { return l.name == name; });
}

Result<Document> withLayersBeneath(Document document, const std::vector<PieceId>& pieces) {
  constexpr int kMostLayer = 20;
  std::set<int> layers;
  for (const PieceId id : pieces) layers.insert(document.find(id)->layer);
  const auto all = document.pattern.pieces;
  for (const auto& [id, whole] : all) {
    const int layer = whole->layer + static_cast<int>(std::distance(layers.begin(), layers.upper_bound(whole->layer)));
    if (layer > kMostLayer)
      return refused(say("“{0}” would lie in layer {1}; there are {2}.", whole->name, layer, kMostLayer));
    if (layer == whole->layer) continue;
    Piece piece = *whole;
    piece.layer = layer;
    document = withPiece(std::move(document), std::move(piece));
  }
  return document;
}

Done resolveSymmetric(const Piece& piece, Choice& symmetric, Context& context,
                      const std::function<bool(const PaperSymmetry&)>& both) {
  if (symmetric == Choice::No) return {};
  const auto symmetry = symmetryOf(piece.outline);
  if (symmetric == Choice::Yes && !symmetry)
    return refused(say("Piece {0} is not symmetric; leave symmetric= away.", piece.name));
  const bool can = symmetry && both(*symmetry);
  if (symmetric == Choice::Yes && !can)
    return refused(say(
        "The other half of “{0}” has no such edge, because of a slit or dart; write symmetric=no for this half alone.",
        piece.name));
  if (symmetry && !can && context.advise)
    context.advise(
        {say("Only this half of “{0}” was changed: the other half has no such edge, because of a slit or dart.",
             piece.name)});
  symmetric = can ? Choice::Yes : Choice::No;
  return {};
}

Done checkFabricName(const Document& document, const std::string& name) {
  if (document.fabrics.contains(name) || preset(name)) return {};
  std::string all;
  for (const Fabric& fabric : presets()) all += (all.empty() ? "" : ", ") + fabric.name;
  for (const auto& [own, fabric] : document.fabrics) all += ", " + own;
  return refused(say("There is no fabric “{0}”; there are: {1}.", name, all));
}

Done checkNewName(const Document& document, const std::string& name) {
  if (Done done = checkName(name); !done) return done;
  if (document.pieceNamed(name)) return refused(say("There is already a piece “{0}”; choose another name.", name));
  return {};
}

Done checkNoNameOfSeveral(const std::string& name) {
  if (name.empty()) return {};
  return refused(say("A name is for one piece; of several each copy is called after its own. Leave name= away."));
}

Document adopted(Document document, const DrapeOutcome& outcome) {
  for (const auto& [id, form] : outcome.forms) {
    const Piece* old = document.find(id);
    if (!old) continue;
    Piece piece = *old;
    piece.form = form;
    piece.pose = Rigid();
    document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
    if (outcome.report.stoppedAfter == 0)
      document.drape.dirty.erase(id);
    else
      document.drape.dirty.insert(id);
  }
  document.drape.last = outcome.report;
  document.drape.force = outcome.force;
  return document;
}

}  // namespace karinui
