#pragma once
// The names that people gave within a pattern: of pieces, seams, fabrics, fastenings, sizes, inner lines, notches and
// edges. Pure; any thread.
#include <string>
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

// The same pattern with neutral names: piece1, seam2, edge3. What was called alike still is, and an edge whose name
// has hem, neck or fold in it keeps that word, which says how it is finished. Fabrics that come with the program keep
// their names. Of the document only what share() gives away is looked at.
Document unnamed(Document document);

}  // namespace karinui
