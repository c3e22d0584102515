#include "design/operations/place_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "design/operations/tapered_tube.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kRound = 2e-4;     // metres an inner edge may depart from its circle, a side from its ray
constexpr double kApart = 0.01;     // radians left between the two sides of a ring that goes all round
constexpr double kAbove = 0.01;     // metres: skin this far above the inner edge counts as well
constexpr double kFlattest = 1e-3;  // metres from the apex of a cone down to its inner edge
constexpr double kFurthest = 1.5;   // metres a cone may stand off
constexpr double kWound = 0.01;     // metres from turn to turn at the inner edge, which a drape closes
constexpr double kRuled = 0.002;    // metres between rulings there

std::optional<Flat> middleOf(const Curve& arc) {
  const Flat a = arc.start, b = arc.at(0.5), c = arc.end;
  const double d = 2 * (a.u * (b.v - c.v) + b.u * (c.v - a.v) + c.u * (a.v - b.v));
  if (std::fabs(d) < 1e-9) return std::nullopt;
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  return Flat{(aa * (b.v - c.v) + bb * (c.v - a.v) + cc * (a.v - b.v)) / d,
              (aa * (c.u - b.u) + bb * (a.u - c.u) + cc * (b.u - a.u)) / d};
}

// The cone with its apex `up` above the inner edge's level that goes round all the skin.
struct Tent {
  Ring base;                   // on the level of the inner edge
  double total = 0, drop = 0;  // angle of all its rulings; how far below the apex the inner edge hangs, on average
};
Tent tentOf(const std::vector<SkinPlace>& skin, Flat axis, double up, double ease, double inner) {
  std::vector<Flat> seen;
  for (const SkinPlace& p : skin)
    if (p.height <= kAbove) {
      const double scale = up / (up - std::fmin(p.height, 0));
      seen.push_back(axis + (p.place - axis) * scale);
    }
  Tent tent;
  tent.base = grown(hull(std::move(seen)), std::fmax(ease, 1e-4));
  const auto n = tent.base.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Flat a = tent.base[i] - axis, b = tent.base[(i + 1) % n] - axis;
    const double la = std::hypot(length(a), up), lb = std::hypot(length(b), up);
    const double part = std::acos(std::clamp((dot(a, b) + up * up) / (la * lb), -1.0, 1.0));
    tent.total += part;
    tent.drop += part * inner * up * 0.5 * (1 / la + 1 / lb);
  }
  if (tent.total > 0) tent.drop /= tent.total;
  return tent;
}

// The middle of what the inner edge goes round.
Flat axisOf(const std::vector<SkinPlace>& skin) {
  std::vector<Flat> level;
  for (const SkinPlace& p : skin)
    if (std::fabs(p.height) <= kAbove) level.push_back(p.place);
  if (level.size() < 3)
    for (const SkinPlace& p : skin) level.push_back(p.place);
  Flat axis;
  const Ring waist = hull(level);
  for (const Flat p : waist) axis += p * (1.0 / static_cast<double>(waist.size()));
  return axis;
}

// The height of the apex at which the inner edge hangs at its level: the drop falls behind the height as that grows. 0:
// it is too short to go round even flat.
std::pair<double, Tent> tentHung(const RingSector& sector, const std::vector<SkinPlace>& skin, Flat axis, double off) {
  double low = kFlattest, high = sector.inner + 0.01;
  Tent tent = tentOf(skin, axis, low, off, sector.inner);
  if (tent.drop <= low) return {0, tent};
  for (int i = 0; i < 60; ++i) {
    const double up = 0.5 * (low + high);
    tent = tentOf(skin, axis, up, off, sector.inner);
    (tent.drop > up ? low : high) = up;
  }
  return {high, tentOf(skin, axis, high, off, sector.inner)};
}

// All but flat the drop is in proportion to the radius, and has to be more than the height.
Error tooShort(const RingSector& sector, const Tent& tent) {
  const double has = sector.angle * sector.inner, needs = has * kFlattest / tent.drop;
  return refused(
      say("The inner edge of this ring is {0} mm too short to hang there: it has {1} mm, and a sector of {2} degrees "
          "needs {3} mm to go round there with its ease. Draw the edge longer or the sector narrower, or place it "
          "with less ease.",
          std::floor((needs - has) * 1000) + 1, fixed(has * 1000, 0), fixed(sector.angle * 180 / std::numbers::pi, 0),
          std::floor(needs * 1000) + 1));
}

}  // namespace

std::optional<RingSector> sectorOf(const Piece& piece) {
  const auto& edges = piece.outline.edges;
  const std::size_t n = edges.size();
  for (std::size_t k = 0; k < n && n >= 4; ++k) {
    const Curve& arc = edges[k].curve;
    if (arc.kind == Curve::Kind::Line) continue;
    const auto middle = middleOf(arc);
    if (!middle) continue;
    const double inner = distance(*middle, arc.start);
    const auto round = arc.flattened(1e-5);
    if (!std::all_of(round.begin(), round.end(),
                     [&](Flat p) { return std::fabs(distance(*middle, p) - inner) < kRound; }))
      continue;
    // The middle lies to the outline's right, where there is no cloth: an inner edge.
    if (cross(arc.tangent(0.5), *middle - arc.at(0.5)) > 0) continue;
    const Curve &in = edges[(k + n - 1) % n].curve, &out = edges[(k + 1) % n].curve;
    const auto leads = [&](const Curve& side, Flat near, Flat far) {
      const Flat way = normalized(far - near);
      return side.kind == Curve::Kind::Line && std::fabs(cross(way, near - *middle)) < kRound &&
             dot(way, near - *middle) > 0;
    };
    if (!leads(in, in.end, in.start) || !leads(out, out.start, out.end)) continue;
    RingSector sector;
    sector.middle = *middle;
    sector.inner = inner;
    sector.angle = arc.length() / inner;
    sector.towards = normalized(arc.at(0.5) - *middle);
    for (const Flat p : piece.outline.flattened(1e-3))
      sector.depth = std::fmax(sector.depth, distance(*middle, p) - inner);
    return sector;
  }
  return std::nullopt;
}

