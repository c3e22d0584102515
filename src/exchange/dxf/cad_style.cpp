#include "cad_style.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "cad_plain.h"
#include "cad_ring.h"
#include "dxf_shapes.h"
#include "dxf_text.h"
#include "exchange/names.h"
#include "karinui/base/number.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

constexpr double kMillimetre = 1e-3, kCentimetre = 1e-2, kInch = 0.0254;
constexpr std::size_t kMostPieces = 5000;
constexpr std::size_t kMostParts = 200;  // pieces in one block
// The largest piece of a garment is longer than this, in metres, and a shorter one is in another unit than was thought.
constexpr double kSmallestStyle = 0.2;
constexpr double kSmallestPiece = 0.08;  // no garment’s largest piece is shorter: its file is in metres
constexpr std::size_t kMostEmpty = 20;   // notes of blocks without an outline
constexpr double kCloGrain = 0.180;      // metres: CLO draws all its grain lines as long as this
constexpr double kFar = 10;              // metres from the paper's origin, where numbers begin to lose their places
constexpr double kSymbol = 1e-3;         // of the largest outline's area: what is smaller beside it is no piece
constexpr double kHole = 0.5;            // of the outline's area: a line within it that is smaller is a cut-out

// The value of a system text: "SIZE" of "Size: 38" is "38". Nothing: it is another text. Writers differ in case, and
// some put a blank before the colon or one of full width.
std::optional<std::string> valueOf(std::string_view text, std::string_view key) {
  if (text.size() < key.size()) return std::nullopt;
  for (std::size_t i = 0; i < key.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(text[i])) != std::tolower(static_cast<unsigned char>(key[i])))
      return std::nullopt;
  const auto colon = text.find_first_not_of(" \t", key.size());
  if (colon == std::string_view::npos) return std::nullopt;
  constexpr std::string_view kFullWidth = "：";
  const std::string_view rest = text.substr(colon);
  if (!rest.starts_with(':') && !rest.starts_with(kFullWidth)) return std::nullopt;
  const auto value = rest.find_first_not_of(" \t", rest.starts_with(':') ? 1 : kFullWidth.size());
  return value == std::string_view::npos ? std::string() : std::string(rest.substr(value));
}

void take(std::string& into, std::string_view text, std::string_view key) {
  if (auto value = valueOf(text, key)) into = *std::move(value);
}

// "2", or of the ASTM form "1,1" the right and the left ones.
void takeQuantity(CadPiece& piece, const std::string& told) {
  std::vector<int> numbers;
  std::string number;
  for (const char c : told + ',') {
    if (c != ',' && c != ' ' && c != ';') {
      number += c;
    } else {
      if (const auto value = parseNumber(number)) numbers.push_back(static_cast<int>(std::clamp(*value, 0.0, 999.0)));
      number.clear();
    }
  }
  for (const int one : numbers) piece.quantity += one;
  piece.pairs = numbers.size() == 2 && numbers[0] > 0 && numbers[0] == numbers[1];
  if (piece.quantity > 0) return;
  // "CUT 2", "cut 1 pair"
  std::string words;
  for (const char c : piece.annotation) words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto cut = words.find("cut ");
  if (cut == std::string::npos || (cut > 0 && std::isalpha(static_cast<unsigned char>(words[cut - 1])))) return;
  const std::string rest = words.substr(cut + 4);
  const auto end = rest.find_first_not_of("0123456789");
  const auto count = parseNumber(rest.substr(0, end));
  if (!count || *count < 1 || *count > 999) return;
  piece.pairs = end != std::string::npos && rest.find("pair", end) == end + 1;
  piece.quantity = static_cast<int>(*count) * (piece.pairs ? 2 : 1);
}

std::optional<std::pair<Flat, Flat>> endsOf(const DxfShape& line) {
  return std::pair(line.points.front(), line.points.back());
}

