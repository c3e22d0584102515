#pragma once
// A document as a picture's worth of plain data: the body, the pieces where they stand, seams and edges, strain.
#include "bench.h"
#include "karinui/scene/scene_frame.h"

namespace karinui::app {

Result<SceneFrame> sceneOf(Bench& bench);

}  // namespace karinui::app
