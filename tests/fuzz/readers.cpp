#include "readers.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "../apps/karinui-room/pose_script.h"
#include "../apps/karinui/batch/manifest.h"
#include "../apps/karinui/serve_request.h"
#include "design/pack.h"
#include "design/quick_folder.h"
#include "devices/json_scan.h"
#include "exchange/reading_process.h"
#include "karinui/base/file.h"
#include "karinui/design/dump.h"
#include "karinui/design/formula.h"
#include "karinui/design/history.h"
#include "karinui/design/make_up.h"
#include "karinui/design/print_image.h"
#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"
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

// A recorded hand, and what `karinui touch replay` makes of it.
void readHand(std::string_view bytes) {
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (const auto sample = parsePointerSample(line)) {
      const auto again = parsePointerSample(text(*sample));
      demand(again && *again == *sample, "a line of a recording is read back");
    }
  }
  constexpr double kTick = 0.001;
  auto hand = ScriptedDevice::read(bytes, simulatedRecord(), kTick, 0.01);
  if (!hand) return;
  demand(hand->begins() <= hand->ends() && hand->ends() - hand->begins() <= kLongestHand, "a hand comes to its end");
  bool was = false;
  for (int k = 0; k < 2000; ++k) {
    const HandSample sample = hand->sample();
    const Rigid& tip = sample.tip;
    demand(std::abs(tip.w * tip.w + tip.x * tip.x + tip.y * tip.y + tip.z * tip.z - 1) < 0.01, "a tip is turned");
    demand(sample.ready || was, "a hand is there until it ends");
    was = true;
  }
}

void readPoses(std::string_view bytes) {
  const auto script = room::parsePoseScript(bytes);
  if (!script) return;
  const long end = script->end();
  demand(end >= 0 && end <= room::kLongestScript + 1, "recorded poses come to their end");
  for (const auto& event : script->events)
    if (event.what.starts_with("picture "))
      demand(isPlainName(std::string_view(event.what).substr(8)), "a picture lies in its folder");
  for (const auto& [picture, head] : script->head) {
    const auto again = room::parsePoseScript(room::headLine(picture, head));
    demand(again && again->headAt(picture) == head, "a head is read back");
  }
  for (std::size_t side = 0; side < 2; ++side)
    for (const auto& [picture, hand] : script->hands[side]) {
      const auto again = room::parsePoseScript(room::handLine(picture, side, hand));
      demand(bool(again), "a hand is read back");
    }
}

// A batch's folder can come from anyone. Keys and seals are no signatures: they are made anew here.
void readManifest(std::string_view bytes) {
  if (auto plan = app::parseManifest(bytes, "batch")) {
    for (app::BatchItem& item : plan->items) item.key = app::keyOf(*plan, item);
    for (const app::BatchDesign& design : plan->designs)
      demand(std::filesystem::path(design.file).parent_path() == "designs", "a design lies in its folder");
    const std::string written = app::manifestText(*plan);
    const auto again = app::parsePlan(written, "batch");
    demand(again && app::manifestText(*again) == written, "a plan is read back");
    for (const app::BatchItem& item : plan->items) {
      const auto one = app::parsePlan(app::planOf(*plan, item), "batch");
      demand(one && one->items.size() == 1 && one->items[0].key == item.key, "an item is read back");
    }
  }
  auto outcome = app::shallowJson(bytes);
  if (!outcome || !outcome->is_object()) return;
  app::BatchItem item;
  item.key = "0123456789abcdef";
  (*outcome)["key"] = item.key;
  (*outcome)["seal"] = app::sealOf(*outcome);
  const app::Json read = app::parseOutcome(outcome->dump(1, ' ', false, app::Json::error_handler_t::replace), item);
  if (!read.is_null()) (void)text(app::saidOf(read)), (void)text(app::saidOf(read), Language::Japanese);
}

void readFormula(std::string_view bytes) {
  const auto formula = Formula::parse(bytes);
  if (!formula) return;
  const auto again = Formula::parse(formula->text());
  demand(again && *again == *formula, "a formula is read back");
  struct : FormulaNames {
    Result<Quantity> named(const std::string& name) override { return Quantity{0.1 * double(name.size()), {1, 0}}; }
    Result<double> edgeLength(const EdgeRef&, bool) override { return 0.3; }
  } names;
  if (const auto value = evaluate(*formula, names)) demand(std::isfinite(value->value), "a value is a number");
}

// What karinui-import says, once a stranger's bytes have taken it over.
void readReply(std::string_view bytes) {
  static Workers one(1);
  if (const auto pixels = pictureReply(bytes, 1'000'000)) {
    demand(pixels->rgb.size() == std::size_t(3) * pixels->width * pixels->height, "a picture is whole");
    (void)fitted(*pixels, 16);
  }
  const auto reply = meshReply(bytes, {});
  if (!reply) return;
  if (const auto* names = std::get_if<std::vector<std::string>>(&*reply)) {
    for (const std::string& name : *names)
      demand(name == std::filesystem::path(name).filename() && name != "..", "a side file lies beside the body's");
    return;
  }
  const auto& mesh = std::get<TriangleMesh>(*reply);
  for (const bool wrap : {false, true}) {
    BodyReadOptions options;
    options.wrap = wrap;
    options.wrapCell = 0.05;
    const auto body = importedBody(mesh, "obj", options, one, Token());
    if (!body) continue;
    demand(body->report.closed() && body->report.outward, "a body is closed and faces outward");
    for (const Vec3& p : body->mesh.points) demand(finite(p), "a body's points are numbers");
    Body::Parts parts;
    parts.name = "stranger";
    parts.mesh = body->mesh;
    (void)Body::make(std::move(parts));
  }
}

// What the service of a force-feedback device says, read where it lies.
void readDeviceMessage(std::string_view bytes) {
  const JsonScan all(bytes);
  if (const auto list = all.member("inverse3"))
    list->each([&](const JsonScan& device) {
      if (const auto state = device.member("state"))
        for (const char* name : {"cursor_position", "cursor_velocity"})
          if (const auto vector = state->member(name)) (void)vector->number("x"), (void)vector->number("z");
      if (const auto status = device.member("status")) (void)status->flag("ready", true);
      return true;
    });
  std::size_t elements = 0;
  all.each([&](const JsonScan& element) {
    demand(!element.text().empty() && element.text().size() <= bytes.size(), "an element lies within");
    return ++elements < 100'000;
  });
  (void)all.isString("left");
  if (const auto number = all.number()) demand(std::isfinite(*number), "a number is finite");
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
       (void)readMeasuresJson(bytes);
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
    {"hand", "hand", readHand},
    {"poses", "poses", readPoses},
    {"manifest", "manifest", readManifest},
    {"formula", "formula", readFormula},
    {"reply", "reply", readReply},
    {"device_message", "device", readDeviceMessage},
};

}  // namespace

std::span<const FuzzedReader> fuzzedReaders() { return kReaders; }

}  // namespace karinui::test
