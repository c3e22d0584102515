// Reading GarmentCode specifications. The meaning of every field was checked against the program's own public sources:
// a panel's place is Rz(c) Ry(b) Rx(a) (p, 0) + translation for rotation [a, b, c]; an arc's last number is SVG's sweep
// with y upwards; stitched edges meet end to start unless the stitch says "right_wrong".
#include <numbers>
#include <optional>

#include "karinui/base/number.h"
#include "karinui/exchange/garment_code.h"
#include "names.h"
#include "strict_json.h"

namespace karinui {
namespace {

constexpr std::size_t kMostPanels = 2000, kMostEdges = 60000;
constexpr double kLongestPanel = 12;  // metres: no panel is longer, so the file's unit is another one

struct Panel {
  std::string name;
  Piece piece;
  std::vector<std::string> edgeNames;  // in the file's order; empty: that edge is not there
};

Rigid placeOf(Vec3 degrees, Vec3 carry) {
  Rigid pose = after(turnAbout({0, 0, 1}, degrees.z * kDegree),
                     after(turnAbout({0, 1, 0}, degrees.y * kDegree), turnAbout({1, 0, 0}, degrees.x * kDegree)));
  pose.carry = carry;
  return pose;
}

// tan(quarter of the turned angle) of an arc as SVG has it; a radius too short for its chord is stretched to it.
double bulgeOf(double chord, double radius, bool largeArc, bool sweep) {
  const double half = std::asin(std::min(1.0, chord / (2 * radius)));
  const double quarter = largeArc ? (std::numbers::pi - half) / 2 : half / 2;
  return std::tan(quarter) * (sweep ? 1 : -1);
}

class EdgeReader {
 public:
  EdgeReader(const std::string& panel, const std::vector<Flat>& points, double metres, bool relative)
      : panel_(panel), points_(points), metres_(metres), relative_(relative) {}

  Result<Curve> read(const Json& edge, std::size_t index) const {
    const Json* ends = member(edge, "endpoints");
    const auto pointAt = [&](std::size_t k) { return endpoint((*ends)[k]); };
    if (!ends || !ends->is_array() || ends->size() != 2 || !pointAt(0) || !pointAt(1))
      return wrong(index, say("its endpoints must be two numbers of vertices"));
    const Flat start = points_[*pointAt(0)], end = points_[*pointAt(1)];
    if (distance(start, end) < 1e-9) return wrong(index, say("it begins and ends at the same place"));
    const Json* bend = member(edge, "curvature");
    if (!bend || bend->is_null()) return Curve::line(start, end);
    if (isPoint(*bend, 2)) return quadratic(start, control(start, end, *bend), end);
    const Json* type = member(*bend, "type");
    const Json* params = member(*bend, "params");
    if (!type || !type->is_string() || !params || !params->is_array())
      return wrong(index, say("its curvature must have a type and params"));
    const auto& kind = type->get_ref<const std::string&>();
    if (kind == "circle") return circle(*params, start, end, index);
    const std::size_t controls = kind == "quadratic" ? 1 : kind == "cubic" ? 2 : 0;
    if (controls == 0) return wrong(index, say("its curvature is of a kind this program does not know"));
    if (params->size() != controls) return wrong(index, say("it has too few or too many control points"));
    for (const Json& point : *params)
      if (!isPoint(point, 2)) return wrong(index, say("its control points must be pairs of finite numbers"));
    if (controls == 1) return quadratic(start, control(start, end, (*params)[0]), end);
    return Curve::cubic(start, control(start, end, (*params)[0]), control(start, end, (*params)[1]), end);
  }

  std::optional<std::size_t> endpoint(const Json& number) const {
    if (!number.is_number_integer()) return std::nullopt;
    const auto index = number.get<long long>();
    if (index < 0 || static_cast<std::size_t>(index) >= points_.size()) return std::nullopt;
    return static_cast<std::size_t>(index);
  }

  Error wrong(std::size_t index, const Message& why) const {
    return badInput(say("Panel \"{0}\", edge {1}: {2}.", shown(panel_), index, why));
  }

