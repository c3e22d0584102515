#include "karinui/pattern/grading.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/graded_places.h"

namespace karinui {

namespace {

constexpr double kSameShare = 1e-9;       // of an edge's length
constexpr double kNearJoint = 0.002;      // of an edge's length: a joint this near serves for a graded place
constexpr std::size_t kMostPlaces = 200;  // of one edge
constexpr double kFollows = 3e-6;         // metres a cubic may miss what it is graded to
constexpr double kShortestPart = 2e-3;    // metres: shorter cubics are not parted for that

// How far the places of one edge go in one size.
struct EdgeDifference {
  std::vector<double> s;  // metres along the edge, ascending; the first is 0, the last its length
  std::vector<Flat> by;

  bool carried() const {  // the edge goes as a whole
    return std::all_of(by.begin(), by.end(), [&](Flat b) { return b == by.front(); });
  }
  // The slope at a graded place: of the parabola through it and its neighbours (three-point differences, as of an Akima
  // or Catmull-Rom curve on uneven steps).
  Flat slopeAt(std::size_t i) const {
    const auto chord = [&](std::size_t k) { return (by[k + 1] - by[k]) * (1 / (s[k + 1] - s[k])); };
    const std::size_t last = s.size() - 1;
    if (last == 1) return chord(0);
    if (i == 0) return 2 * chord(0) - slopeAt(1);
    if (i == last) return 2 * chord(last - 1) - slopeAt(last - 1);
    const double before = s[i] - s[i - 1], after = s[i + 1] - s[i];
    return (chord(i - 1) * after + chord(i) * before) * (1 / (before + after));
  }
  struct There {
    Flat by, slope;  // slope: per metre along the edge
  };
  // Between graded places the cubic with their values and slopes (Hermite).
  There operator()(double at) const {
    const std::size_t last = s.size() - 1;
    if (at <= s.front()) return {by.front(), slopeAt(0)};
    if (at >= s.back()) return {by.back(), slopeAt(last)};
    const auto k = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin()) - 1;
    const double h = s[k + 1] - s[k], t = (at - s[k]) / h;
    const Flat a = by[k], b = by[k + 1], ma = slopeAt(k) * h, mb = slopeAt(k + 1) * h;
    const double t2 = t * t, t3 = t2 * t;
    return {
        a * (2 * t3 - 3 * t2 + 1) + ma * (t3 - 2 * t2 + t) + b * (3 * t2 - 2 * t3) + mb * (t3 - t2),
        (a * (6 * t2 - 6 * t) + ma * (3 * t2 - 4 * t + 1) + b * (6 * t - 6 * t2) + mb * (3 * t2 - 2 * t)) * (1 / h)};
  }
};

// The graded places of an outline by the way along it, and what its corners come to.
class OutlineDifference {
 public:
  OutlineDifference(const Outline& outline, const GradePoints& points, std::size_t size)
      : edges_(outline.edges.size()) {
    const std::size_t n = outline.edges.size();
    std::vector<double> start(n + 1, 0);
    for (std::size_t k = 0; k < n; ++k) start[k + 1] = start[k] + outline.edges[k].curve.length();
    std::vector<std::pair<double, Flat>> all;  // on the way round
    for (std::size_t k = 0; k < n; ++k)
      for (const GradePoint& point : points)
        if (point.edge == outline.edges[k].name && size < point.by.size())
          all.emplace_back(start[k] + point.at * (start[k + 1] - start[k]), point.by[size]);
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const double round = start[n];
    const auto there = [&](double s) -> Flat {
      if (all.empty()) return {};
      const auto after =
          std::lower_bound(all.begin(), all.end(), s, [](const auto& p, double x) { return p.first < x; });
      const auto next = after == all.end() ? std::pair(all[0].first + round, all[0].second) : *after;
      if (next.first - s < kSameShare * round) return next.second;
      const auto last =
          after == all.begin() ? std::pair(all.back().first - round, all.back().second) : *std::prev(after);
      return lerp(last.second, next.second, (s - last.first) / (next.first - last.first));
    };
    std::vector<Flat> corner;
    for (std::size_t k = 0; k < n; ++k) corner.push_back(there(start[k]));
    for (std::size_t k = 0; k < n; ++k) {
      EdgeDifference& edge = edges_[k];
      const double length = start[k + 1] - start[k];
      edge.s = {0}, edge.by = {corner[k]};
      for (const auto& [s, by] : all)
        if (s - start[k] > 1e-6 * length && start[k + 1] - s > 1e-6 * length && s - start[k] > edge.s.back())
          edge.s.push_back(s - start[k]), edge.by.push_back(by);
      edge.s.push_back(length), edge.by.push_back(corner[(k + 1) % n]);
    }
  }
  const EdgeDifference& edge(std::size_t k) const { return edges_[k]; }

