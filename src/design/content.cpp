#include "design/content.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kFar = 1000;  // metres from the origin: no garment is there

bool near(Flat p) { return finite(p) && std::abs(p.u) <= kFar && std::abs(p.v) <= kFar; }
bool near(Vec3 p) { return finite(p) && std::abs(p.x) <= kFar && std::abs(p.y) <= kFar && std::abs(p.z) <= kFar; }

bool sound(const Outline& outline) { return checked(outline) && outline.area() > 0; }

bool sound(const InternalLine& line) {
  return (!line.crease || line.crease->sound()) &&
         std::all_of(line.curves.begin(), line.curves.end(), [](const Curve& c) {
           return near(c.start) && near(c.end) && near(c.control1) && near(c.control2) && std::abs(c.bulge) < kFar &&
                  std::all_of(c.between.begin(), c.between.end(), [](Flat p) { return near(p); });
         });
}

bool sound(const Rigid& pose) {
  const double turn = pose.w * pose.w + pose.x * pose.x + pose.y * pose.y + pose.z * pose.z;
  return std::abs(turn - 1) < 1e-6 && near(pose.carry);
}

bool edgesHaveOneNameEach(const Piece& piece) {
  std::set<std::string> names;
  const auto add = [&](const Outline& outline) {
    return std::all_of(outline.edges.begin(), outline.edges.end(),
                       [&](const Edge& e) { return names.insert(e.name).second; });
  };
  return add(piece.outline) && std::all_of(piece.holes.begin(), piece.holes.end(), add);
}

bool sound(const Document& document, const Piece& piece) {
  const auto mark = [&](const Mark& m) {
    return near(m.place) && m.fraction >= 0 && m.fraction <= 1 && (m.edge.empty() || findEdge(piece, m.edge));
  };
  return checkName(piece.name) && document.pieceNamed(piece.name) == &piece && sound(piece.outline) &&
         std::all_of(piece.holes.begin(), piece.holes.end(), [](const Outline& hole) { return sound(hole); }) &&
         edgesHaveOneNameEach(piece) &&
         std::all_of(piece.lines.begin(), piece.lines.end(), [](const InternalLine& l) { return sound(l); }) &&
         std::all_of(piece.marks.begin(), piece.marks.end(), mark) && std::abs(length(piece.grain) - 1) < 1e-6 &&
         fabricOf(document, piece) && (piece.interfacing.empty() || fabricNamed(document, piece.interfacing)) &&
         piece.layer >= 0 && piece.layer <= 20 && sound(piece.pose) && (!piece.form || soundForm(*piece.form));
}

bool sound(const Document& document, const std::vector<EdgeSpan>& side) {
  return !side.empty() && std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
    const Piece* piece = document.find(span.piece);
    return piece && findCurve(*piece, span.edge) && span.from >= 0 && span.from < span.to && span.to <= 1;
  });
}

template <class Value>
bool edgesThere(const Document& document, const std::map<Allowances::At, Value>& all) {
  return std::all_of(all.begin(), all.end(), [&](const auto& own) {
    const Piece* piece = document.find(own.first.first);
    if constexpr (kOnLinesToo<Value>) return piece && findCurve(*piece, own.first.second);
    return piece && findEdge(*piece, own.first.second);
  });
}

bool finishesThere(const Document& document) {
  bool all = true;
  const auto known = [&](const std::string& fabric) { return fabric.empty() || fabricNamed(document, fabric); };
  Allowances::eachFinish(document.allowances, [&](const auto& finishes) {
    all = all && edgesThere(document, finishes);
    if constexpr (requires { finishes.begin()->second.fabric; })
      for (const auto& [at, own] : finishes) all = all && known(own.fabric);
  });
  return all;
}

bool sound(const Document& document, const Grading& grading) {
  const auto point = [&](const Piece& piece, const GradePoint& p) {
    return piece.outline.find(p.edge) && p.at >= 0 && p.at < 1 && p.by.size() == grading.sizes.size() &&
           length(p.by[grading.base]) == 0 && std::all_of(p.by.begin(), p.by.end(), [](Flat by) { return near(by); });
  };
  return grading.empty() || (grading.sizes.size() <= kMostSizes && grading.base < grading.sizes.size() &&
                             grading.standing < grading.sizes.size() &&
                             std::all_of(grading.pieces.begin(), grading.pieces.end(), [&](const auto& own) {
                               const Piece* piece = document.find(own.first);
                               return piece && std::all_of(own.second.begin(), own.second.end(),
                                                           [&](const GradePoint& p) { return point(*piece, p); });
                             }));
}

}  // namespace

bool soundForm(const Form& form) {
  return !form.faces.empty() && form.flat.size() == form.space.size() &&
         std::all_of(form.flat.begin(), form.flat.end(), [](Flat p) { return near(p); }) &&
         std::all_of(form.space.begin(), form.space.end(), [](Vec3 p) { return near(p); });
}

bool soundContent(const Document& document) {
  const auto& [pieces, seams] = document.pattern;
  return std::all_of(pieces.begin(), pieces.end(), [&](const auto& p) { return sound(document, *p.second); }) &&
         std::all_of(seams.begin(), seams.end(),
                     [&](const auto& s) { return sound(document, s.second.a) && sound(document, s.second.b); }) &&
         std::all_of(document.pins.begin(), document.pins.end(),
                     [&](const auto& pinned) {
                       return document.find(pinned.first) &&
                              std::all_of(pinned.second.begin(), pinned.second.end(), [](Flat p) { return near(p); });
                     }) &&
         edgesThere(document, document.allowances.edges) && edgesThere(document, document.allowances.corners) &&
         finishesThere(document) &&
         std::all_of(document.allowances.fastenings.begin(), document.allowances.fastenings.end(),
                     [&](const auto& own) {
                       return checkName(own.first) && sound(document, own.second.a) && sound(document, own.second.b);
                     }) &&
         std::all_of(document.cutting.begin(), document.cutting.end(),
                     [&](const auto& own) { return document.find(own.first); }) &&
         std::all_of(document.underlays.begin(), document.underlays.end(),
                     [](const auto& own) { return checkName(own.first) && checkUnderlay(own.second); }) &&
         std::all_of(document.looks.pieces.begin(), document.looks.pieces.end(),
                     [&](const auto& own) { return document.find(own.first); }) &&
         std::all_of(document.looks.shifts.begin(), document.looks.shifts.end(),
                     [&](const auto& own) { return document.find(own.first) && near(own.second); }) &&
         std::all_of(document.drape.dirty.begin(), document.drape.dirty.end(),
                     [&](PieceId id) { return document.find(id); }) &&
         std::all_of(document.eases.begin(), document.eases.end(),
                     [&](const auto& own) { return document.find(own.first); }) &&
         sound(document, document.grading) && document.settings.spacing >= 0.002 && document.settings.spacing <= 0.05 &&
         document.settings.ease >= 0 && document.settings.ease <= 0.5;
}

}  // namespace karinui
