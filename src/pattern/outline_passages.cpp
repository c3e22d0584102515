#include "outline_passages.h"

#include <cmath>

namespace karinui {

namespace {

constexpr double kSameParameter = 1e-9;  // of a curve
constexpr double kOnLine = 1e-7;         // metres
constexpr double kNoLength = 1e-6;       // metres

}  // namespace

std::optional<Passage> passageNear(const Outline& outline, Flat normal, double offset, Flat near) {
  std::optional<Passage> best;
  const auto& edges = outline.edges;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    constexpr int kLooks = 64;
    const auto away = [&](double t) { return dot(edges[k].curve.at(t), normal) - offset; };
    for (int i = 0; i < kLooks; ++i) {
      double in = i / double{kLooks}, out = (i + 1) / double{kLooks};
      const double first = away(in), last = away(out);
      if ((first > 0) == (last > 0) && std::abs(first) > kOnLine && std::abs(last) > kOnLine) continue;
      if (std::abs(first) <= kOnLine)
        out = in;
      else if (std::abs(last) <= kOnLine)
        in = out;
      for (int round = 0; round < 50 && in < out; ++round) {
        const double middle = 0.5 * (in + out);
        ((away(middle) > 0) == (first > 0) ? in : out) = middle;
      }
      const Flat place = edges[k].curve.at(in);
      if (!best || distance(place, near) < distance(best->place, near) - kOnLine) best = Passage{k, in, place};
    }
  }
  return best;
}

std::vector<EdgeStretch> stretchesBetween(const Outline& outline, const Passage& from, const Passage& to) {
  const auto& edges = outline.edges;
  std::vector<EdgeStretch> stretches;
  std::size_t k = from.edge;
  double t = from.t;
  for (std::size_t guard = 0; guard <= edges.size(); ++guard) {
    const bool last = k == to.edge && (guard > 0 || to.t > t);
    const double end = last ? to.t : 1;
    if (end - t > kSameParameter && edges[k].curve.part(t, end).length() > kNoLength) stretches.push_back({k, t, end});
    if (last) break;
    k = (k + 1) % edges.size(), t = 0;
  }
  return stretches;
}

}  // namespace karinui
