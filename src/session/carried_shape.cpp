#include "session/carried_shape.h"

namespace karinui {

namespace {

// The two columns of the map from paper to space, per place: the mean over its faces, by their area on paper.
struct Gradient {
  Vec3 u, v;
  double weight = 0;
};
std::vector<Gradient> gradientsOf(const Form& form) {
  std::vector<Gradient> all(form.flat.size());
  for (const Triangle& t : form.faces) {
    const Flat p = form.flat[t[1]] - form.flat[t[0]], q = form.flat[t[2]] - form.flat[t[0]];
    const Vec3 a = form.space[t[1]] - form.space[t[0]], b = form.space[t[2]] - form.space[t[0]];
    const double area = cross(p, q);
    if (!(area > 0)) continue;
    for (const std::uint32_t n : t) all[n].u += a * q.v - b * p.v, all[n].v += b * p.u - a * q.u, all[n].weight += area;
  }
  return all;
}

std::shared_ptr<const Form> carried(const Form& before, const Form& after) {
  const std::vector<Gradient> gradients = gradientsOf(before);
  auto form = std::make_shared<Form>(after);
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const Flat by = after.flat[i] - before.flat[i];
    const auto& [u, v, weight] = gradients[i];
    if (weight > 0 && !(by == Flat())) form->space[i] += (u * by.u + v * by.v) * (1 / weight);
  }
  return form;
}

}  // namespace

Document carriedAlong(const Document& before, Document after) {
  for (auto& [id, piece] : after.pattern.pieces) {
    const Piece* old = before.find(id);
    if (!old || !old->form || !piece->form || old->form == piece->form) continue;
    if (old->form->flat.size() != piece->form->flat.size() || old->form->faces != piece->form->faces) continue;
    Piece moved = *piece;
    moved.form = carried(*old->form, *piece->form);
    piece = std::make_shared<const Piece>(std::move(moved));
  }
  return after;
}

}  // namespace karinui
