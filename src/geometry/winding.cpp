#include "karinui/geometry/winding.h"

#include <algorithm>
#include <vector>

#include "geometry/geos.h"

namespace karinui {

namespace {

// The closed line, divided wherever it meets itself.
Geos::Geometry noded(const Geos& geos, std::span<const Flat> ring) {
  const Geos::Geometry line = geos.own(GEOSGeom_createLineString_r(geos.context, geos.places(ring)));
  return geos.own(line ? GEOSUnaryUnion_r(geos.context, line.get()) : nullptr);
}

Ring ringOf(GEOSContextHandle_t c, const GEOSGeometry* polygon) {
  const GEOSGeometry* outer = GEOSGetExteriorRing_r(c, polygon);
  const GEOSCoordSequence* around = outer ? GEOSGeom_getCoordSeq_r(c, outer) : nullptr;
  unsigned count = 0;
  Ring ring;
  if (!around || !GEOSCoordSeq_getSize_r(c, around, &count)) return ring;
  for (unsigned i = 0; i + 1 < count; ++i) {
    Flat p;
    GEOSCoordSeq_getXY_r(c, around, i, &p.u, &p.v);
    ring.push_back(p);
  }
  if (signedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace

int turnsRound(std::span<const Flat> ring, Flat place) {
  int turns = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Flat a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.v > place.v) == (b.v > place.v)) continue;
    const bool left = cross(b - a, place - a) > 0;
    if (b.v > a.v && left) ++turns;
    if (b.v < a.v && !left) --turns;
  }
  return turns;
}

Ring outlineOfTurns(std::span<const Flat> ring, bool clockwise) {
  if (ring.size() < 3) return {};
  const Geos geos;
  GEOSContextHandle_t c = geos.context;
  const Geos::Geometry line = noded(geos, ring);
  if (!line) return {};
  const GEOSGeometry* const lines[] = {line.get()};
  const Geos::Geometry faces = geos.own(GEOSPolygonize_r(c, lines, 1));
  if (!faces) return {};
  std::vector<Geos::Geometry> kept;
  for (int i = 0; i < GEOSGetNumGeometries_r(c, faces.get()); ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(c, faces.get(), i);
    const Geos::Geometry inner = geos.own(GEOSPointOnSurface_r(c, face));
    Flat place;
    if (!inner || !GEOSGeomGetX_r(c, inner.get(), &place.u) || !GEOSGeomGetY_r(c, inner.get(), &place.v)) continue;
    const int turns = turnsRound(ring, place);
    if (clockwise ? turns < 0 : turns > 0) kept.push_back(geos.own(GEOSGeom_clone_r(c, face)));
  }
  if (kept.empty()) return {};
  std::vector<GEOSGeometry*> handed;  // the collection owns them
  handed.reserve(kept.size());
  for (Geos::Geometry& face : kept) handed.push_back(face.release());
  const Geos::Geometry all = geos.own(
      GEOSGeom_createCollection_r(c, GEOS_GEOMETRYCOLLECTION, handed.data(), static_cast<unsigned>(handed.size())));
  const Geos::Geometry whole = geos.own(all ? GEOSUnaryUnion_r(c, all.get()) : nullptr);
  Ring best;
  for (int i = 0; whole && i < GEOSGetNumGeometries_r(c, whole.get()); ++i) {
    const GEOSGeometry* part = GEOSGetGeometryN_r(c, whole.get(), i);
    if (GEOSGeomTypeId_r(c, part) != GEOS_POLYGON) continue;
    if (Ring one = ringOf(c, part); best.empty() || signedArea(one) > signedArea(best)) best = std::move(one);
  }
  return best;
}

}  // namespace karinui
