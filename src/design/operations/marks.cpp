// What is marked on the paper: notches, drill holes, internal lines.
#include <algorithm>
#include <cmath>
#include <set>

#include "design/operations/finished_edges.h"
#include "karinui/base/number.h"
#include "karinui/geometry/fit_curve.h"
#include "karinui/pattern/fastening.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr double kReach = 0.01;    // metres
constexpr double kOnEdge = 0.001;  // metres: a line that ends this near to an edge or a corner is meant to end on it

// `edge`: the edge a notch lies on, empty for a drill hole.
Done checkSymmetric(const Piece& piece, bool symmetric, const std::string& edge, double at, Context& context) {
  Choice choice = symmetric ? Choice::Yes : Choice::No;
  return resolveSymmetric(piece, choice, context, [&](const PaperSymmetry& symmetry) {
    return edge.empty() || imageOf(piece.outline, symmetry, {*piece.outline.find(edge), at});
  });
}

Document marked(Document document, Piece piece) {
  const PieceId id = piece.id;
  document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
  return document;
}

Flat placeOf(const Piece& piece, const Mark& mark) {
  const auto k = mark.edge.empty() ? std::nullopt : piece.outline.find(mark.edge);
  return k ? piece.outline.edges[*k].curve.atFraction(mark.fraction) : mark.place;
}

double away(const InternalLine& line, Flat at) {
  double nearest = kReach;
  for (const Curve& curve : line.curves) {
    const auto points = curve.flattened(1e-4);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Flat side = points[i + 1] - points[i];
      const double t = std::clamp(dot(at - points[i], side) / std::fmax(dot(side, side), 1e-18), 0.0, 1.0);
      nearest = std::fmin(nearest, distance(at, points[i] + side * t));
    }
  }
  return nearest;
}

// The place of a curve that is nearest to another place.
Flat nearestOn(const Curve& curve, Flat place) {
  if (curve.kind == Curve::Kind::Line) {
    const Flat along = curve.end - curve.start;
    return curve.start + along * std::clamp(dot(place - curve.start, along) / dot(along, along), 0.0, 1.0);
  }
  const int looks = 64 * static_cast<int>(curve.parts().size());
  double guess = 0, least = HUGE_VAL;
  for (int k = 0; k <= looks; ++k)
    if (const double d = distance(curve.at(static_cast<double>(k) / looks), place); d < least)
      least = d, guess = static_cast<double>(k) / looks;
  double low = std::max(0.0, guess - 1.0 / looks), high = std::min(1.0, guess + 1.0 / looks);
  for (int round = 0; round < 60; ++round) {  // the distance has one valley here
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (distance(curve.at(a), place) < distance(curve.at(b), place) ? high : low) =
        distance(curve.at(a), place) < distance(curve.at(b), place) ? b : a;
  }
  return curve.at((low + high) / 2);
}

std::vector<const Outline*> bordersOf(const Piece& piece) {
  std::vector<const Outline*> all{&piece.outline};
  for (const Outline& hole : piece.holes) all.push_back(&hole);
  return all;
}

// An end of a line that is as near to the border as a hand draws: on it, and in its corner rather than beside that.
Flat onBorder(const Piece& piece, Flat end) {
  Flat best = end;
  double least = kOnEdge;
  for (const Outline* border : bordersOf(piece))
    for (const Edge& edge : border->edges)
      if (const double d = distance(edge.curve.start, end); d <= least) least = d, best = edge.curve.start;
  if (least < kOnEdge) return best;
  constexpr double kThere = 1e-7;  // metres: it is on the edge as it is
  for (const Outline* border : bordersOf(piece))
    for (const Edge& edge : border->edges) {
      const Flat place = nearestOn(edge.curve, end);
      if (const double d = distance(place, end); d <= least) least = d, best = d < kThere ? end : place;
    }
  return best;
}

std::vector<Curve> curvesOf(const AddLine& op) {
  if (op.smooth) return fitEdge(op.along).curves;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i + 1 < op.along.size(); ++i) curves.push_back(Curve::line(op.along[i], op.along[i + 1]));
  return curves;
}

