#include <cmath>
#include <map>
#include <numeric>

#include "delaunay.h"
#include "karinui/base/number.h"
#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

std::string atMm(Flat p) {
  std::string words("(");
  words.append(fixed(p.u * 1e3, 1)).append(", ").append(fixed(p.v * 1e3, 1)).append(")");
  return words;
}

Error clashAt(Flat place) {
  return badInput(
      say("The outline crosses or touches itself at {0} mm; draw it so that it stays clear of itself.", atMm(place)));
}

}  // namespace

Result<std::vector<Triangle>> triangulateRegion(std::span<const Flat> points, std::span<const RegionSide> sides,
                                                std::optional<SideClash>* clash) {
  if (clash) clash->reset();
  for (Flat p : points)
    if (!finite(p)) return badInput(say("A place of the outline is not a number; give every place as two lengths."));
  Delaunay mesh(points);
  const auto& corner = mesh.cornerOf();
  // Every directed side, by the corners it joins. Two points at one place may each own sides there.
  std::map<std::array<std::uint32_t, 2>, std::size_t> sideAt;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const std::uint32_t a = corner[sides[k][0]], b = corner[sides[k][1]];
    const auto refuse = [&](std::size_t other) -> Error {
      if (clash) *clash = SideClash{std::min(k, other), std::max(k, other)};
      return clashAt(lerp(points[sides[k][0]], points[sides[k][1]], 0.5));
    };
    if (a == b) return refuse(k);
    const auto [twin, fresh] = sideAt.emplace(std::array{a, b}, k);
    if (!fresh) return refuse(twin->second);
    std::array<std::uint32_t, 2> met{};
    const auto done = mesh.force(a, b, met);
    if (done == Delaunay::Forced::Made) continue;
    std::size_t other = k;
    for (std::size_t j = 0; j < sides.size(); ++j) {
      const std::uint32_t c = corner[sides[j][0]], d = corner[sides[j][1]];
      const bool through = done == Delaunay::Forced::Crossed
                               ? (c == met[0] && d == met[1]) || (c == met[1] && d == met[0])
                               : c == met[0] || d == met[0];
      if (through && j != k) other = j;
    }
    return refuse(other);
  }
  mesh.improve();

  // Inside is what lies left of a side, and everything reached from there without crossing one.
  const auto& faces = mesh.faces();
  std::vector<std::uint8_t> inside(faces.size(), 0);
  std::vector<std::uint32_t> open;
  const auto reach = [&](std::uint32_t face) {
    if (face == Delaunay::kNone || inside[face]) return;
    inside[face] = 1;
    open.push_back(face);
  };
  for (const auto& [ends, k] : sideAt) reach(mesh.leftOf(ends[0], ends[1]));
  while (!open.empty()) {
    const auto& face = faces[open.back()];
    open.pop_back();
    for (int k = 0; k < 3; ++k)
      if (!mesh.forced(face.corner[(k + 1) % 3], face.corner[(k + 2) % 3])) reach(face.beyond[k]);
  }

  // The first point at each corner, and whether there are several.
  constexpr std::uint32_t kNobody = 0xffffffffu;
  std::vector<std::uint32_t> pointAt(points.size() + 3, kNobody);
  std::vector<std::uint8_t> shared(points.size() + 3, 0);
  for (std::uint32_t k = 0; k < points.size(); ++k)
    if (pointAt[corner[k]] == kNobody)
      pointAt[corner[k]] = k;
    else
      shared[corner[k]] = 1;

  // Where several points share a corner, a face belongs to the one whose side bounds its wedge: go round clockwise
  // until a side that leaves the corner with the face on its left.
  const auto pointOf = [&](std::uint32_t face, int at) {
    const std::uint32_t c = faces[face].corner[at];
    if (!shared[c]) return pointAt[c];
    std::uint32_t here = face;
    do {
      int k = 0;
      while (faces[here].corner[k] != c) ++k;
      const auto side = sideAt.find({c, faces[here].corner[(k + 1) % 3]});
      if (side != sideAt.end()) return sides[side->second][0];
      here = faces[here].beyond[(k + 2) % 3];
    } while (here != Delaunay::kNone && here != face);
    return pointAt[c];
  };

  std::vector<Triangle> triangles;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (!inside[f]) continue;
    if (!mesh.real(faces[f])) return clashAt(points[sides[0][0]]);  // the sides do not close
    triangles.push_back({pointOf(f, 0), pointOf(f, 1), pointOf(f, 2)});
  }
  return triangles;
}

Result<std::vector<Triangle>> triangulate(std::span<const Flat> outer, std::span<const Ring> holes,
                                          std::span<const Flat> inner) {
  if (outer.size() < 3) return badInput(say("An outline needs at least three places."));
  std::vector<Flat> points;
  std::vector<RegionSide> sides;
  const auto add = [&](std::span<const Flat> ring, bool counterClockwise) {
    const auto first = static_cast<std::uint32_t>(points.size()), count = static_cast<std::uint32_t>(ring.size());
    points.insert(points.end(), ring.begin(), ring.end());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = first + k, b = first + (k + 1) % count;
      sides.push_back(counterClockwise ? RegionSide{a, b} : RegionSide{b, a});
    }
  };
  add(outer, signedArea(outer) > 0);
  for (const Ring& hole : holes) add(hole, signedArea(hole) < 0);
  points.insert(points.end(), inner.begin(), inner.end());
  return triangulateRegion(points, sides);
}

}  // namespace karinui
