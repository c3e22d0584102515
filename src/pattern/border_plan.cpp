#include "border_plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "karinui/pattern/pleats.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kSameStation = 1e-7;  // metres: stations nearer than this are one
// Metres: corners nearer than this are one in the lattice, whose cells would else be slivers beside an edge of a
// fraction of a millimetre. A hair less than 1 mm, so that edges of that length keep both their corners.
constexpr double kOneCorner = 1e-3 - 1e-8;

constexpr double kOnLine = 1e-4;  // metres: a line that ends as near to another ends on it
constexpr std::size_t kMostStations = 1'000'000;
constexpr double kOneEnd = 2e-5;  // metres: so near to the end of a line a seam ends at it

// The part of an inner line that lies on the cloth: an end that has come to lie beyond the outline, or in a hole, as
// when the edge it ended on was taken in, is where the line meets the border. As it is where no part of it does.
Curve onCloth(const Piece& piece, const Curve& curve) {
  constexpr int kLooks = 400;
  const Ring ring = piece.outline.flattened(1e-6);
  std::vector<Ring> holes;
  for (const Outline& hole : piece.holes) holes.push_back(hole.flattened(1e-6));
  const auto beyond = [&](double t) {  // farther than what the border takes as its own
    const Flat place = curve.at(t);
    if (!contains(ring, place) && distanceToRing(ring, place) > kOnLine) return true;
    return std::any_of(holes.begin(), holes.end(), [&](const Ring& hole) {
      return contains(hole, place) && distanceToRing(hole, place) > kOnLine;
    });
  };
  const auto inside = [&](double t) {
    const Flat place = curve.at(t);
    return contains(ring, place) &&
           std::none_of(holes.begin(), holes.end(), [&](const Ring& hole) { return contains(hole, place); });
  };
  double ends[2] = {0, 1};
  for (const int end : {0, 1}) {
    if (!beyond(end)) continue;
    int look = 1;
    const auto at = [&](int k) {
      return end == 0 ? static_cast<double>(k) / kLooks : 1 - static_cast<double>(k) / kLooks;
    };
    while (look < kLooks && !inside(at(look))) ++look;
    if (look == kLooks) return curve;
    double out = at(look - 1), in = at(look);
    for (int half = 0; half < 50; ++half) (inside((out + in) / 2) ? in : out) = (out + in) / 2;
    ends[end] = in;
  }
  if (ends[0] == 0 && ends[1] == 1) return curve;
  return ends[0] < ends[1] ? curve.part(ends[0], ends[1]) : curve;
}

// Puts stations at the corners of a track, one where several are as near as that.
void placeCorners(Track& track) {
  const std::size_t n = track.edgeStart.size() - 1;
  track.corner = track.edgeStart;
  track.station = {0};
  for (std::size_t k = 1; k < n; ++k) {
    if (track.edgeStart[k] - track.station.back() < kOneCorner)
      track.corner[k] = track.station.back();
    else
      track.station.push_back(track.edgeStart[k]);
  }
  const double last = track.station.back();
  if (track.station.size() == 1 || track.whole() - last >= kOneCorner) return;
  track.station.pop_back();
  std::replace(track.corner.begin(), track.corner.end(), last, track.whole());
}

// Pairs of stops of two walks, in order, the ends among them; nearest pairs are made first.
std::vector<std::array<std::size_t, 2>> matched(const Walk& a, const Walk& b, double snap) {
  struct Candidate {
    double away;
    std::size_t i, j;
  };
  const double mean = (a.length() + b.length()) / 2;
  std::vector<Candidate> candidates;
  for (std::size_t i = 1; i + 1 < a.stops.size(); ++i)
    for (std::size_t j = 1; j + 1 < b.stops.size(); ++j) {
      const double away = std::abs(a.stops[i].at / a.length() - b.stops[j].at / b.length()) * mean;
      if (away <= snap) candidates.push_back({away, i, j});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.away < y.away; });
  std::vector<std::array<std::size_t, 2>> pairs{{0, 0}, {a.stops.size() - 1, b.stops.size() - 1}};
  for (const Candidate& c : candidates) {
    const auto after = std::upper_bound(pairs.begin(), pairs.end(), std::array{c.i, c.j});
    const auto& before = *(after - 1);
    if (before[0] < c.i && before[1] < c.j && c.i < (*after)[0] && c.j < (*after)[1]) pairs.insert(after, {c.i, c.j});
  }
  return pairs;
}

