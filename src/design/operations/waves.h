#pragma once
// The section of cloth that is wider than its part of the way round a limb, as the front of a gathered skirt: upright
// waves along a girth. Metres.
#include <vector>

#include "design/operations/tapered_tube.h"

namespace karinui {

// Lengths along it are kept, on a girth as curved as a circle is that long. It reaches from `low` to `high` of the
// cloth, takes `arc` of the girth, and passes the girth's place `anchor` with 0. Its two ends lie on the girth, all
// else on it or outside.
class Waves {
 public:
  Waves(const Girth& girth, double anchor, double low, double high, double arc);
  Flat at(double s) const;

 private:
  struct Place {
    double along = 0, off = 0;  // of the girth; outwards from it
  };
  std::vector<Place> developed(double swing) const;
  Flat stands(Place place) const;

  const Girth& girth_;
  double low_ = 0, begins_ = 0, step_ = 0, wave_ = 0;
  std::vector<Place> places_;
};

}  // namespace karinui
