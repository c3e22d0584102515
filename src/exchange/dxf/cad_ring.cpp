#include "cad_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

constexpr double kGap = 5e-4;                   // between the ends of lines that are one outline
constexpr double kOnFold = 2e-4;                // of the fold line
constexpr double kBend = std::numbers::pi / 6;  // of chords, where the file does not say what is a corner
constexpr std::size_t kMostLines = 5000;        // chaining compares all with all

void dropRepeated(std::vector<Flat>& ring) {
  ring.erase(std::unique(ring.begin(), ring.end(), [](Flat a, Flat b) { return distance(a, b) < kSamePlace; }),
             ring.end());
  while (ring.size() > 1 && distance(ring.front(), ring.back()) < kSamePlace) ring.pop_back();
}

double bendAt(const std::vector<Flat>& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const Flat in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
  return std::abs(std::atan2(cross(in, out), dot(in, out)));
}

}  // namespace

std::optional<std::vector<Flat>> chained(const std::vector<CadLine>& lines, Flat& gap) {
  std::vector<Flat> largest;
  for (const CadLine& line : lines)
    if (line.closed || (line.points.size() > 3 && distance(line.points.front(), line.points.back()) < kGap))
      if (largest.empty() || std::abs(signedArea(line.points)) > std::abs(signedArea(largest))) largest = line.points;
  if (largest.empty() && !lines.empty() && lines.size() <= kMostLines) {
    std::vector<char> used(lines.size(), 0);
    largest = lines[0].points;
    used[0] = 1;
    for (std::size_t left = lines.size() - 1; left > 0; --left) {
      std::size_t best = lines.size();
      bool turned = false;
      double nearest = kGap;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (used[i]) continue;
        for (const bool back : {false, true}) {
          const Flat start = back ? lines[i].points.back() : lines[i].points.front();
          if (const double d = distance(largest.back(), start); d < nearest) nearest = d, best = i, turned = back;
        }
      }
      if (best == lines.size()) break;  // closed already, or open
      used[best] = 1;
      if (turned)
        largest.insert(largest.end(), lines[best].points.rbegin(), lines[best].points.rend());
      else
        largest.insert(largest.end(), lines[best].points.begin(), lines[best].points.end());
    }
    gap = largest.back();
    if (distance(largest.front(), largest.back()) > kGap) return std::nullopt;
  }
  dropRepeated(largest);
  if (largest.size() < 3) return std::nullopt;
  if (signedArea(largest) < 0) std::reverse(largest.begin(), largest.end());
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
