#include <algorithm>
#include <cmath>

#include "cut_along.h"
#include "meetings.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kCorner = 1e-3;  // metres: a cut this near to a corner goes through it

// The corner before which the cut starts, after the outline is divided there if need be.
Flat toCorner(const Outline& outline, EdgePlace& on) {
  const Curve& curve = outline.edges[on.edge].curve;
  const double before = curve.lengthTo(on.t), behind = curve.length() - before;
  if (before < kCorner && before <= behind) on.t = 0;
  if (behind < kCorner && behind < before) on = {(on.edge + 1) % outline.edges.size(), 0};
  return outline.edges[on.edge].curve.at(on.t);
}

std::size_t cornerAt(const Outline& outline, Flat place) {
  for (std::size_t k = 0; k < outline.edges.size(); ++k)
    if (outline.edges[k].curve.start == place) return k;
  KARINUI_ASSERT(false);
  return 0;
}

std::vector<Edge> bank(const std::vector<Flat>& line, std::set<std::string>& taken) {
  std::vector<Edge> edges;
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    edges.push_back({freeName("cut", taken), Curve::line(line[k], line[k + 1])});
  return edges;
}

std::vector<Edge> walkedBack(std::vector<Edge> edges) {
  std::reverse(edges.begin(), edges.end());
  for (Edge& edge : edges) edge.curve = edge.curve.reversed();
  return edges;
}

// Divides an internal line at the cut; what is sewn to it goes along. Each piece keeps its first part.
void divideLine(InternalLine& line, const Piece& whole, Piece& one, Piece& two, const std::vector<Flat>& cut,
                EdgeMap& map) {
  const auto parts = partsAcross(line.curves.front(), cut);
  auto& spans = map[{whole.id, line.name}];
  std::set<PieceId> has;
  for (Piece* piece : {&one, &two})
    std::erase_if(piece->lines, [&](const InternalLine& own) { return own.name == line.name; });
  const Ring ring = one.outline.flattened();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& [from, curve] = parts[k];
    Piece& piece = contains(ring, curve.at(0.5)) ? one : two;
    if (!has.insert(piece.id).second) continue;
    piece.lines.push_back({line.name, {curve}, line.crease});
    spans.push_back({from, k + 1 < parts.size() ? parts[k + 1].first : 1, {piece.id, line.name, 0, 1}});
  }
}

// Leaves to one of two pieces what lies on its cloth.
void keepOwn(Piece& piece) {
  const Ring ring = piece.outline.flattened();
  std::erase_if(piece.holes, [&](const Outline& hole) { return !contains(ring, hole.edges[0].curve.at(0.5)); });
  for (InternalLine& line : piece.lines)
    std::erase_if(line.curves, [&](const Curve& curve) { return !contains(ring, curve.at(0.5)); });
  std::erase_if(piece.lines, [](const InternalLine& line) { return line.curves.empty(); });
  std::erase_if(piece.marks, [&](const Mark& mark) {
    return mark.edge.empty() ? !contains(ring, mark.place) : findEdge(piece, mark.edge) == nullptr;
  });
}

// The edges from one corner of an outline to another, in its direction.
std::vector<Edge> runFrom(const Outline& outline, std::size_t from, std::size_t to) {
  std::vector<Edge> run;
  for (std::size_t k = from; k != to; k = (k + 1) % outline.edges.size()) run.push_back(outline.edges[k]);
  return run;
}

// The places of a cut, in one run from the outline or a hole to the next.
std::vector<std::vector<Flat>> runsOf(const std::vector<Flat>& line, const std::vector<HoleCrossing>& crossings) {
  std::vector<std::vector<Flat>> runs{{line.front()}};
  std::size_t next = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const auto at = static_cast<double>(k);
    for (; next < crossings.size() && crossings[next].enters < at; ++next)
      runs.back().push_back(crossings[next].in.place), runs.push_back({crossings[next].out.place});
    if (next == 0 || crossings[next - 1].leaves < at) runs.back().push_back(line[k]);
  }
  return runs;
}

// No cut edge shorter than an edge may be.
void dropShort(std::vector<Flat>& places) {
  for (std::size_t k = 1; k + 1 < places.size();)
    if (distance(places[k - 1], places[k]) < kCorner || distance(places[k], places[k + 1]) < kCorner)
      places.erase(places.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
}

}  // namespace

