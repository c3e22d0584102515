#include <algorithm>

#include "design/formula/links.h"
#include "design/operations/operations.h"

namespace karinui {

namespace {

Done checkEdgeName(const Piece& piece, const std::string& name) {
  const bool plain = !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
  if (!plain) return refused(say("“{0}” cannot name an edge; use letters a to z, digits, _ and -.", name));
  if (piece.outline.find(name)) return refused(say("“{0}” already has an edge “{1}”.", piece.name, name));
  return {};
}

}  // namespace

Done resolve(const Document& before, Rename& op, Context&) {
  const int meant = (op.piece ? 1 : 0) + (op.edge ? 1 : 0) + (op.seam ? 1 : 0);
  if (meant != 1) return refused(say("Say what to rename: a piece, an edge or a seam."));
  if (op.piece) {
    if (Done done = resolve(before, op.piece); !done) return done;
    return before.find(op.piece.id)->name == op.to ? Done() : checkNewName(before, op.to);
  }
  if (op.edge) {
    op.edge->from = 0, op.edge->to = 1;
    if (Done done = resolve(before, *op.edge); !done) return done;
    return op.edge->edge == op.to ? Done() : checkEdgeName(*before.find(op.edge->piece.id), op.to);
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
  const PieceId id = op.piece ? op.piece.id : op.edge->piece.id;
  Piece piece = *before.find(id);
  if (op.piece) {
    piece.name = op.to;
  } else {
    const std::string from = op.edge->edge;
    piece.outline.edges[*piece.outline.find(from)].name = op.to;
    for (Mark& mark : piece.marks)
      if (mark.edge == from) mark.edge = op.to;
    renameInFormulas(after, id, from, op.to);
    if (const auto own = after.grading.pieces.find(id); own != after.grading.pieces.end())
      for (GradePoint& point : own->second)
        if (point.edge == from) point.edge = op.to;
    const auto renameKey = [&](auto& all) {
      if (auto own = all.extract({id, from}); own) own.key().second = op.to, all.insert(std::move(own));
    };
    renameKey(after.allowances.edges), renameKey(after.allowances.corners);
    Allowances::eachFinish(after.allowances, renameKey);
    const auto renameSpans = [&](auto& all) {
      for (auto& [key, sewn] : all)
        for (auto* side : {&sewn.a, &sewn.b})
          for (EdgeSpan& span : *side)
            if (span.piece == id && span.edge == from) span.edge = op.to;
    };
    renameSpans(after.pattern.seams), renameSpans(after.allowances.fastenings);
  }
  after.pattern.pieces[id] =
      std::make_shared<const Piece>(std::move(piece));  // a name moves no cloth: nothing is dirty
  return after;
}

}  // namespace karinui
