// Reading our own sheets back. Only what the data attributes name is read; styles, words and strokes are decoration.
#include <charconv>
#include <optional>
#include <set>

#include "fabric_values.h"
#include "karinui/base/number.h"
#include "names.h"
#include "sheet.h"
#include "strict_json.h"
#include "xml.h"

namespace karinui {
namespace {

std::vector<std::string_view> parts(std::string_view text, char by = ' ') {
  std::vector<std::string_view> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(by), text.size());
    if (end > 0) out.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::optional<Flat> pairOf(const std::string* text) {
  if (!text) return std::nullopt;
  const auto numbers = parts(*text);
  if (numbers.size() != 2) return std::nullopt;
  const auto u = parseNumber(numbers[0]), v = parseNumber(numbers[1]);
  return u && v ? std::optional<Flat>({*u, *v}) : std::nullopt;
}

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || stop != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

// The curves of a path of M, L, C and A commands with absolute coordinates, on paper.
std::optional<std::vector<Curve>> curvesOf(const std::string* d, Flat origin) {
  if (!d) return std::nullopt;
  const auto words = parts(*d);
  std::size_t i = 0;
  bool good = true;
  const auto number = [&] {
    const auto value = i < words.size() ? parseNumber(words[i++]) : std::nullopt;
    if (!value || std::abs(*value) > 1e6) good = false;
    return value.value_or(0);
  };
  const auto place = [&]() -> Flat {
    const double x = number(), y = number();
    return {(x - origin.u) / 1000, (origin.v - y) / 1000};
  };
  std::vector<Curve> out;
  std::optional<Flat> at;
  while (good && i < words.size()) {
    const std::string_view command = words[i++];
    if (command == "M") {
      at = place();
      continue;
    }
    if (!at) return std::nullopt;
    if (command == "L") {
      out.push_back(Curve::line(*at, place()));
    } else if (command == "C") {
      const Flat c1 = place(), c2 = place();
      out.push_back(Curve::cubic(*at, c1, c2, place()));
    } else if (command == "A") {
      const double radius = number() / 1000;
      number(), number();  // equal radii need no turn
      const bool large = number() != 0, sweep = number() != 0;
      const Flat end = place();
      if (radius <= 0) return std::nullopt;
      const double half = std::asin(std::min(1.0, distance(*at, end) / (2 * radius)));
      const double quarter = large ? std::acos(-1.0) / 2 - half / 2 : half / 2;
      out.push_back(Curve::arc(*at, end, std::tan(quarter) * (sweep ? -1 : 1)));
    } else {
      return std::nullopt;
    }
    at = out.back().end;
  }
  if (!good) return std::nullopt;
  return out;
}

std::optional<std::vector<EdgeSpan>> spansOf(const std::string* text, const Pattern& pattern) {
  if (!text) return std::nullopt;
  std::vector<EdgeSpan> out;
  for (const std::string_view word : parts(*text)) {
    const std::size_t dot = word.find('.'), sign = word.find('@'), dots = word.find("..", std::min(sign, word.size()));
    if (dot == std::string_view::npos || sign == std::string_view::npos || dots == std::string_view::npos || dot > sign)
      return std::nullopt;
    const auto id = wholeNumber(word.substr(0, dot));
    const auto from = parseNumber(word.substr(sign + 1, dots - sign - 1)), to = parseNumber(word.substr(dots + 2));
    if (!id || !from || !to || !(0 <= *from && *from < *to && *to <= 1)) return std::nullopt;
    out.push_back({{*id}, std::string(word.substr(dot + 1, sign - dot - 1)), *from, *to});
    const auto piece = pattern.pieces.find(out.back().piece);
    if (piece == pattern.pieces.end() || !findCurve(*piece->second, out.back().edge)) return std::nullopt;
  }
  return out.empty() ? std::nullopt : std::optional(out);
}

class SheetReader {
 public:
  Allowances told;
  std::map<std::string, Fabric> fabrics;

  Result<Pattern> read(const std::vector<XmlElement>& elements) {
    for (const XmlElement& element : elements) {
      const std::string* kind = element.find("class");
      if (open_ && element.depth <= depth_)
        if (auto done = close(); !done) return done.error();
      if (!kind) continue;
      if (element.name == "g" && *kind == "piece") {
        if (auto begun = begin(element); !begun) return begun.error();
      } else if (open_) {
        if (auto taken = take(element, *kind); !taken) return taken.error();
      }
    }
    if (open_)
      if (auto done = close(); !done) return done.error();
    if (out_.pieces.empty()) return badInput(say("The drawing has no pieces."));
    for (const XmlElement& element : elements) {
      const std::string* kind = element.find("class");
      if (element.name != "metadata" || !kind) continue;
      if (*kind == "sewing")
        if (auto sewn = sew(element); !sewn) return sewn.error();
      if (*kind == "fabric")
        if (auto known = fabric(element); !known) return known.error();
    }
    return std::move(out_);
  }

