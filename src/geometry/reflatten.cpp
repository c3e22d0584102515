// A drape's own strain must not go into the paper: only what was changed in space since may.
#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "geometry/membrane.h"
#include "karinui/geometry/flatten.h"

namespace karinui {
namespace {

Eigen::Matrix2d edges(const std::array<Flat, 3>& t) {
  Eigen::Matrix2d m;
  m << t[1].u - t[0].u, t[2].u - t[0].u, t[1].v - t[0].v, t[2].v - t[0].v;
  return m;
}

// The stretch part U of A = R U.
Eigen::Matrix2d stretchPart(const Eigen::Matrix2d& a) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(a.transpose() * a);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

// Carries and turns `flat` so that its unchanged parts lie where they lay.
void alignTo(std::span<const Flat> old, std::span<const double> weight, std::vector<Flat>& flat) {
  Flat a, b;
  double whole = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    a += flat[i] * weight[i];
    b += old[i] * weight[i];
    whole += weight[i];
  }
  if (!(whole > 0)) return;
  a = a * (1 / whole);
  b = b * (1 / whole);
  double c = 0, s = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    c += weight[i] * dot(flat[i] - a, old[i] - b);
    s += weight[i] * cross(flat[i] - a, old[i] - b);
  }
  const double l = std::hypot(c, s);
  if (!(l > 0)) return;
  c /= l;
  s /= l;
  for (Flat& p : flat) {
    const Flat q = p - a;
    p = b + Flat{c * q.u - s * q.v, s * q.u + c * q.v};
  }
}

}  // namespace

// With G the map paper -> space before and U the stretch in space since, cloth of the shape G^-1 U G (paper) is
// strained after as the old cloth was before.
Result<std::vector<Flat>> reflatten(std::span<const Flat> flat, std::span<const Triangle> faces,
                                    std::span<const Vec3> before, std::span<const Vec3> after, const Token& token) {
  KARINUI_ASSERT(flat.size() == before.size() && before.size() == after.size());
  const TriangleMesh was{{before.begin(), before.end()}, {}}, is{{after.begin(), after.end()}, {}};
  std::vector<RestTriangle> rest;
  std::vector<double> weight(flat.size(), 1.0);
  double most = 0;
  for (const Triangle& t : faces) {
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return before[v] == after[v]; })) continue;
    const std::array<Flat, 3> paper{flat[t[0]], flat[t[1]], flat[t[2]]};
    const Eigen::Matrix2d p = edges(paper), b = edges(laidFace(was, t));
    if (!(p.determinant() > 0) || !(std::fabs(b.determinant()) > 1e-14)) continue;
    const Eigen::Matrix2d u = stretchPart(edges(laidFace(is, t)) * b.inverse()), g = b * p.inverse();
    const Eigen::Matrix2d wanted = g.inverse() * u * g * p;
    if (!wanted.allFinite() || !(wanted.determinant() > 0))
      return refused(say("The cloth was pulled so far that it folds over."));
    const double change = (u - Eigen::Matrix2d::Identity()).norm();
    most = std::fmax(most, change);
    for (std::uint32_t v : t) weight[v] = std::fmin(weight[v], std::exp(-change * change / (0.003 * 0.003)) + 1e-6);
    rest.push_back(
        restTriangle(t, Flat{0, 0}, Flat{wanted(0, 0), wanted(1, 0)}, Flat{wanted(0, 1), wanted(1, 1)}, 0.01));
  }
  // What did not move in space stays on paper; where too little stayed, the rest is aligned to what moved least.
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double moved = distance(before[i], after[i]) / 0.001;
    weight[i] *= std::exp(-moved * moved) + 1e-6;
  }
  std::vector<Flat> out(flat.begin(), flat.end());
  if (most < 1e-9) return out;
  if (!foldFree(rest, out)) return refused(say("The piece's flat shape has folds; draw it anew."));
  FlatProblem problem;
  problem.rest = rest;
  problem.law = symmetricDirichlet;
  problem.enough = 1e-8;
  for (std::size_t i = 0; i < flat.size(); ++i) problem.pinned.push_back(before[i] == after[i] ? 1 : 0);
  minimise(problem, out, token);
  if (token.cancelled()) return cancelled();
  if (std::count(problem.pinned.begin(), problem.pinned.end(), 1) < 2) alignTo(flat, weight, out);
  return out;
}

}  // namespace karinui
