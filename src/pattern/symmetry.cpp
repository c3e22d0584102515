#include "karinui/pattern/symmetry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "retrace.h"

namespace karinui {
namespace {

constexpr double kSameHalf = 2e-5;  // metres: drawn and drafted pieces are exact, imported ones rounded

// The axis if edge k were the image of edge (sum - k): mirroring turns the order round.
std::optional<PaperSymmetry> symmetryWith(const Outline& outline, std::size_t sum) {
  const auto& edges = outline.edges;
  const std::size_t n = edges.size();
  const auto partner = [&](std::size_t k) { return (sum + n - k) % n; };
  PaperSymmetry found;
  double widest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Flat a = edges[k].curve.start, b = edges[partner(k)].curve.end;
    if (distance(a, b) <= widest) continue;
    widest = distance(a, b);
    found.through = (a + b) * 0.5;
    found.axis = leftOf(normalized(b - a));
  }
  if (widest < 1e-3) return std::nullopt;
  if (found.axis.v < 0) found.axis = -found.axis;
  for (std::size_t k = 0; k < n; ++k) {
    const Curve here = edges[k].curve, there = edges[partner(k)].curve.reversed();
    for (const double f : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (distance(found.image(here.atFraction(f)), there.atFraction(f)) > kSameHalf) return std::nullopt;
  }
  for (std::size_t k = 0; k < n; ++k) {
    found.partner.push_back(partner(k));
    found.corner.push_back((partner(k) + 1) % n);
  }
  return found;
}

// --- Symmetry but for slits and darts.

constexpr std::size_t kMostEdges = 120;  // of a piece that is looked at so closely
constexpr double kLoose = 0.02;          // metres: how far an edge with a dart in it may be from its undivided image
constexpr std::size_t kSamples = 9;      // places an edge is compared at

struct Sampled {
  std::vector<Flat> place;  // evenly along the edge
  double length = 0;
};

// The edges that are a bank of a slit or a side of a dart.
std::vector<bool> cutEdges(const Outline& outline, const std::vector<Sampled>& sampled) {
  const auto& edges = outline.edges;
  const std::size_t n = edges.size();
  std::vector<bool> cut(n, false);
  for (const Retrace& slit : retraces(outline)) {
    double in = 0, out = 0;
    for (std::size_t k = slit.edge; in + sampled[k].length <= slit.reach + kSameHalf; k = (k + n - 1) % n)
      in += sampled[k].length, cut[k] = true;
    for (std::size_t k = (slit.edge + 1) % n; out + sampled[k].length <= slit.reach + kSameHalf; k = (k + 1) % n)
      out += sampled[k].length, cut[k] = true;
  }
  // A dart: as far in as out, round a sharp tip inside the cloth.
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    if (cut[k] || cut[next]) continue;
    const Flat in = edges[k].curve.end - edges[k].curve.start, out = edges[next].curve.end - edges[next].curve.start;
    const double one = sampled[k].length, other = sampled[next].length;
    const double mouth = distance(edges[k].curve.start, edges[next].curve.end);
    if (std::fabs(one - other) < 0.1 * one && mouth < 0.8 * std::min(one, other) && cross(in, out) < 0)
      cut[k] = cut[next] = true;
  }
  return cut;
}

// The maximal runs of edges without a partner, round the outline: [first, first + count).
struct Run {
  std::size_t first = 0, count = 0;
};
std::vector<Run> runsWithout(const std::vector<std::optional<std::size_t>>& partner) {
  const std::size_t n = partner.size();
  std::vector<Run> runs;
  for (std::size_t k = 0; k < n; ++k) {
    if (partner[k] || !partner[(k + n - 1) % n]) continue;
    Run run{k, 0};
    while (!partner[(k + run.count) % n]) ++run.count;
    runs.push_back(run);
  }
  return runs;
}

class BesideCuts {
 public:
  explicit BesideCuts(const Outline& outline) : edges_(outline.edges), n_(outline.edges.size()) {
    std::vector<double> shares;
    for (std::size_t i = 0; i < kSamples; ++i) shares.push_back(static_cast<double>(i) / (kSamples - 1));
    for (const Edge& edge : edges_) {
      sampled_.push_back({edge.curve.atFractions(shares), edge.curve.length()});
      sampled_.back().place.front() = edge.curve.start, sampled_.back().place.back() = edge.curve.end;
    }
    cut_ = cutEdges(outline, sampled_);
    for (std::size_t k = 0; k < n_; ++k)
      if (!cut_[k]) whole_ += sampled_[k].length;
  }

