#pragma once
// One item of a batch: a design made to a person's measure, brought to rest and examined. Runs in a process of its own
// (shard.h), for it may take for ever or fall down.
#include "../open_document.h"
#include "plan.h"

namespace karinui::app {

// Does the item whose plan (planOf()) comes on stdin and keeps its outcome: nothing is read that grows with the batch.
// The exit status of the process is kDone where an outcome was kept. Otherwise what hindered it lies in this machine:
// kItemOutOfMemory, or another status with a sentence on stderr.
int runItem(Program& program, const std::filesystem::path& folder);
constexpr int kItemOutOfMemory = 5;

// Its garment in an empty document, not brought to rest yet. A copy of its design that is not the one that was planned
// is refused with Error::Kind::Storage.
Done makeGarment(OpenDocument& opened, const std::filesystem::path& folder, const BatchPlan& plan,
                 const BatchItem& item);

}  // namespace karinui::app
