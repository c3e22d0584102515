#include "design/operations/lifted_form.h"

#include "design/operations/new_piece.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

namespace {

// Barycentric coordinates, of a place outside the triangle too.
std::array<double, 3> unbounded(Flat a, Flat b, Flat c, Flat place) {
  const double whole = cross(b - a, c - a);
  const double second = cross(place - a, c - a) / whole, third = cross(b - a, place - a) / whole;
  return {1 - second - third, second, third};
}

}  // namespace

Result<std::shared_ptr<const Form>> liftedForm(const Piece& piece, const Piece& beneath, double spacing,
                                               const std::function<LiftedPlace(Flat)>& over) {
  const auto laid = layAlone(piece, spacing);
  if (!laid) return laid.error();
  auto form = std::make_shared<Form>();
  form->flat = (*laid)->nodes, form->faces = (*laid)->faces;
  if (!beneath.form || beneath.form->faces.empty()) {
    for (const Flat node : form->flat) {
      const LiftedPlace at = over(node);
      form->space.push_back({at.place.u, at.place.v, at.metres});
    }
    return std::shared_ptr<const Form>(std::move(form));
  }
  const std::vector<Vec3>& space = beneath.form->space;
  const std::vector<Flat>& flat = beneath.form->flat;
  const LatticeFinder finder(flat, beneath.form->faces);
  for (const Flat node : form->flat) {
    const LiftedPlace at = over(node);
    LatticePlace in = finder.find(at.place);
    if (at.beyond) in.weight = unbounded(flat[in.face[0]], flat[in.face[1]], flat[in.face[2]], at.place);
    const Vec3 a = space[in.face[0]], b = space[in.face[1]], c = space[in.face[2]], out = cross(b - a, c - a);
    const Vec3 place = a * in.weight[0] + b * in.weight[1] + c * in.weight[2];
    form->space.push_back(length(out) > 0 ? place + normalized(out) * at.metres : place);
  }
  return std::shared_ptr<const Form>(std::move(form));
}

Result<std::set<std::pair<double, double>>> nodesOfSewnLayers(const Piece& piece, double spacing,
                                                              const std::vector<const Seam*>& seams) {
  constexpr double kAtEnd = 1e-6;  // of an edge
  const auto laid = layAlone(piece, spacing);
  if (!laid) return laid.error();
  std::set<std::pair<double, double>> nodes;
  std::vector<EdgeSpan> sewn;
  for (const Seam* seam : seams)
    if (seam->tie == Seam::Tie::Pleat)
      for (const auto* side : {&seam->a, &seam->b}) sewn.insert(sewn.end(), side->begin(), side->end());
  for (const EdgeSpan& span : sewn)
    if (const auto edge = (*laid)->edges.find(span.edge); span.piece == piece.id && edge != (*laid)->edges.end())
      for (std::size_t k = 0; k < edge->second.nodes.size(); ++k) {
        const Flat at = (*laid)->nodes[edge->second.nodes[k]];
        const double fraction = edge->second.fraction[k];
        if (fraction > span.from - kAtEnd && fraction < span.to + kAtEnd) nodes.insert({at.u, at.v});
      }
  return nodes;
}

}  // namespace karinui
