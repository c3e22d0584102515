#include <algorithm>
#include <optional>
#include <set>

#include "fabric_values.h"
#include "karinui/exchange/pattern_json.h"
#include "names.h"
#include "sheet.h"
#include "strict_json.h"

namespace karinui {
namespace {

constexpr std::size_t kMostPieces = 2000, kMostPoints = 5'000'000;

// What went wrong, kept by the first reader that meets it; the readers of values then return defaults.
class Reader {
 public:
  std::optional<Error> error;
  Allowances told;

  void refuse(Message what) {
    if (!error) error = badInput(std::move(what));
  }
  void refuse(std::string_view key) {
    refuse(say("{0}: \"{1}\" is missing or of the wrong kind.", where_.empty() ? say("The pattern") : where_, key));
  }
  void at(Message where) { where_ = std::move(where); }

  const Json& list(const Json& of, const char* key, bool required = true) {
    static const Json kEmpty = Json::array();
    const Json* value = member(of, key);
    if (value && value->is_array()) return *value;
    if (required || value) refuse(key);
    return kEmpty;
  }
  std::string text(const Json& of, const char* key) {
    const Json* value = member(of, key);
    if (value && value->is_string()) return value->get<std::string>();
    refuse(key);
    return {};
  }
  double number(const Json& of, const char* key) {
    const Json* value = member(of, key);
    if (value && isFinite(*value)) return value->get<double>();
    refuse(key);
    return 0;
  }
  std::uint64_t id(const Json& of, const char* key, bool required = true) {
    const Json* value = member(of, key);
    if (value && value->is_number_unsigned()) return value->get<std::uint64_t>();
    if (required || value) refuse(key);
    return 0;
  }
  bool flag(const Json& of, const char* key, bool otherwise) {
    const Json* value = member(of, key);
    if (value && value->is_boolean()) return value->get<bool>();
    if (value) refuse(key);
    return otherwise;
  }
  Flat flat(const Json& value, const char* key) {
    if (isPoint(value, 2)) return flatOf(value);
    refuse(key);
    return {};
  }
  Flat flatAt(const Json& of, const char* key) {
    const Json* value = member(of, key);
    return flat(value ? *value : Json{}, key);
  }

