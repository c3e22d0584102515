// play, do, undo, redo, log, import: what makes and changes documents.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "figure.h"
#include "json_answers.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/design/dump.h"
#include "karinui/design/make_up.h"
#include "karinui/design/script.h"
#include "karinui/design/step_words.h"
#include "karinui/design/steps_of.h"
#include "karinui/design/variables.h"
#include "karinui/exchange/read_pattern.h"
#include "karinui/exchange/read_print.h"
#include "make_document.h"
#include "open_document.h"
#include "readable_lengths.h"
#include "sizes_said.h"
#include "stage_pictures.h"
#include "text_files.h"

namespace karinui::app {

namespace {

// What makes a document; a document is one already.
constexpr FileContents kImported{FileContent::Pattern, FileContent::Body, FileContent::Script};

struct PlayOptions {
  std::string script, body, out, pictures;
  bool overwrite = false;
};
struct DoOptions {
  std::string path, photo;
  std::vector<std::string> operations;
};
struct DocumentOnly {
  std::string path;
};
struct AmendOptions {
  std::string path, operation;
  std::size_t step = 0;
};
struct ImportOptions {
  std::string file, body, size, rules, unit, out, sew = "none";
  bool overwrite = false, list = false, ruleSteps = false, wrap = false;
};

Result<void> playScript(OpenDocument& opened, const std::string& script, const std::string& body,
                        StagePictures& pictures) {
  const Result<std::vector<ScriptLine>> lines = parseScript(script);
  if (!lines) return lines.error();
  if (lines->empty()) opened.program().console.note(say("The script holds no operation; nothing of it was performed."));
  if (!body.empty()) {
    Result<SetBody> chosen = bodyOperation(opened, body);
    if (!chosen) return chosen.error();
    if (const auto step = opened.perform(std::move(*chosen)); !step) return step.error();
  }
  for (const ScriptLine& line : *lines) {
    if (const Done drawn = pictures.before(line.number, opened); !drawn) return drawn;
    if (!body.empty() && std::holds_alternative<SetBody>(line.operation)) continue;
    if (const auto step = opened.perform(line.operation); !step) {
      const Error& why = step.error();
      return Error{why.kind, say("Line {0}: {1}", line.number, why.what)};
    }
    if (opened.stopped()) {
      opened.program().console.note(
          say("Stopped in line {0}; the garment is kept as it is there. The rest of the script was not played.",
              line.number));
      return {};
    }
  }
  return pictures.rest(opened);
}

int runPlay(Program& program, const PlayOptions& options) {
  const Result<std::string> script = readFile(options.script);
  if (!script) return program.console.refuse(script.error());
  if (isDump(*script)) return program.console.refuse(readByLoad(options.script));
  return makeDocument(program, options.out, options.overwrite, [&](OpenDocument& opened) -> Result<void> {
    StagePictures pictures(options.pictures, *script);
    const Result<void> played = playScript(opened, *script, options.body, pictures);
    return played ? played : inFile(options.script, played.error());
  });
}

// The photograph becomes a part of the document: the operations `look` print it, the first `underlay` is traced.
Done giveThePhoto(OpenDocument& opened, const std::string& photo, std::vector<Operation>& operations) {
  if (photo.empty()) return {};
  const auto is = [&]<class Op>(const Op*) {
    return std::find_if(operations.begin(), operations.end(),
                        [](const Operation& one) { return std::holds_alternative<Op>(one); });
  };
  const auto look = is(static_cast<SetLook*>(nullptr)), underlay = is(static_cast<LayUnderlay*>(nullptr));
  if (look == operations.end() && underlay == operations.end())
    return refused(
        say("A photograph is printed by the operation look ('look fabric=cotton repeat=20cm') and traced by "
            "'underlay'."));
  const Token& token = opened.context().token;
  const auto keep = [&](const PrintPixels& image) { return opened.file().blobs().put(packPrint(image)); };
  if (look != operations.end()) {
    const auto image = readPrint(photo, token);
    if (!image) return image.error();
    const auto blob = keep(*image);
    if (!blob) return blob.error();
    for (Operation& operation : operations)
      if (auto* one = std::get_if<SetLook>(&operation); one && one->photo.empty()) one->photo = *blob;
  }
  if (underlay != operations.end()) {
    const auto scan = readScan(photo, token);
    if (!scan) return scan.error();
    if (const auto shrunk = scan->shrunk()) opened.program().console.note(*shrunk);
    const auto blob = keep(scan->image);
    if (!blob) return blob.error();
    if (auto& lay = std::get<LayUnderlay>(*underlay); lay.photo.empty()) lay.photo = *blob;
  }
  return {};
}

std::string echoed(const Operation& operation) { return shortened(withReadableLengths(text(operation))); }

// "piece=front": a field, which stands behind its operation.
bool isField(const std::string& word) {
  const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_");
  return end != std::string::npos && end > 0 && word[end] == '=';
}

// Where the quotation marks were forgotten, the shell has made a word of each field.
Done inQuotationMarks(const std::vector<std::string>& words) {
  const auto field = std::find_if(words.begin(), words.end(), isField);
  if (field == words.end()) return {};
  std::string whole = field == words.begin() ? "OPERATION" : *(field - 1);
  for (auto one = field; one != words.end() && isField(*one); ++one) {
    const std::size_t value = one->find('=') + 1;
    const bool several = one->find(' ', value) != std::string::npos;
    whole += " " + one->substr(0, value) + (several ? "\"" : "") + one->substr(value) + (several ? "\"" : "");
  }
  return badInput(
      say("“{0}” stands by itself: an operation and its fields are one word to the shell, in quotation marks: '{1}'.",
          *field, whole));
}

int runDo(Program& program, const DoOptions& options) {
  if (const Done quoted = inQuotationMarks(options.operations); !quoted) return program.console.refuse(quoted.error());
  std::vector<Operation> operations;
  for (const std::string& line : options.operations) {
    Result<Operation> operation = parseOperation(line);
    if (!operation) return program.console.refuse(operation.error());
    operations.push_back(std::move(*operation));
  }
  return withDocument(program, options.path, false, [&](OpenDocument& opened) -> int {
    if (const Done printed = giveThePhoto(opened, options.photo, operations); !printed)
      return program.console.refuse(printed.error());
    for (std::size_t done = 0; done < operations.size(); ++done) {
      const Result<Step> step = opened.perform(std::move(operations[done]));
      if (!step) {  // each operation is on disk by itself: those before stay
        if (done > 0)
          program.console.note(say("Done and kept: {0} of {1} {1|operation|operations}.", done, operations.size()));
        return program.console.refuse(step.error());
      }
      program.console.answer(stepJson(*step, opened.document()), echoed(step->operation));
      if (opened.stopped()) break;
    }
    return opened.settled() ? kDone : kNotSettled;
  });
}

template <Result<Step> (DocumentFile::*turn)(Context&)>
int runTurn(Program& program, const DocumentOnly& options) {
  return withDocument(program, options.path, false, [&](OpenDocument& opened) -> int {
    const Result<Step> step = (opened.file().*turn)(opened.context());
    if (!step) return program.console.refuse(step.error());
    Json object = {{"operation", text(step->operation)},
                   {"operations", opened.document().operations},
                   {"hash", hash(opened.document())}};
    const std::string operation = echoed(step->operation);
    program.console.answer(object,
                           program.console.said(turn == &DocumentFile::undo ? say("Taken back: {0}", operation)
                                                                            : say("Done again: {0}", operation)));
    return kDone;
  });
}

int runAmend(Program& program, const AmendOptions& options) {
  Result<Operation> operation = parseOperation(options.operation);
  if (!operation) return program.console.refuse(operation.error());
  return withDocument(program, options.path, false, [&](OpenDocument& opened) -> int {
    if (const Done amended = opened.amend(options.step, *std::move(operation)); !amended)
      return program.console.refuse(amended.error());
    const Document& document = opened.document();
    Json answer = {{"operations", document.operations}, {"hash", hash(document)}};
    answer.update(restJson(document, opened.settled()));
    program.console.answer(answer, withReadableLengths(opened.file().log()));
    return opened.settled() ? kDone : kNotSettled;
  });
}

int runLog(Program& program, const DocumentOnly& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    Json steps = Json::array();
    for (const Step& step : opened.file().steps()) {
      steps.push_back(
          {{"serial", step.serial}, {"operation", withShortLengths(text(step.operation))}, {"hash", step.after}});
    }
    program.console.answer({{"operations", steps}}, withReadableLengths(opened.file().log()));
    return kDone;
  });
}

