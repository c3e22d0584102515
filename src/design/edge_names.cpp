// What an edge is called that nobody named: "left side" where its name is "e3".
#include <algorithm>
#include <cmath>

#include "design/glossary/terms.h"
#include "karinui/design/step_words.h"

namespace karinui {

namespace {

enum class EdgeZone { Top, Bottom, Side };

// An edge as a tailor sees it on the paper, the grain upwards.
struct Seen {
  EdgeZone part = EdgeZone::Side;
  double hollow = 0;  // how far it is cut into the cloth, over its chord
  double across = 0;  // of its middle: from the piece's left (-1) to its right (1)
  double high = 0;    // likewise from the bottom (-1) to the top (1)
  double chord = 0;   // over the piece's width
  double slope = 0;   // of its outward normal, away from the middle of the piece
};

// The piece's box with the grain upwards.
struct Upright {
  Flat up, right;
  FlatBox box;
  explicit Upright(const Piece& piece) : up(piece.grain), right{piece.grain.v, -piece.grain.u} {
    for (const Flat p : piece.outline.flattened(1e-3)) box.include(turned(p));
  }
  Flat turned(Flat p) const { return {dot(p, right), dot(p, up)}; }
};

Seen seen(const Upright& piece, const Curve& curve) {
  constexpr double kFacing = 0.75;  // cosine: up to 41 degrees from straight up or down
  const Flat start = piece.turned(curve.start), end = piece.turned(curve.end),
             middle = piece.turned(curve.atFraction(0.5));
  const Flat chord = end - start;
  const double long1 = length(chord);
  Seen edge;
  const auto share = [](double at, double low, double high) {
    return high > low ? 2 * (at - low) / (high - low) - 1 : 0.0;
  };
  edge.across = share(middle.u, piece.box.low.u, piece.box.high.u);
  edge.high = share(middle.v, piece.box.low.v, piece.box.high.v);
  edge.chord = long1 / std::fmax(piece.box.size().u, 1e-6);
  if (long1 < 1e-6) return edge;
  const Flat out = Flat{chord.v, -chord.u} * (1 / long1);  // outlines run counter-clockwise
  edge.part = out.v > kFacing ? EdgeZone::Top : out.v < -kFacing ? EdgeZone::Bottom : EdgeZone::Side;
  edge.hollow = -dot(middle - lerp(start, end, 0.5), out) / long1;
  edge.slope = edge.across < 0 ? -out.u : out.u;
  return edge;
}

// Where the middle of an edge stands from the middle of its piece: left and right are the wearer's.
Vec3 standsAt(const Piece& piece, const Upright& upright, Flat paper) {
  Vec3 sum, at;
  if (!piece.form || piece.form->flat.empty()) {
    const bool drawn = piece.pose.w * piece.pose.w > 1 - 1e-9;  // as it was drawn: not turned to stand anywhere yet
    const auto place = [&](Flat p) {
      const Flat here = drawn ? upright.turned(p) : p;
      return Vec3{here.u, here.v, 0};
    };
    const Ring ring = piece.outline.flattened(1e-3);
    for (const Flat p : ring) sum = sum + place(p);
    return piece.pose.turned(place(paper) - sum * (1.0 / static_cast<double>(std::max<std::size_t>(ring.size(), 1))));
  }
  double nearest = 1e18;
  for (std::size_t i = 0; i < piece.form->flat.size(); ++i) {
    sum = sum + piece.form->space[i];
    if (const double away = distance(piece.form->flat[i], paper); away < nearest)
      nearest = away, at = piece.form->space[i];
  }
  return piece.pose.turned(at - sum * (1.0 / static_cast<double>(piece.form->flat.size())));
}

bool sewn(const Document& document, PieceId piece, std::string_view edge) {
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (span.piece == piece && span.edge == edge) return true;
  return false;
}

// Armhole, neckline and shoulder by how they are cut; the rest by where it lies.
Message roleOf(const Document& document, const Piece& piece, const Edge& edge, const Seen& lies) {
  constexpr double kCutIn = 0.08, kNeck = 0.15;  // of the chord
  constexpr double kSloping = 0.15;              // shoulders fall away from the neck by 9 degrees at least
  switch (lies.part) {
    case EdgeZone::Bottom:
      return sewn(document, piece.id, edge.name) ? say("bottom edge") : say("hem");
    case EdgeZone::Top:
      if (lies.hollow > kNeck) return say("neckline");
      if (lies.chord < 0.45 && lies.slope > kSloping && std::fabs(lies.across) > 0.2 && lies.high > 0.5)
        return say("shoulder");
      return say("top edge");
    case EdgeZone::Side:
      break;
  }
  return lies.hollow > kCutIn && lies.high > 0 ? say("armhole") : say("side");
}

Message described(const Document& document, const Piece& piece, const Upright& upright, const Edge& edge) {
  constexpr double kMiddle = 0.15;  // so near to the middle of its piece an edge is on neither side
  const Seen lies = seen(upright, edge.curve);
  const Message role = roleOf(document, piece, edge, lies);
  if (edge.name.ends_with("_left") || edge.name.ends_with("_l")) return say("left {0}", role);
  if (edge.name.ends_with("_right") || edge.name.ends_with("_r")) return say("right {0}", role);
  if (std::fabs(lies.across) < kMiddle || (lies.part != EdgeZone::Side && lies.chord > 0.6)) return role;
  const Vec3 at = standsAt(piece, upright, edge.curve.atFraction(0.5));
  if (std::fabs(at.z) > 1.5 * std::fabs(at.x))  // on the side of the body or on a limb
    return at.z > 0 ? say("front {0}", role) : say("back {0}", role);
  return at.x > 0 ? say("left {0}", role) : say("right {0}", role);
}

}  // namespace

Message edgeNameSaid(const Document& document, const Piece& piece, std::string_view name) {
  if (!isNumbered(name) || !piece.outline.find(name)) return nameSaid(name);
  const Upright upright(piece);
  // Alike ones are counted along the outline.
  Message own;
  std::vector<std::pair<std::string_view, std::string>> all;
  for (const Edge& edge : piece.outline.edges) {
    Message said = isNumbered(edge.name) ? described(document, piece, upright, edge) : nameSaid(edge.name);
    all.emplace_back(edge.name, text(said));
    if (edge.name == name) own = std::move(said);
  }
  std::size_t alike = 0, which = 0;
  for (const auto& [edge, said] : all) {
    if (said != text(own)) continue;
    ++alike;
    if (edge == name) which = alike;
  }
  return alike > 1 ? say("{0} {1}", own, which) : own;
}

Message edgeWithPartnerSaid(const Document& document, const Piece& piece, std::string_view name) {
  const Message own = edgeNameSaid(document, piece, name);
  if (!isNumbered(name)) return own;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const bool first : {true, false})
      for (const EdgeSpan& span : first ? seam.a : seam.b) {
        if (span.piece != piece.id || span.edge != name) continue;
        const EdgeSpan& other = (first ? seam.b : seam.a).front();
        const Piece* partner = document.find(other.piece);
        return !partner                  ? own
               : partner->id == piece.id ? say("{0}, sewn to {1}", own, edgeNameSaid(document, piece, other.edge))
                                         : say("{0}, sewn to {1}", own, nameSaid(partner->name));
      }
  return own;
}

