#pragma once
// Cloth led out of a figure that has grown or moved under it, to be looked at while the figure is turned under the
// hand or is on its way to another pose: nothing is draped, and how it fits is seen when the figure is worn.
#include "karinui/base/workers.h"
#include "karinui/body/body.h"
#include "karinui/design/document.h"

namespace karinui {

// Points of standing pieces that lie in the skin, or nearer to it than a layer is thick, stand a little before it;
// those of outer layers farther. All others stay.
Document clearOfSkin(Document document, const Body& body, Workers& workers);

struct Skin {
  const TriangleMesh& mesh;
  const Bvh& bvh;
  double deep;  // metres: what lies farther in is another limb's skin
};
// The points of one cloth, so that neither they nor its faces lie nearer before the skin than `clear`.
void leadOut(std::vector<Vec3>& points, const std::vector<Triangle>& faces, const Skin& skin, double clear,
             Workers& workers);

}  // namespace karinui