// The edges as `sew` takes them: on flat paper that stands nowhere yet, left and right are not the wearer's.
std::string sideSaid(const std::vector<EdgeRef>& side, const Document& document) {
  std::string all;
  for (const EdgeRef& edge : side) {
    all += (all.empty() ? "" : " + ") + document.find(edge.piece.id)->name + "." + edge.edge;
    if (edge.from > 0 || edge.to < 1) all += "@" + fixed(edge.from, 3) + ":" + fixed(edge.to, 3);
  }
  return all;
}

Json proposalJson(Program& program, const SeamProposal& one, const Document& document) {
  return {{"name", one.sew.name},
          {"operation", text(Operation(one.sew))},
          {"sure", one.sure},
          {"sewn", one.sure >= kSureSeam},
          {"a", sideSaid(one.sew.a, document)},
          {"b", sideSaid(one.sew.b, document)},
          {"reason", program.console.said(one.reason)}};
}

Message proposalSaid(const SeamProposal& one, const Document& document) {
  return say("{0}% {1}: {2} — {3} ({4})", static_cast<int>(std::lround(one.sure * 100)), one.sew.name,
             sideSaid(one.sew.a, document), sideSaid(one.sew.b, document), one.reason);
}

// Makes up a pattern that came without its sewing, and tells what it left to the person.
Done madeUp(OpenDocument& opened) {
  Console& console = opened.program().console;
  auto making = makeUp(opened.document(), opened.context());
  if (!making) return making.error();
  for (Operation& operation : making->steps)
    if (const auto step = opened.perform(std::move(operation)); !step) return step.error();
  for (const PieceId id : making->unknown)
    console.note(say("“{0}” was not recognised; it stands beside the figure.", opened.document().find(id)->name));
  for (const SeamProposal& one : making->unsure)
    console.note(say("Not sewn: {0}", proposalSaid(one, opened.document())));
  for (const Message& note : making->notes) console.note(say("Not sewn: {0}", note));
  return {};
}

