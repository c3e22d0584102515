#pragma once
// A limb as a distance field: a row of sections, drawn out finely between its stations by Catmull-Rom over their index.
// Near the surface the value is the distance divided by nothing more than the slope of the radius; the caller evens it.
#include <cstdint>
#include <vector>

#include "body/figure.h"

namespace karinui {

class Tube {
 public:
  Tube(const std::vector<Section>& stations, Harmonics harmonics);
  static constexpr double kNowhere = 0.3;

  struct Value {
    double across = kNowhere;  // distance to the centre less the section's radius there
    double cap = -1;           // > 0 beyond the first or last plane
  };
  // Where along the tube a place lies, if it is as near to its middle as the planes there are believed.
  struct Along {
    std::size_t interval = 0;
    double t = 0;  // of the way from ring to ring
    Vec3 middle;
    double reach = -1;  // below 0: beyond the ends
  };
  // Places one above the other in z: only some intervals can hold any of them.
  struct Column {
    std::vector<std::uint32_t> interval;  // in order; k lies between the rings k and k + 1
    Along along;                          // of all of them, where no plane rises in z
    Section here;                         // at `along`
  };
  void narrow(double x, double y, Column& to) const;
  Value at(Vec3 p, const Column& column) const;
  const std::vector<Section>& rings() const { return ring_; }
  void bounds(Vec3& low, Vec3& high) const;

 private:
  struct Level {
    Vec3 centre, normal;
  };
  double beyond(Vec3 p, std::size_t k) const { return dot(p - level_[k].centre, level_[k].normal); }
  bool between(Vec3 p, std::size_t k, Along& along) const;
  Along shortOfFirst(Vec3 p) const;
  Along pastLast(Vec3 p) const;
  Along alongParallel(Vec3 p) const;
  Section sectionAt(const Along& along) const;

  std::vector<Section> ring_;
  std::vector<Level> level_;   // of the rings, close together: they are gone through for every place
  std::vector<double> reach_;  // how far from the middle of an interval its planes are believed
  Harmonics harmonics_;
  bool parallel_ = false;  // all planes: each place lies between two of them at the most
  bool upright_ = false;   // and they hold the direction of z
};

}  // namespace karinui
