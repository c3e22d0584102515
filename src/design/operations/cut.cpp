#include <algorithm>
#include <cmath>
#include <functional>

#include "design/operations/operations.h"
#include "design/operations/sewn_runs.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/pleats.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

constexpr std::size_t kMostPlaces = 10000;
constexpr double kAlike = 1e-3;  // by how much of their size halves that are meant to be alike may differ

// How many ids of the step are taken.
struct Minted {
  std::uint32_t pieces = 0, seams = 0;
};

// Pins stay in the cloth they are in: those beyond the cut go over to the piece that has it.
void sharePins(Document& document, const std::vector<Piece>& parts) {
  const auto at = document.pins.find(parts.front().id);
  if (at == document.pins.end()) return;
  const std::vector<Flat> pins = std::move(at->second);
  document.pins.erase(at);
  std::vector<Ring> rings;
  for (const Piece& part : parts) rings.push_back(part.outline.flattened(1e-4));
  for (const Flat pin : pins) {
    const auto away = [&](const Ring& ring) { return contains(ring, pin) ? 0.0 : distanceToRing(ring, pin); };
    const auto nearest =
        std::min_element(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) { return away(a) < away(b); });
    document.pins[parts[static_cast<std::size_t>(nearest - rings.begin())].id].push_back(pin);
  }
}

std::vector<EdgeRef> named(const Document& document, std::vector<EdgeRef> edges) {
  for (EdgeRef& edge : edges) {
    const PieceId id = edge.piece.id;
    edge.piece = PieceRef();
    edge.piece.name = document.find(id)->name;
  }
  return edges;
}

// A dart that was cut across has a seam for each part. Where the cut went through its mouth's side, the parts beside it
// can be made one: that is offered.
void divideDarts(const Document& before, Document& after, const std::vector<CutDart>& darts, Minted& minted,
                 const Context& context) {
  std::map<PieceId, int> beside;  // how many of the darts a part lies beside
  for (const CutDart& dart : darts)
    for (const Seam& part : dividedDart(after.pattern.seams.at(dart.seam), dart.turned))
      if (part.a.front().piece != part.b.front().piece) ++beside[part.a.front().piece], ++beside[part.b.front().piece];
  // The part between two darts stays, so that the advice about the second still names what is there; else the larger.
  const auto rank = [&](const Piece& piece) { return std::pair(beside[piece.id], piece.outline.area()); };
  for (const CutDart& dart : darts) {
    const double whole = length(after.pattern, after.pattern.seams.at(dart.seam).a);
    std::vector<Seam> parts = dividedDart(after.pattern.seams.at(dart.seam), dart.turned);
    const auto ease = before.eases.find(dart.seam);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      Seam& part = parts[k];
      if (k > 0) part.id = mint<SeamId>(before, minted.seams++), part.name.clear();
      if (ease != before.eases.end()) after.eases[part.id] = ease->second * length(after.pattern, part.a) / whole;
      const Piece &a = *after.find(part.a.front().piece), &b = *after.find(part.b.front().piece);
      if (context.advise && a.id != b.id) {
        MergePieces merge;
        merge.a = named(after, refsOf(part.a)), merge.b = named(after, refsOf(part.b));
        if (rank(a) < rank(b)) std::swap(merge.a, merge.b);
        Advice advice{say("“{0}” and “{1}” are sewn along the dart; merged, they are one piece with the dart closed.",
                          a.name, b.name)};
        advice.piece = a.id, advice.edge = part.a.front().edge;
        advice.mend = std::move(merge);
        context.advise(advice);
      }
      after.pattern.seams[part.id] = std::move(part);
    }
  }
}

// What a piece falls into; the first part keeps its id.
struct Cut {
  Document after;
  std::vector<PieceId> parts;
};