 private:
  std::vector<EdgeDifference> edges_;
};

// The shares of its length at which a curve has joints.
std::vector<double> jointsOf(const Curve& curve) {
  std::vector<double> shares;
  double s = 0;
  for (const Curve& part : curve.parts()) shares.push_back(s += part.length());
  const double whole = shares.back();
  shares.pop_back();
  for (double& share : shares) share /= whole;
  return shares;
}

// The curve in cubics, with joints at these shares of its length (ascending) too, but where one is near.
std::vector<Curve> cubicsBetween(const Curve& curve, std::span<const double> shares) {
  const std::vector<double> joints = jointsOf(curve);
  const double whole = curve.length();
  std::vector<Curve> cubics;
  double begun = 0, last = -1;
  auto share = shares.begin();
  for (const Curve& part : curve.parts()) {
    const double size = part.length();
    double from = 0;
    const auto upTo = [&](double to) {
      const std::vector<Curve> more = part.part(from, to).cubics();
      cubics.insert(cubics.end(), more.begin(), more.end());
      from = to;
    };
    for (; share != shares.end() && *share * whole < begun + size; ++share) {
      const auto near = [&](double joint) { return std::abs(joint - *share) < kNearJoint; };
      if (near(last) || std::any_of(joints.begin(), joints.end(), near)) continue;
      const double t = part.parameterAt(*share * whole - begun);
      if (t > from && t < 1) upTo(t);
      last = *share;
    }
    upTo(1);
    begun += size;
  }
  return cubics;
}

// The same curve with joints at its graded places, and as many more as it takes that a cubic can follow: p(t) + d(s(t))
// is one as far as s(t) is the cubic with its own ends' speeds.
Curve refined(Curve curve, const EdgeDifference& difference) {
  const bool straight = curve.kind == Curve::Kind::Line && difference.s.size() == 2;
  if (straight || difference.carried()) return curve;
  std::vector<double> shares;
  for (std::size_t i = 1; i + 1 < difference.s.size(); ++i) shares.push_back(difference.s[i] / difference.s.back());
  std::vector<Curve> parts;
  double s = 0;
  const double scale = difference.s.back() / curve.length();
  for (const Curve& part : cubicsBetween(curve, shares)) {
    const double size = part.length();
    const Flat a = difference(s * scale).slope, b = difference((s + size) * scale).slope;
    std::vector<Curve> todo{part};
    while (!todo.empty()) {
      const Curve one = todo.back();
      todo.pop_back();
      const double long_ = one.length();
      const double off = one.lengthTo(0.5) - long_ / 2 - (length(one.tangent(0)) - length(one.tangent(1))) / 8;
      if (std::max(length(a), length(b)) * std::abs(off) > kFollows && long_ > kShortestPart)
        todo.push_back(one.part(0.5, 1)), todo.push_back(one.part(0, 0.5));
      else
        parts.push_back(one);
    }
    s += size;
  }
  Curve out = Curve::joined(parts);
  out.start = curve.start, out.end = curve.end;
  return out;
}

// A curve whose joints go as told. The controls beside them are carried so that what was smooth stays smooth: a curve
// p(s) becomes p(s) + d(s), and its direction p' + d'.
Curve differed(const Curve& curve, const EdgeDifference& difference) {
  Curve out = curve;
  out.start = curve.start + difference.by.front(), out.end = curve.end + difference.by.back();
  if (curve.kind != Curve::Kind::Cubic) return out;
  if (difference.carried()) {
    const Flat by = difference.by.front();
    out.control1 = curve.control1 + by, out.control2 = curve.control2 + by;
    for (Flat& p : out.between) p += by;
    return out;
  }
  const auto control = [](Flat joint, Flat at, const EdgeDifference::There& there, double side) {
    return at + there.by + there.slope * (side * distance(joint, at));
  };
  const std::vector<Curve> parts = curve.parts();
  double s = 0;
  out.control1 = control(curve.start, curve.control1, difference(0), 1);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    s += parts[k].length();
    const auto there = difference(s);
    out.between[3 * k] = control(parts[k].end, parts[k].control2, there, -1);
    out.between[3 * k + 1] = parts[k].end + there.by;
    out.between[3 * k + 2] = control(parts[k].end, parts[k + 1].control1, there, 1);
  }
  out.control2 = control(curve.end, curve.control2, difference(difference.s.back()), -1);
  return out;
}