  std::optional<PaperSymmetry> find() const {
    if (std::none_of(cut_.begin(), cut_.end(), [](bool is) { return is; })) return std::nullopt;
    std::optional<PaperSymmetry> best;
    double most = 0;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = i; j < n_; ++j) {
        if (cut_[i] || cut_[j] || std::fabs(sampled_[i].length - sampled_[j].length) > 1e-4) continue;
        double matched = 0;
        auto found = withImages(i, j, matched);
        if (!found || matched < 0.5 * whole_ || matched <= most + 1e-9) continue;
        most = matched;
        best = std::move(found);
      }
    return best;
  }

 private:
  // The symmetry in which edge i is the image of edge j.
  std::optional<PaperSymmetry> withImages(std::size_t i, std::size_t j, double& matched) const {
    PaperSymmetry found;
    double widest = 0;
    for (const auto& [a, b] : {std::pair(edges_[i].curve.start, edges_[j].curve.end),
                               std::pair(edges_[i].curve.end, edges_[j].curve.start)}) {
      if (distance(a, b) <= widest) continue;
      widest = distance(a, b);
      found.through = (a + b) * 0.5;
      found.axis = leftOf(normalized(b - a));
    }
    if (widest < 1e-3) return std::nullopt;
    if (found.axis.v < 0) found.axis = -found.axis;
    if (found.axis.v < std::numbers::sqrt2 / 2) return std::nullopt;
    found.partner.resize(n_);
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t m = k; m < n_ && !found.partner[k]; ++m)
        if (!found.partner[m] && areImages(found, k, m)) found.partner[k] = m, found.partner[m] = k;
    for (std::size_t k = 0; k < n_; ++k)
      if (found.partner[k] && !cut_[k]) matched += sampled_[k].length;
    const std::vector<Run> runs = runsWithout(found.partner);
    for (const Run& run : runs)
      if (!excused(found, run, runs)) return std::nullopt;
    found.corner.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      const std::size_t before = (k + n_ - 1) % n_;
      if (mouthAt(k)) continue;  // which of the two would be meant
      if (found.partner[k])
        found.corner[k] = (*found.partner[k] + 1) % n_;
      else if (found.partner[before])
        found.corner[k] = *found.partner[before];
    }
    return found;
  }

  bool areImages(const PaperSymmetry& symmetry, std::size_t k, std::size_t m) const {
    if (std::fabs(sampled_[k].length - sampled_[m].length) > 1e-4) return false;
    for (std::size_t i = 0; i < kSamples; ++i)
      if (distance(symmetry.image(sampled_[k].place[i]), sampled_[m].place[kSamples - 1 - i]) > kSameHalf) return false;
    return true;
  }
  // Whether another corner lies at the very same place: the mouth of a slit.
  bool mouthAt(std::size_t k) const {
    for (std::size_t m = 0; m < n_; ++m)
      if (m != k && edges_[m].curve.start == edges_[k].curve.start) return true;
    return false;
  }
  bool hasCut(const Run& run) const {
    for (std::size_t i = 0; i < run.count; ++i)
      if (cut_[(run.first + i) % n_]) return true;
    return false;
  }
  // The run without its slits and darts.
  std::vector<Flat> closedUp(const Run& run) const {
    std::vector<Flat> line;
    for (std::size_t i = 0; i < run.count; ++i)
      if (const std::size_t k = (run.first + i) % n_; !cut_[k])
        line.insert(line.end(), sampled_[k].place.begin(), sampled_[k].place.end());
    return line;
  }
  static bool near(const std::vector<Flat>& places, const std::vector<Flat>& line) {
    return std::all_of(places.begin(), places.end(), [&](Flat place) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (distanceToSegment(line[i], line[i + 1], place) < kLoose) return true;
      return false;
    });
  }
  // A run without a counterpart is so because of a slit or dart: the other half has there what it would be without.
  bool excused(const PaperSymmetry& symmetry, const Run& run, const std::vector<Run>& runs) const {
    const Flat start = edges_[run.first].curve.start, end = edges_[(run.first + run.count - 1) % n_].curve.end;
    std::vector<Flat> mine = closedUp(run);
    if (mine.empty()) return hasCut(run) && distance(start, end) < kSameHalf;
    for (Flat& place : mine) place = symmetry.image(place);
    return std::any_of(runs.begin(), runs.end(), [&](const Run& other) {
      const Flat otherStart = edges_[other.first].curve.start;
      const Flat otherEnd = edges_[(other.first + other.count - 1) % n_].curve.end;
      if (distance(symmetry.image(start), otherEnd) > kSameHalf ||
          distance(symmetry.image(end), otherStart) > kSameHalf)
        return false;
      const std::vector<Flat> theirs = closedUp(other);
      return (hasCut(run) || hasCut(other)) && near(mine, theirs) && near(theirs, mine);
    });
  }

  const std::vector<Edge>& edges_;
  std::size_t n_;
  std::vector<Sampled> sampled_;
  std::vector<bool> cut_;
  double whole_ = 0;  // metres of edges that are no bank and no side of a dart
};

