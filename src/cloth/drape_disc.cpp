#include "karinui/cloth/drape_disc.h"

#include <cmath>

namespace karinui {

namespace {
constexpr double kLogLength = -4.0717, kLogitShare = 0.3583;
}

double drapeCoefficient(double flat, double draped) {
  constexpr double kWhole = kDrapeDisc * kDrapeDisc, kInner = kDrapeSupport * kDrapeSupport;
  return (draped / flat * kWhole - kInner) / (kWhole - kInner);
}

double bendingLengthOfDrape(double coefficient) {
  return std::exp(kLogLength + kLogitShare * std::log(coefficient / (1 - coefficient)));
}

double drapeSlope(double coefficient) { return kLogitShare / (coefficient * (1 - coefficient)); }

}  // namespace karinui
