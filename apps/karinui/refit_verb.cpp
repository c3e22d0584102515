// refit: the garment made to another person's measure, by doing its operations again on another body.
#include <algorithm>

#include "figure.h"
#include "karinui/base/number.h"
#include "make_document.h"
#include "refit.h"
#include "sizes_said.h"

namespace karinui::app {

namespace {

struct RefitOptions {
  std::string path, body, out;
  bool overwrite = false;
};

// How large a piece is on paper: across its grain and along it.
struct PaperSize {
  double across = 0, along = 0;
};
PaperSize sizeOf(const Piece& piece) {
  double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
  for (const Flat p : piece.outline.flattened(1e-4)) {
    const double along = dot(p, piece.grain), across = cross(p, piece.grain);
    low = std::min(low, along), high = std::max(high, along);
    left = std::min(left, across), right = std::max(right, across);
  }
  return {right - left, high - low};
}
std::string millimetres(double metres) { return fixed(metres * 1000, 0); }

struct Fate {
  Message said;
  Json json;
};

// What became of each piece: whether the other figure made it anew or it stayed as it was drafted.
std::vector<Fate> fatesOf(const Document& before, const Document& after) {
  std::vector<Fate> all;
  for (const auto& [id, piece] : after.pattern.pieces) {
    const Piece* old = before.find(id);
    const PaperSize now = sizeOf(*piece);
    Json json = {{"piece", piece->name}, {"across_mm", now.across * 1000}, {"along_mm", now.along * 1000}};
    if (!old) {
      json["kept"] = false;
      all.push_back(
          {say("“{0}” is new: {1} × {2} mm.", piece->name, millimetres(now.across), millimetres(now.along)), json});
    } else if (old->outline == piece->outline) {
      json["kept"] = true;
      all.push_back({say("“{0}” keeps its drafted size, {1} × {2} mm: nothing in it depends on the figure.",
                         piece->name, millimetres(now.across), millimetres(now.along)),
                     json});
    } else {
      const PaperSize was = sizeOf(*old);
      json["kept"] = false;
      json["was_across_mm"] = was.across * 1000;
      json["was_along_mm"] = was.along * 1000;
      all.push_back({say("“{0}” is made anew: {1} × {2} mm, before {3} × {4} mm.", piece->name, millimetres(now.across),
                         millimetres(now.along), millimetres(was.across), millimetres(was.along)),
                     json});
    }
  }
  return all;
}

int runRefit(Program& program, const RefitOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& source) -> int {
    std::vector<Fate> fates;
    std::vector<Message> sizes;
    Json sizesJson;
    const auto fill = [&](OpenDocument& opened) -> Result<void> {
      const Result<SetBody> body = bodyOperation(opened, options.body);
      if (!body) return body.error();
      if (const Done done = refit(source, opened, *body); !done) return done;
      fates = fatesOf(source.document(), opened.document());
      BodyPtr before;
      if (source.document().body.chosen())
        if (const auto found = bodyOf(source.document(), source.context())) before = *found;
      const auto now = bodyOf(opened.document(), opened.context());
      if (!now) return now.error();
      if (const auto fit = sizeFit(source.document(), before ? &before->measured() : nullptr, (*now)->measured()))
        sizes = sizesSaid(*fit, source.document().grading, sizesJson);
      return {};
    };
    return makeDocument(program, options.out, options.overwrite, fill, [&](Json& answer, std::string& words) {
      Json pieces = Json::array();
      for (const Fate& fate : fates) {
        pieces.push_back(fate.json);
        words += "\n  " + program.console.said(fate.said);
      }
      answer["fitted"] = pieces;
      if (!sizes.empty()) answer["sizes"] = sizesJson;
      for (const Message& said : sizes) words += "\n  " + program.console.said(said);
    });
  });
}

}  // namespace

void addRefitVerb(Program& program) {
  auto options = std::make_shared<RefitOptions>();
  CLI::App* verb =
      program.verb(program.cli, "refit", help("Makes the garment to another body: does its operations again there"),
                   options, runRefit);
  verb->add_option("document", options->path, help("The .karinui document"))->required();
  verb->add_option("--body", options->body, help("Measures, a body file or a built-in size to make it to"))->required();
  program.output(*verb, "-o,--output", options->out, help("The .karinui document to make"), {"karinui"})->required();
  verb->add_flag("--overwrite", options->overwrite, help("Replace a document that is there already"));
}

}  // namespace karinui::app
