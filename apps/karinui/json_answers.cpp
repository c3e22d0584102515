#include "json_answers.h"

#include <algorithm>

#include "karinui/design/script.h"
#include "sewn_stretches.h"

namespace karinui::app {

Json bodyJson(const Measurements& measured, const MeshReport& mesh) {
  Json measurements = Json::object();
  for (const auto& [key, metres] : measured.value) measurements[key] = metres;
  return {{"measurements", measurements},
          {"triangles", mesh.triangles},
          {"closed", mesh.closed()},
          {"self_crossings", mesh.selfCrossings},
          {"shells", mesh.shells},
          {"open_edges", mesh.openEdges},
          {"non_manifold_edges", mesh.nonManifoldEdges}};
}

Json checkJson(const Examination& check) {
  Json elastics = Json::array();
  for (const ElasticPull& e : check.elastics)
    elastics.push_back(
        {{"piece", text(e.piece)}, {"edge", e.edge}, {"cut_m", e.cut}, {"now_m", e.now}, {"pull_n", e.pull}});
  Json object = {{"finite", check.finite},
                 {"penetration_mm", check.penetration * 1000},
                 {"cloth_body_crossings", check.clothBodyCrossings},
                 {"cloth_cloth_crossings", check.clothClothCrossings},
                 {"fold_crossings", check.foldCrossings},
                 {"seam_gap_mm", check.seamGap * 1000},
                 {"strain_mean", check.strain.mean},
                 {"strain_p99", check.strain.p99},
                 {"strain_max", check.strain.max},
                 {"vertices", check.vertices}};
  if (!elastics.empty()) object["elastics"] = elastics;
  for (const ClothCrossing& c : check.crossings)
    object["crossings"].push_back(
        {{"pieces", {text(c.a), text(c.b)}}, {"pairs", c.pairs}, {"middle_m", {c.middle.x, c.middle.y, c.middle.z}}});
  for (const FasteningPull& f : check.fastenings) {
    Json one = {{"name", f.name}, {"gap_mm", f.gap * 1000}, {"pull_n", f.force}, {"holds", f.holds()}};
    if (f.number > 0) one["number"] = f.number;
    if (f.length > 0) one["length_m"] = f.length;
    object["fastenings"].push_back(std::move(one));
  }
  return object;
}

Json checkJson(const Examination& check, const Document& document, const Console& console) {
  Json object = Json::object();
  if (const auto& last = document.drape.last)
    object["settled"] = last->settled, object["why"] = console.said(last->why);
  object["at_rest"] = document.atRest();
  object.update(checkJson(check));
  return object;
}

Json restJson(const Document& document, bool settled) {
  Json object = {{"at_rest", document.atRest()}};
  if (document.drape.last) object["settled"] = settled;
  return object;
}

Json settleJson(const SettleReport& report, const Examination& check, const Console& console) {
  Json object = {{"settled", report.settled},    {"why", console.said(report.why)}, {"residual", report.residual},
                 {"steps", report.steps},        {"solves", report.solves},         {"cpu_s", report.cpuSeconds},
                 {"wall_s", report.wallSeconds}, {"peak_mb", report.peakMegabytes}};
  if (report.merged) {
    object["body_faces"] = report.merged->facesBefore;
    object["planes"] = report.merged->planesAfter;
    object["plane_tests"] = report.merged->testsDone;
    object["plane_tests_saved"] = report.merged->testsSaved;
  }
  object.update(checkJson(check));
  return object;
}

Json continuationJson(const SettleReport& report) {
  const Continuation& more = *report.continuation;
  return {{"settled", more.settled},
          {"steps", more.steps},
          {"solves", more.solves},
          {"max_mm", more.max * 1000},
          {"p99_mm", more.p99 * 1000},
          {"p95_mm", more.p95 * 1000},
          {"rms_mm", more.rms * 1000},
          {"lower_uj", (report.energy[report.fineSteps - 1].joules - report.energy.back().joules) * 1e6}};
}

Json stepJson(const Step& step, const Document& after) {
  Json object = {
      {"operation", withShortLengths(text(step.operation))}, {"operations", after.operations}, {"hash", step.after}};
  if (std::holds_alternative<PullCloth>(step.operation)) {
    double most = 0;
    for (const Vec3& force : after.drape.force) most = std::max(most, length(force));
    object["max_force_n"] = most;
  }
  return object;
}

Json fitJson(const std::vector<Girths>& girths, const std::optional<PressureReport>& pressure) {
  Json levels = Json::object();
  for (const Girths& g : girths) {
    std::string key = text(g.name);  // "under bust"
    std::replace(key.begin(), key.end(), ' ', '_');
    levels[key] = {
        {"height_m", g.height}, {"body_m", g.body}, {"garment_m", g.garment}, {"ease_m", g.garment - g.body}};
  }
  Json object = {{"girths", levels}};
  if (pressure) object["pressure_mean_pa"] = pressure->mean, object["pressure_p99_pa"] = pressure->p99;
  return object;
}

Json infoJson(const Document& document) {
  Json pieces = Json::array();
  for (const auto& [id, piece] : document.pattern.pieces) {
    Json edges = Json::array();
    for (const Edge& edge : piece->outline.edges) {
      edges.push_back({{"name", edge.name}, {"length_m", edge.curve.length()}});
    }
    double area = piece->outline.area();
    for (const Outline& hole : piece->holes) area -= std::abs(hole.area());
    pieces.push_back({{"id", text(id)},
                      {"name", piece->name},
                      {"area_m2", area},
                      {"perimeter_m", piece->outline.length()},
                      {"edges", edges},
                      {"fabric", piece->fabric},
                      {"layer", piece->layer},
                      {"frozen", piece->frozen},
                      {"draped", piece->form != nullptr && !document.drape.dirty.contains(id)}});
  }
  Json seams = Json::array();
  const auto side = [&](const std::vector<EdgeSpan>& spans) {
    Json list = Json::array();
    for (const EdgeSpan& span : spans) {
      list.push_back(
          {{"piece", document.find(span.piece)->name}, {"edge", span.edge}, {"from", span.from}, {"to", span.to}});
    }
    return list;
  };
  for (const auto& [id, seam] : document.pattern.seams) {
    seams.push_back({{"id", text(id)},
                     {"name", seam.name},
                     {"a", side(seam.a)},
                     {"b", side(seam.b)},
                     {"length_a_m", length(document.pattern, seam.a)},
                     {"length_b_m", length(document.pattern, seam.b)},
                     {"ratio", easeRatio(document.pattern, seam)},
                     {"tie", tieName(seam.tie)}});
  }
  Json object = {{"pieces", pieces},
                 {"seams", seams},
                 {"operations", document.operations},
                 {"hash", hash(document)},
                 {"drape_hash", drapeHash(document)},
                 {"spacing_m", document.settings.spacing}};
  if (!document.drape.force.empty()) {
    Json force = Json::array();
    for (const Vec3& f : document.drape.force) force.push_back({f.x, f.y, f.z});
    object["pull_force_n"] = force;
  }
  return object;
}

Json pieceJson(const Document& document, const Piece& piece) {
  const auto place = [](Flat at) { return Json{at.u, at.v}; };
  const auto edgesOf = [&](const Outline& outline) {
    Json edges = Json::array();
    for (const Edge& edge : outline.edges)
      edges.push_back({{"name", edge.name},
                       {"from_m", place(edge.curve.start)},
                       {"to_m", place(edge.curve.end)},
                       {"length_m", edge.curve.length()},
                       {"straight", edge.curve.kind == Curve::Kind::Line}});
    return edges;
  };
  Json holes = Json::array(), lines = Json::array(), marks = Json::array();
  for (const Outline& hole : piece.holes) holes.push_back(edgesOf(hole));
  for (const InternalLine& line : piece.lines) {
    Json places = Json::array();
    for (const Curve& curve : line.curves) {
      if (places.empty()) places.push_back(place(curve.start));
      places.push_back(place(curve.end));
    }
    lines.push_back({{"name", line.name}, {"places_m", places}, {"pressed", line.crease.has_value()}});
  }
  for (const Mark& mark : piece.marks) {
    Json one = {{"name", mark.name}};
    if (mark.edge.empty())
      one["place_m"] = place(mark.place);
    else
      one["edge"] = mark.edge, one["fraction"] = mark.fraction;
    marks.push_back(std::move(one));
  }
  Json sewn = Json::array();
  for (const SewnStretch& one : sewnStretches(document, piece))
    sewn.push_back({{"edge", one.own.edge},
                    {"from", one.own.from},
                    {"to", one.own.to},
                    {"length_m", one.length},
                    {"seam", text(one.seam)},
                    {"other", document.find(one.other.piece)->name + "." + stretchNamed(one.other)}});
  return {{"id", text(piece.id)}, {"name", piece.name}, {"edges", edgesOf(piece.outline)},
          {"holes", holes},       {"lines", lines},     {"marks", marks},
          {"sewn", sewn}};
}

Json printsJson(const Document& document, const PhotoTall& tall) {
  Json seams = Json::array();
  for (const auto& [id, seam] : document.pattern.seams)
    if (const auto meets = printMeeting(document, seam, tall))
      seams.push_back({{"id", text(id)},
                       {"name", seam.name},
                       {"misses_m", meets->most},
                       {"at", meets->at},
                       {"matches", meets->most < kPrintMeets}});
  return seams;
}

Json truingJson(const Document& document, const TruingReport& report) {
  Json seams = Json::array(), corners = Json::array();
  for (const SeamTruing& seam : report.seams)
    seams.push_back({{"id", text(seam.seam)},
                     {"name", document.find(seam.seam)->name},
                     {"length_a_m", seam.a},
                     {"length_b_m", seam.b},
                     {"ease_m", seam.ease},
                     {"gathered", seam.gathered},
                     {"off_m", seam.off()},
                     {"fits", seam.fits()}});
  const auto side = [&](const CornerTruing::Side& at) {
    return Json{{"piece", document.find(at.piece)->name},
                {"edge", at.edge},
                {"place_m", {at.place.u, at.place.v}},
                {"angle_deg", at.angle}};
  };
  for (const CornerTruing& corner : report.corners)
    corners.push_back({{"seam", text(corner.seam)},
                       {"a", side(corner.a)},
                       {"b", side(corner.b)},
                       {"off_deg", corner.off()},
                       {"smooth", corner.smooth()}});
  return {{"faults", report.faults()}, {"seams", seams}, {"corners", corners}};
}

std::string words(const Json& object, int indent) {
  std::string lines;
  for (const auto& [key, value] : object.items()) {
    lines += std::string(indent, ' ');
    if (object.is_object()) lines += key + ": ";
    if (value.is_structured()) {
      lines += "\n" + words(value, indent + 2);
    } else {
      lines += (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
    }
  }
  return lines;
}

}  // namespace karinui::app
