#include "karinui/pattern/edit.h"

#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "words.h"

namespace karinui {

void updateSeams(Pattern& pattern, const EdgeMap& map) {
  const auto led = [&](const std::vector<EdgeSpan>& side) {
    std::vector<EdgeSpan> now;
    for (const EdgeSpan& span : side) {
      const auto parts = map.find({span.piece, span.edge});
      if (parts == map.end()) {
        now.push_back(span);
        continue;
      }
      for (const EdgePart& part : parts->second) {
        const double from = std::max(span.from, part.from), to = std::min(span.to, part.to);
        if (to - from < 1e-9) continue;
        const double scale = (part.now.to - part.now.from) / (part.to - part.from);
        EdgeSpan piece = part.now;
        if (from > part.from) piece.from = part.now.from + (from - part.from) * scale;
        if (to < part.to) piece.to = part.now.from + (to - part.from) * scale;
        now.push_back(std::move(piece));
      }
    }
    return now;
  };
  for (auto& [id, seam] : pattern.seams) {
    seam.a = led(seam.a);
    seam.b = led(seam.b);
  }
}

Result<EditedPiece> splitEdge(const Piece& piece, std::string_view edge, double fraction) {
  EditedPiece edited{piece, {}};
  std::vector<Outline*> outlines{&edited.piece.outline};
  for (Outline& hole : edited.piece.holes) outlines.push_back(&hole);
  for (Outline* outline : outlines) {
    const auto k = outline->find(edge);
    if (!k) continue;
    const double whole = outline->edges[*k].curve.length();
    if (!(fraction * whole >= 1e-3 && (1 - fraction) * whole >= 1e-3))
      return refused(say("Edge {0} is {1} mm long; a corner on it must stay 1 mm from both ends.", edge, inMm(whole)));
    const auto taken = edgeNames(piece);
    divideEdges(*outline, {{*k, outline->edges[*k].curve.parameterAt(fraction * whole)}}, taken, piece.id,
                edited.edges);
    followMarks(edited.piece, edited.edges);
    return edited;
  }
  return notFound(say("Piece {0} has no edge {1}.", piece.name, edge));
}

Result<Piece> moveCorner(const Piece& piece, std::string_view edge, Flat to) {
  Piece moved = piece;
  std::vector<Outline*> outlines{&moved.outline};
  for (Outline& hole : moved.holes) outlines.push_back(&hole);
  for (Outline* outline : outlines) {
    const auto k = outline->find(edge);
    if (!k) continue;
    Curve& after = outline->edges[*k].curve;
    Curve& before = outline->edges[(*k + outline->edges.size() - 1) % outline->edges.size()].curve;
    const Flat step = to - after.start;
    if (after.kind == Curve::Kind::Cubic) after.control1 += step;
    if (before.kind == Curve::Kind::Cubic) before.control2 += step;
    after.start = before.end = to;
    auto good = checked(*outline);
    if (!good) return good.error();
    *outline = std::move(*good);
    return moved;
  }
  return notFound(say("Piece {0} has no edge {1}.", piece.name, edge));
}

Result<Piece> reshaped(const Piece& piece, Outline outline) {
  auto good = checked(std::move(outline));
  if (!good) return good.error();
  const auto& before = piece.outline.edges;
  const auto first = before.empty() ? std::nullopt : good->find(before[0].name);
  bool same = first && good->edges.size() == before.size();
  for (std::size_t k = 0; same && k < before.size(); ++k)
    same = good->edges[(*first + k) % before.size()].name == before[k].name;
  if (!same)
    return refused(
        say("The new outline of piece {0} must have the same edges in the same order, so that its seams hold.",
            piece.name));
  std::rotate(good->edges.begin(), good->edges.begin() + static_cast<std::ptrdiff_t>(*first), good->edges.end());
  Piece now = piece;
  now.outline = std::move(*good);
  return now;
}

bool facesReversed(std::span<const Vec3> a, std::span<const Vec3> b) {
  KARINUI_ASSERT(a.size() == b.size());
  double along = 0, against = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    along += squaredLength(a[k] - b[k]);
    against += squaredLength(a[k] - b[b.size() - 1 - k]);
  }
  return !(along < 0.9 * against);
}

}  // namespace karinui
