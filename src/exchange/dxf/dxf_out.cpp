#include <cmath>
#include <numbers>
#include <set>

#include "exchange/names.h"
#include "exchange/sheet.h"
#include "grade_rules.h"
#include "karinui/base/number.h"
#include "karinui/exchange/dxf.h"
#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/trims.h"

namespace karinui {

namespace {

constexpr double kMiss = 4e-5;            // metres between a curve and its chords
constexpr double kNotchDepth = 4;         // mm, as Gerber writes them
constexpr std::size_t kLongestName = 16;  // of a block, so that with its size it has 20 characters: readers stop there
constexpr double kTurn = std::numbers::pi / 15;   // 12 degrees between two chords of a cut line are a corner
constexpr double kKink = std::numbers::pi / 360;  // half a degree within an edge: the outline has a corner there
constexpr std::size_t kLongestText = 240;         // with what stands before it: readers of R12 take 255
constexpr std::string_view kSize = "M";

// Texts in these files are ASCII; other letters are written as AutoCAD does, \U+524D, which readers either know or
// show as it stands.
std::string asciiText(std::string_view words) {
  std::string ascii;
  for (std::size_t i = 0; i < words.size() && ascii.size() + 7 <= kLongestText;) {
    const auto byte = static_cast<unsigned char>(words[i]);
    const std::size_t more = byte < 0xC0 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
    unsigned code = more == 0 ? byte : byte & (0x3Fu >> more);
    for (std::size_t k = 1; k <= more && i + k < words.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(words[i + k]) & 0x3Fu);
    const bool plain = byte >= ' ' && byte <= '~' && words.substr(i, 3) != "\\U+";
    i += 1 + more;
    if (plain) {
      ascii += static_cast<char>(byte);
    } else if (code < ' ' || code == 0x7F || code > 0xFFFF) {
      ascii += '_';  // four digits hold no more
    } else {
      constexpr std::string_view kDigits = "0123456789ABCDEF";
      ascii += "\\U+";
      for (const int shift : {12, 8, 4, 0}) ascii += kDigits[code >> shift & 15];
    }
  }
  return ascii;
}

// Of a block, in letters that every reader takes.
std::string asciiName(std::string_view name, DistinctNames& taken) {
  std::string ascii = edgeWord(name);
  if (ascii.empty()) ascii = "PIECE";
  ascii.resize(std::min(ascii.size(), kLongestName - 3));
  return taken.give(std::move(ascii));
}

// Closed, with its corners told from the points on its curves.
struct PlacedRing {
  std::vector<Flat> points;
  std::vector<char> turn;
};

// Where the cubics of a chain meet at a corner: these are turns too, else readers round them.
std::vector<char> kinksOf(const Curve& curve) {
  const std::vector<Curve> parts = curve.parts();
  std::vector<char> kinks(parts.size(), 1);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const Flat in = parts[k - 1].tangent(1), out = parts[k].tangent(0);
    kinks[k] = std::abs(angleFrom(in, out)) > kKink;
  }
  return kinks;
}

// `base`: the same outline in the base size, which tells for all sizes where a chain has corners.
PlacedRing drawn(const Outline& outline, const Outline& base) {
  PlacedRing all;
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const Curve& curve = outline.edges[e].curve;
    const std::vector<Flat> points = curve.flattened(kMiss);
    std::vector<char> kinks = kinksOf(curve);
    if (e < base.edges.size())
      if (std::vector<char> told = kinksOf(base.edges[e].curve); told.size() == kinks.size()) kinks = std::move(told);
    const std::size_t chords = points.size() - 1, each = chords / kinks.size();  // as many on each cubic
    for (std::size_t i = 0; i < chords; ++i)
      all.points.push_back(points[i]), all.turn.push_back(i % each == 0 && kinks[i / each]);
  }
  return all;
}

PlacedRing drawn(const Ring& ring) {
  PlacedRing all{ring, std::vector<char>(ring.size())};
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const Flat in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
    all.turn[i] = std::abs(angleFrom(in, out)) > kTurn;
  }
  return all;
}

class Writing {
 public:
  Writing(DxfDialect dialect, const Pattern& pattern) : astm_(dialect == DxfDialect::Astm) {
    DistinctNames taken, told;
    for (const auto& [id, piece] : pattern.pieces) {
      blockNames_[id] = asciiName(piece->name, taken), names_[id] = told.give(asciiText(piece->name));
      base_[id] = piece;
    }
    group(0, "SECTION"), group(2, "HEADER"), group(0, "ENDSEC"), group(0, "SECTION"), group(2, "BLOCKS");
  }

