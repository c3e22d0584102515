#include "folded_paper.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kUnder = 0.5;  // layers a fold begins above what lies beneath it

}  // namespace

// Like shingles: the cloth between two folds is one strip, from under the fold before to the next fold, and rises
// evenly from its inner end, so that two strips lie two layers apart everywhere and what joins them lies between.
FoldedPlace FoldedPaper::shingled(Flat place) const {
  const std::size_t n = folds.size();
  const double sign = folds.front().toStart ? -1 : 1;  // walked towards where the folds are turned
  const auto fold = [&](std::size_t j) { return sign * folds[sign > 0 ? j : n - 1 - j].at; };
  double apart = HUGE_VAL;
  for (std::size_t j = 1; j < n; ++j) apart = std::min(apart, fold(j) - fold(j - 1));
  const double rise = 2 / apart;
  const auto strip = [&](std::size_t m, double x) {
    if (m == 0 && x < fold(0) - depth) return 2 * std::clamp(1 + (x - fold(0) + depth) / (3 * apart), 0.0, 1.0);
    if (m == n && x > fold(n - 1)) return rise * depth * std::clamp(1 - (x - fold(n - 1)) / (3 * apart), 0.0, 1.0);
    return rise * (x - (m > 0 ? fold(m - 1) : fold(0) - apart) + depth);
  };
  const double at = dot(place, across);
  std::size_t k = 0;
  while (k < n && at >= folds[k].strip + 2 * depth) ++k;
  const double before = 2 * depth * static_cast<double>(k);
  const std::size_t j = sign > 0 ? k : n - 1 - k;  // of the fold
  if (k == n || at < folds[k].strip)
    return {place - across * before, strip(sign > 0 ? k : n - k, sign * (at - before))};
  const double in = at - folds[k].strip;
  const bool toStart = folds[k].toStart;
  if (toStart != (in >= depth)) {
    const double by = toStart ? before : before + 2 * depth;
    return {place - across * by, strip(j + 1, sign * (at - by))};
  }
  const double flat = toStart ? folds[k].at + 2 * depth - in : folds[k].at - in, x = sign * flat;
  return {place + across * (flat - at), strip(j + 1, x) + kUnder + (x - fold(j) + depth) / depth};
}

// On a fold, where one layer becomes the next, midway between both.
FoldedPlace FoldedPaper::folded(Flat place) const {
  const double at = dot(place, across);
  for (const Fold& fold : folds)
    for (const double line : {0.0, depth, 2 * depth}) {
      if (std::abs(at - fold.strip - line) >= kOnFold) continue;
      const Flat step = across * (2 * kOnFold), in = across * (fold.toStart ? -kShort : kShort);
      FoldedPlace on = layered(place);
      on.lifted = (layered(place - step).lifted + layered(place + step).lifted) / 2;
      if (line == depth)
        on.clear = in;
      else if ((line > 0) == fold.toStart)  // the fold itself, and not where it comes to lie
        on.clear = -in;
      return on;
    }
  return layered(place);
}

FoldedPlace FoldedPaper::layered(Flat place) const {
  if (overlapping) return shingled(place);
  const double at = dot(place, across);
  double before = 0;
  for (const Fold& fold : folds) {
    if (at < fold.strip) break;
    if (at >= fold.strip + 2 * depth) {
      before += 2 * depth;
      continue;
    }
    const double in = at - fold.strip;
    const bool mirror = fold.toStart == (in >= depth);
    if (!mirror) return {place - across * (fold.toStart ? before : before + 2 * depth), 0};
    const double flat = fold.toStart ? fold.at + 2 * depth - in : fold.at - in;
    return {place + across * (flat - at), 1};
  }
  const Flat flat = place - across * before;
  double lifted = 0;
  for (const Fold& fold : folds) {
    const double from = (fold.toStart ? 1 : -1) * (at - before - fold.at);  // from the fold
    if (from < 0) continue;
    const double past = std::max(0.0, from - depth - kPasses) / kPasses;
    lifted = std::max(lifted, 2 - 2 * past);
  }
  return {flat, lifted};
}

}  // namespace karinui
