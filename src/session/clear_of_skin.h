#pragma once
// Cloth led out of a figure that has grown under it, for a picture while the figure is turned under the hand: nothing
// is draped, and how it fits is seen when the figure is worn.
#include "karinui/base/workers.h"
#include "karinui/body/body.h"
#include "karinui/design/document.h"

namespace karinui {

// Points of standing pieces that lie in the skin, or nearer to it than a layer is thick, stand a little before it;
// those of outer layers farther. All others stay.
Document clearOfSkin(Document document, const Body& body, Workers& workers);

}  // namespace karinui
