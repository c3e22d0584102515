#include "retrace.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kSameLine = 1e-8;  // metres: banks nearer than this are one line

// Whether two curves are one and the same, over their whole length.
bool sameCurve(const Curve& a, const Curve& b) {
  for (const double f : {0.0, 0.2, 0.5, 0.8, 1.0})
    if (distance(a.atFraction(f), b.atFraction(f)) > kSameLine) return false;
  return true;
}

}  // namespace

std::vector<Retrace> retraces(const Outline& outline) {
  const std::size_t count = outline.edges.size();
  std::vector<double> ends(count);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) ends[k] = sum += outline.edges[k].curve.length();
  std::vector<Retrace> found;
  for (std::size_t k = 0; k < count; ++k) {
    // Walk away from the corner on both sides at once, over the shorter of the two rests each time.
    std::size_t steps = 0, in = k, out = (k + 1) % count;
    Curve bankIn = outline.edges[in].curve.reversed(), bankOut = outline.edges[out].curve;
    double reach = 0;
    while (steps + 1 < count) {
      const double lengthIn = bankIn.length(), lengthOut = bankOut.length();
      const double step = std::min(lengthIn, lengthOut);
      const bool wholeIn = lengthIn - step < kSameLine, wholeOut = lengthOut - step < kSameLine;
      const double cutIn = wholeIn ? 1 : bankIn.parameterAt(step), cutOut = wholeOut ? 1 : bankOut.parameterAt(step);
      if (!sameCurve(bankIn.part(0, cutIn), bankOut.part(0, cutOut))) break;
      reach += step;
      if (wholeIn) {
        in = (in + count - 1) % count;
        bankIn = outline.edges[in].curve.reversed();
        ++steps;
      } else {
        bankIn = bankIn.part(cutIn, 1);
      }
      if (wholeOut) {
        out = (out + 1) % count;
        bankOut = outline.edges[out].curve;
        ++steps;
      } else {
        bankOut = bankOut.part(cutOut, 1);
      }
    }
    if (reach > 0) found.push_back({k, ends[k], reach});
  }
  return found;
}

OpenedOut withoutSlits(const Outline& outline, double miss) {
  OpenedOut open;
  const auto slits = retraces(outline);
  const double whole = outline.length();
  const auto taken = [&](double from, double to) {
    const double middle = (from + to) / 2;
    return std::any_of(slits.begin(), slits.end(), [&](const Retrace& slit) {
      const double away = std::abs(std::remainder(middle - slit.tip, whole));
      return away < slit.reach;
    });
  };
  // Cut each edge where slits end on it, and keep the parts outside.
  std::vector<double> mouths;
  for (const Retrace& slit : slits)
    for (const double s : {slit.tip - slit.reach, slit.tip + slit.reach})
      mouths.push_back(s < 0 ? s + whole : s > whole ? s - whole : s);
  double before = 0;
  for (const Edge& edge : outline.edges) {
    const double own = edge.curve.length();
    std::vector<double> cuts{0, own};
    for (double s : mouths)
      if (s - before > kSameLine && s - before < own - kSameLine) cuts.push_back(s - before);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (cuts[k + 1] - cuts[k] < kSameLine || taken(before + cuts[k], before + cuts[k + 1])) continue;
      const Curve part = edge.curve.part(edge.curve.parameterAt(cuts[k]), edge.curve.parameterAt(cuts[k + 1]));
      const auto points = part.flattened(miss);
      open.ring.insert(open.ring.end(), points.begin(), points.end() - 1);
    }
    before += own;
  }
  for (const Retrace& slit : slits) {
    std::vector<Flat> line{outline.edges[slit.edge].curve.end};
    double left = slit.reach;
    for (std::size_t k = slit.edge; left > kSameLine; k = (k + outline.edges.size() - 1) % outline.edges.size()) {
      const Curve back = outline.edges[k].curve.reversed();
      const double own = back.length();
      const auto points = (own <= left ? back : back.part(0, back.parameterAt(left))).flattened(miss);
      line.insert(line.end(), points.begin() + 1, points.end());
      left -= own;
    }
    std::reverse(line.begin(), line.end());
    open.slits.push_back(std::move(line));
  }
  return open;
}

}  // namespace karinui
