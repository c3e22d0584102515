#pragma once
// The part of a batch that one process works through, each item in a child process of its own.
#include "../commands.h"
#include "plan.h"

namespace karinui::app {

struct ShardWish {
  std::size_t shard = 1, shards = 1;  // every `shards`-th item, from the `shard`-th; from 1
  int jobs = 1;                       // items at a time
  int seconds = 600;                  // an item may take
  int attempts = 2;                   // at an item that crashes or lacks memory: the cause may be gone the second time
  bool retry = false;  // also those that crashed or lacked memory before, or ran out of less time than there is now
};
struct ShardDone {
  std::size_t items = 0, done = 0, before = 0;  // of this shard; now; before, and left as they were
  std::size_t hindered = 0;                     // that crashed, or lacked memory or time, now or before
};
// Items that have an outcome are left alone: a batch that was interrupted goes on where it stood. What was refused or
// did not settle is an answer, the same every time, and never tried again. Where an item's process can say why this
// machine gives no outcome (the disk, a file that was changed), the part ends with its sentence.
Result<ShardDone> runShard(Program& program, const std::filesystem::path& folder, const ShardWish& wish);

// "2/5"
Result<std::pair<std::size_t, std::size_t>> parseShard(const std::string& text);

}  // namespace karinui::app
