#pragma once
// The two spaces, as two types the compiler will not mix: Flat is a place (or step) on the paper pattern, Vec3 one in
// the space around the body (y up, right-handed, the body faces +z). Metres.
#include <cmath>

namespace karinui {

struct Flat {
  double u = 0, v = 0;
  bool operator==(const Flat&) const = default;
};
constexpr Flat operator+(Flat a, Flat b) { return {a.u + b.u, a.v + b.v}; }
constexpr Flat operator-(Flat a, Flat b) { return {a.u - b.u, a.v - b.v}; }
constexpr Flat operator-(Flat a) { return {-a.u, -a.v}; }
constexpr Flat operator*(Flat a, double s) { return {a.u * s, a.v * s}; }
constexpr Flat operator*(double s, Flat a) { return a * s; }
constexpr Flat& operator+=(Flat& a, Flat b) { return a = a + b; }
constexpr Flat& operator-=(Flat& a, Flat b) { return a = a - b; }
constexpr double dot(Flat a, Flat b) { return a.u * b.u + a.v * b.v; }
constexpr double cross(Flat a, Flat b) { return a.u * b.v - a.v * b.u; }  // > 0: b is counter-clockwise of a
// Radians from a to b, within half a turn either way; > 0: counter-clockwise.
inline double angleFrom(Flat a, Flat b) { return std::atan2(cross(a, b), dot(a, b)); }
constexpr Flat leftOf(Flat a) { return {-a.v, a.u}; }  // a turned by +90 degrees
inline double length(Flat a) { return std::sqrt(a.u * a.u + a.v * a.v); }
inline double distance(Flat a, Flat b) { return length(b - a); }
inline Flat normalized(Flat a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Flat{};
}
constexpr Flat lerp(Flat a, Flat b, double t) { return a + (b - a) * t; }
inline Flat turned(Flat a, double radians) {  // counter-clockwise
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * a.u - s * a.v, s * a.u + c * a.v};
}
inline bool finite(Flat a) { return std::isfinite(a.u) && std::isfinite(a.v); }

// The smallest upright box about the places included so far.
struct FlatBox {
  Flat low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  constexpr void include(Flat p) {
    low = {p.u < low.u ? p.u : low.u, p.v < low.v ? p.v : low.v};
    high = {p.u > high.u ? p.u : high.u, p.v > high.v ? p.v : high.v};
  }
  constexpr bool empty() const { return low.u > high.u; }
  constexpr Flat size() const { return high - low; }
};

struct Vec3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec3&) const = default;
};
constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
constexpr Vec3& operator*=(Vec3& a, double s) { return a = a * s; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
constexpr double squaredLength(Vec3 a) { return dot(a, a); }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec3 a, Vec3 b) { return length(b - a); }
inline Vec3 normalized(Vec3 a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, double t) { return a + (b - a) * t; }
inline bool finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

// A rigid placement: turn, then carry. Unit quaternion (w, x, y, z).
struct Rigid {
  double w = 1, x = 0, y = 0, z = 0;
  Vec3 carry;
  bool operator==(const Rigid&) const = default;
  Vec3 turned(Vec3 p) const {
    const Vec3 q{x, y, z};
    const Vec3 t = 2 * cross(q, p);
    return p + w * t + cross(q, t);
  }
  Vec3 operator()(Vec3 p) const { return turned(p) + carry; }
};
// first, then second: after(second, first)(p) == second(first(p))
inline Rigid after(const Rigid& s, const Rigid& f) {
  return {s.w * f.w - s.x * f.x - s.y * f.y - s.z * f.z, s.w * f.x + s.x * f.w + s.y * f.z - s.z * f.y,
          s.w * f.y - s.x * f.z + s.y * f.w + s.z * f.x, s.w * f.z + s.x * f.y - s.y * f.x + s.z * f.w, s(f.carry)};
}
inline Rigid inverseOf(const Rigid& r) {
  Rigid out{r.w, -r.x, -r.y, -r.z, {}};
  out.carry = -out.turned(r.carry);
  return out;
}
inline Rigid turnAbout(Vec3 axis, double radians) {
  const Vec3 n = normalized(axis) * std::sin(radians / 2);
  return {std::cos(radians / 2), n.x, n.y, n.z, {}};
}

}  // namespace karinui
