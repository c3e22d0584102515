#include "answers_in_words.h"

#include <algorithm>
#include <numbers>

#include "karinui/base/number.h"
#include "karinui/design/step_words.h"
#include "karinui/design/truing_said.h"
#include "sewn_stretches.h"
#include "word_table.h"

namespace karinui::app {

namespace {

std::string mm(double metres) { return fixed(metres * 1000, 1) + " mm"; }
std::string percent(double share) { return fixed(share * 100, 1) + " %"; }
std::string seconds(double s) { return fixed(s, 1) + " s"; }

std::string sideWords(const Document& document, const std::vector<EdgeSpan>& side) {
  std::string all;
  for (const EdgeSpan& span : side) {
    all += (all.empty() ? "" : " + ") + document.find(span.piece)->name + "." + span.edge;
    if (span.from != 0 || span.to != 1) all += "@" + fixed(span.from, 3) + ":" + fixed(span.to, 3);
  }
  return all + " " + mm(length(document.pattern, side));
}

// What people call it, and what scripts do where that is another word.
std::string withScript(const std::string& words, const std::string& script) {
  return words == script ? words : words + " (" + script + ")";
}

std::string yesOrNo(bool yes, const Console& console) { return console.said(yes ? say("yes") : say("no")); }

// What is caught in with another piece, as a facing, is held by such a seam too, and is not folded.
bool isPleat(const Seam& seam, bool even) {
  return seam.tie == Seam::Tie::Pleat && (!even || std::any_of(seam.b.begin(), seam.b.end(), [&](const EdgeSpan& span) {
           return span.piece == seam.a.front().piece;
         }));
}

}  // namespace

std::string bodyWords(const Measurements& measured, const MeshReport& mesh, const Console& console) {
  WordTable table;
  for (const auto& [key, value] : measured.value)
    table.row({withScript(console.said(identifierSaid(key).value_or(say("{0}", key))), key),
               isAngle(key) ? fixed(value * 180 / std::numbers::pi, 1) + " deg" : mm(value)});
  WordTable surface;
  surface.row({console.said(say("Triangles")), std::to_string(mesh.triangles)});
  surface.row({console.said(say("Closed")), yesOrNo(mesh.closed(), console)});
  surface.row({console.said(say("Crosses itself")), console.said(say("at {0} {0|place|places}", mesh.selfCrossings))});
  surface.row({console.said(say("Separate parts")), std::to_string(mesh.shells)});
  if (mesh.openEdges > 0) surface.row({console.said(say("Open edges")), std::to_string(mesh.openEdges)});
  if (mesh.nonManifoldEdges > 0)
    surface.row({console.said(say("Edges of more than two triangles")), std::to_string(mesh.nonManifoldEdges)});
  return console.said(say("Measured with the tape:")) + "\n" + table.words(2) + console.said(say("The surface:")) +
         "\n" + surface.words(2);
}

Message restSaid(const Document& document) {
  if (!document.drape.last) return say("The garment has not been draped yet; settle brings it to rest.");
  if (!document.drape.last->settled) return *adviceOn(*document.drape.last);
  Message changed;
  for (const PieceId id : document.unrested()) {
    const Message name = nameSaid(document.find(id)->name);
    changed = changed.empty() ? name : say("{0}, {1}", changed, name);
  }
  if (!changed.empty())
    return say("The garment is not at rest: changed since it was draped: {0}. settle brings it to rest.", changed);
  return adviceOn(*document.drape.last).value_or(say("The garment is at rest."));
}

std::string checkWords(const Examination& check, const Document& document, const Console& console) {
  WordTable table;
  const auto named = [&](PieceId id) {
    const Piece* piece = document.find(id);
    return console.said(piece ? nameSaid(piece->name) : say("{0}", text(id)));
  };
  const auto row = [&](const Message& what, const std::string& value) { table.row({console.said(what), value}); };
  if (!check.finite) row(say("Broken: some places of the cloth are no numbers"), "");
  row(say("Deepest inside the body"), mm(check.penetration));
  row(say("Cloth through the body"), console.said(say("at {0} {0|place|places}", check.clothBodyCrossings)));
  row(say("Cloth through cloth"), console.said(say("at {0} {0|place|places}", check.clothClothCrossings)));
  if (check.foldCrossings > 0)
    row(say("Folds closed through themselves, beside a seam or crease"),
        console.said(say("at {0} {0|place|places}", check.foldCrossings)));
  for (const ClothCrossing& c : check.crossings) {
    const Message what =
        c.a == c.b ? say("{0} through itself", named(c.a)) : say("{0} through {1}", named(c.a), named(c.b));
    const Message where =
        say("{0} {0|pair|pairs} of triangles, about {1} cm above the floor", c.pairs, fixed(c.middle.y * 100, 0));
    table.row({"  " + console.said(what), console.said(where)});
  }
  row(say("Widest gap in a seam"), mm(check.seamGap));
  row(say("Stretch, on average"), percent(check.strain.mean));
  row(say("99 % of the cloth is stretched less than"), percent(check.strain.p99));
  row(say("Stretch, at most"), percent(check.strain.max));
  row(say("Points of cloth"), std::to_string(check.vertices));
  for (const ElasticPull& e : check.elastics)
    row(say("Elastic along {0}", named(e.piece) + "." + e.edge),
        console.said(say("pulls with {0} N, cut {1}, drawn out to {2}", fixed(e.pull, 1), mm(e.cut), mm(e.now))));
  for (const FasteningPull& f : check.fastenings) row(fastenerSaid(f), console.said(pulledSaid(f)));
  return console.said(say("The cloth as it stands:")) + "\n" + table.words(2);
}

std::string pressureWords(const PressureReport& pressure, double spacing, const Console& console) {
  constexpr double kCoarse = 0.0205;  // metres: beyond it single points of cloth bear what lies between them
  WordTable table;
  const auto kilo = [](double pascals) { return fixed(pascals / 1000, 2) + " kPa"; };
  table.row({console.said(say("Presses where it lies, on average")), kilo(pressure.mean)});
  table.row({console.said(say("99 % of it presses less than")), kilo(pressure.p99)});
  std::string words = table.words(2);
  if (spacing > kCoarse)
    words +=
        console.said(say("With threads {0} mm apart cloth presses at its single points, and reads several times too "
                         "high: for pressure, set spacing=15mm or less.",
                         spacing * 1000)) +
        "\n";
  return words;
}

std::string settleWords(const Examination& check, const Document& document, bool kept, const Console& console) {
  const SettleReport& report = *document.drape.last;
  const auto advice = adviceOn(report);
  std::string words = console.said(advice ? *advice
                                   : kept ? say("The garment was at rest already; --again drapes it anew.")
                                          : say("The garment is at rest.")) +
                      "\n";
  WordTable table;
  table.row({console.said(say("Draping took")),
             console.said(say("{0} ({1} of processor time, {2} {2|step|steps})", seconds(report.wallSeconds),
                              seconds(report.cpuSeconds), report.steps))});
  table.row({console.said(say("Memory")), fixed(report.peakMegabytes, 0) + " MB"});
  if (report.merged)
    table.row({console.said(say("The body as planes")),
               console.said(say("{0} {0|plane|planes} of {1} {1|triangle|triangles}, {2} of {3} {3|test|tests} saved",
                                report.merged->planesAfter, report.merged->facesBefore, report.merged->testsSaved,
                                report.merged->testsDone + report.merged->testsSaved))});
  return words + table.words(2) + checkWords(check, document, console);
}

std::string infoWords(const Document& document, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  std::string words = said(say("{0} {0|operation|operations}; the cloth's threads lie {1} apart.",
                               static_cast<long long>(document.operations), mm(document.settings.spacing))) +
                      "\n";
  for (const auto& [id, piece] : document.pattern.pieces) {
    double area = piece->outline.area();
    for (const Outline& hole : piece->holes) area -= std::abs(hole.area());
    const bool draped = piece->form && !document.drape.dirty.contains(id);
    words += "\n" +
             said(say("Piece {0} ({1}): {2}, layer {3}; {4} cm2, {5} round; {6}",
                      withScript(said(nameSaid(piece->name)), piece->name), text(id), nameSaid(piece->fabric),
                      piece->layer, fixed(area * 1e4, 1), mm(piece->outline.length()),
                      piece->frozen ? say("frozen")
                      : draped      ? say("draped")
                                    : say("not draped yet"))) +
             "\n";
    WordTable edges;
    for (const Edge& edge : piece->outline.edges)
      edges.row(
          {withScript(said(edgeWithPartnerSaid(document, *piece, edge.name)), edge.name), mm(edge.curve.length())});
    words += edges.words(2);
  }
  if (!document.pattern.seams.empty()) words += "\n" + said(say("Seams:")) + "\n";
  constexpr double kEven = 0.0005;
  WordTable seams;
  for (const auto& [id, seam] : document.pattern.seams) {
    const double ease = easeRatio(document.pattern, seam) - 1;
    seams.row({text(id), seam.name, sideWords(document, seam.a), sideWords(document, seam.b),
               isPleat(seam, ease < kEven)       ? said(say("pleated"))
               : seam.tie == Seam::Tie::TwoToOne ? said(say("gathered, {0} longer", percent(ease)))
               : ease < kEven                    ? said(say("even"))
                                                 : said(say("eased, {0} longer", percent(ease)))});
  }
  words += seams.words(2);
  if (!document.drape.force.empty()) {
    double most = 0;
    for (const Vec3& force : document.drape.force) most = std::max(most, length(force));
    words += "\n" + said(say("The last pull took up to {0} N.", fixed(most, 1))) + "\n";
  }
  return words;
}

std::string pieceWords(const Document& document, const Piece& piece, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  const auto place = [](Flat at) { return fixed(at.u * 100, 2) + "," + fixed(at.v * 100, 2); };
  std::string words =
      said(say("Piece {0} ({1}), places on paper in cm (u,v):", withScript(said(nameSaid(piece.name)), piece.name),
               text(piece.id))) +
      "\n";
  WordTable edges;
  const auto runs = [&](const Outline& outline) {
    for (const Edge& edge : outline.edges)
      edges.row({withScript(said(edgeWithPartnerSaid(document, piece, edge.name)), edge.name),
                 place(edge.curve.start) + "  →  " + place(edge.curve.end), mm(edge.curve.length()),
                 edge.curve.kind == Curve::Kind::Line ? said(say("straight")) : said(say("curved"))});
  };
  runs(piece.outline);
  words += edges.words(2);
  for (std::size_t i = 0; i < piece.holes.size(); ++i) {
    edges = WordTable();
    runs(piece.holes[i]);
    words += said(say("Hole {0}:", i + 1)) + "\n" + edges.words(2);
  }
  WordTable inner;
  for (const InternalLine& line : piece.lines) {
    std::string all = line.curves.empty() ? "" : place(line.curves.front().start);
    for (const Curve& curve : line.curves) all += "  →  " + place(curve.end);
    inner.row({said(nameSaid(line.name)), all, line.crease ? said(say("pressed")) : ""});
  }
  if (!piece.lines.empty()) words += said(say("Lines within:")) + "\n" + inner.words(2);
  WordTable marks;
  for (const Mark& mark : piece.marks) {
    const auto edge = piece.outline.find(mark.edge);
    if (mark.edge.empty() || edge) {
      const Curve* curve = edge ? &piece.outline.edges[*edge].curve : nullptr;
      marks.row({said(nameSaid(mark.name)), mark.edge,
                 place(curve ? curve->at(curve->parameterAt(mark.fraction * curve->length())) : mark.place)});
    }
  }
  if (!piece.marks.empty()) words += said(say("Marks:")) + "\n" + marks.words(2);
  WordTable sewn;
  const auto stretches = sewnStretches(document, piece);
  for (const SewnStretch& one : stretches)
    sewn.row({stretchNamed(one.own), mm(one.length),
              "–  " + document.find(one.other.piece)->name + "." + stretchNamed(one.other)});
  if (!stretches.empty()) words += said(say("Sewn:")) + "\n" + sewn.words(2);
  return words;
}

std::string printWords(const Document& document, const PhotoTall& tall, const Console& console) {
  std::size_t printed = 0;
  for (const auto& [id, seam] : document.pattern.seams) printed += printMeeting(document, seam, tall).has_value();
  if (printed == 0) return {};
  const std::vector<Message> misses = unmatchedSaid(document, tall);
  std::string words =
      console.said(say("The print matches in {0} of {1} {1|seam|seams}.", printed - misses.size(), printed)) + "\n";
  for (const Message& miss : misses) words += "  " + console.said(miss) + "\n";
  return words;
}

std::string truingWords(const Document& document, const TruingReport& report, const Console& console) {
  const std::size_t faults = report.faults();
  std::string words = console.said(report.seams.empty() ? say("Nothing is sewn yet.")
                                   : faults == 0        ? say("All sewn edges fit each other.")
                                                        : say("{0} {0|place does|places do} not fit:", faults)) +
                      "\n";
  for (const Message& fault : faultsSaid(document, report)) words += "  " + console.said(fault) + "\n";
  if (report.seams.empty()) return words;
  words += "\n" + console.said(say("Seams:")) + "\n";
  WordTable seams;
  for (const SeamTruing& seam : report.seams)
    seams.row({text(seam.seam), console.said(seamSaid(document, *document.find(seam.seam))),
               console.said(lengthsSaid(document, seam))});
  return words + seams.words(2);
}

}  // namespace karinui::app
