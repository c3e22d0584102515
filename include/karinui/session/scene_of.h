#pragma once
// A garment as a picture and as something to point at. Pure; long for large garments; any thread.
#include <memory>

#include "karinui/design/document.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

// The body (null: none) and every piece where it stands, at the document's own spacing.
Result<SceneFrame> sceneOf(const Document& document, const Body* body);

// How far each point of a cloth is from the skin, metres; negative inside.
std::vector<float> easeOf(const SceneCloth& cloth, const Body& body);

}  // namespace karinui
