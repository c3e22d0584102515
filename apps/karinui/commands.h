#pragma once
// The verbs of the command line. Each add… hangs its verbs on the program and leaves the exit status in `exit` when
// run.
#include <CLI/CLI.hpp>

#include "console.h"
#include "karinui/base/workers.h"

namespace karinui::app {

// A word of a few, in letters of either case.
inline CLI::IsMember oneOf(std::vector<std::string> words) { return CLI::IsMember(std::move(words), CLI::ignore_case); }

struct Program {
  CLI::App cli{help("Karinui: made-to-measure clothes, designed on a body, draped, and printed as true-size patterns."),
               "karinui"};
  Console console;
  int threads = 2;
  int exit = kDone;

  // A word of the command line, with its help in the person's language throughout.
  static CLI::App* word(CLI::App& parent, const std::string& name, const std::string& what) {
    CLI::App* added = parent.add_subcommand(name, what);
    added->group(help("Commands"));
    added->set_help_flag("-h,--help", help("Print this help and exit"))->group(help("Options"));
    return added;
  }

  // An option that names what the verb writes: a file of one of the endings, or with `folder` (null: never) given a
  // folder. It is refused before the verb runs where mayWrite() says so, and stands by itself in the help.
  template <class Name>
  CLI::Option* output(CLI::App& verb, const std::string& names, Name& into, const std::string& what,
                      std::vector<std::string> endings, const CLI::Option* folder = nullptr) {
    CLI::Option* option = verb.add_option(names, into, what)->group(help("Writes"));
    outputs_.push_back({&verb, option, std::move(endings), folder});
    return option;
  }
  template <class Name>
  CLI::Option* outputFolder(CLI::App& verb, const std::string& names, Name& into, const std::string& what) {
    CLI::Option* option = verb.add_option(names, into, what)->group(help("Writes"));
    outputs_.push_back({&verb, option, {}, option});
    return option;
  }

  // A verb with --json; `run` gives the exit status.
  template <class Options>
  CLI::App* verb(CLI::App& parent, const std::string& name, const std::string& what, std::shared_ptr<Options> options,
                 int (*run)(Program&, const Options&)) {
    CLI::App* added = word(parent, name, what);
    added->add_flag("--json", console.json, help("Answer with one JSON object"));
    added->callback([this, added, options, run] {
      const Done named = outputsNamed(*added);
      exit = named ? run(*this, *options) : console.refuse(named.error());
    });
    return added;
  }

 private:
  struct Output {
    const CLI::App* verb;
    const CLI::Option* option;
    std::vector<std::string> endings;
    const CLI::Option* folder;
  };
  Done outputsNamed(const CLI::App& verb) const;
  std::vector<Output> outputs_;
};

void addBodyVerbs(Program& program);           // body make, body measure
void addDocumentVerbs(Program& program);       // play, do, undo, redo, log, import
void addWholeDocumentVerbs(Program& program);  // rescue, dump, load, share
void addAnswerVerbs(Program& program);         // settle, check, info
void addOutputVerbs(Program& program);         // export, picture
void addLayoutVerb(Program& program);          // layout
void addRefitVerb(Program& program);           // refit
void addSizesVerb(Program& program);           // sizes
void addReportVerb(Program& program);          // report
void addServeVerb(Program& program);           // serve
void addBatchVerbs(Program& program);          // batch plan, run, merge, submit
void addBenchVerb(Program& program);           // bench
void addTouchVerbs(Program& program);          // touch check, touch replay

}  // namespace karinui::app
