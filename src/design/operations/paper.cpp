// Pieces drawn on paper: a rectangle, a polygon or curve, a circle, a ring or a sector of one.
#include <cmath>
#include <numbers>

#include "design/operations/new_piece.h"
#include "karinui/base/number.h"
#include "karinui/design/sewing.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

namespace {

constexpr double kLongest = 20;  // metres
constexpr double kNearlyWhole = 355 * std::numbers::pi / 180;
constexpr std::string_view kCurvesOn = "~";

// Smooth cubics through the places of a run: the tangents of a Catmull-Rom curve over chord length, those of a parabola
// at the ends (Farin, Curves and Surfaces for CAGD).
Curve through(const std::vector<Flat>& run) {
  const std::size_t n = run.size();
  if (n == 2) return Curve::line(run[0], run[1]);
  std::vector<double> chord;
  for (std::size_t i = 0; i + 1 < n; ++i) chord.push_back(std::fmax(distance(run[i], run[i + 1]), 1e-9));
  const auto slope = [&](std::size_t i) { return (run[i + 1] - run[i]) * (1 / chord[i]); };
  std::vector<Flat> tangent(n);
  for (std::size_t i = 1; i + 1 < n; ++i)
    tangent[i] = (slope(i - 1) * chord[i] + slope(i) * chord[i - 1]) * (1 / (chord[i - 1] + chord[i]));
  tangent[0] = slope(0) * 2 - tangent[1];
  tangent[n - 1] = slope(n - 2) * 2 - tangent[n - 2];
  std::vector<Curve> curves;
  for (std::size_t i = 0; i + 1 < n; ++i)
    curves.push_back(Curve::cubic(run[i], run[i] + tangent[i] * (chord[i] / 3),
                                  run[i + 1] - tangent[i + 1] * (chord[i] / 3), run[i + 1]));
  return Curve::joined(curves);
}

Outline outlineOf(const DrawPolygon& op) {
  Outline outline;
  std::vector<Flat> run;
  const std::size_t n = op.points.size();
  const auto end = [&](Flat p) {
    run.push_back(p);
    outline.edges.back().curve = through(run);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (op.edges[i] == kCurvesOn) {
      run.push_back(op.points[i]);
      continue;
    }
    if (i > 0) end(op.points[i]);
    run = {op.points[i]};
    outline.edges.push_back({op.edges[i], {}});
  }
  end(op.points.front());
  return outline;
}

// An arc about the origin; more than half a turn is a chain of cubics, so that no bulge grows without bound.
Curve arcAbout(double radius, double from, double to) {
  const auto at = [&](double angle) { return Flat{radius * std::sin(angle), -radius * std::cos(angle)}; };
  const auto arc = [&](double a, double b) { return Curve::arc(at(a), at(b), std::tan((b - a) / 4)); };
  if (std::fabs(to - from) <= std::numbers::pi) return arc(from, to);
  const std::vector<Curve> halves{arc(from, (from + to) / 2), arc((from + to) / 2, to)};
  return Curve::joined(halves);
}

struct RingPaper {
  Outline outline;
  std::vector<Outline> holes;
};
// The middle is at the origin, the sector opens downwards: its inner edge is above, as a waist.
double innerRadius(const DrawRing& op) {
  if (op.inner) return *op.inner / op.angle;
  return op.radius ? double{*op.radius} : 0;
}

// With the length that its run of edges has now.
DrawRing measured(const Document& document, DrawRing op) {
  if (!op.of.empty()) op.inner = Length{lengthOf(document, op.of)}, op.of.clear();
  return op;
}

RingPaper paperOf(const DrawRing& op) {
  const double inner = innerRadius(op), outer = inner + op.depth, half = op.angle / 2;
  const auto& name = op.edges;
  RingPaper paper;
  auto& edges = paper.outline.edges;
  if (op.angle > kNearlyWhole) {
    edges = {{name[0] + "_left", arcAbout(outer, 0, std::numbers::pi)},
             {name[0] + "_right", arcAbout(outer, std::numbers::pi, kFullTurn)}};
    edges[1].curve.end = edges[0].curve.start;
    if (inner > 0) {
      Outline hole{{{name[2] + "_left", arcAbout(inner, 0, std::numbers::pi)},
                    {name[2] + "_right", arcAbout(inner, std::numbers::pi, kFullTurn)}}};
      hole.edges[1].curve.end = hole.edges[0].curve.start;
      paper.holes.push_back(std::move(hole));
    }
    return paper;
  }
  const Flat left{std::sin(half), -std::cos(half)}, right{-left.u, left.v};
  edges.push_back({name[0], arcAbout(outer, -half, half)});
  edges.push_back({name[1], Curve::line(left * outer, left * inner)});
  if (inner > 0) edges.push_back({name[2], arcAbout(inner, half, -half)});
  edges.push_back({name[3], Curve::line(right * inner, right * outer)});
  edges.front().curve.start = edges.back().curve.end;
  edges[1].curve.start = edges[0].curve.end;
  return paper;
}

Done checkNames(std::vector<std::string>& names, std::vector<std::string> usual) {
  if (names.empty()) names = std::move(usual);
  if (names.size() == usual.size() || usual.empty()) return {};
  return refused(say("This shape has {0} {0|edge|edges}; it got {1} {1|name|names}.", usual.size(), names.size()));
}

Done checkSize(double metres) {
  if (metres > 0 && metres <= kLongest) return {};
  return refused(say("A length on paper lies between 0 and 20 m."));
}

}  // namespace

