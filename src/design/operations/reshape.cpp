#include <algorithm>
#include <cmath>
#include <limits>

#include "design/operations/operations.h"
#include "design/operations/recut_outline.h"
#include "karinui/base/number.h"
#include "karinui/design/drawing.h"
#include "karinui/pattern/lattice.h"

namespace karinui {
namespace {

// The shape a piece holds; a piece that was never given one lies flat.
Result<std::shared_ptr<const Form>> shapeOf(const Document& document, const Piece& piece) {
  if (piece.form) return piece.form;
  Pattern alone;
  alone.pieces[piece.id] = std::make_shared<Piece>(piece);
  const auto laid = lay(alone, document.settings.spacing);
  if (!laid) return laid.error();
  const Lattice& lattice = *laid->lattices.at(piece.id);
  auto form = std::make_shared<Form>();
  form->flat = lattice.nodes;
  form->faces = lattice.faces;
  for (Flat p : lattice.nodes) form->space.push_back({p.u, p.v, 0});
  return std::shared_ptr<const Form>(std::move(form));
}

// The shape after the pulls: cloth comes along less the further it is from the hand, on paper.
std::vector<Vec3> pulledShape(const Form& form, const Rigid& pose, std::span<const ReshapePull> pulls, double within) {
  const Rigid back{pose.w, -pose.x, -pose.y, -pose.z, {}};
  std::vector<Vec3> space = form.space;
  for (std::size_t i = 0; i < space.size(); ++i) {
    Vec3 by;
    double whole = 0;
    for (const ReshapePull& pull : pulls) {
      const double d = distance(form.flat[i], pull.at) / within;
      if (d >= 1) continue;
      const double w = (1 - d * d) * (1 - d * d);
      by += back.turned(pull.by) * w;
      whole += w;
    }
    space[i] += by * (1 / std::fmax(1.0, whole));
  }
  return space;
}

// How far paper places moved from one flat map of a form to another.
class Shift {
 public:
  Shift(const Form& form, const LatticeFinder& finder, std::span<const Flat> after)
      : form_(form), after_(after), finder_(finder) {}
  Flat operator()(Flat place) const {
    const LatticePlace under = finder_.find(place);
    Flat by;
    for (std::size_t k = 0; k < 3; ++k) by += (after_[under.face[k]] - form_.flat[under.face[k]]) * under.weight[k];
    return by;
  }

