#pragma once
// Which of a garment's sizes is nearest to a figure, and what it misses by, in sentences and as JSON.
#include "console.h"
#include "karinui/design/size_fit.h"

namespace karinui::app {

std::vector<Message> sizesSaid(const SizeFit& fit, const Grading& grading, Json& json);

}  // namespace karinui::app
