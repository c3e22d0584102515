#include "karinui/geometry/geodesic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <tuple>

#include "geometry/face_sides.h"
#include "geometry/unfold_strip.h"

namespace karinui {
namespace {

// Weights this small are rounding: the place lies on the edge or corner.
constexpr double kOnEdge = 1e-9;

SurfacePoint cleaned(SurfacePoint place) {
  double sum = 0;
  for (double& w : place.weight) sum += (w = w < kOnEdge ? 0 : w);
  for (double& w : place.weight) w /= sum;
  return place;
}

// The same place seen from a face that shares the edge or corner it lies on.
std::optional<SurfacePoint> seenFrom(const TriangleMesh& mesh, const SurfacePoint& place, std::uint32_t face) {
  SurfacePoint seen{face, {0, 0, 0}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (place.weight[k] == 0) continue;
    const auto& corners = mesh.faces[face];
    const auto it = std::find(corners.begin(), corners.end(), mesh.faces[place.face][k]);
    if (it == corners.end()) return std::nullopt;
    seen.weight[static_cast<std::size_t>(it - corners.begin())] = place.weight[k];
  }
  return seen;
}

// Steps to and fro between two faces lead nowhere.
void dropBacktracks(std::vector<std::uint32_t>& strip) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t f : strip) {
    if (!kept.empty() && kept.back() == f) continue;
    if (kept.size() >= 2 && kept[kept.size() - 2] == f) {
      kept.pop_back();
      continue;
    }
    kept.push_back(f);
  }
  strip = std::move(kept);
}

// An end that also lies in the next face of the strip does not need the first one.
void trimEnds(const TriangleMesh& mesh, std::vector<std::uint32_t>& strip, SurfacePoint& from, SurfacePoint& to) {
  std::size_t begin = 0, end = strip.size();
  while (begin + 1 < end) {
    const auto seen = seenFrom(mesh, from, strip[begin + 1]);
    if (!seen) break;
    from = *seen;
    ++begin;
  }
  while (begin + 1 < end) {
    const auto seen = seenFrom(mesh, to, strip[end - 2]);
    if (!seen) break;
    to = *seen;
    --end;
  }
  strip = std::vector<std::uint32_t>(strip.begin() + static_cast<std::ptrdiff_t>(begin),
                                     strip.begin() + static_cast<std::ptrdiff_t>(end));
}

// The way from face a to face b round corner v, in the one direction of the two that does not start over the edge to
// `not`. Gives the faces strictly between and the angle turned through all of them, a and b included.
struct WayRound {
  std::vector<std::uint32_t> between;
  double angle = 0;
};
std::optional<WayRound> wayRound(const SurfaceGuide& guide, std::uint32_t v, std::uint32_t a, std::uint32_t b,
                                 std::uint32_t avoid) {
  const auto& faces = guide.mesh().faces;
  WayRound way;
  std::uint32_t f = a, last = avoid;
  for (int guard = 0; guard < 200; ++guard) {
    std::uint32_t next = SurfaceGuide::kNone;
    for (int k = 0; k < 3; ++k) {  // the two edges of f at v: k starting at v, or ending at v
      const bool atV =
          faces[f][static_cast<std::size_t>(k)] == v || faces[f][static_cast<std::size_t>((k + 1) % 3)] == v;
      if (atV && guide.across(f, k) != last && guide.across(f, k) != SurfaceGuide::kNone) next = guide.across(f, k);
    }
    if (next == SurfaceGuide::kNone) return std::nullopt;
    if (next == b) return way;
    if (next == a) return std::nullopt;
    way.between.push_back(next);
    last = f;
    f = next;
  }
  return std::nullopt;
}

double cornerAngle(const TriangleMesh& mesh, std::uint32_t face, std::uint32_t v) {
  const auto& t = mesh.faces[face];
  const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
  const Vec3 p = mesh.points[v], a = mesh.points[t[(k + 1) % 3]] - p, b = mesh.points[t[(k + 2) % 3]] - p;
  return std::atan2(length(cross(a, b)), dot(a, b));
}

bool readsBefore(const SurfacePoint& a, const SurfacePoint& b) {
  return std::tie(a.face, a.weight) < std::tie(b.face, b.weight);
}

}  // namespace

