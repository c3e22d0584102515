#include <algorithm>
#include <cmath>
#include <map>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/drawing.h"
#include "karinui/geometry/fit_curve.h"
#include "karinui/pattern/lattice.h"

namespace karinui {
namespace {

constexpr double kStill = 0.0005;    // metres: outline points that move less did not move
constexpr double kStraight = 0.002;  // a straight edge stays straight while it bows less
constexpr double kSample = 0.005;    // metres between the points an edge is measured at

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
  Shift(const Form& form, std::span<const Flat> after) : form_(form), after_(after), finder_(form.flat, form.faces) {}
  Flat operator()(Flat place) const {
    const LatticePlace under = finder_.find(place);
    Flat by;
    for (std::size_t k = 0; k < 3; ++k) by += (after_[under.face[k]] - form_.flat[under.face[k]]) * under.weight[k];
    return by;
  }

 private:
  const Form& form_;
  std::span<const Flat> after_;
  LatticeFinder finder_;
};

Outline movedOutline(const Outline& old, const Shift& shift) {
  const auto cornerShift = [&](Flat corner) {
    const Flat by = shift(corner);
    return length(by) < kStill ? Flat{} : by;
  };
  Outline outline = old;
  for (Edge& edge : outline.edges) {
    const Curve was = edge.curve;
    const auto steps = static_cast<int>(std::clamp(std::ceil(was.length() / kSample), 4.0, 400.0));
    const Flat startBy = cornerShift(was.start), endBy = cornerShift(was.end);
    std::vector<Flat> points;
    double most = 0;
    for (int i = 0; i <= steps; ++i) {
      const Flat p = i == 0 ? was.start : i == steps ? was.end : was.atFraction(static_cast<double>(i) / steps);
      const Flat by = i == 0 ? startBy : i == steps ? endBy : shift(p);
      most = std::fmax(most, length(by));
      points.push_back(p + by);
    }
    if (most < kStill) continue;
    FitSettings one;  // an edge stays one curve: seams know it by its name
    one.straight = was.kind == Curve::Kind::Line ? kStraight : 1e-5;
    one.single = 1e9;
    edge.curve = fitEdge(points, one).curves.front();
  }
  return outline;
}

// A piece cut anew: the shape's paper places follow the outline, its places in space stay.
Piece recut(Piece piece, const Outline& outline) {
  if (piece.form) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Triangle& t : piece.form->faces)
      for (std::size_t k = 0; k < 3; ++k) ++sides[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
    std::vector<std::uint8_t> rim(piece.form->flat.size(), 0);
    for (const auto& [side, count] : sides)
      if (count == 1) rim[side.first] = rim[side.second] = 1;

    struct Sample {
      Flat old, by;
    };
    std::vector<Sample> samples;
    for (const Edge& edge : piece.outline.edges) {
      const auto now = outline.find(edge.name);
      KARINUI_ASSERT(now);
      const Curve &was = edge.curve, &is = outline.edges[*now].curve;
      const auto steps = static_cast<int>(std::clamp(std::ceil(was.length() / 0.002), 4.0, 1000.0));
      for (int i = 0; i < steps; ++i) {
        const double f = static_cast<double>(i) / steps;
        const Flat p = was.atFraction(f);
        samples.push_back({p, was == is ? Flat{} : is.atFraction(f) - p});
      }
    }
    std::vector<Carried> held;
    for (std::uint32_t p = 0; p < rim.size(); ++p) {
      if (!rim[p]) continue;
      const auto nearest = std::min_element(samples.begin(), samples.end(), [&](const Sample& a, const Sample& b) {
        return distance(a.old, piece.form->flat[p]) < distance(b.old, piece.form->flat[p]);
      });
      held.push_back({p, nearest->by});
    }
    auto form = std::make_shared<Form>(*piece.form);
    form->flat = carryAlong(form->flat, form->faces, held);
    piece.form = std::move(form);
  }
  piece.outline = outline;
  return piece;
}

Done sameEdges(const Outline& old, const Outline& now) {
  for (const Edge& edge : old.edges)
    if (!now.find(edge.name))
      return refused(say("The new outline has no edge {0}; reshaping keeps every edge.", edge.name));
  if (old.edges.size() != now.edges.size())
    return refused(say("The new outline has more edges than the piece; reshaping keeps the edges as they are."));
  return {};
}

Done checkPulls(const std::vector<Flat>& at, const std::vector<Vec3>& by, double within) {
  if (at.size() != by.size())
    return refused(say("There are {0} places but {1} ways to pull them; each place needs one.", at.size(), by.size()));
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

Result<ReshapePiece> reshaped(const Document& document, PieceId id, std::span<const ReshapePull> pulls, Length within,
                              const Token& token) {
  const Piece* piece = document.find(id);
  if (!piece) return notFound(say("There is no piece to reshape."));
  ReshapePiece reshape;
  reshape.piece = id;
  reshape.within = within;
  for (const ReshapePull& pull : pulls) {
    reshape.at.push_back(pull.at);
    reshape.by.push_back(pull.by);
  }
  if (auto fine = checkPulls(reshape.at, reshape.by, within); !fine) return fine.error();
  const auto shape = shapeOf(document, *piece);
  if (!shape) return shape.error();
  const Form& form = **shape;
  const auto flat = reflatten(form.flat, form.faces, form.space, pulledShape(form, piece->pose, pulls, within), token);
  if (!flat) return flat.error();
  auto outline = checked(movedOutline(piece->outline, Shift(form, *flat)));
  if (!outline) return outline.error();
  reshape.outline = std::move(*outline);
  return reshape;
}

Done resolve(const Document& before, ReshapePiece& reshape, Context& context) {
  if (auto fine = resolve(before, reshape.piece); !fine) return fine;
  if (auto fine = checkPulls(reshape.at, reshape.by, reshape.within); !fine) return fine;
  if (!reshape.outline.edges.empty()) return {};
  if (reshape.at.empty()) return refused(say("Say which places are pulled and how far, or give the new outline."));
  auto made = reshaped(before, reshape.piece.id, pullsOf(reshape), reshape.within, context.token);
  if (!made) return made.error();
  reshape.outline = std::move(made->outline);
  return {};
}

Result<Document> perform(const Document& before, const ReshapePiece& reshape, Context&) {
  const Piece* old = before.find(reshape.piece.id);
  if (!old) return notFound(say("There is no piece to reshape."));
  const auto outline = checked(reshape.outline);
  if (!outline) return outline.error();
  if (auto fine = sameEdges(old->outline, *outline); !fine) return fine.error();
  Piece piece = *old;
  if (piece.form && !reshape.at.empty()) {  // it stands as it was pulled
    auto form = std::make_shared<Form>(*piece.form);
    form->space = pulledShape(*form, piece.pose, pullsOf(reshape), reshape.within);
    piece.form = std::move(form);
  }
  piece = recut(std::move(piece), *outline);

  // The symmetric copy (or the piece this is the copy of) follows.
  std::vector<Piece> followers;
  const Outline mirrored = mirroredPiece(piece).outline;
  for (const auto& [id, other] : before.pattern.pieces) {
    if (id == piece.id || (other->mirrorOf != piece.id && piece.mirrorOf != id)) continue;
    if (auto fine = sameEdges(other->outline, mirrored); !fine) continue;  // it went its own way since
    followers.push_back(recut(*other, mirrored));
  }
  Document after = withPiece(before, std::move(piece));
  for (Piece& follower : followers) after = withPiece(std::move(after), std::move(follower));
  return after;
}

}  // namespace karinui
