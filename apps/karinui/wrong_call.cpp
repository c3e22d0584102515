#include "wrong_call.h"

#include <algorithm>
#include <sstream>

namespace karinui::app {

namespace {

// The verb that was being read when the trouble came, and how a person calls it: "karinui body make".
struct Verb {
  const CLI::App* app;
  std::string called;
};
Verb verbOf(const CLI::App& cli) {
  Verb verb{&cli, cli.get_name()};
  while (!verb.app->get_subcommands().empty()) {
    verb.app = verb.app->get_subcommands().back();
    verb.called += " " + verb.app->get_name();
  }
  return verb;
}

// "-o,--output" is spoken of as "--output", a word given in order by its name.
std::string spoken(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

// Which option a trouble is about: CLI11 begins its own words with the option's name.
const CLI::Option* optionIn(const CLI::App& app, const std::string& words) {
  const CLI::Option* best = nullptr;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : {option->get_name(), spoken(*option)})
      if (words.starts_with(name + ":") || words.starts_with(name + " ")) best = option;
  return best;
}

// The words nobody asked for. A verb within a verb no longer knows them when it complains; its sentence does, after the
// colon and the last one first.
std::vector<std::string> unexpected(const CLI::App& app, const std::string& words) {
  if (const auto rest = app.remaining(); !rest.empty()) return rest;
  std::vector<std::string> rest;
  const std::size_t colon = words.find(": ");
  if (!words.starts_with("The following argument") || colon == std::string::npos) return rest;
  std::istringstream list(words.substr(colon + 2));
  for (std::string word; list >> word;) rest.insert(rest.begin(), word);
  return rest;
}

}  // namespace

Message wrongCall(const Program& program, const CLI::ParseError& trouble) {
  const Verb verb = verbOf(program.cli);
  const std::string words = trouble.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&trouble) || dynamic_cast<const CLI::RequiredError*>(&trouble)) {
    const std::vector<std::string> rest = unexpected(*verb.app, words);
    if (!rest.empty()) {
      const auto option = std::find_if(rest.begin(), rest.end(), [](const auto& w) { return w.starts_with("-"); });
      const std::string& word = option == rest.end() ? rest.front() : *option;
      if (word.starts_with("-")) return say("“{0}” has no option “{1}”; its options: {0} --help", verb.called, word);
      if (verb.app->get_subcommands({}).empty())
        return say("“{0}” is one word too many for “{1}”; what it takes: {1} --help", word, verb.called);
      return say("“{0}” has no command “{1}”; its commands: {0} --help", verb.called, word);
    }
    for (const CLI::Option* option : verb.app->get_options())
      if (option->get_required() && option->count() == 0)
        return say("“{0}” needs {1}: {2}. How it is called: {0} --help", verb.called, spoken(*option),
                   option->get_description());
    return say("Say what “{0}” should do; its commands: {0} --help", verb.called);
  }
  if (dynamic_cast<const CLI::RequiresError*>(&trouble)) {
    constexpr std::string_view kBetween = " requires ";
    const std::size_t at = words.find(kBetween);
    if (at != std::string::npos)
      return say("{0} goes with {1}; see {2} --help", words.substr(0, at), words.substr(at + kBetween.size()),
                 verb.called);
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&trouble)) {
    constexpr std::string_view kBetween = " excludes ";  // CLI11's own words
    const std::size_t at = words.find(kBetween);
    if (at != std::string::npos)
      return say("{0} and {1} cannot be given together; see {2} --help", words.substr(0, at),
                 words.substr(at + kBetween.size()), verb.called);
  }
  if (const CLI::Option* option = optionIn(*verb.app, words)) {
    if (option->results().empty() || dynamic_cast<const CLI::ArgumentMismatch*>(&trouble))
      return say("{0} needs a value: {1}. See {2} --help", spoken(*option), option->get_description(), verb.called);
    return say("{0} cannot be “{1}”: {2}. See {3} --help", spoken(*option), option->results().back(),
               option->get_description(), verb.called);
  }
  return say("This call cannot be understood ({0}); see {1} --help", words, verb.called);
}

}  // namespace karinui::app