// Where nobody said which of several sizes stands: which is nearest to the body.
Done sizesTold(OpenDocument& opened) {
  const Document& document = opened.document();
  if (document.grading.empty() || !document.body.chosen()) return {};
  const auto body = bodyOf(document, opened.context());
  if (!body) return body.error();
  Json json;
  if (const auto fit = sizeFit(document, nullptr, (*body)->measured()))
    for (const Message& said : sizesSaid(*fit, document.grading, json)) opened.program().console.note(said);
  return {};
}

// What the pattern would become, in memory.
Result<Document> drawnUp(const CadPattern& read, Context& context) {
  Document document;
  for (const Operation& operation :
       stepsOf(read.pattern, document, read.grading, read.cutting, nullptr, read.fabrics)) {
    auto next = apply(document, operation, context);
    if (!next) return next.error();
    document = *std::move(next);
  }
  return document;
}

// The pieces of a pattern file, its sizes, what was guessed, and (`sewing`) the seams that would be proposed.
int runList(Program& program, const ImportOptions& options, bool sewing) {
  auto read =
      readPatternSize(options.file, options.size, fileFormats(), {options.rules, options.ruleSteps}, options.unit);
  if (!read) return program.console.refuse(read.error());
  Workers workers(program.threads);
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{workers, program.console.token(), blobs, bodies, {}, {}};
  auto made = drawnUp(*read, context);
  if (!made) return program.console.refuse(made.error());
  Document document = *std::move(made);
  Json notes = Json::array(), pieces = Json::array(), seams = Json::array();
  std::string lines;
  const auto line = [&](const Message& what) { lines += program.console.said(what) + "\n"; };
  if (!read->style.empty()) line(say("Style: {0}", read->style));
  if (!read->size.empty()) {
    std::string sizes;
    for (const std::string& size : read->sizes) sizes += (sizes.empty() ? "" : ", ") + size;
    line(say("Sizes: {0}; read: {1}", sizes, read->size));
  }
  PieceReadings readings = readPieces(document.pattern);
  for (const auto& [id, piece] : document.pattern.pieces) {
    const Flat size = boxOf(piece->outline.flattened(1e-4)).size();
    const auto row = std::find_if(read->rows.begin(), read->rows.end(),
                                  [&name = piece->name](const auto& one) { return usableName({}, one.name) == name; });
    const int quantity = row == read->rows.end() ? 1 : row->quantity;
    const PieceReading& reading = readings.at(id);
    pieces.push_back({{"name", piece->name},
                      {"width_mm", size.u * 1000},
                      {"height_mm", size.v * 1000},
                      {"edges", piece->outline.edges.size()},
                      {"marks", piece->marks.size()},
                      {"quantity", quantity},
                      {"role", program.console.said(roleSaid(reading.role))},
                      {"sure", reading.sure}});
    line(say("{0}: {1} × {2} mm, {3} {3|edge|edges}, {4} {4|mark|marks}, cut {5}; {6}", piece->name,
             fixed(size.u * 1000, 0), fixed(size.v * 1000, 0), piece->outline.edges.size(), piece->marks.size(),
             quantity, roleSaid(reading.role)));
  }
  if (sewing && read->pattern.seams.empty()) {
    for (const Operation& copy : copiesFor(document, readings))
      if (auto next = apply(document, copy, context)) document = *std::move(next);
    readings = readPieces(document.pattern);
    for (const SeamProposal& one : proposeSeams(document, readings)) {
      seams.push_back(proposalJson(program, one, document));
      line(proposalSaid(one, document));
    }
  }
  if (!read->pattern.seams.empty()) line(say("{0} {0|seam|seams} in the file.", read->pattern.seams.size()));
  for (const Message& note : read->notes) notes.push_back(program.console.said(note)), line(note);
  if (!lines.empty()) lines.pop_back();
  program.console.answer({{"style", read->style},
                          {"sizes", read->sizes},
                          {"size", read->size},
                          {"pieces", pieces},
                          {"seams_in_file", read->pattern.seams.size()},
                          {"seams", seams},
                          {"notes", notes}},
                         lines);
  return kDone;
}

