#include "readers.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "../apps/karinui/serve_request.h"
#include "design/pack.h"
#include "design/quick_folder.h"
#include "karinui/design/dump.h"
#include "karinui/design/history.h"
#include "karinui/design/make_up.h"
#include "karinui/design/print_image.h"
#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/drawing.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/measurement_files.h"
#include "karinui/exchange/measurement_table.h"
#include "karinui/exchange/pattern_json.h"

namespace karinui::test {

namespace {

void demand(bool promise, const char* what) {
  if (promise) return;
  std::fprintf(stderr, "broken promise of a reader: %s\n", what);
  std::abort();
}

// What every reader of patterns promises, and what an import makes of it.
void use(const Pattern& pattern) {
  for (const auto& [id, piece] : pattern.pieces) {
    demand(piece && piece->id == id && !piece->name.empty(), "a piece has its id and a name");
    demand(bool(checked(piece->outline)), "an outline is whole");
    demand(piece->outline.area() > 0, "an outline runs counter-clockwise");
    for (const Outline& hole : piece->holes) demand(bool(checked(hole)), "a hole is whole");
    for (const Mark& mark : piece->marks)
      demand(mark.edge.empty() || (findEdge(*piece, mark.edge) && mark.fraction >= 0 && mark.fraction <= 1),
             "a notch lies on an edge");
    demand(std::abs(length(piece->grain) - 1) < 1e-6, "the grain is a direction");
  }
  for (const auto& [id, seam] : pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        demand(pattern.pieces.contains(span.piece) && findEdge(*pattern.pieces.at(span.piece), span.edge),
               "a seam is of edges that are there");
  if (pattern.pieces.size() > 12) return;
  Document document;
  document.pattern = pattern;
  const PieceReadings readings = readPieces(pattern);
  (void)copiesFor(document, readings);
  for (const SeamProposal& one : proposeSeams(document, readings))
    demand(one.sure >= 0 && one.sure <= 1 && !one.sew.a.empty() && !one.sew.b.empty(), "a proposal is a seam");
  (void)stepsOf(pattern, {});
}

// A folder for documents, while the program runs.
struct Shelf {
  ~Shelf() { std::filesystem::remove_all(folder); }
  std::filesystem::path fresh(const char* name) const {
    std::filesystem::remove(folder / name);
    return folder / name;
  }
  std::filesystem::path folder = quickFolder();
};
const Shelf& shelf() {
  static const Shelf one;
  return one;
}

// Looks a document through as `karinui load` and `karinui log` do. No cloth is draped for it: that is long work, and it
// was cancelled.
void look(const std::filesystem::path& path) {
  Workers workers(1);
  Token cancelled;
  cancelled.cancel();
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{workers, cancelled, blobs, bodies, {}, {}};
  const auto file = DocumentFile::openForReading(path, &context);
  if (!file) return;
  demand(file->steps().size() == file->document().operations, "a document is where its steps lead");
  demand(bool(parseScript(file->log())), "a log can be played");
  (void)file->undone(), (void)file->otherBranches();
}

void readDump(std::string_view bytes) {
  const auto path = shelf().fresh("loaded.karinui"), again = shelf().fresh("again.karinui");
  if (!loadDump(bytes, path)) return demand(!std::filesystem::exists(path), "what is refused leaves nothing behind");
  const auto dump = dumped(path);
  demand(bool(dump), "what was loaded is dumped");
  demand(bool(loadDump(*dump, again)), "a dump is loaded");
  demand(*dumped(again) == *dump, "a dump of what was loaded is the same text");
  look(path);
}

void readDocument(std::string_view bytes) {
  const auto path = shelf().fresh("given.karinui"), saved = shelf().fresh("saved.karinui");
  std::ofstream(path, std::ios::binary) << bytes;
  look(path);
  (void)dumped(path);
  Workers one(1);
  Token quiet;
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{one, quiet, blobs, bodies, {}, {}};
  context.drape = [](const Document&, const DrapePieces&, Context&) { return Result<DrapeOutcome>(refused({})); };
  context.pull = [](const Document&, const PullCloth&, Context&) { return Result<DrapeOutcome>(refused({})); };
  if (const auto rescued = rescue(path, saved, context)) {
    demand(rescued->steps + rescued->anew > 0, "something was saved");
    demand(bool(dumped(saved)), "what was saved is whole");
    look(saved);
  } else {
    demand(!std::filesystem::exists(saved), "what cannot be saved leaves nothing behind");
  }
}

// What is read is written so that it is read again as the same.
template <class Unpack, class Pack>
void keeps(std::string_view bytes, const Unpack& unpack, const Pack& pack, const char* what) {
  const auto read = unpack(bytes);
  if (!read) return;
  const std::string written = pack(*read);
  const auto again = unpack(written);
  demand(again && pack(*again) == written, what);
}

// What a document keeps beside its steps.
void readParts(std::string_view bytes) {
  keeps(bytes, unpackPiece, packPiece, "a piece is kept");
  keeps(
      bytes, unpackForm, [](const auto& form) { return packForm(*form); }, "a form is kept");
  keeps(bytes, unpackRest, packRest, "the rest of a document is kept");
  keeps(bytes, unpackPrint, packPrint, "a print is kept");
  keeps(bytes, unpackBody, packBody, "a body is kept");
  keeps(
      bytes, unpackFigure, [](const auto& body) { return packFigure(*body); }, "a figure is kept");
  if (const auto print = unpackPrint(bytes)) (void)fitted(*print, 16);
  if (auto body = unpackBody(bytes)) (void)Body::make(*std::move(body));
}

void readRequest(std::string_view line) {
  const auto request = app::parseRequest(line);
  if (!request) return;
  demand(request->is_object(), "a request is an object");
  app::Fields fields(*request);
  (void)fields.needed("do"), (void)fields.text("file"), (void)fields.flag("nest");
  if (const auto number = fields.number("overlap_mm", 5, 30))
    demand(*number >= 5 && *number <= 30, "a number is within its bounds");
  (void)fields.checked();
  const app::Json copy = *request;
  demand(bool(app::parseRequest(copy.dump())), "what was read can be answered");
}

constexpr FuzzedReader kReaders[] = {
    {"dxf", "dxf",
     [](std::string_view bytes) {
       if (const auto read = readCadPattern(bytes)) use(read->pattern);
     }},
    {"grade_rules", "rul",
     [](std::string_view bytes) {
       for (const bool steps : {false, true}) (void)readGradeRules(bytes, steps);
     }},
    {"svg", "svg",
     [](std::string_view bytes) {
       if (const auto read = readDrawing(bytes)) use(read->pattern);
     }},
    {"garment_code", "json",
     [](std::string_view bytes) {
       if (const auto read = readGarmentCode(bytes)) use(*read);
     }},
    {"pattern_json", "json",
     [](std::string_view bytes) {
       if (const auto read = readPatternJson(bytes)) use(*read);
     }},
    {"measures", "measures",
     [](std::string_view bytes) {
       (void)readMeasuresText(bytes), (void)readValentina(bytes), (void)readMeasuresYaml(bytes);
     }},
    {"measurement_table", "csv", [](std::string_view bytes) { (void)readMeasurementTable(bytes); }},
    {"script", "ops",
     [](std::string_view bytes) {
       const auto lines = parseScript(bytes);
       if (!lines) return;
       for (const ScriptLine& line : *lines) {
         const auto again = parseOperation(text(line.operation));
         demand(again && *again == line.operation, "an operation's text is read back");
       }
     }},
    {"dump", "dump", readDump},
    {"document", "document", readDocument},
    {"parts", "parts", readParts},
    {"request", "request", readRequest},
};

}  // namespace

std::span<const FuzzedReader> fuzzedReaders() { return kReaders; }

}  // namespace karinui::test