// The place on a side after walking `at`: the leg and the length on its track.
std::array<double, 2> placeOn(const std::vector<Leg>& side, bool backwards, double at) {
  double whole = 0;
  for (const Leg& leg : side) whole += leg.to - leg.from;
  double left = backwards ? whole - at : at;
  for (const Leg& leg : side) {
    if (left <= leg.to - leg.from || &leg == &side.back())
      return {static_cast<double>(leg.track), leg.from + std::clamp(left, 0.0, leg.to - leg.from)};
    left -= leg.to - leg.from;
  }
  return {};
}

// A class of stretches whose counts hang together: each is the class's number doubled `times`.
struct Classes {
  std::vector<std::size_t> parent;
  std::vector<int> times;  // relative to the parent
  explicit Classes(std::size_t size) : parent(size), times(size, 0) {
    for (std::size_t k = 0; k < size; ++k) parent[k] = k;
  }
  std::pair<std::size_t, int> find(std::size_t k) const {
    int sum = 0;
    while (parent[k] != k) {
      sum += times[k];
      k = parent[k];
    }
    return {k, sum};
  }
  // a = b doubled `more` times. False: they already stand in another ratio.
  bool join(std::size_t a, std::size_t b, int more) {
    const auto [rootA, timesA] = find(a);
    const auto [rootB, timesB] = find(b);
    if (rootA == rootB) return timesA == timesB + more;
    // The lower index is the root, so that the outcome does not depend on the order of seams.
    if (rootA < rootB) {
      parent[rootB] = rootA;
      times[rootB] = timesA - more - timesB;
    } else {
      parent[rootA] = rootB;
      times[rootA] = timesB + more - timesA;
    }
    return true;
  }
};

double turning(const Curve& curve) {
  if (curve.kind == Curve::Kind::Line) return 0;
  if (curve.kind == Curve::Kind::Arc) return std::abs(4 * std::atan(curve.bulge));
  double sum = 0;
  constexpr int kLooks = 16;
  for (const Curve& cubic : curve.parts()) {
    Flat before = cubic.tangent(1e-6);
    for (int k = 1; k <= kLooks; ++k) {
      const Flat now = cubic.tangent(k == kLooks ? 1 - 1e-6 : k / double{kLooks});
      sum += std::abs(angleFrom(before, now));
      before = now;
    }
  }
  return sum;
}

}  // namespace

Result<BorderPlan> BorderPlan::plan(const Pattern& pattern, double spacing) {
  BorderPlan made;
  made.spacing_ = spacing;
  if (Done done = made.gatherTracks(pattern); !done) return done.error();
  if (Done done = made.gatherSeams(pattern); !done) return done.error();
  made.addNotches(pattern);
  if (Done done = made.carryAll(); !done) return done.error();
  if (Done done = made.count(); !done) return done.error();
  return made;
}

Done BorderPlan::gatherTracks(const Pattern& pattern) {
  for (const auto& [id, piece] : pattern.pieces) {
    for (std::size_t hole = 0; hole <= piece->holes.size(); ++hole) {
      Track track{id, hole, hole == 0 ? &piece->outline : &piece->holes[hole - 1], {0}, {}, {}};
      if (track.outline->edges.empty()) return badInput(say("Piece {0} has no outline.", piece->name));
      for (const Edge& edge : track.outline->edges) {
        const double own = edge.curve.length();
        if (!(own > kSameStation) || !std::isfinite(own))
          return badInput(say("Edge {0} of piece {1} has no length.", edge.name, piece->name));
        track.edgeStart.push_back(track.edgeStart.back() + own);
      }
      placeCorners(track);
      trackOf_[{id, hole}] = tracks_.size();
      tracks_.push_back(std::move(track));
    }
    gatherLines(pattern, *piece);
  }
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    if (tracks_[t].open()) standOnTracks(t);
  // The banks of a slit are divided alike, place by place.
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (tracks_[t].open()) continue;
    for (const Retrace& slit : retraces(*tracks_[t].outline)) {
      const double whole = tracks_[t].whole();
      const auto wrapped = [&](double from, double to) {
        if (from < -kSameStation) return std::vector<Leg>{{t, from + whole, whole}, {t, 0, to}};
        if (to > whole + kSameStation && from < whole - kSameStation)
          return std::vector<Leg>{{t, from, whole}, {t, 0, to - whole}};
        if (to > whole + kSameStation)
          return std::vector<Leg>{{t, from - whole < kSameStation ? 0 : from - whole, to - whole}};
        return std::vector<Leg>{{t, std::max(from, 0.0), std::min(to, whole)}};
      };
      Joined banks{{},
                   wrapped(slit.tip - slit.reach, slit.tip),
                   wrapped(slit.tip, slit.tip + slit.reach),
                   true,
                   0,
                   10 * kSameStation};
      for (const Leg& leg : {banks.a.front(), banks.b.back()}) {
        addStation(t, leg.from, kSameStation);
        addStation(t, leg.to, kSameStation);
      }
      joined_.push_back(std::move(banks));
    }
  }
  return {};
}

