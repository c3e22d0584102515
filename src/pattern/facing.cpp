// The inner line is where the distance to the run is the width: the run carried inwards, square to itself, with arcs
// about corners and ends where the piece goes round them. It ends where the outline first gets as far from the run.
#include "karinui/pattern/facing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "divide_edges.h"
#include "karinui/geometry/fit_curve.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kStep = 0.002;  // metres between the places looked at
constexpr double kClose = 2e-5;  // metres by which they may be nearer to the run
constexpr double kFree = 1e-3;   // metres of the line's ends that its places keep off
constexpr double kRound = 2;     // widths of the facing: the radius with which a corner is rounded off, and
constexpr double kTight = 1.3;   // times the turn of that circle: what turns more is a corner

class Cutting {
 public:
  Cutting(const Piece& piece, const std::vector<std::string>& run, double width)
      : piece_(piece), edges_(piece.outline.edges), names_(run), width_(width) {}

  Result<DividedPart> facing() {
    if (Done done = measure(say("choose a narrower facing")); !done) return done.error();
    const std::size_t n = edges_.size();
    for (std::size_t k = 0; k < run_.size(); ++k) add((first_ + k) % n, 0, 1);
    for (const auto& [k, to] : on_) add(k, 0, to);
    std::set<std::string> names = edgeNames(piece_);
    addInner(freeName("inner", names), innerLine());
    for (auto at = back_.rbegin(); at != back_.rend(); ++at) add(at->first, at->second, 1);
    return closed();
  }

  Result<DividedPart> rest() {
    if (Done done = measure(say("shorten it by less")); !done) return done.error();
    const auto [onto, to] = on_.back();
    const auto [from, upTo] = back_.back();
    if (onto == from) {
      add(onto, to, upTo);
    } else {
      add(onto, to, 1);
      for (std::size_t k = (onto + 1) % edges_.size(); k != from; k = (k + 1) % edges_.size()) add(k, 0, 1);
      add(from, 0, upTo);
    }
    addInner(names_.front(), innerLine().reversed());
    return closed();
  }

 private:
  // How far the strip goes along the outline.
  Done measure(const Message& otherwise) {
    if (Done done = findRun(); !done) return done.error();
    const std::size_t n = edges_.size();
    for (const Curve* curve : run_)
      for (const Flat p : curve->flattened(1e-5)) line_.push_back(p);
    const std::size_t last = (first_ + run_.size() - 1) % n;
    double left = 0;
    for (std::size_t k = (last + 1) % n; k != first_; k = (k + 1) % n) {
      const auto far = reaches(edges_[k].curve);
      on_.emplace_back(k, far.value_or(1));
      left = 1 - far.value_or(1);
      if (far) break;
    }
    for (std::size_t k = (first_ + n - 1) % n; k != last; k = (k + n - 1) % n) {
      const auto far = reaches(edges_[k].curve.reversed());
      back_.emplace_back(k, 1 - far.value_or(1));
      if (far) break;
    }
    const bool meet = on_.back().first == back_.back().first && back_.back().second <= on_.back().second;
    if (left <= 0 || meet || on_.size() + back_.size() > n - run_.size() + 1)
      return refused(
          say("{0} is nowhere {1} mm deep beside “{2}”; {3}.", piece_.name, inMm(width_), names_.front(), otherwise));
    end_ = edges_[on_.back().first].curve.atFraction(on_.back().second);
    start_ = edges_[back_.back().first].curve.atFraction(back_.back().second);
    return {};
  }

