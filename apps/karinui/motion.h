#pragma once
// check --poses: how a garment fits in one pose beside another, as a table, as JSON and as pictures side by side.
#include <string>
#include <vector>

#include "karinui/session/fit_in_motion.h"
#include "karinui/view/image.h"
#include "open_document.h"

namespace karinui::app {

std::string motionWords(const std::vector<FitInPose>& fits, const Console& console);
Json motionJson(const std::vector<FitInPose>& fits);
// Every pose from the front and obliquely, its name below.
Result<Image> motionSheet(OpenDocument& opened, const std::vector<FitInPose>& fits);

}  // namespace karinui::app
