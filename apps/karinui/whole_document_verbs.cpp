// rescue, dump, load, share: whole documents made of others.
#include <filesystem>

#include "karinui/base/file.h"
#include "karinui/design/dump.h"
#include "karinui/design/share.h"
#include "open_document.h"
#include "text_files.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

struct FromTo {
  std::string path, out;
  bool overwrite = false, unnamed = false;
};

int runRescue(Program& program, const FromTo& options) {
  Workers workers(program.threads);
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{workers, program.console.token(), blobs, bodies, {}, {}};
  const Result<Rescued> rescued = rescue(options.path, options.out, context);
  if (!rescued) return program.console.refuse(rescued.error());
  for (const Message& remark : rescued->remarks) program.console.note(remark);
  program.console.answer({{"steps", rescued->steps}, {"lost", rescued->lost}, {"anew", rescued->anew}},
                         program.console.said(rescuedSaid(*rescued)));
  return kDone;
}

int runDump(Program& program, const FromTo& options) {
  const Result<std::string> dump = dumped(options.path);
  if (!dump) return program.console.refuse(dump.error());
  if (options.out.empty()) {
    program.console.answer({{"dump", *dump}}, *dump);
    return kDone;
  }
  if (const Done done = writeFile(options.out, *dump, Readers::Owner); !done)
    return program.console.refuse(done.error());
  program.console.answer({{"file", options.out}, {"bytes", dump->size()}}, options.out);
  return kDone;
}

int runLoad(Program& program, const FromTo& options) {
  const Result<std::string> dump = readFile(options.path);
  if (!dump) return program.console.refuse(dump.error());
  if (isScript(*dump)) return program.console.refuse(readByPlay(options.path));
  if (const Done done = loadDump(*dump, options.out); !done)
    return program.console.refuse(inFile(options.path, done.error()));
  const int exit = withDocument(program, options.out, true, [&](OpenDocument& opened) -> int {
    if (const Done done = opened.file().checkSteps(opened.context()); !done)
      return program.console.refuse(done.error());
    program.console.answer({{"document", options.out},
                            {"operations", opened.document().operations},
                            {"hash", hash(opened.document())},
                            {"drape_hash", drapeHash(opened.document())}},
                           options.out);
    return kDone;
  });
  std::error_code trouble;
  if (exit != kDone) fs::remove(options.out, trouble);
  return exit;
}

int runShare(Program& program, const FromTo& options) {
  std::error_code trouble;
  if (!options.overwrite && fs::exists(options.out, trouble))
    return program.console.refuse(
        refused(say("“{0}” is there already. Choose another name, or say --overwrite.", options.out)));
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Result<Shared> shared =
        share(opened.file(), options.out, opened.context(), options.unnamed ? SharedNames::Neutral : SharedNames::Kept);
    if (!shared) return program.console.refuse(shared.error());
    for (const Message& note : shared->notes) program.console.note(note);
    program.console.answer({{"document", options.out}, {"names", shared->names}},
                           options.out + "\n" + program.console.said(sharedSaid(*shared)));
    return kDone;
  });
}

}  // namespace

void addWholeDocumentVerbs(Program& program) {
  const auto add = [&](const char* name, const std::string& about, const char* from, const std::string& what,
                       int (*run)(Program&, const FromTo&)) {
    auto options = std::make_shared<FromTo>();
    CLI::App* verb = program.verb(program.cli, name, about, options, run);
    verb->add_option(from, options->path, what)->required();
    return std::pair(verb, options);
  };
  const std::string document = help("The .karinui document"), made = help("The .karinui document to make");
  const auto [saves, saved] =
      add("rescue", help("Saves what is whole of a damaged document in a new one"), "document", document, runRescue);
  program.output(*saves, "-o,--output", saved->out, made, {"karinui"})->required();
  const auto [dumps, dump] = add("dump", help("Writes the whole document as text, for version control; load reads it"),
                                 "document", document, runDump);
  program.output(*dumps, "-o,--output", dump->out, help("The text file (.txt); otherwise it is written to the screen"),
                 {"txt"});
  const auto [loads, loaded] =
      add("load", help("Makes a document of what dump wrote"), "dump", help("The text file that dump wrote"), runLoad);
  program.output(*loads, "-o,--output", loaded->out, made, {"karinui"})->required();
  const auto [shares, shared] =
      add("share", help("Writes the pattern for others, without figure, measurements, formulas and history"),
          "document", document, runShare);
  program.output(*shares, "-o,--output", shared->out, made, {"karinui"})->required();
  shares->add_flag("--unnamed", shared->unnamed, help("Replace all names in it by neutral ones: piece1, seam2, edge3"));
  shares->add_flag("--overwrite", shared->overwrite, help("Replace a document that is there already"));
}

}  // namespace karinui::app