  // A part of an edge, where it is long enough to be one.
  void add(std::size_t k, double from, double to) {
    const Edge& edge = edges_[k];
    const double whole = edge.curve.length();
    if ((to - from) * whole < kLeastEdge) return;
    const Curve curve = from == 0 && to == 1 ? edge.curve
                                             : edge.curve.part(from == 0 ? 0 : edge.curve.parameterAt(from * whole),
                                                               to == 1 ? 1 : edge.curve.parameterAt(to * whole));
    const std::string name = freeName(edge.name, taken_);
    part_.outline.edges.push_back({name, curve});
    part_.edges.push_back({{piece_.id, edge.name, from, to}, {{}, name, 0, 1}});
  }
  void addInner(const std::string& name, const Curve& line) {
    part_.inner = name;
    part_.outline.edges.push_back({name, line});
  }
  Result<DividedPart> closed() {
    auto& all = part_.outline.edges;
    for (std::size_t i = 0; i < all.size(); ++i) all[(i + 1) % all.size()].curve.start = all[i].curve.end;
    auto good = checked(std::move(part_.outline));
    if (!good) return good.error();
    part_.outline = *std::move(good);
    return std::move(part_);
  }

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
  Curve innerLine() const {
    std::vector<Flat> places;
    std::set<std::size_t> asked;  // where the piece has a corner the line is to have, too: the place after it
    const auto arc = [&](Flat about, Flat from, Flat to) {  // clockwise, between two directions
      const double a = std::atan2(from.v, from.u),
                   turn = std::remainder(std::atan2(to.v, to.u) - a, 2 * std::numbers::pi);
      const int steps = static_cast<int>(std::ceil(std::abs(turn) * width_ / kStep));
      for (int k = 1; k < steps; ++k) {
        const double angle = a + turn * k / steps;
        places.push_back(about + Flat{std::cos(angle), std::sin(angle)} * width_);
      }
    };
    const auto inward = [](const Curve& curve, double t) { return leftOf(normalized(curve.tangent(t))); };
    arc(run_.back()->end, normalized(end_ - run_.back()->end), inward(*run_.back(), 1));
    for (std::size_t r = run_.size(); r-- > 0;) {
      const Curve& curve = *run_[r];
      const int steps = std::max(2, static_cast<int>(std::ceil(curve.length() / kStep)));
      for (int k = steps; k >= 0; --k) {
        const double t = k == 0 ? 0 : k == steps ? 1 : curve.parameterAt(curve.length() * k / steps);
        places.push_back(curve.at(t) + inward(curve, t) * width_);
      }
      if (r == 0) break;
      if (cross(run_[r - 1]->tangent(1), curve.tangent(0)) < 0)
        arc(curve.start, inward(curve, 0), inward(*run_[r - 1], 1));
      else
        asked.insert(places.size());
    }
    arc(run_.front()->start, inward(*run_.front(), 0), normalized(start_ - run_.front()->start));
    const Ring ring = piece_.outline.flattened(1e-5);
    const auto off = [&](Flat p) {
      return away(p) < width_ - kClose || !contains(ring, p) || distance(p, end_) < kFree ||
             distance(p, start_) < kFree;
    };
    std::vector<Flat> line{end_};
    std::vector<std::size_t> meant;  // corners of the line that the piece asks for: the place after them
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (asked.contains(i)) meant.push_back(line.size());
      // Where the run's radius is about the width they throng, and turn to and fro.
      if (!off(places[i]) && distance(places[i], line.back()) > kStep / 2) line.push_back(places[i]);
    }
    line.push_back(start_);
    roundOff(line, meant);
    return Curve::joined(fitEdge(line).curves);
  }

  // Into what turns towards the run more tightly than a circle twice as large as the facing is deep such a circle is
  // laid, where there is room: the line follows it from where it touches one side to where it touches the other.
  void roundOff(std::vector<Flat>& line, const std::vector<std::size_t>& meant) const {
    const auto turnAt = [&](std::size_t low, std::size_t high) {
      return angleFrom(line[low] - line[low - 1], line[high + 1] - line[high]);
    };
    // How much the line turns about a place, over how much it would on the circle.
    const auto tightness = [&](std::size_t i) {
      std::size_t low = i - 1, high = i + 1;
      while (low > 0 && distance(line[low], line[i]) < 2 * kStep) --low;
      while (high + 1 < line.size() && distance(line[high], line[i]) < 2 * kStep) ++high;
      const Flat in = line[i] - line[low], out = line[high] - line[i];
      return -angleFrom(in, out) / ((length(in) + length(out)) / 2 / (kRound * width_));
    };
    std::vector<std::pair<double, std::size_t>> corners;  // the tightest place of each
    bool goesOn = false;
    for (std::size_t i = 2; i + 2 < line.size(); ++i) {
      const double tight = tightness(i);
      if (tight < kTight) {
        goesOn = false;
      } else if (!std::exchange(goesOn, true)) {
        corners.emplace_back(tight, i);
      } else if (tight > corners.back().first) {
        corners.back() = {tight, i};
      }
    }
    std::erase_if(corners, [&](const auto& corner) {
      return std::any_of(meant.begin(), meant.end(), [&](std::size_t k) {
        return k < line.size() && distance(line[k], line[corner.second]) < 4 * kStep;
      });
    });
    std::size_t end = line.size() - 1;
    for (std::size_t c = corners.size(); c-- > 0;) {
      const std::size_t before = corners[c].second - 1, after = before + 2;
      const std::size_t start = c > 0 ? (corners[c - 1].second + before) / 2 : 0;
      std::size_t low = before, high = after;
      const auto within = [&] {
        return distance(line[low], line[high]) < 2 * kRound * width_ * std::sin(-turnAt(low, high) / 2);
      };
      while (low > start + 1 && high + 2 < end && within()) --low, ++high;
      end = low;
      const double apart = distance(line[low], line[high]);
      const Flat in = normalized(line[low] - line[low - 1]), out = normalized(line[high + 1] - line[high]);
      const Curve blend =
          Curve::cubic(line[low], line[low] + in * (apart / 3), line[high] - out * (apart / 3), line[high]);
      std::vector<Flat> round = blend.evenly(0, 1, std::max(2, static_cast<int>(std::ceil(apart / kStep))));
      round.erase(round.begin()), round.pop_back();
      const auto at = line.erase(line.begin() + static_cast<std::ptrdiff_t>(low) + 1,
                                 line.begin() + static_cast<std::ptrdiff_t>(high));
      line.insert(at, round.begin(), round.end());
    }
  }

  const Piece& piece_;
  const std::vector<Edge>& edges_;
  const std::vector<std::string>& names_;
  double width_;
  std::size_t first_ = 0;
  std::vector<const Curve*> run_;
  std::vector<Flat> line_;  // the run
  // The edges the strip goes on over, from the run's end and back from its start, each up to which share of its length.
  std::vector<std::pair<std::size_t, double>> on_, back_;
  Flat end_, start_;  // of the inner line
  DividedPart part_;
  std::set<std::string> taken_;
};

}  // namespace

Result<DividedPart> facingOf(const Piece& piece, const std::vector<std::string>& run, double width) {
  return Cutting(piece, run, width).facing();
}

Result<DividedPart> shortenedAt(const Piece& piece, const std::vector<std::string>& run, double by) {
  return Cutting(piece, run, by).rest();
}

}  // namespace karinui
