// export, picture: what leaves a document.
#include <filesystem>
#include <map>
#include <optional>

#include "karinui/base/file.h"
#include "karinui/exchange/formats.h"
#include "karinui/session/export.h"
#include "karinui/session/table_frame_of.h"
#include "karinui/session/view_cut.h"
#include "karinui/view/picture.h"
#include "karinui/view/table_picture.h"
#include "open_document.h"

namespace karinui::app {

namespace {

struct ExportOptions {
  std::string path, out, paper = "sheet", format;
  std::optional<double> allowanceMm;
  double overlapMm = 10;
  std::string date;
  bool nest = false;
};

struct PictureWish {
  std::string path, out, view = "front", map = "none", eyes = "mono", size = "1200x1600", hide, section;
  bool table = false, nest = false;  // the flat pattern instead; in all its sizes
};

Result<SpatialGarment> spatialOf(OpenDocument& opened) {
  const Result<SceneFrame> frame = opened.scene();
  if (!frame) return frame.error();
  return karinui::spatialOf(opened.document(), *frame);
}

// Of the formats of the ending the one that --format or --paper names, or else the first.
const FileFormat* chosenFormat(const ExportOptions& options) {
  const std::vector<const FileFormat*> formats = formatsWriting(options.out);
  const std::string paper = options.paper == "sheet" ? "pdf" : "pdf-" + options.paper;
  for (const FileFormat* format : formats)
    if (format->id == options.format || format->id == paper) return format;
  return formats.empty() ? nullptr : formats.front();
}

Result<std::string> bytesFor(OpenDocument& opened, const ExportOptions& options) {
  const FileFormat* format = chosenFormat(options);
  if (!format) return unwritable(options.out);
  SheetSettings sheet;
  tellGarment(opened.document(), sheet);
  sheet.overlap = options.overlapMm / 1000;
  sheet.date = options.date;
  sheet.nest = options.nest;
  if (options.allowanceMm) sheet.allowance = *options.allowanceMm / 1000;
  sheet.title = std::filesystem::path(options.path).stem().string();
  sheet.language = spokenHere();
  return format->write(
      {opened.document().pattern, [&] { return opened.file().log(); }, [&] { return spatialOf(opened); }, sheet});
}

// What --format may name: the texts of a pattern, which share an ending.
std::vector<std::string> patternFormats() {
  std::vector<std::string> names;
  for (const FileFormat* format : exportFormats())
    if (format->out == FileContent::Pattern) names.emplace_back(format->id);
  return names;
}

int runExport(Program& program, const ExportOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Result<std::string> bytes = bytesFor(opened, options);
    if (!bytes) return program.console.refuse(bytes.error());
    if (const Done done = writeFile(options.out, *bytes); !done) return program.console.refuse(done.error());
    program.console.answer({{"file", options.out}, {"bytes", bytes->size()}}, options.out);
    return kDone;
  });
}