Outline refined(Outline outline, const GradePoints& points, std::size_t size) {
  const OutlineDifference difference(outline, points, size);
  for (std::size_t k = 0; k < outline.edges.size(); ++k)
    outline.edges[k].curve = refined(std::move(outline.edges[k].curve), difference.edge(k));
  return outline;
}

Outline differed(const Outline& outline, const GradePoints& points, std::size_t size) {
  const OutlineDifference difference(outline, points, size);
  Outline out = outline;
  for (std::size_t k = 0; k < out.edges.size(); ++k)
    out.edges[k].curve = differed(out.edges[k].curve, difference.edge(k));
  return out;
}

GradePoints wayOf(const GradePoints& points, std::size_t from, std::size_t to) {
  GradePoints way;
  for (const GradePoint& point : points) way.push_back({point.edge, point.at, {point.by[to] - point.by[from]}});
  return way;
}

double round7(double metres) { return std::round(metres * 1e7) / 1e7; }
Flat round7(Flat p) { return {round7(p.u), round7(p.v)}; }

// One edge in all sizes. Places are added where the graded curve misses one, until it misses none.
class EdgeMeasuring {
 public:
  EdgeMeasuring(const std::vector<const Curve*>& sizes, std::size_t base)
      : base_(*sizes[base]), joints_(jointsOf(base_)) {
    for (const Curve* curve : sizes) {
      Size& size = sizes_.emplace_back(Size{curve, curve->flattened(4e-6), {0}});
      for (std::size_t i = 1; i < size.line.size(); ++i)
        size.along.push_back(size.along.back() + distance(size.line[i - 1], size.line[i]));
    }
    add({0, 1});
  }
  void measure() {
    for (bool more = true; more && places_.size() < kMostPlaces;) {
      std::vector<double> wanted;
      const std::vector<double> missed = misses();
      auto from = places_.begin();
      for (std::size_t k = 0; k < missed.size(); ++k) {
        const double low = from->first, high = (++from)->first;
        if (missed[k] <= kGradedMiss || high - low < 1e-3) continue;
        const double middle = (low + high) / 2;
        double at = std::round(middle * 1e6) / 1e6, nearest = high - low;
        for (const double joint : joints_)  // a joint within rather than the middle
          if (joint > low + 1e-3 && joint < high - 1e-3 && std::abs(joint - middle) < nearest)
            at = joint, nearest = std::abs(joint - middle);
        wanted.push_back(at);
      }
      add(wanted);
      more = !wanted.empty();
    }
  }
  // Shares of the length, and how far each goes in each size.
  const std::map<double, std::vector<Flat>>& places() const { return places_; }

