#pragma once
// A fabric from what a kitchen table gives: a swatch on scales, a strip over the table's edge or a disc over a tin, a
// weight on a strip.
// Every number comes with its standard uncertainty: that of the mean of the readings, and that of ruler, scales and
// angle, which more readings do not mend (ISO/IEC Guide 98-3, first order). Pure functions; any thread. SI units;
// angles in radians.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "karinui/cloth/fabric.h"

namespace karinui {

struct Uncertain {
  double value = 0, error = 0;  // one standard deviation
};
// Of repeated readings of one thing. `tool`: the standard uncertainty of one reading by its tool. Needs one reading.
Uncertain meanOf(const std::vector<double>& readings, double tool);

// A strip held level at a table's edge, `overhang` of it free: B = w g L^3 / gamma, where gamma is how heavy the
// elastica is whose tip lies at `angle` below the edge. At 41.5 degrees it is 8, so that L is twice the bending length
// (Peirce 1930, ASTM D1388). Angles from 5 to 80 degrees.
double elasticaWeight(double angle);
inline constexpr double kPeirceAngle = 0.72431164;  // 41.5 degrees

enum class Grain { Warp, Weft, Bias };  // along which the strip is cut; bias: 45 degrees
inline constexpr std::size_t kGrains = 3;

struct Overhang {
  std::vector<double> lengths;  // m, repeated; each side and each end of the strip is another reading
  std::vector<double> angles;   // of the edge to the tip; empty: 41.5 degrees, as a slope cut to it gives
};
struct HungWeight {
  double mass = 0;              // kg, on the strip
  std::vector<double> lengths;  // m, of the part between the marks, repeated
};

struct TableReadings {
  double ruler = 0.0003, scales = 0.0005, angle = 0.017;  // standard uncertainties of one reading: m, kg, radians
  double swatchLength = 0, swatchWidth = 0;               // m
  std::vector<double> swatchMasses;                       // kg, repeated
  std::array<Overhang, kGrains> overhang;                 // no lengths: not measured
  double stripLength = 0, stripWidth = 0;             // m: between the marks before anything hangs on it, and across
  std::array<std::vector<HungWeight>, kGrains> hung;  // empty: not measured
  std::vector<double> thicknesses;                    // m, repeated; empty: not measured
  std::vector<double> drapes;  // drape coefficients (drape_disc.h), repeated; empty: not measured, as where strips are
  std::string like;            // the fabric that gives what was not measured; empty: the nearest
};

// A quantity that was measured, as the fabric has it.
struct MeasuredNumber {
  double Fabric::*field;
  Uncertain value;
};
struct MeasuredFabric {
  Fabric fabric;     // named as the one that it is like
  std::string like;  // a preset
  std::vector<MeasuredNumber> numbers;
  // A strip on the bias bends as warp and weft let it; measured and as the fabric will have it. N m.
  std::optional<Uncertain> bendBias;
  double bendBiasOfFabric = 0;
};

// What was not measured is that of the preset `like`; where one of warp and weft was, the other goes in proportion.
// Stretch: the preset's curve has its strains stretched until it passes through what was measured, which leaves its
// linearity as it is. Shear, from a strip on the bias under F newtons per metre: its threads bear F/2 each way and
// stretch by e1, e2, the angle between them shears by 2 e - e1 - e2 under F/2 (as FAST-3 has it, threads not being
// rigid). Refused: no swatch, no readings of something, readings outside of what cloth does, saying which.
Result<MeasuredFabric> measuredFabric(const TableReadings& readings);

}  // namespace karinui