 private:
  const Form& form_;
  std::span<const Flat> after_;
  const LatticeFinder& finder_;
};

// The paper's directions and the way out of the cloth, in space, at a paper place.
struct Frame {
  Vec3 u, v, out;
};
Frame frameAt(const Form& form, const LatticeFinder& finder, Flat place) {
  const Triangle t = finder.find(place).face;
  const Flat p = form.flat[t[1]] - form.flat[t[0]], q = form.flat[t[2]] - form.flat[t[0]];
  const Vec3 a = form.space[t[1]] - form.space[t[0]], b = form.space[t[2]] - form.space[t[0]];
  const double turn = cross(p, q);
  if (!(turn > 0)) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return {(a * q.v - b * p.v) * (1 / turn), (b * p.u - a * q.u) * (1 / turn), normalized(cross(a, b))};
}

// With a pull on one half of a symmetric piece comes the same pull on the other half: as far along the mirrored ways of
// the paper, as far out of the cloth.
std::vector<ReshapePull> onBothHalves(const Form& form, const LatticeFinder& finder, const Rigid& pose,
                                      const PaperSymmetry& symmetry, std::span<const ReshapePull> pulls) {
  constexpr double kOne = 0.001;  // metres: pulls nearer than this are each other's image already
  const Rigid back{pose.w, -pose.x, -pose.y, -pose.z, {}};
  std::vector<ReshapePull> all(pulls.begin(), pulls.end());
  for (const ReshapePull& pull : pulls) {
    const Flat there = symmetry.image(pull.at);
    const bool onAxis = distance(there, pull.at) < kOne;  // then it is its own image, less what goes sideways
    const auto taken = [&](const ReshapePull& other) { return &other != &pull && distance(other.at, there) < kOne; };
    if (std::any_of(pulls.begin(), pulls.end(), taken)) continue;
    const Frame here = frameAt(form, finder, pull.at), image = frameAt(form, finder, there);
    const Vec3 by = back.turned(pull.by);
    const double uu = dot(here.u, here.u), uv = dot(here.u, here.v), vv = dot(here.v, here.v);
    const double bu = dot(by, here.u), bv = dot(by, here.v), whole = uu * vv - uv * uv;
    const Flat along = whole > 0 ? Flat{(bu * vv - bv * uv) / whole, (bv * uu - bu * uv) / whole} : Flat{};
    const Flat mirrored = symmetry.imageOf(along);
    const Vec3 other = pose.turned(image.u * mirrored.u + image.v * mirrored.v + image.out * dot(by, here.out));
    if (onAxis)
      all[static_cast<std::size_t>(&pull - pulls.data())].by =
          distance(other, pull.by) < 1e-9 ? pull.by : (pull.by + other) * 0.5;
    else
      all.push_back({there, other});
  }
  return all;
}

// 1 for each point that its faces do not close round: those that follow it in its faces are then not those that go
// before it, and the two sums differ.
std::vector<std::uint8_t> rimOf(std::span<const Triangle> faces, std::size_t points) {
  std::vector<std::uint64_t> turn(points, 0);
  const auto mark = [](std::uint64_t point) { return (point + 1) * (point + 1); };
  for (const Triangle& t : faces)
    for (std::size_t k = 0; k < 3; ++k) turn[t[k]] += mark(t[(k + 1) % 3]) - mark(t[(k + 2) % 3]);
  std::vector<std::uint8_t> rim(points);
  std::transform(turn.begin(), turn.end(), rim.begin(), [](std::uint64_t sum) { return sum != 0; });
  return rim;
}

// How far places along an outline go when it becomes another one.
struct Moved {
  Flat old, by;
};
std::vector<Moved> movedAlong(const Outline& before, const Outline& after) {
  std::vector<Moved> moved;
  for (const Edge& edge : before.edges) {
    const auto now = after.find(edge.name);
    KARINUI_ASSERT(now);
    const Curve &was = edge.curve, &is = after.edges[*now].curve;
    const auto steps = static_cast<int>(std::clamp(std::ceil(was.length() / 0.002), 4.0, 1000.0));
    const std::vector<Flat> old = was.evenly(0, 1, steps);
    std::vector<Flat> fresh = old;
    if (was != is) {
      const FollowEdge follow(was, is);
      std::vector<double> fractions;
      for (int i = 0; i <= steps; ++i) fractions.push_back(follow(static_cast<double>(i) / steps));
      fresh = is.atFractions(fractions);
    }
    for (std::size_t i = 0; i + 1 < old.size(); ++i) moved.push_back({old[i], fresh[i] - old[i]});
  }
  return moved;
}

// The shape of a piece cut anew: its paper places follow the outline (those further than `within` from all places
// pulled stay), its places in space stay.
std::shared_ptr<const Form> followed(const Piece& piece, const Outline& outline, std::span<const Flat> pulled,
                                     double within) {
  if (!piece.form) return nullptr;
  const std::vector<std::uint8_t> rim = rimOf(piece.form->faces, piece.form->flat.size());
  const std::vector<Moved> samples = movedAlong(piece.outline, outline);
  std::vector<Carried> held;
  for (std::uint32_t p = 0; p < rim.size(); ++p) {
    if (!rim[p]) {
      const auto reached = [&](Flat at) { return distance(at, piece.form->flat[p]) < within; };
      if (!pulled.empty() && std::none_of(pulled.begin(), pulled.end(), reached)) held.push_back({p, {}});
      continue;
    }
    Moved nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const Moved& sample : samples)
      if (const Flat to = sample.old - piece.form->flat[p]; dot(to, to) < least) least = dot(to, to), nearest = sample;
    held.push_back({p, nearest.by});
  }
  auto form = std::make_shared<Form>(*piece.form);
  form->flat = carryAlong(form->flat, form->faces, held);
  return form;
}

// A piece cut anew. Notches keep to their cloth.
Piece recut(Piece piece, const Outline& outline, std::span<const Flat> pulled, double within) {
  piece.form = followed(piece, outline, pulled, within);
  for (Mark& mark : piece.marks)
    if (const auto k = piece.outline.find(mark.edge)) {
      const Curve &was = piece.outline.edges[*k].curve, &is = outline.edges[*outline.find(mark.edge)].curve;
      if (was != is) mark.fraction = FollowEdge(was, is)(mark.fraction);
    }
  piece.outline = outline;
  return piece;
}

// Seams and fastenings over a part of an edge stay on the cloth they were on.
template <class Sewn>
void followSewn(Sewn& all, const Piece& old, const Outline& now) {
  for (auto& [id, sewn] : all)
    for (auto* side : {&sewn.a, &sewn.b})
      for (EdgeSpan& span : *side) {
        const auto k = old.outline.find(span.edge);
        if (span.piece != old.id || !k || (span.from == 0 && span.to == 1)) continue;
        const Curve &was = old.outline.edges[*k].curve, &is = now.edges[*now.find(span.edge)].curve;
        if (was == is) continue;
        const FollowEdge follow(was, is);
        if (span.from > 0) span.from = follow(span.from);
        if (span.to < 1) span.to = follow(span.to);
      }
}

Done checkPulls(const std::vector<Flat>& at, const std::vector<Vec3>& by, double within) {
  if (at.size() != by.size())
    return refused(say("There {0|is|are} {0} {0|place|places} but {1} {1|way|ways} to pull them; each place needs one.",
                       at.size(), by.size()));
  if (!(within > 0 && within <= 2)) return refused(say("The cloth that comes along must reach between 0 and 2 m."));
  for (std::size_t i = 0; i < at.size(); ++i)
    if (!finite(at[i]) || !finite(by[i]) || length(by[i]) > 2)
      return refused(say("A pull of more than 2 m is not one of cloth."));
  return {};
}

std::vector<ReshapePull> pullsOf(const ReshapePiece& reshape) {
  std::vector<ReshapePull> pulls;
  for (std::size_t i = 0; i < std::min(reshape.at.size(), reshape.by.size()); ++i)
    pulls.push_back({reshape.at[i], reshape.by[i]});
  return pulls;
}

}  // namespace