Vec3 Cone::place(Flat paper) const {
  const Flat from = paper - sector.middle;
  const double r = length(from);
  double phi = start + std::atan2(cross(sector.towards, from), dot(sector.towards, from));
  const double total = angle.back();
  if (closed) phi -= std::floor(phi / total) * total;
  const auto next = std::upper_bound(angle.begin(), angle.end(), phi);
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next - angle.begin(), 1,
                                                                     static_cast<std::ptrdiff_t>(angle.size()) - 1)) -
                 1;
  const double part = angle[i + 1] - angle[i];
  // Along the great circle, so that angles between rulings are kept.
  const double t = part > 0 ? (phi - angle[i]) / part : 0;
  if (part < 1e-9) return apex + ruling[i] * r;
  const Vec3 way =
      ruling[i] * (std::sin((1 - t) * part) / std::sin(part)) + ruling[i + 1] * (std::sin(t * part) / std::sin(part));
  return apex + normalized(way) * r;
}

Result<Cone> coneRound(const RingSector& sector, const LimbFrame& limb, const std::vector<SkinPlace>& skin,
                       double ease) {
  const Flat axis = axisOf(skin);
  const auto hung = [&](double off) { return tentHung(sector, skin, axis, off); };
  const double needed = sector.angle + kApart;
  double off = ease;
  auto found = hung(off);
  if (found.first == 0) return tooShort(sector, found.second);
  if (found.second.total < needed) {
    double low = ease, high = kFurthest;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      const auto tried = hung(middle);
      (tried.first > 0 && tried.second.total < needed ? low : high) = middle;
    }
    found = hung(low);
    // A sector this wide lies flat: there is no cone of it that hangs at that level.
    if (found.first == 0 || found.second.total < sector.angle)
      return refused(say("A sector of {0} degrees is too wide to stand as a cone there; cut it in more pieces.",
                         fixed(sector.angle * 180 / std::numbers::pi, 0)));
  }
  const auto& [up, tent] = found;
  Cone cone;
  cone.sector = sector;
  cone.apex = limb.inSpace(axis, up);
  for (std::size_t i = 0; i <= tent.base.size(); ++i) {
    const Vec3 ruling = normalized(limb.inSpace(tent.base[i % tent.base.size()], 0) - cone.apex);
    const double part = cone.ruling.empty() ? 0 : std::acos(std::clamp(dot(cone.ruling.back(), ruling), -1.0, 1.0));
    cone.angle.push_back(cone.angle.empty() ? 0 : cone.angle.back() + part);
    cone.ruling.push_back(ruling);
  }
  // The sector's middle comes where the limb's origin is.
  double nearest = 1e9;
  const Vec3 front = normalized(limb.origin - cone.apex);
  for (std::size_t i = 0; i + 1 < cone.ruling.size(); ++i)
    if (const double d = distance(cone.ruling[i], front); d < nearest) nearest = d, cone.start = cone.angle[i];
  return cone;
}

Result<Cone> coneWound(const RingSector& sector, const LimbFrame& limb, const std::vector<SkinPlace>& skin, double ease,
                       bool endOnTop) {
  const Flat axis = axisOf(skin);
  const auto [up, tent] = tentHung(sector, skin, axis, ease);
  if (up == 0) return tooShort(sector, tent);
  const Girth girth(tent.base);
  const double anchor = girth.nearest({0, -ease}), half = girth.length() * sector.angle / tent.total / 2;
  Cone cone;
  cone.sector = sector;
  cone.closed = false;
  cone.apex = limb.inSpace(axis, up);
  const auto ruling = [&](double s) {
    const double beneath = std::fmax(0, endOnTop ? s + half : half - s);  // from the end that lies at the bottom
    const Flat base = girth.at(anchor + s) + girth.outwards(anchor + s) * (kWound * beneath / girth.length());
    return normalized(limb.inSpace(base, 0) - cone.apex);
  };
  // A turn that lies on another is wider than that: measured along itself, both ways from the middle.
  const auto walk = [&](double step) {
    std::vector<std::pair<double, Vec3>> all{{0, ruling(0)}};
    for (double s = step; all.back().first < sector.angle / 2; s += step) {
      const Vec3 next = ruling(s);
      all.emplace_back(all.back().first + std::acos(std::clamp(dot(all.back().second, next), -1.0, 1.0)), next);
    }
    return all;
  };
  const auto before = walk(-kRuled), after = walk(kRuled);
  cone.start = before.back().first;
  for (auto k = before.rbegin(); k != before.rend(); ++k)
    cone.angle.push_back(cone.start - k->first), cone.ruling.push_back(k->second);
  for (auto k = after.begin() + 1; k != after.end(); ++k)
    cone.angle.push_back(cone.start + k->first), cone.ruling.push_back(k->second);
  return cone;
}

double shareOf(const RingSector& sector, Flat paper) {
  const Flat from = paper - sector.middle;
  return std::atan2(cross(sector.towards, from), dot(sector.towards, from)) / sector.angle;
}

}  // namespace karinui
