#include "karinui/session/table_frame_of.h"

#include <algorithm>
#include <array>

#include "karinui/design/piece_label.h"
#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/trims.h"

namespace karinui {

namespace {

constexpr double kChordMiss = 2e-4;  // metres a drawn chord may miss its curve by
constexpr int kSteps = 30;           // of a seam's line along an edge
// Both sides of a seam in one hue; the hues are told apart by most eyes (P. Tol's bright scheme).
constexpr std::array<Colour, 7> kHues{{{0.0578f, 0.1845f, 0.4020f},    // #4477AA
                                       {0.8550f, 0.1329f, 0.1845f},    // #EE6677
                                       {0.0160f, 0.2462f, 0.0331f},    // #228833
                                       {0.4342f, 0.2582f, 0.0060f},    // #B08B12
                                       {0.0232f, 0.3372f, 0.4621f},    // #2A9DB5
                                       {0.4020f, 0.0331f, 0.1845f},    // #AA3377
                                       {0.1845f, 0.1845f, 0.1845f}}};  // #777777

// The pattern as it is shown: with the outlines of a drag.
Pattern shownPattern(const Document& document, const std::map<PieceId, Outline>& outlines) {
  Pattern shown = document.pattern;
  for (const auto& [id, outline] : outlines)
    if (const auto at = shown.pieces.find(id); at != shown.pieces.end()) {
      Piece piece = *at->second;
      piece.outline = outline;
      at->second = std::make_shared<const Piece>(std::move(piece));
    }
  return shown;
}

std::vector<Flat> laid(std::vector<Flat> points, Flat lies) {
  for (Flat& p : points) p += lies;
  return points;
}
TableStroke laid(const PaperStroke& stroke, Flat lies) { return {stroke.from + lies, stroke.to + lies}; }

std::vector<TableEdge> edgesOf(const Outline& outline, Flat lies) {
  std::vector<TableEdge> edges;
  for (const Edge& edge : outline.edges) {
    TableEdge drawn;
    drawn.name = edge.name;
    drawn.points = laid(edge.curve.flattened(kChordMiss), lies);
    drawn.length = edge.curve.length();
    edges.push_back(std::move(drawn));
  }
  return edges;
}

TableEdge* edgeNamed(TablePiece& piece, const std::string& name) {
  const auto in = [&](std::vector<TableEdge>& edges) -> TableEdge* {
    const auto at = std::find_if(edges.begin(), edges.end(), [&](const TableEdge& e) { return e.name == name; });
    return at == edges.end() ? nullptr : &*at;
  };
  if (TableEdge* edge = in(piece.edges)) return edge;
  for (auto& hole : piece.holes)
    if (TableEdge* edge = in(hole)) return edge;
  return nullptr;
}

TablePiece pieceOf(const Pattern& pattern, const Piece& piece, Flat lies) {
  TablePiece drawn;
  drawn.name = piece.name;
  drawn.frozen = piece.frozen;
  drawn.edges = edgesOf(piece.outline, lies);
  for (const Outline& hole : piece.holes) drawn.holes.push_back(edgesOf(hole, lies));
  FlatBox box;
  for (const TableEdge& edge : drawn.edges)
    for (const Flat p : edge.points) box.include(p);
  if (!box.empty()) drawn.low = box.low, drawn.high = box.high;
  for (const InternalLine& line : piece.lines)
    for (const Curve& curve : line.curves) drawn.lines.push_back(laid(curve.flattened(kChordMiss), lies));
  drawn.drills = laid(drillHoles(pattern, piece), lies);
  drawn.drillRadius = kDrillRadius;
  return drawn;
}

void addLabels(TablePiece& drawn, const std::vector<Message>& words, Flat lies, const LetteredPiece& room) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const LetteredPiece::Line& line = room.lines[i];
    drawn.labels.push_back({i == 0 ? TableLabel::Says::Name : TableLabel::Says::Cut, words[i], line.place + lies,
                            line.size, line.upright});
  }
  if (room.grain) drawn.grain = laid(*room.grain, lies);
}