std::shared_ptr<const Form> followedForm(const Piece& piece, const Outline& outline) {
  return followed(piece, outline, {}, 0);
}

Result<ReshapePiece> reshaped(const Document& document, PieceId id, std::span<const ReshapePull> given, Length within,
                              Choice symmetric, const Token& token) {
  const Piece* piece = document.find(id);
  if (!piece) return notFound(say("There is no piece to reshape."));
  ReshapePiece reshape;
  reshape.piece = id;
  reshape.within = within;
  std::vector<ReshapePull> pulls(given.begin(), given.end());
  const auto keep = [&] {
    reshape.at.clear(), reshape.by.clear();
    for (const ReshapePull& pull : pulls) reshape.at.push_back(pull.at), reshape.by.push_back(pull.by);
  };
  keep();
  if (auto fine = checkPulls(reshape.at, reshape.by, within); !fine) return fine.error();
  const auto shape = shapeOf(document, *piece);
  if (!shape) return shape.error();
  const Form& form = **shape;
  const LatticeFinder finder(form.flat, form.faces);
  for (const ReshapePull& pull : pulls)
    if (const Ring ring = piece->outline.flattened(1e-4);
        !contains(ring, pull.at) && distanceToRing(ring, pull.at) > within)
      return refused(say("The place {0} mm, {1} mm is too far from piece {2} for its cloth to come along.",
                         fixed(pull.at.u * 1000, 0), fixed(pull.at.v * 1000, 0), piece->name));
  const auto symmetry = symmetric == Choice::No ? std::nullopt : symmetryOf(piece->outline);
  if (symmetric == Choice::Yes && !symmetry)
    return refused(say("Piece {0} is not symmetric; leave symmetric= away.", piece->name));
  if (symmetry) {
    pulls = onBothHalves(form, finder, piece->pose, *symmetry, pulls);
    keep();
  }
  reshape.symmetric = symmetry ? Choice::Yes : Choice::No;
  const auto flat = reflatten(form.flat, form.faces, form.space, pulledShape(form, piece->pose, pulls, within), token);
  if (!flat) return flat.error();
  const auto cutAnew = [&](bool angles) {
    Outline recut = recutOutline(piece->outline, Shift(form, finder, *flat), angles);
    if (symmetry && recut != piece->outline) recut = symmetrised(std::move(recut), *symmetry);
    return checked(std::move(recut));
  };
  auto outline = cutAnew(true);
  if (!outline) outline = cutAnew(false);  // a pointed neck drawn deeper cannot always keep its angle
  if (!outline) return outline.error();
  reshape.outline = std::move(*outline);
  return reshape;
}

