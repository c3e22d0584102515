#include <algorithm>
#include <map>
#include <set>

#include "cad_outline.h"
#include "exchange/names.h"
#include "grade_rules.h"
#include "karinui/exchange/dxf.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

std::string listOf(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

void addRow(std::vector<CadPattern::Row>& rows, const CadPiece& piece) {
  auto row = std::find_if(rows.begin(), rows.end(), [&](const CadPattern::Row& r) { return r.name == piece.name; });
  if (row == rows.end()) row = rows.insert(rows.end(), {piece.name, {}, {}, {}, 1, false, {}});
  if (!piece.category.empty()) row->category = piece.category;
  if (!piece.annotation.empty()) row->annotation = piece.annotation;
  if (!piece.fabric.empty()) row->fabric = piece.fabric;
  row->quantity = std::max(row->quantity, piece.quantity), row->pairs = row->pairs || piece.pairs;
  row->sizes.push_back(piece.size);
}

constexpr std::size_t kMostMeasured = 200'000;  // points of all sizes together
constexpr double kAtPoint = 1e-4;               // metres from the outline within which a rule is of a point on it,
constexpr double kAtCorner = 5e-5;              // and from a corner within which it is the corner's

// The places of the outline whose points name grade rules.
void addRules(std::vector<CadPattern::RulePlace>& places, const Piece& piece, const EdgePlan& plan) {
  for (std::size_t i = 0; i < plan.rules.size(); ++i) {
    const auto& [place, number] = plan.rules[i];
    const PlaceOnOutline at = nearestOn(piece.outline, place);
    if (at.distance > kAtPoint) continue;
    CadPattern::RulePlace rule{piece.id, at.edge, at.fraction, number, {}};
    if (length(plan.folds[i]) > 0) rule.fold = plan.folds[i];
    const auto& edges = piece.outline.edges;
    const std::size_t k = *piece.outline.find(at.edge);
    if (distance(place, edges[k].curve.start) < kAtCorner) rule.at = 0;
    if (distance(place, edges[k].curve.end) < kAtCorner) rule.edge = edges[(k + 1) % edges.size()].name, rule.at = 0;
    places.push_back(std::move(rule));
  }
}

struct NamedPiece {  // a piece, as it is named in the file
  std::string name;
  std::size_t nth = 0;  // of those of this name and size
  const CadPiece* sample = nullptr;
  EdgePlan plan;
};

// What the other sizes differ by from the one that was read. A size that a piece lacks is as its neighbour.
void measureSizes(const CadStyle& style, const std::map<PieceId, NamedPiece>& drawn, CadPattern& made) {
  if (made.sizes.size() < 2) return;
  std::size_t points = 0;
  for (const CadPiece& piece : style.pieces)
    for (const CadLine& line : piece.boundary) points += line.points.size();
  if (made.sizes.size() > kMostSizes || points > kMostMeasured)
    return made.notes.push_back(
        say("The other sizes were left out: they are more than {0}, or drawn with more than {1} points.", kMostSizes,
            kMostMeasured));
  Grading grading;
  grading.sizes = sizeWords(made.sizes);
  grading.base = grading.standing =
      static_cast<std::size_t>(std::find(made.sizes.begin(), made.sizes.end(), made.size) - made.sizes.begin());
  std::map<std::pair<std::string, std::string>, std::vector<const CadPiece*>> blocks;
  for (const CadPiece& piece : style.pieces) blocks[{piece.name, piece.size}].push_back(&piece);
  for (const auto& [id, own] : drawn) {
    const std::string& name = own.name;
    std::vector<std::optional<Outline>> found(made.sizes.size());
    found[grading.base] = made.pattern.pieces.at(id)->outline;
    bool any = false;
    for (std::size_t size = 0; size < found.size(); ++size) {
      const auto block = blocks.find({name, made.sizes[size]});
      if (size == grading.base || block == blocks.end() || block->second.size() <= own.nth) continue;
      auto outline = outlineOf(*block->second[own.nth], own.sample, own.plan);
      if (outline)
        found[size] = *std::move(outline), any = any || *found[size] != *found[grading.base];
      else
        made.notes.push_back(outline.error().what);
    }
    if (!any) continue;
    for (std::size_t i = grading.base; i-- > 0;)
      if (!found[i]) found[i] = found[i + 1];
    for (std::size_t i = grading.base + 1; i < found.size(); ++i)
      if (!found[i]) found[i] = found[i - 1];
    std::vector<Outline> sizes;
    for (auto& outline : found) sizes.push_back(*std::move(outline));
    auto measured = measuredGrading(sizes, grading.base);
    if (!measured) {
      made.notes.push_back(say("Piece “{0}” is kept in one size: {1}", name, measured.error().what));
      continue;
    }
    grading.pieces[id] = *std::move(measured);
  }
  if (!grading.pieces.empty()) made.grading = std::move(grading);
}

}  // namespace

