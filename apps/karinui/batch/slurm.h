#pragma once
// A batch handed to a cluster's Slurm, as an array of jobs: one a shard.
#include "../commands.h"
#include "plan.h"

namespace karinui::app {

struct SlurmWish {
  std::size_t shards = 0;  // 0: one for 50 items
  int threads = 2;         // of one job
  int seconds = 600;       // an item may take
  int attempts = 2;        // as ShardWish has them
  bool retry = false;
  std::string partition, time;  // as sbatch takes them; empty: the cluster's own
};
// What sbatch is given. `program`: the command on the cluster's machines.
std::string slurmScript(const std::filesystem::path& program, const std::filesystem::path& folder,
                        const BatchPlan& plan, const SlurmWish& wish);
// Writes slurm.sh into the batch's folder and submits it; gives the job's number as sbatch says it. Where there is no
// sbatch the script stays and the error says so.
Result<std::string> submitToSlurm(const std::filesystem::path& folder, const BatchPlan& plan, const SlurmWish& wish);

}  // namespace karinui::app
