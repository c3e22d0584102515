#pragma once
// Clothes that are put on over others: what does not hang yet stands off the cloth that does. Without that an outer
// garment begins within an inner one, and two layers of cloth that stand through each other are slow to part, or never.
#include <set>

#include "design/operations/operations.h"

namespace karinui {

// The document with these pieces outside of what `worn` pieces' forms cover beneath them, seen from the body: flat ones
// are moved as they are, those facing the same way together; cloth that is wrapped round the body is widened where it
// must be. Cloth on another limb is not what a piece is worn over.
Document stoodOff(Document document, const std::set<PieceId>& pieces, const std::set<PieceId>& worn, const Body& body);

}  // namespace karinui
