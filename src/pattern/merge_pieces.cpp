// Two papers laid edge to edge and made one, as a yoke's parts are once its darts are closed.
#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "karinui/pattern/edit.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kApart = 2e-3;  // metres by which the edges may differ in length, or miss each other where they meet
constexpr int kLooks = 64;       // places of each run that are compared

std::vector<Curve> curvesOf(const Piece& piece, std::span<const std::string> run) {
  std::vector<Curve> curves;
  for (const std::string& name : run) curves.push_back(piece.outline.edges[*piece.outline.find(name)].curve);
  return curves;
}

// Places evenly over the length of a run, ends included.
std::vector<Flat> placesOf(const std::vector<Curve>& curves) {
  std::vector<double> ends{0};
  for (const Curve& curve : curves) ends.push_back(ends.back() + curve.length());
  std::vector<Flat> places;
  std::size_t k = 0;
  for (int i = 0; i <= kLooks; ++i) {
    const double at = ends.back() * i / kLooks;
    while (k + 1 < curves.size() && at > ends[k + 1]) ++k;
    const double own = ends[k + 1] - ends[k];
    places.push_back(curves[k].atFraction(std::clamp((at - ends[k]) / own, 0.0, 1.0)));
  }
  return places;
}

// The turn and shift that lay `moving` on `fixed` with the least sum of squared distances.
PaperMove fitted(const std::vector<Flat>& moving, const std::vector<Flat>& fixed) {
  PaperMove move;
  const double n = static_cast<double>(moving.size());
  for (std::size_t i = 0; i < moving.size(); ++i)
    move.from = move.from + moving[i] * (1 / n), move.to = move.to + fixed[i] * (1 / n);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < moving.size(); ++i)
    along += dot(moving[i] - move.from, fixed[i] - move.to), across += cross(moving[i] - move.from, fixed[i] - move.to);
  move.radians = std::atan2(across, along);
  return move;
}

// The outline's edges but for those of a run, from the run's end on round to its start.
Result<std::vector<Edge>> restOf(const Piece& piece, std::span<const std::string> run) {
  const auto& edges = piece.outline.edges;
  const std::size_t n = edges.size(), first = *piece.outline.find(run.front());
  for (std::size_t i = 0; i < run.size(); ++i)
    if (edges[(first + i) % n].name != run[i])
      return refused(say("“{0}” of {1} does not go on where the edge before ends.", run[i], piece.name));
  if (run.size() == n) return refused(say("These are all edges of {0}; none would be left.", piece.name));
  std::vector<Edge> rest;
  for (std::size_t i = run.size(); i < n; ++i) rest.push_back(edges[(first + i) % n]);
  return rest;
}

}  // namespace

Flat PaperMove::operator()(Flat p) const { return Curve::line(p, p).rotated(from, radians).start + (to - from); }

Curve PaperMove::operator()(const Curve& curve) const {
  Curve moved = curve.rotated(from, radians);
  for (Flat* p : {&moved.start, &moved.end, &moved.control1, &moved.control2}) *p = *p + (to - from);
  for (Flat& p : moved.between) p = p + (to - from);
  return moved;
}

Result<MergedPieces> mergePieces(const Piece& piece, std::span<const std::string> run, const Piece& other,
                                 std::span<const std::string> otherRun) {
  for (const auto& [of, names] : {std::pair(&piece, run), std::pair(&other, otherRun)})
    for (const std::string& name : names)
      if (!of->outline.find(name)) return noEdge(*of, name);
  auto rest = restOf(piece, run), otherRest = restOf(other, otherRun);
  if (!rest) return rest.error();
  if (!otherRest) return otherRest.error();
  const std::vector<Curve> here = curvesOf(piece, run), there = curvesOf(other, otherRun);
  const auto lengthOf = [](const std::vector<Curve>& curves) {
    double all = 0;
    for (const Curve& curve : curves) all += curve.length();
    return all;
  };
  if (std::fabs(lengthOf(here) - lengthOf(there)) > kApart)
    return refused(say("The edges are {0} and {1} mm long; make them alike, then merge the pieces.",
                       inMm(lengthOf(here)), inMm(lengthOf(there))));
  const std::vector<Flat> fixed = placesOf(here);
  std::vector<Flat> moving = placesOf(there);
  std::reverse(moving.begin(), moving.end());
  MergedPieces merged{piece, {}, fitted(moving, fixed)};
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (const double miss = distance(merged.move(moving[i]), fixed[i]); miss > kApart)
      return refused(
          say("The edges are not alike: laid on each other they miss by {0} mm at {1} mm, so that the cloth of both "
              "does not lie flat as one.",
              inMm(miss), inMm(fixed[i])));

  std::set<std::string> taken;
  for (const Edge& edge : *rest) taken.insert(edge.name);
  for (const Outline& hole : piece.holes)
    for (const Edge& edge : hole.edges) taken.insert(edge.name);
  for (const InternalLine& line : piece.lines) taken.insert(line.name);
  const auto moveEdge = [&](Edge& edge) {
    const std::string was = edge.name;
    edge.name = freeName(was, taken);
    edge.curve = merged.move(edge.curve);
    merged.edges[{other.id, was}] = {{0, 1, {piece.id, edge.name, 0, 1}}};
  };
  for (Edge& edge : *otherRest) moveEdge(edge);
  for (const std::string& name : run) merged.edges[{piece.id, name}] = {};
  for (const std::string& name : otherRun) merged.edges[{other.id, name}] = {};
  Piece& whole = merged.piece;
  whole.outline.edges = *rest;
  whole.outline.edges.insert(whole.outline.edges.end(), otherRest->begin(), otherRest->end());
  auto& edges = whole.outline.edges;
  for (const auto& [before, behind] : {std::pair(rest->size() - 1, rest->size()), std::pair(edges.size() - 1, 0ul)})
    edges[before].curve.end = edges[behind].curve.start = lerp(edges[before].curve.end, edges[behind].curve.start, 0.5);
  auto good = checked(std::move(whole.outline));
  if (!good) return refused(say("Laid together, the pieces make no paper. {0}", good.error().what));
  whole.outline = *std::move(good);

  for (Outline hole : other.holes) {
    for (Edge& edge : hole.edges) moveEdge(edge);
    whole.holes.push_back(std::move(hole));
  }
  for (InternalLine line : other.lines) {
    const std::string was = line.name;
    line.name = freeName(was, taken);
    for (Curve& curve : line.curves) curve = merged.move(curve);
    if (!findEdge(other, was)) merged.edges[{other.id, was}] = {{0, 1, {piece.id, line.name, 0, 1}}};
    whole.lines.push_back(std::move(line));
  }
  const auto goes = [&](const Mark& mark) { return !mark.edge.empty() && !findEdge(whole, mark.edge); };
  std::erase_if(whole.marks, goes);
  std::set<std::string> marks;
  for (const Mark& mark : whole.marks) marks.insert(mark.name);
  for (Mark mark : other.marks) {
    if (mark.edge.empty()) {
      mark.place = merged.move(mark.place);
    } else {
      const auto now = placeNow(merged.edges, other.id, mark.edge, mark.fraction);
      if (!now) continue;
      mark.edge = now->first;
    }
    if (!mark.name.empty()) mark.name = freeName(mark.name, marks);
    whole.marks.push_back(std::move(mark));
  }
  return merged;
}

}  // namespace karinui
