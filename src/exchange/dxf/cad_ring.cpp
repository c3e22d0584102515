#include "cad_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

constexpr double kOnFold = 2e-4;                   // of the fold line
constexpr double kBend = std::numbers::pi / 6;     // of chords, where the file does not say what is a corner
constexpr std::size_t kMostLines = 5000;           // chaining compares all with all …
constexpr std::size_t kMostCompared = 50'000'000;  // … and begins anew where a chain does not close
constexpr double kThinned = 3e-5;                  // with the fit of curves they stay within 0.05 mm
constexpr double kFarthestApart = 1e-3;            // of points that are kept …
constexpr double kMostKept = 1e4;                  // … but where a line is longer than so many of that

void dropRepeated(std::vector<Flat>& ring) {
  ring.erase(std::unique(ring.begin(), ring.end(), [](Flat a, Flat b) { return distance(a, b) < kSamePlace; }),
             ring.end());
  while (ring.size() > 1 && distance(ring.front(), ring.back()) < kSamePlace) ring.pop_back();
}

double bendAt(const std::vector<Flat>& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const Flat in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
  return std::abs(angleFrom(in, out));
}

// Lines that go on where the one before them ends, as a plotter's file writes an outline, each run of them as one.
struct Strands {
  std::vector<CadLine> lines;
  std::vector<std::vector<std::size_t>> of;  // each: the lines that it is made of
};
Strands strandsOf(const std::vector<CadLine>& lines) {
  Strands all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CadLine& line = lines[i];
    CadLine* last = all.lines.empty() ? nullptr : &all.lines.back();
    const bool goesOn = last && !last->closed && !line.closed && !last->points.empty() && !line.points.empty() &&
                        distance(last->points.back(), line.points.front()) < kSamePlace &&
                        (last->points.size() < 4 || distance(last->points.back(), last->points.front()) >= kSamePlace);
    if (!goesOn) {
      all.lines.push_back(line), all.of.push_back({i});
      continue;
    }
    last->points.insert(last->points.end(), line.points.begin() + 1, line.points.end());
    all.of.back().push_back(i);
  }
  return all;
}

}  // namespace

std::vector<CadLoop> loopsOf(const std::vector<CadLine>& lines, Flat& gap, double meet) {
  if (lines.size() > kMostLines) {
    const Strands strands = strandsOf(lines);
    if (strands.lines.size() < lines.size()) {
      auto loops = loopsOf(strands.lines, gap, meet);
      for (CadLoop& loop : loops) {
        std::vector<std::size_t> own;
        for (const std::size_t k : loop.lines) own.insert(own.end(), strands.of[k].begin(), strands.of[k].end());
        loop.lines = std::move(own);
      }
      return loops;
    }
  }
  std::vector<CadLoop> all;
  std::vector<char> used(lines.size(), 0);
  const auto add = [&](CadLoop loop) {
    dropRepeated(loop.points);
    if (loop.points.size() < 3) return;
    if (signedArea(loop.points) < 0) std::reverse(loop.points.begin(), loop.points.end());
    all.push_back(std::move(loop));
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& points = lines[i].points;
    if (points.empty()) used[i] = 1;
    if (lines[i].closed || (points.size() > 3 && distance(points.front(), points.back()) < meet))
      used[i] = 1, add({points, {i}});
  }
  std::size_t compared = 0;
  for (std::size_t first = 0; first < lines.size() && lines.size() <= kMostLines; ++first) {
    if (used[first]) continue;
    CadLoop loop{lines[first].points, {first}};
    used[first] = 1;
    const auto closed = [&] {
      return loop.points.size() > 3 && distance(loop.points.front(), loop.points.back()) <= meet;
    };
    while (loop.lines.size() == 1 || !closed()) {
      std::size_t best = lines.size();
      bool turned = false;
      double nearest = meet;
      for (std::size_t i = 0; i < lines.size() && ++compared < kMostCompared; ++i) {
        if (used[i]) continue;
        for (const bool back : {false, true}) {
          const Flat start = back ? lines[i].points.back() : lines[i].points.front();
          if (const double d = distance(loop.points.back(), start); d < nearest) nearest = d, best = i, turned = back;
        }
      }
      if (best == lines.size()) break;
      used[best] = 1;
      loop.lines.push_back(best);
      if (turned)
        loop.points.insert(loop.points.end(), lines[best].points.rbegin(), lines[best].points.rend());
      else
        loop.points.insert(loop.points.end(), lines[best].points.begin(), lines[best].points.end());
    }
    if (closed()) {
      add(std::move(loop));
      continue;
    }
    gap = loop.points.back();
    for (const std::size_t i : loop.lines) used[i] = i == first;  // another one may begin there
  }
  return all;
}

