#pragma once
// GEOS behind a small face. It keeps its state in a context; one per call is cheap and makes every call thread-safe. It
// turns every exception into a null or an error code: want of memory must not be taken for an answer about an outline.
#include <geos_c.h>

#include <memory>
#include <new>
#include <span>
#include <string_view>

#include "karinui/geometry/vec.h"

namespace karinui {

class Geos {
 public:
  struct Drop {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(context, g); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Drop>;

  Geos() {
    GEOSContext_setErrorMessageHandler_r(
        context,
        [](const char* what, void* self) {
          if (what == std::string_view("std::bad_alloc")) static_cast<Geos*>(self)->outOfMemory_ = true;
        },
        this);
  }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(context); }

  // Throws std::bad_alloc if GEOS met one.
  void check() const {
    if (outOfMemory_) throw std::bad_alloc();
  }
  Geometry own(GEOSGeometry* g) const {
    Geometry owned(g, Drop{context});
    check();
    return owned;
  }
  // A closed line's places, its first once more at the end; whoever makes a geometry of them owns them.
  GEOSCoordSequence* places(std::span<const Flat> ring) const {
    GEOSCoordSequence* all = GEOSCoordSeq_create_r(context, static_cast<unsigned>(ring.size() + 1), 2);
    check();
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const Flat p = ring[k % ring.size()];
      GEOSCoordSeq_setXY_r(context, all, static_cast<unsigned>(k), p.u, p.v);
    }
    return all;
  }

  const GEOSContextHandle_t context = GEOS_init_r();

 private:
  bool outOfMemory_ = false;
};

}  // namespace karinui