// A curve across the axis whose second half is the image of its first.
Curve mirroredHalf(const Curve& curve, const PaperSymmetry& symmetry) {
  Curve half = curve.part(0, curve.parameterAt(curve.length() / 2));
  half.end = (half.end + symmetry.image(half.end)) * 0.5;
  if (half.kind == Curve::Kind::Cubic) {  // and they meet without a kink
    const Flat across = leftOf(symmetry.axis);
    half.control2 = half.end + across * dot(half.control2 - half.end, across);
  }
  return Curve::joined(std::vector<Curve>{half, symmetry.image(half).reversed()});
}

// The end of an edge that keeps its shape goes along with its corner.
void followCorners(Curve& curve, Flat start, Flat end) {
  if (curve.kind == Curve::Kind::Cubic) {
    if (!(curve.start == start)) curve.control1 += start - curve.start;
    if (!(curve.end == end)) curve.control2 += end - curve.end;
  }
  curve.start = start, curve.end = end;
}

}  // namespace

std::optional<PaperSymmetry> symmetryOf(const Outline& outline) {
  std::optional<PaperSymmetry> best;
  for (std::size_t sum = 0; sum < outline.edges.size(); ++sum) {
    auto found = symmetryWith(outline, sum);
    if (found && found->axis.v >= (best ? best->axis.v + 1e-9 : std::sqrt(0.5) + 1e-9)) best = std::move(found);
  }
  if (!best && outline.edges.size() <= kMostEdges) best = BesideCuts(outline).find();
  return best;
}

std::optional<OutlinePlace> imageOf(const Outline& outline, const PaperSymmetry& symmetry, const OutlinePlace& place) {
  if (const auto partner = symmetry.partner[place.edge]) return OutlinePlace{*partner, 1 - place.at};
  const Flat there = symmetry.image(outline.edges[place.edge].curve.atFraction(place.at));
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    if (symmetry.partner[k]) continue;
    const Curve& curve = outline.edges[k].curve;
    // The nearest place of the edge: from the nearest of many, by halves.
    constexpr int kLooks = 128;
    const std::vector<Flat> looks = curve.evenly(0, 1, kLooks);
    const auto nearest = std::min_element(looks.begin(), looks.end(),
                                          [&](Flat a, Flat b) { return distance(a, there) < distance(b, there); });
    double at = static_cast<double>(nearest - looks.begin()) / kLooks;
    for (double step = 0.5 / kLooks; step > 1e-9; step /= 2)
      for (const double other : {at - step, at + step})
        if (other >= 0 && other <= 1 &&
            distance(curve.atFraction(other), there) < distance(curve.atFraction(at), there))
          at = other;
    if (distance(curve.atFraction(at), there) < 1e-4) return OutlinePlace{k, at};
  }
  return std::nullopt;
}

Curve evenAcross(const Curve& curve, const PaperSymmetry& symmetry) {
  if (curve.kind != Curve::Kind::Cubic) return curve;
  if (!curve.between.empty()) return mirroredHalf(curve, symmetry);
  const Curve image = symmetry.image(curve).reversed();
  return Curve::cubic(curve.start, (curve.control1 + image.control1) * 0.5, (curve.control2 + image.control2) * 0.5,
                      curve.end);
}

