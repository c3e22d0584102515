#pragma once
// One body while it is measured: what the parts of the body have in common. Each part is a file of its own, measured in
// the order of the functions below; a later part may use what an earlier one found.
//
// Sizes by which a part is sought are shares of the stature, unless a comment says metres. Those without a source are
// set by hand: wide enough for every figure of the tests, narrow enough to leave the neighbouring part out.
#include <string_view>

#include "body/anthropometry/anthropometry.h"
#include "body/anthropometry/contour.h"
#include "body/anthropometry/mesh_slices.h"

namespace karinui {

struct Survey {
  const TriangleMesh& mesh;
  MeshSlices slices;
  double floor = 0, stature = 0, middle = 0;  // y of the soles, height, x of the plane of symmetry
  double crotch = 0, armpit = 0, waist = 0;   // levels y
  double bosom = 0;                           // 0: a man's flat chest, 1: a woman's full bust
  Anthropometry found = {};

  double aboveFloor(double y) const { return y - floor; }
  void set(const char* key, double value) { found.value[key] = value; }
};

constexpr std::string_view kSuffix[] = {"_left", "_right"};  // of a landmark's name, by side
inline double outward(int side) { return side ? -1 : 1; }    // the sign of x
inline std::string sided(const char* name, int side) { return name + std::string(kSuffix[side]); }

bool findCrotch(Survey& body);  // false: this is no standing body with its legs apart
bool findArmpit(Survey& body);  // false: nor with its arms off the trunk
void measureTrunk(Survey& body);
void measureLegs(Survey& body);
void measureArm(Survey& body, int side);  // the left one first: it gives the measurements
void measureNeck(Survey& body);
void measureShoulders(Survey& body);
void measureWaistLengths(Survey& body);  // from the neck points

// x of the middle of the gap between arm and trunk just under the armpit, off the plane of symmetry.
double armpitGap(const Survey& body, int side);

// The outline of the body in the plane of symmetry: its frontmost and rearmost point at a level. z = -1e9 and 1e9 where
// there is no body.
struct SagittalProfile {
  Vec3 front, back;
};
SagittalProfile profileAt(const Survey& body, double y);
// The highest point of the body in the plane of this x, no higher than asked.
std::optional<Vec3> highestAt(const Survey& body, double x, double below = 1e9);

}  // namespace karinui