// Names the edges of each part as those of the part of which it is the image, and has the parts in the same order; of
// parts of one size either may have come first.
void arrangeLike(CutPieces& cut, const std::vector<const Piece*>& likewise) {
  std::map<PieceId, PieceId> places;  // of which part each takes the place
  for (Piece& part : cut.pieces)
    for (std::size_t k = 0; k < likewise.size() && k < cut.pieces.size(); ++k)
      if (nameLikeImage(part, cut.edges, *likewise[k])) {
        places[part.id] = cut.pieces[k].id;
        break;
      }
  std::map<PieceId, std::string> names;
  for (const Piece& part : cut.pieces) names[part.id] = part.name;
  std::set<PieceId> taken;
  for (const auto& [part, place] : places) taken.insert(place);
  if (taken.size() != cut.pieces.size()) return;
  // Edges that stayed as they were are not listed; they may have to be found on another piece now.
  std::set<std::pair<PieceId, std::string>> listed;
  for (const auto& [edge, parts] : cut.edges)
    for (const EdgePart& part : parts) listed.emplace(part.now.piece, part.now.edge);
  const auto list = [&](PieceId part, const Outline& outline) {
    for (const Edge& edge : outline.edges)
      if (!listed.contains({part, edge.name})) cut.edges[{part, edge.name}] = {{0, 1, {part, edge.name, 0, 1}}};
  };
  for (const Piece& part : cut.pieces) {
    if (places.at(part.id) == part.id) continue;
    list(part.id, part.outline);
    for (const Outline& hole : part.holes) list(part.id, hole);
  }
  for (Piece& part : cut.pieces) part.id = places.at(part.id), part.name = names.at(part.id);
  for (auto& [edge, parts] : cut.edges)
    for (EdgePart& part : parts)
      if (const auto place = places.find(part.now.piece); place != places.end()) part.now.piece = place->second;
  std::sort(cut.pieces.begin(), cut.pieces.end(), [](const Piece& a, const Piece& b) { return a.id < b.id; });
}

// Whether a line leads across a piece: of one that was divided a single part has it.
bool liesOn(const std::vector<Flat>& line, const Piece& piece) {
  constexpr int kSteps = 16;
  const Ring ring = piece.outline.flattened(1e-4);
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    for (int n = 1; n < kSteps; ++n)
      if (contains(ring, lerp(line[k], line[k + 1], n / static_cast<double>(kSteps)))) return true;
  return false;
}

std::vector<bool> leftKept(const CutPiece& op) {
  std::vector<bool> left;
  for (const std::string& side : op.keeps) left.push_back(side == "left");
  return left;
}

// On another figure a line that divided the piece may end within it; what follows is of two parts.
Done dividesStill(const CutPiece& op, const CutAcross& across, const Piece& whole) {
  if (op.keeps.empty() || !across.keptLeft.empty()) return {};
  return refused(say(
      "The line does not cut “{0}” in two here: it ends within the piece. Lead both its ends well beyond the outline.",
      whole.name));
}

// Which sides of the line keep the piece. It is recorded, for on another figure the other part may be the larger, and
// what was done to the one would be done to the other. Of halves alike it is the left one.
// `twins`: whether the parts are each other's mirror image.
Result<std::vector<std::string>> sidesKept(const Document& before, const CutPiece& op, bool& twins) {
  const Piece& whole = *before.find(op.piece.id);
  const auto newPart = [&](std::size_t k) {
    return NewPart{mint<PieceId>(before, static_cast<std::uint32_t>(k)), "part"};
  };
  const auto across =
      cutAcrossDarts(before.pattern, whole, op.line, newPart, {}, leftKept(op), op.corners == Choice::Yes);
  if (!across) return across.error();
  if (Done done = dividesStill(op, *across, whole); !done) return done.error();
  std::vector<std::string> sides;
  for (const bool left : across->keptLeft) sides.push_back(left ? "left" : "right");
  const auto& parts = across->cut.pieces;
  if (parts.size() == 2) {
    Piece other = parts[1];
    EdgeMap edges;
    twins = nameLikeImage(other, edges, parts[0]);
  }
  if (op.keeps.empty() && parts.size() == 2 &&
      std::abs(parts[0].outline.area() - parts[1].outline.area()) < kAlike * parts[0].outline.area())
    sides = {"left"};
  return sides;
}