  // `rules`: those of its points, in the base size.
  void piece(const Pattern& pattern, const Piece& piece, const AllowancePlan* plan, const Allowances& finish,
             const Cutting& cutting, const std::string& size, const std::vector<NumberedRule>& rules) {
    const std::string block = blockNames_.at(piece.id) + "_" + size;
    const Piece& base = *base_.at(piece.id);
    const PlacedRing seam = drawn(piece.outline, base.outline);
    const auto cut = plan ? cutLines(piece, *plan, kMiss) : std::nullopt;
    const PlacedRing boundary = cut ? drawn(cut->outer) : seam;
    blocks_.push_back(block);
    group(0, "BLOCK"), group(8, "0"), group(2, block), group(70, "64"), place({0, 0});
    const Flat at = boundary.points.front();
    for (const std::string& words :
         {"Piece Name: " + names_.at(piece.id), "Size: " + size, "Quantity: " + quantity(cutting),
          "Annotation: " + asciiText(piece.name), std::string("Category: "), "Fabric: " + asciiText(piece.fabric)})
      text(1, at, words);
    line(1, boundary);
    points(boundary);
    if (astm_) line(84, boundary);
    if (cut) line(14, seam), points(seam);
    if (cut && astm_) line(87, seam);
    for (const NumberedRule& rule : rules)
      text(astm_ ? (cut ? 14 : 1) : rule.corner ? 2 : 3, rule.place, "# " + std::to_string(rule.number));
    // A cut-out is cut within its seam line by its allowance; one that this fills is only marked.
    const std::set<std::size_t> folded = foldedHoles(pattern, piece.id);
    for (std::size_t k = 0; k < piece.holes.size(); ++k) {
      const PlacedRing sewn = drawn(piece.holes[k], piece.holes[k]);
      const bool marked = cut || folded.contains(k);
      line(marked ? 14 : 11, sewn);
      if (astm_) line(marked ? 87 : 86, sewn);
    }
    for (const Ring& hole : cut ? cut->holes : std::vector<Ring>()) {
      line(11, drawn(hole));
      if (astm_) line(86, drawn(hole));
    }
    for (const NotchPlace& notch : notchPlaces(pattern))
      if (notch.piece == piece.id) notchAt(notch, plan ? plan->width(piece.id, notch.edge) : 0);
    for (const Flat drill : drillHoles(pattern, piece)) point(13, drill);
    fastenings(pattern, piece, finish, plan);
    grain(piece);
    for (const InternalLine& inner : piece.lines) {
      open(8, inner);
      if (astm_) open(85, inner);
    }
    for (const StitchRow& row : stitchRows(pattern, finish))
      if (row.piece == piece.id) polyline(kTopstitchLayer, row.points, false);
    group(0, "ENDBLK"), group(8, "0");
  }

  std::string finished(std::string_view style, const std::string& sample, bool ruled) {
    group(0, "ENDSEC"), group(0, "SECTION"), group(2, "ENTITIES");
    for (const std::string& words :
         {"Style Name: " + asciiText(style), std::string(astm_ ? "Author: KARINUI ; KARINUI ; 0.1" : "Author: KARINUI"),
          "Sample Size: " + sample, "Grade Rule Table: " + (ruled ? edgeWord(style) : std::string()),
          std::string("Units: METRIC")})
      text(1, {}, words);
    if (astm_)
      text(1, {}, "ASTM/D13Proposal 1 Version: D 6673-04"), text(1, {}, "Curve Tolerance: 0.05");
    else
      text(1, {}, "Product: KARINUI"), text(1, {}, "Version: 0.1"), text(1, {}, "Tolerance: 0.05");
    for (const std::string& block : blocks_) group(0, "INSERT"), group(8, "1"), group(2, block), place({0, 0});
    group(0, "ENDSEC"), group(0, "EOF");
    return std::move(out_);
  }