 private:
  struct Size {
    const Curve* curve;
    std::vector<Flat> line;
    std::vector<double> along;
    double distanceTo(Flat p, double share) const {  // near a share of its length
      const double at = share * along.back(), reach = 0.08 * along.back() + 0.01;
      double least = 1e9;
      for (auto i = static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), at - reach) - along.begin());
           i < line.size() && (i == 0 || along[i - 1] < at + reach); ++i) {
        if (i == 0) continue;
        const Flat way = line[i] - line[i - 1];
        const double size = dot(way, way);
        const double t = size > 0 ? std::clamp(dot(p - line[i - 1], way) / size, 0.0, 1.0) : 0;
        least = std::min(least, distance(p, line[i - 1] + way * t));
      }
      return least;
    }
  };
  void add(const std::vector<double>& shares) {
    const std::vector<Flat> here = base_.atFractions(shares);
    for (const Size& size : sizes_) {
      const std::vector<Flat> there = size.curve->atFractions(shares);
      for (std::size_t k = 0; k < shares.size(); ++k) places_[shares[k]].push_back(round7(there[k] - here[k]));
    }
  }
  // By how much the graded curves miss the sizes most, between each two places.
  std::vector<double> misses() const {
    constexpr int kSamples = 6;  // of a cubic
    std::vector<double> most(places_.size() - 1);
    const double whole = base_.length();
    for (std::size_t size = 0; size < sizes_.size(); ++size) {
      EdgeDifference difference;
      for (const auto& [share, by] : places_) difference.s.push_back(share * whole), difference.by.push_back(by[size]);
      const Curve from = refined(base_, difference);
      const std::vector<Curve> before = from.parts(), after = differed(from, difference).parts();
      double s = 0;
      for (std::size_t k = 0; k < after.size(); ++k) {
        const double long_ = before[k].length();
        for (int i = 1; i < kSamples; ++i) {
          const double t = static_cast<double>(i) / kSamples, share = (s + t * long_) / whole;
          const auto in = std::distance(places_.begin(), places_.upper_bound(share));
          double& miss = most[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(in - 1, 0, std::ssize(most) - 1))];
          miss = std::max(miss, sizes_[size].distanceTo(after[k].at(t), share));
        }
        s += long_;
      }
    }
    return most;
  }
  const Curve& base_;
  std::vector<double> joints_;
  std::vector<Size> sizes_;
  std::map<double, std::vector<Flat>> places_;
};

// Places along both outlines that are each other's.
std::vector<std::pair<Flat, Flat>> pairsOf(const Outline& before, const Outline& after) {
  constexpr int kSteps = 24;  // of a curve
  std::vector<std::pair<Flat, Flat>> pairs;
  for (std::size_t k = 0; k < before.edges.size(); ++k) {
    const Curve &was = before.edges[k].curve, &is = after.edges[k].curve;
    const bool straight = was.kind == Curve::Kind::Line && is.kind == Curve::Kind::Line;
    const int steps = straight ? 1 : kSteps;
    const auto from = was.evenly(0, 1, steps), to = is.evenly(0, 1, steps);
    for (std::size_t i = 0; i + 1 < from.size(); ++i) pairs.emplace_back(from[i], to[i]);
  }
  return pairs;
}

}  // namespace

std::optional<std::size_t> Grading::find(std::string_view size) const {
  const auto at = std::find(sizes.begin(), sizes.end(), size);
  return at == sizes.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - sizes.begin()));
}

std::vector<Flat> differenceAt(const Outline& outline, const GradePoints& points, std::string_view edge, double at,
                               std::size_t sizes) {
  std::vector<Flat> all(sizes);
  const auto k = outline.find(edge);
  if (!k) return all;
  for (std::size_t size = 0; size < sizes; ++size) {
    const OutlineDifference difference(outline, points, size);
    all[size] = difference.edge(*k)(at * difference.edge(*k).s.back()).by;
  }
  return all;
}

