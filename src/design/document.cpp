#include "karinui/design/document.h"

#include <algorithm>

#include "karinui/base/hash.h"

namespace karinui {

Document::Document() = default;
Document::Document(const Document&) = default;
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(const Document&) = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

namespace {

// Numbers are hashed one by one: structs have padding, and padding has no meaning.
struct Truth {
  Hasher hasher;
  void add(std::string_view value) { hasher.add(value); }
  void add(double value) { hasher.add(value == 0 ? 0.0 : value); }  // -0 is 0
  void add(std::uint64_t value) { hasher.add(value); }
  void add(Flat value) { add(value.u), add(value.v); }
  void add(Vec3 value) { add(value.x), add(value.y), add(value.z); }
  template <class Items>
  void each(const Items& items) {
    add(std::uint64_t{items.size()});
    for (const auto& item : items) add(item);
  }
  void add(const Curve& c) {  // what its kind has; the file keeps no more
    const bool cubic = c.kind == Curve::Kind::Cubic;
    add(static_cast<std::uint64_t>(c.kind));
    add(c.start), add(c.end), add(cubic ? c.control1 : Flat{}), add(cubic ? c.control2 : Flat{}), add(c.bulge);
    for (const Flat p : c.between) add(p);
  }
  void add(const Edge& e) { add(e.name), add(e.curve); }
  void add(const Outline& o) { each(o.edges); }
  void add(const InternalLine& l) {
    add(l.name), each(l.curves);
    if (l.crease) add(std::string_view("crease")), add(l.crease->angle), add(l.crease->hold);
  }
  void add(const Mark& m) { add(m.name), add(m.edge), add(m.fraction), add(m.place); }
  void add(const EdgeSpan& s) { add(s.piece.value), add(s.edge), add(s.from), add(s.to); }
  void add(const Piece& p) {
    add(p.id.value), add(p.name), add(p.outline), each(p.holes), each(p.lines), each(p.marks), add(p.grain),
        add(p.fabric);
    add(static_cast<std::uint64_t>(p.layer)), add(std::uint64_t{p.frozen}), add(p.mirrorOf.value);
    if (!p.interfacing.empty()) add(std::string_view("interfacing")), add(p.interfacing);
  }
  void add(const Seam& s) {
    add(s.id.value), add(s.name), each(s.a), each(s.b), add(std::uint64_t{s.reversed}),
        add(static_cast<std::uint64_t>(s.tie));
  }
  void add(const Fastening& f) {
    add(static_cast<std::uint64_t>(f.kind)), each(f.a), each(f.b), add(std::uint64_t{f.reversed}), each(f.at);
    add(std::uint64_t{f.fromStart}), add(static_cast<std::uint64_t>(f.closed)), add(f.zipped), add(f.inset);
    add(f.size), add(f.gap), add(std::uint64_t{f.holesAlong});
  }
  void add(const Dye& d) { add(std::uint64_t{d.red} << 16 | std::uint64_t{d.green} << 8 | d.blue); }
  void add(const Look& l) {
    add(static_cast<std::uint64_t>(l.finish)), add(l.colour), add(static_cast<std::uint64_t>(l.print)), add(l.ink);
    add(l.repeat), add(l.turn), add(l.photo);
    if (l.wrong)
      add(std::string_view("wrong side")), add(l.wrong->colour), add(static_cast<std::uint64_t>(l.wrong->print)),
          add(l.wrong->ink);
  }
  void add(const Underlay& u) {
    add(u.photo), add(static_cast<std::uint64_t>(u.wide)), add(static_cast<std::uint64_t>(u.high));
    add(u.at), add(u.width), add(u.turn), add(u.strength), add(std::uint64_t{u.hidden});
  }
  void add(const Fabric& f) {
    add(f.name), add(static_cast<std::uint64_t>(f.law));
    for (const double v : {f.weight, f.stretchWarp, f.stretchWeft, f.shear, f.bendWarp, f.bendWeft, f.compression,
                           f.toeWarp, f.thickness, f.frictionBody, f.frictionCloth})
      add(v);
    const Fabric plain;  // fabrics of before curves keep their hash
    std::uint64_t which = 0;
    for (const auto& [v, usual] : {std::pair{f.toeWeft, f.toeWarp},
                                   {f.stiffenWarp, plain.stiffenWarp},
                                   {f.stiffenWeft, plain.stiffenWeft},
                                   {f.shearStiffen, plain.shearStiffen}})
      if (++which; v != usual) add(which), add(v);
  }
};

}  // namespace

const Piece* Document::find(PieceId id) const {
  const auto at = pattern.pieces.find(id);
  return at == pattern.pieces.end() ? nullptr : at->second.get();
}

const Piece* Document::pieceNamed(std::string_view name) const {
  for (const auto& [id, piece] : pattern.pieces)
    if (piece->name == name) return piece.get();
  return nullptr;
}

const Seam* Document::find(SeamId id) const {
  const auto at = pattern.seams.find(id);
  return at == pattern.seams.end() ? nullptr : &at->second;
}

std::vector<PieceId> Document::unrested() const {
  std::vector<PieceId> all;
  for (const PieceId id : drape.dirty)
    if (const Piece* piece = find(id); piece && !piece->frozen) all.push_back(id);
  return all;
}

bool Document::atRest() const { return drape.last && drape.last->settled && unrested().empty(); }

std::string hash(const Document& document) {
  Truth truth;
  truth.add(std::string_view("karinui document 1"));
  truth.add(document.body.hash);
  truth.add(std::uint64_t{document.pattern.pieces.size()});
  for (const auto& [id, piece] : document.pattern.pieces) truth.add(*piece);
  truth.add(std::uint64_t{document.pattern.seams.size()});
  for (const auto& [id, seam] : document.pattern.seams) truth.add(seam);
  truth.add(std::uint64_t{document.fabrics.size()});
  for (const auto& [name, fabric] : document.fabrics) truth.add(name), truth.add(fabric);
  truth.add(std::uint64_t{document.pins.size()});
  for (const auto& [id, places] : document.pins) truth.add(id.value), truth.each(places);
  truth.add(document.settings.spacing), truth.add(static_cast<std::uint64_t>(document.settings.collider));
  truth.add(document.settings.ease);
  if (!document.looks.empty()) {  // documents of before they could have one keep their hash
    truth.add(std::string_view("looks"));
    truth.add(std::uint64_t{document.looks.fabrics.size()});
    for (const auto& [name, look] : document.looks.fabrics) truth.add(name), truth.add(look);
    truth.add(std::uint64_t{document.looks.pieces.size()});
    for (const auto& [id, look] : document.looks.pieces) truth.add(id.value), truth.add(look);
  }
  if (!document.variables.empty()) truth.add(std::string_view("variables"));  // documents without keep their hash
  for (const auto& [name, formula] : document.variables) truth.add(name), truth.add(formula);
  if (const Allowances& own = document.allowances; !own.plain()) {  // likewise
    truth.add(std::string_view("allowances"));
    truth.add(std::uint64_t{own.kinds.size()});
    for (const auto& [kind, width] : own.kinds) truth.add(static_cast<std::uint64_t>(kind)), truth.add(width);
    truth.add(std::uint64_t{own.edges.size()});
    for (const auto& [at, width] : own.edges) truth.add(at.first.value), truth.add(at.second), truth.add(width);
    truth.add(std::uint64_t{own.corners.size()});
    for (const auto& [at, kind] : own.corners)
      truth.add(at.first.value), truth.add(at.second), truth.add(static_cast<std::uint64_t>(kind));
  }
  if (!document.allowances.elastics.empty()) truth.add(std::string_view("elastics"));
  for (const auto& [at, own] : document.allowances.elastics)
    truth.add(at.first.value), truth.add(at.second), truth.add(own.ratio), truth.add(own.strength);
  if (!document.allowances.hems.empty()) truth.add(std::string_view("hems"));
  for (const auto& [at, own] : document.allowances.hems)
    truth.add(at.first.value), truth.add(at.second), truth.add(own.width), truth.add(own.under);
  if (const Allowances& own = document.allowances; own.trimmed()) {
    truth.add(std::string_view("trims"));
    const auto at = [&](const auto& edge) { truth.add(edge.first.value), truth.add(edge.second); };
    truth.add(std::uint64_t{own.topstitches.size()});
    for (const auto& [edge, sewn] : own.topstitches) {
      at(edge), truth.add(sewn.offset), truth.add(static_cast<std::uint64_t>(sewn.rows)), truth.add(sewn.apart);
      truth.add(sewn.length), truth.add(std::uint64_t{sewn.colour.value_or(~0u)});
    }
    truth.add(std::uint64_t{own.pipings.size()});
    for (const auto& [edge, sewn] : own.pipings) at(edge), truth.add(sewn.thickness), truth.add(sewn.fabric);
    truth.add(std::uint64_t{own.bindings.size()});
    for (const auto& [edge, sewn] : own.bindings) at(edge), truth.add(sewn.width), truth.add(sewn.fabric);
  }
  if (!document.allowances.fastenings.empty()) truth.add(std::string_view("fastenings"));
  for (const auto& [name, own] : document.allowances.fastenings) truth.add(name), truth.add(own);
  if (!document.cutting.empty()) truth.add(std::string_view("cutting"));
  for (const auto& [id, cutting] : document.cutting)
    truth.add(id.value), truth.add(static_cast<std::uint64_t>(cutting.count)), truth.add(std::uint64_t{cutting.pairs});
  if (!document.eases.empty()) truth.add(std::string_view("eases"));
  for (const auto& [id, ease] : document.eases) truth.add(id.value), truth.add(ease);
  if (const Grading& own = document.grading; !own.empty()) {
    truth.add(std::string_view("sizes"));
    truth.each(own.sizes);
    truth.add(std::uint64_t{own.base}), truth.add(std::uint64_t{own.standing});
    truth.add(std::uint64_t{own.pieces.size()});
    for (const auto& [id, points] : own.pieces) {
      truth.add(id.value), truth.add(std::uint64_t{points.size()});
      for (const GradePoint& point : points) truth.add(point.edge), truth.add(point.at), truth.each(point.by);
    }
  }
  if (!document.looks.shifts.empty()) truth.add(std::string_view("prints placed"));
  for (const auto& [id, shift] : document.looks.shifts) truth.add(id.value), truth.add(shift);
  if (!document.underlays.empty()) truth.add(std::string_view("underlays"));
  for (const auto& [name, underlay] : document.underlays) truth.add(name), truth.add(underlay);
  return truth.hasher.hex();
}

std::string drapeHash(const Document& document) {
  Truth truth;
  truth.add(std::string_view("karinui drape 1"));
  for (const auto& [id, piece] : document.pattern.pieces) {
    truth.add(id.value);
    for (const double v : {piece->pose.w, piece->pose.x, piece->pose.y, piece->pose.z}) truth.add(v);
    truth.add(piece->pose.carry);
    truth.add(std::uint64_t{piece->form != nullptr});
    if (!piece->form) continue;
    truth.each(piece->form->flat);
    truth.each(piece->form->space);
    truth.hasher.add(std::span<const Triangle>(piece->form->faces));
  }
  return truth.hasher.hex();
}

Result<Fabric> fabricNamed(const Document& document, const std::string& name) {
  const auto own = document.fabrics.find(name);
  return own != document.fabrics.end() ? Result<Fabric>(own->second) : preset(name);
}

Result<Fabric> fabricOf(const Document& document, const Piece& piece) {
  auto outer = fabricNamed(document, piece.fabric);
  if (!outer || piece.interfacing.empty()) return outer;
  const auto inner = fabricNamed(document, piece.interfacing);
  return inner ? Result<Fabric>(fused(*outer, *inner)) : inner;
}

Result<std::map<std::string, Fabric>> fabricsInUse(const Document& document) {
  std::map<std::string, Fabric> all;
  for (const auto& [id, piece] : document.pattern.pieces)
    for (const std::string& name : {piece->fabric, piece->interfacing}) {
      if (name.empty() || all.contains(name)) continue;
      auto fabric = fabricNamed(document, name);
      if (!fabric) return fabric.error();
      all.emplace(name, *std::move(fabric));
    }
  const auto strips = [&](const auto& trims) -> Done {
    for (const auto& [at, own] : trims) {
      if (own.fabric.empty() || all.contains(own.fabric)) continue;
      auto fabric = fabricNamed(document, own.fabric);
      if (!fabric) return fabric.error();
      all.emplace(own.fabric, *std::move(fabric));
    }
    return {};
  };
  if (const Done done = strips(document.allowances.pipings); !done) return done.error();
  if (const Done done = strips(document.allowances.bindings); !done) return done.error();
  return all;
}

}  // namespace karinui
