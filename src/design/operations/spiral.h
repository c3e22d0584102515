#pragma once
// The section of cloth that goes round a limb more than once: a girth whose turns lie over each other. Metres.
#include <vector>

#include "design/operations/tapered_tube.h"

namespace karinui {

// Lengths along it are kept. It passes the girth's place `anchor` with 0, and reaches from `low` to `high` along the
// girth's direction; `lowOnTop`: its end at `low` lies on top, else that at `high`.
class Spiral {
 public:
  Spiral(const Girth& girth, double anchor, double low, double high, bool lowOnTop);
  Flat at(double s) const;

 private:
  struct Place {
    double s = 0;
    Flat place;
  };
  std::vector<Place> places_;  // from low to high
};

}  // namespace karinui
