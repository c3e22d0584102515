#pragma once
// The figure a mannequin is cut from: joints and levels, and along torso, arm, leg and foot a row of sections given as
// r(t) = sum a_k cos kt + sum b_k sin kt around a centre. Only the left half (+x) is kept. Metres.
#include <array>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/body/measurements.h"
#include "karinui/geometry/vec.h"

namespace karinui {

inline constexpr int kMostCoefficients = 13;
using Coefficients = std::array<double, kMostCoefficients>;  // a0 a1 … am, then b1 … bm

struct Harmonics {
  int count = 0;
  bool symmetric = false;  // no sines
  int coefficients() const { return symmetric ? count + 1 : 2 * count + 1; }
};
double radius(const Coefficients& c, Harmonics h, double cosine, double sine);
double hullGirth(const Coefficients& c, Harmonics h);  // the tight tape around the section

// A section in space: t runs from `front` to `side` around `centre`, in the plane across `normal`.
struct Section {
  Vec3 centre, normal, side, front;
  Coefficients shape{};
};

struct Joints {
  double crotch = 0, waist = 0, bust = 0, neck = 0, head = 0, crown = 0;  // heights
  double heel = 0, toe = 0, toeOut = 0;  // along the foot from the ankle; turn in radians
  Vec3 armpit, shoulder, elbow, wrist, tip, hip, knee, ankle;
  std::array<Vec3, 4> thumb;
};

// One station: how far its centre lies off the axis, and its shape.
struct Station {
  double forward = 0, sideways = 0;
  Coefficients shape{};
};

struct Limb {  // torso, arm, leg or foot: fractions and regions are the model's and never change
  Harmonics harmonics;
  std::vector<std::string> region;
  std::vector<double> fraction;
  std::vector<Station> station;
};

inline constexpr double kAdultChin = 0.874;  // its height, of the body's

struct Figure {
  Sex sex = Sex::Female;
  Joints at;
  Limb torso, arm, leg, foot;
  std::array<double, 2> thumbRadius{};
  double chin = kAdultChin;
};

// Where the stations stand, in order; the arm plane in which trunk and arm are cut apart.
std::vector<Section> torsoSections(const Figure& figure);  // bottom to top
std::vector<Section> armSections(const Figure& figure);    // armscye to fingertip
std::vector<Section> legSections(const Figure& figure);    // crotch to ankle
std::vector<Section> footSections(const Figure& figure);   // heel to toe
struct Armscye {
  Vec3 through, outward;
};
Armscye armscye(const Joints& at);

}  // namespace karinui
