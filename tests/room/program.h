#pragma once
// The program itself, run as a child on the stub runtime, and what it leaves.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace karinui::room::test {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() /
              ("karinui_room_" + std::to_string(getpid()) + "_" + std::to_string(count_++))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  inline static std::atomic<int> count_{0};
  fs::path path_;
};

inline std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}
inline void write(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

// An X display of the tests' own, or why there is none.
inline std::string displayTrouble() {
  static pid_t server = 0;
  static const std::string trouble = []() -> std::string {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe for a display";
    server = fork();
    if (server == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      close(ends[0]);
      const int quiet = ::open("/dev/null", O_WRONLY);
      dup2(quiet, 1), dup2(quiet, 2);
      const std::string number = std::to_string(ends[1]);
      execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string said;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) said += c;
    close(ends[0]);
    if (said.empty()) return "no Xvfb (Debian package xvfb)";
    setenv("DISPLAY", (":" + said).c_str(), 1);
    std::atexit([] {
      if (server > 0) kill(server, SIGTERM), waitpid(server, nullptr, 0);
    });
    return {};
  }();
  return trouble;
}

// What a run of karinui-room came to.
struct Ran {
  int code = -1;
  std::string said, printed;  // on the terminal: for errors, and else
  nlohmann::json report;      // of --headless-test
  std::string calls, faults, vibration, validation;
};

struct Way {
  std::string hands = {}, marks = {};   // for the runtime; for the program
  std::string with = {};                // KARINUI_STUB_WITH
  std::vector<std::string> words = {};  // more for the program
  bool validated = true;                // by the core validation layer, which knows GLX only
  bool runtime = true;                  // there is one
  bool headless = true;                 // as a test, without drafts; else as a person begins it
};

inline Ran run(const Folder& folder, const Way& way) {
  const fs::path log = folder / "log", out = folder / "out", validation = folder / "validation.txt";
  fs::create_directories(log);
  write(folder / "hands.txt", way.hands);
  write(folder / "marks.txt", way.marks);
  std::vector<std::string> words{KARINUI_ROOM, "--threads", "1"};
  if (way.headless) words.insert(words.end(), {"--headless-test", out.string()});
  if (!way.marks.empty()) words.insert(words.end(), {"--script", (folder / "marks.txt").string()});
  words.insert(words.end(), way.words.begin(), way.words.end());
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setenv("XR_RUNTIME_JSON", way.runtime ? KARINUI_STUB_JSON : "/nonexistent/runtime.json", 1);
    setenv("KARINUI_STUB_SCRIPT", (folder / "hands.txt").c_str(), 1);
    setenv("KARINUI_STUB_LOG", log.c_str(), 1);
    setenv("KARINUI_STUB_WITH", way.with.c_str(), 1);
    setenv("HOME", folder.path().c_str(), 1);
    setenv("LP_NUM_THREADS", "2", 0);
    unsetenv("XDG_CONFIG_HOME");
    if (way.validated) {
      setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
      setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
      setenv("XR_CORE_VALIDATION_FILE_NAME", validation.c_str(), 1);
    }
    dup2(::open((folder / "stdout.txt").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), 1);
    dup2(::open((folder / "stderr.txt").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), 2);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Ran ran;
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  ran.said = bytesOf(folder / "stderr.txt"), ran.printed = bytesOf(folder / "stdout.txt");
  ran.report = nlohmann::json::parse(bytesOf(out / "report.json"), nullptr, false);
  ran.calls = bytesOf(log / "calls.log"), ran.faults = bytesOf(log / "faults.log");
  ran.vibration = bytesOf(log / "vibration.log"), ran.validation = bytesOf(validation);
  return ran;
}

}  // namespace karinui::room::test
