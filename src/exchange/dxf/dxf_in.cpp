#include <algorithm>
#include <map>
#include <set>

#include "cad_outline.h"
#include "exchange/names.h"
#include "karinui/exchange/dxf.h"

namespace karinui {

namespace {

std::string listOf(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

void addRow(std::vector<CadPattern::Row>& rows, const CadPiece& piece) {
  auto row = std::find_if(rows.begin(), rows.end(), [&](const CadPattern::Row& r) { return r.name == piece.name; });
  if (row == rows.end()) row = rows.insert(rows.end(), {piece.name, {}, {}, {}, 1, {}});
  if (!piece.category.empty()) row->category = piece.category;
  if (!piece.annotation.empty()) row->annotation = piece.annotation;
  if (!piece.fabric.empty()) row->fabric = piece.fabric;
  row->quantity = std::max(row->quantity, piece.quantity);
  row->sizes.push_back(piece.size);
}

}  // namespace

Result<CadPattern> readCadPattern(std::string_view bytes, std::string_view size) {
  const auto file = parseDxf(bytes);
  if (!file) return file.error();
  auto style = cadStyle(*file);
  if (!style) return style.error();
  CadPattern made;
  made.style = style->name, made.author = style->author, made.sampleSize = style->sampleSize, made.sizes = style->sizes;
  const auto has = [&](std::string_view one) {
    return std::find(made.sizes.begin(), made.sizes.end(), one) != made.sizes.end();
  };
  if (!size.empty() && !has(size))
    return badInput(say("The file has no size “{0}”; it has {1}.", cleanText(size), listOf(made.sizes)));
  made.size = !size.empty() ? std::string(size) : has(made.sampleSize) ? made.sampleSize : made.sizes.front();
  if (!style->unitsTold)
    made.notes.push_back(
        say("The file’s unit of length was guessed from how large its pieces are: look at a length you know."));

  std::map<std::string, const CadPiece*> samples;
  for (const CadPiece& piece : style->pieces)
    if (!piece.turns.empty()) samples.emplace(piece.name, &piece);
  std::set<std::string> names;
  std::optional<Error> trouble;
  for (const CadPiece& drawn : style->pieces) {
    addRow(made.rows, drawn);
    if (drawn.size != made.size) continue;
    const auto sample = samples.find(drawn.name);
    auto piece = pieceOf(drawn, sample == samples.end() ? nullptr : sample->second, made.notes);
    if (!piece) {
      if (!trouble) trouble = piece.error();
      made.notes.push_back(piece.error().what);
      continue;
    }
    piece->id = {made.pattern.pieces.size() + 1};
    piece->name = distinct(oneWord(piece->name, "piece"), names);
    made.pattern.pieces[piece->id] = std::make_shared<const Piece>(*std::move(piece));
  }
  if (made.pattern.pieces.empty())
    return trouble ? *trouble : badInput(say("The DXF file has no piece of size {0}.", made.size));
  return made;
}

}  // namespace karinui