Done resolve(const Document& before, ReshapePiece& reshape, Context& context) {
  if (auto fine = resolve(before, reshape.piece); !fine) return fine;
  if (auto fine = checkPulls(reshape.at, reshape.by, reshape.within); !fine) return fine;
  if (!reshape.outline.edges.empty()) return {};
  if (reshape.at.empty()) return refused(say("Say which places are pulled and how far, or give the new outline."));
  auto made = reshaped(before, reshape.piece.id, pullsOf(reshape), reshape.within, reshape.symmetric, context.token);
  if (!made) return made.error();
  reshape = std::move(*made);
  return {};
}

Document cutAlone(Document document, const Piece& piece, const Outline& outline) {
  followSewn(document.pattern.seams, piece, outline), followSewn(document.allowances.fastenings, piece, outline);
  return withPiece(std::move(document), recut(piece, outline, {}, 0));
}

Result<Document> cutAnew(const Document& before, const ReshapePiece& reshape) {
  const Piece* old = before.find(reshape.piece.id);
  if (!old) return notFound(say("There is no piece to reshape."));
  const auto cut = reshaped(*old, reshape.outline);
  if (!cut) return cut.error();
  Piece piece = *old;
  if (piece.form && !reshape.at.empty()) {  // it stands as it was pulled
    auto form = std::make_shared<Form>(*piece.form);
    form->space = pulledShape(*form, piece.pose, pullsOf(reshape), reshape.within);
    piece.form = std::move(form);
  }
  piece = recut(std::move(piece), cut->outline, reshape.at, reshape.within);
  Document after = before;
  followSewn(after.pattern.seams, *old, cut->outline), followSewn(after.allowances.fastenings, *old, cut->outline);

  // The symmetric copy (or the piece this is the copy of) follows.
  std::vector<Flat> mirroredAt;
  for (const Flat at : reshape.at) mirroredAt.push_back({-at.u, at.v});
  const Outline image = mirrored(piece).outline;
  for (const auto& [id, other] : before.pattern.pieces) {
    if (id == piece.id || (other->mirrorOf != piece.id && piece.mirrorOf != id)) continue;
    const auto likewise = reshaped(*other, image);
    if (!likewise) continue;  // it went its own way since
    followSewn(after.pattern.seams, *other, likewise->outline);
    followSewn(after.allowances.fastenings, *other, likewise->outline);
    after = withPiece(std::move(after), recut(*other, likewise->outline, mirroredAt, reshape.within));
  }
  return withPiece(std::move(after), std::move(piece));
}

Result<Document> perform(const Document& before, const ReshapePiece& reshape, Context& context) {
  auto after = cutAnew(before, reshape);
  if (after) tellMisfits(before, *after, context);
  return after;
}

}  // namespace karinui