// `likewise`: the parts of the piece of which this is the symmetric copy.
Result<Cut> cutIn(const Document& before, const CutPiece& op, const std::vector<const Piece*>& likewise, Minted& minted,
                  const Context& context) {
  const Piece& whole = *before.find(op.piece.id);
  std::set<std::string> names;
  for (const auto& [id, piece] : before.pattern.pieces) names.insert(piece->name);
  const auto newPart = [&](std::size_t k) {
    std::string name = op.name;
    for (int n = 2; !names.insert(name).second; ++n) name = op.name + "_" + std::to_string(n);
    return NewPart{mint<PieceId>(before, minted.pieces + static_cast<std::uint32_t>(k)), name};
  };
  auto across = cutAcrossDarts(before.pattern, whole, op.line, newPart,
                               linesOfLattice(withElasticLines(before.pattern, before.allowances), whole), leftKept(op),
                               op.corners == Choice::Yes);
  if (!across) return across.error();
  CutPieces& cut = across->cut;
  if (Done done = dividesStill(op, *across, whole); !done) return done.error();
  minted.pieces += static_cast<std::uint32_t>(cut.pieces.size()) - 1;
  if (cut.pieces.size() > 2) {  // of the parts the largest is called as was asked
    const auto largest = std::max_element(cut.pieces.begin() + 1, cut.pieces.end(), [](const Piece& a, const Piece& b) {
      return a.outline.area() < b.outline.area();
    });
    std::swap(cut.pieces[1].name, largest->name);
  }
  if (!op.edge.empty())
    for (Piece& part : cut.pieces) nameCutEdges(part, whole, cut.edges, op.edge);
  arrangeLike(cut, likewise);
  const bool twins =
      op.twins == Choice::Yes && cut.pieces.size() == 2 && nameLikeImage(cut.pieces[1], cut.edges, cut.pieces[0]);
  Document after = before;
  updateSeams(after.pattern, cut.edges);
  if (cut.pieces.size() > 1) sharePins(after, cut.pieces);
  std::vector<const Piece*> parts;
  std::vector<PieceId> ids;
  for (const Piece& piece : cut.pieces) parts.push_back(&piece), ids.push_back(piece.id);
  updateGrading(after.grading, whole, cut.edges, parts);
  const bool own = before.looks.pieces.contains(whole.id) || before.looks.pieces.contains(whole.mirrorOf);
  for (Piece& piece : cut.pieces) {
    if (own) after.looks.pieces[piece.id] = lookOf(before, whole);
    if (const auto shift = before.looks.shifts.find(whole.id); shift != before.looks.shifts.end())
      after.looks.shifts[piece.id] = shift->second;
    if (const auto often = before.cutting.find(whole.id); often != before.cutting.end() && op.quantities == Choice::Yes)
      after.cutting[piece.id] = often->second;
    piece.mirrorOf = PieceId();  // no longer the other's likeness
    after = withPiece(std::move(after), std::move(piece));
  }
  if (twins) {
    after = withLikeness(std::move(after), ids[0], ids[1]);
    if (context.advise)
      context.advise({say("“{0}” and “{1}” are symmetric copies now: what is done to one is done to the other.",
                          after.find(ids[0])->name, after.find(ids[1])->name),
                      ids[0]});
  }
  divideDarts(before, after, across->darts, minted, context);
  updateAllowances(after.allowances, cut.edges, after.pattern);
  return Cut{std::move(after), std::move(ids)};
}

// Both halves of a symmetric piece: the line lies in one of them, for across the fold it would meet its image.
Done resolveHalves(const Document& before, CutPiece& op, Context& context) {
  constexpr double kFold = 1e-3;  // metres from the fold that are on it
  const Piece& piece = *before.find(op.piece.id);
  if (op.copies == Choice::Yes)
    return refused(
        say("Say copies= for the symmetric copy of “{0}”, or symmetric= for its other half; not both.", piece.name));
  if (Done done = resolveSymmetric(piece, op.symmetric, context, [](const PaperSymmetry&) { return true; }); !done)
    return done;
  const PaperSymmetry symmetry = *symmetryOf(piece.outline);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Flat place : op.line) {
    const double beside = cross(symmetry.axis, place - symmetry.through);
    low = std::fmin(low, beside), high = std::fmax(high, beside);
  }
  if (low > -kFold || high < kFold) return {};
  return refused(
      say("The line crosses the middle of “{0}”, where it would meet its image. Lead it across both halves "
          "and leave symmetric= away, or keep it in one of them.",
          piece.name));
}

}  // namespace

