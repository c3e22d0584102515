#include "karinui/pattern/alteration.h"

namespace karinui {
namespace {

bool alike(const Curve& a, const Curve& b) { return a.kind == b.kind && a.between.size() == b.between.size(); }

Curve altered(const Curve& before, const Curve& after, const Curve& other) {
  Curve out = after;
  out.start = other.start + (after.start - before.start);
  out.end = other.end + (after.end - before.end);
  if (alike(before, after) && alike(before, other)) {
    out.control1 = other.control1 + (after.control1 - before.control1);
    out.control2 = other.control2 + (after.control2 - before.control2);
    out.bulge = other.bulge + (after.bulge - before.bulge);
    for (std::size_t i = 0; i < out.between.size(); ++i)
      out.between[i] = other.between[i] + (after.between[i] - before.between[i]);
    return out;
  }
  // The new curve, carried along with its ends: less of one end's way the farther it is from it.
  const Flat first = out.start - after.start, last = out.end - after.end, along = after.end - after.start;
  const double whole = dot(along, along);
  const auto carried = [&](Flat p) {
    const double t = whole > 0 ? dot(p - after.start, along) / whole : 0.5;
    return p + lerp(first, last, t < 0 ? 0 : t > 1 ? 1 : t);
  };
  out.control1 = carried(after.control1), out.control2 = carried(after.control2);
  for (Flat& p : out.between) p = carried(p);
  return out;
}

}  // namespace

Result<Outline> alteredAlike(const Outline& before, const Outline& after, const Outline& other) {
  const std::size_t n = before.edges.size();
  bool same = after.edges.size() == n && other.edges.size() == n;
  for (std::size_t i = 0; same && i < n; ++i)
    same = before.edges[i].name == after.edges[i].name && before.edges[i].name == other.edges[i].name;
  if (!same) return refused(say("The two sizes have other edges; an alteration of one cannot be done to the other."));
  Outline out;
  for (std::size_t i = 0; i < n; ++i)
    out.edges.push_back(
        {other.edges[i].name, altered(before.edges[i].curve, after.edges[i].curve, other.edges[i].curve)});
  for (std::size_t i = 0; i < n; ++i) out.edges[(i + 1) % n].curve.start = out.edges[i].curve.end;
  return checked(std::move(out));
}

}  // namespace karinui