double distanceTo(const std::vector<CadLine>& lines, Flat place) {
  double nearest = 1e300;
  for (const CadLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.points.size() + (line.closed ? 1 : 0); ++i) {
      const Flat a = line.points[i], way = line.points[(i + 1) % line.points.size()] - a;
      const double square = dot(way, way);
      const double t = square > 0 ? std::clamp(dot(place - a, way) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, distance(place, a + t * way));
    }
  return nearest;
}

// A notch that is drawn as a line, a slit or a V, stands where it meets the boundary and points into the piece.
CadNotch notchOf(const std::vector<Flat>& line, const std::vector<CadLine>& boundary) {
  Flat place = line.front(), tip = line.back();
  if (line.size() > 2) {
    place = 0.5 * (line.front() + line.back());
    for (const Flat p : line)
      if (distance(p, place) > distance(tip, place)) tip = p;
  }
  if (distanceTo(boundary, tip) < distanceTo(boundary, place)) std::swap(place, tip);
  CadNotch notch{place, {}};
  if (distance(place, tip) > 0) notch.inward = normalized(tip - place);
  return notch;
}

std::vector<CadLine>* linesOn(CadPiece& piece, int layer) {
  switch (layer) {
    case 1:
      return &piece.boundary;
    case 84:
      return &piece.dense;
    case 14:
      return &piece.sewing;
    case 11:
      return &piece.cutouts;
    case 8:
      return &piece.inside;
    default:
      return nullptr;
  }
}

CadPiece pieceOf(const std::vector<DxfShape>& shapes, const DxfWords& words) {
  CadPiece piece;
  std::string quantity;
  for (const DxfShape& shape : shapes) {
    const Flat place = shape.points.front();
    if (shape.kind == DxfShape::Kind::Text) {
      const std::string text = words(shape.words);
      if (text.starts_with('#')) {
        const auto first = text.find_first_not_of(' ', 1);
        const auto number = first == std::string::npos ? std::nullopt : parseNumber(text.substr(first));
        if (number && *number >= 0 && *number <= 1e6)
          piece.rules.emplace_back(place, static_cast<std::size_t>(*number));
        continue;
      }
      take(piece.name, text, "Piece Name"), take(piece.category, text, "Category");
      take(piece.annotation, text, "Annotation"), take(quantity, text, "Quantity");
      take(piece.fabric, text, "Fabric"), take(piece.fabric, text, "Material");
      if (const auto size = valueOf(text, "Size")) piece.size = *size, piece.sizeTold = true;
    } else if (shape.kind == DxfShape::Kind::Point) {
      if (shape.layer == 2) piece.turns.push_back(place);
      if (shape.layer == 3) piece.curved.push_back(place);
      if (isNotchLayer(shape.layer)) piece.notches.push_back({place, shape.heading});
      if (shape.layer == 13) piece.drills.push_back(place);
    } else {
      if (shape.layer == 7 && !piece.grain) piece.grain = endsOf(shape);
      if (shape.layer == 6 && !piece.fold) piece.fold = endsOf(shape);
      if (shape.layer == 13 && shape.round) {
        Flat centre;
        for (const Flat p : shape.points) centre += (1.0 / static_cast<double>(shape.points.size())) * p;
        piece.drills.push_back(centre);
      }
      if (auto* const into = linesOn(piece, shape.layer)) into->push_back({shape.points, shape.closed});
    }
  }
  takeQuantity(piece, quantity);
  // Half an outline may leave the fold to layer 6, and one open line may leave out its last side.
  Flat gap;
  if (!piece.boundary.empty() && loopsOf(piece.boundary, gap).empty()) {
    if (piece.fold) {
      piece.boundary.push_back({{piece.fold->first, piece.fold->second}, false});
      if (loopsOf(piece.boundary, gap).empty()) piece.boundary.pop_back();
    }
    if (piece.boundary.size() == 1 && piece.boundary[0].points.size() > 3) {
      piece.boundary[0].closed = true;
      piece.notes.push_back(say("its outline is open and was closed by a straight line."));
    }
  }
  for (const DxfShape& shape : shapes)
    if (shape.kind == DxfShape::Kind::Line && isNotchLayer(shape.layer))
      piece.notches.push_back(notchOf(shape.points, piece.boundary));
  return piece;
}

