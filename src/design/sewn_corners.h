#pragma once
// Where edges that follow each other are one cloth.
#include "karinui/design/document.h"
#include "karinui/design/operations/sewing.h"
#include "karinui/design/values.h"

namespace karinui {

// Whether the cloth goes on from the end of `ref` to the beginning of `next`: they are one place of a piece, or seams
// hold the two places together.
bool goesOnSewn(const Document& document, const EdgeRef& ref, const EdgeRef& next);
// Of a seam that joins two rings, as a bodice and a skirt at the waist: each begins with the edge from which on they
// stand beside each other, where that is plainly nearer than as they are listed. They closed turned against each other.
void meetAsRings(const Document& document, SewEdges& sew);

}  // namespace karinui
