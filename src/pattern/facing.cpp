// The inner line is where the distance to the run is the width: the run carried inwards, square to itself, with arcs
// about corners and ends where the piece goes round them. It ends where the outline first gets as far from the run.
#include "karinui/pattern/facing.h"

#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "karinui/geometry/fit_curve.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kStep = 0.002;  // metres between the places looked at
constexpr double kClose = 2e-5;  // metres by which they may be nearer to the run
constexpr double kFree = 1e-3;   // metres of the line's ends that its places keep off

class Cutting {
 public:
  Cutting(const Piece& piece, const std::vector<std::string>& run, double width)
      : piece_(piece), edges_(piece.outline.edges), names_(run), width_(width) {}

  Result<Facing> cut() {
    if (Done done = findRun(); !done) return done.error();
    const std::size_t n = edges_.size();
    for (const Curve* curve : run_)
      for (const Flat p : curve->flattened(1e-5)) line_.push_back(p);
    Facing facing;
    std::set<std::string> taken;
    const auto add = [&](const Edge& edge, double from, double to) {
      const double whole = edge.curve.length();
      const Curve curve = from == 0 && to == 1 ? edge.curve
                                               : edge.curve.part(from == 0 ? 0 : edge.curve.parameterAt(from * whole),
                                                                 to == 1 ? 1 : edge.curve.parameterAt(to * whole));
      const std::string name = freeName(edge.name, taken);
      facing.outline.edges.push_back({name, curve});
      facing.parts.push_back({{piece_.id, edge.name, from, to}, {{}, name, 0, 1}});
    };
    for (std::size_t k = 0; k < run_.size(); ++k) add(edges_[(first_ + k) % n], 0, 1);
    const std::size_t last = (first_ + run_.size() - 1) % n;
    // On from the run's end, and back from its start, until the outline is far enough away.
    std::vector<std::pair<std::size_t, double>> on, back;
    double left = 0;
    for (std::size_t k = (last + 1) % n; k != first_; k = (k + 1) % n) {
      const auto far = reaches(edges_[k].curve);
      on.emplace_back(k, far.value_or(1));
      left = 1 - far.value_or(1);
      if (far) break;
    }
    for (std::size_t k = (first_ + n - 1) % n; k != last; k = (k + n - 1) % n) {
      const auto far = reaches(edges_[k].curve.reversed());
      back.emplace_back(k, 1 - far.value_or(1));
      if (far) break;
    }
    const bool meet = on.back().first == back.back().first && back.back().second <= on.back().second;
    if (left <= 0 || meet || on.size() + back.size() > n - run_.size() + 1)
      return refused(say("{0} is nowhere {1} mm deep beside “{2}”; choose a narrower facing.", piece_.name,
                         inMm(width_), names_.front()));
    for (const auto& [k, to] : on)
      if (to * edges_[k].curve.length() >= kLeastEdge) add(edges_[k], 0, to);
    const auto [k, from] = back.back();
    const Flat end = facing.outline.edges.back().curve.end, start = edges_[k].curve.atFraction(from);
    std::set<std::string> names = edgeNames(piece_);
    facing.inner = freeName("inner", names);
    facing.outline.edges.push_back({facing.inner, innerLine(end, start)});
    for (auto at = back.rbegin(); at != back.rend(); ++at)
      if ((1 - at->second) * edges_[at->first].curve.length() >= kLeastEdge) add(edges_[at->first], at->second, 1);
    auto& all = facing.outline.edges;
    for (std::size_t i = 0; i < all.size(); ++i) all[(i + 1) % all.size()].curve.start = all[i].curve.end;
    auto good = checked(std::move(facing.outline));
    if (!good) return good.error();
    facing.outline = *std::move(good);
    return facing;
  }

