// Projected Newton with a line search that stops short of the first fold (Smith & Schaefer 2015).
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/membrane.h"

namespace karinui {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The points that may move, and the triangles that feel it: all else stays as it is, and costs nothing.
struct Moving {
  std::vector<std::uint32_t> points;
  std::vector<int> number;  // of each point among those; -1: pinned
  std::vector<RestTriangle> rest;

  explicit Moving(const FlatProblem& problem, std::size_t count) : number(count, -1) {
    for (std::uint32_t p = 0; p < count; ++p) {
      if (!problem.pinned.empty() && problem.pinned[p] != 0) continue;
      number[p] = static_cast<int>(points.size());
      points.push_back(p);
    }
    for (const RestTriangle& t : problem.rest)
      if (std::any_of(t.corner.begin(), t.corner.end(), [&](std::uint32_t p) { return number[p] >= 0; }))
        rest.push_back(t);
  }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(2 * points.size()); }
};

// A symmetric matrix, on and below its diagonal, summed from parts that come in the same order every time: where each
// goes is found out once.
class Summed {
 public:
  explicit Summed(Eigen::Index unknowns) : matrix_(unknowns, unknowns) {}
  void begin() {
    next_ = 0;
    if (!slot_.empty()) std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  }
  void add(int row, int column, double value) {
    if (slot_.empty())
      parts_.emplace_back(row, column, value);
    else
      matrix_.valuePtr()[slot_[next_++]] += value;
  }
  const Sparse& end() {
    if (!slot_.empty()) return matrix_;
    matrix_.setFromTriplets(parts_.begin(), parts_.end());
    const int *start = matrix_.outerIndexPtr(), *row = matrix_.innerIndexPtr();
    for (const auto& part : parts_)
      slot_.push_back(std::lower_bound(row + start[part.col()], row + start[part.col() + 1], part.row()) - row);
    parts_ = {};
    return matrix_;
  }

 private:
  Sparse matrix_;
  std::vector<Eigen::Triplet<double>> parts_;
  std::vector<std::ptrdiff_t> slot_;
  std::size_t next_ = 0;
};

double energy(const FlatProblem& problem, const Moving& moving, std::span<const Flat> flat) {
  double sum = 0;
  for (const RestTriangle& rest : moving.rest) {
    const Gradient f = gradientOf(rest, flat);
    if (!(determinant(f) > 0)) return kInfinite;
    sum += rest.area * problem.law(f, false).value;
  }
  for (const auto& s : problem.springs) {
    const double miss = distance(flat[s.a], flat[s.b]) / s.length - 1;
    sum += s.weight * miss * miss;
  }
  for (const auto& h : problem.holds) sum += h.weight * flat[h.point].u * flat[h.point].u;
  return sum;
}

