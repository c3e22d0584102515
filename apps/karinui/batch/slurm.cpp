#include "slurm.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "karinui/base/file.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

// A word for the shell, whatever is in it.
std::string shellWord(const std::string& word) {
  std::string all = "'";
  for (const char c : word) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

bool plainWord(const std::string& word) {
  return word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.,:-") ==
         std::string::npos;
}

// Runs a program found on PATH; what it says on both its outputs, or why it did not run.
Result<std::pair<int, std::string>> said(std::vector<std::string> words) {
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0)
    return storageError(say("No process could be started: {0}.", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const int failed = ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  std::string all;
  char bytes[4096];
  for (ssize_t got = 0; failed == 0 && (got = ::read(pipe[0], bytes, sizeof bytes)) > 0;)
    all.append(bytes, static_cast<std::size_t>(got));
  ::close(pipe[0]);
  if (failed != 0) return notFound(say("“{0}” is not installed here.", words[0]));
  int status = 0;
  ::waitpid(pid, &status, 0);
  while (!all.empty() && all.back() == '\n') all.pop_back();
  return std::pair(WIFEXITED(status) ? WEXITSTATUS(status) : 128, all);
}

}  // namespace

std::string slurmScript(const fs::path& program, const fs::path& folder, const BatchPlan& plan, const SlurmWish& wish) {
  const std::size_t shards = wish.shards ? wish.shards : std::max<std::size_t>(1, (plan.items.size() + 49) / 50);
  std::string all = "#!/bin/bash\n#SBATCH --job-name=karinui\n#SBATCH --array=1-" + std::to_string(shards) +
                    "\n#SBATCH --cpus-per-task=" + std::to_string(wish.threads) +
                    "\n#SBATCH --output=slurm-%A_%a.log\n" + "#SBATCH --requeue\n";
  if (!wish.partition.empty()) all += "#SBATCH --partition=" + wish.partition + "\n";
  if (!wish.time.empty()) all += "#SBATCH --time=" + wish.time + "\n";
  return all + "exec " + shellWord(program.string()) + " batch run " + shellWord(folder.string()) +
         " --shard \"$SLURM_ARRAY_TASK_ID/" + std::to_string(shards) + "\" --threads " + std::to_string(wish.threads) +
         " --seconds " + std::to_string(wish.seconds) + " --attempts " + std::to_string(wish.attempts) +
         (wish.retry ? " --retry\n" : "\n");
}

Result<std::string> submitToSlurm(const fs::path& folder, const BatchPlan& plan, const SlurmWish& wish) {
  for (const std::string& word : {wish.partition, wish.time})
    if (!plainWord(word)) return badInput(say("“{0}” is no word for sbatch.", word));
  std::error_code trouble;
  const fs::path here = fs::absolute(folder, trouble), script = here / "slurm.sh";
  const fs::path program = fs::read_symlink("/proc/self/exe", trouble);
  if (const Done done = writeFile(script, slurmScript(program, here, plan, wish)); !done) return done.error();
  const auto answer = said({"sbatch", "--parsable", "--chdir", here.string(), script.string()});
  if (!answer)
    return notFound(say("{0} The jobs are in “{1}”; submit it where Slurm is.", answer.error().what, script.string()));
  if (answer->first != 0) return refused(say("sbatch refused: {0}", answer->second));
  return answer->second;
}

}  // namespace karinui::app
