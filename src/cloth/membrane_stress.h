#pragma once
// The stress of a membrane at a right angle between a weft and a warp thread. For threads that turn without stretching
// it is the second derivative of the membrane's energy: on relative moves a, b of their ends the energy is
// 1/2 (weft a.a + 2 shear a.b + warp b.b).
#include <cmath>

namespace karinui {

struct MembraneStress {
  double weft = 0, shear = 0, warp = 0;
};

// The nearest matrix [weft shear; shear warp] without negative eigenvalues: what compression would take from the
// system, which must stay positive, is left out. Cloth pulled on the bias has no stiffness across the pull, which no
// thread by itself could tell.
inline MembraneStress positivePart(MembraneStress s) {
  const double mean = 0.5 * (s.weft + s.warp), half = 0.5 * (s.weft - s.warp);
  const double root = std::sqrt(half * half + s.shear * s.shear), perRoot = 1 / (root > 1e-100 ? root : 1e-100);
  const double high = mean + root > 0 ? mean + root : 0, low = mean - root > 0 ? mean - root : 0;
  const double sum = 0.5 * (high + low), difference = 0.5 * (high - low) * perRoot;
  return {sum + difference * half, difference * s.shear, sum - difference * half};
}

}  // namespace karinui
