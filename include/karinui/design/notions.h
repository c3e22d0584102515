#pragma once
// What has to be bought for a garment besides its cloth, and the strips that are cut from it.
#include <vector>

#include "karinui/design/document.h"
#include "karinui/pattern/trims.h"

namespace karinui {

// Alike things together: "6 buttons 11 mm", "piping cord 4 mm, 120 cm", "bias strip of silk, 32 mm wide, 2 × 62 cm".
std::vector<Message> notionsSaid(const Pattern& pattern, const Allowances& finish,
                                 const std::map<PieceId, Cutting>& cutting);
// How often each piece is cut: as it is told, and both halves of one that lies on the fold.
TimesCut timesCut(const Pattern& pattern, const Allowances& finish, const std::map<PieceId, Cutting>& cutting);

}  // namespace karinui