 private:
  Error wrong(const Message& part) const {
    return badInput(say("Piece \"{0}\" of the drawing: {1} cannot be read.", shown(piece_.name), part));
  }
  Done begin(const XmlElement& element) {
    piece_ = {};
    open_ = true;
    depth_ = element.depth;
    const std::string *name = element.find("data-piece"), *id = element.find("data-id"),
                      *fabric = element.find("data-fabric");
    const std::string* layer = element.find("data-layer");
    if (name) piece_.name = *name;
    const auto number = id ? wholeNumber(*id) : std::nullopt;
    const auto grain = pairOf(element.find("data-grain")), origin = pairOf(element.find("data-origin"));
    const auto height = layer ? parseNumber(*layer) : 0.0;
    if (!name || name->empty() || !number || *number == 0 || !grain || std::abs(length(*grain) - 1) > 1e-6 || !origin ||
        !fabric || !height || std::abs(*height) > 1000)
      return wrong(say("what is said of it"));
    if (!names_.insert(*name).second || out_.pieces.contains({*number}))
      return badInput(say("There are two pieces \"{0}\".", shown(*name)));
    piece_.id = {*number};
    piece_.fabric = *fabric;
    piece_.grain = *grain;
    piece_.layer = static_cast<int>(*height);
    origin_ = *origin;
    return {};
  }
  Done take(const XmlElement& element, const std::string& kind) {
    const std::string *edge = element.find("data-edge"), *line = element.find("data-line"),
                      *mark = element.find("data-mark");
    if (kind == "seam" || kind == "seam only" || kind == "hole") {
      auto curves = curvesOf(element.find("d"), origin_);
      if (!edge || edgeWord(*edge) != *edge || edge->empty() || !curves || curves->empty())
        return wrong(say("an edge"));
      Outline* ring = &piece_.outline;
      if (kind == "hole") {
        const std::string* index = element.find("data-hole");
        const auto number = index ? wholeNumber(*index) : std::nullopt;
        if (!number || *number > piece_.holes.size()) return wrong(say("a hole"));
        piece_.holes.resize(std::max<std::size_t>(piece_.holes.size(), *number + 1));
        ring = &piece_.holes[*number];
      }
      ring->edges.push_back({*edge, Curve::joined(*curves)});
      if (const std::string* width = element.find("data-allowance")) {
        const auto millimetres = parseNumber(*width);
        if (!millimetres || !(*millimetres >= 0) || *millimetres > kWidestAllowance * 1000)
          return wrong(say("an edge"));
        told.edges[{piece_.id, *edge}] = *millimetres / 1000;
      }
    } else if (kind == "internal") {
      auto curves = curvesOf(element.find("d"), origin_);
      if (!line || !curves) return wrong(say("an internal line"));
      piece_.lines.push_back({*line, *std::move(curves), {}});
    } else if (kind == "mark") {
      const std::string* fraction = element.find("data-fraction");
      const auto share = fraction ? parseNumber(*fraction) : std::nullopt;
      const auto place = pairOf(element.find("data-place"));
      if (!mark || (edge ? !share || *share < 0 || *share > 1 : !place)) return wrong(say("a mark"));
      piece_.marks.push_back({*mark, edge ? *edge : "", edge ? *share : 0, edge ? Flat{} : *place});
    }
    return {};
  }
  Done close() {
    open_ = false;
    const auto whole = [&](Outline& ring) -> Done {
      Result<Outline> good = checked(std::move(ring));
      if (!good) return badInput(say("{0}: {1}", "\"" + shown(piece_.name) + "\"", good.error().what));
      ring = *std::move(good);
      return {};
    };
    if (auto good = whole(piece_.outline); !good) return good;
    for (Outline& hole : piece_.holes)
      if (auto good = whole(hole); !good) return good;
    for (const Mark& mark : piece_.marks)
      if (!mark.edge.empty() && !findEdge(piece_, mark.edge)) return wrong(say("a mark"));
    const PieceId id = piece_.id;
    out_.pieces[id] = std::make_shared<const Piece>(std::move(piece_));
    return {};
  }
  Done fabric(const XmlElement& element) {
    Fabric out;
    const std::string *name = element.find("data-name"), *law = element.find("data-law");
    bool good = name && !name->empty() && law && lawNamed(*law, out.law);
    eachFabricValue(out, [&](const char* key, double& value) {
      const std::string* words = element.find(std::string("data-") + key);
      const auto number = words ? parseNumber(*words) : std::nullopt;
      good = good && number;
      value = number.value_or(0);
    });
    if (name) out.name = *name;
    if (!good || !checkFabric(out))
      return badInput(say("A fabric of the drawing cannot be read: {0}.", shown(name ? *name : std::string("?"))));
    fabrics[out.name] = std::move(out);
    return {};
  }
  Done sew(const XmlElement& element) {
    const std::string *name = element.find("data-seam"), *id = element.find("data-id"), *tie = element.find("data-tie");
    const std::string* reversed = element.find("data-reversed");
    const auto number = id ? wholeNumber(*id) : std::nullopt;
    const auto a = spansOf(element.find("data-a"), out_), b = spansOf(element.find("data-b"), out_);
    const auto kind = tie ? tieNamed(*tie) : std::nullopt;
    if (!name || !number || *number == 0 || !a || !b || !kind || !reversed || out_.seams.contains({*number}))
      return badInput(say("A seam of the drawing cannot be read: {0}.", shown(name ? *name : std::string("?"))));
    out_.seams[{*number}] = {{*number}, *name, *a, *b, *reversed == "1", *kind};
    return {};
  }

  Pattern out_;
  Piece piece_;
  Flat origin_;
  std::set<std::string> names_;
  bool open_ = false;
  std::size_t depth_ = 0;
};

}  // namespace

Result<Pattern> readSvg(std::string_view svg, Allowances* allowances, std::map<std::string, Fabric>* fabrics) {
  const auto elements = parseXml(svg);
  if (!elements) return elements.error();
  const std::string* format = elements->front().find("data-format");
  if (elements->front().name != "svg" || !format || *format != "karinui-sheet-1")
    return badInput(say("This drawing was not written by Karinui; only its own sheets can be read back."));
  SheetReader reader;
  auto read = reader.read(*elements);
  if (read && fabrics) *fabrics = std::move(reader.fabrics);
  if (read && allowances) *allowances = ownWidths(*read, std::move(reader.told));
  return read;
}

}  // namespace karinui
