#include "karinui/design/step_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "design/glossary/terms.h"
#include "design/text/value_text.h"
#include "karinui/base/number.h"
#include "karinui/pattern/darts.h"

namespace karinui {

namespace {

constexpr std::size_t kMostNamed = 6;  // things of a list that are named one by one

Message millimetres(double metres) { return say("{0} mm", fixed(metres * 1000, 1)); }
std::string degrees(double radians) { return fixed(radians * 180 / std::numbers::pi, 1); }

template <class T>
std::optional<T> read(std::string_view text) {
  T value{};
  return readValue(text, value) ? std::optional(std::move(value)) : std::nullopt;
}

// Every item of a list in words, or how many there are.
template <class T, class Words>
std::optional<Message> listOf(std::string_view text, const Words& words) {
  const auto items = read<std::vector<T>>(text);
  if (!items || items->empty()) return std::nullopt;
  std::vector<Message> all;
  for (std::size_t i = 0; i < items->size() && i < kMostNamed; ++i) all.push_back(words((*items)[i]));
  if (items->size() > kMostNamed) all.push_back(say("{0} more", items->size() - kMostNamed));
  return listSaid(all);
}

// "50 mm up, 100 mm forward": the figure's left is +x, up +y, forward +z.
Message wayOf(Vec3 by) {
  std::vector<Message> parts;
  const auto add = [&](double metres, const Message& plus, const Message& minus) {
    if (std::fabs(metres) >= 5e-5)
      parts.push_back(say("{0} mm {1}", fixed(std::fabs(metres) * 1000, 1), metres > 0 ? plus : minus));
  };
  add(by.x, say("to the left"), say("to the right"));
  add(by.y, say("upwards"), say("downwards"));
  add(by.z, say("forwards"), say("backwards"));
  return parts.empty() ? say("not at all") : listSaid(parts);
}

Message gravitySaid(Vec3 g) {
  if (g.x == 0 && g.z == 0)
    return g.y > 0 ? say("{0} m/s² upwards", shortest(g.y)) : say("{0} m/s² downwards", shortest(std::fabs(g.y)));
  return say("{0}, {1}, {2} m/s²", shortest(g.x), shortest(g.y), shortest(g.z));
}

Message turnSaid(const Turn& turn) {
  const std::string angle = degrees(turn.angle.radians);
  if (turn.axis == Vec3{0, 1, 0}) return say("{0}° about the upright axis", angle);
  if (turn.axis == Vec3{1, 0, 0}) return say("{0}° about the axis from side to side", angle);
  if (turn.axis == Vec3{0, 0, 1}) return say("{0}° about the axis from front to back", angle);
  return say("{0}°", angle);
}

Message statedSaid(const Stated& stated) {
  const auto key = measurementKey(stated.key);
  const Message name = identifierSaid(key ? *key : stated.key).value_or(say("{0}", stated.key));
  if (key && isAngle(*key)) return say("{0} {1}°", name, degrees(stated.value.metres));
  return say("{0} {1} mm", name, fixed(stated.value.metres * 1000, 1));
}

// What a bare number counts.
Message numberSaid(std::string_view field, double value) {
  if (field == "at" || field == "to_at") return say("{0} %", fixed(100 * value, 1));
  if (field == "seconds") return say("{0} s", shortest(value));
  if (field == "weight") return say("{0} g/m²", fixed(1000 * value, 1));
  if (field.starts_with("stretch") || field == "shear") return say("{0} N/m", shortest(value));
  if (field.starts_with("bend")) return say("{0} µN m", fixed(value * 1e6, 2));
  if (field.starts_with("toe")) return say("{0} %", fixed(100 * value, 2));
  constexpr double kSaid = 1e4;  // what was reckoned out of a length is said in four decimals
  return say("{0}", shortest(std::fabs(value) < 0.1 ? value : std::round(kSaid * value) / kSaid));
}

std::optional<Message> said(const Document& document, std::string_view operation, const FieldHelp& field,
                            std::string_view value) {
  const bool list = field.kind.starts_with("list of ");
  const std::string kind = list ? field.kind.substr(8) : field.kind;
  if (kind.find('|') != std::string::npos) return termSaid(Term::Value, value);
  if (kind == "name") {
    if (field.name == "mesh") return say("an imported body");
    if (field.name == "photo") return say("a photograph");
    if (field.name == "size") return termSaid(Term::Size, value);
    if (!list) return nameSaid(value);
    std::vector<std::string> names = splitList(value);
    std::erase(names, "~");
    std::vector<Message> all;
    for (const std::string& name : names) all.push_back(nameSaid(name));
    return listSaid(all);
  }
  if (kind == "colour") return say("#{0}", value);
  if (kind == "number") {
    const auto number = read<double>(value);
    return number ? std::optional(numberSaid(field.name, *number)) : std::nullopt;
  }
  if (kind == "length") {
    const auto length = read<Length>(value);
    return length ? std::optional(millimetres(length->metres)) : std::nullopt;
  }
  if (kind == "angle") {
    const auto angle = read<Angle>(value);
    return angle ? std::optional(say("{0}°", degrees(angle->radians))) : std::nullopt;
  }
  if (kind == "u,v" && !list && operation == "grain") {
    const auto to = read<Flat>(value);
    return to ? std::optional(say("{0}°", degrees(std::atan2(to->u, to->v)))) : std::nullopt;
  }
  const auto onPaper = [](Flat p) {
    return say("{0} mm across and {1} mm up", fixed(p.u * 1000, 1), fixed(p.v * 1000, 1));
  };
  if (kind == "u,v") {
    const auto places = read<std::vector<Flat>>(value);
    if (!places || places->empty()) return std::nullopt;
    return places->size() == 1 ? onPaper(places->front()) : say("{0} {0|place|places} on the paper", places->size());
  }
  if (kind == "x,y,z" && field.name == "gravity") {
    const auto g = read<Vec3>(value);
    return g ? std::optional(gravitySaid(*g)) : std::nullopt;
  }
  if (kind == "x,y,z") {
    const auto ways = read<std::vector<Vec3>>(value);
    if (!ways || ways->empty()) return std::nullopt;
    return ways->size() == 1 ? wayOf(ways->front())
                             : say("{0} {0|step|steps}, the last {1}", ways->size(), wayOf(ways->back()));
  }
  if (kind == "axis angle") {
    const auto turn = read<Turn>(value);
    return turn ? std::optional(turnSaid(*turn)) : std::nullopt;
  }
  if (kind == "x,y,z turn") {
    const auto pose = read<Rigid>(value);
    return pose ? std::optional(wayOf(pose->carry)) : std::nullopt;
  }
  if (kind == "measurement=length") return listOf<Stated>(value, statedSaid);
  if (kind == "piece") return listOf<PieceRef>(value, [&](const PieceRef& one) { return pieceSaid(document, one); });
  if (kind == "seam") return listOf<SeamRef>(value, [&](const SeamRef& one) { return seamSaid(document, one); });
  if (kind == "piece.edge") return listOf<EdgeRef>(value, [&](const EdgeRef& one) { return edgeSaid(document, one); });
  if (kind == "place on the body") {
    const auto places = read<std::vector<BodyPoint>>(value);
    if (!places || places->empty()) return std::nullopt;
    if (places->size() == 1) return placeSaid(places->front());
    return say("{0} {0|place|places} from “{1}” to “{2}”", places->size(), placeSaid(places->front()),
               placeSaid(places->back()));
  }
  if (kind == "outline") {
    const auto outline = parseOutline(value);
    return outline ? std::optional(say("{0} {0|edge|edges}", outline->edges.size())) : std::nullopt;
  }
  if (kind == "outlines") {
    const auto all = read<std::vector<Outline>>(value);
    return all ? std::optional(say("{0} {0|hole|holes}", all->size())) : std::nullopt;
  }
  if (kind == "lines") {
    const auto all = read<std::vector<InternalLine>>(value);
    return all ? std::optional(say("{0} {0|line|lines}", all->size())) : std::nullopt;
  }
  if (kind == "graded places") {
    const auto all = read<GradePoints>(value);
    return all ? std::optional(say("{0} {0|place|places} on the paper", all->size())) : std::nullopt;
  }
  if (kind == "marks") {
    const auto all = read<std::vector<Mark>>(value);
    return all ? std::optional(say("{0} {0|mark|marks}", all->size())) : std::nullopt;
  }
  return std::nullopt;
}

// "left side: front – back" where both edges are called alike, else each edge with its piece.
Message sidesSaid(const Document& document, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b) {
  const auto whole = [](const std::vector<EdgeRef>& side) {
    return side.size() == 1 && side[0].from == 0 && side[0].to == 1;
  };
  if (whole(a) && whole(b) && a[0].edge == b[0].edge && !isNumbered(a[0].edge))
    return say("{0}: {1}", nameSaid(a[0].edge),
               say("{0} – {1}", pieceSaid(document, a[0].piece), pieceSaid(document, b[0].piece)));
  constexpr std::size_t kMost = 4;  // edges of a side that are named one by one: a pleated waist has a dozen
  const auto side = [&](const std::vector<EdgeRef>& edges) {
    if (edges.size() > kMost)
      return say("{0} … {1}", edgeSaid(document, edges.front()), edgeSaid(document, edges.back()));
    std::vector<Message> all;
    for (const EdgeRef& edge : edges) all.push_back(edgeSaid(document, edge));
    return listSaid(all);
  };
  return say("{0} – {1}", side(a), side(b));
}

// What was decided for the person, or is seen better than read.
bool goesWithoutSaying(std::string_view field, std::string_view value) {
  static constexpr std::array<std::string_view, 11> kQuiet{
      "reversed", "edges", "closed", "symmetric", "square", "level", "eased", "outline", "pose", "inside", "grain"};
  return value.empty() || value == "no" || value == "auto" || value == "1:1" ||
         std::find(kQuiet.begin(), kQuiet.end(), field) != kQuiet.end();
}

// Whether a value says by itself what it is.
bool speaksForItself(const FieldHelp& field) {
  if (field.name == "gravity") return false;
  return field.kind == "name" || field.kind.ends_with("piece") || field.kind.ends_with("seam") ||
         field.kind.ends_with("piece.edge") || field.kind.ends_with("place on the body") ||
         field.kind.ends_with("x,y,z") || field.kind.ends_with("u,v") || field.kind.ends_with("measurement=length");
}

// The leg by whose name a dart is called; nothing where the seam closes no dart, or its legs bear names of their own.
const EdgeSpan* dartCalledBy(const Document& document, const Seam& seam) {
  if (seam.a.size() != 1 || seam.b.size() != 1 || seam.a[0].piece != seam.b[0].piece) return nullptr;
  const auto dart = dartWithLeg(document.pattern, seam.a[0].piece, seam.a[0].edge);
  if (!dart || dart->seam != seam.id || isNumbered(seam.a[0].edge)) return nullptr;
  const auto stem = [](const std::string& name) {
    const std::size_t end = name.find_last_not_of("0123456789");
    return name.substr(0, end != std::string::npos && name[end] == '_' ? end : name.size());
  };
  const auto &a = seam.a[0], &b = seam.b[0];
  if (stem(a.edge) != stem(b.edge)) return nullptr;
  // On a symmetric copy the legs come the other way round: the first by number, or its one dart is called “dart 2”.
  return std::pair(b.edge.size(), b.edge) < std::pair(a.edge.size(), a.edge) ? &b : &a;
}

}  // namespace

Message pieceSaid(const Document& document, const PieceRef& piece) {
  const Piece* known = piece.id ? document.find(piece.id) : nullptr;
  if (known) return nameSaid(known->name);
  return piece.id ? identifierSaid(text(piece.id)).value_or(Message()) : nameSaid(piece.name);
}

Message edgeSaid(const Document& document, const EdgeRef& edge) {
  const Piece* known = edge.piece.id ? document.find(edge.piece.id) : document.pieceNamed(edge.piece.name);
  // What nobody named is told by where it lies, and by the name under which it can be written.
  const Message name = !known ? nameSaid(edge.edge)
                       : isNumbered(edge.edge) && known->outline.find(edge.edge)
                           ? say("{0} ({1})", edgeNameSaid(document, *known, edge.edge), edge.edge)
                           : edgeNameSaid(document, *known, edge.edge);
  const Message whole = say("{0} of {1}", name, pieceSaid(document, edge.piece));
  if (edge.from == 0 && edge.to == 1) return whole;
  return say("{0}, {1} % to {2} %", whole, fixed(100 * edge.from, 0), fixed(100 * edge.to, 0));
}

Message seamSaid(const Document& document, const Seam& seam) {
  if (!seam.name.empty()) return nameSaid(seam.name);
  if (const EdgeSpan* leg = dartCalledBy(document, seam)) return edgeSaid(document, {PieceRef(leg->piece), leg->edge});
  const auto side = [&](const std::vector<EdgeSpan>& spans) {
    std::vector<EdgeRef> all;
    for (const EdgeSpan& s : spans) all.push_back({PieceRef(s.piece), s.edge, s.from, s.to});
    return all;
  };
  return sidesSaid(document, side(seam.a), side(seam.b));
}

Message seamSaid(const Document& document, const SeamRef& seam) {
  if (const Seam* known = seam.id ? document.find(seam.id) : nullptr) return seamSaid(document, *known);
  return seam.id ? identifierSaid(text(seam.id)).value_or(Message()) : nameSaid(seam.name);
}

Message valueSaid(const Document& document, std::string_view operation, const FieldHelp& field,
                  std::string_view value) {
  return said(document, operation, field, value).value_or(say("{0}", value));
}

Message stepSaid(const Document& document, const Operation& operation) {
  const OperationHelp& help = helpOf(operation);
  std::vector<Message> parts;
  const auto* sew = std::get_if<SewEdges>(&operation);
  if (sew) parts.push_back(sidesSaid(document, sew->a, sew->b));
  for (const FieldText& given : fieldTexts(operation)) {
    if (goesWithoutSaying(given.name, given.value) || (sew && (given.name == "a" || given.name == "b"))) continue;
    const FieldHelp& field =
        *std::find_if(help.fields.begin(), help.fields.end(), [&](const auto& f) { return f.name == given.name; });
    const Message value = valueSaid(document, help.name, field, given.value);
    if (speaksForItself(field))
      parts.push_back(value);
    else if (field.kind == "yes|no")
      parts.push_back(fieldSaid(help.name, field.name));
    else
      parts.push_back(say("{0}: {1}", fieldSaid(help.name, field.name), value));
  }
  return listSaid(parts);
}

const OperationHelp& helpOf(const Operation& operation) {
  static const std::vector<OperationHelp> all = operationHelp();
  return *std::find_if(all.begin(), all.end(), [&](const auto& help) { return help.name == nameOf(operation); });
}

}  // namespace karinui
