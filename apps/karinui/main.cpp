// The command line: argument parsing and the exit status; the verbs are in the files beside this one.
#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "commands.h"
#include "fabric_verb.h"
#include "karinui/base/memory.h"
#include "karinui/base/threads.h"
#include "karinui/base/version.h"
#include "wrong_call.h"

int main(int count, char** words) {
  using namespace karinui::app;
  karinui::keepFreedMemory();
  Program program;
  program.threads = karinui::usualThreads();
  program.cli.require_subcommand(1);
  program.cli.option_defaults()->group(help("Options"));
  program.cli.set_version_flag("--version", "karinui " + std::string(karinui::version()),
                               help("Print the version and exit"));
  program.cli.set_help_flag("-h,--help", help("Print this help and exit"));
  program.cli.get_formatter()->label("Usage", help("Usage"));
  program.cli.get_formatter()->label("OPTIONS", help("OPTIONS"));
  program.cli.get_formatter()->label("SUBCOMMAND", help("COMMAND"));
  program.cli.get_formatter()->label("Positionals", help("Given in order"));
  program.cli.get_formatter()->label("REQUIRED", help("(needed)"));
  program.cli.footer(help("A first garment:") +
                     "\n"
                     "  karinui play examples/first_tunic.ops -o tunic.karinui\n"
                     "  karinui picture tunic.karinui -o tunic.png --view oblique\n"
                     "  karinui do tunic.karinui 'cut piece=front line=\"0,-1cm 0,20cm\"'\n"
                     "  karinui undo tunic.karinui\n"
                     "  karinui export tunic.karinui -o tunic.pdf\n" +
                     help("Exit status: 0 done, 2 wrong call, 3 refused input, 4 the cloth did not settle."));
  addBodyVerbs(program);
  addDocumentVerbs(program);
  addWholeDocumentVerbs(program);
  addAnswerVerbs(program);
  addOutputVerbs(program);
  addLayoutVerb(program);
  addRefitVerb(program);
  addSizesVerb(program);
  addReportVerb(program);
  addServeVerb(program);
  addBatchVerbs(program);
  addBenchVerb(program);
  addTouchVerbs(program);
  addFabricVerb(program);
  // “karinui help play” is “karinui play --help”.
  std::vector<char*> given(words, words + count);
  std::string asked = "--help";
  if (count > 1 && given[1] == std::string("help")) {
    given.erase(given.begin() + 1);
    if (count == 2 || !program.cli.get_subcommands([&](CLI::App* verb) { return verb->check_name(given[1]); }).empty())
      given.push_back(asked.data());
  }
  try {
    program.cli.parse(static_cast<int>(given.size()), given.data());
  } catch (const CLI::ParseError& trouble) {
    if (trouble.get_exit_code() == 0) return program.cli.exit(trouble);  // help or the version was asked for
    program.console.json =
        std::any_of(words, words + count, [](const char* word) { return word == std::string("--json"); });
    program.console.refuse(karinui::badInput(wrongCall(program, trouble)));
    return kWrongCall;
  } catch (const std::bad_alloc&) {
    return program.console.refuse(karinui::outOfMemory());
  }
  return program.exit;
}
