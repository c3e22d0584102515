// export, picture: what leaves a document.
#include "karinui/base/file.h"
#include "karinui/exchange/formats.h"
#include "outputs.h"
#include "pictures.h"

namespace karinui::app {

namespace {

struct ExportOptions : ExportRequest {
  std::string path;
};
struct PictureOptionsAsked : PictureRequest {
  std::string path, out;
};

int runExport(Program& program, const ExportOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Result<std::size_t> bytes = exportFile(opened, options);
    if (!bytes) return program.console.refuse(bytes.error());
    program.console.answer({{"file", options.out}, {"bytes", *bytes}}, options.out);
    return kDone;
  });
}

int runPicture(Program& program, const PictureOptionsAsked& options) {
  if (const Done understood = checkPicture(options); !understood) {
    program.console.refuse(understood.error());
    return kWrongCall;
  }
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    Json answer = {{"file", options.out}};
    const auto told = [&](int width, int height) -> int {
      answer["width"] = width, answer["height"] = height;
      program.console.answer(answer, options.out);
      return kDone;
    };
    if (options.frames > 0) {
      const auto size = writeFrames(opened, options, options.out);
      if (!size) return program.console.refuse(size.error());
      answer["frames"] = options.frames;
      return told((*size)[0], (*size)[1]);
    }
    const Result<Image> image = pictureOf(opened, options);
    if (!image) return program.console.refuse(image.error());
    if (const Done done = writePng(options.out, *image); !done) return program.console.refuse(done.error());
    return told(image->width, image->height);
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
  program.output(*verb, "-o,--output", out->out, help("The file; its ending says what it will be"), endingsWritten())
      ->required();
  verb->add_option("--paper,--page", out->paper,
                   help("PDF: one true-size sheet (sheet), or pages to glue: a4, letter, a3, a0, 36in"))
      ->transform(oneOf({kPapers.begin(), kPapers.end()}));
  verb->add_option("--overlap", out->overlapMm, help("paper: how far glued pages overlap in mm, 5 to 30"))
      ->check(CLI::Range(5.0, 30.0));
  verb->add_option("--date", out->date, help("paper: a date to be printed on each piece, as it is to be read"));
  verb->add_flag("--nest", out->nest, help("paper: graded pieces in all their sizes, over one another"));
  verb->add_flag("--pairs-once", out->pairsOnce,
                 help("PDF and plotter: left and right pieces that are alike drawn once, to be cut in pairs"));
  verb->add_option("--allowance", out->allowanceMm,
                   help("paper: seam allowance in mm in place of the document's own, up to 100, 0 for none"))
      ->check(CLI::Range(0.0, 100.0));
  verb->add_option("--poses", out->poses, help("GLB: an animation of the garment through these poses, as T,step,A"));
  verb->add_option(
          "--format", out->format,
          help("Of JSON: karinui (exact) or garmentcode; of DXF: dxf-aama or dxf-astm. Otherwise the first named"))
      ->transform(oneOf(patternFormats()));

  auto wish = std::make_shared<PictureOptionsAsked>();
  verb = program.verb(program.cli, "picture", help("Draws the garment on its body, or its flat pattern"), wish,
                      runPicture);
  verb->add_option("document", wish->path, help("The .karinui document"))->required();
  CLI::Option* view = verb->add_option("--view", wish->view, help("front, back, left, right, oblique"));
  CLI::Option* map = verb->add_option("--map", wish->map, help("none, strain, pressure"));
  CLI::Option* eyes = verb->add_option("--eyes", wish->eyes, help("mono, side-by-side, top-bottom, anaglyph"));
  CLI::Option* hide = verb->add_option("--hide", wish->hide, help("Parts of the figure not to draw: arms,hands,head"));
  CLI::Option* section = verb->add_option("--section", wish->section,
                                          help("Cut open by a plane: side, front or level, and where: front@5cm"));
  ComparisonWish& compare = wish->compare;
  CLI::Option* beside = verb->add_option(
      "--beside", compare.beside, help("Other .karinui documents, drawn beside it at one scale and on one floor"));
  CLI::Option* sizes = verb->add_flag("--sizes", compare.sizes, help("All its sizes side by side, each draped"));
  CLI::Option* fabrics =
      verb->add_option("--fabrics", compare.fabrics, help("Side by side in fabrics, draped in each: \"cotton silk\""));
  CLI::Option* turns =
      verb->add_option("--turns", wish->turns, help("A sheet of so many sides of a whole turn, 2 to 36"))
          ->check(CLI::Range(2, 36));
  CLI::Option* frames =
      verb->add_option("--frames", wish->frames,
                       help("So many numbered pictures of a whole turn, 2 to 3600, for a film; the output is a folder"))
          ->check(CLI::Range(2, 3600));
  turns->excludes(frames);
  program.output(*verb, "-o,--output", wish->out, help("The PNG file; with --frames a folder"), {"png"}, frames)
      ->required();
  CLI::Option* table = verb->add_flag("--table", wish->table, help("The flat pattern on the cutting table instead"));
  for (CLI::Option* other : {view, hide, section, map, eyes, beside, sizes, fabrics, turns, frames})
    table->excludes(other);
  verb->add_flag("--nest", wish->nest, help("with --table: graded pieces in all their sizes, over one another"))
      ->needs(table);
  verb->add_flag("--scans", wish->scans, help("with --table: over the scans that are traced"))->needs(table);
  verb->add_option("--size", wish->size, help("WIDTHxHEIGHT in pixels, of each figure where there are several"));
}

}  // namespace karinui::app