  Curve curve(const Json& json) {
    const std::string kind = text(json, "kind");
    Curve out = Curve::line(flatAt(json, "start"), flatAt(json, "end"));
    if (kind == "cubic") {
      const Json& controls = list(json, "controls");
      if (controls.size() % 3 != 2 || controls.size() > kMostPoints) return refuse("controls"), out;
      std::vector<Flat> between;
      for (const Json& place : controls) between.push_back(flat(place, "controls"));
      out = Curve::cubic(out.start, between.front(), between.back(), out.end);
      out.between.assign(between.begin() + 1, between.end() - 1);
      return out;
    }
    if (kind == "arc") return Curve::arc(out.start, out.end, number(json, "bulge"));
    if (kind != "line") refuse("kind");
    return out;
  }
  Outline outline(const Json& edges) {
    Outline out;
    for (const Json& edge : edges) {
      out.edges.push_back({text(edge, "name"), curve(edge)});
      if (edgeWord(out.edges.back().name) != out.edges.back().name) refuse("name");
    }
    if (error) return {};
    Result<Outline> whole = checked(std::move(out));
    if (whole) return *std::move(whole);
    refuse(say("{0}: {1}", where_, whole.error().what));
    return {};
  }
  std::shared_ptr<const Form> form(const Json& json) {
    Form out;
    const Json &flats = list(json, "flat"), &space = list(json, "space"), &faces = list(json, "faces");
    if (flats.size() != space.size() || flats.size() > kMostPoints) return refuse("form"), nullptr;
    for (const Json& p : flats) out.flat.push_back(flat(p, "flat"));
    for (const Json& p : space) {
      if (!isPoint(p, 3)) return refuse("space"), nullptr;
      out.space.push_back(vec3Of(p));
    }
    for (const Json& face : faces) {
      if (!isPoint(face, 3)) return refuse("faces"), nullptr;
      Triangle corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!face[k].is_number_unsigned() || face[k].get<std::uint64_t>() >= out.flat.size())
          return refuse("faces"), nullptr;
        corners[k] = face[k].get<std::uint32_t>();
      }
      out.faces.push_back(corners);
    }
    return std::make_shared<const Form>(std::move(out));
  }
  Rigid pose(const Json& json) {
    const Json* turn = member(json, "turn");
    const Json* carry = member(json, "carry");
    if (!turn || !isPoint(*turn, 4) || !carry || !isPoint(*carry, 3)) return refuse("pose"), Rigid{};
    const auto q = [&](std::size_t k) { return (*turn)[k].get<double>(); };
    if (std::abs(q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3) - 1) > 1e-6) refuse("turn");
    return {q(0), q(1), q(2), q(3), vec3Of(*carry)};
  }

  Piece piece(const Json& json) {
    Piece out;
    out.id = {id(json, "id")};
    out.name = text(json, "name");
    where_ = say("Piece \"{0}\"", shown(out.name));
    if (!out.id) refuse("id");
    if (out.name.empty() || cleanText(out.name) != out.name) refuse("name");
    out.fabric = text(json, "fabric");
    const double layer = number(json, "layer");
    if (layer != std::floor(layer) || std::abs(layer) > 1000) refuse("layer");
    out.layer = static_cast<int>(std::clamp(layer, -1000.0, 1000.0));
    out.frozen = flag(json, "frozen", false);
    out.mirrorOf = {id(json, "mirror_of", false)};
    out.grain = flatAt(json, "grain");
    if (std::abs(length(out.grain) - 1) > 1e-6) refuse("grain");
    if (const Json* placed = member(json, "pose")) out.pose = pose(*placed);
    out.outline = outline(list(json, "outline"));
    for (const Json& hole : list(json, "holes", false)) out.holes.push_back(outline(hole));
    for (const Json& line : list(json, "lines", false)) {
      out.lines.push_back({text(line, "name"), {}, {}});
      for (const Json& part : list(line, "curves")) out.lines.back().curves.push_back(curve(part));
    }
    for (const Json& mark : list(json, "marks", false)) {
      const bool notch = member(mark, "edge") != nullptr;
      out.marks.push_back({text(mark, "name"), notch ? text(mark, "edge") : "", notch ? number(mark, "fraction") : 0,
                           notch ? Flat{} : flatAt(mark, "place")});
      const Mark& read = out.marks.back();
      if (notch && (!findEdge(out, read.edge) || read.fraction < 0 || read.fraction > 1)) refuse("marks");
    }
    if (const Json* shape = member(json, "form")) out.form = form(*shape);
    if (const Json* widths = member(json, "allowances")) allowances(*widths, out);
    return out;
  }
  void allowances(const Json& widths, const Piece& piece) {
    if (!widths.is_object()) return refuse("allowances");
    for (const auto& [edge, width] : widths.items()) {
      if (!findEdge(piece, edge) || !isFinite(width) || width < 0 || width > kWidestAllowance)
        return refuse("allowances");
      told.edges[{piece.id, edge}] = width.get<double>();
    }
  }

  Fabric fabric(const Json& json) {
    Fabric out;
    out.name = text(json, "name");
    where_ = say("Fabric \"{0}\"", shown(out.name));
    if (out.name.empty() || cleanText(out.name) != out.name) refuse("name");
    if (!lawNamed(text(json, "law"), out.law)) refuse("law");
    eachFabricValue(out, [&](const char* name, double& value) { value = number(json, name); });
    if (const auto sane = checkFabric(out); !sane && !error) refuse(say("{0}: {1}", where_, sane.error().what));
    return out;
  }

  std::vector<EdgeSpan> side(const Json& spans, const Pattern& pattern) {
    std::vector<EdgeSpan> out;
    if (spans.empty()) refuse("a, b");
    for (const Json& span : spans) {
      out.push_back({{id(span, "piece")}, text(span, "edge"), number(span, "from"), number(span, "to")});
      const EdgeSpan& read = out.back();
      const auto on = pattern.pieces.find(read.piece);
      if (on == pattern.pieces.end() || !findCurve(*on->second, read.edge)) refuse("edge");
      if (!(0 <= read.from && read.from < read.to && read.to <= 1)) refuse("from, to");
    }
    return out;
  }
  Seam seam(const Json& json, const Pattern& pattern) {
    Seam out;
    out.id = {id(json, "id")};
    out.name = text(json, "name");
    where_ = say("Seam \"{0}\"", shown(out.name));
    if (!out.id) refuse("id");
    out.a = side(list(json, "a"), pattern);
    out.b = side(list(json, "b"), pattern);
    out.reversed = flag(json, "reversed", true);
    if (const auto tie = tieNamed(text(json, "tie")))
      out.tie = *tie;
    else
      refuse("tie");
    return out;
  }

 private:
  Message where_;  // empty: the pattern itself
};

}  // namespace

Result<Pattern> readPatternJson(std::string_view json, Allowances* allowances, std::map<std::string, Fabric>* fabrics) {
  const Result<Json> root = parseStrictJson(json);
  if (!root) return root.error();
  const Json* format = member(*root, "format");
  if (!format || *format != "karinui-pattern-1")
    return badInput(say("This is not a pattern of Karinui: its format is not karinui-pattern-1."));
  Reader reader;
  Pattern out;
  std::set<std::string> names;
  const Json& pieces = reader.list(*root, "pieces");
  if (pieces.size() > kMostPieces) return badInput(say("There are more than {0} panels.", kMostPieces));
  for (const Json& json_ : pieces) {
    reader.at({});
    Piece piece = reader.piece(json_);
    if (!names.insert(piece.name).second || out.pieces.contains(piece.id))
      reader.refuse(say("There are two pieces \"{0}\".", shown(piece.name)));
    if (reader.error) return *reader.error;
    out.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));
  }
  for (const Json& json_ : reader.list(*root, "seams")) {
    reader.at({});
    Seam seam = reader.seam(json_, out);
    if (out.seams.contains(seam.id)) reader.refuse("id");
    if (reader.error) return *reader.error;
    out.seams[seam.id] = std::move(seam);
  }
  const Json& cloths = reader.list(*root, "fabrics", false);
  if (cloths.size() > kMostPieces) return badInput(say("There are more than {0} fabrics.", kMostPieces));
  for (const Json& json_ : cloths) {
    reader.at({});
    Fabric fabric = reader.fabric(json_);
    if (reader.error) return *reader.error;
    if (fabrics) (*fabrics)[fabric.name] = std::move(fabric);
  }
  if (reader.error) return *reader.error;
  if (allowances) *allowances = ownWidths(out, std::move(reader.told));
  return out;
}

}  // namespace karinui
