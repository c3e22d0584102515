#include "console.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

#include "karinui/base/number.h"

namespace karinui::app {

namespace {
// A signal handler may only reach a global; there is one command in a process and so one token.
std::atomic<Token*> interruptible{nullptr};
std::atomic<StopRequest*> stoppable{nullptr};
void onInterrupt(int) {
  if (StopRequest* stop = stoppable.load(); stop && stop->ask()) return;
  if (Token* token = interruptible.load()) token->cancel();
}
}  // namespace

std::string help(std::string_view english) { return help(say(english)); }
std::string help(const Message& sentence) { return text(sentence, spokenHere()); }

void Console::answer(const Json& object, const std::string& words) const {
  // A file's name may hold bytes that are no text.
  const std::string out = json ? object.dump(2, ' ', false, Json::error_handler_t::replace) : words;
  std::fwrite(out.data(), 1, out.size(), stdout);
  if (!out.ends_with('\n')) std::fputc('\n', stdout);
}

void Console::note(const Message& message) const {
  if (keep_) return keep_(message);
  std::fprintf(stderr, "%s\n", said(message).c_str());
}

int Console::refuse(const Error& error) const {
  if (showing_) std::fputc('\n', stderr);
  std::fprintf(stderr, "karinui: %s\n", said(error.what).c_str());
  if (json) answer({{"error", said(error.what)}}, "");
  return kRefused;
}

const Token& Console::token() {
  interruptible = &token_;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  return token_;
}

void Console::stopFirst(StopRequest* stop) { stoppable = stop; }

// One line for each stage, and one every ten seconds of a long one: a log is read afterwards.
void Console::log(int percent, const Message& doing) {
  if (doing.empty()) return;
  const auto now = std::chrono::steady_clock::now();
  // “Draping …, some 40 steps to go” is of the stage “Draping …”.
  const Message* stage = &doing;
  while (stage->pattern.starts_with("{0}") && !stage->values.empty() &&
         std::holds_alternative<Message>(stage->values[0]))
    stage = &std::get<Message>(stage->values[0]);
  const auto told = stages_.find(stage->pattern);
  const auto pause = told == stages_.end() ? std::chrono::milliseconds(500) : std::chrono::milliseconds(10'000);
  if (now - shown_ < pause || (told != stages_.end() && percent <= told->second)) return;
  shown_ = now;
  stages_[stage->pattern] = percent;
  std::fprintf(stderr, "  %3d%% %s\n", percent, said(doing).c_str());
}

void Console::show(double fraction, const Message& doing) {
  if (isatty(STDERR_FILENO) == 0) return log(static_cast<int>(100 * fraction), doing);
  const auto now = std::chrono::steady_clock::now();
  const bool end = fraction >= 1 && showing_;
  if (now - shown_ < std::chrono::milliseconds(500) && !end) return;
  shown_ = now;
  showing_ = !end;
  std::fprintf(stderr, "\r  %3d%% %s%s", static_cast<int>(100 * fraction), said(doing).c_str(), end ? "\n" : "\033[K");
}

}  // namespace karinui::app
