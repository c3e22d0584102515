#include <algorithm>

#include "design/formula/links.h"
#include "design/operations/operations.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

Done checkEdgeName(const std::string& name) {
  const bool plain = !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
  if (!plain) return refused(say("“{0}” cannot name an edge; use letters a to z, digits, _ and -.", name));
  return {};
}

namespace {

Done checkOwnEdge(const Piece& piece, const std::string& name) {
  if (Done done = checkEdgeName(name); !done) return done;
  if (piece.outline.find(name)) return refused(say("“{0}” already has an edge “{1}”.", piece.name, name));
  return {};
}

void renameEdge(Document& after, PieceId id, const std::string& from, const std::string& to) {
  Piece piece = *after.find(id);
  piece.outline.edges[*piece.outline.find(from)].name = to;
  for (Mark& mark : piece.marks)
    if (mark.edge == from) mark.edge = to;
  renameInFormulas(after, id, from, to);
  if (const auto own = after.grading.pieces.find(id); own != after.grading.pieces.end())
    for (GradePoint& point : own->second)
      if (point.edge == from) point.edge = to;
  const auto renameKey = [&](auto& all) {
    if (auto own = all.extract({id, from}); own) own.key().second = to, all.insert(std::move(own));
  };
  renameKey(after.allowances.edges), renameKey(after.allowances.corners);
  Allowances::eachFinish(after.allowances, renameKey);
  const auto renameSpans = [&](auto& all) {
    for (auto& [key, sewn] : all)
      for (auto* side : {&sewn.a, &sewn.b})
        for (EdgeSpan& span : *side)
          if (span.piece == id && span.edge == from) span.edge = to;
  };
  renameSpans(after.pattern.seams), renameSpans(after.allowances.fastenings);
  after.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));  // nothing moves
}

}  // namespace

Done resolve(const Document& before, Rename& op, Context& context) {
  const int meant = (op.piece ? 1 : 0) + (op.edge ? 1 : 0) + (op.seam ? 1 : 0);
  if (meant != 1) return refused(say("Say what to rename: a piece, an edge or a seam."));
  if (op.piece) {
    if (Done done = resolve(before, op.piece); !done) return done;
    return before.find(op.piece.id)->name == op.to ? Done() : checkNewName(before, op.to);
  }
  if (op.edge) {
    op.edge->from = 0, op.edge->to = 1;
    if (Done done = resolve(before, *op.edge); !done) return done;
    if (op.edge->edge == op.to) return {};
    const bool left = op.copies == Choice::Auto;
    if (Done done = resolveCopies(before, {op.edge->piece}, op.copies, context); !done) return done;
    if (Done done = checkOwnEdge(*before.find(op.edge->piece.id), op.to); !done) return done;
    for (const PieceId copy : copiesMeant(before, op.edge->piece.id, op.copies)) {
      const Done fine = checkOwnEdge(*before.find(copy), otherSide(op.to));
      if (!fine && !left) return fine;
      if (!fine) op.copies = Choice::No;
    }
    return {};
  }
  if (Done done = resolve(before, op.seam); !done) return done;
  if (Done done = checkName(op.to); !done) return done;
  for (const auto& [id, seam] : before.pattern.seams) {
    if (id != op.seam.id && seam.name == op.to) {
      return refused(say("There is already a seam “{0}”; choose another name.", op.to));
    }
  }
  return {};
}

Result<Document> perform(const Document& before, const Rename& op, Context&) {
  Document after = before;
  if (op.seam) {
    after.pattern.seams[op.seam.id].name = op.to;
    return after;
  }
  if (op.piece) {
    Piece piece = *before.find(op.piece.id);
    piece.name = op.to;
    after.pattern.pieces[op.piece.id] =
        std::make_shared<const Piece>(std::move(piece));  // a name moves no cloth: nothing is dirty
    return after;
  }
  const PieceId id = op.edge->piece.id;
  const Piece& piece = *before.find(id);
  for (const PieceId copy : copiesMeant(before, id, op.copies))
    if (const auto edge = edgeOnCopy(*before.find(copy), piece, op.edge->edge))
      renameEdge(after, copy, *edge, otherSide(op.to));
  renameEdge(after, id, op.edge->edge, op.to);
  return after;
}

}  // namespace karinui
