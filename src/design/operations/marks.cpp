// What is marked on the paper: notches, drill holes, internal lines.
#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"
#include "karinui/geometry/fit_curve.h"

namespace karinui {

namespace {

constexpr double kReach = 0.01;  // metres

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
      return refused(say("The drill hole is not on “{0}”.", piece.name));
    }
    return checkSymmetric(piece, op.symmetric, {}, 0, context);
  }
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  op.piece = op.edge.piece;
  if (!(op.at >= 0 && op.at <= 1)) return refused(say("A notch lies between 0, the edge's beginning, and 1, its end."));
  return checkSymmetric(*before.find(op.piece.id), op.symmetric, op.edge.edge, op.at, context);
}

Result<Document> perform(const Document& before, const AddNotch& op, Context&) {
  Piece piece = *before.find(op.piece.id);
  Mark mark;
  mark.name = op.name;
  if (op.point) {
    mark.place = *op.point;
  } else {
    mark.edge = op.edge.edge;
    mark.fraction = op.at;
  }
  piece.marks.push_back(mark);
  if (op.symmetric) {
    const auto symmetry = symmetryOf(piece.outline);
    const Flat here = placeOf(piece, mark);
    mark.place = op.point ? symmetry->image(*op.point) : Flat();
    if (!op.point) {
      const auto image = imageOf(piece.outline, *symmetry, {*piece.outline.find(mark.edge), op.at});
      mark.edge = piece.outline.edges[image->edge].name;
      mark.fraction = image->at;
    }
    if (distance(placeOf(piece, mark), here) > 1e-6) piece.marks.push_back(std::move(mark));
  }
  return marked(before, std::move(piece));
}

Done resolve(const Document& before, AddLine& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  const Piece& piece = *before.find(op.piece.id);
  if (op.along.size() < 2) return refused(say("A line needs at least two places."));
  if (op.along.size() > 10000) return refused(say("A line has at most 10000 places."));
  const Ring ring = piece.outline.flattened(1e-4);
  for (const Flat place : op.along)
    if (!finite(place) || (!contains(ring, place) && !(distanceToRing(ring, place) <= 1e-3)))
      return refused(say("The line leaves {0}.", piece.name));
  const auto taken = [&](const std::string& name) {
    return std::any_of(piece.lines.begin(), piece.lines.end(), [&](const auto& l) { return l.name == name; });
  };
  if (op.name.empty()) {
    op.name = "line";
    for (int n = 2; taken(op.name); ++n) op.name = "line_" + std::to_string(n);
  }
  if (taken(op.name)) return refused(say("{0} already has a line “{1}”; choose another name.", piece.name, op.name));
  return checkName(op.name);
}

Result<Document> perform(const Document& before, const AddLine& op, Context&) {
  Piece piece = *before.find(op.piece.id);
  InternalLine line;
  line.name = op.name;
  if (op.smooth)
    line.curves = fitEdge(op.along).curves;
  else
    for (std::size_t i = 0; i + 1 < op.along.size(); ++i)
      line.curves.push_back(Curve::line(op.along[i], op.along[i + 1]));
  piece.lines.push_back(std::move(line));
  return marked(before, std::move(piece));
}

Done resolve(const Document& before, EraseMarks& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.names.empty() == !op.at) return refused(say("Say what to erase: its name, or a place near it."));
  const Piece& piece = *before.find(op.piece.id);
  for (const std::string& name : op.names) {
    const auto is = [&](const auto& thing) { return thing.name == name; };
    if (std::none_of(piece.lines.begin(), piece.lines.end(), is) &&
        std::none_of(piece.marks.begin(), piece.marks.end(), is))
      return refused(say("“{0}” has no line and no mark “{1}”.", piece.name, name));
  }
  return {};
}

Result<Document> perform(const Document& before, const EraseMarks& op, Context&) {
  const auto erased = [&](Piece piece) {
    Document after = marked(before, std::move(piece));
    updateAllowances(after.allowances, {}, after.pattern);  // what was sewn to the line goes with it
    return after;
  };
  Piece piece = *before.find(op.piece.id);
  for (const std::string& name : op.names) {
    std::erase_if(piece.lines, [&](const InternalLine& line) { return line.name == name; });
    std::erase_if(piece.marks, [&](const Mark& mark) { return mark.name == name; });
  }
  if (!op.at) return erased(std::move(piece));
  double nearest = kReach;
  auto mark = piece.marks.end();
  for (auto m = piece.marks.begin(); m != piece.marks.end(); ++m)
    if (const double d = distance(placeOf(piece, *m), *op.at); d < nearest) nearest = d, mark = m;
  auto line = piece.lines.end();
  for (auto l = piece.lines.begin(); l != piece.lines.end(); ++l)
    if (const double d = away(*l, *op.at); d < nearest) nearest = d, line = l;
  if (line != piece.lines.end())
    piece.lines.erase(line);
  else if (mark != piece.marks.end())
    piece.marks.erase(mark);
  else
    return refused(say("There is nothing to erase within 1 cm of that place on {0}.", piece.name));
  return erased(std::move(piece));
}

}  // namespace karinui
