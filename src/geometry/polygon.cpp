#include "karinui/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/geos.h"

namespace karinui {

double signedArea(std::span<const Flat> ring) {
  double twice = 0;
  // About the first point, so that a small piece far from the origin loses nothing.
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) twice += cross(ring[k] - ring[0], ring[k + 1] - ring[0]);
  return twice / 2;
}

double perimeter(std::span<const Flat> ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) sum += distance(ring[k], ring[(k + 1) % ring.size()]);
  return sum;
}

FlatBox boxOf(std::span<const Flat> places) {
  FlatBox box;
  for (const Flat p : places) box.include(p);
  return box;
}

bool contains(std::span<const Flat> ring, Flat place) {
  bool inside = false;
  for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
    const Flat a = ring[before], b = ring[k];
    if ((a.v > place.v) == (b.v > place.v)) continue;
    const double side = cross(b - a, place - a);
    if ((side > 0) == (b.v > a.v)) inside = !inside;
  }
  return inside;
}

double distanceToRing(std::span<const Flat> ring, Flat place) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ring.size(); ++k)
    best = std::min(best, distanceToSegment(ring[k], ring[(k + 1) % ring.size()], place));
  return best;
}

double distanceToSegment(Flat a, Flat b, Flat place) {
  const Flat along = b - a;
  const double squared = dot(along, along);
  const double t = squared > 0 ? std::clamp(dot(place - a, along) / squared, 0.0, 1.0) : 0.0;
  return distance(lerp(a, b, t), place);
}

std::optional<Flat> crossing(std::span<const Flat> ring) {
  if (ring.size() < 3) return ring.empty() ? Flat{} : ring[0];
  const Geos geos;
  GEOSContextHandle_t c = geos.context;
  GEOSGeometry* shell = GEOSGeom_createLinearRing_r(c, geos.places(ring));  // owns the places, even when it fails
  geos.check();
  if (!shell) return ring[0];
  const Geos::Geometry polygon = geos.own(GEOSGeom_createPolygon_r(c, shell, nullptr, 0));
  if (!polygon) return ring[0];
  GEOSGeometry* marked = nullptr;
  const char valid = GEOSisValidDetail_r(c, polygon.get(), 0, nullptr, &marked);
  const Geos::Geometry where = geos.own(marked);
  if (valid == 1) return std::nullopt;
  Flat place = ring[0];
  if (where) {
    GEOSGeomGetX_r(c, where.get(), &place.u);
    GEOSGeomGetY_r(c, where.get(), &place.v);
  }
  return place;
}

}  // namespace karinui
