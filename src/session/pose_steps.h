#pragma once
// A garment that is taken from pose to pose to be looked at.
#include <string>
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

Operation poseStep(const std::string& name);
// Whether the figure has these poses; asked before long work.
Done posesKnown(const Document& document, const std::vector<std::string>& names, Context& context);
// The garment brought to rest where it stands, if it is not.
Result<Document> rested(Document document, Context& context);

}  // namespace karinui
