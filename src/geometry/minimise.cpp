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

double energy(const FlatProblem& problem, std::span<const Flat> flat) {
  double sum = 0;
  for (const RestTriangle& rest : problem.rest) {
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

// Slope and stiffness of the whole; point p owns unknowns 2p (u) and 2p + 1 (v).
void derivatives(const FlatProblem& problem, std::span<const Flat> flat, Eigen::VectorXd& slope, Sparse& stiffness) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(problem.rest.size() * 36 + problem.springs.size() * 16 + 2 * flat.size());
  slope.setZero(static_cast<Eigen::Index>(2 * flat.size()));
  const auto stays = [&](int unknown) {
    return !problem.pinned.empty() && problem.pinned[static_cast<std::size_t>(unknown) / 2] != 0;
  };
  const auto scatter = [&](std::span<const int> at, const auto& g, const auto& h) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (stays(at[i])) continue;
      slope[at[i]] += g[static_cast<Eigen::Index>(i)];
      for (std::size_t j = 0; j < at.size(); ++j)
        if (!stays(at[j]))
          entries.emplace_back(at[i], at[j], h(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  };
  double diagonal = 0;
  for (const RestTriangle& rest : problem.rest) {
    const MembraneTerm term = problem.law(gradientOf(rest, flat), true);
    Eigen::Matrix<double, 4, 6> b = Eigen::Matrix<double, 4, 6>::Zero();
    std::array<int, 6> at{};
    for (int k = 0; k < 3; ++k) {
      const Flat g = rest.gradient[static_cast<std::size_t>(k)];
      b(0, 2 * k) = b(2, 2 * k + 1) = g.u;
      b(1, 2 * k) = b(3, 2 * k + 1) = g.v;
      const int p = static_cast<int>(rest.corner[static_cast<std::size_t>(k)]);
      at[static_cast<std::size_t>(2 * k)] = 2 * p;
      at[static_cast<std::size_t>(2 * k + 1)] = 2 * p + 1;
    }
    const Eigen::Matrix<double, 6, 1> g = rest.area * (b.transpose() * term.slope);
    const Eigen::Matrix<double, 6, 6> h = rest.area * (b.transpose() * term.stiffness * b);
    diagonal += h.trace();
    scatter(at, g, h);
  }
  for (const auto& s : problem.springs) {
    const Flat step = flat[s.b] - flat[s.a];
    const double l = length(step), miss = l / s.length - 1;
    const Flat n = step * (1 / (l * s.length));
    const Eigen::Vector4d d(-n.u, -n.v, n.u, n.v);
    const std::array<int, 4> at{static_cast<int>(2 * s.a), static_cast<int>(2 * s.a + 1), static_cast<int>(2 * s.b),
                                static_cast<int>(2 * s.b + 1)};
    scatter(at, Eigen::Vector4d(2 * s.weight * miss * d), Eigen::Matrix4d(2 * s.weight * d * d.transpose()));
  }
  for (const auto& h : problem.holds) {
    slope[static_cast<int>(2 * h.point)] += 2 * h.weight * flat[h.point].u;
    entries.emplace_back(static_cast<int>(2 * h.point), static_cast<int>(2 * h.point), 2 * h.weight);
  }
  // A trace of stiffness everywhere: the whole may be carried and turned without cost, but the system has one answer.
  const double trace = 1e-9 * diagonal / static_cast<double>(2 * flat.size());
  for (int i = 0; i < static_cast<int>(2 * flat.size()); ++i) entries.emplace_back(i, i, trace);
  stiffness.resize(static_cast<Eigen::Index>(2 * flat.size()), static_cast<Eigen::Index>(2 * flat.size()));
  stiffness.setFromTriplets(entries.begin(), entries.end());
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

// How each point moves when the whole turns about its middle.
Eigen::VectorXd turning(std::span<const Flat> flat) {
  Flat middle;
  for (Flat p : flat) middle += p;
  middle = middle * (1.0 / static_cast<double>(flat.size()));
  Eigen::VectorXd r(static_cast<Eigen::Index>(2 * flat.size()));
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Flat t = leftOf(flat[i] - middle);
    r[static_cast<Eigen::Index>(2 * i)] = t.u;
    r[static_cast<Eigen::Index>(2 * i + 1)] = t.v;
  }
  return r;
}

}  // namespace

void minimise(const FlatProblem& problem, std::vector<Flat>& flat, const Token& token) {
  double now = energy(problem, flat);
  if (!std::isfinite(now)) return;
  Eigen::SimplicialLDLT<Sparse> solver;
  Eigen::VectorXd slope;
  Sparse stiffness;
  bool analysed = false;
  int calm = 0;
  for (int step = 0; step < problem.maxSteps && !token.cancelled(); ++step) {
    derivatives(problem, flat, slope, stiffness);
    if (!analysed) solver.analyzePattern(stiffness);
    analysed = true;
    solver.factorize(stiffness);
    if (solver.info() != Eigen::Success) return;
    Eigen::VectorXd move = -solver.solve(slope);
    if (problem.holdTurn) {  // the least energy among all that do not turn the whole: one multiplier
      const Eigen::VectorXd turn = turning(flat), answer = solver.solve(turn);
      move -= answer * (turn.dot(move) / turn.dot(answer));
    }
    const double descent = slope.dot(move);
    if (!std::isfinite(descent) || descent >= 0) return;

    const auto stepOf = [&](std::uint32_t p) {
      return Flat{move[static_cast<Eigen::Index>(2 * p)], move[static_cast<Eigen::Index>(2 * p + 1)]};
    };
    double t = 1;
    for (const RestTriangle& rest : problem.rest) {
      const auto& c = rest.corner;
      t = std::fmin(t, 0.8 * firstFold(flat[c[0]], flat[c[1]], flat[c[2]], stepOf(c[0]), stepOf(c[1]), stepOf(c[2])));
    }
    std::vector<Flat> trial(flat.size());
    double then = kInfinite;
    for (int halving = 0; halving < 40; ++halving, t *= 0.5) {
      for (std::uint32_t p = 0; p < flat.size(); ++p) trial[p] = flat[p] + stepOf(p) * t;
      then = energy(problem, trial);
      if (then <= now + 1e-4 * t * descent) break;
    }
    if (!(then < now)) return;
    const double gain = now - then;
    flat = std::move(trial);
    now = then;
    calm = gain <= problem.enough * std::fmax(now, 1e-12) ? calm + 1 : 0;
    if (calm >= 2 || now < 1e-16) return;
  }
}

}  // namespace karinui
