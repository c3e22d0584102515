#include <algorithm>
#include <cmath>
#include <set>

#include "karinui/pattern/piece.h"
#include "retrace.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kJoin = 1e-6;        // ends nearer than this are one place
constexpr double kShortest = 1e-5;    // of an edge
constexpr double kNarrowest = 7e-4;   // of a piece, on average
constexpr double kSmallest = 1e-4;    // of a piece: 1 cm2
constexpr double kLargest = 100;      // metres from the origin: beyond that something is wrong with the units
constexpr std::size_t kMost = 20000;  // edges

bool goodName(std::string_view name) {
  return !name.empty() && name.size() <= 200 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

bool onTable(Flat p) { return finite(p) && std::abs(p.u) <= kLargest && std::abs(p.v) <= kLargest; }

bool reasonable(const Curve& curve) {
  for (Flat p : {curve.start, curve.end, curve.control1, curve.control2})
    if (!onTable(p)) return false;
  if (!std::all_of(curve.between.begin(), curve.between.end(), onTable)) return false;
  return std::isfinite(curve.bulge) && std::abs(curve.bulge) < 1e3;
}

// Ends that are on the other segment, but for rounding, cross nothing: a slit's mouth, or a bank that goes on beyond
// it.
bool crosses(Flat a, Flat b, Flat c, Flat d) {
  const auto apart = [](Flat p, Flat q, Flat r, Flat s) {
    const Flat way = normalized(q - p);
    const double first = cross(way, r - p), second = cross(way, s - p);
    return std::fmin(first, second) < -kJoin && std::fmax(first, second) > kJoin;
  };
  return apart(a, b, c, d) && apart(c, d, a, b);
}

// Where a slit leaves the cloth: its mouth stands on the outline, all else must lie inside.
std::optional<Flat> slitTrouble(const OpenedOut& open) {
  for (const auto& slit : open.slits)
    for (std::size_t k = 0; k + 1 < slit.size(); ++k) {
      if (!contains(open.ring, slit[k + 1])) return slit[k + 1];
      for (std::size_t j = 0; j < open.ring.size(); ++j)
        if (crosses(slit[k], slit[k + 1], open.ring[j], open.ring[(j + 1) % open.ring.size()])) return slit[k];
      for (const auto& other : open.slits)
        for (std::size_t j = 0; j + 1 < other.size(); ++j)
          if (crosses(slit[k], slit[k + 1], other[j], other[j + 1])) return slit[k];
    }
  return std::nullopt;
}

}  // namespace

Result<Outline> checked(Outline outline) {
  auto& edges = outline.edges;
  if (edges.size() < 2) return badInput(say("An outline needs at least two edges; this one has {0}.", edges.size()));
  if (edges.size() > kMost)
    return badInput(
        say("An outline of {0} {0|edge|edges} is more than Karinui takes ({1}); simplify it.", edges.size(), kMost));
  std::set<std::string> names;
  for (const Edge& edge : edges) {
    if (!goodName(edge.name))
      return badInput(
          say("\"{0}\" cannot name an edge; use letters, digits, dash and underscore.", edge.name.substr(0, 40)));
    if (!names.insert(edge.name).second)
      return badInput(say("Two edges are named {0}; give each its own name.", edge.name));
    if (!reasonable(edge.curve))
      return badInput(
          say("Edge {0} has a place that is not a usable number (lengths are metres, within 100 m).", edge.name));
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t next = (k + 1) % edges.size();
    const double gap = distance(edges[k].curve.end, edges[next].curve.start);
    if (gap > kJoin)
      return badInput(say("The outline is open: edge {0} ends at {1} mm, {2} mm from where edge {3} starts; join them.",
                          edges[k].name, inMm(edges[k].curve.end), inMm(gap), edges[next].name));
    edges[next].curve.start = edges[k].curve.end;
  }
  for (const Edge& edge : edges)
    if (const double own = edge.curve.length(); own < kShortest)
      return badInput(
          say("Edge {0} at {1} mm is only {2} mm long; make it at least 0.01 mm or join it with its neighbour.",
              edge.name, inMm(edge.curve.start), fixed(own * 1e3, 3)));
  const OpenedOut open = withoutSlits(outline, 1e-5);
  const auto trouble = crossing(open.ring);
  const auto slit = trouble ? trouble : slitTrouble(open);
  if (slit)
    return badInput(
        say("The outline crosses or touches itself at {0} mm; draw it so that it stays clear of itself.", inMm(*slit)));
  const double area = outline.area();
  if (std::abs(area) < kSmallest)
    return badInput(say("The outline at {0} mm holds only {1} cm2 of cloth; a piece needs at least 1 cm2.",
                        inMm(edges[0].curve.start), fixed(std::abs(area) * 1e4, 2)));
  const double width = 2 * std::abs(area) / outline.length();
  if (width < kNarrowest)
    return badInput(say("The outline at {0} mm is only {1} mm wide on average; make it at least 1 mm wide.",
                        inMm(edges[0].curve.start), fixed(width * 1e3, 2)));
  if (area < 0) {
    std::reverse(edges.begin(), edges.end());
    for (Edge& edge : edges) edge.curve = edge.curve.reversed();
  }
  return outline;
}

}  // namespace karinui