CutFacts factsOf(const Document& document, const AllowancePlan& plan, const Piece& piece, bool faceDown) {
  const auto own = document.cutting.find(piece.id);
  return {own == document.cutting.end() ? Cutting() : own->second,
          plan.onFold(piece),
          faceDown,
          sizeSaid(document),
          {},
          {}};
}

std::vector<std::string> inWords(const std::vector<Message>& lines, Language language) {
  std::vector<std::string> words;
  for (const Message& line : lines) words.push_back(text(line, language));
  return words;
}

// Along one span: points and, from their neighbours, the way into the cloth. A hole is counter-clockwise too: the cloth
// is to its right.
TableSeam::Run runOf(const Piece& piece, const EdgeSpan& span, Flat lies) {
  TableSeam::Run run;
  const Curve* curve = findCurve(piece, span.edge);
  if (!curve) return run;
  run.points = laid(curve->evenly(span.from, span.to, kSteps), lies);
  const double side = piece.outline.find(span.edge) ? 1 : -1;
  const std::size_t last = run.points.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const Flat along = run.points[std::min(i + 1, last)] - run.points[i > 0 ? i - 1 : 0];
    run.inward.push_back(leftOf(normalized(along)) * side);
  }
  return run;
}

// An edge sewn to the next one over all their length closes a wedge.
bool closesDart(const Pattern& pattern, const Seam& seam) {
  if (seam.a.size() != 1 || seam.b.size() != 1 || !seam.reversed || seam.tie == Seam::Tie::Pleat) return false;
  const EdgeSpan &a = seam.a.front(), &b = seam.b.front();
  const auto at = pattern.pieces.find(a.piece);
  if (a.piece != b.piece || at == pattern.pieces.end()) return false;
  const Outline& outline = at->second->outline;
  const auto i = outline.find(a.edge), k = outline.find(b.edge);
  const auto whole = [](const EdgeSpan& span) { return span.from <= 0 && span.to >= 1; };
  const std::size_t count = outline.edges.size();
  return i && k && i != k && whole(a) && whole(b) && ((*i + 1) % count == *k || (*k + 1) % count == *i);
}

TableSeam seamOf(const Pattern& pattern, const Seam& seam, const TableLayout& layout) {
  TableSeam drawn;
  drawn.name = seam.name;
  if (seam.tie == Seam::Tie::Pleat) return drawn;  // an arrow says it
  const SeamSides walk(pattern, seam);
  const SeamSide* const walks[] = {&walk.a, &walk.b};
  for (std::size_t k = 0; k < 2; ++k) {
    for (const EdgeSpan& span : walks[k]->spans())
      drawn.sides[k].runs.push_back(runOf(*pattern.pieces.at(span.piece), span, layout.at(span.piece)));
    if (walks[k]->spans().empty()) continue;
    for (const double fraction : {0.25, 0.3}) {
      const SeamPlace at = walks[k]->at(fraction);
      if (const auto on = borderPlace(pattern, at))
        drawn.sides[k].ticks.push_back({on->place + layout.at(at.piece), -on->outward});
    }
  }
  return drawn;
}

}  // namespace

const LetteredPiece& LetteringRooms::of(const Piece& piece, const std::vector<std::string>& words) {
  Kept& kept = kept_[piece.id];
  if (kept.words != words || kept.grain != piece.grain || kept.outline != piece.outline || kept.holes != piece.holes ||
      kept.lines != piece.lines)
    kept = {piece.outline, piece.holes, piece.lines, piece.grain, words, roomFor(piece, words)};
  return kept.room;
}

const std::vector<LetteredPiece::Line>& LetteringRooms::ofNotes(const Piece& piece,
                                                                const std::vector<WishedNote>& notes,
                                                                const std::vector<std::string>& words,
                                                                const LetteredPiece& lettered,
                                                                const std::vector<Flat>& tags) {
  Noted& kept = noted_[piece.id];
  if (kept.notes != notes || kept.words != words || kept.lettered != lettered.lines || kept.tags != tags ||
      kept.outline != piece.outline || kept.holes != piece.holes || kept.lines != piece.lines)
    kept = {piece.outline, piece.holes,    piece.lines, notes,
            words,         lettered.lines, tags,        roomForNotes(piece, notes, words, lettered, tags)};
  return kept.places;
}

