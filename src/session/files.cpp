// Files in and out of a session.
#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/pattern_json.h"
#include "karinui/exchange/read_body.h"
#include "karinui/exchange/read_pattern.h"
#include "karinui/exchange/sheet.h"
#include "karinui/exchange/spatial.h"
#include "session/room.h"

namespace karinui {

namespace {

SpatialGarment spatialOf(const Fitting& fitting) {
  SpatialGarment garment;
  if (fitting.body) garment.body = fitting.body->mesh();
  for (const SceneCloth& cloth : fitting.frame.cloths)
    garment.pieces.push_back(
        {cloth.name, fitting.document.pieceNamed(cloth.name)->fabric, cloth.mesh, cloth.flat, cloth.colour});
  return garment;
}

Result<std::string> bytesFor(const Fitting& fitting, const std::string& log, const ExportWish& wish) {
  const std::string ending = wish.file.extension().string();
  const Pattern& pattern = fitting.document.pattern;
  SheetSettings sheet;
  sheet.allowance = wish.allowance;
  sheet.title = wish.file.stem().string();
  sheet.language = wish.language;
  if (ending == ".svg") return writeSvg(pattern, sheet);
  if (ending == ".pdf") return writePdf(pattern, wish.a4 ? PaperKind::A4 : PaperKind::OneSheet, sheet);
  if (ending == ".json") return writePatternJson(pattern);
  if (ending == ".ops") return log;
  if (ending == ".obj") return writeObj(spatialOf(fitting));
  if (ending == ".glb") return writeGlb(spatialOf(fitting));
  return badInput(say("“{0}” is not an ending Karinui writes; choose .svg, .pdf, .obj, .glb, .json or .ops.", ending));
}

}  // namespace

Done importPatternInto(Room& room, const std::filesystem::path& file, const Token& token) {
  if (file.extension() == ".ops") {
    const Result<std::string> bytes = readFile(file);
    if (!bytes) return bytes.error();
    const auto lines = parseScript(*bytes);
    if (!lines) return lines.error();
    for (std::size_t i = 0; i < lines->size(); ++i) {
      token.progress(static_cast<double>(i) / static_cast<double>(lines->size()), say("Playing the script"));
      if (const auto step = room.perform((*lines)[i].operation, token); !step)
        return Error{step.error().kind, say("Line {0}: {1}", (*lines)[i].number, step.error().what)};
    }
    return {};
  }
  const Result<Pattern> pattern = readPattern(file);
  if (!pattern) return pattern.error();
  for (Operation& operation : stepsOf(*pattern, room.file().document()))
    if (const auto step = room.perform(std::move(operation), token); !step) return step.error();
  return {};
}

Done importBodyInto(Room& room, const std::filesystem::path& file, const Token& token, std::vector<Message>& notes) {
  Result<ImportedBody> read = readBody(file, {}, room.workers(), token);
  if (!read) return read.error();
  notes = read->notes;
  Body::Parts parts;
  parts.name = file.stem().string();
  parts.mesh = std::move(read->mesh);
  const Result<std::string> blob = room.file().blobs().put(packBody(parts));
  if (!blob) return blob.error();
  SetBody choice;
  choice.mesh = *blob;
  const auto step = room.perform(std::move(choice), token);
  return step ? Done() : Done(step.error());
}

Done exportFrom(const Fitting& fitting, const std::string& log, const ExportWish& wish) {
  const Result<std::string> bytes = bytesFor(fitting, log, wish);
  if (!bytes) return bytes.error();
  return writeFile(wish.file, *bytes);
}

}  // namespace karinui