// The shapes of each piece where several are drawn beside each other: what lies in its outline, or nearest to it.
// `inner`: closed lines on layer 1 that lie in another.
struct Parts {
  std::vector<std::vector<DxfShape>> shapes;
  std::vector<std::size_t> left;  // of each the lines within its outline that are no cut-outs
};
Parts partsOf(std::vector<DxfShape> shapes) {
  std::vector<CadLine> lines;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].kind == DxfShape::Kind::Line && shapes[i].layer == 1)
      lines.push_back({shapes[i].points, shapes[i].closed}), of.push_back(i);
  Flat gap;
  std::vector<CadLoop> loops = lines.size() < 2 ? std::vector<CadLoop>() : loopsOf(lines, gap, slipOf(shapes));
  std::stable_sort(loops.begin(), loops.end(),
                   [](const CadLoop& a, const CadLoop& b) { return signedArea(a.points) > signedArea(b.points); });
  Parts parts;
  std::vector<const CadLoop*> outer;
  std::vector<std::size_t> owner(shapes.size(), shapes.size());
  for (const CadLoop& loop : loops) {
    const auto around = std::find_if(outer.begin(), outer.end(), [&](const CadLoop* one) {
      return contains(one->points, loop.points.front()) && contains(one->points, loop.points[loop.points.size() / 2]);
    });
    const auto nth = static_cast<std::size_t>(around - outer.begin());
    const bool symbol = !outer.empty() && signedArea(loop.points) < kSymbol * signedArea(outer.front()->points);
    if (around == outer.end() && outer.size() < kMostParts && !symbol) {
      outer.push_back(&loop), parts.left.push_back(0);
    } else if (around == outer.end()) {
      continue;
    } else if (signedArea(loop.points) < kHole * signedArea((*around)->points)) {
      for (const std::size_t line : loop.lines) shapes[of[line]].layer = 11;
    } else {
      ++parts.left[nth];
    }
    for (const std::size_t line : loop.lines) owner[of[line]] = nth;
  }
  if (outer.size() < 2) {
    parts.left.resize(1);
    parts.shapes.push_back(std::move(shapes));
    return parts;
  }
  parts.shapes.resize(outer.size());
  std::vector<std::vector<CadLine>> rings;
  for (const CadLoop* loop : outer) rings.push_back({{loop->points, true}});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::size_t nth = owner[i];
    if (nth == shapes.size()) {
      double nearest = 1e300;
      for (std::size_t k = 0; k < outer.size(); ++k) {
        const Flat place = shapes[i].points.front();
        const double off = contains(outer[k]->points, place) ? 0 : distanceTo(rings[k], place);
        if (off < nearest) nearest = off, nth = k;
      }
    }
    parts.shapes[nth].push_back(std::move(shapes[i]));
  }
  return parts;
}

double widest(const CadStyle& style) {
  double most = 0;
  for (const CadPiece& piece : style.pieces) {
    FlatBox box;
    for (const CadLine& line : piece.boundary)
      for (const Flat p : line.points) box.include(p);
    most = std::max({most, box.size().u, box.size().v});
  }
  return most;
}

// How many metres a unit of the file is. What is told is not always so: there are files of CLO in centimetres that say
// METRIC, which means millimetres.
double unitOf(const CadStyle& style, std::string told, int code, bool& sure) {
  const bool clo = style.author.find("CLO") != std::string::npos;
  for (const double unit : {kMillimetre, kInch, kCentimetre})
    if (clo && !style.pieces.empty() &&
        std::all_of(style.pieces.begin(), style.pieces.end(), [&](const CadPiece& piece) {
          return piece.grain && std::abs(distance(piece.grain->first, piece.grain->second) * unit - kCloGrain) < 1e-3;
        }))
      return unit;
  for (char& c : told) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const bool metric = told == "METRIC" || told == "MM" || told == "MILLIMETERS" || told == "MILLIMETRES";
  const bool inches = told == "ENGLISH" || told == "IMPERIAL" || told == "INCH" || told == "INCHES" || told == "IN";
  const bool centimetres = told == "CM" || told == "CENTIMETERS" || told == "CENTIMETRES";
  const double size = widest(style);
  sure = metric || inches || centimetres;
  double unit = inches ? kInch : centimetres ? kCentimetre : kMillimetre;
  if (!sure && (code == 1 || code == 4 || code == 5 || code == 6))
    unit = code == 1 ? kInch : code == 5 ? kCentimetre : code == 6 ? 1 : kMillimetre, sure = true;
  if (size * unit >= kSmallestStyle) return unit;
  sure = false;
  const double guess = metric ? kCentimetre : kInch;
  return size * guess >= kSmallestPiece ? guess : 1;
}

