#include "geometry/unfold_strip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/result.h"

namespace karinui {
namespace {

using Laid = std::array<Flat, 3>;  // where a face's corners lie in the plane

// A third corner from its distances to two laid ones, to the left or right of the step from p to q.
Flat thirdCorner(Flat p, Flat q, double toP, double toQ, bool left) {
  const double base = distance(p, q);
  if (base <= 0) return p + Flat{toP, 0};
  const double x = (base * base + toP * toP - toQ * toQ) / (2 * base);
  const double y = std::sqrt(std::fmax(0.0, toP * toP - x * x));
  const Flat ahead = (q - p) * (1 / base);
  return p + ahead * x + leftOf(ahead) * (left ? y : -y);
}

struct Portal {
  std::uint32_t left = 0, right = 0;  // mesh points
  Flat leftAt, rightAt;
  bool has(std::uint32_t v) const { return left == v || right == v; }
};

struct LaidStrip {
  std::vector<Laid> faces;
  std::vector<Portal> portals;  // between face i and i + 1
};

LaidStrip layStrip(const TriangleMesh& mesh, std::span<const std::uint32_t> strip) {
  LaidStrip out;
  const auto edge = [&](std::uint32_t a, std::uint32_t b) { return distance(mesh.points[a], mesh.points[b]); };
  const Triangle& first = mesh.faces[strip.front()];
  Laid laid{Flat{0, 0}, Flat{edge(first[0], first[1]), 0}, {}};
  laid[2] = thirdCorner(laid[0], laid[1], edge(first[0], first[2]), edge(first[1], first[2]), true);
  out.faces.push_back(laid);
  bool counterClockwise = true;
  for (std::size_t i = 1; i < strip.size(); ++i) {
    const Triangle &from = mesh.faces[strip[i - 1]], &to = mesh.faces[strip[i]];
    for (std::size_t k = 0; k < 3; ++k) {  // the shared edge, as the old face and as the new one runs it
      const std::uint32_t a = from[k], b = from[(k + 1) % 3];
      const auto inTo = [&](std::uint32_t v) { return std::find(to.begin(), to.end(), v); };
      if (inTo(a) == to.end() || inTo(b) == to.end()) continue;
      const auto ia = static_cast<std::size_t>(inTo(a) - to.begin()),
                 ib = static_cast<std::size_t>(inTo(b) - to.begin());
      const Flat pa = out.faces.back()[k], pb = out.faces.back()[(k + 1) % 3];
      // Leaving a counter-clockwise face over a -> b, b is on the left hand.
      out.portals.push_back(counterClockwise ? Portal{b, a, pb, pa} : Portal{a, b, pa, pb});
      const std::size_t ic = 3 - ia - ib;
      Laid next;
      next[ia] = pa;
      next[ib] = pb;
      next[ic] = thirdCorner(pa, pb, edge(a, to[ic]), edge(b, to[ic]), !counterClockwise);
      if ((ia + 1) % 3 == ib) counterClockwise = !counterClockwise;  // a mesh whose faces disagree on the outer side
      out.faces.push_back(next);
      break;
    }
    KARINUI_ASSERT(out.faces.size() == i + 1);
  }
  return out;
}

Flat laidAt(const Laid& face, const SurfacePoint& place) {
  return face[0] * place.weight[0] + face[1] * place.weight[1] + face[2] * place.weight[2];
}

struct Turn {
  Flat at;
  std::uint32_t corner;
  std::size_t portal;
};

// The funnel walk (Lee & Preparata 1984): the corners the shortest line through all portals bends round.
std::vector<Turn> funnel(const std::vector<Portal>& portals, Flat from, Flat to) {
  std::vector<Turn> turns;
  Flat apex = from, left = from, right = from;
  std::size_t leftIndex = 0, rightIndex = 0;
  const std::size_t n = portals.size();
  std::size_t i = 0;
  for (std::size_t guard = 0; i <= n && guard < 4 * (n + 2) * (n + 2); ++guard, ++i) {
    if (i == n) {  // does the goal lie within the funnel?
      if (cross(left - apex, to - apex) > 0) {
        turns.push_back({left, portals[leftIndex].left, leftIndex});
        apex = right = left;
        i = rightIndex = leftIndex;
      } else if (cross(right - apex, to - apex) < 0) {
        turns.push_back({right, portals[rightIndex].right, rightIndex});
        apex = left = right;
        i = leftIndex = rightIndex;
      }
      continue;
    }
    const Flat newLeft = portals[i].leftAt, newRight = portals[i].rightAt;
    if (cross(right - apex, newRight - apex) >= 0) {
      if (right == apex || left == apex || cross(left - apex, newRight - apex) < 0) {
        right = newRight;
        rightIndex = i;
      } else {
        turns.push_back({left, portals[leftIndex].left, leftIndex});
        apex = right = left;
        i = rightIndex = leftIndex;
        continue;
      }
    }
    if (cross(left - apex, newLeft - apex) <= 0) {
      if (left == apex || right == apex || cross(right - apex, newLeft - apex) > 0) {
        left = newLeft;
        leftIndex = i;
      } else {
        turns.push_back({right, portals[rightIndex].right, rightIndex});
        apex = left = right;
        i = leftIndex = rightIndex;
        continue;
      }
    }
  }
  return turns;
}

double angleBetween(Flat a, Flat b) { return std::atan2(std::fabs(cross(a, b)), dot(a, b)); }

SurfacePoint cornerPlace(const TriangleMesh& mesh, std::uint32_t face, std::uint32_t corner) {
  SurfacePoint place{face, {0, 0, 0}};
  for (std::size_t k = 0; k < 3; ++k) place.weight[k] = mesh.faces[face][k] == corner ? 1 : 0;
  return place;
}

// Where the line from p to q passes a portal, as a place of a face that has the portal as an edge.
SurfacePoint passing(const TriangleMesh& mesh, std::uint32_t face, const Portal& portal, Flat p, Flat q) {
  const double l = cross(q - p, portal.leftAt - p), r = cross(q - p, portal.rightAt - p);
  double t = l - r != 0 ? l / (l - r) : 0.5;  // from left to right
  t = t < 1e-9 ? 0 : t > 1 - 1e-9 ? 1 : t;
  SurfacePoint place{face, {0, 0, 0}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.faces[face][k] == portal.left) place.weight[k] = 1 - t;
    if (mesh.faces[face][k] == portal.right) place.weight[k] = t;
  }
  return place;
}

}  // namespace