Result<CutPieces> cutAlong(const Piece& piece, Stretch stretch, std::vector<HoleCrossing> crossings, PieceId second,
                           const std::string& secondName, const std::set<std::string>& sewnLines,
                           std::optional<bool> keepLeft) {
  if (!stretch.start) {  // a slit drawn from its tip
    std::reverse(stretch.line.begin(), stretch.line.end());
    std::swap(stretch.start, stretch.end);
  }
  for (std::size_t h = 0; h < piece.holes.size(); ++h) {
    if (std::any_of(crossings.begin(), crossings.end(), [&](const HoleCrossing& own) { return own.hole == h; }))
      continue;
    std::vector<Meeting> through;
    meetings(stretch.line, piece.holes[h], through);
    if (!through.empty())
      return refused(say("The line runs into a hole at {0} mm; lead it round the hole.", inMm(through[0].place)));
  }

  CutPieces cut{{piece}, {}};
  Piece& whole = cut.pieces[0];
  std::vector<EdgePlace> divisions;
  stretch.line.front() = toCorner(piece.outline, *stretch.start);
  if (stretch.start->t > 0) divisions.push_back(*stretch.start);
  if (stretch.end) {
    stretch.line.back() = toCorner(piece.outline, *stretch.end);
    if (stretch.end->t > 0) divisions.push_back(*stretch.end);
  }
  for (HoleCrossing& own : crossings)
    for (Meeting* end : {&own.in, &own.out}) end->place = toCorner(piece.holes[own.hole], end->on);
  auto runs = runsOf(stretch.line, crossings);
  for (auto& places : runs) {
    dropShort(places);
    if (distance(places.front(), places.back()) < kCorner)
      return refused(say("The line begins and ends at one place of the outline, {0} mm; a cut must lead elsewhere.",
                         inMm(places.front())));
  }
  divideEdges(whole.outline, divisions, edgeNames(whole), piece.id, cut.edges);
  for (const HoleCrossing& own : crossings) {
    std::vector<EdgePlace> ends;
    for (const Meeting* end : {&own.in, &own.out})
      if (end->on.t > 0) ends.push_back(end->on);
    divideEdges(whole.holes[own.hole], ends, edgeNames(whole), piece.id, cut.edges);
  }
  followMarks(whole, cut.edges);
  auto taken = edgeNames(whole);
  const std::size_t mouth = cornerAt(whole.outline, stretch.line.front());
  std::vector<std::vector<Edge>> banks;
  for (const auto& places : runs) banks.push_back(bank(places, taken));

  if (!stretch.end) {
    const auto& places = runs.front();
    const std::vector<Flat> backLine(places.rbegin(), places.rend());
    std::vector<Edge> both = banks.front(), back = bank(backLine, taken);
    both.insert(both.end(), back.begin(), back.end());
    auto& edges = whole.outline.edges;
    edges.insert(edges.begin() + static_cast<std::ptrdiff_t>(mouth), both.begin(), both.end());
    auto good = checked(whole.outline);
    if (!good) return good.error();
    whole.outline = std::move(*good);
    return cut;
  }

  const std::size_t exit = cornerAt(whole.outline, stretch.line.back());
  Piece one = whole, two = whole;
  one.outline.edges = runFrom(whole.outline, exit, mouth);
  two.outline.edges = runFrom(whole.outline, mouth, exit);
  const auto add = [](Piece& to, const std::vector<Edge>& run) {
    to.outline.edges.insert(to.outline.edges.end(), run.begin(), run.end());
  };
  // A hole is walked against its own direction, for the cloth lies without.
  for (std::size_t k = 0; k < banks.size(); ++k) {
    add(one, banks[k]);
    if (k == crossings.size()) break;
    const Outline& hole = whole.holes[crossings[k].hole];
    add(one, walkedBack(runFrom(hole, cornerAt(hole, crossings[k].out.place), cornerAt(hole, crossings[k].in.place))));
  }
  for (std::size_t k = banks.size(); k-- > 0;) {
    add(two, walkedBack(banks[k]));
    if (k == 0) break;
    const Outline& hole = whole.holes[crossings[k - 1].hole];
    add(two, walkedBack(
                 runFrom(hole, cornerAt(hole, crossings[k - 1].in.place), cornerAt(hole, crossings[k - 1].out.place))));
  }
  // `one` lies left of the line.
  cut.keptLeft = keepLeft ? *keepLeft : one.outline.area() >= two.outline.area();
  if (!cut.keptLeft) std::swap(one, two);
  two.id = second;
  two.name = secondName;
  for (Piece* part : {&one, &two}) {
    for (const HoleCrossing& own : crossings)
      for (const Edge& edge : whole.holes[own.hole].edges) {
        std::erase_if(part->holes, [&](const Outline& hole) { return hole.find(edge.name).has_value(); });
        for (Mark& mark : part->marks)
          if (mark.edge == edge.name) mark.fraction = 1 - mark.fraction;
      }
    auto good = checked(part->outline);
    if (!good) return good.error();
    part->outline = std::move(*good);
    keepOwn(*part);
  }
  // Every old edge (and those of holes) that went to the second piece.
  for (auto& [old, parts] : cut.edges)
    for (EdgePart& part : parts)
      if (two.outline.find(part.now.edge)) part.now.piece = second;
  std::set<std::string> gone = edgeNames(two);
  for (const auto& run : banks)
    for (const Edge& edge : run) gone.erase(edge.name);
  for (const std::string& name : gone)
    if (findEdge(piece, name) && !cut.edges.contains({piece.id, name}))
      cut.edges[{piece.id, name}] = {{0, 1, {second, name, 0, 1}}};
  std::vector<Flat> places;
  for (const auto& run : runs) places.insert(places.end(), run.begin(), run.end());
  for (InternalLine internal : piece.lines)
    if (sewnLines.contains(internal.name) && internal.curves.size() == 1 && !findEdge(piece, internal.name))
      divideLine(internal, piece, one, two, places, cut.edges);
  cut.pieces = {std::move(one), std::move(two)};
  return cut;
}

Result<CutPieces> cutPiece(const Piece& piece, std::vector<Flat> line, PieceId second, const std::string& secondName,
                           const std::set<std::string>& sewnLines, bool toCorners) {
  auto stretches = stretchesOver(piece, std::move(line), {});
  if (!stretches) return stretches.error();
  if (toCorners)
    if (auto led = *stretches; leadToCorners(piece.outline, led))
      if (auto cut = cutAlong(piece, std::move(led.front()), {}, second, secondName, sewnLines)) return cut;
  return cutAlong(piece, std::move(stretches->front()), {}, second, secondName, sewnLines);
}

}  // namespace karinui
