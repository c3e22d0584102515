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

}  // namespace

std::vector<CadLoop> loopsOf(const std::vector<CadLine>& lines, Flat& gap, double meet) {
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
