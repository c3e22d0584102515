#include "outputs.h"

#include <filesystem>

#include "karinui/session/export.h"
#include "karinui/session/table_frame_of.h"
#include "karinui/session/view_cut.h"
#include "karinui/view/picture.h"
#include "karinui/view/table_picture.h"

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

Result<PictureOptions> picked(const PictureRequest& wish) {
  const auto view = viewNamed(wish.view);
  if (!view) return view.error();
  const auto map = mapNamed(wish.map);
  if (!map) return map.error();
  const auto eyes = eyesNamed(wish.eyes);
  if (!eyes) return eyes.error();
  const auto size = sizeNamed(wish.size);
  if (!size) return size.error();
  PictureOptions options;
  options.view = *view;
  options.map = *map;
  options.eyes = *eyes;
  options.width = (*size)[0];
  options.height = (*size)[1];
  options.language = spokenHere();
  return options;
}

Result<ViewCut> cutOf(const PictureRequest& wish) {
  Result<ViewCut> cut = hiddenNamed(wish.hide);
  if (!cut || wish.section.empty()) return cut;
  const auto section = sectionNamed(wish.section);
  if (!section) return section.error();
  cut->section = *section;
  return cut;
}

Result<Image> fittingPicture(OpenDocument& opened, const PictureOptions& options, const ViewCut& cut) {
  Result<SceneFrame> frame = opened.scene();
  if (!frame) return frame.error();
  if (cut.any()) {
    BodyPtr body;
    if (opened.document().body.chosen()) {
      auto found = bodyOf(opened.document(), opened.context());
      if (!found) return found.error();
      body = *std::move(found);
    }
    VisibleParts(cut, body).cut(*frame);
  }
  const auto picture = Picture::open();
  if (!picture) return picture.error();
  Result<Image> image = (*picture)->draw(*frame, options);
  for (const Message& note : (*picture)->notes()) opened.program().console.note(note);
  return image;
}

Result<Image> tablePicture(OpenDocument& opened, const PictureOptions& options, const PictureRequest& request) {
  const SnapshotPtr garment = snapshotOf(opened.document(), nullptr, opened.prints());
  TableLayout layout;
  layout.arrange(*garment);
  TableFrameOptions shown;
  shown.language = options.language;
  shown.nest = request.nest;
  shown.scans = request.scans;
  std::vector<Message> notes;
  Result<Image> image =
      drawTable(tableFrameOf(*garment, layout, {}, shown), {options.width, options.height, options.language}, &notes);
  for (const Message& note : notes) opened.program().console.note(note);
  return image;
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
  tellGarment(opened.document(), sheet);
  sheet.overlap = request.overlapMm / 1000;
  sheet.date = request.date;
  sheet.nest = request.nest;
  if (request.allowanceMm) sheet.allowance = *request.allowanceMm / 1000;
  sheet.title = opened.file().path().stem().string();
  sheet.language = spokenHere();
  return format->write(
      {opened.document().pattern, [&] { return opened.file().log(); }, [&] { return spatialOf(opened); }, sheet});
}

Done checkPicture(const PictureRequest& request) {
  if (const auto options = picked(request); !options) return options.error();
  const auto cut = cutOf(request);
  return cut ? Done() : Done(cut.error());
}

Result<Image> pictureOf(OpenDocument& opened, const PictureRequest& request) {
  const Result<PictureOptions> options = picked(request);
  if (!options) return options.error();
  if (request.table) return tablePicture(opened, *options, request);
  const Result<ViewCut> cut = cutOf(request);
  if (!cut) return cut.error();
  return fittingPicture(opened, *options, *cut);
}

}  // namespace karinui::app
