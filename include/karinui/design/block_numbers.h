#pragma once
// What an ease and a length of a block can be, whatever the figure; the figure's own say comes when it is drafted.
// Pure.
#include "karinui/design/document.h"

namespace karinui {

Done checkNumbers(const DraftBlock& block);

}  // namespace karinui
