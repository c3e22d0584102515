#include "outputs.h"

#include <filesystem>
#include <sstream>
#include <tuple>

#include "karinui/session/animation.h"
#include "karinui/session/export.h"
#include "written_files.h"

namespace karinui::app {

namespace {

Result<SpatialGarment> spatialOf(OpenDocument& opened, const std::string& poses) {
  if (!poses.empty()) {
    std::vector<std::string> names;
    std::istringstream list(poses);
    for (std::string name; std::getline(list, name, ',');) {
      std::erase(name, ' ');
      if (!name.empty()) names.push_back(name);
    }
    return animationOf(opened.document(), names, opened.context(), opened.prints());
  }
  const Result<SceneFrame> frame = opened.scene();
  if (!frame) return frame.error();
  return karinui::spatialOf(opened.document(), *frame);
}

// Of the formats of the ending the one that --format or --paper names, or else the first.
const FileFormat* chosenFormat(const ExportRequest& request) {
  const std::vector<const FileFormat*> formats = formatsWriting(request.out);
  const std::string paper = paperFormat(request.paper);
  for (const FileFormat* format : formats)
    if (format->id == request.format || format->id == paper) return format;
  return formats.empty() ? nullptr : formats.front();
}

// What was asked for belongs to the file's ending.
Done fits(const ExportRequest& request, const FileFormat& format) {
  const std::string file = std::filesystem::path(request.out).filename().string();
  if (!request.format.empty() && format.id != request.format)
    return badInput(say("“{0}” is no format of {1}.", request.format, file));
  if (!request.paper.empty() && format.id.starts_with("pdf") && format.id != paperFormat(request.paper))
    return badInput(say("There is no paper “{0}”; there are: {1}.", request.paper, "sheet, a4, letter, a3, a0, 36in"));
  const bool sheet = format.out == FileContent::Sheet, pages = format.id.starts_with("pdf");
  const bool cut = sheet || format.id == "karinui" || format.id.starts_with("dxf");
  for (const auto& [name, asked, holds] : {std::tuple("--paper", !request.paper.empty(), pages),
                                           {"--overlap", request.overlapMm.has_value(), pages},
                                           {"--date", !request.date.empty(), sheet},
                                           {"--nest", request.nest, sheet},
                                           {"--pairs-once", request.pairsOnce, isPaper(format)},
                                           {"--poses", !request.poses.empty(), format.id == "glb"},
                                           {"--allowance", request.allowanceMm.has_value(), cut}})
    if (asked && !holds) return unasked(name, request.out);
  return {};
}

}  // namespace

std::string paperFormat(const std::string& paper) { return paper.empty() || paper == "sheet" ? "pdf" : "pdf-" + paper; }

std::vector<std::string> patternFormats() {
  std::vector<std::string> names;
  for (const FileFormat* format : exportFormats())
    if (format->out == FileContent::Pattern) names.emplace_back(format->id);
  return names;
}

Result<std::size_t> exportFile(OpenDocument& opened, const ExportRequest& request) {
  const FileFormat* format = chosenFormat(request);
  if (!format) return unwritable(request.out);
  if (const Done fit = fits(request, *format); !fit) return fit.error();
  SheetSettings sheet;
  tellGarment(opened.document(), photosIn(opened.context().blobs), sheet);
  if (request.overlapMm) sheet.overlap = *request.overlapMm / 1000;
  sheet.date = request.date;
  sheet.nest = request.nest, sheet.pairsOnce = request.pairsOnce;
  if (request.allowanceMm) sheet.allowance = *request.allowanceMm / 1000;
  sheet.title = opened.file().path().stem().string();
  sheet.language = spokenHere();
  std::vector<SideFile> beside;
  const Result<std::string> bytes = format->write({opened.document().pattern, [&] { return opened.file().log(); },
                                                   [&] { return spatialOf(opened, request.poses); }, sheet,
                                                   std::filesystem::path(request.out).stem().string(), &beside});
  if (!bytes) return bytes.error();
  if (const Done done = writeExport(request.out, *bytes, beside); !done) return done.error();
  return bytes->size();
}

}  // namespace karinui::app
