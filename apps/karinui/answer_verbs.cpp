// settle, check, info: what a document is and how its cloth stands.
#include <algorithm>

#include "answers_in_words.h"
#include "examination.h"
#include "json_answers.h"
#include "karinui/design/drape.h"
#include "karinui/pattern/truing.h"
#include "motion.h"

namespace karinui::app {

namespace {

struct DocumentOnly {
  std::string path;
};

struct InfoOptions {
  std::string path, piece;
};

struct CheckOptions {
  std::string path, sheet;
  std::vector<std::string> poses;
};

struct SettleOptions {
  std::string path;
  int threads = 0;
  bool again = false;
};

int answerPoses(OpenDocument& opened, const CheckOptions& options) {
  Console& console = opened.program().console;
  const auto fits = fitInMotion(opened.document(), options.poses, opened.context());
  if (!fits) return console.refuse(fits.error());
  if (!options.sheet.empty()) {
    const Result<Image> sheet = motionSheet(opened, *fits);
    if (!sheet) return console.refuse(sheet.error());
    if (const Done done = writePng(options.sheet, *sheet); !done) return console.refuse(done.error());
  }
  Json object = motionJson(*fits);
  if (!options.sheet.empty()) object["file"] = options.sheet;
  console.answer(object, motionWords(*fits, console));
  const auto any = [&](const auto& what) { return std::any_of(fits->begin(), fits->end(), what); };
  if (any([](const FitInPose& fit) { return fit.refused.has_value(); })) return kRefused;
  return any([](const FitInPose& fit) { return !fit.settled; }) ? kNotSettled : kDone;
}

int answerCheck(Program& program, const CheckOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    if (!options.poses.empty()) return answerPoses(opened, options);
    if (const Done done = opened.file().checkSteps(opened.context()); !done)
      return program.console.refuse(done.error());
    const Result<Examination> found = examined(opened.document(), opened.context());
    if (!found) return program.console.refuse(found.error());
    Json object = checkJson(*found, opened.document(), program.console);
    std::string words = program.console.said(restSaid(opened.document())) + "\n";
    words += checkWords(*found, opened.document(), program.console);
    if (const Result<Fit> fit = fitOf(opened)) {
      for (const WideEdge& edge : fit->wide) {
        words += program.console.said(wideEdgeSaid(opened.document(), edge)) + "\n";
        Json run = Json::array();
        for (const EdgeRef& part : edge.run) run.push_back({{"piece", text(part.piece.id)}, {"edge", part.edge}});
        object["wide_edges"].push_back({{"run", run},
                                        {"round_m", edge.round},
                                        {"waist_m", edge.waist},
                                        {"below_m", edge.below},
                                        {"fallen", edge.fallen},
                                        {"narrow", edge.narrow}});
      }
      if (fit->pressure) {
        words += pressureWords(*fit->pressure, opened.document().settings.spacing, program.console);
        object["pressure_mean_kpa"] = fit->pressure->mean / 1000,
        object["pressure_p99_kpa"] = fit->pressure->p99 / 1000;
      }
    }
    const PhotoTall tall = photosIn(opened.file().blobs());
    if (const Json prints = printsJson(opened.document(), tall); !prints.empty()) object["prints"] = prints;
    words += printWords(opened.document(), tall, program.console);
    program.console.answer(object, words);
    return kDone;
  });
}

int answerSettle(Program& program, const SettleOptions& options) {
  if (options.threads > 0) program.threads = options.threads;
  return withDocument(program, options.path, false, [&](OpenDocument& opened) -> int {
    StopRequest stop;
    program.console.stopFirst(&stop);
    const Result<Settled> settled = settle(opened, stop, options.again);
    program.console.stopFirst(nullptr);
    if (!settled) return program.console.refuse(settled.error());
    const SettleReport& report = *opened.document().drape.last;
    Json object = settleJson(report, settled->check, program.console);
    object["kept"] = settled->kept;
    program.console.answer(object, settleWords(settled->check, opened.document(), settled->kept, program.console));
    return report.settled ? kDone : kNotSettled;
  });
}

int answerInfo(Program& program, const InfoOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    if (!options.piece.empty()) {
      std::string names;
      for (const auto& [id, piece] : opened.document().pattern.pieces) {
        names += (names.empty() ? "" : ", ") + piece->name;
        if (piece->name != options.piece && text(id) != options.piece) continue;
        program.console.answer(pieceJson(opened.document(), *piece),
                               pieceWords(opened.document(), *piece, program.console));
        return kDone;
      }
      return program.console.refuse(
          names.empty() ? refused(say("There is no piece “{0}”; there are no pieces yet.", options.piece))
                        : refused(say("There is no piece “{0}”; there are: {1}.", options.piece, names)));
    }
    program.console.answer(infoJson(opened.document()), infoWords(opened.document(), program.console));
    return kDone;
  });
}

int answerTruing(Program& program, const DocumentOnly& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Document& document = opened.document();
    const TruingReport report = truing(document.pattern, document.eases);
    program.console.answer(truingJson(document, report), truingWords(document, report, program.console));
    return kDone;
  });
}

}  // namespace

void addAnswerVerbs(Program& program) {
  auto settle = std::make_shared<SettleOptions>();
  CLI::App* verb =
      program.verb(program.cli, "settle", help("Brings the garment to rest on its body"), settle, answerSettle);
  verb->add_option("document", settle->path, help("The .karinui document"))->required();
  verb->add_option("--threads", settle->threads, help("How many threads work, 1 to 256; the result is the same"))
      ->check(CLI::Range(1, 256));
  verb->add_flag("--again", settle->again, help("Also when it is at rest already"));

  auto checked = std::make_shared<CheckOptions>();
  verb =
      program.verb(program.cli, "check", help("Examines the cloth, independently of the solver"), checked, answerCheck);
  verb->add_option("document", checked->path, help("The .karinui document"))->required();
  CLI::Option* poses = verb->add_option("--poses", checked->poses,
                                        help("Fit in motion: at rest in these poses too, as T,forward,seated"))
                           ->delimiter(',');
  program.output(*verb, "--sheet", checked->sheet, help("with --poses: a PNG file of the poses side by side"), {"png"})
      ->needs(poses);

  auto info = std::make_shared<InfoOptions>();
  verb = program.verb(program.cli, "info", help("Lists pieces, seams and lengths"), info, answerInfo);
  verb->add_option("document", info->path, help("The .karinui document"))->required();
  verb->add_option("--piece", info->piece,
                   help("Of this piece where the ends of its edges, its inner lines and marks lie on paper"));

  auto walked = std::make_shared<DocumentOnly>();
  program
      .verb(program.cli, "truing", help("Walks sewn edges against each other: lengths, and corners across seams"),
            walked, answerTruing)
      ->add_option("document", walked->path, help("The .karinui document"))
      ->required();
}

}  // namespace karinui::app