std::optional<std::vector<Flat>> chained(const std::vector<CadLine>& lines, Flat& gap) {
  std::optional<std::vector<Flat>> largest;
  for (CadLoop& loop : loopsOf(lines, gap))
    if (!largest || signedArea(loop.points) > signedArea(*largest)) largest = std::move(loop.points);
  return largest;
}

std::vector<Flat> thinned(const std::vector<Flat>& points, bool closed, const std::vector<Flat>& stay) {
  const std::size_t n = points.size();
  if (n < 3) return points;
  const PlaceSet staying(stay);
  double whole = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) whole += distance(points[i], points[i + 1]);
  const double apart = std::max(kFarthestApart, whole / kMostKept);
  std::vector<Flat> kept{points[0]};
  // The ways from the last point kept that pass all points since within the tolerance lie between two angles, counted
  // from the first such way.
  std::size_t from = 0;
  Flat way;
  double low = 0, high = 0, far = 0;
  for (std::size_t k = 1; k < n + (closed ? 1 : 0); ++k) {
    const Flat here = points[k % n];
    const double away = distance(points[from], here);
    const auto narrowed = [&] {
      if (away <= kThinned) return true;
      if (far <= kThinned) way = here - points[from], low = -std::numbers::pi, high = std::numbers::pi;
      const double angle = angleFrom(way, here - points[from]), slack = std::asin(kThinned / away);
      if (angle < low || angle > high) return false;
      low = std::max(low, angle - slack), high = std::min(high, angle + slack);
      return true;
    };
    const bool goesOn = away >= far && away <= apart && narrowed();
    if (!goesOn && from + 1 < k) {
      from = k - 1, far = 0;
      kept.push_back(points[from]);
      --k;  // once more, from the point that is kept now
      continue;
    }
    far = away;
    if (k < n && (!goesOn || staying.near(here))) from = k, far = 0, kept.push_back(here);
  }
  if (!closed && kept.back() != points.back()) kept.push_back(points.back());
  return kept;
}

CadRing withTurns(std::vector<Flat> points, const std::vector<Flat>& turns) {
  CadRing ring{std::move(points), {}};
  ring.turn.resize(ring.points.size(), 0);
  const PlaceSet told(turns);
  for (std::size_t i = 0; i < ring.points.size(); ++i) ring.turn[i] = told.near(ring.points[i]);
  if (std::none_of(ring.turn.begin(), ring.turn.end(), [](char c) { return c != 0; }))
    for (std::size_t i = 0; i < ring.points.size(); ++i) ring.turn[i] = bendAt(ring.points, i) > kBend;
  return ring;
}

std::optional<CadRing> unfolded(const CadRing& half, Flat through, Flat unitAxis) {
  const std::size_t n = half.points.size();
  const auto on = [&](std::size_t i) { return std::abs(cross(unitAxis, half.points[i % n] - through)) < kOnFold; };
  std::size_t first = n, longest = 1;  // of the run of points on the line
  for (std::size_t i = 0; i < n; ++i) {
    if (!on(i) || on(i + n - 1)) continue;
    std::size_t count = 1;
    while (count < n && on(i + count)) ++count;
    if (count > longest && count < n) longest = count, first = i;
  }
  if (first == n) return std::nullopt;
  CadRing whole;
  const auto add = [&](Flat p, char turn) { whole.points.push_back(p), whole.turn.push_back(turn); };
  const auto foot = [&](Flat p) { return through + dot(p - through, unitAxis) * unitAxis; };
  const std::size_t start = first + longest - 1, count = n - longest + 2;  // from the line back to it, ends included
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (start + k) % n;
    const bool end = k == 0 || k + 1 == count;
    add(end ? foot(half.points[i]) : half.points[i], end ? char{1} : half.turn[i]);
  }
  for (std::size_t k = count - 1; k-- > 1;) add(reflected(whole.points[k], through, unitAxis), whole.turn[k]);
  return whole;
}

}  // namespace karinui
