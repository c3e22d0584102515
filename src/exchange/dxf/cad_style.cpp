#include "cad_style.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "exchange/names.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kMillimetre = 1e-3, kCentimetre = 1e-2, kInch = 0.0254;
constexpr std::size_t kMostPieces = 5000;
// The largest piece of a garment is longer than this, in metres, and a shorter one is in another unit than was thought.
constexpr double kSmallestStyle = 0.2;
constexpr double kCloGrain = 0.180;  // metres: CLO draws all its grain lines as long as this

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string()
                                         : cleanText(text.substr(first, text.find_last_not_of(" \t") + 1 - first));
}

// The value of a system text: "SIZE" of "Size: 38" is "38". Nothing: it is another text. Writers differ in case.
std::optional<std::string> valueOf(std::string_view text, std::string_view key) {
  if (text.size() <= key.size() || text[key.size()] != ':') return std::nullopt;
  for (std::size_t i = 0; i < key.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(text[i])) != std::tolower(static_cast<unsigned char>(key[i])))
      return std::nullopt;
  return trimmed(text.substr(key.size() + 1));
}

void take(std::string& into, std::string_view text, std::string_view key) {
  if (auto value = valueOf(text, key)) into = *std::move(value);
}

// "2", or of the ASTM form "1,1" the right and the left ones together.
int quantityOf(const std::string& text) {
  int all = 0;
  std::string number;
  for (const char c : text + ',') {
    if (c != ',' && c != ' ') {
      number += c;
    } else if (const auto value = parseNumber(number)) {
      all += static_cast<int>(std::clamp(*value, 0.0, 999.0));
      number.clear();
    }
  }
  return std::max(all, 1);
}

std::optional<std::pair<Flat, Flat>> lineOf(const DxfEntity& entity) {
  if (entity.vertices.size() >= 2) return std::pair(entity.vertices.front(), entity.vertices.back());
  const auto from = entity.place(10), to = entity.place(11);
  return from && to ? std::optional(std::pair(*from, *to)) : std::nullopt;
}

std::optional<Flat> wayOf(std::optional<double> degrees) {
  if (!degrees) return std::nullopt;
  const double angle = *degrees * std::numbers::pi / 180;
  return Flat{std::cos(angle), std::sin(angle)};
}

CadPiece pieceOf(const std::vector<DxfEntity>& entities, std::string_view block) {
  CadPiece piece;
  const auto last = block.rfind('_');
  piece.name = cleanText(block.substr(0, last));
  if (last != std::string_view::npos) piece.size = cleanText(block.substr(last + 1));
  std::string quantity;
  for (const DxfEntity& entity : entities) {
    const int layer = entity.layer();
    if (entity.type == "TEXT" && entity.text(1).starts_with('#')) {
      const auto number = parseNumber(trimmed(entity.text(1).substr(1)));
      if (const auto place = entity.place(); place && number && *number >= 0 && *number <= 1e6)
        piece.rules.emplace_back(*place, static_cast<std::size_t>(*number));
    } else if (entity.type == "TEXT" && layer == 1) {
      const std::string_view text = entity.text(1);
      take(piece.name, text, "Piece Name"), take(piece.size, text, "Size"), take(piece.category, text, "Category");
      take(piece.annotation, text, "Annotation"), take(quantity, text, "Quantity");
      take(piece.fabric, text, "Fabric"), take(piece.fabric, text, "Material");
    } else if (entity.type == "POINT") {
      const auto place = entity.place();
      if (!place) continue;
      if (layer == 2) piece.turns.push_back(*place);
      if (layer == 3) piece.curved.push_back(*place);
      if (layer == 4 || (layer >= 80 && layer <= 83)) piece.notches.push_back({*place, wayOf(entity.number(50))});
      if (layer == 13) piece.drills.push_back(*place);
    } else if (const auto line = lineOf(entity)) {
      CadLine drawn{entity.vertices, entity.type != "LINE" && entity.closed()};
      if (entity.type == "LINE") drawn.points = {line->first, line->second};
      if (drawn.points.size() < 2) continue;
      if (layer == 7 && !piece.grain) piece.grain = line;
      if (layer == 6 && !piece.fold) piece.fold = line;
      auto* const into = layer == 1    ? &piece.boundary
                         : layer == 84 ? &piece.dense
                         : layer == 14 ? &piece.sewing
                         : layer == 11 ? &piece.cutouts
                         : layer == 8  ? &piece.inside
                                       : nullptr;
      if (into) into->push_back(std::move(drawn));
    }
  }
  piece.quantity = quantityOf(quantity);
  return piece;
}

