// refit: the garment made to another person's measure, by doing its operations again on another body.
#include <algorithm>

#include "figure.h"
#include "karinui/base/number.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/alteration.h"
#include "make_document.h"
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
std::string mm(double metres) { return fixed(metres * 1000, 0); }

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
      all.push_back({say("“{0}” is new: {1} × {2} mm.", piece->name, mm(now.across), mm(now.along)), json});
    } else if (old->outline == piece->outline) {
      json["kept"] = true;
      all.push_back({say("“{0}” keeps its drafted size, {1} × {2} mm: nothing in it depends on the figure.",
                         piece->name, mm(now.across), mm(now.along)),
                     json});
    } else {
      const PaperSize was = sizeOf(*old);
      json["kept"] = false;
      json["was_across_mm"] = was.across * 1000;
      json["was_along_mm"] = was.along * 1000;
      all.push_back({say("“{0}” is made anew: {1} × {2} mm, before {3} × {4} mm.", piece->name, mm(now.across),
                         mm(now.along), mm(was.across), mm(was.along)),
                     json});
    }
  }
  return all;
}

// A step as it is done on the other body. An outline that was pulled from the cloth is found anew; one that was drawn
// on the paper is drawn as far from the piece as it is there now.
Operation refitted(const Step& step, OpenDocument& source, const Document& now, Context& context) {
  Operation operation = step.operation;
  auto* reshape = std::get_if<ReshapePiece>(&operation);
  if (!reshape || reshape->outline.edges.empty()) return operation;
  if (!reshape->at.empty()) {
    reshape->outline = {};
    return operation;
  }
  const auto then = source.file().documentAfter(step.parent, context);
  const Piece* before = then ? then->find(reshape->piece.id) : nullptr;
  const Piece* there = now.find(reshape->piece.id);
  if (!before || !there) return operation;
  if (auto outline = alteredAlike(before->outline, reshape->outline, there->outline))
    reshape->outline = *std::move(outline);
  return operation;
}

int runRefit(Program& program, const RefitOptions& options) {
  return withDocument(program, options.path, true, [&](OpenDocument& source) -> int {
    const std::vector<Step> steps = source.file().steps();
    if (steps.empty()) return program.console.refuse(refused(say("The document is empty; there is nothing to fit.")));
    std::vector<Fate> fates;
    std::vector<Message> sizes;
    Json sizesJson;
    const auto fill = [&](OpenDocument& opened) -> Result<void> {
      const Result<SetBody> body = bodyOperation(opened, options.body);
      if (!body) return body.error();
      // Prints and figures that the document brought along.
      Context context{
          opened.context().workers, opened.context().token, source.file().blobs(), opened.context().bodies, {}, {}};
      const auto perform = [&](Operation operation, const Step* step) -> Result<void> {
        const Message told = step ? stepSaid(opened.document(), operation) : Message();
        const std::string name(nameOf(operation));
        const Result<Step> done = opened.performWith(std::move(operation), context);
        if (done) return {};
        if (!step || done.error().kind == Error::Kind::Cancelled) return done.error();
        return Error{done.error().kind, say("Step {0}, {1} ({2}), cannot be done on this body: {3}",
                                            static_cast<std::size_t>(step->serial), name, told, done.error().what)};
      };
      bool chosen = false;
      for (const Step& step : steps) {
        // Every choice of a figure becomes this one, so that the steps keep their numbers.
        const bool figure = std::holds_alternative<SetBody>(step.operation);
        chosen |= figure;
        if (const auto done =
                perform(figure ? Operation(*body) : refitted(step, source, opened.document(), context), &step);
            !done)
          return done.error();
      }
      if (!chosen)
        if (const auto done = perform(Operation(*body), nullptr); !done) return done.error();
      fates = fatesOf(source.document(), opened.document());
      BodyPtr before;
      if (source.document().body.chosen())
        if (const auto found = bodyOf(source.document(), source.context())) before = *found;
      const auto now = bodyOf(opened.document(), context);
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
  verb->add_option("-o,--output", options->out, help("The .karinui document to make"))->required();
  verb->add_flag("--overwrite", options->overwrite, help("Replace a document that is there already"));
}

}  // namespace karinui::app
