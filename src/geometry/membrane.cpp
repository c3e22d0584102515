#include "geometry/membrane.h"

#include <algorithm>
#include <cmath>

namespace karinui {

RestTriangle restTriangle(const Triangle& corner, Flat a, Flat b, Flat c, double thinnest) {
  RestTriangle rest;
  rest.corner = corner;
  double twice = cross(b - a, c - a);
  const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
  if (twice < thinnest * longest * longest) {
    // Move the corner opposite the longest side out to the least height.
    Flat *p = &a, *q = &b, *r = &c;
    if (distance(b, c) >= longest) {
      p = &b, q = &c, r = &a;
    } else if (distance(c, a) >= longest) {
      p = &c, q = &a, r = &b;
    }
    const Flat side = normalized(*q - *p);
    const Flat base = *p + side * std::clamp(dot(*r - *p, side), 0.0, longest);
    *r = base + leftOf(side) * (thinnest * longest);
    twice = cross(b - a, c - a);
  }
  rest.area = twice / 2;
  rest.x = a;
  rest.y = b;
  rest.z = c;
  rest.gradient = {leftOf(c - b) * (1 / twice), leftOf(a - c) * (1 / twice), leftOf(b - a) * (1 / twice)};
  return rest;
}

std::array<Flat, 3> laidFace(const TriangleMesh& sheet, const Triangle& face) {
  const Vec3 a = sheet.points[face[0]], ab = sheet.points[face[1]] - a, ac = sheet.points[face[2]] - a;
  const double base = length(ab);
  const double along = base > 0 ? dot(ab, ac) / base : 0;
  const double height = base > 0 ? length(cross(ab, ac)) / base : length(ac);
  return {Flat{0, 0}, Flat{base, 0}, Flat{along, height}};
}

std::vector<RestTriangle> restOf(const TriangleMesh& sheet, double thinnest) {
  std::vector<RestTriangle> rest;
  rest.reserve(sheet.faces.size());
  for (const Triangle& face : sheet.faces) {
    const auto laid = laidFace(sheet, face);
    rest.push_back(restTriangle(face, laid[0], laid[1], laid[2], thinnest));
  }
  return rest;
}

Gradient gradientOf(const RestTriangle& rest, std::span<const Flat> flat) {
  Gradient f = Gradient::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat p = flat[rest.corner[k]], g = rest.gradient[k];
    f[0] += p.u * g.u;
    f[1] += p.u * g.v;
    f[2] += p.v * g.u;
    f[3] += p.v * g.v;
  }
  return f;
}

bool foldFree(std::span<const RestTriangle> rest, std::span<const Flat> flat) {
  return std::all_of(rest.begin(), rest.end(), [&](const RestTriangle& t) {
    const double j = determinant(gradientOf(t, flat));
    return std::isfinite(j) && j > 0;
  });
}

// With I = |F|^2 and J = det F the energy is I + I / J^2. Of the second derivative's four eigenvalues only that of the
// twist, which turns F by its own rotation and a quarter, can be below zero (Smith, de Goes and Kim: Analytic
// Eigensystems for Isotropic Distortion Energies, 2019); it is raised to zero, so that Newton always goes downhill.
MembraneTerm symmetricDirichlet(const Gradient& f, bool derivatives) {
  MembraneTerm term;
  const double i = f.squaredNorm(), j = determinant(f), j2 = 1 / (j * j);
  term.value = i * (1 + j2) - 4;
  if (!derivatives) return term;
  const Eigen::Vector4d dj(f[3], -f[2], -f[1], f[0]);
  const double j3 = j2 / j, j4 = j2 * j2;
  term.slope = 2 * (1 + j2) * f - 2 * i * j3 * dj;
  const Eigen::Vector4d across = 3 * i * j4 * dj - 4 * j3 * f;
  term.stiffness = across * dj.transpose() + dj * across.transpose();
  term.stiffness.diagonal().array() += 2 * (1 + j2);
  const double bent = 2 * i * j3;  // by the second derivative of J
  term.stiffness(0, 3) -= bent, term.stiffness(3, 0) -= bent;
  term.stiffness(1, 2) += bent, term.stiffness(2, 1) += bent;
  const double twist = 2 - 2 * (i - j) * j3;
  if (twist < 0) {
    const double c = f[0] + f[3], s = f[2] - f[1];  // the rotation's cosine and sine, times the sum of stretches
    const Eigen::Vector4d t(-s, -c, c, -s);
    term.stiffness -= twist / (2 * (c * c + s * s)) * t * t.transpose();
  }
  return term;
}

// The columns of F^-1 are what a step along weft and along warp becomes in the sheet.
ClothStretch stretchOf(const Gradient& f) {
  const double j = determinant(f), p = std::hypot(f[2], f[3]), q = std::hypot(f[0], f[1]);
  return {p / j, q / j, -(f[0] * f[2] + f[1] * f[3]) / (p * q)};
}

MembraneTerm FabricLaw::operator()(const Gradient& f, bool derivatives) const {
  MembraneTerm term = symmetricDirichlet(f, derivatives && keep > 0);
  term.value *= keep;
  const ClothStretch s = stretchOf(f);
  term.value += warp * (s.warp - 1) * (s.warp - 1) + weft * (s.weft - 1) * (s.weft - 1) + shear * s.cosine * s.cosine;
  if (!derivatives) return term;
  term.slope *= keep;
  term.stiffness *= keep;
  const double j = determinant(f), p = std::hypot(f[2], f[3]), q = std::hypot(f[0], f[1]);
  const Eigen::Vector4d dj(f[3], -f[2], -f[1], f[0]);
  const Eigen::Vector4d dp(0, 0, f[2] / p, f[3] / p), dq(f[0] / q, f[1] / q, 0, 0);
  const Eigen::Vector4d dn(f[2], f[3], f[0], f[1]);
  const double n = f[0] * f[2] + f[1] * f[3];
  const auto add = [&](double weight, double residual, const Eigen::Vector4d& slope) {  // Gauss-Newton
    term.slope += 2 * weight * residual * slope;
    term.stiffness += 2 * weight * slope * slope.transpose();
  };
  add(weft, s.weft - 1, dp / j - p / (j * j) * dj);
  add(warp, s.warp - 1, dq / j - q / (j * j) * dj);
  add(shear, s.cosine, -dn / (p * q) + n / (p * p * q * q) * (dp * q + p * dq));
  return term;
}

}  // namespace karinui