 private:
  Flat control(Flat start, Flat end, const Json& pair) const {
    const Flat given = flatOf(pair), along = end - start;
    return relative_ ? start + along * given.u + leftOf(along) * given.v : given * metres_;
  }
  // The same curve, one degree higher.
  static Curve quadratic(Flat start, Flat middle, Flat end) {
    return Curve::cubic(start, start + (middle - start) * (2.0 / 3), end + (middle - end) * (2.0 / 3), end);
  }
  Result<Curve> circle(const Json& params, Flat start, Flat end, std::size_t index) const {
    const auto flag = [&](std::size_t k) { return params[k].is_boolean() || params[k].is_number_integer(); };
    if (params.size() != 3 || !isFinite(params[0]) || params[0].get<double>() <= 0 || !flag(1) || !flag(2))
      return wrong(index, say("a circle needs a radius and two flags"));
    const auto set = [&](std::size_t k) {
      return params[k].is_boolean() ? params[k].get<bool>() : params[k].get<long long>() != 0;
    };
    return Curve::arc(start, end, bulgeOf(distance(start, end), params[0].get<double>() * metres_, set(1), set(2)));
  }

  const std::string& panel_;
  const std::vector<Flat>& points_;
  double metres_;
  bool relative_;
};

Result<std::vector<Flat>> readVertices(const std::string& name, const Json& panel, double metres) {
  const Json* vertices = member(panel, "vertices");
  if (!vertices || !vertices->is_array()) return badInput(say("Panel \"{0}\" has no list of vertices.", shown(name)));
  if (vertices->size() > kMostEdges)
    return badInput(say("Panel \"{0}\" has more than {1} vertices.", shown(name), kMostEdges));
  std::vector<Flat> points;
  for (const Json& vertex : *vertices) {
    if (!isPoint(vertex, 2))
      return badInput(
          say("Panel \"{0}\", vertex {1}: a vertex is a pair of finite numbers.", shown(name), points.size()));
    points.push_back(flatOf(vertex) * metres);
  }
  return points;
}

// Turned over about the vertical: what was at (u, v) is at (-u, v), seen from the other side.
Outline turnedOver(const Outline& outline) {
  Outline out = outline;
  for (Edge& edge : out.edges) edge.curve = edge.curve.mirrored({}, {0, 1});
  return out;
}

Result<Panel> readPanel(const std::string& name, const Json& json, double metres, bool relative) {
  Panel panel{name, {}, {}};
  Result<std::vector<Flat>> points = readVertices(name, json, metres);
  if (!points) return points.error();
  const Json* edges = member(json, "edges");
  if (!edges || !edges->is_array() || edges->empty())
    return badInput(say("Panel \"{0}\" has no list of edges.", shown(name)));
  if (edges->size() > kMostEdges)
    return badInput(say("Panel \"{0}\" has more than {1} edges.", shown(name), kMostEdges));
  const EdgeReader reader(name, *points, metres, relative);
  DistinctNames taken;
  for (std::size_t i = 0; i < edges->size(); ++i) {
    const Json& edge = (*edges)[i];
    Result<Curve> curve = reader.read(edge, i);
    if (!curve) return curve.error();
    if (i > 0 && panel.piece.outline.edges.back().curve.end != curve->start)
      return reader.wrong(i, say("it does not begin where the edge before it ends"));
    const Json* label = member(edge, "name");  // as we write it ourselves
    if (!label) label = member(edge, "label");
    std::string word = label && label->is_string() ? edgeWord(label->get_ref<const std::string&>()) : std::string{};
    if (word.empty()) word = "edge_" + std::to_string(i);
    panel.edgeNames.push_back(taken.give(std::move(word)));
    panel.piece.outline.edges.push_back({panel.edgeNames.back(), *std::move(curve)});
  }
  auto& outline = panel.piece.outline;
  if (outline.edges.back().curve.end != outline.edges.front().curve.start)
    return badInput(
        say("Panel \"{0}\" is not closed: its last edge does not end where its first begins.", shown(name)));

  Vec3 carry, turn;
  const auto read3 = [&](const char* key, Vec3& out) {
    const Json* value = member(json, key);
    if (value && !isPoint(*value, 3)) return false;
    if (value) out = vec3Of(*value);
    return true;
  };
  if (!read3("translation", carry) || !read3("rotation", turn))
    return badInput(say("Panel \"{0}\": translation and rotation are three finite numbers each.", shown(name)));
  panel.piece.pose = placeOf(turn, carry * metres);
  if (outline.area() < 0) {
    outline = turnedOver(outline);
    panel.piece.pose = after(panel.piece.pose, Rigid{0, 0, 1, 0, {}});  // half a turn about the vertical
  }
  Result<Outline> whole = checked(outline);
  if (!whole) return badInput(say("Panel \"{0}\": {1}", shown(name), whole.error().what));
  outline = *std::move(whole);
  panel.piece.name = cleanText(name).empty() ? "panel" : cleanText(name);
  return panel;
}

// The panels' names in the order in which they become pieces.
Result<std::vector<std::string>> panelNames(const Json& pattern, const Json& panels) {
  std::vector<std::string> names;
  std::set<std::string> listed;
  if (const Json* order = member(pattern, "panel_order"); order && order->is_array())
    for (const Json& name : *order) {
      if (!name.is_string()) return badInput(say("The panel_order must be a list of the panels' names."));
      if (!panels.contains(name.get_ref<const std::string&>()))
        return badInput(
            say("The panel_order names the panel \"{0}\", which is not there.", shown(name.get<std::string>())));
      if (listed.insert(name.get<std::string>()).second) names.push_back(name.get<std::string>());
    }
  std::set<std::string> rest;
  for (const auto& [name, panel] : panels.items())
    if (!listed.contains(name)) rest.insert(name);
  names.insert(names.end(), rest.begin(), rest.end());
  return names;
}

class StitchReader {
 public:
  StitchReader(const std::vector<Panel>& panels, const Pattern& pattern) : panels_(panels), pattern_(pattern) {}

