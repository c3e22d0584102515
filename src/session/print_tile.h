#pragma once
// One repeat of a print as a picture, for other programs. Pure; any thread.
#include <optional>

#include "karinui/exchange/spatial.h"
#include "karinui/scene/cloth_look.h"

namespace karinui {

std::optional<SpatialLook::Tile> printTile(const ClothLook& look, const Colour& cloth);  // nothing: no print

}  // namespace karinui