// Slope and stiffness of the whole; the n-th point that moves owns unknowns 2n (u) and 2n + 1 (v).
void derivatives(const FlatProblem& problem, const Moving& moving, std::span<const Flat> flat, Eigen::VectorXd& slope,
                 Summed& stiffness) {
  stiffness.begin();
  slope.setZero(moving.unknowns());
  const auto scatter = [&](std::span<const std::uint32_t> points, const auto& g, const auto& h) {
    for (std::size_t i = 0; i < 2 * points.size(); ++i) {
      const int row = moving.number[points[i / 2]];
      if (row < 0) continue;
      const int at = 2 * row + static_cast<int>(i % 2);
      slope[at] += g[static_cast<Eigen::Index>(i)];
      for (std::size_t j = 0; j < 2 * points.size(); ++j)
        if (const int column = 2 * moving.number[points[j / 2]] + static_cast<int>(j % 2); column >= 0 && column <= at)
          stiffness.add(at, column, h(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  };
  double diagonal = 0;
  for (const RestTriangle& rest : moving.rest) {
    const MembraneTerm term = problem.law(gradientOf(rest, flat), true);
    Eigen::Matrix<double, 4, 6> b = Eigen::Matrix<double, 4, 6>::Zero();
    for (int k = 0; k < 3; ++k) {
      const Flat g = rest.gradient[static_cast<std::size_t>(k)];
      b(0, 2 * k) = b(2, 2 * k + 1) = g.u;
      b(1, 2 * k) = b(3, 2 * k + 1) = g.v;
    }
    const Eigen::Matrix<double, 6, 1> g = rest.area * (b.transpose() * term.slope);
    const Eigen::Matrix<double, 6, 6> h = rest.area * (b.transpose() * term.stiffness * b);
    diagonal += h.trace();
    scatter(rest.corner, g, h);
  }
  for (const auto& s : problem.springs) {
    const Flat step = flat[s.b] - flat[s.a];
    const double l = length(step), miss = l / s.length - 1;
    const Flat n = step * (1 / (l * s.length));
    const Eigen::Vector4d d(-n.u, -n.v, n.u, n.v);
    const std::array<std::uint32_t, 2> ends{s.a, s.b};
    scatter(ends, Eigen::Vector4d(2 * s.weight * miss * d), Eigen::Matrix4d(2 * s.weight * d * d.transpose()));
  }
  for (const auto& h : problem.holds) {
    const int at = 2 * moving.number[h.point];
    if (at < 0) continue;
    slope[at] += 2 * h.weight * flat[h.point].u;
    stiffness.add(at, at, 2 * h.weight);
  }
  // A trace of stiffness everywhere: the whole may be carried and turned without cost, but the system has one answer.
  const double trace = 1e-9 * diagonal / static_cast<double>(moving.unknowns());
  for (int i = 0; i < static_cast<int>(moving.unknowns()); ++i) stiffness.add(i, i, trace);
}

// The smallest positive t at which a triangle's area would vanish along a step.
double firstFold(Flat a, Flat b, Flat c, Flat da, Flat db, Flat dc) {
  const Flat p = b - a, q = c - a, dp = db - da, dq = dc - da;
  const double c0 = cross(p, q), c1 = cross(dp, q) + cross(p, dq), c2 = cross(dp, dq);
  if (std::fabs(c2) < 1e-30) return c1 < 0 ? -c0 / c1 : kInfinite;
  const double root = c1 * c1 - 4 * c2 * c0;
  if (root < 0) return kInfinite;
  const double far = -0.5 * (c1 + std::copysign(std::sqrt(root), c1));
  double best = kInfinite;
  for (double t : {far / c2, far != 0 ? c0 / far : kInfinite})
    if (t > 0 && t < best) best = t;
  return best;
}

// How each point that moves does so when the whole turns about its middle.
Eigen::VectorXd turning(const Moving& moving, std::span<const Flat> flat) {
  Flat middle;
  for (Flat p : flat) middle += p;
  middle = middle * (1.0 / static_cast<double>(flat.size()));
  Eigen::VectorXd r(moving.unknowns());
  for (std::size_t n = 0; n < moving.points.size(); ++n) {
    const Flat t = leftOf(flat[moving.points[n]] - middle);
    r[static_cast<Eigen::Index>(2 * n)] = t.u;
    r[static_cast<Eigen::Index>(2 * n + 1)] = t.v;
  }
  return r;
}

}  // namespace

void minimise(const FlatProblem& problem, std::vector<Flat>& flat, const Token& token) {
  const Moving moving(problem, flat.size());
  double now = energy(problem, moving, flat);
  if (moving.points.empty() || !std::isfinite(now)) return;
  Eigen::SimplicialLDLT<Sparse> solver;
  Eigen::VectorXd slope;
  Summed sum(moving.unknowns());
  bool analysed = false;
  int calm = 0;
  double gained = 0;  // by the last step
  for (int step = 0; step < problem.maxSteps && !token.cancelled(); ++step) {
    derivatives(problem, moving, flat, slope, sum);
    const Sparse& stiffness = sum.end();
    if (!analysed) solver.analyzePattern(stiffness);
    analysed = true;
    solver.factorize(stiffness);
    if (solver.info() != Eigen::Success) return;
    Eigen::VectorXd move = -solver.solve(slope);
    if (problem.holdTurn) {  // the least energy among all that do not turn the whole: one multiplier
      const Eigen::VectorXd turn = turning(moving, flat), answer = solver.solve(turn);
      move -= answer * (turn.dot(move) / turn.dot(answer));
    }
    const double descent = slope.dot(move);
    if (!std::isfinite(descent) || descent >= 0) return;

    const auto stepOf = [&](std::uint32_t p) {
      const Eigen::Index n = 2 * Eigen::Index{moving.number[p]};
      return n < 0 ? Flat{} : Flat{move[n], move[n + 1]};
    };
    double t = 1;
    for (const RestTriangle& rest : moving.rest) {
      const auto& c = rest.corner;
      t = std::fmin(t, 0.8 * firstFold(flat[c[0]], flat[c[1]], flat[c[2]], stepOf(c[0]), stepOf(c[1]), stepOf(c[2])));
    }
    std::vector<Flat> trial = flat;
    double then = kInfinite;
    for (int halving = 0; halving < 40; ++halving, t *= 0.5) {
      for (const std::uint32_t p : moving.points) trial[p] = flat[p] + stepOf(p) * t;
      then = energy(problem, moving, trial);
      if (then <= now + 1e-4 * t * descent) break;
    }
    if (!(then < now)) return;
    const double gain = now - then, enough = problem.enough * std::fmax(then, 1e-12);
    flat = std::move(trial);
    now = then;
    calm = gain <= enough ? calm + 1 : 0;
    // Where steps gain less and less at a quick rate, what is left to gain follows from the last two.
    const bool nothingLeft = t == 1 && gain < 0.1 * gained && gain * gain <= enough * (gained - gain);
    if (calm >= 2 || nothingLeft || now < 1e-16) return;
    gained = gain;
  }
}

}  // namespace karinui