Done resolve(const Document& before, CutPiece& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.line.size() < 2) return refused(say("A cut needs a line of at least two places."));
  if (op.line.size() > kMostPlaces) return refused(say("The line of a cut has more than {0} places.", kMostPlaces));
  for (const Flat place : op.line)
    if (!(length(place) <= 1000)) return refused(say("The line of the cut leaves the table."));
  if (op.copies != Choice::Auto)
    if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  if (op.symmetric == Choice::No) op.symmetric = Choice::Auto;  // nothing is to be decided
  if (op.symmetric == Choice::Yes)
    if (Done done = resolveHalves(before, op, context); !done) return done;
  if (op.name.empty())
    op.name = usableName(before, before.find(op.piece.id)->name);
  else if (Done done = checkNewName(before, op.name); !done)
    return done;
  if (!op.edge.empty())
    if (Done done = checkEdgeName(op.edge); !done) return done;
  for (const std::string& side : op.keeps)
    if (side != "left" && side != "right")
      return refused(say("The side of a cut's line is left or right, as the line runs, not “{0}”.", side));
  if (context.recorded) return {};
  if (op.corners == Choice::Auto) op.corners = Choice::Yes;
  if (op.quantities == Choice::Auto && before.cutting.contains(op.piece.id)) op.quantities = Choice::Yes;
  bool twins = false;
  auto sides = sidesKept(before, op, twins);
  if (!sides) return sides.error();
  op.keeps = std::move(*sides);
  if (op.twins == Choice::Yes && !twins)
    return refused(
        say("The line does not part “{0}” in two mirror images; leave twins= away.", before.find(op.piece.id)->name));
  if (op.twins == Choice::Auto && twins && op.copies != Choice::Yes) op.twins = Choice::Yes;
  if (op.twins == Choice::Yes && op.copies == Choice::Yes)
    return refused(say("Parts have one symmetric copy: copies=yes gives them that of “{0}”; leave twins= away.",
                       before.find(op.piece.id)->name));
  return {};
}

Result<Document> perform(const Document& before, const CutPiece& op, Context& context) {
  const Piece& whole = *before.find(op.piece.id);
  Minted minted;
  auto cut = cutIn(before, op, {}, minted, context);
  if (!cut) return cut.error();
  const std::vector<PieceId> copies = copiesMeant(before, whole.id, op.copies);
  if (copies.empty()) tellUnlike(before, whole, context);
  Document after = std::move(cut->after);
  Context silent = context;
  silent.advise = {};
  std::vector<const Piece*> own;
  const Pattern pattern = after.pattern;  // keeps them
  for (const PieceId part : cut->parts) own.push_back(pattern.pieces.at(part).get());
  // The same cut along the image of the line, in another piece.
  const auto cutLikewise = [&](PieceId id, const std::function<Flat(Flat)>& image) -> Result<Cut> {
    CutPiece likewise = op;
    likewise.piece.id = id;
    likewise.name = nameOfCopy(after, op.name);
    for (Flat& place : likewise.line) place = image(place);
    for (std::string& side : likewise.keeps) side = side == "left" ? "right" : "left";
    return cutIn(after, likewise, own, minted, silent);
  };
  for (const PieceId id : copies) {
    auto other = cutLikewise(id, [](Flat place) { return Flat{-place.u, place.v}; });
    if (!other) return other.error();
    after = std::move(other->after);
    const bool copied = before.find(id)->mirrorOf == whole.id;
    for (const PieceId part : cut->parts)
      for (const PieceId image : other->parts)
        after = copied ? withLikeness(std::move(after), part, image) : withLikeness(std::move(after), image, part);
  }
  if (op.symmetric == Choice::Yes) {
    const PaperSymmetry symmetry = *symmetryOf(whole.outline);
    std::vector<Flat> line = op.line;
    for (Flat& place : line) place = symmetry.image(place);
    if (!liesOn(line, *after.find(whole.id)))
      return refused(
          say("Of both halves of “{0}” the part between the two lines keeps the name; leave keeps= away.", whole.name));
    auto other = cutLikewise(whole.id, [&](Flat place) { return symmetry.image(place); });
    if (!other) return other.error();
    after = std::move(other->after);
    for (const PieceId part : cut->parts)
      for (const PieceId image : other->parts)
        if (part != whole.id && image != whole.id) after = withLikeness(std::move(after), part, image);
  }
  return after;
}

}  // namespace karinui
