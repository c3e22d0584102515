#include "pocket_offers.h"

#include <algorithm>
#include <cmath>

#include "karinui/design/document.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui::studio {

namespace {

constexpr double kUsualOpening = 0.16, kUsualInset = 0.04, kBeside = 0.06;  // metres
constexpr double kLeastOpening = 0.10, kBeyondOpening = 0.02;

bool isUpright(const Curve& curve) {
  const Flat chord = curve.end - curve.start;
  return std::fabs(chord.v) > std::fabs(chord.u);
}

bool isDart(const Document& document, const Piece& piece, const std::string& edge) {
  return dartWithLeg(document.pattern, piece.id, edge).has_value();
}

std::string freeName(const Document& document) {
  std::string name = "pocket";
  const auto taken = [&] {
    return std::any_of(document.pattern.pieces.begin(), document.pattern.pieces.end(),
                       [&](const auto& one) { return one.second->name.starts_with(name + "_"); });
  };
  for (int n = 2; taken(); ++n) name = "pocket" + std::to_string(n);
  return name;
}

// How far a piece stands before the others, in the middle of its cloth.
double standsForward(const Piece& piece) {
  Vec3 sum;
  if (piece.form && !piece.form->space.empty()) {
    for (const Vec3 place : piece.form->space) sum += place;
    sum = sum * (1.0 / static_cast<double>(piece.form->space.size()));
  } else {
    const FlatBox box = boxOf(piece.outline.flattened(1e-3));
    sum = {(box.low.u + box.high.u) / 2, (box.low.v + box.high.v) / 2, 0};
  }
  return piece.pose(sum).z;
}

// By how they stand; where they lie in one plane, as beside the figure, by what they are called.
bool isBefore(const Piece& front, const Piece& back) {
  constexpr double kPlainly = 0.01;  // metres
  const double apart = standsForward(front) - standsForward(back);
  if (std::fabs(apart) > kPlainly) return apart > 0;
  const auto isCalled = [](const Piece& piece, const char* word) { return piece.name.find(word) != std::string::npos; };
  return isCalled(back, "back") && isCalled(front, "front");
}

// The bags hang to the front: of a back's side, the front's that it is sewn to is meant.
EdgeRef towardsFront(const Document& document, const EdgeRef& edge) {
  const Piece* piece = document.find(edge.piece.id);
  if (!piece) return edge;
  for (const SeamPlace& there : sewnTo(document.pattern, {edge.piece.id, edge.edge, 0.5}))
    if (const Piece* other = document.find(there.piece); other && other->id != piece->id &&
                                                         other->layer >= piece->layer &&
                                                         other->outline.find(there.edge) && isBefore(*other, *piece))
      return {PieceRef(there.piece), there.edge};
  return edge;
}

// Down to whole half centimetres, so that it fits a short edge.
Length openingIn(double room) { return {std::min(kUsualOpening, std::floor(room * 200) / 200)}; }

}  // namespace

std::optional<SewPocket> pocketIn(const Document& document, const EdgeRef& at) {
  const EdgeRef edge = towardsFront(document, at);
  const Piece* piece = document.find(edge.piece.id);
  const auto k = piece ? piece->outline.find(edge.edge) : std::nullopt;
  if (!k || isDart(document, *piece, edge.edge)) return std::nullopt;
  const Curve& curve = piece->outline.edges[*k].curve;
  const auto seams = seamsOn(document, {edge});
  const bool sewn = std::any_of(seams.begin(), seams.end(), [&](SeamId id) {
    return document.find(id)->tie == Seam::Tie::OneToOne && document.find(id)->reversed;
  });
  SewPocket pocket;
  pocket.first = Length{kUsualInset};
  pocket.length = openingIn(curve.length() - kUsualInset - kBeyondOpening);
  if (!sewn || !isUpright(curve) || pocket.length < kLeastOpening) return std::nullopt;
  pocket.edge = {edge.piece, edge.edge};
  pocket.name = freeName(document);
  pocket.fabric = "cotton";
  return pocket;
}

std::optional<SewPocket> slantedAt(const Document& document, const EdgeRef& at, double fraction) {
  const EdgeRef edge = towardsFront(document, at);
  const Piece* piece = document.find(edge.piece.id);
  const auto k = piece ? piece->outline.find(edge.edge) : std::nullopt;
  if (!k || isDart(document, *piece, edge.edge)) return std::nullopt;
  const auto& edges = piece->outline.edges;
  const std::size_t n = edges.size(), before = (*k + n - 1) % n, after = (*k + 1) % n;
  const auto down = [&](std::size_t side) { return edges[side].curve.start.v >= edges[side].curve.end.v; };
  std::size_t side = *k, above = 0;
  if (isUpright(edges[*k].curve)) {
    above = down(side) ? before : after;
  } else {
    above = *k, side = fraction < 0.5 ? before : after;
    if (down(side) != (side == after)) return std::nullopt;  // the corner is at the side's lower end
  }
  const Curve &upright = edges[side].curve, &level = edges[above].curve;
  if (!isUpright(upright) || isUpright(level) || isDart(document, *piece, edges[side].name)) return std::nullopt;
  SewPocket pocket;
  pocket.kind = SewPocket::Kind::Slant;
  pocket.inset = Length{kUsualInset};
  pocket.length = openingIn(upright.length() - kBeyondOpening);
  if (pocket.length < kLeastOpening || level.length() < kBeside + 0.01) return std::nullopt;
  // Of a hem the corner is not cut away: it looks down.
  const Flat middle = lerp(level.start, level.end, 0.5), low = down(side) ? upright.end : upright.start;
  if (low.v > middle.v) return std::nullopt;
  pocket.edge = {edge.piece, edges[side].name};
  pocket.name = freeName(document);
  pocket.fabric = "cotton";
  return pocket;
}

std::optional<SewWelt> weltAt(const Document& document, PieceId id, Flat place) {
  constexpr double kLeastWide = 0.16, kLeastHigh = 0.20;  // metres
  const Piece* piece = document.find(id);
  if (!piece) return std::nullopt;
  const FlatBox box = boxOf(piece->outline.flattened(1e-3));
  if (box.high.u - box.low.u < kLeastWide || box.high.v - box.low.v < kLeastHigh) return std::nullopt;
  SewWelt welt;
  welt.piece = PieceRef(id);
  welt.at = place;
  welt.name = freeName(document);
  welt.fabric = "cotton";
  return welt;
}

}  // namespace karinui::studio
