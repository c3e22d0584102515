#include "meetings.h"

#include <algorithm>
#include <cmath>

namespace karinui {

std::optional<double> segmentMeets(Flat a, Flat b, Flat c, Flat d, double& other) {
  const Flat r = b - a, s = d - c;
  const double turn = cross(r, s);
  if (std::abs(turn) < 1e-18) return std::nullopt;
  const double t = cross(c - a, s) / turn;
  other = cross(c - a, r) / turn;
  if (t < -1e-12 || t > 1 + 1e-12 || other < -1e-12 || other > 1 + 1e-12) return std::nullopt;
  return std::clamp(t, 0.0, 1.0);
}

// Refined on the curve itself.
void meetings(const std::vector<Flat>& line, const Outline& outline, std::vector<Meeting>& found) {
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const Curve& curve = outline.edges[e].curve;
    const auto chords = curve.flattened(1e-5);
    const auto count = static_cast<double>(chords.size() - 1);
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      for (std::size_t j = 0; j + 1 < chords.size(); ++j) {
        double on = 0;
        const auto t = segmentMeets(line[k], line[k + 1], chords[j], chords[j + 1], on);
        if (!t) continue;
        double u = (static_cast<double>(j) + on) / count;
        const Flat along = normalized(line[k + 1] - line[k]);
        for (int round = 0; round < 8; ++round) {
          const double slope = cross(along, curve.tangent(u));
          if (std::abs(slope) < 1e-12) break;
          u = std::clamp(u - cross(along, curve.at(u) - line[k]) / slope, 0.0, 1.0);
        }
        found.push_back({static_cast<double>(k) + *t, {e, u}, curve.at(u)});
      }
  }
}

std::vector<std::pair<double, Curve>> partsAcross(const Curve& curve, const std::vector<Flat>& line) {
  std::vector<Meeting> crossings;
  meetings(line, Outline{{{"line", curve}}}, crossings);
  std::vector<double> ends{0};
  for (const Meeting& meet : crossings)
    if (meet.on.t > 1e-6 && meet.on.t < 1 - 1e-6) ends.push_back(meet.on.t);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < 1e-6; }), ends.end());
  std::vector<std::pair<double, Curve>> parts;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double to = k + 1 < ends.size() ? ends[k + 1] : 1;
    parts.emplace_back(curve.lengthTo(ends[k]) / curve.length(),
                       ends[k] == 0 && to == 1 ? curve : curve.part(ends[k], to));
  }
  return parts;
}

}  // namespace karinui