 private:
  Done findRun() {
    std::optional<std::size_t> last;
    for (const std::string& name : names_) {
      const auto k = piece_.outline.find(name);
      if (!k) return noEdge(piece_, name);
      if (last && *k != (*last + 1) % edges_.size())
        return refused(say("“{0}” does not follow “{1}” on the outline of {2}; face them one at a time.", name,
                           edges_[*last].name, piece_.name));
      if (!last) first_ = *k;
      last = k;
      run_.push_back(&edges_[*k].curve);
    }
    if (run_.size() + 1 > edges_.size() || run_.front()->start == run_.back()->end)
      return refused(say("A facing has two ends: leave an edge of {0} free between them.", piece_.name));
    return {};
  }

  double away(Flat p) const {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k + 1 < line_.size(); ++k)
      least = std::min(least, distanceToSegment(line_[k], line_[k + 1], p));
    return least;
  }

  // The share of its length at which a curve first is as far from the run as the facing is wide.
  std::optional<double> reaches(const Curve& curve) const {
    const int steps = std::max(4, static_cast<int>(std::ceil(curve.length() / kStep)));
    const std::vector<Flat> places = curve.evenly(0, 1, steps);
    for (int k = 1; k <= steps; ++k) {
      if (away(places[k]) < width_) continue;
      double low = static_cast<double>(k - 1) / steps, high = static_cast<double>(k) / steps;
      for (int round = 0; round < 40; ++round) {
        const double middle = (low + high) / 2;
        (away(curve.atFraction(middle)) < width_ ? low : high) = middle;
      }
      return high;
    }
    return std::nullopt;
  }

  // From the outline beyond the run's end back to the outline before its start.
  Curve innerLine(Flat end, Flat start) const {
    std::vector<Flat> places;
    const auto arc = [&](Flat about, Flat from, Flat to) {  // clockwise, between two directions
      const double a = std::atan2(from.v, from.u), turn = std::remainder(std::atan2(to.v, to.u) - a, 2 * M_PI);
      const int steps = static_cast<int>(std::ceil(std::abs(turn) * width_ / kStep));
      for (int k = 1; k < steps; ++k) {
        const double angle = a + turn * k / steps;
        places.push_back(about + Flat{std::cos(angle), std::sin(angle)} * width_);
      }
    };
    const auto inward = [](const Curve& curve, double t) { return leftOf(normalized(curve.tangent(t))); };
    arc(run_.back()->end, normalized(end - run_.back()->end), inward(*run_.back(), 1));
    for (std::size_t r = run_.size(); r-- > 0;) {
      const Curve& curve = *run_[r];
      const int steps = std::max(2, static_cast<int>(std::ceil(curve.length() / kStep)));
      for (int k = steps; k >= 0; --k) {
        const double t = k == 0 ? 0 : k == steps ? 1 : curve.parameterAt(curve.length() * k / steps);
        places.push_back(curve.at(t) + inward(curve, t) * width_);
      }
      if (r > 0 && cross(run_[r - 1]->tangent(1), curve.tangent(0)) < 0)
        arc(curve.start, inward(curve, 0), inward(*run_[r - 1], 1));
    }
    arc(run_.front()->start, inward(*run_.front(), 0), normalized(start - run_.front()->start));
    const Ring ring = piece_.outline.flattened(1e-5);
    std::erase_if(places, [&](Flat p) {
      return away(p) < width_ - kClose || !contains(ring, p) || distance(p, end) < kFree || distance(p, start) < kFree;
    });
    places.insert(places.begin(), end);
    places.push_back(start);
    return Curve::joined(fitEdge(places).curves);
  }

  const Piece& piece_;
  const std::vector<Edge>& edges_;
  const std::vector<std::string>& names_;
  double width_;
  std::size_t first_ = 0;
  std::vector<const Curve*> run_;
  std::vector<Flat> line_;  // the run
};

}  // namespace

Result<Facing> facingOf(const Piece& piece, const std::vector<std::string>& run, double width) {
  return Cutting(piece, run, width).cut();
}

}  // namespace karinui
