#include <algorithm>
#include <cmath>
#include <optional>

#include "divide_edges.h"
#include "karinui/pattern/edit.h"
#include "meetings.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kSnap = 5e-3;     // ends nearer to the outline than this go onto it
constexpr double kCorner = 1e-3;   // a cut this near to a corner goes through it
constexpr double kWiggle = 2e-4;   // of the line, straightened
constexpr double kSameCut = 1e-6;  // metres

Meeting nearestOn(const Outline& outline, Flat place) {
  Meeting best;
  double least = HUGE_VAL;
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const Curve& curve = outline.edges[e].curve;
    const int looks = 64 * static_cast<int>(curve.parts().size());
    double guess = 0, near = HUGE_VAL;
    for (int k = 0; k <= looks; ++k) {
      const double t = static_cast<double>(k) / looks;
      if (const double d = distance(curve.at(t), place); d < near) near = d, guess = t;
    }
    double low = std::max(0.0, guess - 1.0 / looks), high = std::min(1.0, guess + 1.0 / looks);
    for (int round = 0; round < 60; ++round) {  // the distance has one valley here
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(curve.at(a), place) < distance(curve.at(b), place) ? high : low) =
          distance(curve.at(a), place) < distance(curve.at(b), place) ? b : a;
    }
    for (double t : {guess, (low + high) / 2})
      if (const double d = distance(curve.at(t), place); d < least) least = d, best = {0, {e, t}, curve.at(t)};
  }
  return best;
}

void straighten(const std::vector<Flat>& line, std::size_t first, std::size_t last,
                std::vector<Flat>& kept) {  // Douglas-Peucker
  std::size_t far = first;
  double worst = kWiggle;
  for (std::size_t k = first + 1; k < last; ++k)
    if (const double d = distanceToSegment(line[first], line[last], line[k]); d > worst) worst = d, far = k;
  if (far != first) {
    straighten(line, first, far, kept);
    straighten(line, far, last, kept);
  } else {
    kept.push_back(line[last]);
  }
}

std::optional<Flat> selfCrossing(const std::vector<Flat>& line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < line.size(); ++j) {
      double other = 0;
      if (const auto t = segmentMeets(line[i], line[i + 1], line[j], line[j + 1], other))
        return lerp(line[i], line[i + 1], *t);
    }
  return std::nullopt;
}

// The part of the line inside the piece: its places, and where its ends stand on the outline, if they do.
struct Inside {
  std::vector<Flat> line;
  std::optional<EdgePlace> start, end;
};

Result<Inside> insidePart(const Piece& piece, std::vector<Flat> line) {
  const Ring ring = piece.outline.flattened(1e-6);
  std::optional<Meeting> startsOn, endsOn;
  double nearest = HUGE_VAL;
  for (const bool first : {true, false}) {
    Flat& end = first ? line.front() : line.back();
    Meeting meet = nearestOn(piece.outline, end);
    const double away = distance(meet.place, end);
    nearest = std::min(nearest, away);
    if (away > kSameCut && (away > kSnap || !contains(ring, end))) continue;
    end = meet.place;
    meet.at = first ? 0 : static_cast<double>(line.size() - 1);
    (first ? startsOn : endsOn) = meet;
  }
  std::vector<Meeting> all;
  meetings(line, piece.outline, all);
  std::erase_if(all, [&](const Meeting& m) {
    return (startsOn && distance(m.place, startsOn->place) < 1e-5) ||
           (endsOn && distance(m.place, endsOn->place) < 1e-5);
  });
  if (startsOn) all.push_back(*startsOn);
  if (endsOn) all.push_back(*endsOn);
  std::stable_sort(all.begin(), all.end(), [](const Meeting& a, const Meeting& b) { return a.at < b.at; });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Meeting& a, const Meeting& b) { return distance(a.place, b.place) < kSameCut; }),
            all.end());

  const double whole = static_cast<double>(line.size() - 1);
  const auto placeAt = [&](double at) {
    const auto k = std::min(static_cast<std::size_t>(at), line.size() - 2);
    return lerp(line[k], line[k + 1], at - static_cast<double>(k));
  };
  std::vector<std::array<int, 2>> stretches;  // meetings (or -1: an end of the line) around the parts inside
  for (int k = -1; k < static_cast<int>(all.size()); ++k) {
    const double from = k < 0 ? 0 : all[k].at, to = k + 1 < static_cast<int>(all.size()) ? all[k + 1].at : whole;
    if (to - from < 1e-9) continue;
    // Looked at in the middle of the longest straight bit, so that a corner of the line on the outline does not
    // mislead.
    if (!contains(ring, placeAt((from + to) / 2))) continue;
    if (!stretches.empty() && stretches.back()[1] == k)
      return refused(
          say("The line touches the outline at {0} mm on its way; keep it clear of the outline between its ends.",
              inMm(all[k].place)));
    stretches.push_back({k, k + 1 < static_cast<int>(all.size()) ? k + 1 : -1});
  }
  if (stretches.empty())
    return refused(say("The line does not run over piece {0}; draw it across the cloth.", piece.name));
  if (stretches.size() > 1)
    return refused(say("The line leaves piece {0} and comes back at {1} mm; cut once at a time.", piece.name,
                       inMm(all[stretches[1][0]].place)));
  const auto [before, after] = stretches[0];
  if (before < 0 && after < 0)
    return refused(
        say("The line does not reach the outline of piece {0}: its nearer end is {1} mm inside; begin or end it on an "
            "edge.",
            piece.name, inMm(nearest)));
  Inside inside;
  const double from = before < 0 ? 0 : all[before].at, to = after < 0 ? whole : all[after].at;
  inside.line.push_back(before < 0 ? line.front() : all[before].place);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (static_cast<double>(k) > from + 1e-9 && static_cast<double>(k) < to - 1e-9) inside.line.push_back(line[k]);
  inside.line.push_back(after < 0 ? line.back() : all[after].place);
  if (before >= 0) inside.start = all[before].on;
  if (after >= 0) inside.end = all[after].on;
  return inside;
}

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

}  // namespace