int runImport(Program& program, const ImportOptions& options) {
  const FileContent content = contentOf(options.file);
  if (options.sew != "none" && options.sew != "auto" && options.sew != "list")
    return program.console.refuse(badInput(say("--sew is auto, list or none.")));
  const bool onlyListed = options.list || options.sew == "list";
  if (onlyListed && content != FileContent::Pattern)
    return program.console.refuse(unreadable(options.file, {FileContent::Pattern}));
  if (onlyListed) return runList(program, options, options.sew != "none");
  if (options.out.empty()) return program.console.refuse(badInput(say("Say where the document goes: -o FILE.karinui")));
  if (content == FileContent::Script)
    return runPlay(program, {options.file, options.body, options.out, "", options.overwrite});
  if (content != FileContent::Pattern && content != FileContent::Body) {
    const Result<std::string> text = readFile(options.file);
    return program.console.refuse(text && isDump(*text)     ? readByLoad(options.file)
                                  : text && isScript(*text) ? readByPlay(options.file)
                                                            : unreadable(options.file, kImported));
  }
  return makeDocument(program, options.out, options.overwrite, [&](OpenDocument& opened) -> Result<void> {
    std::optional<CadPattern> drawn;
    if (content == FileContent::Pattern) {
      Result<CadPattern> read =
          readPatternSize(options.file, options.size, fileFormats(), {options.rules, options.ruleSteps}, options.unit);
      if (!read) return read.error();
      for (const Message& note : read->notes) program.console.note(note);
      drawn = *std::move(read);
    }
    const std::string body = drawn ? options.body : options.file;
    if (!body.empty()) {
      Result<SetBody> chosen = bodyOperation(opened, body, options.wrap);
      if (!chosen) return chosen.error();
      if (const auto step = opened.perform(std::move(*chosen)); !step) return step.error();
    }
    if (!drawn) return {};
    if (!body.empty()) {
      const Result<BodyPtr> figure = bodyOf(opened.document(), opened.context());
      if (!figure) return figure.error();
      RaisedPattern raised = raisedTo(**figure, std::move(drawn->pattern));
      if (raised.by != 0)
        program.console.note(say("The pieces were carried {0} by {1} cm, to the height of this body.",
                                 raised.by > 0 ? say("up") : say("down"), fixed(100 * std::fabs(raised.by), 0)));
      drawn->pattern = std::move(raised.pattern);
    }
    for (const Message& note : unknownFabricsSaid(drawn->pattern, opened.document(), drawn->fabrics))
      program.console.note(note);
    for (Operation& operation : stepsOf(drawn->pattern, opened.document(), drawn->grading, drawn->cutting,
                                        &opened.file().blobs(), drawn->fabrics))
      if (const auto step = opened.perform(std::move(operation)); !step) return step.error();
    if (options.sew == "auto" && drawn->pattern.seams.empty())
      if (const Done done = madeUp(opened); !done) return done;
    return options.size.empty() ? sizesTold(opened) : Done{};
  });
}

