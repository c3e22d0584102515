#pragma once
// Topstitching, piping and bindings of a piece, as they are drawn on its cloth.
#include "karinui/design/document.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

// Onto the cloth that a piece was laid as: its mesh, paper places and colour are there.
void addTrims(const Document& document, PieceId id, SceneCloth& cloth);

}  // namespace karinui
