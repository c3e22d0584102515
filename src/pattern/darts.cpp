#include "karinui/pattern/darts.h"

#include <cmath>

namespace karinui {

namespace {

constexpr double kWidestFolded = 0.05;  // metres of a mouth: a wider wedge would lie thick, and is cut out

Flat wayAt(const Curve& curve, bool atEnd) {
  for (const double t : {0.0, 1e-6, 1e-3, 0.1})
    if (const Flat way = curve.tangent(atEnd ? 1 - t : t); length(way) > 1e-9) return normalized(way);
  return normalized(curve.end - curve.start);
}

}  // namespace

bool PaperDart::folded() const { return distance(from, until) <= kWidestFolded; }

std::vector<PaperDart> dartsOf(const Pattern& pattern) {
  std::vector<PaperDart> all;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.a.size() != 1 || seam.b.size() != 1 || !seam.reversed || seam.tie == Seam::Tie::Pleat) continue;
    const EdgeSpan &a = seam.a.front(), &b = seam.b.front();
    const auto piece = pattern.pieces.find(a.piece);
    if (a.piece != b.piece || piece == pattern.pieces.end()) continue;
    const Outline& outline = piece->second->outline;
    const auto i = outline.find(a.edge), k = outline.find(b.edge);
    const auto whole = [](const EdgeSpan& span) { return span.from <= 0 && span.to >= 1; };
    if (!i || !k || i == k || !whole(a) || !whole(b)) continue;
    const std::size_t n = outline.edges.size();
    const std::size_t to = (*i + 1) % n == *k ? *i : *k, back = to == *i ? *k : *i;
    if ((to + 1) % n != back || n < 4) continue;
    const Curve &in = outline.edges[to].curve, &out = outline.edges[back].curve;
    if (cross(wayAt(in, true), wayAt(out, false)) >= 0) continue;  // a point of cloth, as of a cone
    all.push_back({id, a.piece, to, back, in.start, in.end, out.end});
  }
  return all;
}

Flat capOf(const Outline& outline, const PaperDart& dart) {
  const std::size_t n = outline.edges.size();
  const Flat middle = lerp(dart.from, dart.until, 0.5), fold = normalized(middle - dart.point),
             leg = normalized(dart.point - dart.until), on = wayAt(outline.edges[(dart.back + 1) % n].curve, false);
  const Flat back = leg * (2 * dot(on, leg)) - on;  // the edge behind, as it lies under the folded dart
  const double turned = cross(back, fold);
  if (std::abs(turned) < 1e-9) return middle;
  const Flat peak = dart.until + back * (cross(dart.point - dart.until, fold) / turned);
  // Where the edge behind runs almost along the leg there is no such place near by.
  const bool good = dot(peak - dart.until, back) > 0 && distance(peak, middle) < distance(dart.from, dart.until);
  return good ? peak : middle;
}

}  // namespace karinui
