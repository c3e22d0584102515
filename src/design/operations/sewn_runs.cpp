#include "design/operations/sewn_runs.h"

#include <algorithm>

namespace karinui {

std::vector<EdgeSpan> spansOf(const std::vector<EdgeRef>& refs) {
  std::vector<EdgeSpan> side;
  for (const EdgeRef& ref : refs) side.push_back({ref.piece.id, ref.edge, ref.from, ref.to});
  return side;
}

const InternalLine* lineOf(const Document& document, const EdgeRef& ref) {
  const Piece* piece = document.find(ref.piece.id);
  if (!piece || findEdge(*piece, ref.edge)) return nullptr;
  const auto line = std::find_if(piece->lines.begin(), piece->lines.end(),
                                 [&](const InternalLine& l) { return l.name == ref.edge && !l.curves.empty(); });
  return line == piece->lines.end() ? nullptr : &*line;
}

Done resolveSewn(const Document& before, EdgeRef& ref) {
  if (Done done = resolve(before, ref.piece); !done) return done;
  const Piece& piece = *before.find(ref.piece.id);
  if (piece.outline.find(ref.edge) || !(findEdge(piece, ref.edge) || lineOf(before, ref))) return resolve(before, ref);
  if (!(ref.from >= 0 && ref.from < ref.to && ref.to <= 1))
    return refused(say("The part of {0}.{1} runs from {2} to {3}; it must run forward between 0 and 1.",
                       before.find(ref.piece.id)->name, ref.edge, ref.from, ref.to));
  return {};
}

Document withOneCurve(Document document, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b) {
  for (const auto* side : {&a, &b})
    for (const EdgeRef& ref : *side) {
      const InternalLine* line = lineOf(document, ref);
      if (!line || line->curves.size() == 1) continue;
      Piece piece = *document.find(ref.piece.id);
      for (InternalLine& own : piece.lines)
        if (own.name == ref.edge) own.curves = {Curve::joined(own.curves)};
      document.pattern.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));
    }
  return document;
}

std::vector<EdgeRef> refsOf(const std::vector<EdgeSpan>& spans) {
  std::vector<EdgeRef> refs;
  for (const EdgeSpan& span : spans) refs.push_back({PieceRef(span.piece), span.edge, span.from, span.to});
  return refs;
}

}  // namespace karinui