// A mark's mirror image on a symmetric copy that is the piece's likeness.
Mark imageOnCopy(const Piece& copy, const Piece& piece, Mark mark) {
  mark.name = otherSide(mark.name);
  mark.place = {-mark.place.u, mark.place.v};
  if (mark.edge.empty()) return mark;
  mark.edge = edgeOnCopy(copy, piece, mark.edge).value_or(std::string());
  mark.fraction = 1 - mark.fraction;
  return mark;
}
using PlacedMark = std::pair<PieceId, Mark>;

// A notch of another piece, or of another edge, that comes to lie where this one does.
constexpr double kMeets = 0.001;  // metres along the edge
bool isMet(const Piece& piece, const Mark& notch) {
  const auto k = piece.outline.find(notch.edge);
  return k && std::any_of(piece.marks.begin(), piece.marks.end(), [&](const Mark& own) {
           return own.edge == notch.edge &&
                  std::fabs(own.fraction - notch.fraction) * piece.outline.edges[*k].curve.length() < kMeets;
         });
}
// The seams, and where `zips` the zips as such, however far they are closed.
Pattern joinedPattern(const Document& document, bool zips) {
  if (!zips) return document.pattern;
  Fastenings shut = document.allowances.fastenings;
  for (auto& [name, own] : shut) own.zipped = 1;
  return withZips(document.pattern, shut);
}
// Where notches meet the edges that theirs are sewn to.
std::vector<PlacedMark> onPartners(const Document& document, const std::vector<PlacedMark>& placed, bool zips) {
  const Pattern joined = joinedPattern(document, zips);
  std::vector<PlacedMark> all;
  for (const auto& [id, mark] : placed) {
    if (mark.edge.empty()) continue;
    for (const SeamPlace& there : sewnTo(joined, {id, mark.edge, mark.fraction}))
      if (document.find(there.piece)->outline.find(there.edge))
        all.push_back({there.piece, Mark{mark.name, there.edge, there.fraction, {}}});
  }
  return all;
}
// A choice about what notches are sewn to: recorded where there is something to choose.
Done resolvePartners(const std::function<std::vector<PlacedMark>(bool zips)>& find, Choice& choice, Choice& zips,
                     const Context& context) {
  std::vector<PlacedMark> partners = find(false);
  if (!context.recorded && zips != Choice::No && choice != Choice::No) {
    auto more = find(true);
    zips = more.size() > partners.size() ? Choice::Yes : Choice::Auto;
    if (zips == Choice::Yes) partners = std::move(more);
  } else if (zips == Choice::Yes) {
    partners = find(true);
  }
  if (choice == Choice::Auto && context.recorded) return {};
  if (!partners.empty()) {
    if (choice == Choice::Auto) choice = Choice::Yes;
    return {};
  }
  if (choice == Choice::Yes && !context.recorded && !context.byFormula)
    return refused(say("Nothing is sewn to the edge there that could have the notch, too; leave partners= away."));
  choice = Choice::Auto;
  return {};
}

bool sameMark(const Mark& one, const Mark& other) {
  constexpr double kSame = 1e-5;  // metres, and of an edge's length
  return one.edge == other.edge && (one.edge.empty() ? distance(one.place, other.place) < kSame
                                                     : std::fabs(one.fraction - other.fraction) < kSame);
}

std::vector<Curve> mirrored(const std::vector<Curve>& curves) {
  std::vector<Curve> images;
  for (const Curve& curve : curves) images.push_back(curve.mirrored({0, 0}, {0, 1}));
  return images;
}

bool hasName(const Piece& piece, const std::string& name) {
  return std::any_of(piece.lines.begin(), piece.lines.end(), [&](const auto& line) { return line.name == name; });
}

double lengthOf(const std::vector<Curve>& curves) {
  double sum = 0;
  for (const Curve& curve : curves) sum += curve.length();
  return sum;
}