template <class Change>
void changePlaces(CadPiece& piece, const Change& change) {
  for (auto* lines : {&piece.boundary, &piece.dense, &piece.sewing, &piece.cutouts, &piece.inside})
    for (CadLine& line : *lines)
      for (Flat& p : line.points) p = change(p);
  for (auto* points : {&piece.turns, &piece.curved, &piece.drills})
    for (Flat& p : *points) p = change(p);
  for (CadNotch& notch : piece.notches) notch.place = change(notch.place);
  for (auto& [place, rule] : piece.rules) place = change(place);
  for (auto* line : {&piece.grain, &piece.fold})
    if (*line) (*line)->first = change((*line)->first), (*line)->second = change((*line)->second);
}

// Pieces that lie far from the paper's origin are brought there, all sizes of one by the same way.
void bringNear(std::vector<CadPiece>& pieces) {
  std::map<std::string, Flat> far;
  for (CadPiece& piece : pieces) {
    const Flat first = piece.boundary.front().points.front();
    const auto by = far.emplace(piece.name, length(first) > kFar ? first : Flat{}).first->second;
    if (length(by) > 0) changePlaces(piece, [&](Flat p) { return p - by; });
  }
}

// Names and sizes that no text tells. Blocks are called PIECE_SIZE, as the standards have it, unless the endings are
// not the same for every piece: FRONT_LEFT is no size.
void nameSizes(CadStyle& style) {
  const bool told = std::any_of(style.pieces.begin(), style.pieces.end(), [](const CadPiece& p) { return p.sizeTold; });
  std::set<std::string> whole, bases, endings;
  const auto parted = [](const std::string& name) {
    const auto last = name.rfind('_');
    return last == std::string::npos ? std::pair(name, std::string())
                                     : std::pair(name.substr(0, last), name.substr(last + 1));
  };
  for (const CadPiece& piece : style.pieces) {
    const auto [base, ending] = parted(piece.block);
    whole.insert(piece.block), bases.insert(base), endings.insert(ending);
  }
  const bool sizes = told || endings.contains(style.sampleSize) || whole.size() == bases.size() * endings.size();
  for (CadPiece& piece : style.pieces) {
    const auto [base, ending] = parted(piece.block);
    if (piece.name.empty()) piece.name = (piece.sizeTold ? ending == piece.size : sizes) ? base : piece.block;
    if (!piece.sizeTold && sizes) piece.size = ending;
  }
  // What has none is of the size that is read when nothing is asked for.
  std::string usual = style.sampleSize;
  for (const CadPiece& piece : style.pieces)
    if (usual.empty()) usual = piece.size;
  for (CadPiece& piece : style.pieces)
    if (piece.size.empty()) piece.size = usual;
}

