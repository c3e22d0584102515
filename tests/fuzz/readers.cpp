#include "readers.h"

#include <cstdio>
#include <cstdlib>

#include "karinui/design/make_up.h"
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
};

}  // namespace

std::span<const FuzzedReader> fuzzedReaders() { return kReaders; }

}  // namespace karinui::test