Outline symmetrised(Outline outline, const PaperSymmetry& symmetry) {
  auto& edges = outline.edges;
  const std::size_t n = edges.size();
  const Outline given = outline;
  // Corners first, in pairs; a corner without an image that lies where one of a pair lies goes with it.
  std::vector<bool> paired(n, false);
  for (std::size_t k = 0; k < n; ++k) {
    if (!symmetry.corner[k]) continue;
    const std::size_t other = *symmetry.corner[k];
    if (other < k && symmetry.corner[other]) continue;
    const Flat corner = (edges[k].curve.start + symmetry.image(edges[other].curve.start)) * 0.5;
    edges[k].curve.start = corner;
    if (other != k) edges[other].curve.start = symmetry.image(corner);
    paired[k] = paired[other] = true;
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t m = 0; m < n && !paired[k]; ++m)
      if (paired[m] && given.edges[m].curve.start == given.edges[k].curve.start)
        edges[k].curve.start = edges[m].curve.start;
  for (std::size_t k = 0; k < n; ++k) {
    const Flat start = edges[k].curve.start, end = edges[(k + 1) % n].curve.start;
    if (!symmetry.partner[k]) {
      edges[k].curve = given.edges[k].curve;
      followCorners(edges[k].curve, start, end);
    }
    edges[k].curve.end = end;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!symmetry.partner[k]) continue;
    const std::size_t other = *symmetry.partner[k];
    Curve& curve = edges[k].curve;
    if (other > k) {
      edges[other].curve = symmetry.image(curve).reversed();
    } else if (other == k && curve.kind != Curve::Kind::Line) {
      curve = mirroredHalf(curve, symmetry);
    }
  }
  return outline;
}

Outline onBothHalves(const Outline& before, Outline now, const PaperSymmetry& symmetry) {
  auto& edges = now.edges;
  const std::size_t n = edges.size();
  const auto halfway = [&](Flat a, Flat b) { return (a + symmetry.image(b)) * 0.5; };
  const Outline done = now;
  const auto moved = [&](std::size_t c) { return !(done.edges[c].curve.start == before.edges[c].curve.start); };
  for (std::size_t k = 0; k < n; ++k) {
    if (!moved(k) || !symmetry.corner[k]) continue;
    const std::size_t other = *symmetry.corner[k];
    if (other != k && moved(other)) continue;
    const Flat was = before.edges[other].curve.start;
    edges[other].curve.start = other == k ? halfway(done.edges[k].curve.start, done.edges[k].curve.start)
                                          : symmetry.image(done.edges[k].curve.start);
    for (std::size_t c = 0; c < n; ++c)  // the other side of a slit's mouth
      if (c != other && !symmetry.corner[c] && !moved(c) && before.edges[c].curve.start == was)
        edges[c].curve.start = edges[other].curve.start;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Flat start = edges[k].curve.start, end = edges[(k + 1) % n].curve.start;
    if (!symmetry.partner[k]) {
      edges[k].curve = done.edges[k].curve;
      followCorners(edges[k].curve, start, end);
    }
    edges[k].curve.end = end;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!symmetry.partner[k]) continue;
    const std::size_t other = *symmetry.partner[k];
    const auto changed = [&](std::size_t e) { return !(done.edges[e].curve == before.edges[e].curve); };
    Curve& curve = edges[k].curve;
    if (!changed(k)) continue;
    if (other != k) {
      if (k < other || !changed(other)) {
        Curve image = symmetry.image(curve).reversed();
        image.start = edges[other].curve.start, image.end = edges[other].curve.end;  // to the bit
        edges[other].curve = std::move(image);
      }
    } else if (curve.kind == Curve::Kind::Cubic) {  // it crosses the axis: as much on both sides
      const Curve image = symmetry.image(curve).reversed();
      curve.control1 = (curve.control1 + image.control1) * 0.5;
      curve.control2 = (curve.control2 + image.control2) * 0.5;
      for (std::size_t i = 0; i < curve.between.size(); ++i)
        curve.between[i] = (curve.between[i] + image.between[i]) * 0.5;
    }
  }
  return now;
}

}  // namespace karinui
