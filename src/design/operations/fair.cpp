// Edges are drawn anew as fair lines.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "design/operations/operations.h"
#include "karinui/design/drawing.h"

namespace karinui {

namespace {

constexpr double kCornerTurn = 0.5;    // radians: two edges that turn by more where they meet are two lines
constexpr double kRightAngle = 0.35;   // radians off a right angle: the line keeps its direction at such a corner
constexpr double kGoesOn = 0.15;       // radians: two edges that turn by less go on smoothly
constexpr double kLeastChange = 5e-5;  // metres: a line that moves by less is fair already

// The chosen edges, by their number in the outline, in runs that go on smoothly.
std::vector<std::vector<std::size_t>> smoothRuns(const Outline& outline, const std::vector<bool>& chosen) {
  const std::size_t n = outline.edges.size();
  const auto goesOn = [&](std::size_t k) {  // from edge k to the next
    const std::size_t next = (k + 1) % n;
    if (!chosen[k] || !chosen[next]) return false;
    const Flat in = outline.edges[k].curve.tangent(1), out = outline.edges[next].curve.tangent(0);
    return std::fabs(angleFrom(in, out)) < kCornerTurn;
  };
  std::size_t first = 0;  // a ring without a corner begins anywhere
  while (first + 1 < n && goesOn((first + n - 1) % n)) ++first;
  std::vector<std::vector<std::size_t>> runs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (first + i) % n;
    if (!chosen[k]) continue;
    if (i == 0 || !goesOn((k + n - 1) % n)) runs.emplace_back();
    runs.back().push_back(k);
  }
  return runs;
}

// At a seam a line ends square to it, so that both of its halves go on smoothly when they are sewn; and a line that
// goes on smoothly into an edge that was not chosen still does.
bool directionMatters(Flat in, Flat out) {
  const double turn = std::acos(std::clamp(dot(normalized(in), normalized(out)), -1.0, 1.0));
  return turn < kGoesOn || std::fabs(turn - std::numbers::pi / 2) < kRightAngle;
}
KeptDirections directionsKept(const Outline& outline, const std::vector<std::size_t>& run) {
  const auto& edges = outline.edges;
  const std::size_t n = edges.size(), before = (run.front() + n - 1) % n, after = (run.back() + 1) % n;
  return {directionMatters(edges[before].curve.tangent(1), edges[run.front()].curve.tangent(0)),
          directionMatters(edges[run.back()].curve.tangent(1), edges[after].curve.tangent(0))};
}

// How far the two curves are apart at most, at equal shares of their lengths.
double farthest(const Curve& a, const Curve& b) {
  constexpr int kPlaces = 50;
  double far = 0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double f = static_cast<double>(i) / kPlaces;
    far = std::fmax(far, distance(a.atFraction(f), b.atFraction(f)));
  }
  return far;
}

}  // namespace

Done resolve(const Document& before, FairEdges& op, Context& context) {
  return resolveWhole(before, op.edges, op.symmetric, context);
}

Result<Document> perform(const Document& before, const FairEdges& op, Context& context) {
  std::map<PieceId, std::vector<bool>> chosen;
  for (const EdgeRef& ref : op.edges) {
    const Outline& outline = before.find(ref.piece.id)->outline;
    chosen.try_emplace(ref.piece.id, outline.edges.size()).first->second[*outline.find(ref.edge)] = true;
  }
  Document after = before;
  bool changed = false;
  for (const auto& [id, edges] : chosen) {
    const Piece was = *after.find(id);
    ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
    reshape.piece = id;
    reshape.outline = was.outline;
    for (const std::vector<std::size_t>& run : smoothRuns(was.outline, edges)) {
      std::vector<Curve> line;
      for (const std::size_t k : run) line.push_back(was.outline.edges[k].curve);
      const std::vector<Curve> fair = fairLine(line, directionsKept(was.outline, run));
      for (std::size_t i = 0; i < run.size(); ++i)
        if (farthest(line[i], fair[i]) > kLeastChange) reshape.outline.edges[run[i]].curve = fair[i];
    }
    for (std::size_t k = 0; k < was.outline.edges.size(); ++k)  // corners are met to the last bit
      reshape.outline.edges[(k + 1) % was.outline.edges.size()].curve.start = reshape.outline.edges[k].curve.end;
    const auto symmetry = op.symmetric == Choice::No ? std::nullopt : symmetryOf(was.outline);
    if (symmetry) reshape.outline = onBothHalves(was.outline, std::move(reshape.outline), *symmetry);
    if (reshape.outline == was.outline) continue;
    changed = true;
    auto next = cutAnew(after, reshape);
    if (!next) return next.error();
    after = *std::move(next);
    tellLengths(was, *after.find(id), context);
  }
  if (!changed && context.advise) context.advise({say("These edges are fair lines already.")});
  tellSeams(before, after, context);
  return after;
}

}  // namespace karinui