std::string layersOf(const DxfFile& file) {
  std::set<std::string> names;
  const auto add = [&](const std::vector<DxfEntity>& entities) {
    for (const DxfEntity& entity : entities)
      if (names.size() < 12 && (entity.is("LINE") || !entity.vertices.empty() || entity.is("SPLINE")))
        names.insert(cleanText(entity.text(8)));
  };
  for (const DxfBlock& block : file.blocks) add(block.entities);
  add(file.entities);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

// Files that leave out layer 1 have their outlines on the layer of the seam line, or of the second drawing.
void takeOtherBoundary(std::vector<DxfShape>& shapes) {
  const auto on = [&](int layer) {
    return std::any_of(shapes.begin(), shapes.end(), [&](const DxfShape& shape) {
      return shape.kind == DxfShape::Kind::Line && shape.layer == layer;
    });
  };
  if (on(1)) return;
  for (const int layer : {14, 84, 87})
    if (on(layer)) {
      for (DxfShape& shape : shapes)
        if (shape.kind == DxfShape::Kind::Line && shape.layer == layer) shape.layer = 1;
      return;
    }
}

// A block with an outline of its own, drawn there or inserted as a plain shape, is a piece; the others are drawn within
// those that insert them.
std::set<std::string_view> blocksOfPieces(const DxfFile& file) {
  std::set<std::string_view> pieces;
  const auto add = [&](const auto& draws) {
    std::set<std::string_view> found;
    for (const DxfBlock& block : file.blocks)
      if (std::any_of(block.entities.begin(), block.entities.end(), [&](const DxfEntity& entity) {
            const int layer = layerNumber(entity.text(8));
            return (layer == 1 || layer == 14 || layer == 84) && draws(entity);
          }))
        found.insert(block.name);
    pieces.merge(found);
  };
  add([](const DxfEntity& entity) { return !entity.is("INSERT") && !entity.is("TEXT") && !entity.is("POINT"); });
  add([&](const DxfEntity& entity) { return entity.is("INSERT") && !pieces.contains(entity.text(2)); });
  return pieces;
}

// A drawing on layers of its own, as programs that know nothing of the trade write it.
Done takePlain(const DxfFile& file, const DxfWords& words, CadStyle& style) {
  auto shapes = shapesOf(file, file.entities, {}, {});
  if (!shapes) return shapes.error();
  putOnLayers(*shapes);
  Parts parts = partsOf(*std::move(shapes));
  for (std::size_t k = 0; k < parts.shapes.size(); ++k) {
    std::vector<DxfShape>& own = parts.shapes[k];
    tellInnerLines(own);
    CadPiece piece = pieceOf(own, words);
    if (piece.boundary.empty()) continue;
    if (piece.name.empty()) piece.name = plainNameOf(own, words);
    piece.block = parts.shapes.size() > 1 ? "piece-" + std::to_string(k + 1) : "piece";
    style.pieces.push_back(std::move(piece));
  }
  if (style.pieces.empty()) return {};
  style.notes.clear();
  style.notes.push_back(
      say("The file’s layers are not those of AAMA and ASTM: its closed lines were read as outlines, those within "
          "them as seam lines and inner lines."));
  return {};
}

}  // namespace

