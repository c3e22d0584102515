#include "fabric_values.h"
#include "karinui/exchange/pattern_json.h"
#include "names.h"
#include "strict_json.h"

namespace karinui {
namespace {

Json of(Flat p) { return Json::array({p.u, p.v}); }
Json of(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

Json of(const Curve& curve) {
  Json out;
  switch (curve.kind) {
    case Curve::Kind::Line:
      out["kind"] = "line";
      break;
    case Curve::Kind::Cubic:
      out["kind"] = "cubic";
      break;
    case Curve::Kind::Arc:
      out["kind"] = "arc";
      break;
  }
  out["start"] = of(curve.start);
  if (curve.kind == Curve::Kind::Cubic) {  // all that lies between start and end: of a chain its joints too
    out["controls"] = Json::array({of(curve.control1)});
    for (const Flat p : curve.between) out["controls"].push_back(of(p));
    out["controls"].push_back(of(curve.control2));
  }
  if (curve.kind == Curve::Kind::Arc) out["bulge"] = curve.bulge;
  out["end"] = of(curve.end);
  return out;
}

Json of(const Outline& outline) {
  Json out = Json::array();
  for (const Edge& edge : outline.edges) {
    Json written{{"name", edge.name}};
    written.update(of(edge.curve));
    out.push_back(std::move(written));
  }
  return out;
}

Json of(const Form& form) {
  Json flat = Json::array(), space = Json::array(), faces = Json::array();
  for (const Flat p : form.flat) flat.push_back(of(p));
  for (const Vec3 p : form.space) space.push_back(of(p));
  for (const Triangle& face : form.faces) faces.push_back(Json::array({face[0], face[1], face[2]}));
  return {{"flat", flat}, {"space", space}, {"faces", faces}};
}

Json of(const Piece& piece) {
  Json out;
  out["id"] = piece.id.value;
  out["name"] = piece.name;
  out["fabric"] = piece.fabric;
  out["layer"] = piece.layer;
  out["frozen"] = piece.frozen;
  if (piece.mirrorOf) out["mirror_of"] = piece.mirrorOf.value;
  out["grain"] = of(piece.grain);
  out["pose"] = {{"turn", Json::array({piece.pose.w, piece.pose.x, piece.pose.y, piece.pose.z})},
                 {"carry", of(piece.pose.carry)}};
  out["outline"] = of(piece.outline);
  out["holes"] = Json::array();
  for (const Outline& hole : piece.holes) out["holes"].push_back(of(hole));
  out["lines"] = Json::array();
  for (const InternalLine& line : piece.lines) {
    Json curves = Json::array();
    for (const Curve& curve : line.curves) curves.push_back(of(curve));
    out["lines"].push_back({{"name", line.name}, {"curves", curves}});
  }
  out["marks"] = Json::array();
  for (const Mark& mark : piece.marks) {
    if (mark.edge.empty())
      out["marks"].push_back({{"name", mark.name}, {"place", of(mark.place)}});
    else
      out["marks"].push_back({{"name", mark.name}, {"edge", mark.edge}, {"fraction", mark.fraction}});
  }
  if (piece.form) out["form"] = of(*piece.form);
  return out;
}

Json of(const Fabric& fabric) {
  Json out{{"name", fabric.name}, {"law", lawName(fabric.law)}};
  eachFabricValue(fabric, [&](const char* name, double value) { out[name] = value; });
  return out;
}

Json of(const std::vector<EdgeSpan>& side) {
  Json out = Json::array();
  for (const EdgeSpan& span : side)
    out.push_back({{"piece", span.piece.value}, {"edge", span.edge}, {"from", span.from}, {"to", span.to}});
  return out;
}

Json of(const Seam& seam) {
  return {{"id", seam.id.value}, {"name", seam.name},         {"a", of(seam.a)},
          {"b", of(seam.b)},     {"reversed", seam.reversed}, {"tie", tieName(seam.tie)}};
}

}  // namespace

std::string writePatternJson(const Pattern& pattern, const AllowancePlan* allowances,
                             const std::map<std::string, Fabric>& fabrics) {
  Json root{{"format", "karinui-pattern-1"}, {"units", "m"}, {"pieces", Json::array()}, {"seams", Json::array()}};
  for (const auto& [id, piece] : pattern.pieces) {
    Json written = of(*piece);
    if (allowances) {
      Json& widths = written["allowances"] = Json::object();
      const auto add = [&, owner = id](const Outline& outline) {
        for (const Edge& edge : outline.edges) widths[edge.name] = allowances->width(owner, edge.name);
      };
      add(piece->outline);
      for (const Outline& hole : piece->holes) add(hole);
    }
    root["pieces"].push_back(std::move(written));
  }
  for (const auto& [id, seam] : pattern.seams) root["seams"].push_back(of(seam));
  for (const Fabric* fabric : fabricsOf(pattern, fabrics)) root["fabrics"].push_back(of(*fabric));
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace karinui
