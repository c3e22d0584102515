#include "geometry/predicates.h"

#include <array>
#include <cstddef>
#include <limits>

namespace karinui {
namespace {

// An exact sum of doubles, smallest first, no two overlapping. Room for Capacity parts; the sizes below are proven
// maxima.
template <std::size_t Capacity>
struct Expansion {
  std::array<double, Capacity> part;
  std::size_t size = 0;

  // Adds one double exactly (Shewchuk's grow-expansion), dropping parts that became zero.
  void add(double value) {
    double sum = value;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double a = sum, b = part[i];
      sum = a + b;
      const double bVirtual = sum - a;
      const double rest = (a - (sum - bVirtual)) + (b - bVirtual);
      if (rest != 0) part[kept++] = rest;
    }
    if (sum != 0) part[kept++] = sum;
    size = kept;
  }
  // Adds value * factor exactly: the product's rounding error is itself a double.
  void addProduct(double value, double factor) {
    const double product = value * factor;
    add(std::fma(value, factor, -product));
    add(product);
  }
  int sign() const { return size == 0 ? 0 : part[size - 1] > 0 ? 1 : -1; }
};

// a - b as two doubles without any loss.
std::array<double, 2> exactDifference(double a, double b) {
  const double difference = a - b;
  const double bVirtual = a - difference;
  return {(a - (difference + bVirtual)) + (bVirtual - b), difference};
}

using Difference = std::array<double, 2>;

// p q - r s, exactly: at most 16 parts.
Expansion<16> minor(const Difference& p, const Difference& q, const Difference& r, const Difference& s) {
  Expansion<16> e;
  for (double x : p)
    for (double y : q) e.addProduct(x, y);
  for (double x : r)
    for (double y : s) e.addProduct(-x, y);
  return e;
}

int exactSide(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Difference ux = exactDifference(b.x, a.x), uy = exactDifference(b.y, a.y), uz = exactDifference(b.z, a.z);
  const Difference vx = exactDifference(c.x, a.x), vy = exactDifference(c.y, a.y), vz = exactDifference(c.z, a.z);
  const Difference wx = exactDifference(d.x, a.x), wy = exactDifference(d.y, a.y), wz = exactDifference(d.z, a.z);
  Expansion<192> determinant;  // three minors of 16 parts, each times 2 parts, each product 2 parts
  const auto addTimes = [&](const Expansion<16>& e, const Difference& w) {
    for (std::size_t i = 0; i < e.size; ++i)
      for (double x : w) determinant.addProduct(e.part[i], x);
  };
  addTimes(minor(uy, vz, uz, vy), wx);
  addTimes(minor(uz, vx, ux, vz), wy);
  addTimes(minor(ux, vy, uy, vx), wz);
  return determinant.sign();
}

int signOf(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;

}  // namespace

int side(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
  const double determinant = (yz - zy) * w.x + (zx - xz) * w.y + (xy - yx) * w.z;
  const double permanent = (std::fabs(yz) + std::fabs(zy)) * std::fabs(w.x) +
                           (std::fabs(zx) + std::fabs(xz)) * std::fabs(w.y) +
                           (std::fabs(xy) + std::fabs(yx)) * std::fabs(w.z);
  // Shewchuk's bound for the first stage of orient3d is (7 + 56 e) e with e half a unit in the last place.
  if (std::fabs(determinant) > 8 * kHalfUlp * permanent) return signOf(determinant);
  // Differences that vanish are exact: two points at one place, or all four on a plane across an axis.
  const auto none = [](double x, double y, double z) { return x == 0 && y == 0 && z == 0; };
  if (none(u.x, v.x, w.x) || none(u.y, v.y, w.y) || none(u.z, v.z, w.z)) return 0;
  for (const Vec3 way : {u, v, w, c - b, d - b, d - c})
    if (none(way.x, way.y, way.z)) return 0;
  return exactSide(a, b, c, d);
}

int side(Flat a, Flat b, Flat c) {
  const double left = (b.u - a.u) * (c.v - a.v), right = (b.v - a.v) * (c.u - a.u);
  const double determinant = left - right;
  if (std::fabs(determinant) > 4 * kHalfUlp * (std::fabs(left) + std::fabs(right))) return signOf(determinant);
  return minor(exactDifference(b.u, a.u), exactDifference(c.v, a.v), exactDifference(b.v, a.v),
               exactDifference(c.u, a.u))
      .sign();
}

}  // namespace karinui
