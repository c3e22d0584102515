#include "design/operations/inside_last.h"

#include <algorithm>
#include <cmath>

#include "design/operations/lifted_form.h"
#include "design/operations/new_piece.h"
#include "karinui/geometry/bvh.h"
#include "karinui/pattern/facing.h"
#include "karinui/pattern/lattice.h"
#include "karinui/pattern/pockets.h"

namespace karinui {

namespace {

constexpr double kNear = 0.06;  // metres: what stands farther from what it is sewn to does not go along with it

// Where pieces stand, as one mesh, and which place of their paper each of its points is.
struct StandingCloth {
  TriangleMesh mesh;
  std::vector<PieceId> piece;  // of each face
  std::vector<Flat> flat;      // of each point
};

std::optional<StandingCloth> standingOf(const Document& document, const std::set<PieceId>& pieces) {
  StandingCloth cloth;
  for (const PieceId id : pieces) {
    const Piece& piece = *document.find(id);
    const auto laid = layAlone(piece, document.settings.spacing);
    if (!laid) return std::nullopt;
    const Stand stand(piece);
    const auto first = static_cast<std::uint32_t>(cloth.flat.size());
    for (const Flat place : (*laid)->nodes) cloth.flat.push_back(place), cloth.mesh.points.push_back(stand(place));
    for (const Triangle& face : (*laid)->faces) {
      cloth.mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
      cloth.piece.push_back(id);
    }
  }
  return cloth;
}

// What a piece is sewn onto, paper on paper; all that the others are sewn onto where it goes with those.
std::set<PieceId> beneathWhich(const Pattern& pattern, PieceId piece, const std::set<PieceId>& inside) {
  std::set<PieceId> own, all;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie != Seam::Tie::Pleat || seam.reversed) continue;
    for (const EdgeSpan& outer : seam.a) {
      if (inside.contains(outer.piece)) continue;
      for (const EdgeSpan& span : seam.b)
        if (inside.contains(span.piece)) (span.piece == piece ? own : all).insert(outer.piece);
    }
  }
  return own.empty() ? all : own;
}

Vec3 normalAt(const Stand& stand, Flat place) {
  constexpr double kStep = 1e-3;  // metres on paper
  return normalized(cross(stand(place + Flat{kStep, 0}) - stand(place - Flat{kStep, 0}),
                          stand(place + Flat{0, kStep}) - stand(place - Flat{0, kStep})));
}

}  // namespace

std::optional<Document> laidInto(Document draped, const Document& before, const std::set<PieceId>& inside) {
  // Under the two bags of a pocket there is room for a lining.
  const double deepest = pocketsOf(before.pattern).empty() && bagsOnLines(before.pattern).empty() ? 2 : 3;
  for (const PieceId id : inside) {
    const auto was = standingOf(before, beneathWhich(before.pattern, id, inside));
    if (!was || was->mesh.faces.empty()) return std::nullopt;
    const Bvh near(was->mesh);
    std::map<PieceId, Stand> stands;
    for (const PieceId outer : was->piece) stands.try_emplace(outer, *draped.find(outer));
    const Piece& old = *before.find(id);
    const auto laid = layAlone(old, before.settings.spacing);
    if (!laid) return std::nullopt;
    const Stand stood(old);
    auto form = std::make_shared<Form>();
    form->flat = (*laid)->nodes, form->faces = (*laid)->faces;
    for (const Flat place : form->flat) {
      const Vec3 at = stood(place);
      const auto nearest = near.nearest(at, kNear);
      if (!nearest) return std::nullopt;
      const Triangle& face = was->mesh.faces[nearest->place.face];
      const auto& w = nearest->place.weight;
      Flat there;
      Vec3 on;
      for (std::size_t c = 0; c < 3; ++c) there += was->flat[face[c]] * w[c], on += was->mesh.points[face[c]] * w[c];
      const auto& p = was->mesh.points;
      const Vec3 out = normalized(cross(p[face[1]] - p[face[0]], p[face[2]] - p[face[0]]));
      const double apart = std::clamp(dot(at - on, out), -deepest * kLayersApart, -kLayersApart);
      const Stand& stand = stands.at(was->piece[nearest->place.face]);
      form->space.push_back(stand(there) + normalAt(stand, there) * apart);
    }
    auto piece = std::make_shared<Piece>(old);
    piece->form = std::move(form), piece->pose = Rigid();
    draped.pattern.pieces[id] = std::move(piece);
  }
  return draped;
}

}  // namespace karinui