TautLine pullTaut(const TriangleMesh& mesh, std::span<const std::uint32_t> strip, const SurfacePoint& from,
                  const SurfacePoint& to) {
  const LaidStrip laid = layStrip(mesh, strip);
  const Flat start = laidAt(laid.faces.front(), from), end = laidAt(laid.faces.back(), to);
  const std::vector<Turn> turns = funnel(laid.portals, start, end);

  TautLine line;
  const auto stop = [&](std::size_t k) { return k == 0 ? start : k <= turns.size() ? turns[k - 1].at : end; };
  const auto turnsAt = [&](std::size_t k, const Portal& p) {
    return k >= 1 && k <= turns.size() && p.has(turns[k - 1].corner);
  };
  line.places.push_back(from);
  const auto add = [&](const SurfacePoint& place) {
    if (distance(at(mesh, line.places.back()), at(mesh, place)) > 0) line.places.push_back(place);
  };
  for (std::size_t k = 0; k <= turns.size(); ++k) {  // the stretch from stop k to stop k + 1
    line.length += distance(stop(k), stop(k + 1));
    const std::size_t begin = k == 0 ? 0 : turns[k - 1].portal;
    const std::size_t finish = k < turns.size() ? turns[k].portal : laid.portals.size();
    for (std::size_t i = begin; i < finish; ++i)
      if (!turnsAt(k, laid.portals[i]) && !turnsAt(k + 1, laid.portals[i]))
        add(passing(mesh, strip[i], laid.portals[i], stop(k), stop(k + 1)));
    if (k < turns.size()) add(cornerPlace(mesh, strip[turns[k].portal], turns[k].corner));
  }
  add(to);
  if (line.places.size() == 1) line.places.push_back(to);

  for (std::size_t k = 0; k < turns.size(); ++k) {
    const std::uint32_t v = turns[k].corner;
    std::size_t first = turns[k].portal, last = first;
    while (first > 0 && laid.portals[first - 1].has(v)) --first;
    while (last + 1 < laid.portals.size() && laid.portals[last + 1].has(v)) ++last;
    TautLine::Bend bend{v, first, last + 1, 0};
    const auto outer = [&](std::size_t face, const Portal& portal, Flat toward) {
      for (std::size_t c = 0; c < 3; ++c)
        if (!portal.has(mesh.faces[strip[face]][c]))
          return angleBetween(toward - turns[k].at, laid.faces[face][c] - turns[k].at);
      return 0.0;
    };
    bend.angleOutside = outer(first, laid.portals[first], stop(k)) + outer(last + 1, laid.portals[last], stop(k + 2));
    line.bends.push_back(bend);
  }
  return line;
}

}  // namespace karinui
