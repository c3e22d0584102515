#include <algorithm>
#include <cmath>

#include "karinui/cloth/fabric.h"

namespace karinui {

// Three parts add up: the squeeze's slope everywhere, what the toe adds to it, what stiffening adds beyond the toe.

double ThreadCurve::energy(double e) const {
  const double over = std::fmax(0.0, e), bent = std::fmin(over, toe), straight = over - bent;
  const double firmed = std::fmin(straight, firming()), beyond = straight - firmed;
  const double rise = stiffness - squeeze, firmer = stiffening * stiffness;
  const double inToe = toe > 0 ? rise * bent * bent * bent / (6 * toe) : 0;
  return 0.5 * squeeze * e * e + inToe + rise * straight * 0.5 * (toe + straight) +
         firmer * firmed * (firmed * firmed / 6 + 0.5 * beyond * (firmed + beyond));
}

double ThreadCurve::force(double e) const {
  const double over = std::fmax(0.0, e), bent = std::fmin(over, toe), straight = over - bent;
  const double firmed = std::fmin(straight, firming());
  const double inToe = toe > 0 ? bent * bent / (2 * toe) : 0;
  return squeeze * e + (stiffness - squeeze) * (inToe + straight) +
         stiffening * stiffness * firmed * (straight - 0.5 * firmed);
}

double ThreadCurve::tangent(double e) const {
  if (e <= 0) return squeeze;
  const double risen = toe > 0 ? std::fmin(1.0, e / toe) : 1.0;
  return squeeze + (stiffness - squeeze) * risen + stiffening * stiffness * std::clamp(e - toe, 0.0, firming());
}

double ThreadCurve::strainAt(double wanted) const {
  double low = 0, high = wanted / std::fmax(1e-9, stiffness) + toe;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (force(middle) < wanted ? low : high) = middle;
  }
  return high;
}

double ThreadCurve::linearity(double wanted) const {
  const double e = strainAt(wanted);
  return energy(e) / (0.5 * wanted * e);
}

}  // namespace karinui