  // `trusted`: the file is known to keep the rule of the right sides.
  Result<std::vector<Seam>> read(const Json& stitches, bool trusted) const {
    if (!stitches.is_array()) return badInput(say("The stitches must be a list."));
    if (stitches.size() > kMostEdges) return badInput(say("There are more than {0} stitches.", kMostEdges));
    std::vector<Seam> seams;
    std::vector<bool> told;  // the stitch itself says that it does not follow the rule
    for (const Json& stitch : stitches) {
      const std::size_t index = seams.size();
      if (!stitch.is_array() || stitch.size() < 2 || stitch.size() > 3)
        return badInput(say("Stitch {0}: it must join two edges.", index));
      Seam seam;
      const auto a = side(stitch[0], index), b = side(stitch[1], index);
      if (!a) return a.error();
      if (!b) return b.error();
      if (*a == *b) return badInput(say("Stitch {0} joins an edge to itself.", index));
      seam.id = madeBy<SeamId>(1, static_cast<std::uint32_t>(index));
      seam.name = "seam_" + std::to_string(index);
      seam.a = {*a};
      seam.b = {*b};
      told.push_back(stitch.size() == 3 && stitch[2].is_string() &&
                     stitch[2].get_ref<const std::string&>() == "right_wrong");
      seam.reversed = !told.back();
      if (easeRatio(pattern_, seam) >= 1.5) seam.tie = Seam::Tie::TwoToOne;
      seams.push_back(std::move(seam));
    }
    if (!trusted && contradictsRule(seams, told))
      for (std::size_t i = 0; i < seams.size(); ++i)
        if (const auto better = nearerEnds(seams[i]); better && !told[i]) seams[i].reversed = *better;
    return seams;
  }

 private:
  Result<EdgeSpan> side(const Json& json, std::size_t index) const {
    const Json* name = member(json, "panel");
    const Json* edge = member(json, "edge");
    if (!name || !name->is_string() || !edge || !edge->is_number_integer())
      return badInput(say("Stitch {0}: each side needs a panel's name and an edge's number.", index));
    for (const Panel& panel : panels_) {
      if (panel.name != name->get_ref<const std::string&>()) continue;
      const auto number = edge->get<long long>();
      if (number < 0 || static_cast<std::size_t>(number) >= panel.edgeNames.size())
        return badInput(say("Stitch {0}: panel \"{1}\" has no edge {2}.", index, shown(panel.name), number));
      return EdgeSpan{panel.piece.id, panel.edgeNames[static_cast<std::size_t>(number)], 0, 1};
    }
    return badInput(say("Stitch {0}: there is no panel \"{1}\".", index, shown(name->get_ref<const std::string&>())));
  }

