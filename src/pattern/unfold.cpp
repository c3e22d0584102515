#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "karinui/pattern/edit.h"
#include "karinui/pattern/lattice.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kBows = 1e-4;  // metres a fold may bow
constexpr double kOver = 1e-6;  // metres a half may reach over it

bool onLine(const Curve& curve, Flat through, Flat axis, double within) {
  const auto points = curve.flattened(1e-5);
  return std::all_of(points.begin(), points.end(),
                     [&](Flat p) { return std::fabs(cross(axis, p - through)) <= within; });
}

// The form of the half and its image on the plane through the fold, at right angles to the cloth there.
std::shared_ptr<const Form> unfolded(const Form& half, Flat a, Flat b, const std::function<Flat(Flat)>& image) {
  const LatticeFinder finder(half.flat, half.faces);
  const auto stand = [&](Flat p) {
    const LatticePlace place = finder.find(p);
    Vec3 at;
    for (std::size_t i = 0; i < 3; ++i) at += half.space[place.face[i]] * place.weight[i];
    return at;
  };
  const Flat middle = lerp(a, b, 0.5), inwards = leftOf(normalized(b - a)) * 0.01;
  const Vec3 foot = stand(middle), along = normalized(stand(b) - stand(a));
  const Vec3 in = stand(middle + inwards) - foot;
  const Vec3 normal = normalized(in - along * dot(in, along));
  auto whole = std::make_shared<Form>(half);
  const auto n = static_cast<std::uint32_t>(half.flat.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    whole->flat.push_back(image(half.flat[i]));
    whole->space.push_back(half.space[i] - normal * (2 * dot(half.space[i] - foot, normal)));
  }
  for (const Triangle& face : half.faces) whole->faces.push_back({face[0] + n, face[2] + n, face[1] + n});
  return whole;
}

}  // namespace

Result<EditedPiece> unfolded(const Piece& piece, std::string_view fold) {
  const auto found = piece.outline.find(fold);
  if (!found) return notFound(say("Piece {0} has no edge {1}.", piece.name, fold));
  const auto& half = piece.outline.edges;
  const std::size_t n = half.size(), at = *found;
  const Flat a = half[at].curve.start, b = half[at].curve.end, axis = normalized(b - a);
  if (!onLine(half[at].curve, a, axis, kBows))
    return refused(say("“{0}” is curved; a piece is unfolded on a straight edge.", fold));
  for (const Flat p : piece.outline.flattened(1e-5))
    if (cross(axis, p - a) < -kOver)
      return refused(say("“{0}” reaches over the line of “{1}” at {2} mm; its halves would lie on each other.",
                         piece.name, fold, inMm(p)));
  const auto image = [&](Flat p) { return Curve::line(p, p).mirrored(a, axis).start; };

  EditedPiece edit;
  edit.piece = piece;
  const bool left = leftOf(axis).u >= 0;
  std::set<std::string> taken;
  std::vector<Edge> mine, other;
  for (std::size_t k = 1; k < n; ++k) {  // the fold itself goes
    const Edge& edge = half[(at + k) % n];
    const bool sided = otherSide(edge.name) != edge.name;
    std::string name = sided ? edge.name : edge.name + (left ? "_left" : "_right");
    std::string across = otherSide(name);
    if (!taken.insert(name).second || !taken.insert(across).second)
      return refused(say("Two edges of the unfolded piece would be called “{0}”; rename one of them first.", name));
    edit.edges[{piece.id, edge.name}] = {{0, 1, {piece.id, name, 0, 1}}};
    other.push_back({std::move(across), edge.curve.mirrored(a, axis).reversed()});
    mine.push_back({std::move(name), edge.curve});
  }
  std::reverse(other.begin(), other.end());
  // From the fold's end round the half to the fold's start, and back on the other side.
  edit.piece.outline.edges = mine;
  edit.piece.outline.edges.insert(edit.piece.outline.edges.end(), other.begin(), other.end());
  auto outline = checked(edit.piece.outline);
  if (!outline) return outline.error();
  edit.piece.outline = *std::move(outline);

  for (Mark& mark : edit.piece.marks)
    if (const auto now = placeNow(edit.edges, piece.id, mark.edge, mark.fraction); !mark.edge.empty() && now)
      mark.edge = now->first;
  std::erase_if(edit.piece.marks, [&](const Mark& mark) { return mark.edge == fold; });
  for (const Mark& mark : std::vector<Mark>(edit.piece.marks)) {
    Mark copy = mark;
    if (!mark.name.empty()) copy.name = otherSide(mark.name);
    if (mark.edge.empty()) {
      copy.place = image(mark.place);
    } else {
      copy.edge = otherSide(mark.edge);
      copy.fraction = 1 - mark.fraction;
    }
    edit.piece.marks.push_back(std::move(copy));
  }
  for (const InternalLine& line : piece.lines) {
    const bool onFold = std::all_of(line.curves.begin(), line.curves.end(),
                                    [&](const Curve& curve) { return onLine(curve, a, axis, kBows); });
    if (onFold) continue;
    InternalLine copy;
    copy.name = otherSide(line.name);
    if (copy.name == line.name) copy.name += "_2";
    copy.crease = line.crease;
    for (const Curve& curve : line.curves) copy.curves.push_back(curve.mirrored(a, axis));
    edit.piece.lines.push_back(std::move(copy));
  }
  for (const Outline& hole : piece.holes) {
    Outline copy;
    for (auto edge = hole.edges.rbegin(); edge != hole.edges.rend(); ++edge)
      copy.edges.push_back({edge->name + "_2", edge->curve.mirrored(a, axis).reversed()});
    edit.piece.holes.push_back(std::move(copy));
  }
  if (piece.form) edit.piece.form = unfolded(*piece.form, a, b, image);
  return edit;
}

}  // namespace karinui
