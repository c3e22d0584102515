#include "cut_stretches.h"

#include <algorithm>
#include <cmath>

#include "meetings.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kSnap = 5e-3;        // ends nearer to the outline than this go onto it
constexpr double kWiggle = 2e-4;      // of the line, straightened
constexpr double kSameCut = 1e-6;     // metres
constexpr double kCornerNear = 3e-3;  // metres: nobody wants an edge as short as this

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

// The dart whose two legs these are.
const PaperDart* between(const std::vector<PaperDart>& darts, const EdgePlace& a, const EdgePlace& b) {
  for (const PaperDart& dart : darts)
    if ((a.edge == dart.to && b.edge == dart.back) || (a.edge == dart.back && b.edge == dart.to)) return &dart;
  return nullptr;
}

// The place on the dart's other leg, `edge`, that is sewn to this one.
Meeting acrossDart(const Outline& outline, const Meeting& from, std::size_t edge) {
  const Curve &here = outline.edges[from.on.edge].curve, &there = outline.edges[edge].curve;
  const double share = 1 - here.lengthTo(from.on.t) / here.length();
  Meeting meeting = from;
  meeting.on = {edge, there.parameterAt(share * there.length())};
  meeting.place = there.at(meeting.on.t);
  return meeting;
}

// The corner that is near to a place of the outline; nothing: none is, or the place is on it.
std::optional<EdgePlace> cornerNear(const Outline& outline, const EdgePlace& on) {
  const Curve& curve = outline.edges[on.edge].curve;
  const double before = curve.lengthTo(on.t), behind = curve.length() - before;
  if (std::min(before, behind) > kCornerNear || std::min(before, behind) < kSameCut) return std::nullopt;
  return EdgePlace{before <= behind ? on.edge : (on.edge + 1) % outline.edges.size(), 0};
}

// A line that stays as near to the outline as a corner would be takes a thin strip off.
bool takesStrip(const Outline& outline, const std::vector<Flat>& line) {
  const Ring ring = outline.flattened(1e-5);
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    for (const double t : {0.25, 0.5, 0.75})
      if (distanceToRing(ring, lerp(line[k], line[k + 1], t)) > kCornerNear) return false;
  return true;
}

}  // namespace

Result<std::vector<Stretch>> stretchesOver(const Piece& piece, std::vector<Flat> given,
                                           const std::vector<PaperDart>& darts) {
  for (Flat p : given)
    if (!finite(p) || std::abs(p.u) > 100 || std::abs(p.v) > 100)
      return badInput(say("A place of the line is not a usable number (lengths are metres, within 100 m)."));
  if (given.size() > 5000)
    return badInput(say("The line has {0} {0|place|places}; at most 5000 are taken.", given.size()));
  given.erase(std::unique(given.begin(), given.end(), [](Flat a, Flat b) { return distance(a, b) < kSameCut; }),
              given.end());
  if (given.size() < 2) return badInput(say("A cut needs a line of at least two places."));
  std::vector<Flat> line{given.front()};
  straighten(given, 0, given.size() - 1, line);
  if (const auto where = selfCrossing(line))
    return refused(say("The line crosses itself at {0} mm; draw it without a loop.", inMm(*where)));

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
  std::vector<Stretch> found;
  std::optional<Meeting> begins;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const auto [before, after] = stretches[k];
    if (k > 0) {
      const Meeting &left = all[stretches[k - 1][1]], &back = all[before];
      if (!between(darts, left.on, back.on))
        return refused(say("The line leaves piece {0} and comes back at {1} mm; cut once at a time.", piece.name,
                           inMm(back.place)));
      begins = acrossDart(piece.outline, left, back.on.edge);
      begins->at = back.at;
    } else if (before >= 0) {
      begins = all[before];
    }
    if (!begins && after < 0)
      return refused(
          say("The line does not reach the outline of piece {0}: its nearer end is {1} mm inside; begin or end it on "
              "an edge.",
              piece.name, inMm(nearest)));
    Stretch stretch;
    const double from = begins ? begins->at : 0, to = after < 0 ? whole : all[after].at;
    stretch.line.push_back(begins ? begins->place : line.front());
    for (std::size_t p = 0; p < line.size(); ++p)
      if (static_cast<double>(p) > from + 1e-9 && static_cast<double>(p) < to - 1e-9) stretch.line.push_back(line[p]);
    stretch.line.push_back(after < 0 ? line.back() : all[after].place);
    if (begins) stretch.start = begins->on;
    if (after >= 0) stretch.end = all[after].on;
    found.push_back(std::move(stretch));
  }
  return found;
}

bool leadToCorners(const Outline& outline, std::vector<Stretch>& stretches) {
  if (stretches.size() == 1 && takesStrip(outline, stretches.front().line)) return false;
  Stretch &first = stretches.front(), &last = stretches.back();
  const auto start = first.start ? cornerNear(outline, *first.start) : std::nullopt;
  const auto end = last.end ? cornerNear(outline, *last.end) : std::nullopt;
  if (start && end && start->edge == end->edge) return false;
  if (start) first.start = start, first.line.front() = outline.edges[start->edge].curve.start;
  if (end) last.end = end, last.line.back() = outline.edges[end->edge].curve.start;
  return start || end;
}

}  // namespace karinui