  // Which way the ends lie clearly nearer to each other in space; nothing where both ways are much the same.
  std::optional<bool> nearerEnds(const Seam& seam) const {
    const auto ends = [&](const EdgeSpan& span) {
      const Piece& piece = *pattern_.pieces.at(span.piece);
      const Curve& curve = piece.outline.edges[*piece.outline.find(span.edge)].curve;
      const auto stand = [&](Flat p) { return piece.pose({p.u, p.v, 0}); };
      return std::pair{stand(curve.start), stand(curve.end)};
    };
    const auto [a0, a1] = ends(seam.a[0]);
    const auto [b0, b1] = ends(seam.b[0]);
    const double against = squaredLength(a0 - b1) + squaredLength(a1 - b0);
    const double along = squaredLength(a0 - b0) + squaredLength(a1 - b1);
    if (against < 0.9 * along) return true;
    if (along < 0.9 * against) return false;
    return std::nullopt;
  }

  bool contradictsRule(const std::vector<Seam>& seams, const std::vector<bool>& told) const {
    std::size_t keeps = 0, breaks = 0;
    for (std::size_t i = 0; i < seams.size(); ++i)
      if (const auto nearer = nearerEnds(seams[i]); nearer && !told[i]) ++(*nearer ? keeps : breaks);
    return breaks > keeps;
  }

  const std::vector<Panel>& panels_;
  const Pattern& pattern_;
};

Done ofPlausibleSize(const Pattern& pattern, double metres) {
  for (const auto& [id, piece] : pattern.pieces) {
    FlatBox box;
    for (const Flat p : piece->outline.flattened(1e-3)) box.include(p);
    const double longest = std::max(box.size().u, box.size().v);
    if (longest > kLongestPanel)
      return badInput(
          say("Panel \"{0}\" would be {1} m long, for units_in_meter is {2}. Write 100 there if the numbers are "
              "centimetres, 1000 if they are millimetres.",
              piece->name, fixed(longest, 0), fixed(1 / metres, 0)));
  }
  return {};
}

}  // namespace

Result<Pattern> readGarmentCode(std::string_view json) {
  Result<Json> root = parseStrictJson(json);
  if (!root) return root.error();
  const Json* pattern = member(*root, "pattern");
  const Json* panels = pattern ? member(*pattern, "panels") : nullptr;
  if (!panels || !panels->is_object() || panels->empty())
    return badInput(say(
        "This JSON is no pattern that is read here. One of Karinui has the \"format\" \"karinui-pattern-1\", a "
        "GarmentCode specification a \"pattern\" with \"panels\". JSON of measures is read where measures are asked "
        "for."));
  if (panels->size() > kMostPanels) return badInput(say("There are more than {0} panels.", kMostPanels));
  double metres = 0.01;
  bool relative = true, ours = false;
  if (const Json* properties = member(*root, "properties")) {
    const Json* generator = member(*properties, "generator");
    ours = generator && *generator == "Karinui";
    if (const Json* units = member(*properties, "units_in_meter")) {
      if (!isFinite(*units) || units->get<double>() < 1e-3 || units->get<double>() > 1e6)
        return badInput(say("units_in_meter must be a number such as 100 (centimetres)."));
      metres = 1 / units->get<double>();
    }
    if (const Json* coordinates = member(*properties, "curvature_coords"))
      relative = !coordinates->is_string() || coordinates->get_ref<const std::string&>() != "absolute";
  }
  const auto names = panelNames(*pattern, *panels);
  if (!names) return names.error();

  Pattern out;
  std::vector<Panel> read;
  DistinctNames taken;
  for (const std::string& name : *names) {
    Result<Panel> panel = readPanel(name, panels->at(name), metres, relative);
    if (!panel) return panel.error();
    panel->piece.id = madeBy<PieceId>(1, static_cast<std::uint32_t>(read.size()));
    panel->piece.name = taken.give(std::move(panel->piece.name));
    out.pieces[panel->piece.id] = std::make_shared<const Piece>(panel->piece);
    read.push_back(*std::move(panel));
  }
  if (const Done plausible = ofPlausibleSize(out, metres); !plausible) return plausible.error();
  if (const Json* stitches = member(*pattern, "stitches")) {
    Result<std::vector<Seam>> seams = StitchReader(read, out).read(*stitches, ours);
    if (!seams) return seams.error();
    for (Seam& seam : *seams) out.seams[seam.id] = std::move(seam);
  }
  return out;
}

}  // namespace karinui