std::string padded(const std::string& name, std::size_t width) {
  return "  " + name + std::string(std::max(width, name.size() + 1) - name.size(), ' ');
}

// All operations, or the fields of the one that is named.
std::string vocabulary(const std::string& named) {
  const std::vector<OperationHelp> all = operationHelp();
  const auto one = std::find_if(all.begin(), all.end(), [&](const OperationHelp& o) { return o.name == named; });
  std::string lines;
  if (one != all.end()) {
    lines = one->name + ": " + help(one->help) + "\n";
    for (const FieldHelp& field : one->fields) {
      lines += padded(field.name + "=", 16) + help(field.help) + (field.needed ? " " + help("(needed)") : "") + "\n";
    }
    return lines;
  }
  lines = help("Operations:") + "\n";
  for (const OperationHelp& operation : all) lines += padded(operation.name, 10) + help(operation.help) + "\n";
  return lines + help("Their fields: karinui do --help OPERATION, or docs/format/operations.md");
}

struct VariablesOptions {
  std::string path, formula;
};

// The table of variables, or what one formula is in this garment.
int runVariables(Program& program, const VariablesOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    DocumentNames names(opened.document(), opened.context());
    if (!options.formula.empty()) {
      const Result<Quantity> value = workedOut(options.formula, names);
      if (!value) return program.console.refuse(value.error());
      program.console.answer({{"formula", options.formula}, {"value", value->value}},
                             quantitySaid(*value, false) + "\n");
      return kDone;
    }
    Json rows = Json::array();
    std::string lines;
    for (const VariableRow& row : variablesOf(opened.document(), names)) {
      Json object = {{"name", row.name}, {"formula", row.formula}};
      if (row.value) object["value"] = row.value->value;
      rows.push_back(object);
      lines += row.name + " = " + row.formula + "  # " +
               (row.value ? quantitySaid(*row.value, false) : program.console.said(row.value.error().what)) + "\n";
    }
    if (lines.empty()) lines = program.console.said(say("There are no variables.")) + "\n";
    program.console.answer({{"variables", rows}}, lines);
    return kDone;
  });
}

}  // namespace

