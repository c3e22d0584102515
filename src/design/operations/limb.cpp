#include "design/operations/limb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace karinui {

namespace {

constexpr double kOff = 1e-7;  // a plane just beside a mesh's own points cuts its faces cleanly
constexpr int kLevels = 9;     // sections taken over the piece's height
constexpr int kAround = 48;    // places looked for round a limb, and kRings such rings from one named level to the next
constexpr int kRings = 12;

constexpr double kBeside = 0.005;  // a piece narrower than the way from ring to ring
constexpr double kHand = 0.1;      // metres from the body: cloth further off hangs elsewhere

// How high above the limb's origin each point of the mesh lies.
std::vector<double> heightsOf(const TriangleMesh& mesh, const LimbFrame& limb) {
  std::vector<double> heights;
  heights.reserve(mesh.points.size());
  for (const Vec3 p : mesh.points) heights.push_back(dot(p - limb.origin, limb.up));
  return heights;
}

// Where the mesh meets the plane `height` above the limb's origin: loose segments on the plane, grouped by being
// joined.
std::vector<std::vector<Flat>> sections(const TriangleMesh& mesh, const std::vector<double>& heights,
                                        const LimbFrame& limb, double height) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> node;  // a crossed edge of the mesh is a node
  std::vector<Flat> place;
  std::vector<std::uint32_t> parent;
  const auto root = [&](std::uint32_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  const auto above = [&](std::uint32_t p) { return heights[p] - height; };
  for (const Triangle& face : mesh.faces) {
    const bool first = above(face[0]) < 0;
    if ((above(face[1]) < 0) == first && (above(face[2]) < 0) == first) continue;  // most of them
    std::array<std::uint32_t, 3> ends{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t a = face[i], b = face[(i + 1) % 3];
      if (a > b) std::swap(a, b);
      const double ha = above(a), hb = above(b);
      if ((ha < 0) == (hb < 0)) continue;
      const auto [at, fresh] = node.try_emplace({a, b}, static_cast<std::uint32_t>(place.size()));
      if (fresh) {
        place.push_back(limb.onPlane(lerp(mesh.points[a], mesh.points[b], ha / (ha - hb))));
        parent.push_back(at->second);
      }
      ends[count++] = at->second;
    }
    if (count == 2) parent[std::max(root(ends[0]), root(ends[1]))] = std::min(root(ends[0]), root(ends[1]));
  }
  std::map<std::uint32_t, std::vector<Flat>> loops;
  for (std::uint32_t n = 0; n < place.size(); ++n) loops[root(n)].push_back(place[n]);
  std::vector<std::vector<Flat>> all;
  for (auto& [first, loop] : loops) all.push_back(std::move(loop));
  return all;
}

const std::vector<Flat>* nearest(const std::vector<std::vector<Flat>>& loops, Flat place) {
  const std::vector<Flat>* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    for (const Flat p : loop) {
      if (const double d = distance(p, place); d < least) least = d, best = &loop;
    }
  }
  return best;
}

}  // namespace

bool isLimb(BodyPoint::Part part) {
  return part == BodyPoint::Part::LeftArm || part == BodyPoint::Part::RightArm || part == BodyPoint::Part::LeftLeg ||
         part == BodyPoint::Part::RightLeg;
}

std::vector<LimbRing> ringsOf(const Body& body, BodyPoint::Part part) {
  std::vector<LimbRing> rings;
  const int levels = static_cast<int>(chartLevels(part).size());
  for (int i = 0; i <= (levels - 1) * kRings; ++i) {
    LimbRing ring{static_cast<double>(i) / kRings, {}, {}};
    for (int k = 0; k < kAround; ++k) {
      BodyPoint at;
      at.part = part, at.along = ring.along, at.around = static_cast<double>(k) / kAround;
      if (const auto place = body.find(at)) ring.skin.push_back(karinui::at(body.mesh(), *place));
    }
    for (const Vec3 p : ring.skin) ring.middle += p * (1.0 / static_cast<double>(ring.skin.size()));
    if (ring.skin.size() >= kAround / 4) rings.push_back(std::move(ring));
  }
  return rings;
}

