#pragma once
// What the command says and how it ends: answers on stdout (words, or one JSON object), progress and trouble on stderr.
#include <chrono>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/cloth/stop_request.h"

namespace karinui::app {

using Json = nlohmann::ordered_json;

enum Exit { kDone = 0, kWrongCall = 2, kRefused = 3, kNotSettled = 4 };

// A sentence of the help, in the person's language.
std::string help(std::string_view english);
std::string help(const Message& sentence);  // with values

class Console {
 public:
  explicit Console(Language language = spokenHere()) : language_(language) {}
  bool json = false;  // --json

  std::string said(const Message& message) const { return text(message, language_); }
  // The one answer of a command: the object if --json, else the words.
  void answer(const Json& object, const std::string& words) const;
  void note(const Message& message) const;  // stderr, or where keepNotes() said
  void keepNotes(std::function<void(const Message&)> keep) { keep_ = std::move(keep); }
  int refuse(const Error& error) const;  // says why; gives the exit status
  // Ctrl-C cancels it; after half a second its progress is shown.
  const Token& token();
  // What follows is a job of its own, whose progress begins anew.
  void newJob() { stages_.clear(); }
  // Ctrl-C asks this first, and cancels only what cannot be stopped so; null: not any more.
  void stopFirst(StopRequest* stop);

 private:
  void show(double fraction, const Message& doing);
  void log(int percent, const Message& doing);
  Language language_;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
  Token token_{[this](double fraction, const Message& doing) { show(fraction, doing); }};
  bool showing_ = false;
  // Where nobody watches, by stage: the most that was told of it.
  std::map<std::string, int> stages_;
  std::function<void(const Message&)> keep_;
};

}  // namespace karinui::app
