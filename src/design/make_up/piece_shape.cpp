#include "piece_shape.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kSmooth = 18 * kDegree;  // a line turns more than this at a corner
constexpr double kInto = 95 * kDegree;    // and at a dart's point by more than this, inwards
constexpr double kReach = 0.008;          // metres on either side over which a corner's turn is taken
constexpr double kSlim = 0.75;            // a dart's mouth over its leg
constexpr std::size_t kMostCorners = 20;  // the sharpest are kept

// The way the outline goes on from the start of an edge, or comes to it, over a short reach.
Flat wayAfter(const Outline& outline, std::size_t k) {
  const std::size_t n = outline.edges.size();
  double left = kReach;
  const Flat start = outline.edges[k].curve.start;
  for (std::size_t i = 0; i < n; ++i) {
    const Curve& curve = outline.edges[(k + i) % n].curve;
    const double own = curve.length();
    if (own >= left) return normalized(curve.at(curve.parameterAt(left)) - start);
    left -= own;
  }
  return normalized(outline.edges[k].curve.tangent(0));
}
Flat wayBefore(const Outline& outline, std::size_t k) {
  const std::size_t n = outline.edges.size();
  double left = kReach;
  const Flat start = outline.edges[k].curve.start;
  for (std::size_t i = 1; i <= n; ++i) {
    const Curve& curve = outline.edges[(k + n - i) % n].curve;
    const double own = curve.length();
    if (own >= left) return normalized(start - curve.at(curve.parameterAt(own - left)));
    left -= own;
  }
  return normalized(outline.edges[k].curve.tangent(0));
}

void measure(Shape& shape) {
  shape.area = 0;
  shape.low = shape.high = shape.runs.front().line.front();
  for (Shape::Run& run : shape.runs) {
    run.area = 0;
    for (std::size_t i = 0; i < run.line.size(); ++i) {
      const Flat p = run.line[i];
      shape.low = {std::min(shape.low.u, p.u), std::min(shape.low.v, p.v)};
      shape.high = {std::max(shape.high.u, p.u), std::max(shape.high.v, p.v)};
      if (i + 1 < run.line.size()) run.area += cross(p, run.line[i + 1]);
    }
    shape.area += run.area / 2;
  }
}

}  // namespace

double Shape::length(std::size_t from, std::size_t to) const {
  double sum = 0;
  for (std::size_t k = from; k != to; k = (k + 1) % size()) sum += runs[k].length;
  return sum;
}

double Shape::bow(std::size_t from, std::size_t to) const {
  double sum = 0;
  for (std::size_t k = from; k != to; k = (k + 1) % size()) sum += runs[k].area;
  const Flat a = place(from), b = place(to);
  const double square = dot(b - a, b - a);
  return square > 0 ? 0.5 * (sum + cross(b, a)) / square : 0;
}

Shape Shape::turned(double angle) const {
  Shape out = *this;
  for (Corner& corner : out.corners) corner.place = karinui::turned(corner.place, angle);
  for (Run& run : out.runs)
    for (Flat& p : run.line) p = karinui::turned(p, angle);
  measure(out);
  return out;
}

Shape Shape::mirrored() const {
  Shape out = *this;
  const std::size_t n = size();
  for (std::size_t k = 0; k < n; ++k) {
    out.corners[k] = corners[n - 1 - k];
    out.corners[k].place.u = -out.corners[k].place.u;
    Run& run = out.runs[k] = runs[(2 * n - 2 - k) % n];
    std::reverse(run.line.begin(), run.line.end());
    for (Flat& p : run.line) p.u = -p.u;
  }
  measure(out);
  return out;
}

Shape shapeOf(const Piece& piece) {
  const Outline& outline = piece.outline;
  const std::size_t n = outline.edges.size();
  struct Found {
    std::size_t at;
    double turn, length;
  };
  std::vector<double> turn(n), own(n);
  for (std::size_t k = 0; k < n; ++k) {
    turn[k] = angleFrom(wayBefore(outline, k), wayAfter(outline, k));
    own[k] = outline.edges[k].curve.length();
  }
  Shape shape;
  // Darts: a point that the outline runs into and comes back from, along legs of one length between two corners.
  std::vector<char> leg(n, 0);
  for (std::size_t k = 0; k < n && n >= 5; ++k) {
    if (turn[k] > -kInto) continue;
    const std::size_t to = (k + n - 1) % n;
    const double a = own[to], b = own[k];
    const Flat mouth = outline.edges[to].curve.start - outline.edges[k].curve.end;
    if (std::abs(a - b) > std::max(0.004, 0.04 * std::max(a, b)) || karinui::length(mouth) > kSlim * std::max(a, b))
      continue;
    if (leg[to] || leg[k]) continue;
    leg[to] = leg[k] = 1;
    shape.darts.push_back({to, k});
  }
  // What is between is walked edge by edge; a dart's two legs are stepped over.
  std::vector<Found> found;
  for (std::size_t k = 0; k < n; ++k) {
    if (leg[k]) continue;
    std::size_t before = (k + n - 1) % n;
    double angle = turn[k];
    if (leg[before]) {  // closed up, the line goes on from the other end of the mouth
      std::size_t first = before;
      while (leg[(first + n - 1) % n] && first != k) first = (first + n - 1) % n;
      const Flat in = wayBefore(outline, first), out = wayAfter(outline, k);
      angle = angleFrom(in, out);
      // Legs turn by their own angle when they are closed.
      const Flat to = outline.edges[first].curve.end - outline.edges[first].curve.start,
                 back = outline.edges[before].curve.start - outline.edges[before].curve.end;
      angle += angleFrom(back, to);
      before = (first + n - 1) % n;
    }
    found.push_back({k, angle, 0});
  }
  std::vector<std::size_t> order(found.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(found[a].turn) > std::abs(found[b].turn); });
  std::vector<char> corner(found.size(), 0);
  for (std::size_t i = 0; i < order.size() && i < kMostCorners; ++i)
    corner[order[i]] = std::abs(found[order[i]].turn) > kSmooth || i < 3;
  std::size_t first = 0;
  while (first < corner.size() && !corner[first]) ++first;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Found& f = found[(first + i) % found.size()];
    if (corner[(first + i) % found.size()]) {
      shape.corners.push_back({outline.edges[f.at].curve.start, f.turn, f.at});
      if (!shape.runs.empty()) shape.runs.back().line.push_back(outline.edges[f.at].curve.start);
      shape.runs.emplace_back();
    }
    shape.runs.back().edges.push_back(f.at);
    shape.runs.back().length += own[f.at];
    const auto line = outline.edges[f.at].curve.flattened(1e-4);
    Ring& all = shape.runs.back().line;
    all.insert(all.end(), line.begin(), line.end());
  }
  shape.runs.back().line.push_back(shape.corners.front().place);
  measure(shape);
  return shape;
}

std::vector<double> notchesAlong(const Piece& piece, const std::vector<std::string>& edges, bool ends) {
  std::vector<double> all;
  double before = 0;
  for (const std::string& name : edges) {
    const Edge* edge = findEdge(piece, name);
    const double own = edge ? edge->curve.length() : 0;
    for (const Mark& mark : piece.marks)
      if (mark.edge == name) all.push_back(before + mark.fraction * own);
    before += own;
  }
  if (!ends) std::erase_if(all, [&](double at) { return at < kAtEnd || at > before - kAtEnd; });
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace karinui
