#pragma once
// The energy of cloth on its way to rest and beyond, as an SVG drawing.
#include <string>

#include "karinui/cloth/settle_report.h"

namespace karinui::bench {

// Microjoules above the lowest sample against processor seconds, both by tens; a line marks where rest was called.
// Empty where fewer than two samples were taken.
std::string energyPlot(const std::string& scene, const SettleReport& report);

}  // namespace karinui::bench
