// layout: the pieces laid on the cloth they are cut from.
#include <algorithm>
#include <cmath>

#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/exchange/formats.h"
#include "karinui/exchange/lay_sheet.h"
#include "outputs.h"
#include "written_files.h"

namespace karinui::app {

namespace {

struct LayoutOptions {
  std::string path, out, width = "150cm", gap = "5mm", stripes, rows, fabric, paper;
  bool folded = false, nap = false;
  std::optional<double> allowanceMm;
  std::optional<double> overlapMm;
  int tries = LaySettings().tries;
  std::uint64_t seed = 1;
};

Result<LaySettings> settingsOf(const LayoutOptions& options) {
  LaySettings settings;
  const auto read = [](const std::string& words, double& into) -> Done {
    if (words.empty()) return {};
    if (Done meant = unitMeant(words); !meant) return meant;
    const auto length = parseLength(words);
    if (!length) return length.error();
    into = *length;
    return {};
  };
  for (const auto& [words, into] : {std::pair{&options.width, &settings.width},
                                    {&options.gap, &settings.gap},
                                    {&options.stripes, &settings.stripes},
                                    {&options.rows, &settings.rows}})
    if (const Done done = read(*words, *into); !done) return done.error();
  settings.folded = options.folded;
  settings.nap = options.nap;
  settings.fabric = options.fabric;
  settings.tries = options.tries;
  settings.seed = options.seed;
  if (options.allowanceMm) settings.allowance = *options.allowanceMm / 1000;
  return settings;
}

int runLayout(Program& program, const LayoutOptions& options) {
  const Result<LaySettings> settings = settingsOf(options);
  if (!settings) {
    program.console.refuse(settings.error());
    return kWrongCall;
  }
  const std::string ending = endingOf(options.out);
  for (const auto& [name, asked] :
       {std::pair("--paper", !options.paper.empty()), {"--overlap", options.overlapMm.has_value()}})
    if (asked && ending != "pdf") return program.console.refuse(unasked(name, options.out));
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Result<LayPlan> plan = layPlan(opened.document(), *settings, opened.context());
    if (!plan) return program.console.refuse(plan.error());
    for (const Message& note : plan->notes) program.console.note(note);
    if (!options.out.empty()) {
      LayPaper paper;
      paper.title = std::filesystem::path(options.path).stem().string();
      paper.paper = fileFormat(paperFormat(options.paper)).paper;
      if (options.overlapMm) paper.overlap = *options.overlapMm / 1000;
      paper.language = spokenHere();
      const Result<std::string> bytes = writeLay(*plan, ending, paper);
      if (!bytes) return program.console.refuse(bytes.error());
      if (const Done done = writeFile(options.out, *bytes); !done) return program.console.refuse(done.error());
    }
    Json fabrics = Json::array();
    std::string words;
    for (std::size_t i = 0; i < plan->fabrics.size(); ++i) {
      const FabricLay& lay = plan->fabrics[i];
      fabrics.push_back({{"fabric", lay.fabric},
                         {"length_m", lay.length},
                         {"width_m", plan->settings.width},
                         {"area_m2", lay.area},
                         {"use", lay.use},
                         {"pieces", lay.pieces.size()}});
      words += (i ? "\n" : "") + program.console.said(laySaid(*plan)[i]);
    }
    program.console.answer({{"file", options.out}, {"folded", plan->settings.folded}, {"fabrics", fabrics}}, words);
    return kDone;
  });
}

}  // namespace

void addLayoutVerb(Program& program) {
  auto options = std::make_shared<LayoutOptions>();
  CLI::App* verb = program.verb(program.cli, "layout",
                                help("Lays the pieces on the cloth they are cut from, and tells how much it takes"),
                                options, runLayout);
  verb->add_option("document", options->path, help("The .karinui document"))->required();
  CLI::Option* out =
      program.output(*verb, "-o,--output", options->out, help("The lay plan at true size: .pdf, .svg, .dxf or .plt"),
                     {std::begin(kLayEndings), std::end(kLayEndings)});
  verb->add_option("--width", options->width, help("Of the cloth, laid open: 150cm"));
  verb->add_flag("--fold", options->folded,
                 help("The cloth is folded lengthwise: pairs are cut at once, halves lie on the fold"));
  verb->add_option("--gap", options->gap, help("Between the cut lines of two pieces: 5mm"));
  verb->add_flag("--nap", options->nap, help("All pieces lie the same way up: nap, or a print with a direction"));
  verb->add_option("--stripes", options->stripes,
                   help("Repeat of stripes along the cloth, counted across it; they are centred on each piece"));
  verb->add_option("--rows", options->rows,
                   help("Repeat of stripes across the cloth, counted along it; they meet in the seams"));
  verb->add_option("--fabric", options->fabric, help("Only the pieces of this fabric"));
  verb->add_option("--allowance", options->allowanceMm,
                   help("paper: seam allowance in mm in place of the document's own, up to 100, 0 for none"))
      ->check(CLI::Range(0.0, 100.0));
  verb->add_option("--paper,--page", options->paper,
                   help("PDF: one true-size sheet (sheet), or pages to glue: a4, letter, a3, a0, 36in"))
      ->transform(oneOf({kPapers.begin(), kPapers.end()}))
      ->needs(out);
  verb->add_option("--overlap", options->overlapMm, help("paper: how far glued pages overlap in mm, 5 to 30"))
      ->check(CLI::Range(5.0, 30.0))
      ->needs(out);
  verb->add_option("--tries", options->tries, help("How many orders of the pieces are tried; more take less cloth"))
      ->check(CLI::Range(0, 100'000'000));
  verb->add_option("--seed", options->seed, help("Another number tries other orders"));
}

}  // namespace karinui::app
