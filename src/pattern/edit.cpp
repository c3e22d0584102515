#include "karinui/pattern/edit.h"

#include <algorithm>
#include <cmath>

#include "words.h"

namespace karinui {

std::vector<EdgeSpan> ledOver(const std::vector<EdgeSpan>& side, const EdgeMap& map) {
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
  std::vector<EdgeSpan> joined;
  for (EdgeSpan& span : now) {
    EdgeSpan* last = joined.empty() ? nullptr : &joined.back();
    if (last && last->piece == span.piece && last->edge == span.edge && std::fabs(last->to - span.from) < 1e-9)
      last->to = span.to;
    else
      joined.push_back(std::move(span));
  }
  return joined;
}

void updateSeams(Pattern& pattern, const EdgeMap& map) {
  for (auto& [id, seam] : pattern.seams) {
    seam.a = ledOver(seam.a, map);
    seam.b = ledOver(seam.b, map);
  }
}

std::optional<std::pair<std::string, double>> placeNow(const EdgeMap& map, PieceId piece, const std::string& edge,
                                                       double fraction) {
  const auto parts = map.find({piece, edge});
  if (parts == map.end()) return std::pair(edge, fraction);
  for (const EdgePart& part : parts->second) {
    if (fraction < part.from || fraction > part.to) continue;
    const double share = (fraction - part.from) / (part.to - part.from);
    return std::pair(part.now.edge, part.now.from + share * (part.now.to - part.now.from));
  }
  return std::nullopt;
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
