#include "karinui/geometry/section.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "geometry/predicates.h"
#include "karinui/base/result.h"

namespace karinui {
namespace {

// A mesh edge the plane cuts, always named from its lower to its higher point so that both faces compute the same
// place.
using CutEdge = std::pair<std::uint32_t, std::uint32_t>;

struct Cut {
  CutEdge from, to;
  std::uint32_t face = 0;
};

constexpr std::uint32_t kNone = ~0u;

// The cuts that start on an edge, in the order of faces: a hash table with linear probing.
class CutsByStart {
 public:
  explicit CutsByStart(const std::vector<Cut>& cuts)
      : cuts_(cuts), slot_(std::bit_ceil(2 * cuts.size() + 1), kNone), later_(cuts.size()) {
    for (auto i = static_cast<std::uint32_t>(cuts.size()); i-- > 0;) {
      std::uint32_t& first = slot_[slotOf(cuts[i].from)];
      later_[i] = first;
      first = i;
    }
  }
  std::uint32_t first(const CutEdge& edge) const { return slot_[slotOf(edge)]; }  // kNone: there is none
  std::uint32_t after(std::uint32_t cut) const { return later_[cut]; }

 private:
  std::size_t slotOf(const CutEdge& edge) const {
    const std::size_t mask = slot_.size() - 1;
    std::size_t at =
        (edge.first * std::size_t{0x9E3779B97F4A7C15} + edge.second * std::size_t{0xC2B2AE3D27D4EB4F}) >> 32;
    for (at &= mask; slot_[at] != kNone && cuts_[slot_[at]].from != edge;) at = (at + 1) & mask;
    return at;
  }

  const std::vector<Cut>& cuts_;
  std::vector<std::uint32_t> slot_, later_;
};

CutEdge named(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Cut> cutFaces(const TriangleMesh& mesh, const std::vector<double>& height) {
  std::vector<std::uint8_t> over(height.size());  // small, for nearly all faces are only asked this
  for (std::size_t i = 0; i < height.size(); ++i) over[i] = height[i] >= 0;
  std::vector<Cut> cuts;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f];
    const std::array<std::uint8_t, 3> above{over[t[0]], over[t[1]], over[t[2]]};
    if (const int sum = above[0] + above[1] + above[2]; sum == 0 || sum == 3) continue;
    Cut cut;
    cut.face = f;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      // The face runs counter-clockwise seen from outside; the line through it keeps the solid on its left when it goes
      // from the edge that falls through the plane to the edge that rises.
      if (above[k] && !above[next]) cut.from = named(t[k], t[next]);
      if (!above[k] && above[next]) cut.to = named(t[k], t[next]);
    }
    cuts.push_back(cut);
  }
  return cuts;
}

// Two unit directions that see the plane from above: right, up, normal are right-handed.
std::pair<Vec3, Vec3> axesOf(Vec3 normal) {
  const Vec3 helper = std::fabs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 right = normalized(cross(helper, normal));
  return {right, cross(normal, right)};
}

// The hull's corners as indices, by A. M. Andrew's monotone chain, with exact turns.
std::vector<std::size_t> hullIndices(std::span<const Flat> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Flat p = points[a], q = points[b];
    return p.u != q.u ? p.u < q.u : p.v != q.v ? p.v < q.v : a < b;
  });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] == points[b]; }),
      order.end());
  if (order.size() < 3) return order;
  std::vector<std::size_t> hull;
  const auto extend = [&](std::size_t i, std::size_t keep) {
    while (hull.size() >= keep + 2 && side(points[hull[hull.size() - 2]], points[hull.back()], points[i]) <= 0)
      hull.pop_back();
    hull.push_back(i);
  };
  for (std::size_t i : order) extend(i, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = order.size() - 1; i-- > 0;) extend(order[i], lower);
  hull.pop_back();
  return hull;
}

}  // namespace

std::vector<SectionLoop> section(const TriangleMesh& mesh, const Plane& plane) {
  std::vector<double> height(mesh.points.size());
  for (std::size_t i = 0; i < height.size(); ++i) height[i] = dot(mesh.points[i] - plane.through, plane.normal);
  const std::vector<Cut> cuts = cutFaces(mesh, height);

  const CutsByStart starting(cuts);
  std::vector<bool> entered(cuts.size(), false);  // where another cut ends on the edge one starts on
  for (const Cut& cut : cuts)
    for (std::uint32_t i = starting.first(cut.to); i != kNone && !entered[i]; i = starting.after(i)) entered[i] = true;
  const auto placeOn = [&](CutEdge e) {
    const double a = height[e.first], b = height[e.second];
    return lerp(mesh.points[e.first], mesh.points[e.second], a / (a - b));
  };

  std::vector<bool> used(cuts.size(), false);
  std::vector<SectionLoop> loops;
  const auto follow = [&](std::uint32_t first) {
    SectionLoop loop;
    for (std::uint32_t i = first;;) {
      used[i] = true;
      loop.points.push_back(placeOn(cuts[i].from));
      loop.faces.push_back(cuts[i].face);
      if (cuts[i].to == cuts[first].from) break;
      std::uint32_t next = starting.first(cuts[i].to);
      while (next != kNone && used[next]) next = starting.after(next);
      if (next == kNone) {
        loop.points.push_back(placeOn(cuts[i].to));
        loop.closed = false;
        break;
      }
      i = next;
    }
    loops.push_back(std::move(loop));
  };
  // Open lines first, from the edges where nothing ends; what is left runs in circles.
  for (std::uint32_t i = 0; i < cuts.size(); ++i)
    if (!used[i] && !entered[i]) follow(i);
  for (std::uint32_t i = 0; i < cuts.size(); ++i)
    if (!used[i]) follow(i);
  std::sort(loops.begin(), loops.end(),
            [](const SectionLoop& a, const SectionLoop& b) { return a.faces.front() < b.faces.front(); });
  return loops;
}

double lineLength(std::span<const Vec3> points, bool closed) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  if (closed && points.size() > 1) sum += distance(points.back(), points.front());
  return sum;
}

double enclosedArea(std::span<const Vec3> loop, Vec3 normal) {
  Vec3 twice;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) twice += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  return dot(twice, normal) / 2;
}

std::vector<Flat> convexHull(std::span<const Flat> points) {
  std::vector<Flat> hull;
  for (std::size_t i : hullIndices(points)) hull.push_back(points[i]);
  return hull;
}

std::vector<Vec3> tightTape(std::span<const Vec3> points, Vec3 normal) {
  const auto [right, up] = axesOf(normal);
  std::vector<Flat> flat(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) flat[i] = {dot(points[i], right), dot(points[i], up)};
  std::vector<Vec3> tape;
  for (std::size_t i : hullIndices(flat)) tape.push_back(points[i]);
  return tape;
}

double tightTapeLength(std::span<const Vec3> points, Vec3 normal) {
  return lineLength(tightTape(points, normal), true);
}

}  // namespace karinui
