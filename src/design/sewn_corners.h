#pragma once
// Where edges that follow each other are one cloth.
#include "karinui/design/document.h"
#include "karinui/design/values.h"

namespace karinui {

// Whether the cloth goes on from the end of `ref` to the beginning of `next`: they are one place of a piece, or seams
// hold the two places together.
bool goesOnSewn(const Document& document, const EdgeRef& ref, const EdgeRef& next);

}  // namespace karinui