SurfacePath reversed(SurfacePath path) {
  std::reverse(path.places.begin(), path.places.end());
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

SurfacePoint along(const TriangleMesh& mesh, const SurfacePath& path, double fraction) {
  KARINUI_ASSERT(!path.empty());
  double left = std::clamp(fraction, 0.0, 1.0) * path.length;
  for (std::size_t i = 0; i + 1 < path.places.size(); ++i) {
    const double step = distance(path.points[i], path.points[i + 1]);
    if (left > step && i + 2 < path.places.size()) {
      left -= step;
      continue;
    }
    const double t = step > 0 ? std::min(left / step, 1.0) : 0;
    // Both ends in one face: the face of either, or one that shares both (a step along an edge or over a corner).
    for (const SurfacePoint* host : {&path.places[i], &path.places[i + 1]}) {
      const auto a = seenFrom(mesh, path.places[i], host->face), b = seenFrom(mesh, path.places[i + 1], host->face);
      if (!a || !b) continue;
      SurfacePoint place{host->face, {}};
      for (std::size_t k = 0; k < 3; ++k) place.weight[k] = a->weight[k] * (1 - t) + b->weight[k] * t;
      return place;
    }
    return t < 0.5 ? path.places[i] : path.places[i + 1];
  }
  return path.places.back();
}

SurfaceGuide::SurfaceGuide(const TriangleMesh& mesh) : mesh_(&mesh), across_(mesh.faces.size(), {kNone, kNone, kNone}) {
  const std::vector<FaceSide> sides = sidesByEdge(mesh);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i;
    while (j < sides.size() && sides[j].sameEdge(sides[i])) ++j;
    if (j - i == 2) {  // an edge of three or more faces is nobody's way
      across_[sides[i].face][sides[i].from] = sides[i + 1].face;
      across_[sides[i + 1].face][sides[i + 1].from] = sides[i].face;
    }
    i = j;
  }
}

// The cheapest chain of faces, by the distances of their middles and aimed at the goal (A*). Empty if there is none.
std::vector<std::uint32_t> SurfaceGuide::strip(const SurfacePoint& from, const SurfacePoint& to) const {
  const auto middle = [&](std::uint32_t f) {
    const Triangle& t = mesh_->faces[f];
    return (mesh_->points[t[0]] + mesh_->points[t[1]] + mesh_->points[t[2]]) * (1.0 / 3);
  };
  const Vec3 goal = at(*mesh_, to);
  std::vector<double> cost(mesh_->faces.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(mesh_->faces.size(), kNone);
  using Entry = std::tuple<double, std::uint32_t, double>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[from.face] = 0;
  open.emplace(0.0, from.face, 0.0);
  while (!open.empty()) {
    const auto [estimate, f, paid] = open.top();
    open.pop();
    if (f == to.face) break;
    if (paid > cost[f]) continue;
    const Vec3 here = f == from.face ? at(*mesh_, from) : middle(f);
    for (std::uint32_t g : across_[f]) {
      if (g == kNone) continue;
      const Vec3 there = g == to.face ? goal : middle(g);
      const double c = paid + distance(here, there);
      if (c >= cost[g]) continue;
      cost[g] = c;
      before[g] = f;
      open.emplace(c + distance(there, goal), g, c);
    }
  }
  if (std::isinf(cost[to.face])) return {};
  std::vector<std::uint32_t> chain{to.face};
  while (chain.back() != from.face) chain.push_back(before[chain.back()]);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

Result<SurfacePath> SurfaceGuide::straight(const SurfacePoint& fromGiven, const SurfacePoint& toGiven) const {
  if (readsBefore(toGiven, fromGiven)) {
    auto back = straight(toGiven, fromGiven);
    if (!back) return back.error();
    return reversed(std::move(*back));
  }
  SurfacePoint from = cleaned(fromGiven), to = cleaned(toGiven);
  KARINUI_ASSERT(from.face < mesh_->faces.size() && to.face < mesh_->faces.size());
  std::vector<std::uint32_t> faces = strip(from, to);
  if (faces.empty()) return refused(say("The two places lie on parts of the body that do not hang together."));

  TautLine line;
  std::vector<std::uint32_t> settled;  // corners whose other side proved no shorter
  const std::size_t most = 50 * faces.size() + 200;
  for (std::size_t round = 0; round < most; ++round) {
    trimEnds(*mesh_, faces, from, to);
    line = pullTaut(*mesh_, faces, from, to);
    bool changed = false;
    for (const TautLine::Bend& bend : line.bends) {
      if (std::find(settled.begin(), settled.end(), bend.corner) != settled.end()) continue;
      const std::uint32_t a = faces[bend.firstFace], b = faces[bend.lastFace];
      const auto way = wayRound(*this, bend.corner, a, b, faces[bend.firstFace + 1]);
      if (!way) continue;
      double other = bend.angleOutside;
      for (std::uint32_t f : way->between) other += cornerAngle(*mesh_, f, bend.corner);
      if (other >= std::numbers::pi - 1e-10) continue;
      std::vector<std::uint32_t> led(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(bend.firstFace) + 1);
      led.insert(led.end(), way->between.begin(), way->between.end());
      led.insert(led.end(), faces.begin() + static_cast<std::ptrdiff_t>(bend.lastFace), faces.end());
      dropBacktracks(led);
      SurfacePoint ledFrom = from, ledTo = to;
      trimEnds(*mesh_, led, ledFrom, ledTo);
      const TautLine shorter = pullTaut(*mesh_, led, ledFrom, ledTo);
      if (shorter.length >= line.length) {
        settled.push_back(bend.corner);
        continue;
      }
      faces = std::move(led);
      from = ledFrom;
      to = ledTo;
      changed = true;
      break;
    }
    if (!changed) break;
  }

  SurfacePath path;
  path.places = std::move(line.places);
  for (const SurfacePoint& p : path.places) path.points.push_back(at(*mesh_, p));
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) path.length += distance(path.points[i], path.points[i + 1]);
  return path;
}

}  // namespace karinui
