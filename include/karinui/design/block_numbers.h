#pragma once
// What an ease and a length of a block can be, whatever the figure, and how it is worn over what is there; the figure's
// own say comes when it is drafted. Pure.
#include "karinui/design/document.h"
#include "karinui/design/operation.h"

namespace karinui {

Done checkNumbers(const DraftBlock& block);

// The name of a piece that the garment has and that the block would make once more; empty: there is none.
std::string takenBy(const Document& document, const DraftBlock& block);
// A block whose pieces are there already is worn over them: with a prefix that is free, in the layer above all that is
// there, and off cloth that has been draped. What the block says itself holds; any other block is as it was.
DraftBlock wornOver(const Document& document, DraftBlock block);
Message wornOverSaid(const DraftBlock& block);  // of one that is so

}  // namespace karinui