const std::vector<TableSize>& LetteringRooms::nestOf(const Piece& piece, const Grading& grading) {
  Nested& kept = nested_[piece.id];
  const GradePoints& points = grading.pieces.at(piece.id);
  if (kept.outline != piece.outline || kept.points != points || kept.sizes != grading.sizes ||
      kept.standing != grading.standing) {
    kept = {piece.outline, points, grading.sizes, grading.standing, {}};
    for (std::size_t i = 0; i < grading.sizes.size(); ++i)
      if (i != grading.standing)
        if (const auto outline = graded(piece.outline, grading, points, grading.standing, i))
          kept.nest.push_back({grading.sizes[i], outline->flattened(kChordMiss), kHues[i % kHues.size()]});
  }
  return kept.nest;
}

TableFrame tableFrameOf(const GarmentSnapshot& snapshot, const TableLayout& layout, const Selection& chosen,
                        const TableFrameOptions& options, LetteringRooms* rooms) {
  const Document& document = snapshot.document;
  const Pattern pattern = shownPattern(document, options.outlines);
  TableFrame frame;
  for (const auto& [name, stored] : document.underlays) {
    const auto moved = options.underlays.find(name);
    const Underlay& lies = moved == options.underlays.end() ? stored : moved->second;
    if (const auto image = snapshot.scans.find(name); options.scans && !lies.hidden && image != snapshot.scans.end())
      frame.scans.push_back({image->second, lies.at, lies.width, lies.turn, lies.strength});
  }
  const AllowancePlan plan(pattern, document.allowances);
  const std::set<PieceId> faceDown = cutFaceDown(document.pattern, plan, document.cutting);
  struct Lettered {
    std::vector<std::string> words;
    LetteredPiece room;
    std::vector<Flat> tags;
  };
  std::map<PieceId, std::size_t> number;  // in the frame
  std::map<PieceId, Lettered> lettered;
  for (const auto& [id, piece] : pattern.pieces) {
    const Flat lies = layout.at(id);
    TablePiece drawn = pieceOf(pattern, *piece, lies);
    if (auto cut = cutLines(*piece, plan, kChordMiss)) {
      drawn.cut.push_back(laid(std::move(cut->outer), lies));
      for (Ring& hole : cut->holes) drawn.cut.push_back(laid(std::move(hole), lies));
    }
    drawn.lies = lies;
    drawn.chosen = chosen.pieces.contains(id);
    drawn.unsettled = document.drape.dirty.contains(id);
    const Piece& stored = *document.pattern.pieces.at(id);
    if (options.outlines.contains(id)) drawn.before = laid(stored.outline.flattened(kChordMiss), lies);
    const std::vector<Message> lines = labelOf(stored, factsOf(document, plan, stored, faceDown.contains(id)));
    const std::vector<std::string> words = inWords(lines, options.language);
    Lettered& written = lettered[id];
    written = {words, rooms ? rooms->of(stored, words) : roomFor(stored, words), {}};
    addLabels(drawn, lines, lies, written.room);
    if (options.nest && document.grading.pieces.contains(id)) {
      LetteringRooms own;
      for (TableSize size : (rooms ? *rooms : own).nestOf(stored, document.grading)) {
        size.outline = laid(std::move(size.outline), lies);
        drawn.nest.push_back(std::move(size));
      }
    }
    if (const auto pins = document.pins.find(id); pins != document.pins.end())
      for (const Flat pin : pins->second) drawn.pins.push_back(pin + lies);
    if (options.corners)
      for (const Edge& edge : piece->outline.edges) drawn.corners.push_back(edge.curve.start + lies);
    number[id] = frame.pieces.size();
    frame.pieces.push_back(std::move(drawn));
  }
  for (std::size_t k = 0; k < snapshot.worn.size() && k < snapshot.frame.cloths.size(); ++k)
    if (const auto at = number.find(snapshot.worn[k].id); at != number.end())
      frame.pieces[at->second].colour = snapshot.frame.cloths[k].colour,
      frame.pieces[at->second].look = snapshot.frame.cloths[k].look;

  std::map<std::pair<PieceId, std::string>, double> sewn;  // share of an edge
  for (const auto& [id, seam] : pattern.seams) {
    TableSeam drawn = seamOf(pattern, seam, layout);
    drawn.colour = kHues[frame.seams.size() % kHues.size()];
    drawn.chosen = chosen.seam == id;
    const bool dart = closesDart(pattern, seam);
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) {
        const auto at = number.find(span.piece);
        TableEdge* edge = at == number.end() ? nullptr : edgeNamed(frame.pieces[at->second], span.edge);
        if (!edge) continue;
        const double share = sewn[{span.piece, span.edge}] += span.to - span.from;
        edge->state = share > 1 - 1e-6 ? TableEdge::State::Sewn : TableEdge::State::PartlySewn;
        if (!edge->seam) edge->seam = frame.seams.size();
        edge->dart = edge->dart || dart;
      }
    frame.seams.push_back(std::move(drawn));
  }
  std::vector<NotchPlace> notches = notchPlaces(pattern);
  for (const NotchPlace& notch : finishNotches(pattern, document.allowances)) notches.push_back(notch);
  for (const NotchPlace& notch : notches)
    frame.pieces[number.at(notch.piece)].notches.push_back({laid(strokeOf(notch), layout.at(notch.piece)), notch.own});
  for (const PaperArrow& arrow : pleatArrows(pattern))
    for (const PaperStroke& stroke : {arrow.shaft, arrow.head, arrow.otherHead})
      frame.pieces[number.at(arrow.piece)].notches.push_back({laid(stroke, layout.at(arrow.piece)), false});
  for (const PaperFastener& fastener : fastenersOf(pattern, document.allowances.fastenings))
    for (const PaperStroke& stroke : fastener.strokes)
      frame.pieces[number.at(fastener.piece)].notches.push_back({laid(stroke, layout.at(fastener.piece)), false});
  for (const StitchRow& row : stitchRows(pattern, document.allowances))
    frame.pieces[number.at(row.piece)].stitches.push_back(laid(row.points, layout.at(row.piece)));
  for (const TrimRun& run : trimRuns(pattern, document.allowances)) {
    const Flat lies = layout.at(run.piece);
    frame.pieces[number.at(run.piece)].trims.push_back({laid(run.edgewise, lies), laid(run.inside, lies)});
  }
  for (const SeamTag& tag : seamTags(pattern)) {
    lettered[tag.piece].tags.push_back(tag.place);
    frame.pieces[number.at(tag.piece)].labels.push_back({TableLabel::Says::SeamNumber,
                                                         Message{std::to_string(tag.number), {}},
                                                         tag.place + layout.at(tag.piece), kSeamTagSize, true});
  }
  std::map<PieceId, std::vector<PaperNote>> notes;
  for (PaperNote& note : notesOf(pattern, document.allowances)) notes[note.piece].push_back(std::move(note));
  LetteringRooms passing;
  for (const auto& [id, own] : notes) {
    const Lettered& written = lettered.at(id);
    std::vector<WishedNote> wished;
    for (const PaperNote& note : own)
      wished.push_back({text(note.words, options.language), {note.place, kNoteSize, note.upright}});
    const auto& places =
        (rooms ? *rooms : passing).ofNotes(*pattern.pieces.at(id), wished, written.words, written.room, written.tags);
    for (std::size_t k = 0; k < own.size(); ++k)
      frame.pieces[number.at(id)].labels.push_back(
          {TableLabel::Says::Note, own[k].words, places[k].place + layout.at(id), places[k].size, places[k].upright});
  }
  for (const EdgeRef& one : chosen.edges())
    if (const auto at = number.find(one.piece.id); at != number.end())
      if (TableEdge* edge = edgeNamed(frame.pieces[at->second], one.edge)) edge->chosen = true;
  return frame;
}

}  // namespace karinui