Result<PictureOptions> picked(const PictureWish& wish) {
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

Result<ViewCut> cutOf(const PictureWish& wish) {
  Result<ViewCut> cut = hiddenNamed(wish.hide);
  if (!cut || wish.section.empty()) return cut;
  const auto section = sectionNamed(wish.section);
  if (!section) return section.error();
  cut->section = *section;
  return cut;
}

Result<Image> fittingPicture(Program& program, OpenDocument& opened, const PictureOptions& options,
                             const ViewCut& cut) {
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
  for (const Message& note : (*picture)->notes()) program.console.note(note);
  return image;
}

Result<Image> tablePicture(Program& program, OpenDocument& opened, const PictureOptions& options, bool nest) {
  const SnapshotPtr garment = snapshotOf(opened.document(), nullptr);
  TableLayout layout;
  layout.arrange(*garment);
  TableFrameOptions shown;
  shown.language = options.language;
  shown.nest = nest;
  std::vector<Message> notes;
  Result<Image> image =
      drawTable(tableFrameOf(*garment, layout, {}, shown), {options.width, options.height, options.language}, &notes);
  for (const Message& note : notes) program.console.note(note);
  return image;
}

int runPicture(Program& program, const PictureWish& wish) {
  const Result<PictureOptions> options = picked(wish);
  const Result<ViewCut> cut = cutOf(wish);
  if (!options || !cut) {
    program.console.refuse(options ? cut.error() : options.error());
    return kWrongCall;
  }
  return withDocument(program, wish.path, true, [&](OpenDocument& opened) -> int {
    const Result<Image> image = wish.table ? tablePicture(program, opened, *options, wish.nest)
                                           : fittingPicture(program, opened, *options, *cut);
    if (!image) return program.console.refuse(image.error());
    if (const Done done = writePng(wish.out, *image); !done) return program.console.refuse(done.error());
    program.console.answer({{"file", wish.out}, {"width", image->width}, {"height", image->height}}, wish.out);
    return kDone;
  });
}

}  // namespace

void addOutputVerbs(Program& program) {
  auto out = std::make_shared<ExportOptions>();
  CLI::App* verb =
      program.verb(program.cli, "export",
                   help(say("Writes the pattern, the garment in 3D or the operations ({0})", listed(endingsWritten()))),
                   out, runExport);
  verb->add_option("document", out->path, help("The .karinui document"))->required();
  verb->add_option("-o,--output", out->out, help("The file; its ending says what it will be"))->required();
  verb->add_option("--paper,--page", out->paper,
                   help("PDF: one true-size sheet (sheet), or pages to glue: a4, letter, a3, a0, 36in"))
      ->check(CLI::IsMember({"sheet", "a4", "letter", "a3", "a0", "36in"}));
  verb->add_option("--overlap", out->overlapMm, help("paper: how far glued pages overlap in mm, 5 to 30"))
      ->check(CLI::Range(5.0, 30.0));
  verb->add_option("--date", out->date, help("paper: a date to be printed on each piece, as it is to be read"));
  verb->add_flag("--nest", out->nest, help("paper: graded pieces in all their sizes, over one another"));
  verb->add_option("--allowance", out->allowanceMm,
                   help("paper: seam allowance in mm in place of the document's own, up to 100, 0 for none"))
      ->check(CLI::Range(0.0, 100.0));
  verb->add_option("--format", out->format, help("JSON: karinui (exact) or garmentcode"))
      ->check(CLI::IsMember(patternFormats()));

  auto wish = std::make_shared<PictureWish>();
  verb = program.verb(program.cli, "picture", help("Draws the garment on its body, or its flat pattern"), wish,
                      runPicture);
  verb->add_option("document", wish->path, help("The .karinui document"))->required();
  verb->add_option("-o,--output", wish->out, help("The PNG file"))->required();
  CLI::Option* view = verb->add_option("--view", wish->view, help("front, back, left, right, oblique"));
  CLI::Option* map = verb->add_option("--map", wish->map, help("none, strain"));
  CLI::Option* eyes = verb->add_option("--eyes", wish->eyes, help("mono, side-by-side, top-bottom, anaglyph"));
  CLI::Option* hide = verb->add_option("--hide", wish->hide, help("Parts of the figure not to draw: arms,hands,head"));
  CLI::Option* section = verb->add_option("--section", wish->section,
                                          help("Cut open by a plane: side, front or level, and where: front@5cm"));
  verb->add_flag("--table", wish->table, help("The flat pattern on the cutting table instead"))
      ->excludes(view)
      ->excludes(hide)
      ->excludes(section)
      ->excludes(map)
      ->excludes(eyes);
  verb->add_flag("--nest", wish->nest, help("with --table: graded pieces in all their sizes, over one another"));
  verb->add_option("--size", wish->size, help("WIDTHxHEIGHT in pixels"));
}

}  // namespace karinui::app