Result<CutPieces> cutPiece(const Piece& piece, std::vector<Flat> line, PieceId second, const std::string& secondName,
                           const std::set<std::string>& sewnLines) {
  for (Flat p : line)
    if (!finite(p) || std::abs(p.u) > 100 || std::abs(p.v) > 100)
      return badInput(say("A place of the line is not a usable number (lengths are metres, within 100 m)."));
  if (line.size() > 5000)
    return badInput(say("The line has {0} {0|place|places}; at most 5000 are taken.", line.size()));
  line.erase(std::unique(line.begin(), line.end(), [](Flat a, Flat b) { return distance(a, b) < kSameCut; }),
             line.end());
  if (line.size() < 2) return badInput(say("A cut needs a line of at least two places."));
  std::vector<Flat> straight{line.front()};
  straighten(line, 0, line.size() - 1, straight);
  if (const auto where = selfCrossing(straight))
    return refused(say("The line crosses itself at {0} mm; draw it without a loop.", inMm(*where)));
  auto inside = insidePart(piece, std::move(straight));
  if (!inside) return inside.error();
  if (!inside->start) {  // a slit drawn from its tip
    std::reverse(inside->line.begin(), inside->line.end());
    std::swap(inside->start, inside->end);
  }
  for (const Outline& hole : piece.holes) {
    std::vector<Meeting> through;
    meetings(inside->line, hole, through);
    if (!through.empty())
      return refused(say("The line runs into a hole at {0} mm; lead it round the hole.", inMm(through[0].place)));
  }

  CutPieces cut{{piece}, {}};
  Piece& whole = cut.pieces[0];
  auto taken = edgeNames(piece);
  std::vector<EdgePlace> divisions;
  inside->line.front() = toCorner(piece.outline, *inside->start);
  if (inside->start->t > 0) divisions.push_back(*inside->start);
  if (inside->end) {
    inside->line.back() = toCorner(piece.outline, *inside->end);
    if (inside->end->t > 0) divisions.push_back(*inside->end);
  }
  // No cut edge shorter than an edge may be.
  auto& places = inside->line;
  for (std::size_t k = 1; k + 1 < places.size();)
    if (distance(places[k - 1], places[k]) < kCorner || distance(places[k], places[k + 1]) < kCorner)
      places.erase(places.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  if (distance(places.front(), places.back()) < kCorner)
    return refused(say("The line begins and ends at one place of the outline, {0} mm; a cut must lead elsewhere.",
                       inMm(places.front())));
  divideEdges(whole.outline, divisions, taken, piece.id, cut.edges);
  followMarks(whole, cut.edges);
  taken = edgeNames(whole);
  auto& edges = whole.outline.edges;
  const std::size_t mouth = cornerAt(whole.outline, places.front());
  const std::vector<Edge> in = bank(places, taken);

  if (!inside->end) {
    std::vector<Flat> backLine(places.rbegin(), places.rend());
    std::vector<Edge> both = in, back = bank(backLine, taken);
    both.insert(both.end(), back.begin(), back.end());
    edges.insert(edges.begin() + static_cast<std::ptrdiff_t>(mouth), both.begin(), both.end());
    auto good = checked(whole.outline);
    if (!good) return good.error();
    whole.outline = std::move(*good);
    return cut;
  }

  const std::size_t exit = cornerAt(whole.outline, places.back());
  const auto between = [&](std::size_t from, std::size_t to) {
    std::vector<Edge> run;
    for (std::size_t k = from; k != to; k = (k + 1) % edges.size()) run.push_back(edges[k]);
    return run;
  };
  Piece one = whole, two = whole;
  one.outline.edges = between(exit, mouth);
  one.outline.edges.insert(one.outline.edges.end(), in.begin(), in.end());
  two.outline.edges = between(mouth, exit);
  const auto back = walkedBack(in);
  two.outline.edges.insert(two.outline.edges.end(), back.begin(), back.end());
  if (one.outline.area() < two.outline.area()) std::swap(one, two);
  two.id = second;
  two.name = secondName;
  for (Piece* part : {&one, &two}) {
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
  for (const Edge& edge : in) gone.erase(edge.name);
  for (const std::string& name : gone)
    if (findEdge(piece, name) && !cut.edges.contains({piece.id, name}))
      cut.edges[{piece.id, name}] = {{0, 1, {second, name, 0, 1}}};
  for (InternalLine internal : piece.lines)
    if (sewnLines.contains(internal.name) && internal.curves.size() == 1 && !findEdge(piece, internal.name))
      divideLine(internal, piece, one, two, places, cut.edges);
  cut.pieces = {std::move(one), std::move(two)};
  return cut;
}

}  // namespace karinui
