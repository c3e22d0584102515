#include "comparison.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "karinui/design/glossary.h"
#include "karinui/design/variant.h"
#include "karinui/session/fit.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBeside = 24;
constexpr int kMostInRow = 8;

Done add(Compared& all, OpenDocument& opened, const Document& document, const Message& name, const ViewCut& cut,
         Map map) {
  const Console& console = opened.program().console;
  if (!document.body.chosen())
    return refused(
        say("“{0}” has no figure, so it stands on no floor beside another; choose one: body size=eu38.", name));
  Result<SeenGarment> garment = seen(opened, document, cut, map);
  if (!garment) return Error{garment.error().kind, say("“{0}”: {1}", name, garment.error().what)};
  LineUp::Figure figure{console.said(name)};
  if (const auto unrest = unrestSaid(document)) {
    console.note(say("“{0}”: {1}; it is drawn as it stands.", name, *unrest));
    figure.below.push_back(console.said(*unrest));
  }
  all.figures.push_back(std::move(figure));
  all.frames.push_back(std::move(garment->frame));
  all.mapTop = std::max(all.mapTop, garment->mapTop);
  return {};
}

Done addVariant(Compared& all, OpenDocument& opened, const Operation& change, const Message& name, const ViewCut& cut,
                Map map) {
  const Result<Document> variant = variantOf(opened.document(), change, opened.context());
  if (!variant) return variant.error();
  return add(all, opened, *variant, name, cut, map);
}

Done tooMany(std::size_t many) {
  if (many <= kMostBeside) return {};
  return refused(say("{0} garments are too many for one picture; {1} at most.", many, kMostBeside));
}

Done addSizes(Compared& all, OpenDocument& opened, const ViewCut& cut, Map map) {
  const Grading& grading = opened.document().grading;
  if (grading.empty())
    return refused(say("The garment is made in one size; name its sizes first: grade sizes=\"S M L\" base=M."));
  if (Done few = tooMany(grading.sizes.size()); !few) return few;
  for (const std::string& size : grading.sizes)
    if (Done done = addVariant(all, opened, ChooseSize{size}, say("Size {0}", size), cut, map); !done) return done;
  return {};
}

Done addFabrics(Compared& all, OpenDocument& opened, std::string fabrics, const ViewCut& cut, Map map) {
  std::replace(fabrics.begin(), fabrics.end(), ',', ' ');
  std::istringstream words(fabrics);
  const std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
  if (Done few = tooMany(names.size()); !few) return few;
  for (const std::string& name : names)  // before the long work
    if (const auto known = fabricNamed(opened.document(), name); !known) return known.error();
  for (const std::string& name : names)
    if (Done done = addVariant(all, opened, cutFrom(opened.document(), name), nameSaid(name), cut, map); !done)
      return done;
  return {};
}

// Files are called by their names, and where two are alike with their folders.
std::vector<std::string> namesOf(const std::vector<fs::path>& paths) {
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    const auto alike = [&](const fs::path& other) { return other.stem() == path.stem(); };
    const bool alone = std::count_if(paths.begin(), paths.end(), alike) == 1;
    names.push_back(((alone ? fs::path() : fs::absolute(path).parent_path().filename()) / path.stem()).string());
  }
  return names;
}

Done addDocuments(Compared& all, OpenDocument& opened, const std::vector<std::string>& beside, const ViewCut& cut,
                  Map map) {
  if (Done few = tooMany(beside.size() + 1); !few) return few;
  std::vector<fs::path> paths{opened.file().path()};
  paths.insert(paths.end(), beside.begin(), beside.end());
  const std::vector<std::string> names = namesOf(paths);
  if (Done done = add(all, opened, opened.document(), say("{0}", names[0]), cut, map); !done) return done;
  for (std::size_t k = 1; k < paths.size(); ++k) {
    Result<DocumentFile> file = DocumentFile::openForReading(paths[k]);
    if (!file) return file.error();
    OpenDocument other(opened.program(), *std::move(file));
    other.tellRemarks();
    if (Done done = add(all, other, other.document(), say("{0}", names[k]), cut, map); !done) return done;
  }
  return {};
}

}  // namespace

int columnsOf(std::size_t figures) {
  const int count = static_cast<int>(figures), rows = (count + kMostInRow - 1) / kMostInRow;
  return (count + rows - 1) / std::max(1, rows);
}

Result<Compared> compared(OpenDocument& opened, const ComparisonWish& wish, const ViewCut& cut, Map map) {
  if (!wish.beside.empty() + wish.sizes + !wish.fabrics.empty() > 1)
    return badInput(say("Side by side are other documents, or sizes, or fabrics: say one of beside, sizes, fabrics."));
  Compared all;
  if (!wish.any()) {
    Result<SeenGarment> garment = seen(opened, opened.document(), cut, map);
    if (!garment) return garment.error();
    all.figures.emplace_back();
    all.frames.push_back(std::move(garment->frame));
    all.mapTop = garment->mapTop;
    return all;
  }
  const Done done = wish.sizes             ? addSizes(all, opened, cut, map)
                    : wish.fabrics.empty() ? addDocuments(all, opened, wish.beside, cut, map)
                                           : addFabrics(all, opened, wish.fabrics, cut, map);
  if (!done) return done.error();
  return all;
}

Result<SeenGarment> seen(OpenDocument& opened, const Document& document, const ViewCut& cut, Map map) {
  BodyPtr body;
  if (document.body.chosen()) {
    auto found = bodyOf(document, opened.context());
    if (!found) return found.error();
    body = *std::move(found);
  }
  const SnapshotPtr garment = snapshotOf(document, body, opened.prints());
  SeenGarment all{garment->frame};
  if (map == Map::Pressure) {
    Result<PressedFrame> pressed = pressedFrame(*garment, opened.context().workers);
    if (!pressed) return pressed.error();
    all = {std::move(pressed->frame), pressed->top};
  }
  if (extent(all.frame).empty()) return refused(say("There is nothing to see: no body, no cloth and no line."));
  if (cut.any()) VisibleParts(cut, body).cut(all.frame);
  return all;
}

}  // namespace karinui::app
