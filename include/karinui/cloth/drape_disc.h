#pragma once
// The drape tester (Cusick 1968): a disc of cloth lies on a smaller round support, what stands out hangs in folds, and
// its shadow is measured. The drape coefficient is the share of the free ring that the shadow covers: 0 hangs, 1 stands
// out. Metres. Pure functions; any thread.

namespace karinui {

inline constexpr double kDrapeDisc = 0.15, kDrapeSupport = 0.09;  // radii

// From the areas of the disc, flat and draped, in any unit.
double drapeCoefficient(double flat, double draped);

// The bending length (B / (w g))^(1/3), B the mean of warp and weft, of cloth with this coefficient in (0, 1).
// ln c = -4.072 + 0.358 ln(q / (1 - q)): least squares over the thirteen fabrics of the shop, each laid on our drape
// tester six times (docs/user/fabrics.md); what their shear adds is left in the spread.
double bendingLengthOfDrape(double coefficient);
double drapeSlope(double coefficient);         // d ln c / d coefficient there
inline constexpr double kDrapeSpread = 0.051;  // standard deviation of ln c of a fabric from that line

}  // namespace karinui