// Where a line lies beside the cloth, by more than the hand's inaccuracy.
std::optional<Flat> leaves(const Piece& piece, const std::vector<Curve>& curves) {
  constexpr double kStep = 0.002;  // metres
  const Ring ring = piece.outline.flattened(1e-4);
  std::vector<Ring> holes;
  for (const Outline& hole : piece.holes) holes.push_back(hole.flattened(1e-4));
  const auto outside = [&](Flat place) {
    if (!contains(ring, place) && !(distanceToRing(ring, place) <= kOnEdge)) return true;
    return std::any_of(holes.begin(), holes.end(), [&](const Ring& hole) {
      return contains(hole, place) && distanceToRing(hole, place) > kOnEdge;
    });
  };
  for (const Curve& curve : curves) {
    const std::vector<Flat> points = curve.flattened(1e-4);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const int steps = 1 + static_cast<int>(std::min(distance(points[i], points[i + 1]) / kStep, 1e5));
      for (int k = 0; k <= steps; ++k)
        if (const Flat p = lerp(points[i], points[i + 1], static_cast<double>(k) / steps); outside(p)) return p;
    }
  }
  return std::nullopt;
}

// A line of this name lies exactly there, whichever way it runs: it came with that of a symmetric copy.
bool isThere(const Piece& piece, const AddLine& op) {
  constexpr double kSame = 1e-5;  // metres
  const std::vector<Curve> curves = curvesOf(op);
  const auto alike = [&](const std::vector<Curve>& own, bool back) {
    for (std::size_t k = 0; k < curves.size(); ++k)
      for (const double t : {0.0, 0.5, 1.0}) {
        const Curve& there = own[back ? curves.size() - 1 - k : k];
        if (distance(there.at(back ? 1 - t : t), curves[k].at(t)) > kSame) return false;
      }
    return true;
  };
  return std::any_of(piece.lines.begin(), piece.lines.end(), [&](const InternalLine& line) {
    return line.name == op.name && line.curves.size() == curves.size() &&
           (alike(line.curves, false) || alike(line.curves, true));
  });
}

// A notch or drill hole with its images on the other half and on symmetric copies.
std::vector<PlacedMark> notchesOf(const Document& document, const AddNotch& op) {
  const Piece& piece = *document.find(op.piece.id);
  Mark mark;
  mark.name = op.name;
  if (op.point) {
    mark.place = *op.point;
  } else {
    mark.edge = op.edge.edge;
    mark.fraction = op.at;
  }
  std::vector<PlacedMark> all{{op.piece.id, mark}};
  if (op.symmetric) {
    const auto symmetry = symmetryOf(piece.outline);
    const Flat here = placeOf(piece, mark);
    mark.place = op.point ? symmetry->image(*op.point) : Flat();
    if (!op.point) {
      const auto image = imageOf(piece.outline, *symmetry, {*piece.outline.find(mark.edge), op.at});
      mark.edge = piece.outline.edges[image->edge].name;
      mark.fraction = image->at;
    }
    if (distance(placeOf(piece, mark), here) > 1e-6) all.push_back({op.piece.id, std::move(mark)});
  }
  for (std::size_t k = 0, here = all.size(); k < here; ++k)
    for (const PieceId id : copiesMeant(document, op.piece.id, op.copies)) {
      const Piece& copy = *document.find(id);
      const Mark image = imageOnCopy(copy, piece, all[k].second);
      if (std::none_of(copy.marks.begin(), copy.marks.end(), [&](const Mark& own) { return sameMark(own, image); }))
        all.push_back({id, image});
    }
  return all;
}

