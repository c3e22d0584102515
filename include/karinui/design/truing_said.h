#pragma once
// What truing found, in sentences. Pure; any thread.
#include <vector>

#include "karinui/design/document.h"
#include "karinui/pattern/truing.h"

namespace karinui {

// How the lengths of a seam's two sides compare.
Message lengthsSaid(const Document& document, const SeamTruing& seam);
// How the lines go on across the end of a seam.
Message cornerSaid(const Document& document, const CornerTruing& corner);
// What does not fit, a sentence each; of one seam, or (none) of all.
std::vector<Message> faultsSaid(const Document& document, const TruingReport& report, SeamId of = {});

}  // namespace karinui
