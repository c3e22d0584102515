#include "design/pack.h"

#include "design/pack_values.h"

namespace karinui {

std::string packPiece(const Piece& p) {
  Writer w;
  w.add(p.id.value).add(p.name);
  addText(w, p.outline), addText(w, p.holes), addText(w, p.lines), addText(w, p.marks);
  w.add(p.grain).add(p.fabric).add(p.layer).add(static_cast<std::uint8_t>(p.frozen)).add(p.mirrorOf.value);
  w.add(p.pose.w).add(p.pose.x).add(p.pose.y).add(p.pose.z).add(p.pose.carry);
  if (!p.interfacing.empty()) w.add(p.interfacing);  // pieces without are packed as before there was any
  return w.taken();
}

Result<Piece> unpackPiece(std::string_view bytes) {
  Reader r(bytes);
  Piece p;
  p.id.value = r.number<std::uint64_t>();
  p.name = r.text();
  readText(r, p.outline), readText(r, p.holes), readText(r, p.lines), readText(r, p.marks);
  p.grain = r.flat();
  p.fabric = r.text();
  p.layer = r.number<int>();
  p.frozen = r.number<std::uint8_t>() != 0;
  p.mirrorOf.value = r.number<std::uint64_t>();
  p.pose.w = r.number<double>(), p.pose.x = r.number<double>(), p.pose.y = r.number<double>(),
  p.pose.z = r.number<double>();
  p.pose.carry = r.vec3();
  if (r.good() && !r.finished() && (p.interfacing = r.text()).empty()) r.fail();
  if (!r.finished() || !p.id || !checkName(p.name)) return damaged();
  return p;
}

std::string packForm(const Form& form) {
  Writer w;
  w.all(form.flat).all(form.space).all(form.faces);
  return w.taken();
}

Result<std::shared_ptr<const Form>> unpackForm(std::string_view bytes) {
  Reader r(bytes);
  auto form = std::make_shared<Form>();
  form->flat.resize(r.count(16));
  for (Flat& p : form->flat) p = r.flat();
  form->space.resize(r.count(24));
  for (Vec3& p : form->space) p = r.vec3();
  form->faces.resize(r.count(12));
  for (Triangle& t : form->faces) t = r.triangle(form->flat.size());
  if (!r.finished() || form->flat.size() != form->space.size()) return damaged();
  return std::shared_ptr<const Form>(std::move(form));
}

}  // namespace karinui