Result<Outline> graded(const Outline& outline, const Grading& grading, const GradePoints& points, std::size_t from,
                       std::size_t to) {
  if (from == to) return outline;
  const GradePoints way = wayOf(points, from, to);
  auto done = checked(differed(refined(outline, way, 0), way, 0));
  if (!done) return refused(say("In size {0}: {1}", grading.sizes[to], done.error().what));
  return done;
}

GradePoints placesInSize(const Outline& outline, const GradePoints& points, std::size_t from, std::size_t to) {
  GradePoints now = points;
  const OutlineDifference difference(outline, wayOf(points, from, to), 0);
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    const Curve was = refined(outline.edges[k].curve, difference.edge(k)), is = differed(was, difference.edge(k));
    const double before = was.length(), after = is.length();
    for (GradePoint& point : now)  // joint for joint, both run by the same parameter
      if (point.edge == outline.edges[k].name && point.at > 0)
        point.at = is.lengthTo(was.parameterAt(point.at * before)) / after;
  }
  return now;
}

std::vector<Flat> carriedWithin(const Outline& before, const Outline& after, std::vector<Flat> places) {
  if (places.empty() || before == after) return places;
  const auto pairs = pairsOf(before, after);
  const std::size_t n = pairs.size();
  for (Flat& place : places) {
    std::vector<double> tangent(n);  // of half the angle under which each side of the ring is seen
    std::vector<double> away(n);
    std::optional<Flat> on;
    for (std::size_t i = 0; i < n && !on; ++i) {
      const Flat a = pairs[i].first - place, b = pairs[(i + 1) % n].first - place;
      away[i] = length(a);
      const double turned = cross(a, b), along = dot(a, b), apart = length(a) * length(b);
      if (away[i] < 1e-9) on = pairs[i].second - pairs[i].first;
      // Between the two: on the outline.
      if (!on && along < 0 && std::abs(turned) < 1e-12) {
        const double share = away[i] / (away[i] + length(b));
        on = lerp(pairs[i].second - pairs[i].first, pairs[(i + 1) % n].second - pairs[(i + 1) % n].first, share);
      }
      tangent[i] = std::abs(turned) > 1e-18 ? (apart - along) / turned : 0;
    }
    Flat by;
    double whole = 0;
    for (std::size_t i = 0; i < n && !on; ++i) {
      const double weight = (tangent[(i + n - 1) % n] + tangent[i]) / away[i];
      by += (pairs[i].second - pairs[i].first) * weight, whole += weight;
    }
    if (on)
      place += *on;
    else if (std::abs(whole) > 1e-12)
      place += by * (1 / whole);
  }
  return places;
}

Result<Piece> inSize(const Piece& piece, const Grading& grading, std::size_t to) {
  const auto own = grading.pieces.find(piece.id);
  if (own == grading.pieces.end() || to == grading.standing) return piece;
  auto outline = graded(piece.outline, grading, own->second, grading.standing, to);
  if (!outline) return refused(say("Piece {0}: {1}", piece.name, outline.error().what));
  Piece out = piece;
  const auto carry = [&](Curve& curve) {
    const auto ends = carriedWithin(piece.outline, *outline, {curve.start, curve.end, curve.control1, curve.control2});
    curve.start = ends[0], curve.end = ends[1];
    if (curve.kind == Curve::Kind::Cubic) curve.control1 = ends[2], curve.control2 = ends[3];
    curve.between = carriedWithin(piece.outline, *outline, curve.between);
  };
  for (Outline& hole : out.holes) {
    for (Edge& edge : hole.edges) carry(edge.curve);
    for (std::size_t k = 0, n = hole.edges.size(); k < n; ++k)
      hole.edges[(k + 1) % n].curve.start = hole.edges[k].curve.end;
  }
  for (InternalLine& line : out.lines)
    for (Curve& curve : line.curves) carry(curve);
  for (Mark& mark : out.marks)
    if (mark.edge.empty()) mark.place = carriedWithin(piece.outline, *outline, {mark.place}).front();
  out.outline = *std::move(outline);
  return out;
}

