#pragma once
// A garment made to another person's measure.
#include "open_document.h"

namespace karinui::app {

// Does the operations of `source` again in `target`, which is empty, on another body. Every choice of a figure becomes
// this one. The error names the step.
Done refit(OpenDocument& source, OpenDocument& target, const SetBody& body);

}  // namespace karinui::app
