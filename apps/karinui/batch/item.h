#pragma once
// One item of a batch: a design made to a person's measure, brought to rest and examined. Runs in a process of its own
// (shard.h), for it may take for ever or fall down.
#include "../commands.h"
#include "plan.h"

namespace karinui::app {

// Does it and keeps its outcome. The exit status of the process is kDone where an outcome was kept.
int runItem(Program& program, const std::filesystem::path& folder, const std::string& key);

}  // namespace karinui::app
