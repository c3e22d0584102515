#pragma once
// Fastenings of pieces that are copied.
#include <map>

#include "design/operations/operations.h"

namespace karinui {

// The document with the fastenings of `piece` set on its copy too, where both their sides are on pieces in `copies`,
// which has it with its copy. `mirror`: the copies are mirror images. The others are told.
Document withCopiedFastenings(Document document, PieceId piece, const std::map<PieceId, PieceId>& copies, bool mirror,
                              const Context& context);

}  // namespace karinui