 private:
  // AAMA: how many; ASTM: right ones and left ones.
  std::string quantity(const Cutting& cutting) const {
    if (!astm_) return std::to_string(cutting.count);
    const int left = cutting.pairs ? cutting.count / 2 : 0;
    return std::to_string(cutting.count - left) + "," + std::to_string(left);
  }
  void group(int code, std::string_view value) {
    out_.append(std::to_string(code)).append("\r\n").append(value).append("\r\n");
  }
  void group(int code, double value) { group(code, fixed(value, 4)); }
  void place(Flat p, int code = 10) { group(code, p.u * 1e3), group(code + 10, p.v * 1e3); }
  void text(int layer, Flat at, const std::string& words) {
    group(0, "TEXT"), group(8, std::to_string(layer)), place(at), group(40, "5"), group(1, words);
  }
  void point(int layer, Flat at) { group(0, "POINT"), group(8, std::to_string(layer)), place(at); }
  void polyline(int layer, const std::vector<Flat>& points, bool closed) {
    const std::string on = std::to_string(layer);
    group(0, "POLYLINE"), group(8, on), group(66, "1"), group(70, closed ? "1" : "0");
    for (const Flat p : points) group(0, "VERTEX"), group(8, on), place(p);
    group(0, "SEQEND"), group(8, on);
  }
  void points(const PlacedRing& ring) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) point(ring.turn[i] ? 2 : 3, ring.points[i]);
  }
  void line(int layer, const PlacedRing& ring) { polyline(layer, ring.points, true); }
  void open(int layer, const InternalLine& inner) {
    std::vector<Flat> points;
    for (const Curve& curve : inner.curves)
      for (const Flat p : curve.flattened(kMiss))
        if (points.empty() || distance(points.back(), p) > 1e-6) points.push_back(p);
    if (points.size() >= 2) polyline(layer, points, false);
  }
  void notchAt(const NotchPlace& notch, double allowance) {
    point(4, notch.place + allowance * notch.outward);
    group(30, kNotchDepth);
    const Flat inward = -1 * notch.outward;
    group(50, std::atan2(inward.v, inward.u) * 180 / std::numbers::pi);
  }
  // Where buttons, snaps, hooks and ties are set: drill holes, each with what comes there; the ends of zips: notches.
  void fastenings(const Pattern& pattern, const Piece& piece, const Allowances& finish, const AllowancePlan* plan) {
    for (const NotchPlace& notch : finishNotches(pattern, finish))
      if (notch.piece == piece.id) notchAt(notch, plan ? plan->width(piece.id, notch.edge) : 0);
    for (const auto& [name, own] : finish.fastenings) {
      if (own.kind == FasteningKind::Zip) continue;
      std::size_t number = 0;
      for (const FastenedPlaces& pair : placesOf(pattern, own)) {
        ++number;
        for (const bool over : {true, false}) {
          const FasteningPlace& at = over ? pair.a : pair.b;
          if (at.piece != piece.id) continue;
          point(13, at.place);
          text(15, at.place, asciiText(std::string(what(own.kind, over)) + " " + name + " " + std::to_string(number)));
        }
      }
    }
  }
  static std::string_view what(FasteningKind kind, bool over) {
    switch (kind) {
      case FasteningKind::Snap:
        return "snap";
      case FasteningKind::Hook:
        return over ? "hook" : "eye";
      case FasteningKind::Tie:
        return "tie";
      default:
        return over ? "buttonhole" : "button";
    }
  }
  // As long as half the piece, through the middle of its outline's box.
  void grain(const Piece& piece) {
    const auto [low, high] = boxOf(piece.outline.flattened());
    const Flat middle = 0.5 * (low + high), half = (0.25 * distance(low, high)) * piece.grain;
    group(0, "LINE"), group(8, "7"), place(middle - half), place(middle + half, 11);
  }

  bool astm_;
  std::string out_;
  std::map<PieceId, std::string> names_, blockNames_;
  std::map<PieceId, std::shared_ptr<const Piece>> base_;
  std::vector<std::string> blocks_;
};

}  // namespace

Result<std::string> writeDxf(const Pattern& pattern, DxfDialect dialect, const SheetSettings& settings) {
  if (pattern.pieces.empty()) return refused(say("There is no piece to print."));
  const Grading& grading = settings.grading;
  const bool graded = !grading.pieces.empty();
  RuleBook book;
  if (graded) {
    auto rules = ruleBook(pattern, grading);
    if (!rules) return rules.error();
    book = *std::move(rules);
  }
  Writing writing(dialect, pattern);
  const std::vector<std::string> sizes = graded ? asciiSizes(grading.sizes) : std::vector{std::string(kSize)};
  // Block by block as readers list them: each piece in all its sizes.
  std::vector<Pattern> patterns;
  std::vector<std::optional<AllowancePlan>> plans;
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    auto one = graded ? patternInSize(pattern, grading, size) : Result<Pattern>(pattern);
    if (!one) return one.error();
    const auto allowances = allowancesOn(*one, settings);
    if (!allowances) return allowances.error();
    patterns.push_back(*std::move(one)), plans.push_back(*allowances);
  }
  for (const auto& [id, piece] : pattern.pieces)
    for (std::size_t size = 0; size < sizes.size(); ++size)
      writing.piece(patterns[size], *patterns[size].pieces.at(id), plans[size] ? &*plans[size] : nullptr,
                    settings.allowances, settings.cutting.contains(id) ? settings.cutting.at(id) : Cutting(),
                    sizes[size], graded && size == grading.base ? book.places[id] : std::vector<NumberedRule>());
  return writing.finished(settings.title, sizes[graded ? grading.base : 0], graded);
}

}  // namespace karinui
