#pragma once
// The order in which the cloth of a first drape is put on: garment by garment, from the skin outwards, and the facings
// and linings of each when the rest of it hangs. Draped all at once, layers that stand near or through each other
// hinder each other: shirt, trousers and waistcoat take three times as long, and end standing through each other.
#include "design/operations/operations.h"

namespace karinui {

// In stages where the record says so or, if it is new, where all is draped of what never came to rest; the report says
// what was done. Otherwise at once.
Result<DrapeOutcome> draped(const Document& before, const DrapePieces& op, Context& context);

}  // namespace karinui
