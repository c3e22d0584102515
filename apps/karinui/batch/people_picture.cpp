#include "people_picture.h"

#include <algorithm>
#include <map>

#include "../comparison.h"
#include "../examination.h"
#include "item.h"
#include "karinui/design/glossary.h"
#include "misfit.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPeople = 60;

// The first of the names that none of them has.
std::optional<std::string> stranger(const std::vector<std::string>& names, const auto& all) {
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; })) return name;
  return std::nullopt;
}

// Rows of the table that are asked for, as they are to stand.
std::vector<std::size_t> chosen(const PeopleWish& wish, const BatchTable& table, const std::vector<Misfit>& misfits) {
  std::vector<std::size_t> rows;
  if (wish.misfits)
    for (const Misfit& misfit : misfits) rows.push_back(misfit.row);
  else
    for (std::size_t r = 0; r < table.rows.size(); ++r) rows.push_back(r);
  const auto among = [](const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  std::erase_if(rows, [&](std::size_t r) {
    return !among(wish.people, table.text(r, "person")) || !among(wish.designs, table.text(r, "design"));
  });
  return rows;
}

// As the map shows it; a garment that does not press is drawn as cloth.
Result<SeenGarment> shownOn(OpenDocument& opened, Map map) {
  auto garment = seen(opened, opened.document(), {}, map);
  if (garment || map != Map::Pressure) return garment;
  garment = seen(opened, opened.document(), {}, Map::None);
  if (garment)
    for (SceneCloth& cloth : garment->frame.cloths) cloth.strain.clear();
  return garment;
}

// The garment of an item as its outcome was found: opened where it was kept, else made and kept.
Result<SeenGarment> dressed(Program& program, const fs::path& folder, const BatchPlan& plan, const BatchItem& item,
                            Map map) {
  const fs::path kept = folder / "garments" / (item.key + ".karinui");
  std::error_code trouble;
  if (fs::exists(kept, trouble)) {
    Result<DocumentFile> file = DocumentFile::openForReading(kept);
    if (!file) return file.error();
    OpenDocument opened(program, *std::move(file));
    return shownOn(opened, map);
  }
  if (const Done done = makePrivateFolder(kept.parent_path()); !done) return done.error();
  const fs::path part = kept.string() + ".part";
  fs::remove(part, trouble);
  Result<SeenGarment> garment = SeenGarment();
  Done made;
  {
    Result<DocumentFile> file = DocumentFile::create(part);
    if (!file) return file.error();
    OpenDocument opened(program, *std::move(file));
    StopRequest nobody;
    made = makeGarment(opened, folder, plan, item);
    if (made)
      if (const auto settled = settle(opened, nobody, false); !settled) made = settled.error();
    garment = shownOn(opened, map);  // of one that was refused as far as it came
  }
  if (made)
    fs::rename(part, kept, trouble);
  else
    fs::remove(part, trouble);
  if (!made && made.error().hindered()) return made.error();
  return garment;
}

}  // namespace

Done checkPeople(const PeopleWish& wish) {
  const auto each = pictureOptions(wish);
  return each ? Done() : Done(each.error());
}

Result<PeoplePicture> peoplePicture(Program& program, const PeopleWish& wish) {
  auto each = pictureOptions(wish);
  if (!each) return each.error();
  const auto plan = readPlan(wish.folder);
  if (!plan) return plan.error();
  if (const auto name = stranger(wish.people, plan->bodies))
    return notFound(say("There is no person “{0}” in this batch.", *name));
  if (const auto name = stranger(wish.designs, plan->designs))
    return notFound(say("There is no design “{0}” in this batch.", *name));
  const BatchTable table = tableOf(*plan, wish.folder);
  const std::vector<Misfit> misfits = misfitsOf(table);
  std::vector<std::size_t> rows = chosen(wish, table, misfits);
  PeoplePicture picture;
  picture.missing = std::erase_if(rows, [&](std::size_t r) { return table.text(r, "outcome").empty(); });
  if (rows.empty())
    return refused(picture.missing > 0 || !wish.misfits
                       ? say("Nothing of this batch is done yet; begin with karinui batch run.")
                       : say("The garment fits everyone who was asked for; leave out --misfits to see them."));
  if (rows.size() > kMostPeople)
    return refused(
        say("{0} garments are too many for one picture; {1} at most. Choose some: --misfits, --person, "
            "--design.",
            rows.size(), kMostPeople));
  if (const Done same = madeByThisProgram(*plan); !same) return same.error();

  std::map<std::size_t, Misfit> byRow;
  for (const Misfit& misfit : misfits) byRow.emplace(misfit.row, misfit);
  const bool many = plan->designs.size() > 1;
  Console& console = program.console;
  const Token& token = program.console.token();
  std::vector<LineUp::Figure> figures;
  std::vector<SceneFrame> frames;
  for (const std::size_t r : rows) {
    token.progress(static_cast<double>(figures.size()) / static_cast<double>(rows.size()),
                   say("{0} is dressed", table.text(r, "person")));
    LineUp::Figure figure{table.text(r, "person")};
    const std::string fabric = table.text(r, "fabric");
    if (many) figure.below.push_back(table.text(r, "design"));
    if (!fabric.empty()) figure.below.push_back(console.said(nameSaid(fabric)));
    if (const auto at = byRow.find(r); at != byRow.end()) {
      figure.marked = true;
      figure.below.push_back(console.said(saidOf(table, at->second)));
      ++picture.misfits;
    }
    figures.push_back(std::move(figure));
    // What ran out of time or memory or fell down would do so again.
    const std::string outcome = table.text(r, "outcome");
    if (outcome == nameOf(Outcome::Timeout) || outcome == nameOf(Outcome::OutOfMemory) ||
        outcome == nameOf(Outcome::Crashed)) {
      frames.emplace_back();
      continue;
    }
    console.keepNotes([](const Message&) {});  // the table has what there is to say
    Result<SeenGarment> garment = dressed(program, wish.folder, *plan, plan->items[r], each->map);
    console.keepNotes({});
    if (!garment && garment.error().hindered()) return garment.error();
    each->mapTop = std::max(each->mapTop, garment ? garment->mapTop : 0);
    frames.push_back(garment ? std::move(garment->frame)
                             : SceneFrame());  // a figure that cannot be built is told below
  }
  picture.garments = rows.size();
  LineUp lineUp(std::move(figures), frames, *each);
  auto image = lineUp.draw(0, columnsOf(rows.size()), token);
  if (!image) return image.error();
  for (const Message& note : lineUp.notes()) console.note(note);
  picture.image = *std::move(image);
  return picture;
}

}  // namespace karinui::app
