// A ring and what lies near it (GEOS' buffer).
#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/nest.h"

namespace karinui {

Ring widened(const Ring& ring, double by) {
  constexpr int kQuarter = 6;  // chords of a quarter circle; their miss is taken off by a larger radius
  const double radius = by / std::cos(std::numbers::pi / 4 / kQuarter);
  const GEOSContextHandle_t c = GEOS_init_r();
  GEOSCoordSequence* places = GEOSCoordSeq_create_r(c, static_cast<unsigned>(ring.size() + 1), 2);
  KARINUI_ASSERT(places);
  for (std::size_t k = 0; k <= ring.size(); ++k)
    GEOSCoordSeq_setXY_r(c, places, static_cast<unsigned>(k), ring[k % ring.size()].u, ring[k % ring.size()].v);
  GEOSGeometry* shell = GEOSGeom_createLinearRing_r(c, places);
  GEOSGeometry* polygon = shell ? GEOSGeom_createPolygon_r(c, shell, nullptr, 0) : nullptr;
  GEOSGeometry* wide = polygon ? GEOSBuffer_r(c, polygon, radius, kQuarter) : nullptr;
  Ring out;
  if (wide && GEOSGeomTypeId_r(c, wide) == GEOS_POLYGON) {
    const GEOSGeometry* border = GEOSGetExteriorRing_r(c, wide);
    const GEOSCoordSequence* found = border ? GEOSGeom_getCoordSeq_r(c, border) : nullptr;
    unsigned count = 0;
    if (found && GEOSCoordSeq_getSize_r(c, found, &count) && count > 1)
      for (unsigned k = 0; k + 1 < count; ++k) {
        Flat p;
        GEOSCoordSeq_getXY_r(c, found, k, &p.u, &p.v);
        out.push_back(p);
      }
  }
  if (wide) GEOSGeom_destroy_r(c, wide);
  if (polygon) GEOSGeom_destroy_r(c, polygon);
  GEOS_finish_r(c);
  if (out.size() < 3) {  // the ring crosses itself: all of its box
    const FlatBox box = boxOf(ring);
    const Flat low = box.low - Flat{by, by}, high = box.high + Flat{by, by};
    return {low, {high.u, low.v}, high, {low.u, high.v}};
  }
  if (signedArea(out) < 0) out = Ring(out.rbegin(), out.rend());
  return out;
}

}  // namespace karinui
