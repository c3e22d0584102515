#pragma once
// The dress form of a figure: its trunk from neck to thigh, closed by caps at neck and armholes, on a stand. Metres.
#include "body/extremity.h"

namespace karinui {

// `mesh` is the standing skin of the figure with these joints; its left armpit and its crotch are where the tape found
// them. Above the crotch, below `neck` and before the arms' caps
// its points and faces keep their place and their order, but for the rims of the caps. No faces: the skin has no single
// line where it is to be cut.
TriangleMesh dressForm(const TriangleMesh& mesh, const Joints& at, Vec3 armpit, const Plane& neck, double crotch);

}  // namespace karinui