void BorderPlan::gatherLines(const Pattern& pattern, const Piece& piece) {
  const std::set<std::string> names = linesOfLattice(pattern, piece);
  std::size_t next = piece.holes.size();
  for (const InternalLine& line : piece.lines) {
    const Curve* curve = names.contains(line.name) ? findCurve(piece, line.name) : nullptr;
    if (!curve || curve != &line.curves.front() || !(curve->length() > kOneCorner)) continue;
    const Curve laid = onCloth(piece, *curve);
    const double whole = laid.length();
    Track track{piece.id, ++next, nullptr, {0, whole}, {0, whole}, {0, whole}};
    track.line = std::make_shared<const Outline>(Outline{{{line.name, laid}}});
    track.outline = track.line.get();
    trackOf_[{piece.id, next}] = tracks_.size();
    tracks_.push_back(std::move(track));
  }
}

// Where a line begins or ends on the outline, or on another line, that has a station there.
void BorderPlan::standOnTracks(std::size_t line) {
  const Curve curve = tracks_[line].outline->edges.front().curve;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (t == line || tracks_[t].piece != tracks_[line].piece) continue;
    for (const Flat end : {curve.start, curve.end})
      for (std::size_t k = 0; k < tracks_[t].outline->edges.size(); ++k) {
        const Curve& along = tracks_[t].outline->edges[k].curve;
        const std::vector<Flat> chords = along.flattened(1e-5);
        double walked = 0, nearest = kOnLine, at = 0;
        for (std::size_t n = 0; n + 1 < chords.size(); ++n) {
          const double own = distance(chords[n], chords[n + 1]);
          const double share = std::clamp(dot(end - chords[n], chords[n + 1] - chords[n]) / (own * own), 0.0, 1.0);
          if (const double away = distance(lerp(chords[n], chords[n + 1], share), end); away < nearest)
            nearest = away, at = walked + share * own;
          walked += own;
        }
        if (nearest < kOnLine && addStation(t, tracks_[t].edgeStart[k] + at, kOnLine))
          lineEnds_.emplace_back(t, tracks_[t].edgeStart[k] + at);
      }
  }
}

Result<std::vector<Leg>> BorderPlan::legs(const Pattern& pattern, const Seam& seam,
                                          const std::vector<EdgeSpan>& side) const {
  std::vector<Leg> run;
  for (const EdgeSpan& span : side) {
    const auto piece = pattern.pieces.find(span.piece);
    if (piece == pattern.pieces.end()) return notFound(say("Seam {0} speaks of a piece that is not there.", seam.name));
    bool found = false;
    for (std::size_t hole = 0; trackOf_.contains({span.piece, hole}) && !found; ++hole) {
      const std::size_t t = trackOf_.at({span.piece, hole});
      const auto k = tracks_[t].outline->find(span.edge);
      if (!k) continue;
      found = true;
      if (!(span.from >= 0 && span.from < span.to && span.to <= 1))
        return badInput(say("Seam {0} takes edge {1} from {2} to {3}; it must run forward within 0 to 1.", seam.name,
                            span.edge, span.from, span.to));
      const double start = tracks_[t].edgeStart[*k], end = tracks_[t].edgeStart[*k + 1];
      const double first = tracks_[t].corner[*k], last = tracks_[t].corner[*k + 1];
      if (first == last) continue;  // too short for the lattice: what is sewn beside it meets there
      const Leg leg{t, span.from == 0 ? first : start + span.from * (end - start),
                    span.to == 1 ? last : start + span.to * (end - start)};
      if (leg.to - leg.from < 1e-4)
        return badInput(say("Seam {0} takes less than 0.1 mm of edge {1}; sew a longer part.", seam.name, span.edge));
      run.push_back(leg);
    }
    if (!found)
      return notFound(say("Piece {0} has no edge {1} for seam {2}.", piece->second->name, span.edge, seam.name));
  }
  return run;
}