// What an eraser takes: of its piece, and of symmetric copies.
struct Erased {
  std::vector<std::pair<PieceId, InternalLine>> lines;
  std::vector<PlacedMark> marks;
};
// Refused: there is nothing near.
Result<Erased> whatGoes(const Document& document, const EraseMarks& op) {
  const Piece& piece = *document.find(op.piece.id);
  Erased taken;
  for (const std::string& name : op.names) {
    for (const InternalLine& line : piece.lines)
      if (line.name == name) taken.lines.push_back({piece.id, line});
    for (const Mark& mark : piece.marks)
      if (mark.name == name) taken.marks.push_back({piece.id, mark});
  }
  if (op.at) {
    double nearest = kReach;
    const Mark* mark = nullptr;
    for (const Mark& one : piece.marks)
      if (const double d = distance(placeOf(piece, one), *op.at); d < nearest) nearest = d, mark = &one;
    const InternalLine* line = nullptr;
    for (const InternalLine& one : piece.lines)
      if (const double d = away(one, *op.at); d < nearest) nearest = d, line = &one;
    if (line)
      taken.lines.push_back({piece.id, *line});
    else if (mark)
      taken.marks.push_back({piece.id, *mark});
    else
      return refused(say("There is nothing to erase within 1 cm of that place on {0}.", piece.name));
  }
  const Erased own = taken;
  for (const PieceId id : copiesMeant(document, op.piece.id, op.copies)) {
    const Piece& copy = *document.find(id);
    for (const auto& [from, line] : own.lines)
      if (const InternalLine* image = lineOnCopy(line, copy)) taken.lines.push_back({id, *image});
    for (const auto& [from, mark] : own.marks)
      for (const Mark& one : copy.marks)
        if (sameMark(one, imageOnCopy(copy, piece, mark))) taken.marks.push_back({id, one});
  }
  return taken;
}
// The notches that meet those that go.
std::vector<PlacedMark> partnersErased(const Document& document, const Erased& taken, bool zips) {
  std::vector<PlacedMark> all;
  for (const PlacedMark& there : onPartners(document, taken.marks, zips))
    for (const Mark& own : document.find(there.first)->marks) {
      Piece alone = *document.find(there.first);
      alone.marks = {own};
      if (isMet(alone, there.second)) all.push_back({there.first, own});
    }
  return all;
}

}  // namespace

Done resolve(const Document& before, AddNotch& op, Context& context) {
  if (op.edge == EdgeRef() ? !op.point : op.point.has_value()) {
    return refused(say("Say where to mark: edge=front.side at=0.5, or piece=front point=10cm,5cm."));
  }
  if (!op.name.empty()) {
    if (Done done = checkName(op.name); !done) return done;
  }
  if (op.point) {
    if (Done done = resolve(before, op.piece); !done) return done;
    const Piece& piece = *before.find(op.piece.id);
    if (!contains(piece.outline.flattened(1e-4), *op.point)) {
      const FlatBox paper = boxOf(piece.outline.flattened(1e-4));
      const auto cm = [](double metres) { return fixed(metres * 100, 0); };
      return refused(
          say("The drill hole is not on “{0}”, which lies between {1} and {2} cm across, and {3} and {4} cm up "
              "on its paper.",
              piece.name, cm(paper.low.u), cm(paper.high.u), cm(paper.low.v), cm(paper.high.v)));
    }
    if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
    return checkSymmetric(piece, op.symmetric, {}, 0, context);
  }
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  op.piece = op.edge.piece;
  if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  if (!(op.at >= 0 && op.at <= 1)) return refused(say("A notch lies between 0, the edge's beginning, and 1, its end."));
  if (Done done = checkSymmetric(*before.find(op.piece.id), op.symmetric, op.edge.edge, op.at, context); !done)
    return done;
  return resolvePartners([&](bool zips) { return onPartners(before, notchesOf(before, op), zips); }, op.partners,
                         op.zips, context);
}

Result<Document> perform(const Document& before, const AddNotch& op, Context&) {
  const std::vector<PlacedMark> all = notchesOf(before, op);
  Document after = before;
  const auto add = [&](const PlacedMark& one) {
    Piece piece = *after.find(one.first);
    piece.marks.push_back(one.second);
    after = marked(std::move(after), std::move(piece));
  };
  for (const PlacedMark& one : all) add(one);
  if (op.partners == Choice::Yes)
    for (const PlacedMark& one : onPartners(before, all, op.zips == Choice::Yes))
      if (!isMet(*after.find(one.first), one.second)) add(one);
  return after;
}