Vec3 axisOver(const std::vector<LimbRing>& rings, Vec3 anchor, double low, double high) {
  Vec3 up{0, 1, 0};
  for (int round = 0; round < 3; ++round) {
    const LimbRing *bottom = nullptr, *top = nullptr;
    const auto height = [&](const LimbRing& ring) { return dot(ring.middle - anchor, up); };
    for (const LimbRing& ring : rings) {
      // Open rings have no middle; they lie beyond the first closed one.
      if (ring.skin.size() < kAround) continue;
      if (!bottom || std::abs(height(ring) - low) < std::abs(height(*bottom) - low)) bottom = &ring;
      if (!top || std::abs(height(ring) - high) < std::abs(height(*top) - high)) top = &ring;
    }
    if (!bottom || !top || distance(bottom->middle, top->middle) < 0.02) return up;
    up = normalized(top->middle - bottom->middle);
    if (up.y < 0) up = -up;
  }
  return up;
}

// Andrew's monotone chain, counter-clockwise.
Ring hull(std::vector<Flat> points) {
  std::sort(points.begin(), points.end(), [](Flat a, Flat b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
  Ring ring;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = ring.size();
    for (const Flat p : points) {
      while (ring.size() >= base + 2 && cross(ring.back() - ring[ring.size() - 2], p - ring.back()) <= 1e-12)
        ring.pop_back();
      ring.push_back(p);
    }
    ring.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return ring;
}

Ring grown(const Ring& ring, double ease) {
  Ring out;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Flat in = normalized(ring[i] - ring[(i + n - 1) % n]), on = normalized(ring[(i + 1) % n] - ring[i]);
    const double turn = angleFrom(in, on);
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / 0.1)));
    const Flat side = -leftOf(in);
    for (int k = 0; k <= steps; ++k) {
      const double a = turn * k / steps;
      out.push_back(ring[i] +
                    Flat{side.u * std::cos(a) - side.v * std::sin(a), side.u * std::sin(a) + side.v * std::cos(a)} *
                        ease);
    }
  }
  return out;
}

std::vector<SkinPlace> ringsAround(const std::vector<LimbRing>& rings, const LimbFrame& limb, const FlatBox& box) {
  std::vector<SkinPlace> all;
  for (const LimbRing& ring : rings)
    for (const Vec3 p : ring.skin) {
      const double height = dot(p - limb.origin, limb.up);
      if (height >= box.low.v - kBeside && height <= box.high.v + kBeside) all.push_back({limb.onPlane(p), height});
    }
  return all;
}

std::vector<SkinPlace> levelsAround(const Body& body, const LimbFrame& limb, const FlatBox& box, bool bothLegs) {
  const std::vector<double> heights = heightsOf(body.mesh(), limb);
  const auto around = sections(body.mesh(), heights, limb, kOff);
  const auto* found = nearest(around, {0, 0});
  if (!found || found->size() < 3) return {};
  std::vector<SkinPlace> all;
  const auto add = [&](const std::vector<Flat>& loop, double height) {
    for (const Flat p : loop) all.push_back({p, height});
  };
  add(*found, 0);
  const FlatBox core = boxOf(*found);
  const Flat middle = lerp(core.low, core.high, 0.5);
  const Ring coreHull = hull(*found);
  const double reach = 1.5 * length(core.high - core.low);
  Ring above;  // round what counts at the level above, below the anchor
  for (int k = kLevels - 1; k >= 0; --k) {
    const double height = box.low.v + (box.high.v - box.low.v) * k / (kLevels - 1);
    std::vector<Flat> here;
    for (const auto& loop : sections(body.mesh(), heights, limb, height + kOff)) {
      const FlatBox its = boxOf(loop);
      if (length(its.high - its.low) > reach) continue;
      const Flat centre = lerp(its.low, its.high, 0.5);
      const bool trunk = contains(coreHull, centre) && distance(centre, middle) < 0.5 * length(core.high - core.low);
      if (!trunk && !(bothLegs && !above.empty() && contains(above, centre))) continue;
      add(loop, height);
      here.insert(here.end(), loop.begin(), loop.end());
    }
    if (height < 0 && !here.empty()) above = hull(std::move(here));
  }
  return all;
}

std::vector<SkinPlace> clothAround(const Document& document, PieceId without, const LimbFrame& limb, const FlatBox& box,
                                   const std::vector<SkinPlace>& skin) {
  std::vector<Flat> core;
  for (const SkinPlace& p : skin) core.push_back(p.place);
  const Ring ring = hull(std::move(core));
  std::vector<SkinPlace> all;
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (id == without || !piece->form) continue;
    for (const Vec3 own : piece->form->space) {
      const Vec3 p = piece->pose(own) - limb.origin;
      const double height = dot(p, limb.up);
      if (height < box.low.v - kBeside || height > box.high.v + kBeside) continue;
      const Flat place = limb.onPlane(limb.origin + p);
      if (contains(ring, place) || distanceToRing(ring, place) < kHand) all.push_back({place, height});
    }
  }
  return all;
}

}  // namespace karinui