Done BorderPlan::gatherSeams(const Pattern& pattern) {
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.a.empty() || seam.b.empty()) return badInput(say("Seam {0} has an empty side.", seam.name));
    auto a = legs(pattern, seam, seam.a), b = legs(pattern, seam, seam.b);
    if (!a) return a.error();
    if (!b) return b.error();
    if (a->empty() || b->empty()) continue;
    for (auto* side : {&*a, &*b})
      for (Leg& leg : *side) {
        // What is sewn up to the end of a line ends there, though that was found along chords: stations that lie by
        // micrometres beside each other would be carried across the seams to ever more of them.
        for (const auto& [track, at] : lineEnds_)
          for (double* end : {&leg.from, &leg.to})
            if (track == leg.track && std::fabs(*end - at) < kOneEnd) *end = at;
        addStation(leg.track, leg.from, kSameStation);
        addStation(leg.track, leg.to, kSameStation);
      }
    const int doubled = seam.tie != Seam::Tie::TwoToOne                     ? 0
                        : length(pattern, seam.a) > length(pattern, seam.b) ? 1
                                                                            : -1;
    seamName_[id] = seam.name;
    joined_.push_back({id, std::move(*a), std::move(*b), seam.reversed, doubled, 0.35 * spacing_});
  }
  return {};
}

void BorderPlan::addNotches(const Pattern& pattern) {
  for (const auto& [id, piece] : pattern.pieces)
    for (const Mark& mark : piece->marks)
      for (std::size_t hole = 0; hole <= piece->holes.size() && !mark.edge.empty(); ++hole) {
        const std::size_t t = trackOf_.at({id, hole});
        const auto k = tracks_[t].outline->find(mark.edge);
        if (!k || !(mark.fraction >= 0 && mark.fraction <= 1)) continue;
        addStation(t, std::lerp(tracks_[t].edgeStart[*k], tracks_[t].edgeStart[*k + 1], mark.fraction), spacing_ / 4);
      }
}

bool BorderPlan::addStation(std::size_t track, double at, double apart) {
  auto& stations = tracks_[track].station;
  const double whole = tracks_[track].whole();
  const auto after = std::lower_bound(stations.begin(), stations.end(), at);
  const double next = after == stations.end() ? whole + stations.front() : *after;
  const double before = after == stations.begin() ? stations.back() - whole : *(after - 1);
  if (next - at <= apart || at - before <= apart) return false;
  stations.insert(after, at);
  return true;
}

Walk BorderPlan::walk(const std::vector<Leg>& side, bool backwards) const {
  Walk forward;
  double walked = 0;
  for (const Leg& leg : side) {
    const auto& stations = tracks_[leg.track].station;
    const std::size_t count = stations.size();
    // Stations of the leg, both ends included; the one at the very end may be station 0.
    auto k = static_cast<std::size_t>(std::lower_bound(stations.begin(), stations.end(), leg.from - kSameStation) -
                                      stations.begin());
    bool first = true;
    for (; k < count || !tracks_[leg.track].open(); ++k) {
      const double at = k < count ? stations[k] : tracks_[leg.track].whole() + stations[k - count];
      if (at > leg.to + kSameStation) break;
      const std::array<std::size_t, 2> station{leg.track, k % count};
      if (first && !forward.stops.empty()) {
        auto& shared = forward.stops.back().stations;
        if (shared.back() != station) shared.push_back(station);
      } else {
        if (!forward.stops.empty()) forward.steps.push_back({leg.track, (k + count - 1) % count, backwards});
        forward.stops.push_back({walked + at - leg.from, {station}});
      }
      first = false;
    }
    walked += leg.to - leg.from;
  }
  if (!backwards) return forward;
  Walk back;
  for (std::size_t k = forward.stops.size(); k-- > 0;) {
    auto stop = forward.stops[k];
    stop.at = walked - stop.at;
    std::reverse(stop.stations.begin(), stop.stations.end());
    back.stops.push_back(std::move(stop));
  }
  back.steps.assign(forward.steps.rbegin(), forward.steps.rend());
  return back;
}

bool BorderPlan::carryAcross(const Joined& joined) {
  const Walk a = walk(joined.a, false), b = walk(joined.b, joined.reversed);
  const auto pairs = matched(a, b, joined.snap);
  bool changed = false;
  std::vector<std::array<double, 2>> wanted;
  for (std::size_t k = 0; k + 1 < pairs.size(); ++k) {
    const auto [i0, j0] = pairs[k];
    const auto [i1, j1] = pairs[k + 1];
    const double a0 = a.stops[i0].at, a1 = a.stops[i1].at, b0 = b.stops[j0].at, b1 = b.stops[j1].at;
    for (std::size_t i = i0 + 1; i < i1; ++i)
      wanted.push_back(placeOn(joined.b, joined.reversed, b0 + (a.stops[i].at - a0) / (a1 - a0) * (b1 - b0)));
    for (std::size_t j = j0 + 1; j < j1; ++j)
      wanted.push_back(placeOn(joined.a, false, a0 + (b.stops[j].at - b0) / (b1 - b0) * (a1 - a0)));
  }
  for (const auto& [track, at] : wanted) changed |= addStation(static_cast<std::size_t>(track), at, kSameStation);
  return changed;
}

