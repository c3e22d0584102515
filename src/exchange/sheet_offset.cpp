#include <geos_c.h>

#include <memory>

#include "sheet.h"

namespace karinui {
namespace {

struct Session {  // GEOS keeps its state and its errors here; nothing is shared between threads
  GEOSContextHandle_t handle = GEOS_init_r();
  ~Session() { GEOS_finish_r(handle); }
};

}  // namespace

Result<Ring> movedOutwards(const Ring& ring, double distance) {
  // A mitre longer than this many times the allowance is cut off, as pattern programs do.
  constexpr double kLongestMitre = 3.5;
  const Error failed = refused(say("The seam allowance cannot be drawn around this outline; try a smaller one."));
  const Session session;
  const auto h = session.handle;
  const auto drop = [h](GEOSGeometry* g) { GEOSGeom_destroy_r(h, g); };
  using Geometry = std::unique_ptr<GEOSGeometry, decltype(drop)>;

  GEOSCoordSequence* points = GEOSCoordSeq_create_r(h, static_cast<unsigned>(ring.size() + 1), 2);
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Flat p = ring[i % ring.size()];
    GEOSCoordSeq_setXY_r(h, points, static_cast<unsigned>(i), p.u, p.v);
  }
  GEOSGeometry* line = GEOSGeom_createLinearRing_r(h, points);
  if (!line) return failed;
  const Geometry polygon(GEOSGeom_createPolygon_r(h, line, nullptr, 0), drop);
  if (!polygon) return failed;
  const Geometry grown(
      GEOSBufferWithStyle_r(h, polygon.get(), distance, 8, GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, kLongestMitre), drop);
  if (!grown || GEOSGeomTypeId_r(h, grown.get()) != GEOS_POLYGON) return failed;
  const GEOSGeometry* outer = GEOSGetExteriorRing_r(h, grown.get());
  const GEOSCoordSequence* around = outer ? GEOSGeom_getCoordSeq_r(h, outer) : nullptr;
  unsigned count = 0;
  if (!around || !GEOSCoordSeq_getSize_r(h, around, &count) || count < 4) return failed;
  Ring out;
  for (unsigned i = 0; i + 1 < count; ++i) {
    Flat p;
    GEOSCoordSeq_getXY_r(h, around, i, &p.u, &p.v);
    out.push_back(p);
  }
  return out;
}

}  // namespace karinui