Result<GradePoints> measuredGrading(const std::vector<Outline>& sizes, std::size_t base) {
  GradePoints made;
  const std::vector<Edge>& edges = sizes[base].edges;
  const std::size_t n = edges.size();
  for (const Outline& size : sizes)
    if (size.edges.size() != n)
      return refused(say("The outlines have {0} and {1} {1|edge|edges}; sizes are measured corner by corner.", n,
                         size.edges.size()));
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<const Curve*> curves;
    for (const Outline& size : sizes) curves.push_back(&size.edges[k].curve);
    EdgeMeasuring edge(curves, base);
    edge.measure();
    for (const auto& [share, by] : edge.places()) {
      if (share >= 1) break;  // the next edge's
      GradePoint& point = made.emplace_back(GradePoint{edges[k].name, share, by});
      point.by[base] = {};
    }
  }
  return made;
}

void updateGrading(Grading& grading, const Piece& before, const EdgeMap& map, const std::vector<const Piece*>& now) {
  const auto own = grading.pieces.find(before.id);
  if (own == grading.pieces.end()) return;
  const GradePoints old = own->second;
  const auto parts = [&](const std::string& edge) {
    const auto at = map.find({before.id, edge});
    return at == map.end() ? std::vector<EdgePart>{{0, 1, {before.id, edge, 0, 1}}} : at->second;
  };
  // Where the outline was at the start (or the end) of an edge that is now.
  const auto wasAt = [&](PieceId piece, const std::string& edge, bool end) -> std::optional<std::vector<Flat>> {
    for (const Edge& was : before.outline.edges)
      for (const EdgePart& part : parts(was.name))
        if (part.now.piece == piece && part.now.edge == edge && (end ? part.now.to == 1 : part.now.from == 0))
          return differenceAt(before.outline, old, was.name, end ? part.to : part.from, grading.sizes.size());
    return std::nullopt;
  };
  for (const Piece* piece : now) {
    GradePoints points;
    const auto& edges = piece->outline.edges;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      auto by = wasAt(piece->id, edges[k].name, false);
      if (!by) by = wasAt(piece->id, edges[(k + edges.size() - 1) % edges.size()].name, true);
      if (by) points.push_back({edges[k].name, 0, *std::move(by)});
    }
    for (const GradePoint& point : old) {
      if (point.at <= 0) continue;
      const EdgeMap one{{{before.id, point.edge}, parts(point.edge)}};
      const auto there = placeNow(one, before.id, point.edge, point.at);
      if (!there || there->second < 1e-6 || there->second > 1 - 1e-6) continue;
      for (const EdgePart& part : parts(point.edge))
        if (part.now.piece == piece->id && part.now.edge == there->first && point.at >= part.from &&
            point.at <= part.to)
          points.push_back({there->first, there->second, point.by});
    }
    grading.pieces[piece->id] = std::move(points);
  }
}

GradePoints mirroredGrading(const GradePoints& points, const Outline& original, const Outline& image) {
  GradePoints out;
  const std::size_t n = original.edges.size();
  for (GradePoint point : points) {
    const auto k = original.find(point.edge);
    if (!k || image.edges.size() != n) continue;
    // The image of an edge starts where the edge ends.
    point.edge = image.edges[point.at > 0 ? n - 1 - *k : (n - *k) % n].name;
    if (point.at > 0) point.at = 1 - point.at;
    for (Flat& by : point.by) by.u = -by.u;
    out.push_back(std::move(point));
  }
  return out;
}

}  // namespace karinui