Done BorderPlan::carryAll() {
  // Every round only adds stations, and none nearer to a free one than the seam's snap: in practice a few rounds do.
  for (int round = 0; round < 24; ++round) {
    bool changed = false;
    for (const Joined& joined : joined_) changed |= carryAcross(joined);
    if (!changed) return {};
    std::size_t stations = 0;
    for (const Track& track : tracks_) stations += track.station.size();
    if (stations > kMostStations) break;  // ever more of them: they never meet
  }
  const auto last = std::find_if(joined_.rbegin(), joined_.rend(), [](const Joined& j) { return bool{j.seam}; });
  return refused(say("The seams around {0} overlap so that their points never meet; sew them edge to edge.",
                     last == joined_.rend() ? std::string() : seamName_.at(last->seam)));
}

Done BorderPlan::count() {
  offset_.clear();
  std::size_t total = 0;
  for (const Track& track : tracks_) {
    offset_.push_back(total);
    total += track.station.size();
  }
  Classes classes(total);
  for (const Joined& joined : joined_) {
    const Walk a = walk(joined.a, false), b = walk(joined.b, joined.reversed);
    if (a.steps.size() != b.steps.size())
      return refused(
          say("The sides of seam {0} cannot be divided alike; sew them edge to edge.", seamName_[joined.seam]));
    for (std::size_t k = 0; k < a.steps.size(); ++k)
      if (!classes.join(offset_[a.steps[k].track] + a.steps[k].stretch, offset_[b.steps[k].track] + b.steps[k].stretch,
                        joined.doubled))
        return refused(
            say("Seam {0} is gathered two to one, but its sides are also sewn otherwise; make all of them one to one.",
                seamName_[joined.seam]));
  }
  root_.resize(total);
  count_.assign(total, 1);
  if (finer_.size() != total) finer_.assign(total, 0);
  std::vector<int> times(total), least(total, 0), members(total, 0);
  for (std::size_t k = 0; k < total; ++k) {
    std::tie(root_[k], times[k]) = classes.find(k);
    least[root_[k]] = std::min(least[root_[k]], times[k]);
  }
  std::vector<double> wish(total, 0), must(total, 1);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    std::size_t edge = 0;
    for (std::size_t k = 0; k < track.station.size(); ++k) {
      const double from = track.station[k], to = k + 1 < track.station.size() ? track.station[k + 1] : track.whole();
      while (edge + 1 < track.outline->edges.size() && track.edgeStart[edge + 1] <= from + kSameStation / 2) ++edge;
      double bend = 0;  // of all edges in the stretch: short ones, then the one they lead to
      for (std::size_t e = edge;
           e == edge || (e < track.outline->edges.size() && track.edgeStart[e] < to - kSameStation); ++e) {
        const Curve& curve = track.outline->edges[e].curve;
        const double t0 = curve.parameterAt(std::max(from - track.edgeStart[e], 0.0)),
                     t1 = curve.parameterAt(to - track.edgeStart[e]);
        bend += t0 < t1 ? turning(curve.part(t0, t1)) : 0;
      }
      const std::size_t n = offset_[t] + k, root = root_[n];
      const double scale = std::exp2(least[root] - times[n]);
      wish[root] += scale * (to - from) / spacing_;
      must[root] = std::max(must[root], scale * std::ceil(bend / 1.05 - 1e-9));  // at most 60 degrees a segment
      ++members[root];
    }
  }
  for (std::size_t n = 0; n < total; ++n) {
    const std::size_t root = root_[n];
    const double base = std::max({1.0, std::round(wish[root] / members[root]), std::ceil(must[root])});
    count_[n] = static_cast<std::size_t>(base * std::exp2(times[n] - least[root] + finer_[root]));
  }
  return {};
}

bool BorderPlan::refine(std::size_t track, std::size_t stretch) {
  const std::size_t root = root_[offset_[track] + stretch];
  if (finer_[root] >= 6) return false;
  ++finer_[root];
  for (std::size_t n = 0; n < root_.size(); ++n)
    if (root_[n] == root) count_[n] *= 2;
  return true;
}

}  // namespace karinui