Result<CadPattern> readCadPattern(std::string_view bytes, std::string_view size, double unit) {
  const auto file = parseDxf(bytes);
  if (!file) return file.error();
  auto style = cadStyle(*file, unit);
  if (!style) return style.error();
  CadPattern made;
  made.style = style->name, made.author = style->author, made.sampleSize = style->sampleSize, made.sizes = style->sizes;
  const auto has = [&](std::string_view one) {
    return std::find(made.sizes.begin(), made.sizes.end(), one) != made.sizes.end();
  };
  if (!size.empty() && !has(size))
    return badInput(say("The file has no size “{0}”; it has {1}.", cleanText(size), listOf(made.sizes)));
  made.size = !size.empty() ? std::string(size) : has(made.sampleSize) ? made.sampleSize : made.sizes.front();
  if (!style->unitsTold) made.guessedUnit = style->unit;
  if (!style->unitsTold)
    made.notes.push_back(
        say("The file’s unit of length was guessed from how large its pieces are: look at a length you know. Where it "
            "is wrong, say what a unit is (--unit mm)."));
  for (const Message& note : style->notes) made.notes.push_back(note);

  if (style->lettersGuessed)
    made.notes.push_back(say("The file does not tell in which code page its names are written; it was guessed."));

  // A piece that is not drawn in the size that is read is taken in the one nearest to it in the file's order.
  const auto place = [&](const std::string& one) {
    return std::find(made.sizes.begin(), made.sizes.end(), one) - made.sizes.begin();
  };
  std::map<std::string, std::string> taken;
  for (const CadPiece& piece : style->pieces) {
    const auto [size_, fresh] = taken.emplace(piece.name, piece.size);
    const auto off = [&](const std::string& one) { return std::abs(place(one) - place(made.size)); };
    if (!fresh && off(piece.size) < off(size_->second)) size_->second = piece.size;
  }
  for (const auto& [name, one] : taken)
    if (one != made.size)
      made.notes.push_back(
          say("Piece “{0}” is not drawn in size {1}; it was taken in size {2}.", name, made.size, one));

  // Several pieces of one name are told apart by their order.
  std::map<std::pair<std::string, std::size_t>, const CadPiece*> samples;
  std::map<std::pair<std::string, std::string>, std::size_t> count;
  for (const CadPiece& piece : style->pieces)
    if (const std::size_t nth = count[{piece.name, piece.size}]++; !piece.turns.empty())
      samples.emplace(std::pair(piece.name, nth), &piece);
  count.clear();
  DistinctNames names;
  std::map<PieceId, NamedPiece> all;
  std::optional<Error> trouble;
  for (const CadPiece& drawn : style->pieces) {
    addRow(made.rows, drawn);
    if (drawn.size != taken.at(drawn.name)) continue;
    const std::size_t nth = count[{drawn.name, drawn.size}]++;
    const auto sample = samples.find({drawn.name, nth});
    NamedPiece one{drawn.name, nth, sample == samples.end() ? nullptr : sample->second, {}};
    auto piece = pieceOf(drawn, one.sample, made.notes, one.plan);
    if (!piece) {
      if (!trouble) trouble = piece.error();
      made.notes.push_back(piece.error().what);
      continue;
    }
    piece->id = {made.pattern.pieces.size() + 1};
    piece->name = names.give(oneWord(piece->name, "piece"));
    addRules(made.rules, *piece, one.plan);
    all.emplace(piece->id, std::move(one));
    made.pattern.pieces[piece->id] = std::make_shared<const Piece>(*std::move(piece));
  }
  if (made.pattern.pieces.empty())
    return trouble ? *trouble : badInput(say("The DXF file has no piece of size {0}.", made.size));
  // "Quantity: 2" of a piece that is not alike on both sides is a left and a right one.
  for (const auto& [id, drawn] : all)
    for (const CadPattern::Row& row : made.rows)
      if (row.name == drawn.name && row.quantity > 1)
        made.cutting.quantities[id] = {
            row.quantity, row.quantity % 2 == 0 && (row.pairs || !symmetryOf(made.pattern.pieces.at(id)->outline))};
  measureSizes(*style, all, made);
  return made;
}

}  // namespace karinui
