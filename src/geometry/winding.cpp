#include "karinui/geometry/winding.h"

#include <geos_c.h>

#include <algorithm>
#include <memory>

namespace karinui {

namespace {

struct Drop {
  GEOSContextHandle_t context;
  void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(context, g); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Drop>;

struct Work {
  GEOSContextHandle_t context = GEOS_init_r();
  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  ~Work() { GEOS_finish_r(context); }
  Geometry own(GEOSGeometry* g) const { return Geometry(g, Drop{context}); }
};

// The closed line, divided wherever it meets itself.
Geometry noded(const Work& work, std::span<const Flat> ring) {
  GEOSContextHandle_t c = work.context;
  GEOSCoordSequence* places = GEOSCoordSeq_create_r(c, static_cast<unsigned>(ring.size() + 1), 2);
  for (std::size_t k = 0; k <= ring.size(); ++k) {
    const Flat p = ring[k % ring.size()];
    GEOSCoordSeq_setXY_r(c, places, static_cast<unsigned>(k), p.u, p.v);
  }
  const Geometry line = work.own(GEOSGeom_createLineString_r(c, places));
  return work.own(line ? GEOSUnaryUnion_r(c, line.get()) : nullptr);
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
  const Work work;
  GEOSContextHandle_t c = work.context;
  const Geometry line = noded(work, ring);
  if (!line) return {};
  const GEOSGeometry* const lines[] = {line.get()};
  const Geometry faces = work.own(GEOSPolygonize_r(c, lines, 1));
  if (!faces) return {};
  std::vector<GEOSGeometry*> kept;
  for (int i = 0; i < GEOSGetNumGeometries_r(c, faces.get()); ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(c, faces.get(), i);
    const Geometry inner = work.own(GEOSPointOnSurface_r(c, face));
    Flat place;
    if (!inner || !GEOSGeomGetX_r(c, inner.get(), &place.u) || !GEOSGeomGetY_r(c, inner.get(), &place.v)) continue;
    const int turns = turnsRound(ring, place);
    if (clockwise ? turns < 0 : turns > 0) kept.push_back(GEOSGeom_clone_r(c, face));
  }
  if (kept.empty()) return {};
  const Geometry all = work.own(
      GEOSGeom_createCollection_r(c, GEOS_GEOMETRYCOLLECTION, kept.data(), static_cast<unsigned>(kept.size())));
  const Geometry whole = work.own(all ? GEOSUnaryUnion_r(c, all.get()) : nullptr);
  Ring best;
  for (int i = 0; whole && i < GEOSGetNumGeometries_r(c, whole.get()); ++i) {
    const GEOSGeometry* part = GEOSGetGeometryN_r(c, whole.get(), i);
    if (GEOSGeomTypeId_r(c, part) != GEOS_POLYGON) continue;
    if (Ring one = ringOf(c, part); best.empty() || signedArea(one) > signedArea(best)) best = std::move(one);
  }
  return best;
}

}  // namespace karinui
