#pragma once
// Files of measures opened and saved. GUI thread.
#include <filesystem>

#include "karinui/session/session.h"

namespace karinui::studio {

// The figure becomes one with the measures of the file; what is left out is told. Refusals are told like any other.
void wearMeasures(Session& session, const std::filesystem::path& file);
// All that the figure measures, those that were typed as typed.
void saveMeasures(Session& session, const std::filesystem::path& file);

}  // namespace karinui::studio