double widest(const CadStyle& style) {
  double most = 0;
  for (const CadPiece& piece : style.pieces) {
    Flat low{1e9, 1e9}, high{-1e9, -1e9};
    for (const CadLine& line : piece.boundary)
      for (const Flat p : line.points) {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
      }
    most = std::max({most, high.u - low.u, high.v - low.v});
  }
  return most;
}

// How many metres a unit of the file is. What is told is not always so: there are files of CLO in centimetres that say
// METRIC, which means millimetres.
double unitOf(const CadStyle& style, std::string_view told, bool& sure) {
  const bool clo = style.author.find("CLO") != std::string::npos;
  for (const double unit : {kMillimetre, kInch, kCentimetre})
    if (clo && !style.pieces.empty() &&
        std::all_of(style.pieces.begin(), style.pieces.end(), [&](const CadPiece& piece) {
          return piece.grain && std::abs(distance(piece.grain->first, piece.grain->second) * unit - kCloGrain) < 1e-3;
        }))
      return unit;
  const double unit = told == "ENGLISH" ? kInch : kMillimetre, size = widest(style);
  sure = told == "METRIC" || told == "ENGLISH";
  if (size * unit >= kSmallestStyle) return unit;
  sure = false;
  return told == "METRIC" ? kCentimetre : kInch;
}

void scale(CadPiece& piece, double unit) {
  for (auto* lines : {&piece.boundary, &piece.dense, &piece.sewing, &piece.cutouts, &piece.inside})
    for (CadLine& line : *lines)
      for (Flat& p : line.points) p = p * unit;
  for (auto* points : {&piece.turns, &piece.curved, &piece.drills})
    for (Flat& p : *points) p = p * unit;
  for (CadNotch& notch : piece.notches) notch.place = notch.place * unit;
  for (auto& [place, rule] : piece.rules) place = place * unit;
  for (auto* line : {&piece.grain, &piece.fold})
    if (*line) (*line)->first = (*line)->first * unit, (*line)->second = (*line)->second * unit;
}

}  // namespace

Result<CadStyle> cadStyle(const DxfFile& file) {
  CadStyle style;
  std::string units;
  for (const DxfEntity& entity : file.entities) {
    if (entity.type != "TEXT") continue;
    const std::string_view text = entity.text(1);
    take(style.name, text, "Style Name"), take(style.sampleSize, text, "Sample Size"), take(units, text, "Units");
    take(style.author, text, "Author");
  }
  if (file.blocks.size() > kMostPieces) return badInput(say("The DXF file holds more than {0} pieces.", kMostPieces));
  for (const DxfBlock& block : file.blocks) style.pieces.push_back(pieceOf(block.entities, block.name));
  style.pieces.push_back(pieceOf(file.entities, style.name.empty() ? "piece" : style.name));  // drawn without a block
  std::erase_if(style.pieces, [](const CadPiece& piece) { return piece.boundary.empty(); });
  if (style.pieces.empty())
    return badInput(
        say("The DXF file has no piece: nothing is drawn on layer 1, where AAMA and ASTM files have outlines."));

  for (char& c : units) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const double unit = unitOf(style, units, style.unitsTold);
  for (CadPiece& piece : style.pieces) {
    scale(piece, unit);
    if (std::find(style.sizes.begin(), style.sizes.end(), piece.size) == style.sizes.end())
      style.sizes.push_back(piece.size);
  }
  return style;
}

}  // namespace karinui
