#pragma once
// Where cloth may lie that was just cut otherwise on paper, before a drape says it: a guess to show at once. Pure.
#include "karinui/design/document.h"

namespace karinui {

// `after` is `before` with outlines changed; as an operation leaves it the cloth of its pieces has new places on paper
// but stands where it stood. Here each place also goes as far along the cloth as it went on paper: its step is carried
// into space by the map from paper to space there (the deformation gradient of the shape as it was).
Document carriedAlong(const Document& before, Document after);

}  // namespace karinui
