#pragma once
// fabric measure: a fabric from a kitchen table.
#include "commands.h"

namespace karinui::app {

void addFabricVerb(Program& program);

}  // namespace karinui::app