Done resolve(const Document& before, AddLine& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  const Piece& piece = *before.find(op.piece.id);
  if (op.along.size() < 2) return refused(say("A line needs at least two places."));
  if (op.along.size() > 10000) return refused(say("A line has at most 10000 places."));
  if (!std::all_of(op.along.begin(), op.along.end(), [](Flat place) { return finite(place); }))
    return refused(say("A place of the line is not a usable number (lengths are metres, within 100 m)."));
  if (!context.recorded) {  // a line that was drawn before ends where it ended
    for (Flat* end : {&op.along.front(), &op.along.back()}) *end = onBorder(piece, *end);
    if (const auto place = leaves(piece, curvesOf(op)))
      return refused(
          say("The line leaves {0} at {1}, {2} cm on its paper; keep it within the outline. An end within "
              "1 mm of an edge is taken to be on it.",
              piece.name, fixed(100 * place->u, 1), fixed(100 * place->v, 1)));
    if (lengthOf(curvesOf(op)) < kOnEdge) return refused(say("The line is shorter than 1 mm; draw it longer."));
  }
  if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  if (op.name.empty()) {
    op.name = "line";
    for (int n = 2; hasName(piece, op.name); ++n) op.name = "line_" + std::to_string(n);
  }
  if (hasName(piece, op.name) && !isThere(piece, op))
    return refused(say("{0} already has a line “{1}”; choose another name.", piece.name, op.name));
  return checkName(op.name);
}

Result<Document> perform(const Document& before, const AddLine& op, Context& context) {
  InternalLine line;
  line.name = op.name;
  line.curves = curvesOf(op);
  Piece piece = *before.find(op.piece.id);
  if (isThere(piece, op)) {
    if (context.advise)
      context.advise({say("{0} has “{1}” already: it was drawn with its symmetric copy.", piece.name, op.name)});
    return before;
  }
  Document after = before;
  for (const PieceId id : copiesMeant(before, op.piece.id, op.copies)) {
    Piece copy = *before.find(id);
    if (lineOnCopy(line, copy)) continue;
    const std::string name = otherSide(line.name);
    InternalLine image{name, mirrored(line.curves), {}};
    for (int n = 2; hasName(copy, image.name); ++n) image.name = name + "_" + std::to_string(n);
    copy.lines.push_back(std::move(image));
    after = marked(std::move(after), std::move(copy));
  }
  piece.lines.push_back(std::move(line));
  return marked(std::move(after), std::move(piece));
}

Done resolve(const Document& before, EraseMarks& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  if (op.names.empty() == !op.at) return refused(say("Say what to erase: its name, or a place near it."));
  const Piece& piece = *before.find(op.piece.id);
  for (const std::string& name : op.names) {
    const auto is = [&](const auto& thing) { return thing.name == name; };
    if (std::none_of(piece.lines.begin(), piece.lines.end(), is) &&
        std::none_of(piece.marks.begin(), piece.marks.end(), is))
      return refused(say("“{0}” has no line and no mark “{1}”.", piece.name, name));
  }
  const auto taken = whatGoes(before, op);
  if (!taken) return taken.error();
  return resolvePartners([&](bool zips) { return partnersErased(before, *taken, zips); }, op.partners, op.zips,
                         context);
}

Result<Document> perform(const Document& before, const EraseMarks& op, Context&) {
  const auto taken = whatGoes(before, op);
  if (!taken) return taken.error();
  std::vector<PlacedMark> marks = taken->marks;
  if (op.partners == Choice::Yes)
    for (PlacedMark& one : partnersErased(before, *taken, op.zips == Choice::Yes)) marks.push_back(std::move(one));
  Document after = before;
  std::set<PieceId> pieces{op.piece.id};
  for (const auto& [id, line] : taken->lines) pieces.insert(id);
  for (const auto& [id, mark] : marks) pieces.insert(id);
  for (const PieceId id : pieces) {
    Piece piece = *before.find(id);
    for (const auto& [on, line] : taken->lines)
      if (on == id)
        std::erase_if(piece.lines, [&name = line.name](const InternalLine& own) { return own.name == name; });
    for (const auto& [on, mark] : marks)
      if (const auto at = std::find(piece.marks.begin(), piece.marks.end(), mark); on == id && at != piece.marks.end())
        piece.marks.erase(at);
    after = marked(std::move(after), std::move(piece));
  }
  updateAllowances(after.allowances, {}, after.pattern);  // what was sewn to the line goes with it
  return after;
}

}  // namespace karinui