void addDocumentVerbs(Program& program) {
  auto play = std::make_shared<PlayOptions>();
  CLI::App* verb =
      program.verb(program.cli, "play", help("Plays a script of operations into a new document"), play, runPlay);
  verb->add_option("script", play->script, help("The script: one operation a line"))->required();
  program.output(*verb, "-o,--output", play->out, help("The .karinui document to make"), {"karinui"})->required();
  verb->add_option("--body", play->body, help("A body file (or built-in size) instead of the script's own"));
  program.outputFolder(*verb, "--pictures", play->pictures,
                       help("A folder for the pictures the script asks for (\"# picture: NAME view=front\")"));
  verb->add_flag("--overwrite", play->overwrite, help("Replace a document that is there already"));
  verb->footer(vocabulary(""));

  auto perform = std::make_shared<DoOptions>();
  verb = program.verb(program.cli, "do", help("Does operations on a document"), perform, runDo);
  verb->add_option("document", perform->path, help("The .karinui document"))->required();
  verb->add_option("operation", perform->operations, help("'OP key=value …', one or more"))->required();
  verb->add_option("--photo", perform->photo,
                   help("A photograph (PNG or JPEG) for the operation look, or a scan for underlay"));
  verb->footer([perform] { return vocabulary(perform->path); });

  auto undo = std::make_shared<DocumentOnly>(), redo = std::make_shared<DocumentOnly>(),
       log = std::make_shared<DocumentOnly>();
  program.verb(program.cli, "undo", help("Takes the last operation back"), undo, runTurn<&DocumentFile::undo>)
      ->add_option("document", undo->path, help("The .karinui document"))
      ->required();
  program.verb(program.cli, "redo", help("Does again what was taken back"), redo, runTurn<&DocumentFile::redo>)
      ->add_option("document", redo->path, help("The .karinui document"))
      ->required();
  auto amend = std::make_shared<AmendOptions>();
  verb = program.verb(program.cli, "amend", help("Makes a step another one; those after it are played again"), amend,
                      runAmend);
  verb->add_option("document", amend->path, help("The .karinui document"))->required();
  verb->add_option("step", amend->step, help("Which step, from 1, as log numbers them"))->required();
  verb->add_option("operation", amend->operation, help("'OP key=value …', as it should have been"))->required();
  verb->footer([amend] { return vocabulary(amend->path); });
  program.verb(program.cli, "log", help("Writes the operations as a script that play reads"), log, runLog)
      ->add_option("document", log->path, help("The .karinui document"))
      ->required();

  auto variables = std::make_shared<VariablesOptions>();
  verb = program.verb(program.cli, "variables", help("Lists the variables of a document and what they are now"),
                      variables, runVariables);
  verb->add_option("document", variables->path, help("The .karinui document"))->required();
  verb->add_option("formula", variables->formula, help("A formula to work out instead: 'bust_girth/4 + 1cm'"));

  auto import = std::make_shared<ImportOptions>();
  verb = program.verb(program.cli, "import", help("Makes a document from a pattern, a body or a script"), import,
                      runImport);
  verb->add_option("file", import->file, help(say("The file: {0}", listRead(kImported))))->required();
  program.output(*verb, "-o,--output", import->out, help("The .karinui document to make"), {"karinui"});
  verb->add_flag("--list", import->list, help("Only lists the pieces, sizes and notes of a pattern file"));
  verb->add_option("--sew", import->sew,
                   help("Of a pattern without seams: auto sews those that are sure and stands the pieces on the body; "
                        "list only shows what would be sewn"));
  verb->add_option("--size", import->size,
                   help("Of a style in several sizes the one that stands; else its sample size"));
  verb->add_option("--rules", import->rules,
                   help("Grade rules (RUL) for the numbered points of a DXF; else those beside it"));
  verb->add_flag("--rule-steps", import->ruleSteps,
                 help("The rules say how far a point goes from each size to the next, not from the sample size"));
  verb->add_option(
      "--unit", import->unit,
      help("What a unit of a DXF or SVG is, where the file does not tell it or is wrong: mm, cm, m, in, pt"));
  verb->add_option("--body", import->body, help("A body file or built-in size to put the pattern on"));
  verb->add_flag("--wrap", import->wrap, help("Close a scan's holes first"));
  verb->add_flag("--overwrite", import->overwrite, help("Replace a document that is there already"));
}

}  // namespace karinui::app
