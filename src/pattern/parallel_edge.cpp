#include "parallel_edge.h"

#include <algorithm>
#include <cmath>

#include "karinui/geometry/fit_curve.h"
#include "meetings.h"

namespace karinui {

namespace {

constexpr int kChordsOfParallel = 400;
constexpr double kLedOn = 1;            // metres beyond the ends
constexpr double kFarForBy = 2.5;       // times the measure: farther than that an end does not go along the edge beside
constexpr double kOnArc = 2e-6;         // metres: a place is on the arc
constexpr double kStraightOn = 1e-6;    // metres that a straight part bows
constexpr double kNothingToAdd = 1e-7;  // metres

}  // namespace

ParallelLine::ParallelLine(const Curve& curve, double by) : curve_(curve), by_(by) {
  const auto way = [&](bool atEnd) { return normalized(endTangent(curve, atEnd)); };
  if (curve.kind == Curve::Kind::Line) {
    for (const bool atEnd : {false, true})
      points_.push_back((atEnd ? curve.end : curve.start) + leftOf(way(atEnd)) * by);
  } else {
    for (int k = 0; k <= kChordsOfParallel; ++k) {
      const double t = static_cast<double>(k) / kChordsOfParallel;
      const Flat along = k == 0 ? way(false) : k == kChordsOfParallel ? way(true) : normalized(curve.tangent(t));
      points_.push_back(curve.at(t) + leftOf(along) * by);
    }
  }
  points_.insert(points_.begin(), points_.front() - way(false) * kLedOn);
  points_.push_back(points_.back() + way(true) * kLedOn);
}

std::optional<Flat> ParallelLine::met(const Curve& beside, bool besideEnds) const {
  const Curve from = besideEnds ? beside.reversed() : beside;  // from the corner
  std::vector<Flat> way;
  if (by_ > 0) {
    way = from.flattened(1e-6);
  } else {
    way = {from.start, from.start - normalized(endTangent(from, false)) * (kFarForBy * std::fabs(by_))};
  }
  double gone = 0;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) {
    std::optional<double> first;
    for (std::size_t j = 0; j + 1 < points_.size(); ++j) {
      double on = 0;
      if (const auto t = segmentMeets(way[k], way[k + 1], points_[j], points_[j + 1], on); t && (!first || *t < *first))
        first = t;
    }
    if (first && gone + *first * distance(way[k], way[k + 1]) > kFarForBy * std::fabs(by_)) break;
    if (first) return lerp(way[k], way[k + 1], *first);
    gone += distance(way[k], way[k + 1]);
  }
  return std::nullopt;
}

ParallelLine::Nearest ParallelLine::nearest(Flat place) const {
  Nearest best;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const Flat along = points_[k + 1] - points_[k];
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(place - points_[k], along) / square, 0.0, 1.0) : 0;
    if (const double d = distance(points_[k] + along * share, place); d < least) least = d, best = {k, share};
  }
  return best;
}

Curve ParallelLine::between(Flat from, Flat to) const {
  if (curve_.kind == Curve::Kind::Line) return Curve::line(from, to);
  if (curve_.kind == Curve::Kind::Arc) {  // about the same middle
    const double quarter = std::atan(curve_.bulge), sine = std::sin(2 * quarter);
    const double radius = distance(curve_.start, curve_.end) / 2 / sine;  // > 0: the middle is to the left
    const Flat middle = curve_.start + leftOf(normalized(curve_.tangent(0))) * radius;
    const auto on = [&](Flat p) { return std::fabs(distance(p, middle) - std::fabs(radius - by_)) < kOnArc; };
    if (on(from) && on(to) && (radius > 0) == (radius - by_ > 0))
      return Curve::arc(from, to,
                        std::tan(quarter + (angleFrom(curve_.start - middle, from - middle) * -1 +
                                            angleFrom(curve_.end - middle, to - middle)) /
                                               4));
  }
  const Nearest a = nearest(from), b = nearest(to);
  std::vector<Flat> points{from};
  for (std::size_t k = a.chord + 1; k <= b.chord; ++k)
    if (distance(points.back(), points_[k]) > 1e-5 && distance(points_[k], to) > 1e-5) points.push_back(points_[k]);
  points.push_back(to);
  const auto way = [&](const Nearest& at) {
    const std::size_t last = points_.size() - 2;
    if (at.chord == 0) return normalized(points_[1] - points_[0]);
    if (at.chord == last) return normalized(points_[last + 1] - points_[last]);
    const double t = (static_cast<double>(at.chord - 1) + at.share) / kChordsOfParallel;
    return t <= 0   ? normalized(points_[1] - points_[0])
           : t >= 1 ? normalized(points_[last + 1] - points_[last])
                    : normalized(curve_.tangent(t));
  };
  FitSettings fit;
  fit.straight = 2e-5, fit.tolerance = 5e-5, fit.farthest = 1e-4;
  return Curve::joined(fitEdge(points, fit, way(a), way(b)).curves);
}

Curve endedAt(const Curve& curve, bool atEnd, Flat place) {
  if (!atEnd) return endedAt(curve.reversed(), true, place).reversed();
  if (curve.kind == Curve::Kind::Line) return Curve::line(curve.start, place);
  if (distance(place, curve.end) < kNothingToAdd) {
    Curve same = curve;
    same.end = place;
    return same;
  }
  // On it: what is beyond goes. The nearest place, searched from the end.
  const std::vector<Flat> chords = curve.flattened(1e-6);
  double least = HUGE_VAL, at = 1;
  const auto count = static_cast<double>(chords.size() - 1);
  for (std::size_t k = 0; k + 1 < chords.size(); ++k) {
    const Flat along = chords[k + 1] - chords[k];
    const double share = std::clamp(dot(place - chords[k], along) / std::fmax(dot(along, along), 1e-24), 0.0, 1.0);
    if (const double d = distance(chords[k] + along * share, place); d < least)
      least = d, at = (static_cast<double>(k) + share) / count;
  }
  if (at < 1 && least < 1e-5) {
    double low = std::fmax(0, at - 2 / count), high = std::fmin(1, at + 2 / count);
    for (int round = 0; round < 80; ++round) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(curve.at(a), place) < distance(curve.at(b), place) ? high : low) =
          distance(curve.at(a), place) < distance(curve.at(b), place) ? b : a;
    }
    Curve part = curve.part(0, (low + high) / 2);
    part.end = place;
    return part;
  }
  // Beyond it: straight on. What ends straight already is led on as it is.
  std::vector<Curve> parts = curve.kind == Curve::Kind::Arc ? curve.cubics() : curve.parts();
  const std::vector<Flat> last = parts.back().flattened(1e-7);
  if (bow(last) < kStraightOn) {
    const Flat start = parts.back().start;
    parts.back() = Curve::cubic(start, lerp(start, place, 1.0 / 3), lerp(start, place, 2.0 / 3), place);
  } else {
    parts.push_back(Curve::line(parts.back().end, place));
  }
  return Curve::joined(parts);
}

}  // namespace karinui