std::optional<Message> identifierSaid(const Document& document, std::string_view identifier) {
  const std::size_t dot = identifier.rfind('.');
  if (dot != std::string_view::npos && isNumbered(identifier.substr(dot + 1))) {
    const std::string_view owner = identifier.substr(0, dot);
    for (const auto& [id, piece] : document.pattern.pieces)
      if ((piece->name == owner || text(id) == owner) && piece->outline.find(identifier.substr(dot + 1)))
        return say("{0} of {1}", edgeNameSaid(document, *piece, identifier.substr(dot + 1)), nameSaid(piece->name));
  }
  if (auto known = identifierSaid(identifier)) return known;
  // Names that are a person's own.
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (piece->name == identifier) return nameSaid(identifier);
    if (dot != std::string_view::npos && piece->name == identifier.substr(0, dot) &&
        piece->outline.find(identifier.substr(dot + 1)))
      return edgeSaid(piece->name, identifier.substr(dot + 1));
    if (piece->outline.find(identifier)) return nameSaid(identifier);
    for (const InternalLine& line : piece->lines)
      if (line.name == identifier) return nameSaid(identifier);
  }
  for (const auto& [id, seam] : document.pattern.seams)
    if (seam.name == identifier) return nameSaid(identifier);
  if (document.fabrics.contains(std::string(identifier))) return nameSaid(identifier);
  return std::nullopt;
}

}  // namespace karinui
