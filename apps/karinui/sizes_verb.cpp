// sizes: the sizes of a graded garment, and sizes measured on other garments of the same pieces.
#include "karinui/base/number.h"
#include "open_document.h"
#include "word_table.h"

namespace karinui::app {

namespace {

struct SizesOptions {
  std::string path;
  std::vector<std::string> measured;  // "L=larger.karinui"
};

// What the pieces are in one size, measured on the same pieces of another document, corner by corner.
Done measure(OpenDocument& opened, const std::string& size, const Document& other) {
  const Grading grading = opened.document().grading;
  const auto which = grading.find(size);
  if (!which)
    return refused(say("There is no size “{0}” yet; name the sizes first: grade sizes=\"S M L\" base=M.", size));
  std::size_t found = 0;
  const auto pieces = opened.document().pattern.pieces;
  for (const auto& [id, piece] : pieces) {
    const Piece* there = other.pieceNamed(piece->name);
    if (!there) {
      opened.program().console.note(
          say("The other document has no piece “{0}”; it stays as it is graded.", piece->name));
      continue;
    }
    const auto own = opened.document().grading.pieces.find(id);
    std::vector<Outline> sizes;
    for (std::size_t i = 0; i < grading.sizes.size(); ++i) {
      auto outline = own == opened.document().grading.pieces.end()
                         ? Result<Outline>(piece->outline)
                         : graded(piece->outline, grading, own->second, grading.standing, i);
      if (!outline) return outline.error();
      sizes.push_back(*std::move(outline));
    }
    sizes[*which] = there->outline;
    auto measured = measuredGrading(sizes, grading.base);
    if (!measured) return refused(say("Piece {0}: {1}", piece->name, measured.error().what));
    GradePieces grade;
    grade.piece = id, grade.points = *std::move(measured);
    if (const auto step = opened.perform(std::move(grade)); !step) return step.error();
    ++found;
  }
  return found > 0 ? Done() : refused(say("The other document has none of the pieces."));
}

int list(Program& program, const Document& document) {
  const Grading& grading = document.grading;
  Json sizes = Json::array();
  WordTable table;
  const auto said = [&](const Message& words) { return program.console.said(words); };
  for (std::size_t i = 0; i < grading.sizes.size(); ++i) {
    Json pieces = Json::array();
    std::string name = grading.sizes[i];
    if (i == grading.base) name += " " + said(say("(base)"));
    if (i == grading.standing) name += " " + said(say("(stands)"));
    table.row({name});
    for (const auto& [id, piece] : document.pattern.pieces) {
      const auto made = inSize(*piece, grading, i);
      if (!made) return program.console.refuse(made.error());
      Json edges = Json::object();
      std::string lengths;
      for (const Edge& edge : made->outline.edges) {
        const double mm = edge.curve.length() * 1000;
        edges[edge.name] = mm;
        lengths += (lengths.empty() ? "" : ", ") + edge.name + " " + fixed(mm, 1);
      }
      pieces.push_back({{"name", piece->name},
                        {"graded", grading.pieces.contains(id)},
                        {"area_cm2", made->outline.area() * 1e4},
                        {"edges_mm", edges}});
      table.row({"", piece->name, fixed(made->outline.area() * 1e4, 0) + " cm²", lengths});
    }
    sizes.push_back({{"size", grading.sizes[i]}, {"pieces", pieces}});
  }
  Json answer = {{"sizes", sizes}};
  if (!grading.empty())
    answer["base"] = grading.sizes[grading.base], answer["stands"] = grading.sizes[grading.standing];
  program.console.answer(
      answer, grading.empty() ? said(say("There are no sizes; the garment is made in one.")) + "\n" : table.words(0));
  return kDone;
}

int runSizes(Program& program, const SizesOptions& options) {
  return withDocument(program, options.path, options.measured.empty(), [&](OpenDocument& opened) -> int {
    for (const std::string& one : options.measured) {
      const auto equals = one.find('=');
      if (equals == std::string::npos || equals == 0)
        return program.console.refuse(
            badInput(say("Write the size and the document it is measured on: L=larger.karinui")));
      auto file = DocumentFile::openForReading(one.substr(equals + 1));
      if (!file) return program.console.refuse(file.error());
      if (const Done done = measure(opened, one.substr(0, equals), file->document()); !done)
        return program.console.refuse(done.error());
    }
    return list(program, opened.document());
  });
}

}  // namespace

void addSizesVerb(Program& program) {
  auto options = std::make_shared<SizesOptions>();
  CLI::App* verb = program.verb(program.cli, "sizes",
                                help("Lists the sizes of a garment: the area of each piece, the lengths of its edges"),
                                options, runSizes);
  verb->add_option("document", options->path, help("The .karinui document"))->required();
  verb->add_option(
      "--measure", options->measured,
      help("SIZE=DOCUMENT: first takes what the pieces are in that size from another document with the same "
           "pieces, as refit makes it"));
}

}  // namespace karinui::app
