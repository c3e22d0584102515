#include "karinui/pattern/darts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

constexpr double kWidestFolded = 0.05;  // metres of a mouth: a wider wedge would lie thick, and is cut out
constexpr double kUpright = 0.996;      // cosine of 5 degrees
constexpr double kStraight = 1.0005;    // longer than the way between its ends
constexpr double kOnCentre = 1e-3;      // metres

// Across the paper, where the centre of the body is.
double centreOf(const Outline& outline, const PaperDart& dart) {
  if (const auto symmetry = symmetryOf(outline))
    if (std::abs(symmetry->axis.v) > kUpright) return symmetry->through.u;
  double low = outline.edges[0].curve.start.u, high = low, longest = 0, centre = 0;
  bool two = false;  // as long as each other, which says nothing
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    const Curve& curve = outline.edges[k].curve;
    low = std::min(low, curve.start.u), high = std::max(high, curve.start.u);
    const Flat way = curve.end - curve.start;
    const double tall = length(way);
    const bool straight = curve.kind == Curve::Kind::Line || curve.length() < tall * kStraight;
    if (k == dart.to || k == dart.back || !straight || std::abs(way.v) < tall * kUpright) continue;
    if (tall < longest - kOnCentre) continue;
    two = tall < longest + kOnCentre;
    longest = std::max(longest, tall), centre = lerp(curve.start, curve.end, 0.5).u;
  }
  return longest > 0 && !two ? centre : std::midpoint(low, high);
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
    if (cross(endTangent(in, true), endTangent(out, false)) >= 0) continue;  // a point of cloth, as of a cone
    all.push_back({id, a.piece, to, back, in.start, in.end, out.end});
  }
  return all;
}

std::optional<PaperDart> dartWithLeg(const Pattern& pattern, PieceId piece, std::string_view leg) {
  const auto& edges = pattern.pieces.at(piece)->outline.edges;
  for (const PaperDart& dart : dartsOf(pattern))
    if (dart.piece == piece && (edges[dart.to].name == leg || edges[dart.back].name == leg)) return dart;
  return std::nullopt;
}

bool DoubleDart::folded() const { return distance(left, right) <= kWidestFolded; }

std::vector<DoubleDart> doubleDartsOf(const Pattern& pattern) {
  constexpr int kLooks = 24;
  std::vector<DoubleDart> all;
  for (const auto& [id, seam] : pattern.seams) {
    if (!seam.reversed || seam.tie == Seam::Tie::Pleat || seam.a.empty() || seam.b.empty()) continue;
    const auto piece = pattern.pieces.find(seam.a.front().piece);
    if (piece == pattern.pieces.end()) continue;
    for (std::size_t h = 0; h < piece->second->holes.size(); ++h) {
      const Outline& hole = piece->second->holes[h];
      const auto within = [&](const EdgeSpan& span) {
        return span.piece == piece->first && span.from <= 0 && span.to >= 1 && hole.find(span.edge);
      };
      // All its edges, each on one side: the sides then meet in two places.
      if (seam.a.size() + seam.b.size() != hole.edges.size() || !std::all_of(seam.a.begin(), seam.a.end(), within) ||
          !std::all_of(seam.b.begin(), seam.b.end(), within))
        continue;
      DoubleDart dart{id,
                      piece->first,
                      h,
                      hole.edges[*hole.find(seam.a.front().edge)].curve.start,
                      hole.edges[*hole.find(seam.a.back().edge)].curve.end,
                      {},
                      {}};
      const SeamSides sides(pattern, seam);
      std::vector<double> looks = sides.breaks();
      for (int k = 1; k < kLooks; ++k) looks.push_back(k / double{kLooks});
      double widest = -1;
      for (const double share : looks) {
        const SeamPlace a = sides.a.at(share), b = sides.b.at(share);
        const Flat here = curveOf(pattern, a.piece, a.edge)->atFraction(a.fraction),
                   there = curveOf(pattern, b.piece, b.edge)->atFraction(b.fraction);
        if (distance(here, there) > widest) widest = distance(here, there), dart.right = here, dart.left = there;
      }
      all.push_back(dart);
    }
  }
  return all;
}

std::set<std::size_t> foldedHoles(const Pattern& pattern, PieceId piece) {
  std::set<std::size_t> holes;
  for (const DoubleDart& dart : doubleDartsOf(pattern))
    if (dart.piece == piece && dart.folded()) holes.insert(dart.hole);
  return holes;
}

bool pressedForward(const Piece& piece, const PaperDart& dart) {
  const Flat forward = dart.from - dart.until, along = dart.point - lerp(dart.from, dart.until, 0.5);
  if (std::abs(along.u) > std::abs(along.v)) return forward.v < 0;
  const double aside = centreOf(piece.outline, dart) - lerp(dart.from, dart.until, 0.5).u;
  return std::abs(aside) > kOnCentre && aside * forward.u > 0;
}

Flat capOf(const Piece& piece, const PaperDart& dart) {
  const auto& edges = piece.outline.edges;
  const std::size_t n = edges.size();
  const bool forward = pressedForward(piece, dart);
  const Flat end = forward ? dart.from : dart.until;
  const Flat on = forward ? endTangent(edges[(dart.to + n - 1) % n].curve, true) * -1
                          : endTangent(edges[(dart.back + 1) % n].curve, false);
  const Flat middle = lerp(dart.from, dart.until, 0.5), fold = normalized(middle - dart.point),
             leg = normalized(dart.point - end);
  const Flat back = leg * (2 * dot(on, leg)) - on;  // the edge that it lies over, as it lies under the pressed dart
  const double turned = cross(back, fold);
  if (std::abs(turned) < 1e-9) return middle;
  const Flat peak = end + back * (cross(dart.point - end, fold) / turned);
  // Where that edge runs almost along the leg there is no such place near by.
  const bool good = dot(peak - end, back) > 0 && distance(peak, middle) < distance(dart.from, dart.until);
  return good ? peak : middle;
}

}  // namespace karinui