Result<CadStyle> cadStyle(const DxfFile& file, double unit) {
  CadStyle style;
  std::string units;
  const DxfWords words(file);
  style.lettersGuessed = words.guessed();
  const auto tell = [&](const std::vector<DxfEntity>& entities) {
    for (const DxfEntity& entity : entities) {
      if (!entity.is("TEXT") && !entity.is("MTEXT") && !entity.is("ATTRIB")) continue;
      const std::string text = words(entity.text(1));
      take(style.name, text, "Style Name"), take(style.sampleSize, text, "Sample Size"), take(units, text, "Units");
      take(style.author, text, "Author");
    }
  };
  for (const DxfBlock& block : file.blocks) tell(block.entities);
  tell(file.entities);
  if (file.blocks.size() > kMostPieces) return badInput(say("The DXF file holds more than {0} pieces.", kMostPieces));

  const std::set<std::string_view> pieces = blocksOfPieces(file);
  struct Inserted {
    DxfFrame frame;
    int count = 0;
  };
  std::map<std::string_view, Inserted> inserted;
  const auto find = [&](const std::vector<DxfEntity>& entities) {
    for (const DxfEntity& entity : entities)
      if (entity.is("INSERT") && pieces.contains(entity.text(2)))
        if (const auto [at, fresh] = inserted.emplace(entity.text(2), Inserted{frameOf(entity, {}), 1}); !fresh)
          ++at->second.count;
  };
  find(file.entities);
  for (const DxfBlock& block : file.blocks)
    if (inserted.empty() || !pieces.contains(block.name)) find(block.entities);
  std::set<std::string> empty;
  std::map<std::string, CadPiece> around;  // the words beside a block that is inserted, by its name
  const auto add = [&](const std::vector<DxfEntity>& entities, const DxfFrame& frame, std::string_view name,
                       int count) -> Done {
    auto shapes = shapesOf(file, entities, frame, pieces);
    if (!shapes) return shapes.error();
    takeOtherBoundary(*shapes);
    Parts parts = partsOf(*std::move(shapes));
    for (std::size_t k = 0; k < parts.shapes.size(); ++k) {
      CadPiece piece = pieceOf(parts.shapes[k], words);
      if (piece.boundary.empty()) {
        if (piece.name.empty()) continue;
        const bool within = std::any_of(entities.begin(), entities.end(), [&](const DxfEntity& entity) {
          return entity.is("INSERT") && pieces.contains(entity.text(2)) &&
                 around.emplace(words(entity.text(2)), piece).second;
        });
        if (!within && empty.insert(piece.name).second && empty.size() <= kMostEmpty)
          style.notes.push_back(say("Piece “{0}” has no outline and was left out.", piece.name));
        continue;
      }
      piece.block = words(name) + (parts.shapes.size() > 1 ? "-" + std::to_string(k + 1) : "");
      if (parts.left[k] > 0)
        piece.notes.push_back(
            say("{0} {0|line|lines} on layer 1 within its outline {0|was|were} left out.", parts.left[k]));
      if (piece.quantity == 0) piece.quantity = count;
      style.pieces.push_back(std::move(piece));
    }
    if (style.pieces.size() > kMostPieces)
      return badInput(say("The DXF file holds more than {0} pieces.", kMostPieces));
    return {};
  };
  for (const DxfBlock& block : file.blocks) {
    const auto lies = inserted.find(block.name);
    DxfFrame frame = lies == inserted.end() ? DxfFrame() : lies->second.frame;
    frame.at = {};  // where a piece lies on the sheet does not matter
    if (const Done done = add(block.entities, frame, block.name, lies == inserted.end() ? 0 : lies->second.count);
        !done)
      return done.error();
  }
  if (const Done done = add(file.entities, {}, style.name.empty() ? "piece" : style.name, 0); !done)
    return done.error();  // what is drawn without a block
  for (CadPiece& piece : style.pieces)
    if (const auto said = around.find(piece.block); said != around.end() && piece.name.empty()) {
      const CadPiece& beside = said->second;
      piece.name = beside.name, piece.category = beside.category, piece.annotation = beside.annotation;
      piece.fabric = beside.fabric;
      if (!piece.sizeTold) piece.size = beside.size, piece.sizeTold = beside.sizeTold;
      if (beside.quantity > 0) piece.quantity = beside.quantity, piece.pairs = beside.pairs;
    }
  if (style.pieces.empty())
    if (const Done done = takePlain(file, words, style); !done) return done.error();
  if (style.pieces.empty()) {
    const std::string layers = layersOf(file);
    if (!layers.empty())
      return badInput(
          say("The DXF file has no piece: nothing is drawn on layer 1, where AAMA and ASTM files have "
              "outlines. It has lines on: {0}.",
              layers));
    return badInput(
        say("The DXF file has no piece: nothing is drawn on layer 1, where AAMA and ASTM files have outlines."));
  }

  nameSizes(style);
  if (unit <= 0) unit = unitOf(style, units, file.unitCode, style.unitsTold);
  style.unit = unit;
  for (CadPiece& piece : style.pieces) {
    changePlaces(piece, [&](Flat p) { return p * unit; });
    if (std::find(style.sizes.begin(), style.sizes.end(), piece.size) == style.sizes.end())
      style.sizes.push_back(piece.size);
  }
  bringNear(style.pieces);
  return style;
}

}  // namespace karinui
