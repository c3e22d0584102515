#pragma once
// The verbs of the command line. Each add… hangs its verbs on the program and leaves the exit status in `exit` when
// run.
#include <CLI/CLI.hpp>

#include "console.h"
#include "karinui/base/workers.h"

namespace karinui::app {

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

  // A verb with --json; `run` gives the exit status.
  template <class Options>
  CLI::App* verb(CLI::App& parent, const std::string& name, const std::string& what, std::shared_ptr<Options> options,
                 int (*run)(Program&, const Options&)) {
    CLI::App* added = word(parent, name, what);
    added->add_flag("--json", console.json, help("Answer with one JSON object"));
    added->callback([this, options, run] { exit = run(*this, *options); });
    return added;
  }
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