Rigid beside(const Document& document, const Outline& outline) {
  const auto boxOfPaper = [](const Outline& paper) {
    Box box;
    for (const Flat p : paper.flattened(1e-3)) box.include({p.u, p.v, 0});
    return box;
  };
  const Box mine = boxOfPaper(outline);
  Rigid pose;
  pose.carry = {-mine.centre().x, kPaperHeight - mine.centre().y, kPaperDistance};
  bool moved = true;
  while (moved) {
    moved = false;
    for (const auto& [id, piece] : document.pattern.pieces) {
      if (piece->form || std::fabs(piece->pose.carry.z - kPaperDistance) > 0.05) continue;
      const Box its = boxOfPaper(piece->outline);
      const double left = its.high.x + piece->pose.carry.x + kPaperGap - (mine.low.x + pose.carry.x);
      const bool apart = left <= 1e-9 || mine.high.x + pose.carry.x + kPaperGap / 2 <= its.low.x + piece->pose.carry.x;
      if (!apart) pose.carry.x += left, moved = true;
    }
  }
  return pose;
}

Done checkPaper(const Document& before, const NewPaper& paper) {
  if (Done done = checkNewName(before, paper.name); !done) return done;
  if (!paper.fabric.empty())
    if (Done done = checkFabricName(before, paper.fabric); !done) return done;
  if (paper.layer < 0 || paper.layer > 20) return refused(say("A layer is a number from 0, next to the skin, to 20."));
  return {};
}

Result<Piece> newPiece(const Document& before, const NewPaper& paper, Outline outline, std::vector<Outline> holes) {
  Piece piece;
  piece.id = mint<PieceId>(before, 0);
  piece.name = paper.name;
  auto fine = checked(std::move(outline));
  if (!fine) return fine.error();
  piece.outline = *std::move(fine);
  for (Outline& hole : holes) {
    auto good = checked(std::move(hole));
    if (!good) return good.error();
    piece.holes.push_back(*std::move(good));
  }
  if (!paper.fabric.empty()) piece.fabric = paper.fabric;
  piece.layer = paper.layer;
  piece.pose = beside(before, piece.outline);
  return piece;
}

Done resolve(const Document& before, DrawRectangle& op, Context&) {
  if (Done done = checkPaper(before, {op.name, op.fabric, op.layer}); !done) return done;
  if (Done done = checkSize(op.width); !done) return done;
  if (Done done = checkSize(op.height); !done) return done;
  return checkNames(op.edges, {"bottom", "side_left", "top", "side_right"});
}

Result<Document> perform(const Document& before, const DrawRectangle& op, Context&) {
  auto piece = newPiece(before, {op.name, op.fabric, op.layer}, rectangleOf(op.width, op.height, op.edges));
  if (!piece) return piece.error();
  return withPiece(before, *std::move(piece));
}

Done resolve(const Document& before, DrawPolygon& op, Context&) {
  if (Done done = checkPaper(before, {op.name, op.fabric, op.layer}); !done) return done;
  const std::size_t n = op.points.size();
  if (n < 3) return refused(say("A polygon needs at least three places."));
  if (n > 2000) return refused(say("“{0}” has more than {1} edges.", op.name, 2000));
  if (op.edges.empty())
    for (std::size_t i = 0; i < n; ++i) op.edges.push_back(op.symmetric && i + 1 == n ? "fold" : "e" + written(i + 1));
  if (op.symmetric && op.edges.size() == n - 1) op.edges.push_back("fold");
  if (op.edges.size() != n)
    return refused(say(
        "There {0|is|are} {0} {0|place|places} and {1} {1|name|names}; say one for each, ~ where the line curves on.",
        n, op.edges.size()));
  if (op.edges.front() == kCurvesOn)
    return refused(say("The first place of a line begins an edge: give it a name, not ~."));
  if (op.symmetric && op.edges.back() == kCurvesOn)
    return refused(say("The last place of a half begins the fold: give it a name, not ~."));
  return {};
}

Result<Document> perform(const Document& before, const DrawPolygon& op, Context&) {
  auto piece = newPiece(before, {op.name, op.fabric, op.layer}, outlineOf(op));
  if (!piece) return piece.error();
  if (op.symmetric) {
    auto whole = unfolded(*piece, op.edges.back());
    if (!whole) return whole.error();
    piece = std::move(whole->piece);
    piece->pose = beside(before, piece->outline);
  }
  return withPiece(before, *std::move(piece));
}

Done resolve(const Document& before, DrawRing& op, Context&) {
  if (Done done = checkPaper(before, {op.name, op.fabric, op.layer}); !done) return done;
  if (Done done = checkSize(op.depth); !done) return done;
  if (!(op.angle > 0.01 && op.angle <= kFullTurn + 1e-9))
    return refused(say("A sector has an angle between 1 and 360 degrees; what is more takes several pieces."));
  if ((op.inner ? 1 : 0) + (op.radius ? 1 : 0) + (op.of.empty() ? 0 : 1) > 1)
    return refused(say("Say the inner edge once: by its length, by a run of edges, or by its radius."));
  for (EdgeRef& edge : op.of)
    if (Done done = resolve(before, edge); !done) return done;
  if (const double radius = innerRadius(measured(before, op)); !(radius >= 0 && radius <= kLongest))
    return refused(say("A length on paper lies between 0 and 20 m."));
  return checkNames(op.edges, {"hem", "side_left", "waist", "side_right"});
}

Result<Document> perform(const Document& before, const DrawRing& op, Context&) {
  RingPaper paper = paperOf(measured(before, op));
  auto piece = newPiece(before, {op.name, op.fabric, op.layer}, std::move(paper.outline), std::move(paper.holes));
  if (!piece) return piece.error();
  return withPiece(before, *std::move(piece));
}

}  // namespace karinui
