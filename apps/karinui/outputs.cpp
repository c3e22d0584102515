#include "outputs.h"

#include <filesystem>

#include "karinui/session/export.h"

namespace karinui::app {

namespace {

Result<SpatialGarment> spatialOf(OpenDocument& opened) {
  const Result<SceneFrame> frame = opened.scene();
  if (!frame) return frame.error();
  return karinui::spatialOf(opened.document(), *frame);
}

// Of the formats of the ending the one that --format or --paper names, or else the first.
const FileFormat* chosenFormat(const ExportRequest& request) {
  const std::vector<const FileFormat*> formats = formatsWriting(request.out);
  const std::string paper = request.paper == "sheet" ? "pdf" : "pdf-" + request.paper;
  for (const FileFormat* format : formats)
    if (format->id == request.format || format->id == paper) return format;
  return formats.empty() ? nullptr : formats.front();
}

}  // namespace

std::vector<std::string> patternFormats() {
  std::vector<std::string> names;
  for (const FileFormat* format : exportFormats())
    if (format->out == FileContent::Pattern) names.emplace_back(format->id);
  return names;
}

Result<std::string> exportBytes(OpenDocument& opened, const ExportRequest& request) {
  const FileFormat* format = chosenFormat(request);
  if (!format) return unwritable(request.out);
  SheetSettings sheet;
  tellGarment(opened.document(), photosIn(opened.context().blobs), sheet);
  sheet.overlap = request.overlapMm / 1000;
  sheet.date = request.date;
  sheet.nest = request.nest;
  if (request.allowanceMm) sheet.allowance = *request.allowanceMm / 1000;
  sheet.title = opened.file().path().stem().string();
  sheet.language = spokenHere();
  return format->write(
      {opened.document().pattern, [&] { return opened.file().log(); }, [&] { return spatialOf(opened); }, sheet});
}

}  // namespace karinui::app
